#include "reference_task.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "glint/image/clock.h"
#include "glint/image/error.h"
#include "glint/reference/raster.h"
#include "glint/reference/renderer.h"

namespace glint::viewer {
namespace {

constexpr int rowsAtOnce = 16;

constexpr double snapped = 1.0 / 128;  // samples: twice the grid of 1/256

// Whether a primitive visible at the next pixel, moved by a snap, would cover the sample at (x, y)
// in front of the surface there.
bool mayCover(const reference::Primitive& next, double x, double y,
              const reference::Attributes& seen) {
  if (next.topology != Topology::triangles) return true;
  for (const glm::dvec3& edge : next.edges)
    if (reference::at(edge, x, y) < -snapped * std::hypot(edge.x, edge.y)) return false;
  return seen.item < 0 || next.footprint(x, y).depth > seen.depth;
}

// Marks the edges of rows y to y + rows - 1. `around` has the attributes of these rows and of one
// more on either side, if it exists, starting at row `from`.
void markEdges(const reference::Stage& stage, const std::vector<reference::Attributes>& around,
               int from, int y, int rows, ReferencePicture& picture) {
  const int width = picture.linear.width;
  const int last = from + int(around.size() / std::size_t(width)) - 1;
  const auto at = [&](int x, int row) -> const reference::Attributes& {
    return around[std::size_t(width) * std::size_t(row - from) + std::size_t(x)];
  };
  // The primitive at each pixel whose edges may be near another pixel's sample.
  std::vector<std::optional<reference::Primitive>> primitives(around.size());
  for (std::size_t i = 0; i < around.size(); ++i) {
    if (around[i].item < 0 || around[i].edgeDistance > 1.5) continue;
    const reference::Item& item = stage.items[std::size_t(around[i].item)];
    primitives[i] =
        reference::makePrimitive(item, stage.vertices[item.vertices], around[i].primitive);
  }
  const auto same = [](const reference::Attributes& a, const reference::Attributes& b) {
    return a.item == b.item && a.primitive == b.primitive;
  };
  for (int row = y; row < y + rows; ++row)
    for (int x = 0; x < width; ++x) {
      const reference::Attributes& seen = at(x, row);
      bool edge = seen.item >= 0 && seen.edgeDistance < snapped;
      for (int dy = -1; dy <= 1 && !edge; ++dy)
        for (int dx = -1; dx <= 1 && !edge; ++dx) {
          if (row + dy < from || row + dy > last || x + dx < 0 || x + dx >= width) continue;
          const reference::Attributes& next = at(x + dx, row + dy);
          const auto& primitive = primitives[std::size_t(&next - around.data())];
          edge = primitive && !same(next, seen) &&
                 mayCover(*primitive, x + 0.5, stage.grid.y - row - 0.5, seen);
        }
      picture.edges[std::size_t(width) * std::size_t(row) + std::size_t(x)] = edge;
    }
}

void draw(const Model& model, ReferencePicture& picture, const std::atomic<bool>& stop,
          const std::function<void()>& progressed) {
  const int threads = std::max(1, int(std::thread::hardware_concurrency()) - 1);
  ReferenceRenderer renderer(model.scene, *model.images, model.bounds, picture.look, threads);
  Image band;
  auto told = Clock::now();
  const int height = picture.linear.height;
  for (int y = 0; y < height && !stop; y += rowsAtOnce) {
    const int rows = std::min(rowsAtOnce, height - y);
    renderer.drawRows(y, rows, band);
    std::ranges::copy(band.values, picture.linear.row(y));
    if (!picture.edges.empty()) {
      const int from = std::max(0, y - 1), end = std::min(height, y + rows + 1);
      markEdges(renderer.stage(), renderer.attributes(from, end - from), from, y, rows, picture);
    }
    picture.rows = y + rows;
    if (progressed && Clock::now() - told > std::chrono::milliseconds(100)) {
      told = Clock::now();
      progressed();
    }
  }
}

}  // namespace

Look exactLook(const Look& look) {
  Look exact = comparableLook(look);
  exact.maxError.reset();
  exact.highlight = Highlight::exact;
  exact.fresnel = Fresnel::exact;
  for (auto& [name, edit] : exact.material) {
    edit.highlight.reset();
    edit.fresnel.reset();
  }
  return exact;
}

Look comparableLook(const Look& look) {
  Look plain = look;
  if (plain.antiAliasing.mode == AntiAliasing::Mode::msaa)
    plain.antiAliasing = {AntiAliasing::Mode::none, 1};
  return plain;
}

ReferenceTask::ReferenceTask(std::function<void()> progressed)
    : progressed_(std::move(progressed)), worker_([] { stepBack(10); }) {}

void ReferenceTask::want(std::shared_ptr<const Model> model, const Look& look) {
  const Look exact = exactLook(look);
  if (picture_ && picture_->look == exact && model == model_) return;
  model_ = std::move(model);
  picture_ = std::make_shared<ReferencePicture>();
  picture_->look = exact;
  const glm::ivec2 size = exact.resolution;
  picture_->linear = {size.x, size.y, {}};
  picture_->linear.values.resize(std::size_t(4) * std::size_t(size.x) * std::size_t(size.y));
  // A supersampled pixel is an average: an edge at one of its samples is not an edge of the pixel.
  if (exact.antiAliasing.mode != AntiAliasing::Mode::ssaa)
    picture_->edges.resize(picture_->linear.values.size() / 4);
  worker_.latest([model = model_, picture = picture_, this](const std::atomic<bool>& stop) {
    try {
      draw(*model, *picture, stop, progressed_);
    } catch (const std::exception& error) {
      picture->error = error.what();
      picture->failed = true;
    }
    if (progressed_ && !stop) progressed_();
  });
}

void ReferenceTask::stop() {
  worker_.stopLatest();
  picture_.reset();
  model_.reset();
}

}  // namespace glint::viewer
