#include "glint/render/renderer.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "glint/gl/check.h"
#include "glint/image/clock.h"
#include "glint/image/srgb.h"
#include "glint/render/block_buffer.h"
#include "glint/render/composition.h"
#include "glint/render/thin.h"

namespace glint {
namespace {

constexpr GLuint environmentUnit = 3;
constexpr GLuint parameterUnit = 5;  // and the three after it

enum Binding : GLuint {
  frameBinding,
  lightBinding,
  drawBinding,
  materialBinding,
  curveBinding,
  tableBinding
};

// Each at the place that it is bound to.
constexpr const char* blocks[] = {"FrameBlock",    "LightBlock", "DrawBlock",
                                  "MaterialBlock", "CurveBlock", "LobeTableBlock"};
constexpr const char* samplers[] = {
    "colorTexture",     "emissionTexture", "normalTexture",
    "environmentImage", "behind",          "metallicRoughnessTexture",
    "occlusionTexture", "specularTexture", "transmissionTexture"};

class Stopwatch {
 public:
  explicit Stopwatch(double& milliseconds) : sum_(milliseconds) {}
  ~Stopwatch() { sum_ += since(start_); }

 private:
  double& sum_;
  Clock::time_point start_ = Clock::now();
};

void connect(const Program& program) {
  for (GLuint i = 0; i < std::size(blocks); ++i) program.bindBlock(blocks[i], i);
  for (GLint i = 0; i < GLint(std::size(samplers)); ++i) program.bindSampler(samplers[i], i);
}

// The program of a key, built where there is none yet.
template <typename Kept, typename Compose>
const Program& builtOnce(Kept& kept, const typename Kept::key_type& key, const Compose& compose) {
  if (const auto found = kept.find(key); found != kept.end()) return found->second;
  const ComposedProgram text = compose();
  const ShaderSource sources[] = {{GL_VERTEX_SHADER, text.vertex},
                                  {GL_FRAGMENT_SHADER, text.fragment}};
  Program program(text.name, sources);
  connect(program);
  return kept.emplace(key, std::move(program)).first->second;
}

void setFaces(const DrawItem& item) {
  glFrontFace(item.mirrored ? GL_CW : GL_CCW);
  if (item.faces == FaceSide::both) {
    glDisable(GL_CULL_FACE);
  } else {
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
  }
}

// Writes the mean of each scale x scale block of `from` to `to`, width x height pixels in rows of
// `stride` pixels.
void average(const float* from, int scale, float* to, int width, int height, int stride) {
  const std::size_t across = std::size_t(4) * width * scale;
  const double share = 1.0 / (double(scale) * scale);
  for (int y = 0; y < height; ++y) {
    float* out = to + std::size_t(4) * stride * y;
    for (int x = 0; x < width; ++x) {
      double sum[4] = {0, 0, 0, 0};
      for (int sy = 0; sy < scale; ++sy) {
        const float* in = from + across * std::size_t(y * scale + sy) + std::size_t(4) * x * scale;
        for (int i = 0; i < 4 * scale; ++i) sum[i % 4] += double(in[i]);
      }
      for (int c = 0; c < 4; ++c) out[4 * x + c] = float(sum[c] * share);
    }
  }
}

}  // namespace

Renderer::Renderer(GlslSources sources)
    : sources_(std::move(sources)),
      fileNames_(fileNamesInLines()),
      clipControl_(GLINT_GLAD_GL_ARB_clip_control != 0),
      noVertices_(VertexArray::make()),
      frame_(Buffer::make()),
      thinFrame_(Buffer::make()) {}

const Program& Renderer::programFor(const Variant& variant, bool instanced) {
  return builtOnce(programs_, {variant, instanced}, [&] {
    return compose(variant, sources_, fileNames_, instanced ? int(mostInstances) : 1);
  });
}

const Program& Renderer::backgroundFor(Environment environment) {
  return builtOnce(backgrounds_, environment,
                   [&] { return composeBackground(environment, sources_, fileNames_); });
}

void Renderer::limitPrograms(std::size_t most) {
  if (programs_.size() > most) programs_.clear();
}

void Renderer::setProgramsAside() {
  former_.push_back(
      std::exchange(programs_, {}));  // moving a map leaves its elements where they are
}

RenderTarget& Renderer::targetFor(int width, int height, int samples) {
  if (!target_ || target_->width() < width || target_->height() < height ||
      askedSamples_ != samples) {
    layers_.reset();
    target_.reset();  // first: both at once would double the memory
    target_ = std::make_unique<RenderTarget>(width, height, samples);
    askedSamples_ = samples;
  }
  return *target_;
}

const DepthLayers* Renderer::layersFor() {
  if (!layers_ && (target_->samples() == 1 || canLayerSamples())) {
    layers_ = std::make_unique<DepthLayers>(*target_);
    layerQuery_ = Query::make();
  }
  return layers_.get();
}

const Program& Renderer::layerProgram() {
  const bool multisampled = target_->samples() > 1;
  return builtOnce(layerPrograms_, multisampled,
                   [&] { return composeLayer(multisampled, clipControl_, sources_, fileNames_); });
}

void Renderer::needCurve() {
  if (curve_) return;
  CurveBlock block;
  for (std::size_t i = 0; i < srgbDecoded.size(); ++i)
    block.linearOfCode[i] = glm::vec4(srgbDecoded[i], 0, 0, 0);
  curve_ = Buffer::make();
  fill(curve_, sizeof block, &block, GL_STATIC_DRAW);
}

Renderer::Picture Renderer::begin(GpuScene& scene, DrawList list, const Look& look) {
  return {*this, scene, std::move(list), look};
}

Renderer::Picture::Picture(Renderer& renderer, GpuScene& scene, DrawList list, const Look& look)
    : renderer_(renderer),
      scene_(scene),
      list_(std::move(list)),
      look_(look),
      layout_(tilesFor(look.resolution, look.antiAliasing)),
      lights_(Buffer::make()),
      draws_(Buffer::make()),
      materials_(Buffer::make()),
      calls_(drawCalls(list_.items)),
      wideThins_(hasWideThins(scene.scene(), list_, layout_)) {
  if (wideThins_) scene.warn(thinWarning(thinLimits(), layout_.scale));
  {
    const Stopwatch time(times_.compile);
    for (const DrawCall& call : calls_)
      programs_.push_back(&renderer.programFor(list_.items[call.first].variant, call.count > 1));
    if (look_.environmentBackground) renderer.backgroundFor(environmentOf(look_));
  }
  const Stopwatch time(times_.draw);
  renderer.targetFor(layout_.tileWidth * layout_.scale, layout_.bandHeight * layout_.scale,
                     layout_.samples);
  if (list_.environment) renderer.environment_.upload(list_.environment);
  const auto readsCodes = [](const DrawItem& item) {
    return item.variant.colorTexture || item.variant.emissionTexture;
  };
  if (std::ranges::any_of(list_.items, readsCodes)) renderer.needCurve();
  fill(lights_, list_.lights.size() * sizeof(LightEntry), list_.lights.data(), GL_STREAM_DRAW);
  uploadDraws();
  for (const DrawItem& item : list_.items)
    scene.geometry(item.mesh, item.variant.program == Shading::flat);
  checkGl("upload");
}

void Renderer::Picture::uploadDraws() {
  BlockBuffer draws, materials;
  for (const DrawCall& call : calls_) {
    drawOffsets_.push_back(draws.begin());
    for (std::size_t i = 0; i < call.count; ++i) draws.add(list_.items[call.first + i].draw);
    materialOffsets_.push_back(materials.begin());
    materials.add(list_.items[call.first].materialBlock);
    tableOffsets_.push_back(materials.begin());
    for (const glm::vec4& row : list_.items[call.first].lobeTables) materials.add(row);
  }
  draws.upload(draws_, mostInstances * sizeof(DrawBlock));
  materials.upload(materials_);
}

int Renderer::Picture::samples() const { return renderer_.target_->samples(); }

void Renderer::Picture::drawBand(Image& rows) {
  const auto& band = layout_.bands.at(nextBand_++);
  rows.width = look_.resolution.x;
  rows.height = band.front().height;
  rows.values.resize(std::size_t(4) * rows.width * rows.height);
  for (const Tile& tile : band) drawTile(tile, rows.values.data());
}

Image Renderer::Picture::drawAll() {
  Image image{look_.resolution.x, look_.resolution.y, {}};
  image.values.resize(std::size_t(4) * image.width * image.height);
  for (; nextBand_ < layout_.bands.size(); ++nextBand_)
    for (const Tile& tile : layout_.bands[nextBand_]) drawTile(tile, image.row(tile.y));
  return image;
}

void Renderer::Picture::redraw() {
  for (const auto& band : layout_.bands)
    for (const Tile& tile : band) drawTile(tile, nullptr);
}

void Renderer::Picture::drawTile(const Tile& tile, float* rows) {
  RenderTarget& target = *renderer_.target_;
  const int width = tile.width * layout_.scale, height = tile.height * layout_.scale;
  {
    const Stopwatch time(times_.draw);
    // The tile's corners as shares of the picture, from the lower left.
    const glm::dvec2 whole(look_.resolution);
    const glm::dvec2 lower = glm::dvec2(tile.x, look_.resolution.y - tile.y - tile.height) / whole;
    const glm::dvec2 upper = glm::dvec2(tile.x + tile.width, look_.resolution.y - tile.y) / whole;
    FrameBlock frame = list_.frame;
    const std::vector<glm::vec2> samples = target.samplePositions();
    frame.sampleCount = float(std::min(samples.size(), std::size(frame.samples)));
    for (std::size_t i = 0; i < samples.size() && i < std::size(frame.samples); ++i)
      frame.samples[i] = glm::vec4(samples[i] - 0.5f, 0, 0);
    frame.projection = glm::mat4(projection(list_.camera, lower, upper, renderer_.clipControl_));
    projection_ = frame.projection;
    tilePixels_ = {width, height};
    if (!list_.camera.orthographic) {
      const glm::dvec2 reach =
          glm::dvec2(list_.camera.halfHeight * list_.camera.aspect, list_.camera.halfHeight);
      frame.rayScale = (upper - lower) * reach;
      frame.rayOffset = (upper + lower - 1.0 + list_.camera.shift) * reach;
    }
    std::optional<ThinWidth> thinWidth;
    if (wideThins_) {
      // A pixel more on every side: GL drops points whose middle is outside, and cuts lines there.
      const glm::dvec2 pixel = 1.0 / whole;
      frame.projection =
          glm::mat4(projection(list_.camera, lower - pixel, upper + pixel, renderer_.clipControl_));
      fill(renderer_.thinFrame_, sizeof frame, &frame, GL_STREAM_DRAW);
      frame.projection = projection_;
      thinWidth.emplace(layout_.scale);
    }
    fill(renderer_.frame_, sizeof frame, &frame, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, frameBinding, renderer_.frame_.id());
    inThinFrame_ = false;
    if (!list_.lights.empty()) glBindBufferBase(GL_UNIFORM_BUFFER, lightBinding, lights_.id());
    if (renderer_.curve_) glBindBufferBase(GL_UNIFORM_BUFFER, curveBinding, renderer_.curve_.id());

    target.bind();
    glViewport(0, 0, width, height);
    glEnable(GL_MULTISAMPLE);  // other code in the context (the probe) may have turned it off
    if (renderer_.clipControl_) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(renderer_.clipControl_ ? GL_GREATER : GL_LESS);
    glDepthMask(GL_TRUE);
    glClearDepth(renderer_.clipControl_ ? 0.0 : 1.0);
    const glm::vec3 background(look_.backgroundColor);
    if (look_.noBackground)
      glClearColor(0, 0, 0, 0);
    else
      glClearColor(background.r, background.g, background.b, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);

    if (list_.environment) renderer_.environment_.bind(environmentUnit);
    if (look_.environmentBackground && !look_.noBackground) {
      glDisable(GL_DEPTH_TEST);
      glDisable(GL_BLEND);
      glDisable(GL_CULL_FACE);
      renderer_.backgroundFor(environmentOf(look_)).use();
      glBindVertexArray(renderer_.noVertices_.id());
      glDrawArrays(GL_TRIANGLES, 0, 3);
      glEnable(GL_DEPTH_TEST);
    }
    used_ = nullptr;
    renderer_.setBlending(false);
    std::size_t next = 0;
    for (; next < calls_.size() && !list_.items[calls_[next].first].blended; ++next) drawCall(next);
    if (next < calls_.size()) {
      const glm::ivec4 box = pixelsOf(next);
      glEnable(GL_SCISSOR_TEST);
      glScissor(box.x, box.y, box.z, box.w);
      if (box.z > 0 && box.w > 0) drawLayers(next);
      glDisable(GL_SCISSOR_TEST);
    }
    thinWidth.reset();
    target.resolve();
    if (rows) glFinish();  // read-back would wait anyway; this separates the two times
    checkGl("draw");
  }
  if (!rows) return;
  const Stopwatch time(times_.read);
  float* const to = rows + std::size_t(4) * tile.x;
  if (layout_.scale == 1) {
    target.read(to, width, height, look_.resolution.x);
  } else {
    std::vector<float>& all = renderer_.scratch_;
    all.resize(std::size_t(4) * width * height);
    target.read(all.data(), width, height, width);
    average(all.data(), layout_.scale, to, tile.width, tile.height, look_.resolution.x);
  }
  checkGl("read");
}

void Renderer::Picture::bindDraw(std::size_t i) {
  const DrawCall& call = calls_[i];
  const std::size_t places = call.count > 1 ? mostInstances : 1;
  glBindBufferRange(GL_UNIFORM_BUFFER, drawBinding, draws_.id(), drawOffsets_[i],
                    GLsizeiptr(places * sizeof(DrawBlock)));
  setFaces(list_.items[call.first]);
  const Mesh& mesh = scene_.scene().meshes[std::size_t(list_.items[call.first].mesh)];
  const bool thin = wideThins_ && mesh.topology != Topology::triangles;
  if (thin == inThinFrame_) return;
  inThinFrame_ = thin;
  const Buffer& frame = thin ? renderer_.thinFrame_ : renderer_.frame_;
  glBindBufferBase(GL_UNIFORM_BUFFER, frameBinding, frame.id());
  const int extra = thin ? layout_.scale : 0;
  glViewport(-extra, -extra, tilePixels_.x + 2 * extra, tilePixels_.y + 2 * extra);
}

void Renderer::Picture::drawCall(std::size_t i, const Buffer* indices) {
  const DrawItem& item = list_.items[calls_[i].first];
  const bool isFlat = item.variant.program == Shading::flat;
  // Layers of a blended mesh are found by drawing all of it.
  const bool whole =
      item.blended || calls_[i].count > 1 || scene_.geometry(item.mesh, isFlat).runs.empty();
  const bool culls = item.faces == FaceSide::front;
  if (!whole && !scene_.findShown(item.mesh, isFlat,
                                  {projection_, item.draw.eyeFromModel, tilePixels_, culls}))
    return;
  if (programs_[i] != used_) (used_ = programs_[i])->use();
  bindDraw(i);
  glBindBufferRange(GL_UNIFORM_BUFFER, materialBinding, materials_.id(), materialOffsets_[i],
                    sizeof(MaterialBlock));
  if (!item.lobeTables.empty())
    glBindBufferRange(GL_UNIFORM_BUFFER, tableBinding, materials_.id(), tableOffsets_[i],
                      GLsizeiptr(item.lobeTables.size() * sizeof(glm::vec4)));
  const Material& material = scene_.scene().materials[std::size_t(item.material)];
  if (item.variant.colorTexture) scene_.bindTexture(*material.colorTexture, 0);
  if (item.variant.emissionTexture) scene_.bindTexture(*material.emissionTexture, 1);
  if (item.variant.normalTexture) scene_.bindTexture(*material.normalTexture, 2);
  const bool read[] = {item.variant.metallicRoughnessTexture, item.variant.occlusionTexture,
                       item.variant.specularTexture, item.variant.transmissionTexture};
  if (item.variant.textured != 0) {
    const auto textures = parameterTexturesOf(material);
    for (GLuint k = 0; k < 4; ++k)
      if (read[k]) scene_.bindTexture(**textures[k], parameterUnit + k);
  }
  if (whole)
    scene_.draw(item.mesh, isFlat, calls_[i].count, indices);
  else
    scene_.drawShown(item.mesh, isFlat);
}

Image Renderer::draw(GpuScene& scene, const Bounds& bounds, const Look& look) {
  return draw(scene, makeDrawList(scene.scene(), bounds, look), look);
}

Image Renderer::draw(GpuScene& scene, DrawList list, const Look& look) {
  return begin(scene, std::move(list), look).drawAll();
}

}  // namespace glint
