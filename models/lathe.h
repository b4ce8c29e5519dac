#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "mesh.h"

namespace glint::models {

/// A line in the half plane of radius (x >= 0) and height (y), made of connected arcs, straight
/// pieces and waves. Its normals point to the left of its direction, with x to the right.
class Profile {
 public:
  struct Point {
    glm::dvec2 position;
    glm::dvec2 normal;
  };

  /// An arc from `from` to `to`, in 360ths of a turn, in `steps` pieces. Clockwise arcs are convex,
  /// with normals that point away from the centre; counter-clockwise ones are concave.
  void arc(glm::dvec2 center, double radius, int from, int to, int steps);
  /// The arc with `waves` grooves of this depth cut into it, smooth at both ends.
  void grooves(glm::dvec2 center, double radius, int from, int to, int waves, double depth);
  void line(glm::dvec2 start, glm::dvec2 end, int steps);
  void lift(double height);

  const std::vector<Point>& points() const { return points_; }

 private:
  void add(const Point& point);

  std::vector<Point> points_;
};

/// The profile rotated about the Y axis; `around` is a multiple of 8. Its outside goes downwards.
Mesh lathe(const Profile& profile, int around);

}  // namespace glint::models
