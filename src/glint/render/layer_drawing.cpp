#include <algorithm>

#include "glint/render/face_mesh.h"
#include "glint/render/renderer.h"

namespace glint {
namespace {

// More layers than a picture can show: the nearest are then left out. Without a limit, a driver
// whose depth test sees other depths than its shaders would never finish.
constexpr int mostLayers = 1024;

// After this many layers, and again after each doubling, the rest is examined: if its triangles can
// be drawn in one order, finding that out takes two passes and drawing one, however many layers
// there are. Most scenes have fewer.
constexpr int firstLook = 4;

GLuint answerOf(GLenum question, const Query& query, const std::function<void()>& draw) {
  glBeginQuery(question, query.id());
  draw();
  glEndQuery(question);
  GLuint answer = 0;
  glGetQueryObjectuiv(query.id(), GL_QUERY_RESULT, &answer);
  return answer;
}

/// The indices with which GpuScene draws a mesh (with `faces`, those for the program `flat`),
/// sorted so that its triangles, lines or points come farthest first by the means of their corners.
/// Those that overlap may still be in the wrong order; the caller must check.
std::vector<std::uint32_t> farthestFirst(const Mesh& mesh, bool faces,
                                         const glm::mat4& eyeFromModel) {
  faces = faces && mesh.topology == Topology::triangles;
  const FaceMesh faceMesh = faces ? makeFaceMesh(mesh) : FaceMesh{};
  const std::vector<std::uint32_t>& indices = faces ? faceMesh.indices : mesh.indices;
  const std::size_t corners = mesh.topology == Topology::triangles ? 3
                              : mesh.topology == Topology::lines   ? 2
                                                                   : 1;
  const glm::vec3 along(eyeFromModel[0].z, eyeFromModel[1].z, eyeFromModel[2].z);
  struct Piece {
    float depth;
    std::uint32_t first;
  };
  std::vector<Piece> pieces;
  pieces.reserve(indices.size() / corners);
  for (std::size_t i = 0; i + corners <= indices.size(); i += corners) {
    float sum = 0;  // of the corners' z; all pieces have as many corners
    for (std::size_t k = 0; k < corners; ++k) {
      const std::uint32_t vertex = indices[i + k];
      const std::uint32_t source =
          faces && !faceMesh.source.empty() ? faceMesh.source[vertex] : vertex;
      sum += glm::dot(along, mesh.positions[source]);
    }
    pieces.push_back({sum, std::uint32_t(i)});
  }
  // The eye looks along -z.
  std::ranges::stable_sort(pieces, {}, &Piece::depth);
  std::vector<std::uint32_t> ordered;
  ordered.reserve(indices.size());
  for (const Piece& piece : pieces)
    ordered.insert(ordered.end(), indices.begin() + piece.first,
                   indices.begin() + piece.first + std::ptrdiff_t(corners));
  return ordered;
}

}  // namespace

void Renderer::setBlending(bool blended) {
  if (blended) {
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  } else {
    glDisable(GL_BLEND);
  }
  glDepthMask(blended ? GL_FALSE : GL_TRUE);
}

bool Renderer::any(const std::function<void()>& draw) {
  return answerOf(GL_ANY_SAMPLES_PASSED, layerQuery_, draw) != 0;
}

GLuint Renderer::samplesPassed(const std::function<void()>& draw) {
  if (!countQuery_) countQuery_ = Query::make();
  return answerOf(GL_SAMPLES_PASSED, countQuery_, draw);
}

// The pixels of the tile that the boxes of the calls from `first` on may cover: x, y, width,
// height. The whole tile if a box reaches behind the eye.
glm::ivec4 Renderer::Picture::pixelsOf(std::size_t first) const {
  const glm::dvec2 size(tilePixels_);
  glm::dvec2 low(1e300), high(-1e300);
  for (std::size_t i = calls_[first].first; i < list_.items.size(); ++i) {
    const DrawItem& item = list_.items[i];
    const glm::dmat4 toClip = glm::dmat4(projection_) * glm::dmat4(item.draw.eyeFromModel);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p(corner & 1 ? item.high.x : item.low.x,
                         corner & 2 ? item.high.y : item.low.y,
                         corner & 4 ? item.high.z : item.low.z);
      const glm::dvec4 clip = toClip * glm::dvec4(p, 1);
      if (!(clip.w > 0)) return {0, 0, tilePixels_};
      const glm::dvec2 place = (glm::dvec2(clip) / clip.w + 1.0) * 0.5 * size;
      low = glm::min(low, place);
      high = glm::max(high, place);
    }
  }
  // Points and lines are a pixel of the picture wide, and all of this is rounded.
  const double extra = 1.0 + layout_.scale;
  const glm::ivec2 begin(glm::clamp(glm::floor(low - extra), glm::dvec2(0), size));
  const glm::ivec2 end(glm::clamp(glm::ceil(high + extra), glm::dvec2(begin), size));
  return {begin, end - begin};
}

