#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "glint/reference/shade.h"
#include "glint/render/draw_list.h"
#include "glint/render/glsl_sources.h"
#include "glint/render/probe.h"

namespace glint::stability {

/// Points of a surface as a program's shading gets them: in eye space, and with one direction of
/// the only light per point if `lights` is not empty.
struct Points {
  std::vector<glm::vec3> normals;    ///< as interpolated, of any length
  std::vector<glm::vec3> positions;  ///< the eye is at the origin
  /// Replaces the light's direction (directional, camera) or position (point) in the light's block,
  /// without being normalised. As many as normals, or none.
  std::vector<glm::vec3> lights;
  bool front = true;  ///< the side that is seen

  std::size_t size() const { return normals.size(); }
  void add(const glm::vec3& normal, const glm::vec3& position) {
    normals.push_back(normal);
    positions.push_back(position);
  }
  void add(const glm::vec3& normal, const glm::vec3& position, const glm::vec3& light) {
    add(normal, position);
    lights.push_back(light);
  }
};

/// A program and its inputs, resolved for points in eye space: the draw list of a scene of one
/// small square at the distance 1 in front of the eye.
struct PointScene {
  PointScene(const Look& look, const Material& material);

  Scene scene;
  Look look;
  DrawList list;

  const DrawItem& item() const { return list.items.front(); }
};

/// Runs the whole programs of glsl/ through the probe: each variant's own text, with uniforms and
/// varyings turned into variables that a row of inputs sets. Belongs to the current context.
class Programs {
 public:
  explicit Programs(GlslSources sources) : sources_(std::move(sources)) {}

  /// Radiance of each point, on the driver.
  std::vector<glm::vec3> shade(const PointScene&, const Points&);

  /// The reflectance that the scene's form of Fresnel gives for cosines of incidence, on the
  /// driver; entering through a front face, leaving through a back face. The look's program must be
  /// `environment` and the material a dielectric.
  std::vector<float> reflectance(const PointScene&, const std::vector<float>& cosines,
                                 bool entering);

  /// The probe of a variant, for custom functions: its text contains the whole program, with `void
  /// surfaceMain()` in place of main, and `void setSurface(...)` as shade() uses it.
  Probe& probe(const Variant&);

 private:
  GlslSources sources_;
  std::map<Variant, std::unique_ptr<Probe>> probes_;
};

/// Radiance of each point by the reference, in double.
std::vector<glm::dvec3> referenceShade(const PointScene&, const Points&);

/// As Programs::reflectance, by the reference's formulas.
std::vector<double> referenceReflectance(const PointScene&, const std::vector<float>& cosines,
                                         bool entering);

/// The contents of a scene's uniforms, for custom functions: as parameters, as the call of `void
/// setBlocks(...)` in a program's text, and as columns of one row.
inline constexpr const char* blockArguments =
    "vec3 toViewer, float schlickExponent, vec3 ambient, vec3 right, vec3 up, vec3 back, "
    "MaterialBlock m";
inline constexpr const char* setTheBlocks =
    "  setBlocks(toViewer, schlickExponent, ambient, right, up, back, m);\n";
std::vector<std::vector<float>> blockColumns(const PointScene&);

/// The text of a variant's program as functions of variables: what Programs compiles.
std::string programText(const Variant&, const GlslSources&);

}  // namespace glint::stability
