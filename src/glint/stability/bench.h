#pragma once

#include <optional>
#include <string>
#include <vector>

#include "glint/render/probe.h"
#include "glint/render/renderer.h"
#include "glint/stability/case.h"
#include "glint/stability/program.h"

namespace glint::stability {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double degrees = pi / 180;

/// The relative rounding error of a float.
inline constexpr double rounding = 1.0 / (1 << 24);

/// How far a lobe may be from its form's value for rounded unit vectors. With |D| = sqrt(2 lambda),
/// an error d of D moves lambda by |D| d and the lobe by alpha |D| d exp(-alpha lambda) <= 0.61
/// sqrt(alpha) d. D's components are sums of three terms of at most 2, rounded at each step, of
/// vectors that are themselves off by 1.5e-7 where the shader normalises them: d <= 6.5e-7, which
/// gives 4e-7 sqrt(alpha). The power itself adds 1e-6: 0.37 of the relative error of log1m (6e-7)
/// and two products, and exp2's 3 + 2 |x| ulp (GLSL) times 2^-|x|.
inline double lobeTolerance(double exponent) { return 1e-6 + 4e-7 * std::sqrt(exponent); }

/// m_d I N.L of unit vectors that are off by 1.5e-7 each: three products, two sums.
inline constexpr double diffuseTolerance = 6e-7;

/// The exact form of Fresnel: about 12 roundings in amplitudes, whose squares are halved.
inline constexpr double fresnelTolerance = 1e-6;

/// What the cases run on: the current context, the reference, and the forms under test.
class Bench {
 public:
  /// The forms (`highlight`, `fresnel`, `schlick-exponent`) are taken from the look `forms`.
  /// `setParameter` sets a parameter of a look from its option's text, as the command line does:
  /// some cases test what it refuses.
  using SetParameter = void (*)(Look&, std::string_view name, const std::string& text);
  Bench(const Look& forms, GlslSources sources, SetParameter setParameter);

  /// A look with the forms under test, without ambient light, background and anti-aliasing.
  Look look(Shading shading = Shading::phong) const;

  /// The same with a white directional light.
  Look lit(Shading shading = Shading::phong, const glm::dvec3& toLight = {0, 0, 1}) const;

  /// Takes an option's text as the command line does, so many times.
  void take(std::string_view option, const std::string& text, std::size_t times = 1) const {
    for (Look look; times > 0; --times) setParameter_(look, option, text);
  }

  /// Whether the form claims to be the function itself (exact, pow; exact, textbook): then it is
  /// compared with the function's values, to within rounding. An approximation is compared with its
  /// own formula in double.
  bool lobeIsExact() const { return lobeIsExact_; }
  bool fresnelIsExact() const { return fresnelIsExact_; }

  const GlslSources& sources() const { return sources_; }
  Programs& programs() { return programs_; }

  /// Runs a function of vector.glsl, lobe.glsl or fresnel.glsl, or a custom one that uses them.
  std::vector<float> run(std::string_view function, const std::vector<std::vector<float>>& columns);
  glm::dvec3 runVector(std::string_view function, const std::vector<std::vector<float>>& columns);

  Image draw(const Scene&, const Look&, const DecodedImages& = {});
  Image draw(const Scene&, const Look&, DrawList list);
  Image reference(const Scene&, const Look&, const DecodedImages& = {});

  Renderer& renderer() { return renderer_; }

 private:
  const SetParameter setParameter_;
  Look forms_;
  GlslSources sources_;
  bool lobeIsExact_, fresnelIsExact_;
  Probe functions_;
  Programs programs_;
  Renderer renderer_;
};

/// A pixel's linear red, green and blue; y counts rows from the top.
inline glm::dvec3 at(const Image& image, int x, int y) {
  const float* p = image.row(y) + std::size_t(4) * std::size_t(x);
  return {p[0], p[1], p[2]};
}

inline glm::dvec3 middle(const Image& image) {
  return at(image, image.width / 2, image.height / 2);
}

inline constexpr Shading everyShading[] = {Shading::flat, Shading::gouraud, Shading::phong,
                                           Shading::blinnPhong, Shading::environment};

inline bool isBlinn(Shading s) { return s == Shading::blinnPhong || s == Shading::environment; }

/// Red, so that red minus green is diffuse and green is specular; ior 1, so that the program
/// `environment` reflects nothing.
Material litMaterial(double diffuse, double specular, double exponent);

/// A place on a surface under one directional light: the unit normal, the unit vector to the light,
/// and the position in eye space, whose negative points to the viewer.
struct Geometry {
  glm::vec3 n, l, p;
};

inline Points pointsOf(const std::vector<Geometry>& geometries) {
  Points points;
  for (const Geometry& g : geometries) points.add(g.n, g.p, g.l);
  return points;
}

/// The geometry whose R and V, or N and H (`blinn`), have the cosine c, V's or H's side being
/// towards `side`. The light is turned to the front where it does not shine on it steeply.
Geometry besidePeak(const glm::dvec3& n, const glm::dvec3& light, const glm::dvec3& side, double c,
                    bool blinn);

/// The program `environment` in a white room whose only light is what is reflected.
Look whiteRoom(const Bench& bench, double mediumIor = 1, bool twoSided = false);

/// What shows only its surroundings, a metal or what lets light through.
Material boundary(double ior, double transmission = 0, double metalness = 0,
                  const glm::dvec3& color = glm::dvec3(1));

/// The light that results there: m_d I N.L, and the highlight by Phong and by Blinn-Phong.
struct LightValues {
  double diffuse = 0, phong = 0, blinn = 0;
};

using LightTolerances = LightValues;

/// Checks all five programs on the driver, and the reference, at each geometry: diffuse strength 1,
/// specular strength 1, white light of intensity 1. A form that is not exact is compared with the
/// reference, whose own values are then not checked here. Records the worst finding of each
/// program.
void expectLight(Bench&, Record&, const std::string& what, double exponent,
                 const std::vector<Geometry>& geometries, const std::vector<LightValues>& expected,
                 const LightTolerances& tolerances, Light::Type type = Light::Type::directional);

/// The tolerances for an exponent, for geometries whose half vector is longer than 1/2.
LightTolerances tolerancesFor(double exponent);

/// The diffuse light and the highlights by their formulas in long double, including the gate N.L >
/// 0.
LightValues formulaValues(const glm::dvec3& n, const glm::dvec3& l, const glm::dvec3& v,
                          double exponent);

std::string vectorText(const glm::dvec3&);

/// Takes the text of --material.
void takeMaterial(const std::string& text);

}  // namespace glint::stability
