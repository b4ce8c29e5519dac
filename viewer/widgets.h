#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "glint/options/parameters.h"

struct ImVec4;

namespace glint {
struct Scene;
}

namespace glint::viewer::widgets {

/// Sizes in window coordinates, from the content scale.
struct Style {
  float scale = 1.0f;
  float labelWidth = 150.0f;
  float panelLeft = 0.0f;  ///< where the panel begins: tooltips of its rows stand left of it
  bool greek = true;       ///< the font has more than Latin letters
};
Style& style();

/// A colour of the theme for ImGui.
ImVec4 colorOf(const glm::dvec3&);

/// A label at the left; the next widget fills the rest of the line. With `edited` it is
/// highlighted.
void label(const std::string& text, bool edited = false);

/// The tooltip of what was drawn last, or of its label, once the pointer has rested there. It
/// stands beside the panel, where it hides no row.
void tooltip(const std::string& text);
/// Seconds until a tooltip is due; infinite if none is waited for.
double tooltipDue();

/// Whether the row that was drawn last is to be reset: its label was double-clicked, or Backspace
/// pressed where the keyboard's ring is; with `widgetToo` also a double-click on the widget, whose
/// drag ends.
bool resetAsked(bool widgetToo = false);

/// A slider with typed values (Ctrl+click, or Enter at the ring) that may go beyond it, within
/// [min, max]: see readTypedNumber(). True if the value changed.
bool slider(const char* id, double& value, const SliderRange& range, double min, double max,
            const char* format = "%.4g");

/// A number as a text, as wide as the next item: red, with what is expected beside it, while it
/// cannot be taken; Enter does not leave it so, and who clicks elsewhere leaves the value as it
/// was.
bool number(const char* id, double& value, double min, double max);

/// Whether the keyboard's ring is at a number, which Enter begins to type.
bool ringTakesEnter();

/// What was typed and could not be taken since this was asked last; empty if nothing.
std::string takeProblem();

/// A colour in linear light as three numbers, with a square that opens a picker, which shows it as
/// sRGB. "#c04020" may be typed in place of a number.
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
/// leaves it open; `scene`, which may be null, says what a text can be chosen from and what has no
/// effect, which is grey and says why. True if the look changed; an error of a typed text is
/// thrown as InputError.
bool parameter(const Parameter& p, Look& look, const Scene* scene,
               const std::optional<glm::dvec3>& shown = {});

/// `slides`: of a slider, with what can be done there.
std::string parameterTooltip(const std::string& help, std::string_view symbol,
                             const std::string& unit, double min, double max, bool slides = true);

}  // namespace glint::viewer::widgets
