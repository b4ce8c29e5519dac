#include "glint/reference/renderer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "glint/image/error.h"
#include "glint/image/task.h"
#include "glint/reference/pixel.h"
#include "glint/reference/raster.h"
#include "glint/reference/samples.h"
#include "glint/shading/safe.h"

namespace glint {
namespace {

using reference::PixelShader;

// Depths that differ by less belong to the same surface, computed from its vertices in another
// order.
constexpr double sameDepth = 1e-12;

constexpr int maxStripSamples = 1 << 16;

int scaleOf(const AntiAliasing& antiAliasing) {
  return antiAliasing.mode == AntiAliasing::Mode::ssaa ? antiAliasing.count : 1;
}

}  // namespace

Look referenceDefaults() {
  Look look;
  look.antiAliasing.mode = AntiAliasing::Mode::none;
  return look;
}

void checkReferenceAntiAliasing(const AntiAliasing& antiAliasing) {
  reference::samplePattern(antiAliasing);
}

ReferenceRenderer::ReferenceRenderer(const Scene& scene, const DecodedImages& images,
                                     const Bounds& bounds, const Look& look, int threads)
    : look_(look),
      scale_(scaleOf(look.antiAliasing)),
      threads_(threadsFor(threads)),
      list_(makeDrawList(scene, bounds, look)),
      stage_(scene, images, list_, look) {
  const int pictureRows = maxStripSamples / (stage_.grid.x * scale_);
  stripRows_ = std::clamp(pictureRows, 1, 16) * scale_;
  sortIntoStrips();
}

void ReferenceRenderer::sortIntoStrips() {
  strips_.resize(stripOf(stage_.grid.y - 1) + 1);
  const double rows = stage_.grid.y;
  for (std::size_t i = 0; i < stage_.items.size(); ++i) {
    const reference::Item& item = stage_.items[i];
    const std::size_t count = reference::primitiveCount(*item.mesh);
    for (std::uint32_t k = 0; k < count; ++k) {
      const auto p = reference::makePrimitive(item, stage_.vertices[item.vertices], k);
      if (!p || !(p->high.x >= -1) || !(p->low.x <= stage_.grid.x + 1)) continue;
      const double top = std::floor(rows - p->high.y) - 1, bottom = rows - p->low.y + 1;
      if (!(bottom >= 0) || !(top < rows)) continue;
      const std::size_t first = stripOf(int(std::max(top, 0.0)));
      const std::size_t last = stripOf(int(std::min(bottom, rows - 1)));
      for (std::size_t s = first; s <= last; ++s) strips_[s].push_back({std::uint32_t(i), k});
    }
  }
}

double ReferenceRenderer::depthAt(const reference::Primitive& p, int column, int row,
                                  const glm::dvec2& sample) const {
  return p.footprint(column + 0.5 + sample.x, stage_.grid.y - row - 0.5 + sample.y).depth;
}

double ReferenceRenderer::alphaAt(const reference::Item& item, const reference::Primitive& p,
                                  int column, int row) const {
  const glm::dvec2 place =
      reference::shadingPlace(p, stage_.samples, column + 0.5, stage_.grid.y - row - 0.5);
  return reference::baseColor(item, p.fragment(column, row, stage_.grid.y, place)).a;
}

void ReferenceRenderer::sampleAt(std::vector<glm::dvec2> samples) {
  stage_.samples = std::move(samples);
}

void ReferenceRenderer::findVisible(int firstRow, int endRow, Strip& strip) const {
  const std::size_t width = std::size_t(stage_.grid.x);
  const std::size_t samples = width * std::size_t(endRow - firstRow);
  strip.depth.assign(samples, 0.0);
  strip.visible.assign(samples, 0);
  const auto& primitives = strips_[stripOf(firstRow)];
  for (std::size_t k = 0; k < primitives.size(); ++k) {
    const reference::Item& item = stage_.items[primitives[k].item];
    if (item.blended) break;  // blended items come last
    const auto p =
        reference::makePrimitive(item, stage_.vertices[item.vertices], primitives[k].primitive);
    if (!p) continue;
    const auto visit = [&](int column, int row) {
      const std::size_t at = width * std::size_t(row - firstRow) + std::size_t(column);
      const double depth = depthAt(*p, column, row, strip.sample);
      if (!(depth > strip.depth[at] * (1 + sameDepth)) || depth > 1) return;
      if (item.mask && alphaAt(item, *p, column, row) < item.alphaCutoff) return;
      strip.depth[at] = depth;
      strip.visible[at] = std::uint32_t(k + 1);
    };
    reference::forEachSample(*p, stage_.grid, firstRow, endRow, strip.sample, visit);
  }
}

glm::dvec4 ReferenceRenderer::background(int column, int row) const {
  if (look_.noBackground) return glm::dvec4(0.0);
  if (!look_.environmentBackground) return {look_.backgroundColor, 1.0};
  const auto ray = [&](int x, int y) {
    return safeNormalize(stage_.ray(x + 0.5, stage_.grid.y - y - 0.5));
  };
  const int below = (stage_.grid.y - 1 - row) % 2 == 0 ? row - 1 : row + 1;
  const glm::dvec3 here = ray(column, row), across = ray(column ^ 1, row),
                   along = ray(column, below), both = ray(column ^ 1, below);
  const double spread = std::max({glm::length(across - here), glm::length(along - here),
                                  glm::length(both - across), glm::length(both - along)});
  return {environmentToward(stage_.frame, here, spread), 1.0};
}

void ReferenceRenderer::drawStrip(int firstRow, int endRow, Strip& strip) const {
  findVisible(firstRow, endRow, strip);
  strip.color.resize(strip.visible.size());
  const auto& primitives = strips_[stripOf(firstRow)];
  PixelShader shader(stage_);
  std::size_t at = 0;
  for (int row = firstRow; row < endRow; ++row)
    for (int column = 0; column < stage_.grid.x; ++column, ++at) {
      if (strip.visible[at] == 0) {
        strip.color[at] = background(column, row);
        continue;
      }
      const Entry& seen = primitives[strip.visible[at] - 1];
      strip.color[at] = shader.fragment(int(seen.item), seen.primitive, column, row);
    }
  blend(firstRow, endRow, strip);
}

void ReferenceRenderer::drawSamples(int firstRow, int endRow, Strip& strip) const {
  strip.sample = glm::dvec2(0.0);
  if (stage_.samples.empty()) return drawStrip(firstRow, endRow, strip);
  std::vector<glm::dvec4> sum;
  for (const glm::dvec2& sample : stage_.samples) {
    strip.sample = sample;
    drawStrip(firstRow, endRow, strip);
    sum.resize(strip.color.size(), glm::dvec4(0.0));
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += strip.color[i];
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    strip.color[i] = sum[i] / double(stage_.samples.size());
}

// Blends exactly: at each sample, everything blended in front of the opaque surface, back to front.
void ReferenceRenderer::blend(int firstRow, int endRow, Strip& strip) const {
  const std::size_t width = std::size_t(stage_.grid.x);
  const auto& primitives = strips_[stripOf(firstRow)];
  auto from = std::find_if(primitives.begin(), primitives.end(),
                           [&](const Entry& r) { return stage_.items[r.item].blended; });
  PixelShader shader(stage_);
  strip.fragments.clear();
  for (; from != primitives.end(); ++from) {
    const reference::Item& item = stage_.items[from->item];
    const auto p = reference::makePrimitive(item, stage_.vertices[item.vertices], from->primitive);
    if (!p) continue;
    const auto visit = [&](int column, int row) {
      const std::size_t at = width * std::size_t(row - firstRow) + std::size_t(column);
      const double depth = depthAt(*p, column, row, strip.sample);
      if (!(depth > strip.depth[at] * (1 + sameDepth)) || depth > 1) return;
      strip.fragments.push_back({at, strip.fragments.size(), depth,
                                 shader.fragment(int(from->item), from->primitive, column, row)});
    };
    reference::forEachSample(*p, stage_.grid, firstRow, endRow, strip.sample, visit);
  }
  std::ranges::sort(strip.fragments, [](const Fragment& a, const Fragment& b) {
    return std::tie(a.at, a.depth, a.number) < std::tie(b.at, b.depth, b.number);
  });
  // Of coinciding surfaces, the last drawn lies on top.
  for (auto first = strip.fragments.begin(); first != strip.fragments.end();) {
    const auto last = std::find_if(first, strip.fragments.end(), [&](const Fragment& f) {
      return f.at != first->at || f.depth > first->depth * (1 + sameDepth);
    });
    std::ranges::sort(first, last, {}, &Fragment::number);
    first = last;
  }
  for (const Fragment& f : strip.fragments) {
    const glm::dvec4& over = f.color;
    strip.color[f.at] =
        glm::dvec4(glm::dvec3(over) * over.a, over.a) + (1 - over.a) * strip.color[f.at];
  }
}

int ReferenceRenderer::bandRows() const {
  return std::min(look_.resolution.y, stripRows_ / scale_ * threads_ * 4);
}

void ReferenceRenderer::drawRows(int y0, int rows, Image& out) {
  out.width = look_.resolution.x;
  out.height = rows;
  out.values.resize(std::size_t(4) * out.width * rows);
  const int first = y0 * scale_, end = (y0 + rows) * scale_;
  const int firstStrip = first / stripRows_, lastStrip = (end - 1) / stripRows_;
  std::vector<Strip> strips(static_cast<std::size_t>(threads_));
  inParallel(threads_, std::size_t(lastStrip - firstStrip + 1), [&](std::size_t n, int thread) {
    const int i = int(n);
    Strip& strip = strips[std::size_t(thread)];
    const int from = std::max(first, (firstStrip + i) * stripRows_);
    const int to = std::min(end, (firstStrip + i + 1) * stripRows_);
    drawSamples(from, to, strip);
    const double share = 1.0 / (double(scale_) * scale_);
    for (int y = from / scale_; y < to / scale_; ++y)
      for (int x = 0; x < out.width; ++x) {
        glm::dvec4 sum(0.0);
        for (int sy = 0; sy < scale_; ++sy) {
          const std::size_t row = std::size_t(y * scale_ + sy - from);
          const std::size_t at = row * std::size_t(stage_.grid.x) + std::size_t(x) * scale_;
          for (int sx = 0; sx < scale_; ++sx) sum += strip.color[at + std::size_t(sx)];
        }
        float* pixel = out.row(y - y0) + std::size_t(4) * x;
        for (int c = 0; c < 4; ++c) pixel[c] = float(sum[c] * share);
      }
    rowsDone_ += (to - from) / scale_;
  });
}

Image ReferenceRenderer::draw() {
  Image image;
  drawRows(0, look_.resolution.y, image);
  return image;
}

std::vector<reference::Attributes> ReferenceRenderer::attributes(int y0, int rows) const {
  const std::size_t width = std::size_t(stage_.grid.x);
  std::vector<reference::Attributes> all(width * std::size_t(rows));
  const int end = y0 + rows, firstStrip = y0 / stripRows_, lastStrip = (end - 1) / stripRows_;
  std::vector<Strip> strips(static_cast<std::size_t>(threads_));
  inParallel(threads_, std::size_t(lastStrip - firstStrip + 1), [&](std::size_t n, int thread) {
    const int i = int(n);
    Strip& strip = strips[std::size_t(thread)];
    const int from = std::max(y0, (firstStrip + i) * stripRows_);
    const int to = std::min(end, (firstStrip + i + 1) * stripRows_);
    findVisible(from, to, strip);
    PixelShader shader(stage_);
    std::size_t at = 0;
    for (int row = from; row < to; ++row)
      for (int column = 0; column < stage_.grid.x; ++column, ++at) {
        if (strip.visible[at] == 0) continue;
        const Entry& seen = strips_[stripOf(from)][strip.visible[at] - 1];
        all[width * std::size_t(row - y0) + std::size_t(column)] =
            shader.attributes(int(seen.item), seen.primitive, column, row);
      }
  });
  return all;
}

reference::Terms ReferenceRenderer::shade(const reference::Attributes& a) const {
  if (a.item < 0) return {};
  return reference::shade(stage_.frame, stage_.items[std::size_t(a.item)].surface, a);
}

}  // namespace glint
