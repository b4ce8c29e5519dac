// A measured material compared with the edited one.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "edits.h"
#include "glint/image/error.h"
#include "glint/shading/angles.h"
#include "materials.h"
#include "panel.h"
#include "plot_axes.h"
#include "widgets.h"

namespace glint::viewer {
namespace {

constexpr ImU32 channelColors[3] = {IM_COL32(255, 120, 110, 255), IM_COL32(120, 220, 120, 255),
                                    IM_COL32(130, 170, 255, 255)};
constexpr ImU32 thickColors[3] = {IM_COL32(255, 120, 110, 120), IM_COL32(120, 220, 120, 120),
                                  IM_COL32(130, 170, 255, 120)};

// Samples the plane of incidence over the viewer's angle from the normal, as the lobe plot does.
template <typename Light>
void sample(Curve (&curves)[3], double incidence, Light light) {
  const auto at = [](double degrees) {
    return glm::dvec3(std::sin(degrees * radians), 0, std::cos(degrees * radians));
  };
  for (double angle = -88; angle <= 88; angle += 0.5) {
    const glm::dvec3 value = light(at(-incidence), at(angle));
    for (int c = 0; c < 3; ++c)
      if (std::isfinite(value[c])) curves[c].points.emplace_back(angle, value[c]);
  }
}

// What the fit and the error were computed for; both take a while.
struct Compared {
  std::shared_ptr<const MeasuredMaterial> material;
  ShadingParameters parameters;
  FitForm form;
  FitError error;
};

bool same(const Compared& c, const std::shared_ptr<const MeasuredMaterial>& material,
          const ShadingParameters& s, const FitForm& form) {
  return c.material == material && c.form.blinn == form.blinn &&
         c.form.blinnFactor == form.blinnFactor && c.parameters.color == s.color &&
         std::ranges::all_of(materialParameters(), [&](const MaterialParameter& p) {
           return c.parameters.*p.value == s.*p.value;
         });
}

void errorRow(const std::shared_ptr<const MeasuredMaterial>& material, const ShadingParameters& s,
              const FitForm& form) {
  static Compared last;
  if (!same(last, material, s, form)) {
    if (ImGui::IsAnyMouseDown() && last.material) {
      ImGui::TextDisabled("the error is computed when edits pause");
      return;
    }
    last = {material, s, form, errorOf(*material, s, form)};
  }
  ImGui::TextWrapped("RMSE %.3g (%.3g %% of the measurement), max %.3g; linear light",
                     last.error.rmse, 100 * last.error.relative, last.error.largest);
  widgets::tooltip(
      "the sum for a light of intensity 1 compared with pi times the measured reflectance times "
      "N.L, over all pairs of directions within 80 degrees of the normal");
}

void plotOf(Settings& settings, const MeasuredMaterial& material, const ShadingParameters& s,
            const FitForm& form) {
  ImGui::SetNextItemWidth(-1);
  widgets::slider("##light", settings.incidence, {0, 85, false}, 0, 89, "light at %.0f deg");
  Curve measured[3], model[3];
  sample(measured, settings.incidence,
         [&](const glm::dvec3& L, const glm::dvec3& V) { return material.light(L, V); });
  sample(model, settings.incidence,
         [&](const glm::dvec3& L, const glm::dvec3& V) { return modelLight(s, form, L, V); });
  double most = 1e-3;
  for (const Curve* curves : {measured, model})
    for (int c = 0; c < 3; ++c)
      for (const glm::dvec2& p : curves[c].points)
        if (std::abs(p.x) <= 80) most = std::max(most, p.y);
  const Plot axes({-90, 0}, {90, 1.05 * most}, 170, 2.8f);
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", most);
  axes.grid({{-90, "-90"}, {-45, "-45"}, {0, "0"}, {45, "45"}, {90, "90"}},
            {{0, "0"}, {most, text}});
  axes.markX(settings.incidence, IM_COL32(255, 255, 255, 60));
  for (int c = 0; c < 3; ++c) {
    axes.curve(measured[c], thickColors[c], 4.0f);
    axes.curve(model[c], channelColors[c], 1.3f);
  }
  if (const auto x = axes.hovered(); x && !measured[0].points.empty())
    ImGui::SetTooltip("viewer at %.1f degrees\nmeasured %.4g %.4g %.4g\nmodel %.4g %.4g %.4g", *x,
                      yAt(measured[0], *x), yAt(measured[1], *x), yAt(measured[2], *x),
                      yAt(model[0], *x), yAt(model[1], *x), yAt(model[2], *x));
  legend(IM_COL32(200, 200, 200, 120), "thick: measured");
  ImGui::SameLine();
  legend(IM_COL32(230, 230, 230, 255), "thin: the model, by channel");
}

}  // namespace

void drawMeasured(PanelContext& context, const FitForm& form) {
  Session& session = context.session;
  const bool any = session.measured != nullptr;
  if (!ImGui::CollapsingHeader("Measured material###measured",
                               any ? ImGuiTreeNodeFlags_DefaultOpen : 0))
    return;
  if (!any) {
    ImGui::TextWrapped(
        "Open a measured reflectance (MERL .binary): it is compared here with the model, and a "
        "button fits the material to it.");
    actionButton(context, Action::open, "Open ...", -1);
    return;
  }
  const auto& material = session.measured;
  Look& look = session.document.a;
  const Scene& scene = session.model->scene;
  const ShadingParameters s = effectiveParameters(scene, look, session.material);
  ImGui::TextWrapped("%s", material->path().filename().string().c_str());
  plotOf(context.settings, *material, s, form);
  errorRow(material, s, form);
  actionButton(context, Action::fitMeasured, "Fit the material to it", -1);
}

}  // namespace glint::viewer
