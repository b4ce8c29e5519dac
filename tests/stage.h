#pragma once

// One context with its renderer at a time, for tests that draw many pictures.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "backend_name.h"
#include "glint/gl/context.h"
#include "glint/render/renderer.h"
#include "scenes.h"

namespace glint::test {

/// A context on a backend, current while the test runs, and a renderer in it.
class Stage {
 public:
  explicit Stage(Backend backend) : context_(openContext(backend)) {
    context_->makeCurrent();
    renderer_.emplace();
  }
  ~Stage() { renderer_.reset(); }

  Context& context() { return *context_; }
  Renderer& renderer() { return *renderer_; }

  Image draw(const Scene& scene, const Look& look) { return drawWith(*renderer_, scene, look); }

  /// With the given shaders.
  Image draw(const GlslSources& sources, const Scene& scene, const Look& look) {
    Renderer renderer(sources);
    return drawWith(renderer, scene, look);
  }

 private:
  static Image drawWith(Renderer& renderer, const Scene& original, const Look& look) {
    Scene scene = original;  // decoding may remove broken textures
    GpuScene gpu(scene, decodeImages(scene, look));
    return renderer.draw(gpu, boundsOf(scene), look);
  }

  std::unique_ptr<Context> context_;
  std::optional<Renderer> renderer_;
};

/// Keeps one stage from test to test; a test that needs another backend replaces it.
class StageKeeper : public testing::Environment {
 public:
  void TearDown() override { stage_.reset(); }
  Stage& enter(Backend backend) {
    if (!stage_ || backend_ != backend) {
      stage_.reset();
      stage_ = std::make_unique<Stage>(backend);
      backend_ = backend;
    } else {
      stage_->context().makeCurrent();
    }
    return *stage_;
  }
  void leave() {
    if (stage_) stage_->context().release();
  }

 private:
  std::unique_ptr<Stage> stage_;
  Backend backend_ = Backend::automatic;
};

inline StageKeeper& stageKeeper() {
  // googletest owns it and destroys the context before drivers are torn down.
  static StageKeeper& keeper =
      *static_cast<StageKeeper*>(testing::AddGlobalTestEnvironment(new StageKeeper));
  return keeper;
}
inline StageKeeper& registeredStageKeeper = stageKeeper();

/// A test with a stage on the backend of its parameter.
class OnStage : public testing::TestWithParam<Backend> {
 protected:
  void SetUp() override { stage_ = &stageKeeper().enter(GetParam()); }
  void TearDown() override { stageKeeper().leave(); }
  Image draw(const Scene& scene, const Look& look) { return stage_->draw(scene, look); }
  Stage& stage() { return *stage_; }

 private:
  Stage* stage_ = nullptr;
};

inline std::string nameOfBackend(const testing::TestParamInfo<Backend>& info) {
  return info.param == Backend::osmesa ? "osmesa" : "egl";
}

inline auto softwareBackends() { return testing::Values(Backend::osmesa, Backend::eglSoftware); }

/// The pixel at column x, row y from the top.
inline glm::dvec4 pixel(const Image& image, int x, int y) {
  const float* p = image.row(y) + std::size_t(4) * x;
  return {p[0], p[1], p[2], p[3]};
}

inline glm::dvec3 color(const Image& image, int x, int y) { return glm::dvec3(pixel(image, x, y)); }

inline glm::dvec3 middle(const Image& image) {
  return color(image, image.width / 2, image.height / 2);
}

inline bool isFinite(const Image& image) {
  for (float x : image.values)
    if (!std::isfinite(x)) return false;
  return true;
}

inline double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

inline double largestDifference(const Image& a, const Image& b) {
  EXPECT_EQ(a.values.size(), b.values.size());
  double most = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double d = std::abs(double(a.values[i]) - b.values[i]);
    most = d <= most ? most : d;  // keeps NaN
  }
  return most;
}

/// The same view, for pictures of attributes: of one program, form and light, so that few variants
/// of it are compiled for many looks.
inline Look geometryLook(Look look) {
  look.shading = Shading::phong;
  look.highlight = {};
  look.light = {directional({0, 0, 1})};
  look.noLights = false;
  return look;
}

/// The number of pixels whose bits differ.
inline std::size_t differingPixels(const Image& a, const Image& b) {
  EXPECT_EQ(a.values.size(), b.values.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i + 3 < a.values.size(); i += 4)
    count += std::memcmp(&a.values[i], &b.values[i], 4 * sizeof(float)) != 0;
  return count;
}

/// Pixels that are not the background's colour, `black` by default.
inline std::size_t coveredPixels(const Image& image, const glm::dvec3& background = glm::dvec3(0)) {
  const glm::vec3 b(background);
  std::size_t count = 0;
  for (std::size_t i = 0; i + 3 < image.values.size(); i += 4)
    count += image.values[i] != b.r || image.values[i + 1] != b.g || image.values[i + 2] != b.b;
  return count;
}

inline void expectColor(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance,
                        const char* what = "") {
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(actual[i], expected[i], tolerance) << what << " [" << i << "]";
}

}  // namespace glint::test
