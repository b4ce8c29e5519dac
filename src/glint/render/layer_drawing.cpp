#include "glint/render/renderer.h"
#include "glint/render/triangle_order.h"

namespace glint {
namespace {

// More layers than a picture can show: the nearest are then left out. Without a limit, a driver
// whose depth test sees other depths than its shaders would never finish.
constexpr int mostLayers = 1024;

// After this many layers, and again after each doubling, the rest is examined: if its triangles can
// be drawn in one order, finding that out takes two passes and drawing one, however many layers
// there are. Most scenes have fewer.
constexpr int firstLook = 4;

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
  glBeginQuery(GL_ANY_SAMPLES_PASSED, layerQuery_.id());
  draw();
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  GLuint found = 0;
  glGetQueryObjectuiv(layerQuery_.id(), GL_QUERY_RESULT, &found);
  return found != 0;
}

GLuint Renderer::samplesPassed(const std::function<void()>& draw) {
  if (!countQuery_) countQuery_ = Query::make();
  glBeginQuery(GL_SAMPLES_PASSED, countQuery_.id());
  draw();
  glEndQuery(GL_SAMPLES_PASSED);
  GLuint count = 0;
  glGetQueryObjectuiv(countQuery_.id(), GL_QUERY_RESULT, &count);
  return count;
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
