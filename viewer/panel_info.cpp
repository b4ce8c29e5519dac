#include <imgui.h>

#include <cmath>
#include <cstdio>
#include <set>

#include "compose.h"
#include "effects.h"
#include "glint/options/parameters.h"
#include "glint/scene/lights.h"
#include "glint/scene/look_text.h"
#include "materials.h"
#include "panel.h"
#include "widgets.h"

namespace glint::viewer {
namespace {

// Breaks a text into one line per part.
std::string inLines(std::string text) {
  for (std::size_t at; (at = text.find("; ")) != std::string::npos;) text.replace(at, 2, "\n");
  return text;
}

using widgets::style;

void row(const char* name, const char* format, ...) IM_FMTARGS(2);
void row(const char* name, const char* format, ...) {
  ImGui::TextDisabled("%s", name);
  ImGui::SameLine(style().labelWidth * 0.75f);
  va_list arguments;
  va_start(arguments, format);
  ImGui::TextV(format, arguments);
  va_end(arguments);
}

void vectorRow(const char* name, const glm::dvec3& v) {
  row(name, "%.5f  %.5f  %.5f", v.x, v.y, v.z);
}

void lightRows(const LightProbe& light, int number) {
  ImGui::TextUnformatted(("Light " + std::to_string(number) + " (" + light.name + ")").c_str());
  vectorRow("  L", light.L);
  row(style().greek ? "  N\u00b7L  R\u00b7V  N\u00b7H" : "  N.L R.V N.H", "%.5f  %.5f  %.5f",
      light.nl, light.rv, light.nh);
  vectorRow("  diffuse", light.diffuse);
  vectorRow("  specular", light.specular);
}

void surfaceRows(const Session& session, const Probe& probe) {
  row("material", "%s%s", materialLabel(session.model->scene, probe.hit->material).c_str(),
      probe.layers > 1 ? "  (seen through)" : "");
  vectorRow("C", probe.color);
  if (probe.alpha != 1) row("alpha", "%.5f", probe.alpha);
  if (probe.N == glm::dvec3(0.0)) {
    ImGui::TextDisabled("%s: shows C", probe.hit->topology == Topology::points  ? "a point"
                                       : probe.hit->topology == Topology::lines ? "a line"
                                                                                : "unlit");
    return;
  }
  vectorRow("N", probe.N);
  vectorRow("V", probe.V);
  row(style().greek ? "N\u00b7V" : "N.V", "%.6f%s", probe.nv,
      probe.hit->backFace ? "  (back face)" : "");
  row(style().greek ? "R(\u03b8)" : "R(theta)", "%.6g", probe.reflectance);
  vectorRow("ambient", probe.ambient);
  int n = 0;
  for (const LightProbe& light : probe.lights) lightRows(light, ++n);
  if (probe.emission != glm::dvec3(0.0)) vectorRow("emission", probe.emission);
  if (!probe.environment) return;
  vectorRow("reflection", probe.reflection);
  if (probe.transparency == 0) return;
  vectorRow("refraction", probe.refraction);
  row("transparency", "%.5f", probe.transparency);
}

void probeRows(PanelContext& context, const Probe& probe) {
  if (probe.other)
    row("pixel", "%d, %d of look %c", probe.pixel.x, probe.pixel.y, probe.side);
  else
    row("pixel", "%d, %d", probe.pixel.x, probe.pixel.y);
  if (probe.hit)
    surfaceRows(context.session, probe);
  else
    ImGui::TextDisabled("background");
  ImGui::Spacing();
  row("shown", "%.6f  %.6f  %.6f", double(probe.shown.r), double(probe.shown.g),
      double(probe.shown.b));
  row("  as sRGB", "%d  %d  %d", probe.code[0], probe.code[1], probe.code[2]);
  if (probe.other) {
    const glm::dvec3 mine(probe.shown), other(*probe.other);
    const glm::dvec3 d = probe.side == 'A' ? mine - other : other - mine;
    row("A - B", "%+.6f  %+.6f  %+.6f", d.r, d.g, d.b);
  }
  row("reference", "%.6f  %.6f  %.6f", probe.expected.r, probe.expected.g, probe.expected.b);
  row("  levels off", "%+d  %+d  %+d of 255", probe.code[0] - probe.expectedCode[0],
      probe.code[1] - probe.expectedCode[1], probe.code[2] - probe.expectedCode[2]);
  if (probe.center) {
    const bool same = *probe.center == probe.shown;
    if (!same) vectorRow("at the centre", glm::dvec3(*probe.center));
    row("  off by", "%+.2g  %+.2g  %+.2g ulp", probe.ulps[0], probe.ulps[1], probe.ulps[2]);
    if (!same) ImGui::TextDisabled("at the centre: without anti-aliasing");
  } else {
    ImGui::TextDisabled("  ulp: drawing without anti-aliasing ...");
  }
  if (!probe.remark.empty()) ImGui::TextWrapped("%s", probe.remark.c_str());
  actionButton(context, Action::copyPixel, "Copy");
}

void variantRows(const Scene& scene, const DrawnPicture& picture) {
  std::set<Variant> seen;
  const Look look = withFileLights(scene, picture.look);
  for (const DrawItem& item : picture.list.items) {
    if (!seen.insert(item.variant).second) continue;
    const std::string title = std::string(shadingName(item.variant.program)) + " " +
                              std::to_string(seen.size()) + "##" + std::to_string(seen.size());
    if (!ImGui::TreeNodeEx(title.c_str(), seen.size() == 1 ? ImGuiTreeNodeFlags_DefaultOpen : 0))
      continue;
    const Mesh& mesh = scene.meshes[std::size_t(item.mesh)];
    const Material material =
        editedMaterial(scene.materials[std::size_t(item.material)], picture.look);
    for (const FeatureReason& reason :
         reasonsFor(item.variant, mesh, material, look, picture.list.camera.orthographic)) {
      ImGui::PushStyleColor(ImGuiCol_Text, reason.present
                                               ? ImGui::GetStyleColorVec4(ImGuiCol_Text)
                                               : ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
      ImGui::TextWrapped("%s %s: %s", reason.present ? "+" : "-", reason.feature.c_str(),
                         reason.reason.c_str());
      ImGui::PopStyleColor();
    }
    ImGui::TreePop();
  }
}

}  // namespace

void drawCompareTab(PanelContext& context) {
  Document& document = context.session.document;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float half = (ImGui::GetContentRegionAvail().x - gap) / 2;
  actionButton(context, Action::keepAsB, "Keep as B", half);
  ImGui::SameLine();
  actionButton(context, Action::swapAB, "Exchange A and B", half);
  if (!document.b)
    ImGui::TextWrapped(
        "Keep the look as B, then go on editing A: the two are shown side by side, in turn, or as "
        "their difference. To compare two programs or forms with one look, keep it and choose "
        "another here or on the tab Shading.");
  ImGui::Separator();
  ImGui::TextDisabled("A is compared with");
  ImGui::BeginDisabled(!document.b);
  if (ImGui::RadioButton("B", !document.exact)) document.exact = false;
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (ImGui::RadioButton("its exact reference", document.exact)) {
    if (document.compare == CompareMode::off) document.compare = CompareMode::split;
    document.exact = true;
  }
  widgets::tooltip(
      "the same look in the exact forms, in double precision on the processor, drawn while you "
      "wait; both without multisampling, which the reference does not have (" +
      keyText(infoOf(Action::compareExact)) + ")");
  if (!document.b && !document.exact) return;
  ImGui::Separator();
  const std::pair<CompareMode, Action> modes[] = {
      {CompareMode::off, Action::compareOff},
      {CompareMode::split, Action::compareSplit},
      {CompareMode::blink, Action::compareBlink},
      {CompareMode::difference, Action::compareDifference}};
  const char* const names[] = {"only A", "side by side",
                               document.exact ? "reference instead of A" : "B instead of A",
                               "difference"};
  for (int i = 0; i < 4; ++i) {
    if (ImGui::RadioButton(names[i], document.compare == modes[i].first))
      document.compare = modes[i].first;
    actionTooltip(modes[i].second);
  }
  if (document.compare == CompareMode::split) {
    widgets::label("divider");
    widgets::slider("##divider", document.divider, {0, 1, false}, 0, 1);
    if (widgets::resetAsked(true)) document.divider = 0.5;
  }
  if (document.compare == CompareMode::difference && !document.exact) {
    widgets::label("times");
    widgets::slider("##times", document.amplification, {1, 256, true}, 1, 256);
    if (widgets::resetAsked(true)) document.amplification = 16;
    widgets::tooltip("the difference of the 8-bit values is multiplied by this");
  }
  if (!context.comparison.empty() && document.compare != CompareMode::off)
    ImGui::TextWrapped("%s", inLines(context.comparison).c_str());
  if (document.exact || !document.b) return;
  ImGui::Separator();
  ImGui::TextDisabled("B's values; A's are on the tabs Shading to Picture");
  for (const Parameter& p : lookParameters()) {
    if (p.name != "shading" && p.name != "highlight" && p.name != "fresnel" &&
        p.name != "max-error")
      continue;
    ImGui::PushID("b");
    widgets::parameter(p, *document.b,
                       context.session.model ? &context.session.model->scene : nullptr);
    ImGui::PopID();
  }
  ImGui::Separator();
  ImGui::TextDisabled("What differs");
  const std::vector<Difference> all = differences(document.a, *document.b);
  for (const Difference& each : all)
    ImGui::TextWrapped("%s: A %s, B %s", each.what.c_str(), valueText(each.a).c_str(),
                       valueText(each.b).c_str());
  if (all.empty()) ImGui::TextUnformatted("nothing: A and B are the same look");
}

void drawInfoTab(PanelContext& context) {
  Session& session = context.session;
  if (session.model && ImGui::CollapsingHeader("Pixel", ImGuiTreeNodeFlags_DefaultOpen)) {
    *context.probeShown = true;
    if (context.probe)
      probeRows(context, *context.probe);
    else
      ImGui::TextDisabled("move the mouse over the picture");
  }
  if (session.model && ImGui::CollapsingHeader("Model", ImGuiTreeNodeFlags_DefaultOpen)) {
    const Scene& scene = session.model->scene;
    std::size_t triangles = 0, lines = 0, points = 0;
    for (const Instance& i : scene.instances) {
      const Mesh& mesh = scene.meshes[std::size_t(i.mesh)];
      std::size_t& count = mesh.topology == Topology::triangles ? triangles
                           : mesh.topology == Topology::lines   ? lines
                                                                : points;
      count += mesh.indices.size() / cornersOf(mesh.topology);
    }
    ImGui::TextWrapped("%s", session.model->path.string().c_str());
    row("triangles", "%zu", triangles);
    if (points > 0) row("points", "%zu", points);
    if (lines > 0) row("lines", "%zu", lines);
    row("pieces", "%zu", scene.instances.size());
    row("radius", "%.5g", session.model->bounds.radius);
    vectorRow("centre", session.model->bounds.center);
    row("load", "%.0f ms", session.model->loadTime);
  }
  if (context.picture && ImGui::CollapsingHeader("Frame", ImGuiTreeNodeFlags_DefaultOpen)) {
    const DrawnPicture& p = *context.picture;
    row("picture", "%d x %d%s", p.look.resolution.x, p.look.resolution.y,
        context.preview ? " (while moving)" : "");
    row("samples", "%d per pixel", p.samples);
    row("total", "%.1f ms", p.milliseconds);
    row("compile", "%.1f ms", p.times.compile);
    row("draw", "%.1f ms", p.times.draw);
    row("read back", "%.1f ms", p.times.read);
    row("panel", "%.1f ms", context.uiMilliseconds);
    if (p.notNumbers > 0) row("not a number", "%zu pixels", p.notNumbers);
  }
  if (context.picture && session.model &&
      ImGui::CollapsingHeader("Shaders and why", ImGuiTreeNodeFlags_DefaultOpen))
    variantRows(session.model->scene, *context.picture);
  if (ImGui::CollapsingHeader("Log", ImGuiTreeNodeFlags_DefaultOpen)) {
    if (session.log.empty()) ImGui::TextDisabled("no messages");
    for (const std::string& line : session.log) ImGui::TextWrapped("%s", line.c_str());
  }
}

}  // namespace glint::viewer
