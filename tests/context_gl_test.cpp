// Contexts, programs and render targets on each software backend.

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

#include "backend_name.h"
#include "glint/gl/check.h"
#include "glint/gl/context.h"
#include "glint/gl/framebuffer.h"
#include "glint/gl/program.h"
#include "glint/gl/queue_limit.h"
#include "glint/image/error.h"

using testing::AllOf;
using testing::HasSubstr;

namespace glint::context_gl_test {

TEST(NoContext, IsAnErrorInWords) {
  const auto open = [] { return glint::RenderTarget(8, 8, 1); };
  const auto link = [] { return glint::Program("none", {}); };
  // Before any context exists, after one has died, and while one is released.
  for (int round = 0; round < 2; ++round) {
    EXPECT_THAT(open, testing::ThrowsMessage<glint::Error>(HasSubstr("no OpenGL context")));
    EXPECT_THAT(link, testing::ThrowsMessage<glint::Error>(HasSubstr("no OpenGL context")));
    const auto context = glint::openContext(Backend::osmesa);
    context->makeCurrent();
    EXPECT_NO_THROW(open());
  }
}

constexpr int width = 37, height = 23;

constexpr const char* vertexText = R"(#version 330 core
layout(location = 0) in vec2 position;
out vec3 color;
void main() {
  gl_Position = vec4(position, 0.25, 1);
  color = vec3(position * 0.5 + 0.5, 7.0);
}
)";
constexpr const char* fragmentText = R"(#version 330 core
layout(std140) uniform Scale { vec4 scale; };
uniform sampler2D map;
in vec3 color;
layout(location = 0) out vec4 result;
void main() { result = scale * vec4(color * color, texture(map, vec2(0.5)).r); }
)";

/// A triangle with interpolated colours on a dark background; rows from the bottom.
std::vector<float> drawTriangle(int samples) {
  const glint::ShaderSource sources[] = {{GL_VERTEX_SHADER, vertexText},
                                         {GL_FRAGMENT_SHADER, fragmentText}};
  const glint::Program program("triangle", sources);
  EXPECT_TRUE(program.bindBlock("Scale", 3));
  EXPECT_FALSE(program.bindBlock("Nothing", 3));
  EXPECT_TRUE(program.bindSampler("map", 2));
  EXPECT_FALSE(program.bindSampler("nothing", 2));
  EXPECT_EQ(program.uniform("nothing"), -1);

  const glint::TextureHandle texture = glint::TextureHandle::make();
  glActiveTexture(GL_TEXTURE2);
  glBindTexture(GL_TEXTURE_2D, texture.id());
  const float half = 0.5f;
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, 1, 1, 0, GL_RED, GL_FLOAT, &half);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);

  const glint::Buffer block = glint::Buffer::make(), vertices = glint::Buffer::make();
  const float scale[] = {1.0f, 0.1f, 3.0f, 2.0f};
  glBindBufferBase(GL_UNIFORM_BUFFER, 3, block.id());
  glBufferData(GL_UNIFORM_BUFFER, sizeof scale, scale, GL_STATIC_DRAW);
  const glint::VertexArray array = glint::VertexArray::make();
  glBindVertexArray(array.id());
  const float corners[] = {-0.9f, -0.8f, 0.95f, -0.3f, 0.1f, 0.9f};
  glBindBuffer(GL_ARRAY_BUFFER, vertices.id());
  glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);

  const glint::RenderTarget target(width, height, samples);
  EXPECT_GE(target.samples(), samples);
  glClearColor(0.01f, 0.02f, 0.03f, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  program.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  target.resolve();
  std::vector<float> pixels(4 * width * height);
  target.read(pixels.data(), width, height, width);
  glint::checkGl("the triangle");
  return pixels;
}

template <class Call>
std::string message(Call call) {
  try {
    call();
  } catch (const glint::Error& error) {
    return error.what();
  }
  return "no error";
}

std::vector<float> drawOn(Backend backend, int samples) {
  const auto context = glint::openContext(backend);
  context->makeCurrent();
  return drawTriangle(samples);
}

class OnBackend : public testing::TestWithParam<Backend> {
 protected:
  void SetUp() override {
    context_ = glint::openContext(GetParam());
    context_->makeCurrent();
  }
  std::unique_ptr<glint::Context> context_;
};

