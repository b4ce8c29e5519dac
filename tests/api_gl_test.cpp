// The small interface of glint/glint.h and glint/compare.h: the program's pictures, layers, models
// from memory and arrays, errors, threads, fork, and memory over many sessions.

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <functional>
#include <glm/glm.hpp>
#include <thread>

#include "api_memory.h"
#include "command.h"
#include "glint/compare.h"
#include "glint/glint.h"
#include "glint/image/stored_image.h"

namespace glint::test::api_gl_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string modelFile(const std::string& name) { return glint::test::shipped + name; }

const Options small{{"resolution", "64,48"}};

std::vector<std::byte> bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto* const first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

/// A square from -1 to 1 facing +Z.
Arrays square() {
  Arrays arrays;
  arrays.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  arrays.indices = {0, 1, 2, 0, 2, 3};
  arrays.material = "color=0.5,0.25,0.125,ambient=1,diffuse=0";
  return arrays;
}

/// The whole square in the middle of the picture, lit by 1 from all sides.
const Options frontal{{"resolution", "32,32"},         {"camera-position", "0,0,4"},
                      {"camera-focal-point", "0,0,0"}, {"camera-view-angle", "40"},
                      {"ambient-light", "1,1,1"},      {"no-lights", "true"},
                      {"background-color", "0,0,0"}};

glm::vec4 at(const Image& image, int x, int y) {
  const float* p = image.row(y) + std::size_t(4) * std::size_t(x);
  return {p[0], p[1], p[2], p[3]};
}

TEST(Api, DrawsThePictureOfTheProgram) {
  Folder folder("api");
  for (const std::string backend : {"osmesa", "reference"}) {
    SCOPED_TRACE(backend);
    Session session(backend);
    EXPECT_THAT(session.description(), HasSubstr(backend));
    const Model model = Model::load(modelFile("teapot.glb"));
    const Options look{{"resolution", "96,64"},
                       {"shading", "blinn-phong"},
                       {"material", "color=#c04020,specular=0.5"},
                       {"light", "directional:1,2,3"},
                       {"light", "point:0,3,2:0.2,0.2,0.5"},
                       {"exposure", "0.5"}};
    const Codes codes = session.drawCodes(model, look);
    const Image linear = session.draw(model, look);
    std::vector<std::string> words{"render",         modelFile("teapot.glb"), "-o",
                                   folder / "a.png", "--rendering-backend",   backend};
    for (const auto& [name, value] : look) words.insert(words.end(), {"--" + name, value});
    ASSERT_EQ(runGlint(words).status, 0);
    words[3] = folder / "a.exr";
    ASSERT_EQ(runGlint(words).status, 0);
    const glint::StoredImage png = glint::readStoredImage(folder / "a.png");
    const auto& stored = std::get<std::vector<std::uint8_t>>(png.values);
    ASSERT_EQ(stored.size(), std::size_t(3 * 96 * 64));
    std::size_t differing = 0;
    for (std::size_t i = 0; i < 96 * 64; ++i) {
      for (std::size_t c = 0; c < 3; ++c) differing += stored[3 * i + c] != codes.values[4 * i + c];
      differing += codes.values[4 * i + 3] != 255;
    }
    EXPECT_EQ(differing, 0u);
    const Image exr = glint::readPicture(folder / "a.exr");
    EXPECT_TRUE(glint::comparePictures(exr, linear).same);
  }
}

