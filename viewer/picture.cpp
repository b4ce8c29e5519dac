#include "picture.h"

#include <cmath>

#include "glint/gl/check.h"
#include "glint/gltf/model_hash.h"
#include "glint/image/clock.h"
#include "glint/image/picture_writer.h"
#include "glint/image/srgb.h"
#include "glint/options/picture_text.h"

namespace glint::viewer {

std::optional<DrawnPicture> drawPicture(Renderer& renderer, GpuScene& scene, const Bounds& bounds,
                                        const Look& look, const std::atomic<bool>& stop) {
  const auto start = Clock::now();
  auto picture = renderer.begin(scene, makeDrawList(scene.scene(), bounds, look), look);
  DrawnPicture drawn;
  drawn.asked = drawn.look = look;
  const std::size_t pixels = std::size_t(look.resolution.x) * std::size_t(look.resolution.y);
  drawn.linear = {look.resolution.x, look.resolution.y, {}};
  drawn.linear.values.reserve(4 * pixels);
  drawn.codes.resize(4 * pixels);
  const float scale = float(std::exp2(look.exposure));
  Image band;
  std::vector<std::uint8_t> rgb;
  std::size_t done = 0;
  for (int i = 0; i < picture.bandCount(); ++i) {
    if (stop) return {};
    picture.drawBand(band);
    const std::size_t count = std::size_t(band.width) * std::size_t(band.height);
    std::uint8_t* out = drawn.codes.data() + 4 * done;
    if (look.noBackground) {
      drawn.notNumbers += encodeSrgb8(band.values.data(), count, scale, out);
    } else {
      rgb.resize(3 * count);
      drawn.notNumbers += encodeSrgb8Opaque(band.values.data(), count, scale, rgb.data());
      for (std::size_t p = 0; p < count; ++p) {
        for (std::size_t c = 0; c < 3; ++c) out[4 * p + c] = rgb[3 * p + c];
        out[4 * p + 3] = 255;
      }
    }
    drawn.linear.values.insert(drawn.linear.values.end(), band.values.begin(), band.values.end());
    done += count;
  }
  drawn.list = picture.list();
  drawn.samples = picture.samples();
  drawn.times = picture.times();
  drawn.milliseconds = since(start);
  return drawn;
}

void writePicture(Renderer& renderer, GpuScene& scene, const Bounds& bounds, const Look& asked,
                  const std::string& model, const std::string& path) {
  const Look look = resolveLook(scene.scene(), bounds, asked).look;
  PictureOptions options;
  options.text = pictureText(look, asked, {modelHash(model), glStrings(), 8, {}});
  options.alpha = look.noBackground;
  options.exposureScale = float(std::exp2(look.exposure));
  auto picture = renderer.begin(scene, makeDrawList(scene.scene(), bounds, look), look);
  const auto writer = openPictureWriter(path, look.resolution.x, look.resolution.y, options);
  Image band;
  for (int i = 0; i < picture.bandCount(); ++i) {
    picture.drawBand(band);
    writer->write(band);
  }
  writer->finish();
}

namespace {

constexpr const char* vertexText = R"(#version 330 core
uniform vec2 extent;
out vec2 texel;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0;
  texel = vec2(corner.x, 1.0 - corner.y) * extent;
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
)";

constexpr const char* fragmentText = R"(#version 330 core
uniform sampler2D picture;
in vec2 texel;
out vec4 color;
void main() {
  ivec2 last = textureSize(picture, 0) - 1;
  color = vec4(texelFetch(picture, clamp(ivec2(texel), ivec2(0), last), 0).rgb, 1.0);
}
)";

}  // namespace

Screen::Screen() : texture_(TextureHandle::make()), noVertices_(VertexArray::make()) {
  const ShaderSource sources[] = {{GL_VERTEX_SHADER, vertexText},
                                  {GL_FRAGMENT_SHADER, fragmentText}};
  program_ = Program("screen", sources);
  program_.bindSampler("picture", 0);
}

void Screen::upload(const std::uint8_t* rgba, int width, int height) {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture_.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (width != width_ || height != height_) {
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  } else {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
  }
  width_ = width;
  height_ = height;
  checkGl("upload of the picture");
}

void Screen::show(int x, int y, int width, int height, int framebufferHeight) const {
  if (width_ == 0) return;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(x, framebufferHeight - y - height, width, height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture_.id());
  glBindSampler(0, 0);
  program_.use();
  glUniform2f(program_.uniform("extent"), float(width_), float(height_));
  glBindVertexArray(noVertices_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace glint::viewer
