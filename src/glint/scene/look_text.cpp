#include "glint/scene/look_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "glint/image/srgb.h"
#include "glint/scene/material_key.h"
#include "glint/scene/material_parameters.h"
#include "glint/scene/text_parts.h"

namespace glint {

using namespace parts;

namespace {

// The names of a table's rows, in order.
template <typename Row>
std::vector<std::string_view> namesOf(std::span<const Row> rows) {
  std::vector<std::string_view> names;
  for (const Row& each : rows) names.push_back(each.name);
  return names;
}

}  // namespace

std::string numberText(double value) {
  std::array<char, 32> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

double parseNumber(const std::string& text, double min, double max, const std::string& what) {
  double value = 0;
  if (!readAll(text, value) || !(value >= min && value <= max))
    refuse(what, text, "a number " + rangeText(min, max));
  return value;
}

std::int64_t parseInteger(const std::string& text, std::int64_t min, std::int64_t max,
                          const std::string& what) {
  std::int64_t value = 0;
  if (!readAll(text, value) || value < min || value > max)
    refuse(what, text, "a whole number from " + std::to_string(min) + " to " + std::to_string(max));
  return value;
}

std::size_t parseChoice(const std::string& text, std::span<const std::string_view> names,
                        const std::string& what) {
  const auto found = std::find(names.begin(), names.end(), text);
  if (found != names.end()) return std::size_t(found - names.begin());
  std::string expected;
  for (std::size_t i = 0; i < names.size(); ++i)
    expected += (i == 0 ? "one of " : ", ") + std::string(names[i]);
  refuse(what, text, expected);
}

glm::dvec3 parseVector(const std::string& text, double min, double max, const std::string& what) {
  const auto parts = split(text, ',');
  glm::dvec3 v;
  bool good = parts.size() == 3;
  for (int i = 0; good && i < 3; ++i)
    good = readAll(parts[std::size_t(i)], v[i]) && v[i] >= min && v[i] <= max;
  if (!good) refuse(what, text, "three numbers x,y,z " + rangeText(min, max));
  return v;
}

glm::dvec3 parseColor(const std::string& text, const std::string& what) {
  if (text.size() == 7 && text[0] == '#') {
    std::uint32_t code = 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + 7, code, 16);
    if (error == std::errc() && end == text.data() + 7)
      return {decodeSrgb8(std::uint8_t(code >> 16)), decodeSrgb8(std::uint8_t(code >> 8)),
              decodeSrgb8(std::uint8_t(code))};
  }
  const auto parts = split(text, ',');
  glm::dvec3 v;
  bool good = parts.size() == 3;
  for (int i = 0; good && i < 3; ++i)
    good = readAll(parts[std::size_t(i)], v[i]) && v[i] >= 0 && v[i] <= 1e6;
  if (!good) refuse(what, text, "a colour r,g,b (linear, from 0 to 1e6) or #rrggbb");
  return v;
}

glm::dvec2 parseRange(const std::string& text) {
  const auto parts = split(text, ',');
  glm::dvec2 v;
  if (parts.size() != 2 || !readAll(parts[0], v.x) || !readAll(parts[1], v.y) || !(v.x > 0) ||
      !(v.y > v.x) || v.y > 1e30)
    refuse("--clipping-range", text, "NEAR,FAR with 0 < NEAR < FAR");
  return v;
}

glm::dvec4 parseIntrinsics(const std::string& text) {
  constexpr double least = 1e-3, most = 1e7;
  const auto parts = split(text, ',');
  glm::dvec4 v(0.0);
  bool good = parts.size() == 4;
  for (std::size_t i = 0; good && i < 4; ++i)
    good = readAll(parts[i], v[int(i)]) && std::abs(v[int(i)]) <= most &&
           (i > 1 || v[int(i)] >= least);
  if (!good)
    refuse("--camera-intrinsics", text,
           "FX,FY,CX,CY in pixels, FX and FY " + rangeText(least, most) + ", CX and CY " +
               rangeText(-most, most));
  return v;
}

glm::ivec2 parseResolution(const std::string& text) {
  const auto parts = split(text, ',');
  glm::ivec2 v;
  if (parts.size() != 2 || !readAll(parts[0], v.x) || !readAll(parts[1], v.y) || v.x < 1 ||
      v.y < 1 || v.x > 65535 || v.y > 65535)
    refuse("--resolution", text, "W,H with each from 1 to 65535");
  return v;
}

AntiAliasing parseAntiAliasing(const std::string& text) {
  if (text == "none") return {AntiAliasing::Mode::none, 1};
  const auto parts = split(text, ':');
  int n = 0;
  if (parts.size() == 2 && readAll(parts[1], n)) {
    if (parts[0] == "msaa" && n >= 1 && n <= 64) return {AntiAliasing::Mode::msaa, n};
    if (parts[0] == "ssaa" && n >= 1 && n <= 16) return {AntiAliasing::Mode::ssaa, n};
  }
  refuse("--anti-aliasing", text, "none, msaa:N (N from 1 to 64) or ssaa:N (N from 1 to 16)");
}

std::string antiAliasingText(const AntiAliasing& a) {
  if (a.mode == AntiAliasing::Mode::none) return "none";
  return (a.mode == AntiAliasing::Mode::msaa ? "msaa:" : "ssaa:") + std::to_string(a.count);
}

namespace {

HighlightForm parseHighlight(const std::string& name, const std::string& what,
                             const std::string& whole) {
  const auto parts = split(name, ':');
  const auto rows = highlightRows();
  const auto found = std::ranges::find(rows, parts[0], &HighlightRow::name);
  if (found != rows.end()) {
    HighlightForm form(found->form);
    if (!found->hasGamma() && parts.size() == 1) return form;
    const bool number = parts.size() == 2 && readAll(parts[1], form.gamma);
    if (found->hasGamma() && number && form.gamma >= found->leastGamma &&
        form.gamma <= found->mostGamma && (form.gamma & (form.gamma - 1)) == 0)
      return form;
    if (found->hasGamma()) {
      std::string all;
      for (int gamma = found->leastGamma; gamma <= found->mostGamma; gamma *= 2)
        all += (all.empty() ? "" : ", ") + std::to_string(gamma);
      refuse(what, whole,
             parts[0] + ":G with G one of " + all + ", such as " + parts[0] + ":" +
                 std::to_string(8 * found->leastGamma));
    }
  }
  std::string expected;
  for (const HighlightRow& each : rows)
    expected += (expected.empty() ? "one of " : ", ") + std::string(each.name) +
                (each.hasGamma() ? ":G" : "");
  refuse(what, whole, expected);
}

}  // namespace

HighlightForms parseHighlights(const std::string& text, const std::string& what) {
  constexpr const char* list =
      "a list of forms, each with a number of lights, brightest first, and a last one for all "
      "others, such as exact/2,lyon:8 (at most four forms)";
  const auto parts = split(text, ',');
  if (parts.size() > HighlightForms::mostDimmer + 1) refuse(what, text, list);
  HighlightForms forms;
  int lights = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto halves = split(parts[i], '/');
    const HighlightForm form = parseHighlight(halves[0], what, text);
    if (i == 0)
      forms.brightest = form;
    else
      forms.add(form, lights);
    const bool last = i + 1 == parts.size();
    int count = 0;
    if (last ? halves.size() != 1
             : halves.size() != 2 || !readAll(halves[1], count) || count < 1 ||
                   count > int(maxLights))
      refuse(what, text, list);
    lights += count;
  }
  return forms;
}

