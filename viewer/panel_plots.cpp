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

constexpr ImU32 sColor = IM_COL32(130, 220, 130, 255);
constexpr ImU32 pColor = IM_COL32(225, 120, 190, 255);

void fresnelPlots(bool& inside, Fresnel fresnel, double n1, double n2, double schlickExponent) {
  if (ImGui::RadioButton("entering", !inside)) inside = false;
  ImGui::SameLine();
  if (ImGui::RadioButton("leaving", inside)) inside = true;
  if (inside) std::swap(n1, n2);
  const std::string form(fresnelText(fresnel));
  const FresnelPlot plot = fresnelPlot(fresnel, n1, n2, schlickExponent);
  const Plot axes({0, 0}, {90, 1.02}, 170);
  axes.grid({{0, "0"}, {30, "30"}, {60, "60"}, {90, "90"}}, {{0, "0"}, {0.5, ".5"}, {1, "1"}});
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
  axes.grid({{0, "0"}, {30, "30"}, {60, "60"}}, {{0, "0"}, {2, "2"}, {4, "4"}});
  axes.curve(plot.inPlane, exactColor);
  axes.curve(plot.across, chosenColor);
  if (const auto x = axes.hovered())
    ImGui::SetTooltip("light at %.1f degrees: %.4g in the plane, %.4g across it", *x,
                      yAt(plot.inPlane, *x), yAt(plot.across, *x));
  legend(exactColor, "in the plane of incidence");
  ImGui::SameLine();
  legend(chosenColor, "across it");
}

// Opens the plot that a key has asked for, and closes the others.
void openWanted(const Session& session, bool mine) {
  if (session.plotWanted) ImGui::SetNextItemOpen(mine);
}

// Scrolls that plot fully into view.
void seeWanted(const Session& session, bool mine) {
  if (session.plotWanted && mine) ImGui::SetScrollHereY(1);
}

}  // namespace

void drawPlots(PanelContext& context) {
  Session& session = context.session;
  session.plotShown = true;
  const PlotView plot = session.plot;
  const bool lobe = int(plot) <= int(PlotView::lobeInSpace);
  const bool fresnel = plot == PlotView::fresnel || plot == PlotView::fresnelLeaving;
  if (session.plotWanted && lobe) context.settings.lobe = LobeView(plot);
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
    drawLobe(context.settings, input);
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
