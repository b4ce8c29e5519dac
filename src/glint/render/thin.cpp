#include "glint/render/thin.h"

#include <glad/gl.h>

#include <algorithm>

namespace glint {

ThinLimits thinLimits() {
  GLfloat points[] = {1, 1}, lines[] = {1, 1};
  GLint flags = 0;
  glGetFloatv(GL_POINT_SIZE_RANGE, points);
  glGetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, lines);
  glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
  // Forward-compatible contexts refuse wider lines, whatever range they announce.
  if (flags & GL_CONTEXT_FLAG_FORWARD_COMPATIBLE_BIT) lines[1] = 1;
  return {points[1], lines[1]};
}

bool hasWideThins(const Scene& scene, const DrawList& list, const TileLayout& layout) {
  return (layout.scale > 1 || layout.samples > 1) &&
         std::ranges::any_of(list.items, [&](const DrawItem& item) {
           return scene.meshes[std::size_t(item.mesh)].topology != Topology::triangles;
         });
}

ThinWidth::ThinWidth(int width) {
  const ThinLimits limits = thinLimits();
  glPointSize(std::min(float(width), limits.point));
  glLineWidth(std::min(float(width), limits.line));
}

ThinWidth::~ThinWidth() {
  glPointSize(1);
  glLineWidth(1);
}

std::string thinWarning(const ThinLimits& limits, int width) {
  const bool points = limits.point < float(width), lines = limits.line < float(width);
  if (!points && !lines) return {};
  const int most = int(points && lines ? std::min(limits.point, limits.line)
                       : points        ? limits.point
                                       : limits.line);
  const std::string what = points && lines ? "points and lines" : points ? "points" : "lines";
  const std::string needed = std::to_string(width);
  return what + " are thinner than one pixel: this driver draws them at most " +
         std::to_string(most) + (most == 1 ? " sample" : " samples") + " wide, and ssaa:" + needed +
         " needs " + needed + ": use --anti-aliasing msaa:4";
}

}  // namespace glint