TEST(Api, ModelsComeFromMemoryAndArrays) {
  Session session;
  const Image file = session.draw(Model::load(modelFile("torus.glb")), small);
  const Image memory = session.draw(Model::fromMemory(bytesOf(modelFile("torus.glb"))), small);
  EXPECT_EQ(file.values, memory.values);

  const Arrays part = square();
  const Model model = Model::fromArrays({&part, 1});
  EXPECT_THAT(model.warnings(), ElementsAre());
  EXPECT_THAT(model.bounds(), ElementsAre(0, 0, 0, testing::DoubleNear(std::sqrt(2.0), 1e-6)));
  const Image picture = session.draw(model, frontal);
  const glm::vec4 middle = at(picture, 16, 16), corner = at(picture, 0, 0);
  EXPECT_NEAR(middle.r, 0.5f, 1e-6);
  EXPECT_NEAR(middle.g, 0.25f, 1e-6);
  EXPECT_NEAR(middle.b, 0.125f, 1e-6);
  EXPECT_EQ(corner, glm::vec4(0, 0, 0, 1));

  // Colours, a position, and the back.
  Arrays back = part;
  back.colors.assign(4, {0.5f, 1, 1, 1});
  back.place = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
  EXPECT_EQ(at(session.draw(Model::fromArrays({&back, 1}), frontal), 16, 16).r, 0.0f);
  back.twoSided = true;
  EXPECT_NEAR(at(session.draw(Model::fromArrays({&back, 1}), frontal), 16, 16).r, 0.25f, 1e-6);

  // A texture with one red pixel.
  Folder folder("texture");
  glint::writePicture(folder / "red.png", Codes{1, 1, {255, 0, 0, 255}});
  Arrays red = part;
  red.material = "diffuse=0";
  red.texture = bytesOf(folder / "red.png");
  red.texcoords.assign(4, {0.5f, 0.5f});
  const glm::vec4 textured = at(session.draw(Model::fromArrays({&red, 1}), frontal), 16, 16);
  EXPECT_NEAR(textured.r, 1.0f, 1e-5);
  EXPECT_NEAR(textured.g, 0.0f, 1e-5);
}

