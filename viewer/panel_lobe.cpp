// The lobe of the selected material, its light moved by a slider.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "glint/scene/look_text.h"
#include "glint/shading/angles.h"
#include "panel.h"
#include "plot_axes.h"
#include "widgets.h"

namespace glint::viewer {
namespace {

using widgets::style;

// The lobe as a polar plot: the length of a ray is the value in its direction.
void polarLobe(const LobePlot& plot) {
  const float text = ImGui::GetTextLineHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float radius = std::min(width / 2 - 2.5f * text, 105 * style().scale);
  ImGui::Dummy(ImVec2(width, radius + 1.2f * text));
  const ImVec2 foot(corner.x + width / 2, corner.y + radius + 0.6f * text);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImU32 grid = IM_COL32(255, 255, 255, 40);
  const auto at = [&](double degrees, double length) {
    const double a = degrees * radians;
    return ImVec2(foot.x + radius * float(length * std::sin(a)),
                  foot.y - radius * float(length * std::cos(a)));
  };
  for (const double r : {0.5, 1.0}) {
    std::vector<ImVec2> arc;
    for (int a = -90; a <= 90; a += 3) arc.push_back(at(a, r));
    draw->AddPolyline(arc.data(), int(arc.size()), grid, 0, 1);
  }
  for (int a = -90; a <= 90; a += 30) draw->AddLine(foot, at(a, 1), grid);
  draw->AddLine(at(-plot.incidence, 1), foot, IM_COL32(255, 255, 255, 150), style().scale);
  draw->AddText(ImVec2(at(-plot.incidence, 1.0).x - text, at(-plot.incidence, 1.0).y - text),
                ImGui::GetColorU32(ImGuiCol_TextDisabled), "L");
  draw->AddText(ImVec2(at(plot.incidence, 1.0).x + 3, at(plot.incidence, 1.0).y - text),
                ImGui::GetColorU32(ImGuiCol_TextDisabled), "R");
  const auto rose = [&](const Curve& curve, ImU32 color, float line) {
    std::vector<ImVec2> points;
    for (const glm::dvec2& p : curve.points) points.push_back(at(p.x, p.y));
    draw->AddPolyline(points.data(), int(points.size()), color, 0, line * style().scale);
  };
  rose(plot.exact, exactColor, 2.2f);
  rose(plot.chosen, chosenColor, 1.2f);
}

void lobeOverAngle(const LobePlot& plot, const std::string& form) {
  const Plot axes({-90, 0}, {90, 1.05}, 150);
  axes.grid({{-90, "-90"}, {-45, "-45"}, {0, "0"}, {45, "45"}, {90, "90"}},
            {{0, "0"}, {0.5, ".5"}, {1, "1"}});
  axes.curve(plot.exact, exactColor, 2.2f);
  axes.curve(plot.chosen, chosenColor, 1.2f);
  if (const auto x = axes.hovered())
    ImGui::SetTooltip("viewer at %.1f degrees: exact %.5g, %s %.5g", *x, yAt(plot.exact, *x),
                      form.c_str(), yAt(plot.chosen, *x));
}

// The surface above the lit plane, seen from outside; dragging or the slider below turns it.
void lobeInSpace(const LobeSurface& surface, double incidence) {
  static double turn = 30, tilt = 25;  // degrees: about the normal, and above the plane
  const float text = ImGui::GetTextLineHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float radius = std::min(width / 2 - 1.5f * text, 95 * style().scale);
  const float height = 1.5f * radius + text;
  ImGui::InvisibleButton("##space", ImVec2(width, height));
  if (ImGui::IsItemActive()) {
    turn = std::remainder(turn - double(ImGui::GetIO().MouseDelta.x / style().scale), 360.0);
    tilt = std::clamp(tilt + double(ImGui::GetIO().MouseDelta.y / style().scale), 0.0, 90.0);
  }
  if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
  const double c = std::cos(turn * radians), s = std::sin(turn * radians);
  const double ct = std::cos(tilt * radians), st = std::sin(tilt * radians);
  const ImVec2 foot(corner.x + width / 2, corner.y + 1.1f * radius + text / 2);
  // Right, up and towards the viewer.
  const auto seen = [&](const glm::dvec3& p) {
    const double right = c * p.x + s * p.y, back = -s * p.x + c * p.y;
    return glm::dvec3(right, back * st + p.z * ct, p.z * st - back * ct);
  };
  const auto at = [&](const glm::dvec3& p) {
    const glm::dvec3 q = seen(p);
    return ImVec2(foot.x + radius * float(q.x), foot.y - radius * float(q.y));
  };
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->PushClipRect(corner, ImVec2(corner.x + width, corner.y + height), true);
  std::vector<ImVec2> plane;
  for (int a = 0; a < 360; a += 6)
    plane.push_back(at({std::cos(a * radians), std::sin(a * radians), 0}));
  draw->AddConvexPolyFilled(plane.data(), int(plane.size()), IM_COL32(255, 255, 255, 22));
  const glm::dvec3 light(-std::sin(incidence * radians), 0, std::cos(incidence * radians));
  const glm::dvec3 mirror(-light.x, 0, light.z);
  const auto ray = [&](const glm::dvec3& to, const char* name, ImU32 color) {
    draw->AddLine(foot, at(to), color, style().scale);
    draw->AddText(ImVec2(at(to).x + 3, at(to).y - text / 2), color, name);
  };
  const ImU32 dim = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  ray({0, 0, 1}, "N", dim);
  ray(mirror, "R", dim);
  // Quads, farthest first, shaded by their orientation to the viewer.
  const std::size_t across = surface.columns, rows = surface.points.size() / across;
  struct Quad {
    double depth;
    std::size_t first;
  };
  std::vector<Quad> quads;
  for (std::size_t i = 0; i + 1 < rows; ++i)
    for (std::size_t j = 0; j + 1 < across; ++j) {
      const std::size_t k = across * i + j;
      const glm::dvec3 middle = surface.points[k] + surface.points[k + 1] +
                                surface.points[k + across] + surface.points[k + across + 1];
      quads.push_back({seen(middle).z, k});
    }
  std::ranges::sort(quads, {}, &Quad::depth);
  const ImDrawListFlags flags = draw->Flags;
  draw->Flags &= ~ImDrawListFlags_AntiAliasedFill;  // would show seams
  for (const Quad& quad : quads) {
    const glm::dvec3 *p = &surface.points[quad.first], *q = p + across;
    const glm::dvec3 n = glm::cross(seen(q[1]) - seen(p[0]), seen(q[0]) - seen(p[1]));
    const double length = glm::length(n);
    if (!(length > 0)) continue;
    const double shade = 0.35 + 0.65 * std::abs(n.z) / length;
    const auto part = [&](int code) { return int(code * shade); };
    const ImU32 color = IM_COL32(part(90), part(170), part(255), 255);
    draw->AddQuadFilled(at(p[0]), at(p[1]), at(q[1]), at(q[0]), color);
  }
  draw->Flags = flags;
  ray(light, "L", IM_COL32(255, 255, 255, 230));
  draw->PopClipRect();
  ImGui::SetNextItemWidth(-1);
  widgets::slider("##turn", turn, {-180, 180, false}, -180, 180, "seen from %.0f deg");
}

}  // namespace

void drawLobe(Settings& settings, const LobeInput& input) {
  const std::string form = highlightText(input.highlight);
  for (const auto& [view, name] : {std::pair{LobeView::polar, "polar"},
                                   {LobeView::overAngle, "over angle"},
                                   {LobeView::inSpace, "in space"}}) {
    if (ImGui::RadioButton(name, settings.lobe == view)) settings.lobe = view;
    ImGui::SameLine();
  }
  ImGui::NewLine();
  ImGui::SetNextItemWidth(-1);
  widgets::slider("##incidence", settings.incidence, {0, 89, false}, 0, 89, "light at %.0f deg");
  widgets::tooltip(widgets::parameterTooltip(
      "the light's angle from the normal, in the plots alone", {}, "degrees", 0, 89));
  const LobePlot plot = lobePlot(input, settings.incidence);
  if (settings.lobe == LobeView::polar) polarLobe(plot);
  if (settings.lobe == LobeView::overAngle) lobeOverAngle(plot, form);
  if (settings.lobe == LobeView::inSpace)
    lobeInSpace(lobeSurface(input, settings.incidence), settings.incidence);
  if (settings.lobe != LobeView::inSpace) {
    legend(exactColor, "exact");
    ImGui::SameLine();
  }
  legend(chosenColor, form == "exact" ? "chosen: exact" : ("chosen: " + form).c_str());
  ImGui::SameLine();
  ImGui::TextDisabled("half width %.3g deg", plot.halfWidth);
  differencePlot(plot.chosen, plot.exact, plot.largestDifference, {-90, -45, 0, 45, 90});
}

}  // namespace glint::viewer
