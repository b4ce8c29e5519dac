// The same picture drawn by the driver and in double precision on the CPU.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "glint/gl/context.h"
#include "glint/gltf/scene_file.h"
#include "glint/image/matchers.h"
#include "glint/reference/renderer.h"
#include "glint/render/renderer.h"

TEST(Teapot, LooksLikeTheReference) {
  glint::Scene scene = glint::loadGltf(MODEL);
  const glint::Bounds bounds = glint::boundsOf(scene);
  glint::Look look;
  look.resolution = {128, 128};
  look.antiAliasing = {glint::AntiAliasing::Mode::none};
  const glint::DecodedImages images = glint::decodeImages(scene, look);
  glint::ReferenceRenderer reference(scene, images, bounds, look);

  const auto context = glint::openContext(glint::Backend::automatic);
  context->makeCurrent();
  glint::Renderer renderer;
  glint::GpuScene uploaded(scene, images);
  // At edges a driver may give a pixel to the neighbour: the mean says more than the maximum.
  EXPECT_THAT(renderer.draw(uploaded, bounds, look),
              glint::LooksLike(reference.draw(), {{"mean", 1e-4}, {"flip", 1e-3}}));
}
