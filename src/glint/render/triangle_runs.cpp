#include "glint/render/triangle_runs.h"

#include <algorithm>
#include <cmath>

#include "glint/image/task.h"

namespace glint {
namespace {

// Longer runs are seldom hidden as a whole; shorter ones cost more to test than they save.
constexpr std::size_t runLength = 256;  // triangles

// Added to the sine of a cone: faces that turn away by less may be drawn.
constexpr double backMargin = 0.02;
constexpr double sideMargin = 4;  // pixels

// Unit; scaled first, since the square of the cross product's length may over- or underflow.
glm::dvec3 faceNormal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double size = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
  return size > 0 ? glm::normalize(n / size) : glm::dvec3(0);
}

TriangleRun makeRun(const Mesh& mesh, std::size_t first, std::size_t count) {
  TriangleRun run{std::uint32_t(first), std::uint32_t(count)};
  run.low = run.high = mesh.positions[mesh.indices[first]];
  glm::dvec3 normals[runLength];
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < count; i += 3) {
    glm::dvec3 corners[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3& p = mesh.positions[mesh.indices[first + i + k]];
      run.low = glm::min(run.low, p);
      run.high = glm::max(run.high, p);
      corners[k] = p;
    }
    normals[i / 3] = faceNormal(corners[0], corners[1], corners[2]);
    sum += normals[i / 3];
  }
  const double length = glm::length(sum);
  if (!(length > 0)) return run;
  const glm::dvec3 axis = sum / length;
  double cosine = 1;
  for (std::size_t i = 0; i < count / 3; ++i)  // a face without area is not drawn
    if (normals[i] != glm::dvec3(0)) cosine = std::min(cosine, glm::dot(normals[i], axis));
  run.axis = axis;
  if (cosine > 0) run.sine = float(std::sqrt(std::max(0.0, 1 - cosine * cosine)));
  return run;
}

}  // namespace

std::vector<TriangleRun> makeTriangleRuns(const Mesh& mesh) {
  const std::size_t indices = mesh.indices.size() / 3 * 3, length = 3 * runLength;
  std::vector<TriangleRun> runs((indices + length - 1) / length);
  constexpr std::size_t together = 64;
  inParallel(0, (runs.size() + together - 1) / together, [&](std::size_t part, int) {
    const std::size_t end = std::min(runs.size(), (part + 1) * together);
    for (std::size_t i = part * together; i < end; ++i)
      runs[i] = makeRun(mesh, i * length, std::min(length, indices - i * length));
  });
  return runs;
}

RunView::RunView(const glm::mat4& projection, const glm::mat4& eyeFromModel, glm::ivec2 pixels,
                 bool cullsBackFaces) {
  const glm::dmat4 toEye(eyeFromModel);
  const glm::dmat4 rows = glm::transpose(glm::dmat4(projection) * toEye);
  const glm::dvec2 share = 1.0 + 2 * sideMargin / glm::dvec2(glm::max(pixels, 1));
  sides_[0] = rows[3] * share.x + rows[0];
  sides_[1] = rows[3] * share.x - rows[0];
  sides_[2] = rows[3] * share.y + rows[1];
  sides_[3] = rows[3] * share.y - rows[1];
  if (!cullsBackFaces) return;
  const bool parallel = projection[2][3] == 0;
  const glm::dvec4 eye =
      glm::inverse(toEye) * (parallel ? glm::dvec4(0, 0, 1, 0) : glm::dvec4(0, 0, 0, 1));
  for (int k = 0; k < 4; ++k)
    if (!std::isfinite(eye[k])) return;
  eye_ = eye;
}

bool RunView::mayShow(const TriangleRun& run) const {
  const glm::dvec3 center = (glm::dvec3(run.low) + glm::dvec3(run.high)) * 0.5;
  const glm::dvec3 half = glm::dvec3(run.high) - center;
  for (const glm::dvec4& side : sides_) {
    const glm::dvec3 normal(side);
    // The corner of the box farthest inside; written so that NaN counts as seen.
    if (glm::dot(normal, center) + side.w + glm::dot(glm::abs(normal), half) < 0) return false;
  }
  if (run.sine > 1) return true;
  const glm::dvec3 away = eye_.w == 0 ? -glm::dvec3(eye_) : center - glm::dvec3(eye_);
  const double radius = eye_.w == 0 ? 0 : glm::length(half);
  const double least = (double(run.sine) + backMargin) * glm::length(away) + radius;
  return !(least > 0 && glm::dot(away, glm::dvec3(run.axis)) > least);
}

void appendShown(const std::vector<TriangleRun>& runs, const RunView& view,
                 std::vector<std::uint32_t>& firsts, std::vector<std::int32_t>& counts) {
  std::uint32_t end = 0;
  bool open = false;
  for (const TriangleRun& run : runs) {
    if (!view.mayShow(run)) {
      open = false;
      continue;
    }
    if (open && run.first == end) {
      counts.back() += std::int32_t(run.count);
    } else {
      firsts.push_back(run.first);
      counts.push_back(std::int32_t(run.count));
    }
    end = run.first + run.count;
    open = true;
  }
}

}  // namespace glint