TEST_P(OnBackend, IsSoftwareOfAtLeast33) {
  const glint::GlStrings gl = glint::glStrings();
  EXPECT_THAT(gl.renderer, HasSubstr("llvmpipe"));
  EXPECT_FALSE(gl.vendor.empty());
  EXPECT_GE(gl.version, "3.3");
  EXPECT_EQ(context_->backend(), GetParam());
  EXPECT_FALSE(context_->description().empty());
}

TEST_P(OnBackend, DrawsWhatTheFormulaSays) {
  for (int samples : {1, 4}) {
    const std::vector<float> pixels = drawTriangle(samples);
    const auto at = [&](int x, int y) { return &pixels[4 * ((height - 1 - y) * width + x)]; };
    // Row 0 is the bottom one, where the triangle's base is; its tip is at the top.
    EXPECT_FLOAT_EQ(at(0, height - 1)[0], 0.01f);
    const int x = 18, y = 9;
    const double u = (x + 0.5) / width, v = (y + 0.5) / height;
    // A colour of magnitude 7 squared and scaled keeps a few ulps of float (6e-8 each), and the
    // interpolation's plane equation adds as many. With all 4 samples inside the triangle the
    // colour is still that of the centre.
    const double tolerance = 32 * 6e-8;
    EXPECT_NEAR(at(x, y)[0], u * u, tolerance * u * u);
    EXPECT_NEAR(at(x, y)[1], 0.1 * v * v, tolerance * 0.1 * v * v);
    EXPECT_NEAR(at(x, y)[2], 147, tolerance * 147);  // no clamping to 1
    EXPECT_EQ(at(x, y)[3], 1.0f);
    for (float value : pixels) ASSERT_TRUE(std::isfinite(value));
  }
}

TEST_P(OnBackend, FourSamplesSmoothTheEdge) {
  EXPECT_NE(drawTriangle(1), drawTriangle(4));
  EXPECT_EQ(drawTriangle(4), drawTriangle(2));  // llvmpipe gives 4 for 2
}

TEST_P(OnBackend, ReadsAPartFromTheTop) {
  const glint::RenderTarget target(5, 4, 1);
  glEnable(GL_SCISSOR_TEST);
  for (int y = 0; y < 4; ++y) {
    glScissor(0, y, 5, 1);
    glClearColor(float(y), 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  glDisable(GL_SCISSOR_TEST);
  const int drivers = GLINT_GLAD_GL_MESA_pack_invert;
  for (const int turns : {drivers, 0}) {  // 0: as on drivers that cannot flip rows
    GLINT_GLAD_GL_MESA_pack_invert = turns;
    std::vector<float> rows(4 * 7 * 3, -1.0f);
    target.read(rows.data(), 4, 3, 7);  // rows 2, 1, 0; three pixels after each stay unchanged
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 7; ++x)
        EXPECT_EQ(rows[std::size_t(4 * (7 * y + x))], x < 4 ? float(2 - y) : -1.0f)
            << x << "," << y;
  }
  GLINT_GLAD_GL_MESA_pack_invert = drivers;
}

TEST_P(OnBackend, QueueIsLeftForWholeTriangles) {
  glint::QueueLimit queue;
  const std::size_t most = queue.room();
  for (const std::size_t indices : {std::size_t(1), std::size_t(100), std::size_t(2), most - 1}) {
    queue.drawn(indices);
    EXPECT_GT(queue.room(), 0u);
    EXPECT_EQ(queue.room() % 3, 0u) << indices;
  }
  EXPECT_EQ(queue.room(), most);  // the batch was full, and another one began
  glint::checkGl("waiting");
}

TEST_P(OnBackend, RefusesMoreSamplesThanTheDriverHas) {
  const int most = glint::maxSamples();
  EXPECT_EQ(most, 4);
  EXPECT_EQ(
      message([] { glint::RenderTarget target(8, 8, 8); }),
      "--anti-aliasing msaa:8: this driver has at most 4 samples: use --anti-aliasing ssaa:3");
  EXPECT_THROW(glint::RenderTarget(8, 8, 16), glint::InputError);
  EXPECT_THROW(glint::RenderTarget(8, 8, 0), glint::InputError);
  glint::checkGl("asking for samples");
}

TEST_P(OnBackend, RefusesSizesTheDriverLacks) {
  EXPECT_THAT(message([] { glint::RenderTarget target(1 << 20, 8, 1); }),
              AllOf(HasSubstr("--resolution 1048576,8"), HasSubstr("pixels per side")));
  EXPECT_THROW(glint::RenderTarget(0, 8, 1), glint::InputError);
}

TEST_P(OnBackend, CompilerErrorsKeepFileAndLine) {
  std::string text = "#version 330 core\n";
  if (glint::fileNamesInLines()) {
    text += "#extension GL_ARB_shading_language_include : enable\n#line 41 \"lobes.glsl\"\n";
  } else {
    text += "#line 41 7\n";
  }
  text += "float f() { return undeclared; }\nvoid main() {}\n";
  const glint::ShaderSource sources[] = {{GL_VERTEX_SHADER, vertexText},
                                         {GL_FRAGMENT_SHADER, text}};
  const std::string error = message([&] { glint::Program("phong", sources); });
  EXPECT_THAT(error, AllOf(testing::StartsWith("phong: fragment shader does not compile:\n"),
                           HasSubstr("undeclared"), HasSubstr("41")));
  if (glint::fileNamesInLines()) {
    EXPECT_THAT(error, HasSubstr("lobes.glsl"));
  }
}

TEST_P(OnBackend, LinkErrorsAreThrown) {
  const glint::ShaderSource sources[] = {{GL_VERTEX_SHADER, vertexText},
                                         {GL_FRAGMENT_SHADER,
                                          "#version 330 core\nin vec4 color;\nout vec4 result;\n"
                                          "void main() { result = color; }\n"}};
  EXPECT_THAT(message([&] { glint::Program("odd", sources); }),
              AllOf(HasSubstr("odd: the stages do not link:\n"), HasSubstr("color")));
}

TEST_P(OnBackend, GlErrorsAreInWords) {
  glEnable(0x1234);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 99);
  EXPECT_THAT(message([] { glint::checkGl("testing"); }),
              AllOf(testing::StartsWith("testing: "), HasSubstr("GL_INVALID_ENUM")));
  EXPECT_EQ(message([] { glint::checkGl("testing"); }), "no error");
}

