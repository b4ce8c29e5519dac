#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "choice.h"
#include "glint/render/variant.h"
#include "glint/scene/look_text.h"
#include "glint/shading/angles.h"
#include "materials.h"
#include "panel.h"
#include "plot_axes.h"
#include "widgets.h"

namespace glint::viewer {
namespace {

using widgets::style;

constexpr ImU32 exactColor = IM_COL32(240, 190, 80, 255);
constexpr ImU32 chosenColor = IM_COL32(90, 170, 255, 255);
constexpr ImU32 sColor = IM_COL32(130, 220, 130, 255);
constexpr ImU32 differenceColor = IM_COL32(240, 110, 90, 255);
constexpr ImU32 pColor = IM_COL32(225, 120, 190, 255);

// What the chosen form adds to the exact one, on a scale of its own.
void differencePlot(const Curve& chosen, const Curve& exact, double largest,
                    std::initializer_list<double> ticks) {
  if (!(largest > 1e-13)) {  // rounding in double
    ImGui::TextDisabled("the chosen form is the exact one");
    return;
  }
  // Ticks at a round number below the largest value.
  const double power = std::pow(10.0, std::floor(std::log10(largest)));
  const double tick = largest >= 5 * power ? 5 * power : largest >= 2 * power ? 2 * power : power;
  const auto first = exact.points.front().x, last = exact.points.back().x;
  const Plot axes({first, -1.1 * largest}, {last, 1.1 * largest}, 74, 3.3f);
  char text[32];
  for (const double x : ticks) {
    std::snprintf(text, sizeof text, "%.0f", x);
    axes.gridX(x, text);
  }
  axes.gridY(0, "0");
  std::snprintf(text, sizeof text, "%.0e", tick);
  std::string shortened = text;  // 2e-03 as 2e-3
  if (const auto zero = shortened.find("e-0"); zero != std::string::npos)
    shortened.erase(zero + 2, 1);
  if (const auto plus = shortened.find("e+00"); plus != std::string::npos) shortened.erase(plus);
  axes.gridY(tick, shortened.c_str());
  axes.gridY(-tick, "");
  const Curve d = difference(chosen, exact);
  axes.curve(d, differenceColor, 1.4f);
  if (const auto x = axes.hovered())
    ImGui::SetTooltip("%.1f degrees: chosen - exact = %.4g", *x, yAt(d, *x));
  legend(differenceColor, "chosen - exact");
  ImGui::SameLine();
  std::snprintf(text, sizeof text, "at most %.3g", largest);
  ImGui::TextDisabled("%s", text);
}

// The lobe as a rose: the length of a ray is what is sent along it.
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

void lobePlots(Settings& settings, const LobeInput& input) {
  const std::string form = highlightText(input.highlight);
  bool& polar = settings.polar;
  if (ImGui::RadioButton("polar", polar)) polar = true;
  ImGui::SameLine();
  if (ImGui::RadioButton("over angle", !polar)) polar = false;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  float incidence = float(settings.incidence);
  if (ImGui::SliderFloat("##incidence", &incidence, 0, 89, "light at %.0f deg"))
    settings.incidence = double(incidence);
  const LobePlot plot = lobePlot(input, settings.incidence);
  if (polar) {
    polarLobe(plot);
  } else {
    const Plot axes({-90, 0}, {90, 1.05}, 150);
    for (const auto& [x, text] :
         {std::pair{-90.0, "-90"}, {-45.0, "-45"}, {0.0, "0"}, {45.0, "45"}, {90.0, "90"}})
      axes.gridX(x, text);
    axes.gridY(0, "0");
    axes.gridY(0.5, ".5");
    axes.gridY(1, "1");
    axes.curve(plot.exact, exactColor, 2.2f);
    axes.curve(plot.chosen, chosenColor, 1.2f);
    if (const auto x = axes.hovered())
      ImGui::SetTooltip("viewer at %.1f degrees: exact %.5g, %s %.5g", *x, yAt(plot.exact, *x),
                        form.c_str(), yAt(plot.chosen, *x));
  }
  legend(exactColor, "exact");
  ImGui::SameLine();
  legend(chosenColor, form == "exact" ? "chosen: exact" : ("chosen: " + form).c_str());
  ImGui::SameLine();
  ImGui::TextDisabled("half width %.3g deg", plot.halfWidth);
  differencePlot(plot.chosen, plot.exact, plot.largestDifference, {-90, -45, 0, 45, 90});
}

void fresnelPlots(bool& inside, Fresnel fresnel, double n1, double n2, double schlickExponent) {
  if (ImGui::RadioButton("entering", !inside)) inside = false;
  ImGui::SameLine();
  if (ImGui::RadioButton("leaving", inside)) inside = true;
  if (inside) std::swap(n1, n2);
  const std::string form(fresnelText(fresnel));
  const FresnelPlot plot = fresnelPlot(fresnel, n1, n2, schlickExponent);
  const Plot axes({0, 0}, {90, 1.02}, 170);
  for (const auto& [x, text] : {std::pair{0.0, "0"}, {30.0, "30"}, {60.0, "60"}, {90.0, "90"}})
    axes.gridX(x, text);
  axes.gridY(0, "0");
  axes.gridY(0.5, ".5");
  axes.gridY(1, "1");
  axes.markX(plot.brewster, IM_COL32(225, 120, 190, 130));
  if (plot.critical) axes.markX(*plot.critical, IM_COL32(255, 255, 255, 130));
  axes.curve(plot.perpendicular, sColor, 1);
  axes.curve(plot.parallel, pColor, 1);
  axes.curve(plot.exact, exactColor, 2.2f);
  axes.curve(plot.chosen, chosenColor, 1.2f);
  if (const auto x = axes.hovered())
    ImGui::SetTooltip("%.1f degrees: R %.5g, %s %.5g\nperpendicular %.5g, parallel %.5g", *x,
                      yAt(plot.exact, *x), form.c_str(), yAt(plot.chosen, *x),
                      yAt(plot.perpendicular, *x), yAt(plot.parallel, *x));
  legend(exactColor, "R exact");
  ImGui::SameLine();
  legend(chosenColor, ("chosen: " + form).c_str());
  legend(sColor, style().greek ? "R\u22a5" : "R perp.");
  ImGui::SameLine();
  legend(pColor, style().greek ? "R\u2225" : "R par.");
  char text[160];
  std::snprintf(text, sizeof text, "R(0) = %.4g; Brewster's angle %.2f degrees",
                plot.normalIncidence, plot.brewster);
  ImGui::TextDisabled("%s", text);
  if (plot.critical) ImGui::TextDisabled("critical angle %.2f degrees", *plot.critical);
  differencePlot(plot.chosen, plot.exact, plot.largestDifference, {0, 30, 60, 90});
}

void widthPlots(double exponent) {
  const WidthPlot plot = widthPlot(exponent);
  const Plot axes({0, 0}, {85, 5}, 140);
  for (const auto& [x, text] : {std::pair{0.0, "0"}, {30.0, "30"}, {60.0, "60"}})
    axes.gridX(x, text);
  for (const auto& [y, text] : {std::pair{0.0, "0"}, {2.0, "2"}, {4.0, "4"}}) axes.gridY(y, text);
  axes.curve(plot.inPlane, exactColor);
  axes.curve(plot.across, chosenColor);
  if (const auto x = axes.hovered())
    ImGui::SetTooltip("light at %.1f degrees: %.4g in the plane, %.4g across it", *x,
                      yAt(plot.inPlane, *x), yAt(plot.across, *x));
  legend(exactColor, "in the plane of incidence");
  ImGui::SameLine();
  legend(chosenColor, "across it");
}

// A plot that a key has asked for is opened, the others are closed.
void openWanted(const Session& session, bool mine) {
  if (session.plotWanted) ImGui::SetNextItemOpen(mine);
}

// And seen as a whole.
void seeWanted(const Session& session, bool mine) {
  if (session.plotWanted && mine) ImGui::SetScrollHereY(1);
}

}  // namespace

void drawPlots(PanelContext& context) {
  Session& session = context.session;
  session.plotShown = true;
  const PlotView plot = session.plot;
  const bool lobe = plot == PlotView::lobe || plot == PlotView::lobeOverAngle;
  const bool fresnel = plot == PlotView::fresnel || plot == PlotView::fresnelLeaving;
  if (session.plotWanted && lobe) context.settings.polar = plot == PlotView::lobe;
  static bool inside = false;
  if (session.plotWanted && fresnel) inside = plot == PlotView::fresnelLeaving;
  Look look = session.document.a;
  const DrawnPicture* picture = context.picture;
  if (leavesOpen(look) && picture && leavesOpen(picture->asked))
    look = withChoice(look, *picture->choice);
  const Material material = effectiveMaterial(session.model->scene, look, session.material);
  const ShadingParameters& s = material.shading;
  LobeInput input;
  input.exponent = s.exponent;
  input.blinnFactor = look.blinnFactor;
  input.blinn = usesBlinn(look.shading);
  input.highlight = highlightOf(material, look).brightest;
  openWanted(session, lobe);
  if (ImGui::CollapsingHeader(input.blinn ? "Lobe (Blinn-Phong)###lobe" : "Lobe (Phong)###lobe",
                              ImGuiTreeNodeFlags_DefaultOpen))
    lobePlots(context.settings, input);
  seeWanted(session, lobe);
  const bool fresnelOpen = look.shading == Shading::environment;
  ImGui::SetNextItemOpen(fresnelOpen, ImGuiCond_Once);
  openWanted(session, fresnel);
  if (ImGui::CollapsingHeader("Fresnel reflectance"))
    fresnelPlots(inside, fresnelOf(material, look), look.mediumIor, s.ior, look.schlickExponent);
  seeWanted(session, fresnel);
  openWanted(session, plot == PlotView::widths);
  if (ImGui::CollapsingHeader(style().greek ? "\u03b1'/\u03b1 of equally wide highlights###width"
                                            : "a'/a of equally wide highlights###width"))
    widthPlots(s.exponent);
  seeWanted(session, plot == PlotView::widths);
  drawMeasured(context, {input.blinn, input.blinnFactor});
  session.plotWanted = false;
}

}  // namespace glint::viewer