std::string highlightText(const HighlightForm& form) {
  std::string text(row(form.form).name);
  if (row(form.form).hasGamma()) text += ":" + std::to_string(form.gamma);
  return text;
}

std::string highlightText(const HighlightForms& forms) {
  std::string text = highlightText(forms.brightest);
  int from = 0;
  for (const HighlightForms::Dimmer& each : forms.dimmer) {
    text += "/" + std::to_string(each.from - from) + "," + highlightText(each.form);
    from = each.from;
  }
  return text;
}

std::vector<std::string> highlightTexts() {
  std::vector<std::string> texts;
  for (const HighlightRow& each : highlightRows())
    for (int gamma = each.leastGamma; gamma <= each.mostGamma; gamma = std::max(2 * gamma, 1))
      texts.push_back(highlightText(HighlightForm(each.form, gamma)));
  return texts;
}

Shading parseShading(const std::string& text, const std::string& what) {
  return Shading(parseChoice(text, shadingTexts(), what));
}

std::string_view shadingName(Shading shading) { return row(shading).name; }

std::span<const std::string_view> shadingTexts() {
  static const auto names = namesOf(shadingRows());
  return names;
}

Fresnel parseFresnel(const std::string& text, const std::string& what) {
  return Fresnel(parseChoice(text, fresnelTexts(), what));
}

std::string_view fresnelText(Fresnel form) { return row(form).name; }

std::span<const std::string_view> fresnelTexts() {
  static const auto names = namesOf(fresnelRows());
  return names;
}

namespace {

constexpr std::array<std::string_view, 4> environmentNames{"studio", "sky", "white", "image"};

}  // namespace

std::string_view environmentText(Environment environment) {
  return environmentNames[std::size_t(environment)];
}

std::span<const std::string_view> environmentTexts() {
  return std::span(environmentNames).first(3);
}

void setMaterialEdit(Look& look, const std::string& name, const std::string& key,
                     const std::string& text) {
  const std::string what = "--material " + (name.empty() ? key : name + ":" + key);
  MaterialEdit& edit = look.material[materialKey(name)];
  if (key == "color") {
    edit.color = parseColor(text, what);
    return;
  }
  if (key == "highlight") {
    edit.highlight = parseHighlights(text, what);
    return;
  }
  if (key == "fresnel") {
    edit.fresnel = parseFresnel(text, what);
    return;
  }
  for (const SwitchedTexture& t : switchedTextures()) {
    if (t.name != key) continue;
    const bool on = text == "on" || text == "true";
    if (!on && text != "off" && text != "false") refuse(what, text, "on or off");
    edit.*t.edit = on;
    return;
  }
  std::string known;
  for (const auto& p : materialParameters()) {
    if (p.name == key) {
      edit.*p.edit = parseNumber(text, p.min, p.max, what);
      return;
    }
    known += std::string(p.name) + ", ";
  }
  throw InputError("--material: unknown parameter '" + key + "': use one of " + known +
                   "color, color-texture, normal-texture, emission-texture, highlight, fresnel");
}

void parseMaterialEdit(Look& look, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    refuse("--material", text, "[NAME:]key=value,...");
  const std::size_t colon = endOfMaterialKey(text);
  const std::string name = colon == std::string::npos ? "" : text.substr(0, colon);
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& part :
       split(text.substr(colon == std::string::npos ? 0 : colon + 1), ',')) {
    const std::size_t at = part.find('=');
    if (at != std::string::npos)
      pairs.emplace_back(part.substr(0, at), part.substr(at + 1));
    else if (pairs.empty())
      refuse("--material", text, "[NAME:]key=value,...");
    else
      pairs.back().second += "," + part;
  }
  for (const auto& [key, value] : pairs) setMaterialEdit(look, name, key, value);
}

}  // namespace glint
