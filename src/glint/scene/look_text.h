#pragma once

// The texts by which options and look files give values. Every function throws InputError with a
// line that begins with `what`.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glint/scene/look.h"

namespace glint {

double parseNumber(const std::string& text, double min, double max, const std::string& what);
std::int64_t parseInteger(const std::string& text, std::int64_t min, std::int64_t max,
                          const std::string& what);
std::size_t parseChoice(const std::string& text, std::span<const std::string_view> names,
                        const std::string& what);
glm::dvec3 parseVector(const std::string& text, double min, double max, const std::string& what);
/// A linear colour from "r,g,b" (linear, components from 0 to 1e6) or "#rrggbb" (sRGB).
/// `what` begins the message of the InputError.
glm::dvec3 parseColor(const std::string& text, const std::string& what);
glm::dvec2 parseRange(const std::string& text);
glm::dvec4 parseIntrinsics(const std::string& text);
glm::ivec2 parseResolution(const std::string& text);
AntiAliasing parseAntiAliasing(const std::string& text);
std::string antiAliasingText(const AntiAliasing&);
/// "exact", "lyon:8": the form's name and its gamma, if it has one.
std::string highlightText(const HighlightForm&);
/// Forms with the number of lights for each, the brightest first, and last one for all remaining
/// lights: "exact/2,lyon:8".
HighlightForms parseHighlights(const std::string& text, const std::string& what);
std::string highlightText(const HighlightForms&);
/// The texts of all single forms, in order.
std::vector<std::string> highlightTexts();
Shading parseShading(const std::string& text, const std::string& what);
std::string_view shadingName(Shading);
/// All names, in the order of the programs.
std::span<const std::string_view> shadingTexts();
Fresnel parseFresnel(const std::string& text, const std::string& what);
std::string_view fresnelText(Fresnel);
/// All names, in the order of the forms.
std::span<const std::string_view> fresnelTexts();
/// Includes `image`, which cannot be chosen by name.
std::string_view environmentText(Environment);
/// The names that can be chosen, in order.
std::span<const std::string_view> environmentTexts();
/// A light in the syntax of --light, including its fall-off.
Light parseLight(const std::string& text);
std::string lightText(const Light&);
void parseMaterialEdit(Look&, const std::string& text);
/// Sets one parameter of the material `name`, which is a key (material_key.h); `text` is a number,
/// a colour for "color", or a form for "highlight" and "fresnel".
void setMaterialEdit(Look&, const std::string& name, const std::string& key,
                     const std::string& text);

/// The shortest text that reads back as the same double.
std::string numberText(double);

}  // namespace glint
