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
  float panelLeft = 0.0f;  ///< the panel's left edge: tooltips of its rows appear left of it
  bool greek = true;       ///< the font has more than Latin letters
};
Style& style();

/// A colour of the theme for ImGui.
ImVec4 colorOf(const glm::dvec3&);

/// A name from a file as the text of a widget: ImGui hides what follows "##", so blanks go between.
inline std::string shownName(const std::string& name) {
  std::string shown;
  for (const char c : name) {
    if (c == '#' && shown.ends_with('#')) shown += ' ';
    shown += c;
  }
  return shown;
}

/// A label at the left; the next widget fills the rest of the line. With `edited` it is
/// highlighted.
void label(const std::string& text, bool edited = false);

/// The tooltip of the last item, or of its label, once the pointer has rested there. It appears
/// beside the panel, where it hides no row.
void tooltip(const std::string& text);
/// Seconds until a tooltip is due; infinite if none is pending.
double tooltipDue();

/// Whether the user asked to reset the last row: its label was double-clicked, or Backspace was
/// pressed at the keyboard's ring. With `widgetToo`, also if the widget was double-clicked; that
/// ends its drag.
bool resetAsked(bool widgetToo = false);

/// A slider that also accepts typed values (Ctrl+click, or Enter at the ring), which may lie
/// outside its range but within [min, max]: see readTypedNumber(). True if the value changed.
bool slider(const char* id, double& value, const SliderRange& range, double min, double max,
            const char* format = "%.4g");

/// A number field, as wide as the next item. While the text is not valid, it is red and the
/// expected input is shown beside it. Enter does not leave the field then; a click elsewhere
/// restores the old value.
bool number(const char* id, double& value, double min, double max);

/// Whether the keyboard's ring is at a number, where Enter starts typing.
bool ringTakesEnter();

/// The last invalid typed text since the last call; empty if none.
std::string takeProblem();

/// A colour in linear light as three numbers, and a square that opens a picker in sRGB. "#c04020"
/// may be typed instead of a number.
bool color(const char* id, glm::dvec3& linear);

bool vector(const char* id, glm::dvec3& v);

/// A direction as a point on a sphere seen from the viewer: the centre points to the viewer, the
/// inner circle to the sides, the outer one away. `axes` has the camera's right, up and back as
/// columns; the direction is in world space and unit after a change.
bool direction(const char* id, glm::dvec3& direction, const glm::dmat3& axes, float size);

/// A form of the lobe: its name and, if it has one, a slider for its gamma below. True if it
/// changed.
bool highlightForm(const std::string& name, bool edited, HighlightForms& forms,
                   const std::string& help);

/// The widget for a parameter of a look, by its kind. `shown` is the value displayed if the look
/// leaves it open. `scene`, which may be null, determines the choices of a text and which
/// parameters have no effect: those are grey and show why. True if the look changed; an invalid
/// typed text throws InputError.
bool parameter(const Parameter& p, Look& look, const Scene* scene,
               const std::optional<glm::dvec3>& shown = {});

/// `slides`: for a slider, also explains how to use it.
std::string parameterTooltip(const std::string& help, std::string_view symbol,
                             const std::string& unit, double min, double max, bool slides = true);

}  // namespace glint::viewer::widgets
