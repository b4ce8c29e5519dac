#include "glint/budget/varying_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "glint/budget/scene_distance.h"
#include "glint/shading/bounds.h"
#include "glint/shading/safe.h"

namespace glint {
namespace {

using rounding::u;

// A corner as the driver gets it: in pixels from the picture's middle, with w of clip space.
struct DrivenCorner {
  glm::dvec2 place{0};
  double w = 1;
  glm::dvec3 eye{0};  // right, up, back
  glm::dvec3 normal{0};
};

// An edge rather than a surface, sides in pixels.
bool isNeedle(double longest, double height) { return height < 1 && height < longest / 8; }

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

class TriangleMeasure {
 public:
  TriangleMeasure(const Camera& camera, glm::ivec2 resolution, const TileLayout& layout)
      : camera_(camera),
        half_(0.5 * layout.scale * glm::dvec2(resolution)),
        pixels_(half_.y / camera.halfHeight),
        reach_(layout.scale * std::hypot(layout.tileWidth, layout.bandHeight)) {}

  DrivenCorner cornerAt(const glm::dvec3& eye, const glm::dvec3& normal) const {
    DrivenCorner c{{}, camera_.orthographic ? 1.0 : -eye.z, eye, normal};
    c.place = pixels_ * glm::dvec2(eye) / c.w;
    return c;
  }

  // Whether all corners lie beyond one side of what the camera sees.
  bool isOutside(const DrivenCorner& a, const DrivenCorner& b, const DrivenCorner& c) const {
    const auto all = [&](auto beyond) { return beyond(a) && beyond(b) && beyond(c); };
    const glm::dvec2 edge = half_ / pixels_;
    if (all([&](const DrivenCorner& each) { return -each.eye.z < camera_.near; })) return true;
    for (int axis = 0; axis < 2; ++axis)
      for (const double side : {-1.0, 1.0})
        if (all([&](const DrivenCorner& each) {
              return side * each.eye[axis] >
                     edge[axis] * (camera_.orthographic ? 1.0 : -each.eye.z);
            }))
          return true;
    return false;
  }

  // `shortest`: of the normals that a triangle's interpolate to.
  void add(const std::array<DrivenCorner, 3>& t, double shortest, bool twoSided, bool mirrored) {
    if (std::ranges::all_of(t, [&](const DrivenCorner& c) { return -c.eye.z >= camera_.near; })) {
      addShown(t[0], t[1], t[2], shortest, twoSided, mirrored);
      return;
    }
    // What lies before the near plane: three or four corners.
    std::vector<DrivenCorner> shown;
    for (std::size_t i = 0; i < 3; ++i) {
      const DrivenCorner &from = t[i], &to = t[(i + 1) % 3];
      const double a = -from.eye.z - camera_.near, b = -to.eye.z - camera_.near;
      if (a >= 0) shown.push_back(from);
      if ((a >= 0) == (b >= 0)) continue;
      const double share = a / (a - b);
      shown.push_back(cornerAt(from.eye + share * (to.eye - from.eye),
                               from.normal + share * (to.normal - from.normal)));
    }
    for (std::size_t i = 2; i < shown.size(); ++i)
      addShown(shown[0], shown[i - 1], shown[i], shortest, twoSided, mirrored);
  }

  VaryingError error;

