#include "presets.h"

#include <algorithm>
#include <cmath>

#include "glint/image/srgb.h"

namespace glint::viewer {
namespace {

// A row of the table: ambient, diffuse and specular, red, green and blue each, the shininess and
// the index of refraction.
struct Row {
  std::string_view name, group;
  double numbers[11];
};

constexpr Row rows[] = {
    {"gold",
     "metals",
     {.24725, .1995, .0745, .75164, .60648, .22648, .628281, .555802, .366065, .4, 1.5}},
    {"silver",
     "metals",
     {.19225, .19225, .19225, .50754, .50754, .50754, .508273, .508273, .508273, .4, 1.5}},
    {"copper",
     "metals",
     {.19125, .0735, .0225, .7038, .27048, .0828, .256777, .137622, .086014, .1, 1.5}},
    {"brass",
     "metals",
     {.329412, .223529, .027451, .780392, .568627, .113725, .992157, .941176, .807843, .21794872,
      1.5}},
    {"bronze",
     "metals",
     {.2125, .1275, .054, .714, .4284, .18144, .393548, .271906, .166721, .2, 1.5}},
    {"chrome", "metals", {.25, .25, .25, .4, .4, .4, .774597, .774597, .774597, .6, 1.5}},
    {"emerald",
     "stones",
     {.0215, .1745, .0215, .07568, .61424, .07568, .633, .727811, .633, .6, 1.58}},
    {"jade", "stones", {.135, .2225, .1575, .54, .89, .63, .316228, .316228, .316228, .1, 1.66}},
    {"obsidian",
     "stones",
     {.05375, .05, .06625, .18275, .17, .22525, .332741, .328634, .346435, .3, 1.49}},
    {"pearl",
     "stones",
     {.25, .20725, .20725, 1, .829, .829, .296648, .296648, .296648, .088, 1.53}},
    {"ruby",
     "stones",
     {.1745, .01175, .01175, .61424, .04136, .04136, .727811, .626959, .626959, .6, 1.77}},
    {"turquoise",
     "stones",
     {.1, .18725, .1745, .396, .74151, .69102, .297254, .30829, .306678, .1, 1.61}},
    {"black plastic", "plastics", {0, 0, 0, .01, .01, .01, .5, .5, .5, .25, 1.49}},
    {"cyan plastic",
     "plastics",
     {0, .1, .06, 0, .50980392, .50980392, .50196078, .50196078, .50196078, .25, 1.49}},
    {"green plastic", "plastics", {0, 0, 0, .1, .35, .1, .45, .55, .45, .25, 1.49}},
    {"red plastic", "plastics", {0, 0, 0, .5, 0, 0, .7, .6, .6, .25, 1.49}},
    {"white plastic", "plastics", {0, 0, 0, .55, .55, .55, .7, .7, .7, .25, 1.49}},
    {"yellow plastic", "plastics", {0, 0, 0, .5, .5, 0, .6, .6, .5, .25, 1.49}},
    {"black rubber", "rubbers", {.02, .02, .02, .01, .01, .01, .4, .4, .4, .078125, 1.52}},
    {"cyan rubber", "rubbers", {0, .05, .05, .4, .5, .5, .04, .7, .7, .078125, 1.52}},
    {"green rubber", "rubbers", {0, .05, 0, .4, .5, .4, .04, .7, .04, .078125, 1.52}},
    {"red rubber", "rubbers", {.05, 0, 0, .5, .4, .4, .7, .04, .04, .078125, 1.52}},
    {"white rubber", "rubbers", {.05, .05, .05, .5, .5, .5, .7, .7, .7, .078125, 1.52}},
    {"yellow rubber", "rubbers", {.05, .05, 0, .5, .5, .4, .7, .7, .04, .078125, 1.52}},
    // Not from the table: clear and matt materials, which it lacks.
    {"glass", "other", {.05, .05, .05, .1, .1, .1, .9, .9, .9, 1, 1.52}},
    {"water", "other", {.03, .05, .06, .06, .1, .12, .8, .8, .8, 1, 1.333}},
    {"diamond", "other", {.05, .05, .05, .1, .1, .1, 1, 1, 1, 1, 2.417}},
    {"chalk", "other", {.9, .9, .88, .93, .93, .91, 0, 0, 0, .01, 1.5}},
    {"clay", "other", {.6, .35, .25, .72, .42, .3, .05, .05, .05, .03, 1.5}},
};

glm::dvec3 toLinear(const glm::dvec3& v) {
  return {srgbLinear(v.r), srgbLinear(v.g), srgbLinear(v.b)};
}

}  // namespace

std::span<const Preset> presets() {
  static const std::vector<Preset> all = [] {
    std::vector<Preset> made;
    for (const auto& [name, group, n] : rows)
      made.push_back({name,
                      group,
                      group != "other",
                      {n[0], n[1], n[2]},
                      {n[3], n[4], n[5]},
                      {n[6], n[7], n[8]},
                      n[9],
                      n[10],
                      group == "metals"});
    return made;
  }();
  return all;
}

ShadingParameters presetParameters(const Preset& preset) {
  const glm::dvec3 C = toLinear(preset.diffuse), a = toLinear(preset.ambient),
                   k = toLinear(preset.specular);
  const double cc = glm::dot(C, C), ck = glm::dot(C, k);
  ShadingParameters p;
  p.color = C;
  p.diffuse = 1;
  p.ambient = cc > 0 ? glm::dot(a, C) / cc : 0;
  p.exponent = 128 * preset.shininess / 4;
  p.ior = preset.ior;
  // k = u C + v (1, 1, 1) with u, v >= 0; m_s = u + v, m_sm = u / m_s.
  double u = 0, v = 0;
  if (preset.metal) {
    u = cc > 0 ? ck / cc : 0;
  } else {
    const double c1 = C.r + C.g + C.b, k1 = k.r + k.g + k.b, det = 3 * cc - c1 * c1;
    if (det > 1e-9 * cc) {
      u = (3 * ck - c1 * k1) / det;
      v = (cc * k1 - c1 * ck) / det;
    }
    if (!(det > 1e-9 * cc) || u < 0) u = 0, v = k1 / 3;
    if (v < 0) v = 0, u = ck / cc;
  }
  p.specular = u + v;
  p.metalness = u + v > 0 ? u / (u + v) : 0;
  const auto tidy = [](double& x) { x = std::round(x * 1e4) / 1e4; };
  for (double* x :
       {&p.ambient, &p.exponent, &p.specular, &p.metalness, &p.color.r, &p.color.g, &p.color.b})
    tidy(*x);
  return p;
}

}  // namespace glint::viewer
