// Public sample models drawn by the binary: the same files from every backend, pictures that are
// not empty, programs that differ visibly, and an error for every damaged file.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "command.h"
#include "glint/image/read_image.h"

namespace glint::test::pictures_assets_test {

namespace fs = std::filesystem;

constexpr const char* programNames[] = {"flat", "gouraud", "phong", "blinn-phong", "environment"};

std::vector<std::string> modelsIn(const char* part) {
  const char* folder = std::getenv("GLINT_ASSETS");
  std::vector<std::string> models;
  if (!folder) return models;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(folder) / part)) {
    const fs::path ending = entry.path().extension();
    if (ending == ".gltf" || ending == ".glb") models.push_back(entry.path().string());
  }
  std::sort(models.begin(), models.end());
  return models;
}

// Draws all models in one process: FOLDER/STEM.EXT.
void drawAll(const std::vector<std::string>& models, const std::string& output,
             const std::vector<std::string>& options) {
  std::vector<std::string> arguments{"render"};
  arguments.insert(arguments.end(), models.begin(), models.end());
  arguments.insert(arguments.end(), {"-o", output, "--resolution", "120,90"});
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Ran ran = glint::test::runGlint(arguments, {.timeoutSeconds = 300});
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.signal, 0);
}

// Pixels whose colour is not the background's.
std::size_t covered(const Image& image) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 4)
    count += std::abs(image.values[i] - image.values[0]) > 1e-4f ||
             std::abs(image.values[i + 1] - image.values[1]) > 1e-4f;
  return count;
}

class Pictures : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    ASSERT_NE(std::getenv("GLINT_ASSETS"), nullptr)
        << "set GLINT_ASSETS to the folder of the sample models";
  }
};

TEST_P(Pictures, AreTheSameFilesFromEveryBackendAndShowSomething) {
  const auto models = modelsIn("models");
  ASSERT_GE(models.size(), 18u);
  for (const char* antiAliasing : {"msaa:4", "none"})
    for (const char* ending : {".pfm", ".png"}) {
      Folder a("osmesa"), b("egl");
      const std::vector<std::string> options{"--shading", GetParam(), "--anti-aliasing",
                                             antiAliasing};
      for (const auto& [folder, backend] :
           {std::pair(&a, "osmesa"), std::pair(&b, "egl-software")}) {
        auto all = options;
        all.insert(all.end(), {"--rendering-backend", backend});
        drawAll(models, *folder / ("{model}" + std::string(ending)), all);
      }
      for (const std::string& model : models) {
        const std::string name = fs::path(model).stem().string() + ending;
        const std::string bytes = contents(a / name);
        EXPECT_FALSE(bytes.empty()) << name;
        EXPECT_EQ(bytes == contents(b / name), true)
            << name << " differs between backends, " << antiAliasing;
        const Image image = glint::readImage(a / name);
        double sum = 0;
        for (float x : image.values) {
          ASSERT_TRUE(std::isfinite(x)) << name;
          sum += x;
        }
        // The model fills nine tenths of the smaller side, so even a thin one covers a hundredth of
        // the picture. The mean is over colour and alpha.
        EXPECT_GT(covered(image), image.values.size() / 4 / 100) << name;
        const double mean = (sum / double(image.values.size() / 4) - 1) / 3;
        EXPECT_GT(mean, 0.01) << name;
        EXPECT_LT(mean, 1.0) << name;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Programs, Pictures, testing::ValuesIn(programNames), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

// Averaged over the model's pixels, two programs differ by more than half a level of 255 (linear
// light) in one of two views, which an eye comparing the pictures can see. Flat faces need a
// highlight that varies over them, too, so the light is at the eye, which is near and has a wide
// angle.
TEST(PicturesOfPrograms, DifferVisibly) {
  const auto models = modelsIn("models");
  ASSERT_FALSE(models.empty()) << "set GLINT_ASSETS to the folder of the sample models";
  using Pair = std::pair<std::size_t, std::size_t>;
  std::map<std::string, std::map<Pair, double>> differences;
  for (const char* elevation : {"0", "30"}) {
    std::map<std::string, std::vector<Image>> images;
    for (const char* program : programNames) {
      Folder folder("programs");
      drawAll(models, folder / "{model}.pfm",
              {"--shading", program, "--anti-aliasing", "none", "--rendering-backend", "osmesa",
               "--material", "specular=0.6,exponent=3,metalness=0", "--light", "camera",
               "--camera-view-angle", "90", "--camera-elevation-angle", elevation});
      for (const std::string& model : models)
        images[model].push_back(
            glint::readImage(folder / (fs::path(model).stem().string() + ".pfm")));
    }
    for (const auto& [model, pictures] : images)
      for (std::size_t i = 0; i < std::size(programNames); ++i)
        for (std::size_t j = i + 1; j < std::size(programNames); ++j) {
          double sum = 0;
          for (std::size_t k = 0; k < pictures[i].values.size(); ++k)
            sum += std::abs(pictures[i].values[k] - pictures[j].values[k]);
          double& most = differences[model][{i, j}];
          most = std::max(most, sum / 3 / double(std::max<std::size_t>(covered(pictures[i]), 1)));
        }
  }
  for (const auto& [model, pairs] : differences)
    for (const auto& [pair, mean] : pairs)
      EXPECT_GT(mean, 0.5 / 255) << fs::path(model).stem() << ": " << programNames[pair.first]
                                 << " and " << programNames[pair.second];
}

TEST(DamagedFiles, EndInOneLineOrAPictureWithWarnings) {
  const auto models = modelsIn("malformed");
  ASSERT_GE(models.size(), 17u) << "set GLINT_ASSETS to the folder of the sample models";
  for (const char* program : {"phong", "flat"})
    for (const std::string& model : models) {
      SCOPED_TRACE(model);
      Folder folder("damaged");
      const Ran ran =
          glint::test::runGlint({"render", model, "-o", folder / "a.pfm", "--resolution", "64,48",
                                 "--shading", program, "--rendering-backend", "osmesa"},
                                {.timeoutSeconds = 10});
      EXPECT_FALSE(ran.timedOut);
      EXPECT_EQ(ran.signal, 0);
      if (ran.status == 2) {
        EXPECT_EQ(ran.errorLines().size(), 1u) << ran.err;
        EXPECT_THAT(ran.err, testing::HasSubstr(fs::path(model).filename().string()));
        EXPECT_THAT(folder.names(), testing::IsEmpty());
        continue;
      }
      EXPECT_EQ(ran.status, 0) << ran.err;
      for (const std::string& line : ran.errorLines())
        EXPECT_THAT(line, testing::StartsWith("glint: warning: "));
      EXPECT_THAT(folder.names(), testing::ElementsAre("a.pfm"));
      for (float x : glint::readImage(folder / "a.pfm").values) EXPECT_TRUE(std::isfinite(x));
    }
}

// `glint info` reads the same files.
TEST(DamagedFiles, AreRefusedByInfoAsByRender) {
  for (const std::string& model : modelsIn("malformed")) {
    const Ran ran = glint::test::runGlint({"info", model}, {.timeoutSeconds = 10});
    EXPECT_FALSE(ran.timedOut) << model;
    EXPECT_TRUE(ran.status == 0 || ran.status == 2) << model << " " << ran.status;
    if (ran.status == 2) {
      EXPECT_EQ(ran.errorLines().size(), 1u) << ran.err;
    }
  }
}

}  // namespace glint::test::pictures_assets_test