 private:
  void addShown(const DrivenCorner& a, const DrivenCorner& b, const DrivenCorner& c,
                double shortest, bool twoSided, bool mirrored) {
    const glm::dvec2 ab = b.place - a.place, ac = c.place - a.place, bc = c.place - b.place;
    const double area = cross(ab, ac);  // twice
    if (!(twoSided ? area != 0 : (mirrored ? -area : area) > 0)) return;
    const double side2 = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
    const double side = std::sqrt(side2), height = std::abs(area) / side;
    if (isNeedle(side, height)) return;
    const double most = std::max({a.w, b.w, c.w});
    const double w = most / std::min({a.w, b.w, c.w});
    // q times the largest w, of the normal and of 1.
    const double wa = most / a.w, wb = most / b.w, wc = most / c.w;
    const glm::dvec3 na = wa * a.normal, nab = wb * b.normal - na, nac = wc * c.normal - na;
    const glm::dvec3 nx = (nab * ac.y - nac * ab.y) / area, ny = (nac * ab.x - nab * ac.x) / area;
    const double wx = ((wb - wa) * ac.y - (wc - wa) * ab.y) / area;
    const double wy = ((wc - wa) * ab.x - (wb - wa) * ac.x) / area;
    const double reach = reach_ + side, long_ = side / height;
    const double slope = std::sqrt(glm::dot(nx, nx) + glm::dot(ny, ny));
    const double chord = std::sqrt(
        std::max({glm::dot(nab, nab), glm::dot(nac, nac), glm::dot(nac - nab, nac - nab)}));
    error.normalTurn = std::max(error.normalTurn,
                                u * (8 + 3 * w + 6 * reach * slope + 6 * chord * long_) / shortest);
    // P / w differs by as much as the places in the picture do.
    const double place = (reach * std::hypot(wx, wy) + (w - 1) * long_) +
                         (std::numbers::sqrt2 * reach + side * long_) / pixels_;
    error.place = std::max(error.place, u * (8 + 6 * w + 6 * place));
  }

  const Camera& camera_;
  glm::dvec2 half_;
  double pixels_;  // for a unit at distance 1
  double reach_;
};

// The cofactors, scaled so that none under- or overflows, without the sign of a mirror.
glm::dmat3 normalMatrix(const glm::dmat3& given) {
  double size = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) size = std::max(size, std::abs(given[i][j]));
  const glm::dmat3 m = given * (size > 0 ? 1 / size : 1.0);
  const glm::dmat3 c(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return glm::dot(m[0], c[0]) < 0 ? -1.0 * c : c;
}

}  // namespace

VaryingError varyingError(const Mesh& mesh, const glm::dmat4& world, bool twoSided,
                          const Camera& camera, glm::ivec2 resolution, const TileLayout& layout) {
  TriangleMeasure measure(camera, resolution, layout);
  if (mesh.topology != Topology::triangles || mesh.normals.empty()) return measure.error;
  const glm::dmat3 toEye = glm::transpose(camera.axes) * glm::dmat3(world);
  const glm::dvec3 offset = glm::transpose(camera.axes) *
                            (glm::dmat3(world) * mesh.origin + glm::dvec3(world[3]) - camera.eye);
  const glm::dmat3 toNormals = normalMatrix(glm::dmat3(world));
  std::vector<DrivenCorner> corners;
  corners.reserve(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    corners.push_back(measure.cornerAt(toEye * glm::dvec3(mesh.positions[i]) + offset,
                                       safeNormalize(toNormals * glm::dvec3(mesh.normals[i]))));
  const bool mirrored = glm::determinant(glm::dmat3(world)) < 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const DrivenCorner &a = corners[mesh.indices[i]], &b = corners[mesh.indices[i + 1]],
                       &c = corners[mesh.indices[i + 2]];
    if (measure.isOutside(a, b, c)) continue;
    const glm::dvec3 ab = b.normal - a.normal, ac = c.normal - a.normal;
    const double chord2 =
        std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(ac - ab, ac - ab)});
    // Of unit vectors with chords up to h the mean is as long as sqrt(1 - h^2 / 3) at least. Where
    // they all but cancel the face's stands in (glsl/per_pixel.glsl).
    const double shortest =
        chord2 > 1 ? distanceToTriangle(glm::dvec3(0.0), {a.normal, b.normal, c.normal})
                   : std::sqrt(1 - chord2 / 3);
    measure.add({a, b, c}, std::max(shortest, 1e-3), twoSided, mirrored);
  }
  return measure.error;
}

}  // namespace glint