TEST(Api, LayersAreNamed) {
  const Arrays part = square();
  const Model model = Model::fromArrays({&part, 1});
  for (const std::string backend : {"auto", "reference"}) {
    SCOPED_TRACE(backend);
    Session session(backend);
    const auto layers = session.layers(model, frontal);
    ASSERT_EQ(layers.size(), 3u);
    EXPECT_NEAR(at(layers.at("depth"), 16, 16).x, 4.0f, 1e-5);
    EXPECT_TRUE(std::isinf(at(layers.at("depth"), 0, 0).x));
    EXPECT_EQ(at(layers.at("normal"), 16, 16), glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(at(layers.at("id"), 16, 16), glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(at(layers.at("id"), 0, 0).x, -1.0f);
    const auto all = session.layers(model, frontal, {});
    EXPECT_NEAR(at(all.at("ambient"), 16, 16).r, 0.5f, 1e-6);
    EXPECT_THAT(
        [&] { (void)session.layers(model, frontal, {"shadow"}); },
        ThrowsMessage<glint::InputError>(HasSubstr("no layer 'shadow': there are ambient, ")));
  }
}

TEST(Api, AnimationsAndLooksMayChangeFromPictureToPicture) {
  const Model model = Model::load(modelFile("bend.glb"));
  Session one, other;
  const auto atTime = [](const std::string& time) {
    Options look = small;
    look.emplace_back("animation-time", time);
    return look;
  };
  const Image rest = one.draw(model, small), bent = one.draw(model, atTime("0.5"));
  EXPECT_NE(rest.values, bent.values);
  EXPECT_EQ(one.draw(model, small).values, rest.values);
  // A session that has skipped poses.
  (void)one.draw(model, atTime("0.3"));
  EXPECT_EQ(other.draw(model, atTime("0.5")).values, bent.values);
  (void)one.draw(model, atTime("0.2"));
  (void)one.draw(model, atTime("0.4"));
  EXPECT_EQ(other.draw(model, small).values, rest.values);
}

TEST(Api, RefusesInOneLine) {
  Session session;
  const Model model = Model::load(modelFile("torus.glb"));
  const auto drawing = [&](Options look) {
    return [&session, &model, look] { (void)session.draw(model, look); };
  };
  using glint::InputError;
  EXPECT_THAT(drawing({{"shadding", "phong"}}), ThrowsMessage<InputError>(HasSubstr("shadding")));
  EXPECT_THAT(drawing({{"shading", "pbr"}}), ThrowsMessage<InputError>(HasSubstr("--shading")));
  EXPECT_THAT(drawing({{"resolution", "0,5"}}), ThrowsMessage<InputError>(HasSubstr("0,5")));
  EXPECT_THAT(drawing({{"light", "directional:1,1,1"}, {"no-lights", "true"}}),
              ThrowsMessage<InputError>(HasSubstr("give one of them")));
  EXPECT_THAT(drawing({{"material", "Nothing:exponent=5"}}),
              ThrowsMessage<InputError>(HasSubstr("Nothing")));
  EXPECT_THAT(drawing({{"animation", "walk"}}), ThrowsMessage<InputError>(HasSubstr("walk")));
  (void)session.draw(model, small);  // and still draws
  EXPECT_THAT([] { Session other("vulkan"); }, ThrowsMessage<InputError>(HasSubstr("vulkan")));
  EXPECT_THAT([] { (void)Model::load("nowhere.glb"); },
              ThrowsMessage<InputError>(HasSubstr("nowhere.glb")));
  const std::vector<std::byte> nothing(20);
  EXPECT_THAT([&] { (void)Model::fromMemory(nothing); },
              ThrowsMessage<InputError>(testing::StartsWith("the model in memory: ")));

  const auto refusal = [](void (*spoil)(Arrays&)) {
    return [spoil] {
      Arrays part = square();
      spoil(part);
      (void)Model::fromArrays({&part, 1});
    };
  };
  EXPECT_THAT(refusal([](Arrays& a) { a.indices[1] = 4; }),
              ThrowsMessage<InputError>(HasSubstr("arrays[0]: index 4 and 4 positions")));
  EXPECT_THAT(refusal([](Arrays& a) { a.indices.pop_back(); }),
              ThrowsMessage<InputError>(HasSubstr("5 indices are not a multiple of 3")));
  EXPECT_THAT(refusal([](Arrays& a) { a.normals.resize(3); }),
              ThrowsMessage<InputError>(HasSubstr("3 normals for 4 positions")));
  EXPECT_THAT(refusal([](Arrays& a) { a.material = "shine=5"; }),
              ThrowsMessage<InputError>(HasSubstr("shine")));
  EXPECT_THAT(refusal([](Arrays& a) { a.positions.clear(); }),
              ThrowsMessage<InputError>(HasSubstr("no positions")));
  EXPECT_THAT(refusal([](Arrays& a) { a.texture.resize(9), a.texcoords.resize(4); }),
              ThrowsMessage<InputError>(HasSubstr("neither PNG nor JPEG nor WebP")));
  EXPECT_THAT([] { (void)Model::fromArrays({}); },
              ThrowsMessage<InputError>(HasSubstr("there are none")));
  // Triangles that are not finite are left out.
  Arrays part = square();
  part.positions[3][0] = NAN;
  EXPECT_THAT(Model::fromArrays({&part, 1}).warnings(),
              ElementsAre(HasSubstr("1 of 2 triangles have a non-finite position")));
}

TEST(Api, ComparesPictures) {
  Folder folder("compare");
  const Codes grey{2, 1, {100, 100, 100, 255, 100, 100, 100, 255}};
  Codes other = grey;
  other.values[0] = 110;
  EXPECT_TRUE(glint::comparePictures(grey, grey).same);
  const auto found =
      glint::comparePictures(grey, other, {.limits = {{"max", 0.01}}, .metrics = {"flip"}});
  EXPECT_FALSE(found.same);
  EXPECT_NEAR(found.values.at("max"), 10 / 255.0, 1e-6);
  EXPECT_THAT(found.failures, ElementsAre(HasSubstr("max")));
  EXPECT_EQ(found.map.size(), 2u);
  EXPECT_GT(found.map[0], 0);
  EXPECT_THAT(found.worst, HasSubstr("(0, 0)"));
  glint::writePicture(folder / "a.png", grey);
  glint::writePicture(folder / "b.png", other);
  EXPECT_FALSE(glint::compareFiles(folder / "a.png", folder / "b.png").same);
  EXPECT_TRUE(
      glint::compareFiles(folder / "a.png", folder / "b.png", {.limits = {{"max", 0.04}}}).same);
  EXPECT_THAT(
      [&] {
        (void)glint::comparePictures(grey, Codes{2, 2, grey.values});
      },
      ThrowsMessage<glint::InputError>(HasSubstr("2 x 2 pixels with 8 values")));
  EXPECT_THAT(
      [&] {
        (void)glint::comparePictures(grey, grey, {.limits = {{"psnrr", 1}}});
      },
      ThrowsMessage<glint::InputError>(HasSubstr("psnrr")));
}

TEST(Api, DrawsInThreads) {
  const Model model = Model::load(modelFile("torus.glb"));
  Session shared;
  const Image expected = shared.draw(model, small);
  std::atomic<int> same = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      Session own;
      Session reference("reference");
      const Image truth = reference.draw(model, small);
      const Model ownModel = Model::load(modelFile("torus.glb"));
      for (int k = 0; k < 5; ++k) {
        same += own.draw(model, small).values == expected.values;
        same += own.draw(ownModel, small).values == expected.values;
        same += shared.draw(model, small).values == expected.values;
        same += reference.draw(model, small).values == truth.values;
      }
    });
  for (std::thread& each : threads) each.join();
  EXPECT_EQ(same, 4 * 5 * 4);
}

