// The textures of the selected material.
#include <imgui.h>

#include <algorithm>

#include "imgui_versions.h"
#include "material_textures.h"
#include "panel.h"
#include "widgets.h"

namespace glint::viewer {

void drawTextures(PanelContext& context) {
  Session& session = context.session;
  const Scene& scene = session.model->scene;
  Look& look = session.document.a;
  const auto textures = materialTextures(scene, look, session.material);
  if (textures.empty() || !context.thumbnails) return;
  if (!ImGui::CollapsingHeader("Textures", ImGuiTreeNodeFlags_DefaultOpen)) return;
  const float side = 2 * ImGui::GetFrameHeight();
  int number = 0;
  for (const MaterialTexture& texture : textures) {
    ImGui::PushID(number++);
    const auto shown = context.thumbnails->of(session.model->images, texture.image);
    if (shown.texture != 0) {
      const float longer = float(std::max(shown.width, shown.height));
      imgui::image(shown.texture, side * float(shown.width) / longer,
                   side * float(shown.height) / longer);
    } else {
      ImGui::Dummy(ImVec2(side, side));
    }
    ImGui::SameLine(side + 2 * ImGui::GetStyle().ItemSpacing.x);
    ImGui::BeginGroup();
    bool on = !texture.isOff;
    if (ImGui::Checkbox(texture.name.c_str(), &on))
      switchTexture(look, scene, session.material, texture, on);
    widgets::tooltip(texture.own ? "off: as if the material had none; on: it is used again"
                                 : "off: the values above replace it; on: it replaces them again");
    ImGui::TextDisabled("%s", texture.drives.c_str());
    ImGui::EndGroup();
    ImGui::PopID();
  }
}

}  // namespace glint::viewer
