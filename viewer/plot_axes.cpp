#include "plot_axes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "widgets.h"

namespace glint::viewer {

using widgets::style;

namespace {

ImU32 gridColor() { return IM_COL32(255, 255, 255, 28); }
ImU32 textColor() { return ImGui::GetColorU32(ImGuiCol_TextDisabled); }

constexpr ImU32 differenceColor = IM_COL32(240, 110, 90, 255);

}  // namespace

Plot::Plot(glm::dvec2 low, glm::dvec2 high, float height, float margin) : low_(low), high_(high) {
  const float text = ImGui::GetTextLineHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::Dummy(ImVec2(width, height * style().scale));
  hovered_ = ImGui::IsItemHovered();
  begin_ = ImVec2(corner.x + margin * text, corner.y + 0.4f * text);
  end_ = ImVec2(corner.x + width - 0.6f * text, corner.y + height * style().scale - 1.3f * text);
  draw_ = ImGui::GetWindowDrawList();
  draw_->AddRectFilled(begin_, end_, ImGui::GetColorU32(ImGuiCol_FrameBg));
}

ImVec2 Plot::at(glm::dvec2 p) const {
  const glm::dvec2 share = (p - low_) / (high_ - low_);
  return ImVec2(begin_.x + float(share.x) * (end_.x - begin_.x),
                end_.y - float(std::clamp(share.y, -0.01, 1.01)) * (end_.y - begin_.y));
}

void Plot::grid(Lines xs, Lines ys) const {
  for (const auto& [x, text] : xs) gridX(x, text);
  for (const auto& [y, text] : ys) gridY(y, text);
}
void Plot::gridX(double x, const char* text) const {
  const ImVec2 p = at({x, low_.y});
  draw_->AddLine(ImVec2(p.x, begin_.y), ImVec2(p.x, end_.y), gridColor());
  const ImVec2 size = ImGui::CalcTextSize(text);
  draw_->AddText(ImVec2(p.x - size.x / 2, end_.y + 1), textColor(), text);
}
void Plot::gridY(double y, const char* text) const {
  const ImVec2 p = at({low_.x, y});
  draw_->AddLine(ImVec2(begin_.x, p.y), ImVec2(end_.x, p.y), gridColor());
  const ImVec2 size = ImGui::CalcTextSize(text);
  draw_->AddText(ImVec2(begin_.x - size.x - 4, p.y - size.y / 2), textColor(), text);
}
void Plot::markX(double x, ImU32 color) const {
  const ImVec2 p = at({x, low_.y});
  draw_->AddLine(ImVec2(p.x, begin_.y), ImVec2(p.x, end_.y), color, style().scale);
}
void Plot::curve(const Curve& c, ImU32 color, float width) const {
  std::vector<ImVec2> points;
  for (const glm::dvec2& p : c.points)
    if (std::isfinite(p.y)) points.push_back(at(p));
  draw_->PushClipRect(begin_, end_, true);
  draw_->AddPolyline(points.data(), int(points.size()), color, 0, width * style().scale);
  draw_->PopClipRect();
}
std::optional<double> Plot::hovered() const {
  const float x = ImGui::GetIO().MousePos.x;
  if (!hovered_ || x < begin_.x || x > end_.x) return {};
  return low_.x + double((x - begin_.x) / (end_.x - begin_.x)) * (high_.x - low_.x);
}

void legend(ImU32 color, const char* text) {
  const float h = ImGui::GetTextLineHeight();
  if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(text).x + h) ImGui::NewLine();
  const ImVec2 p = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(p.x, p.y + 0.4f * h),
                                            ImVec2(p.x + 0.8f * h, p.y + 0.6f * h), color);
  ImGui::Dummy(ImVec2(0.9f * h, h));
  ImGui::SameLine(0, 2);
  ImGui::TextUnformatted(text);
}

double yAt(const Curve& curve, double x) {
  const auto& p = curve.points;
  const auto above = std::lower_bound(
      p.begin(), p.end(), x, [](const glm::dvec2& point, double value) { return point.x < value; });
  if (above == p.end()) return p.back().y;
  if (above == p.begin() || above->x == x) return above->y;
  const glm::dvec2 a = *(above - 1), b = *above;
  return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

void differencePlot(const Curve& chosen, const Curve& exact, double largest,
                    std::initializer_list<double> ticks) {
  if (!(largest > 1e-13)) {  // within double rounding
    ImGui::TextDisabled("the chosen form is the exact one");
    return;
  }
  // Ticks at the largest of 1, 2 and 5 times a power of ten that is not above the largest value.
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
  std::string shortened = text;  // writes 2e-03 as 2e-3
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

}  // namespace glint::viewer