/// What `work` returns in a child process, or "ended with N".
std::string inChild(const std::function<std::string()>& work) {
  int ends[2];
  if (pipe(ends) != 0) return "no pipe";
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);
    std::string said;
    try {
      said = work();
    } catch (const std::exception& error) {
      said = error.what();
    }
    const bool written = write(ends[1], said.data(), said.size()) == ssize_t(said.size());
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  std::string said(4096, 0);
  const ssize_t got = read(ends[0], said.data(), said.size());
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  said.resize(std::size_t(std::max<ssize_t>(got, 0)));
  return status == 0 ? said : "ended with " + std::to_string(status);
}

bool hasOpenGl() {
  const std::string maps = glint::test::contents("/proc/self/maps");
  return maps.find("libEGL") != maps.npos || maps.find("libOSMesa") != maps.npos;
}

TEST(Api, TellsWhatForkForbids) {
  // Before this process has used OpenGL, children may use it.
  if (!hasOpenGl()) {
    EXPECT_THAT(inChild([] {
                  Session session;
                  return std::to_string(
                      session.draw(Model::load(modelFile("torus.glb")), small).values.size());
                }),
                std::to_string(4 * 64 * 48));
  }
  Session session;
  const Model model = Model::load(modelFile("torus.glb"));
  (void)session.draw(model, small);
  EXPECT_THAT(inChild([&] { return std::to_string(session.draw(model, small).width); }),
              HasSubstr("when this process was forked"));
  EXPECT_THAT(inChild([&] {
                Session other;
                return std::string("drawn");
              }),
              HasSubstr("when this process was forked"));
  EXPECT_EQ(inChild([&] {
              Session other("reference");
              return std::to_string(other.draw(model, small).width);
            }),
            "64");
  // A child that exits normally does not destroy its parent's objects.
  EXPECT_EQ(inChild([&] {
              const Session taken = std::move(session);
              return std::string("gone");
            }),
            "gone");
  EXPECT_EQ(session.draw(model, small).width, 64);
}

TEST(Api, SessionsLeaveNothing) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps what was freed, and looks for leaks itself";
#endif
  const std::string model = modelFile("torus.glb");
  glint::test::drawSessions(20, 1, model);  // allocates what is kept once
  const double before = glint::test::residentBytes();
  glint::test::drawSessions(20, 1, model);
  // The model alone is 100 kB. tests/api_memory_long_test.cpp has a tighter bound, and threads.
  EXPECT_LT(glint::test::residentBytes() - before, 1e6);
}

}  // namespace glint::test::api_gl_test
