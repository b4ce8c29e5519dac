#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "glint/options/parameters.h"

namespace glint::viewer::widgets {

/// Sizes in window coordinates, from the content scale.
struct Style {
  float scale = 1.0f;
  float labelWidth = 150.0f;
  bool greek = true;  ///< the font has more than Latin letters
};
Style& style();

/// A label at the left; the next widget fills the rest of the line. With `edited` it is
/// highlighted.
void label(const std::string& text, bool edited = false);

/// The tooltip of what was drawn last.
void tooltip(const std::string& text);

/// Whether what was drawn last was double-clicked, which resets it. Ends the drag that the first
/// click began.
bool doubleClicked();

/// A slider with typed values (Ctrl+click) that may go beyond it, within [min, max]. True if the
/// value changed.
bool slider(const char* id, double& value, const SliderRange& range, double min, double max,
            const char* format = "%.4g");

/// A colour in linear light, shown and edited as sRGB; components above 1 stay as they are until
/// they are edited.
bool color(const char* id, glm::dvec3& linear);

bool vector(const char* id, glm::dvec3& v);

/// A direction as a point of a sphere that is seen from the viewer: the centre points to the
/// viewer, the inner circle to the sides, the outer one away. `axes` has right, up and back of the
/// camera as columns; the direction is in world space and unit after a change.
bool direction(const char* id, glm::dvec3& direction, const glm::dmat3& axes, float size);

/// A form of the lobe: its name, and below it, where it has one, a slider for its gamma. True if it
/// changed.
bool highlightForm(const std::string& name, bool edited, HighlightForms& forms,
                   const std::string& help);

/// The widget for one parameter of a look, by its kind. `shown` is what stands where the look
/// leaves it open. True if the look changed; an error of a typed text is thrown as InputError.
bool parameter(const Parameter& p, Look& look, const std::optional<glm::dvec3>& shown = {});

std::string parameterTooltip(const std::string& help, std::string_view symbol,
                             const std::string& unit, double min, double max);

}  // namespace glint::viewer::widgets