TEST_P(OnBackend, HandlesMove) {
  glint::Buffer one = glint::Buffer::make();
  const GLuint id = one.id();
  glBindBuffer(GL_ARRAY_BUFFER, id);
  glint::Buffer two = std::move(one);
  EXPECT_FALSE(one);
  EXPECT_EQ(two.id(), id);
  EXPECT_TRUE(glIsBuffer(id));
  two = glint::Buffer();
  EXPECT_FALSE(glIsBuffer(id));
  glint::RenderTarget target(4, 4, 4);
  target = glint::RenderTarget(6, 6, 1);
  EXPECT_EQ(target.width(), 6);
  target.bind();
  EXPECT_EQ(glCheckFramebufferStatus(GL_FRAMEBUFFER), GLenum(GL_FRAMEBUFFER_COMPLETE));
}

TEST_P(OnBackend, MovesToAnotherThread) {
  context_->release();
  std::thread([&] {
    context_->makeCurrent();
    EXPECT_EQ(drawTriangle(1).size(), std::size_t(4 * width * height));
    context_->release();
  }).join();
  context_->makeCurrent();
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

INSTANTIATE_TEST_SUITE_P(Software, OnBackend,
                         testing::Values(Backend::osmesa, Backend::eglSoftware),
                         [](const auto& test) {
                           return test.param == Backend::osmesa ? "osmesa" : "egl";
                         });

TEST(Contexts, GiveTheSameBitsOnBothBackends) {
  for (int samples : {1, 4}) {
    const std::vector<float> osmesa = drawOn(Backend::osmesa, samples);
    const std::vector<float> egl = drawOn(Backend::eglSoftware, samples);
    EXPECT_EQ(std::memcmp(osmesa.data(), egl.data(), osmesa.size() * sizeof(float)), 0);
    EXPECT_EQ(drawOn(Backend::osmesa, samples), osmesa);
  }
}

TEST(Contexts, OpenOnAnotherThreadThanTheyAreUsedOn) {
  for (Backend backend : {Backend::osmesa, Backend::eglSoftware, Backend::automatic}) {
    auto opening = glint::openContextAsync(backend);
    const auto context = opening.get();
    context->makeCurrent();
    EXPECT_EQ(drawTriangle(1).size(), std::size_t(4 * width * height));
  }
}

TEST(Contexts, ProbeReportsEachBackend) {
  const auto reports = glint::probeBackends();
  ASSERT_EQ(reports.size(), 3u);
  for (const glint::BackendReport& report : reports) {
    EXPECT_TRUE(report.works) << report.detail;
    EXPECT_THAT(report.detail, HasSubstr("OpenGL 4"));
  }
}

}  // namespace glint::context_gl_test
