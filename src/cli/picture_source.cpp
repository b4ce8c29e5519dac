#include "picture_source.h"
#include "glint/image/clock.h"

#include <algorithm>

namespace glint {
namespace {

// The number of samples where anti-aliasing does not depend on the driver.
int samplesOf(const AntiAliasing& antiAliasing, int ofDriver) {
  if (antiAliasing.mode == AntiAliasing::Mode::ssaa) return antiAliasing.count * antiAliasing.count;
  return ofDriver;
}

class GlSource : public PictureSource {
 public:
  GlSource(Renderer& renderer, GpuScene& scene, const Bounds& bounds, const Look& look)
      : look_(look),
        picture_(renderer.begin(scene, makeDrawList(scene.scene(), bounds, look), look)) {}

  glm::ivec2 size() const override { return look_.resolution; }
  bool draw(Image& rows) override {
    if (band_ == picture_.bandCount()) return false;
    picture_.drawBand(rows);
    ++band_;
    return true;
  }
  const DrawList& list() const override { return picture_.list(); }
  RenderTimes times() const override { return picture_.times(); }
  int samples() const override { return samplesOf(look_.antiAliasing, picture_.samples()); }

 private:
  const Look look_;
  Renderer::Picture picture_;
  int band_ = 0;
};

class ReferenceSource : public PictureSource {
 public:
  ReferenceSource(const LoadedModel& model, const Look& look) : look_(look) {
    const auto start = Clock::now();
    renderer_.emplace(model.scene, model.images, model.bounds, look_);
    times_.draw = since(start);
  }

  glm::ivec2 size() const override { return look_.resolution; }
  bool draw(Image& rows) override {
    const int first = renderer_->rowsDone();
    if (first == look_.resolution.y) return false;
    const auto start = Clock::now();
    renderer_->drawRows(first, std::min(renderer_->bandRows(), look_.resolution.y - first), rows);
    times_.draw += since(start);
    return true;
  }
  const DrawList& list() const override { return renderer_->list(); }
  RenderTimes times() const override { return times_; }
  int samples() const override {
    const bool msaa = look_.antiAliasing.mode == AntiAliasing::Mode::msaa;
    return samplesOf(look_.antiAliasing, msaa ? look_.antiAliasing.count : 1);
  }

 private:
  const Look look_;
  std::optional<ReferenceRenderer> renderer_;
  RenderTimes times_;
};

}  // namespace

Stage::Stage(Renderer* renderer, LoadedModel& model) : renderer_(renderer), model_(model) {
  if (!renderer_) return;
  if (model_.file)  // more stages will be made of this model
    scene_.emplace(model_.scene, model_.images);
  else
    scene_.emplace(model_.scene, std::move(model_.images));
}

std::unique_ptr<PictureSource> Stage::picture(const Look& look) {
  if (renderer_) return std::make_unique<GlSource>(*renderer_, *scene_, model_.bounds, look);
  return std::make_unique<ReferenceSource>(model_, look);
}

Image Stage::term(const Look& look, const PictureTerm& term) {
  if (renderer_) return drawTerm(*renderer_, *scene_, model_.bounds, look, term);
  return drawReferenceTerm(model_.scene, model_.images, model_.bounds, look, term);
}

}  // namespace glint