void Renderer::Picture::drawLayers(std::size_t first) {
  const DepthLayers* layers = renderer_.layersFor();
  if (!layers) {  // in the list's order, from back to front by their centres
    renderer_.setBlending(true);
    for (std::size_t i = first; i < calls_.size(); ++i) drawCall(i);
    return;
  }
  const bool reversed = renderer_.clipControl_;
  int look = firstLook;
  for (int layer = 0; layer < mostLayers; ++layer) {
    layers->bindDepths(layer, layerDepthUnit);
    renderer_.setBlending(false);
    glDepthFunc(reversed ? GL_LESS : GL_GREATER);
    glClearDepth(reversed ? 1.0 : 0.0);
    glClear(GL_DEPTH_BUFFER_BIT);
    renderer_.layerProgram().use();
    used_ = nullptr;
    if (!renderer_.any([&] { drawDepths(first, false); })) break;
    layers->bindColors(layer);
    renderer_.setBlending(true);
    glDepthFunc(GL_EQUAL);
    for (std::size_t i = first; i < calls_.size(); ++i) drawCall(i);
    if (layer + 1 < look) continue;
    look *= 2;
    if (drawInOrder(*layers, layer, first)) break;
  }
}

// Draws what is nearer than the last layer in the order of its triangles, if that order is back to
// front at every sample: if each of its samples lies in front of all those drawn there before.
bool Renderer::Picture::drawInOrder(const DepthLayers& layers, int last, std::size_t first) {
  const bool reversed = renderer_.clipControl_;
  orderTriangles(first);
  layers.bindDepths(last + 1, layerDepthUnit);
  renderer_.setBlending(false);
  renderer_.layerProgram().use();
  used_ = nullptr;
  glDisable(GL_DEPTH_TEST);
  const GLuint all = renderer_.samplesPassed([&] { drawDepths(first, true); });
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(reversed ? GL_GREATER : GL_LESS);
  glClearDepth(reversed ? 0.0 : 1.0);
  glClear(GL_DEPTH_BUFFER_BIT);
  const GLuint nearer = renderer_.samplesPassed([&] { drawDepths(first, true); });
  if (nearer != all) return false;
  layers.bindColors(last);
  renderer_.setBlending(true);
  for (std::size_t i = first; i < calls_.size(); ++i) drawCall(i, &ordered_[i - first]);
  return true;
}

void Renderer::Picture::orderTriangles(std::size_t first) {
  if (!ordered_.empty()) return;  // one order for all tiles
  for (std::size_t i = first; i < calls_.size(); ++i) {
    const DrawItem& item = list_.items[calls_[i].first];
    const auto indices =
        farthestFirst(scene_.scene().meshes[std::size_t(item.mesh)],
                      item.variant.program == Shading::flat, item.draw.eyeFromModel);
    const Buffer& buffer = ordered_.emplace_back(Buffer::make());
    glBindVertexArray(renderer_.noVertices_.id());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.id());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof indices[0]),
                 indices.data(), GL_STATIC_DRAW);
  }
}

void Renderer::Picture::drawDepths(std::size_t first, bool inOrder) {
  for (std::size_t i = first; i < calls_.size(); ++i) {
    const DrawItem& item = list_.items[calls_[i].first];
    bindDraw(i);
    scene_.draw(item.mesh, item.variant.program == Shading::flat, 1,
                inOrder ? &ordered_[i - first] : nullptr);
  }
}

}  // namespace glint
