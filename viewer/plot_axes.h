#pragma once

#include <imgui.h>

#include <initializer_list>
#include <optional>
#include <utility>

#include "plots.h"

namespace glint::viewer {

inline constexpr ImU32 exactColor = IM_COL32(240, 190, 80, 255);
inline constexpr ImU32 chosenColor = IM_COL32(90, 170, 255, 255);

/// Axes in a rectangle of the panel.
class Plot {
 public:
  /// `margin` is for the labels at the left, in lines of text.
  Plot(glm::dvec2 low, glm::dvec2 high, float height, float margin = 2.2f);

  ImVec2 at(glm::dvec2 p) const;
  using Lines = std::initializer_list<std::pair<double, const char*>>;
  void grid(Lines xs, Lines ys) const;
  void gridX(double x, const char* text) const;
  void gridY(double y, const char* text) const;
  void markX(double x, ImU32 color) const;
  void curve(const Curve& c, ImU32 color, float width = 1.6f) const;
  /// The mouse's position on the x axis.
  std::optional<double> hovered() const;

 private:
  glm::dvec2 low_, high_;
  ImVec2 begin_, end_;
  ImDrawList* draw_ = nullptr;
  bool hovered_ = false;
};

/// A legend entry with a curve's colour and name, on the next line if there is no room.
void legend(ImU32 color, const char* text);

/// The curve, interpolated between its points.
double yAt(const Curve& curve, double x);

/// What the chosen form adds to the exact one, at most `largest`, on its own scale; `ticks` are
/// those of the x axis.
void differencePlot(const Curve& chosen, const Curve& exact, double largest,
                    std::initializer_list<double> ticks);

}  // namespace glint::viewer
