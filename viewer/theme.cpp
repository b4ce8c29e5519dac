#include "theme.h"

#include <algorithm>
#include <cmath>

namespace glint::viewer {
namespace {

// WCAG 2.1, "relative luminance"; its threshold is from an older draft of sRGB.
double luminanceOf(const glm::dvec3& srgb) {
  const auto linear = [](double x) {
    return x <= 0.03928 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(srgb.r) + 0.7152 * linear(srgb.g) + 0.0722 * linear(srgb.b);
}

}  // namespace

std::span<const ThemePair> themePairs() {
  using namespace theme;
  static constexpr ThemePair pairs[] = {
      {"rows", text, window},
      {"dim rows", dim, window},
      {"edited names", edited, window},
      {"errors in the status line", error, window},
      {"forms chosen", key, window},
      {"the material under the pointer in its list", hovered, frame},
      {"popups", text, popup},
      {"dim text in popups and keys in the palette", dim, popup},
      {"keys in the help", key, window},
      {"errors of what is typed", error, popup},
      {"fields", text, frame},
      {"hints in fields", dim, frame},
      {"fields under the pointer", text, frameHovered},
      {"fields being dragged", text, frameActive},
      {"a field that cannot be taken", text, wrongFrame},
      {"buttons", text, button},
      {"buttons under the pointer", text, buttonHovered},
      {"pressed buttons and the tab shown", text, accent},
      {"tabs under the pointer", text, bright},
      {"headers and the selected material", text, header},
      {"keys of the selected entry of the palette", dim, header},
      {"headers under the pointer", text, headerHovered},
      {"the menu bar", text, menu}};
  return pairs;
}

double contrast(const glm::dvec3& a, const glm::dvec3& b) {
  const double la = luminanceOf(a), lb = luminanceOf(b);
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

}  // namespace glint::viewer
