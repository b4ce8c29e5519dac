// Several pictures of one model: its terms, sweeps over a parameter, moments of an animation.

#include <gmock/gmock.h>

#include <cmath>

#include "command.h"
#include "glint/image/file.h"
#include "glint/image/picture_layers.h"
#include "glint/image/read_image.h"
#include "gltf_sample.h"

namespace glint::test::series_cli_test {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string sphere = shipped + "sphere.glb", torus = shipped + "torus.glb";

Arguments tiny(Arguments arguments, const Arguments& more = {}) {
  arguments.insert(arguments.end(), {"--resolution", "32,32"});
  return quick(std::move(arguments), more);
}

// The files of --terms add up to the picture, by GL and by the reference, and the layers of an EXR
// have the same values.
TEST(Terms, FilesAddUpAndLayersAreTheSame) {
  Folder folder("terms");
  const auto draw = [&](const std::string& backend, const std::string& name,
                        const std::string& more) {
    return reportOf(runGlint(joined(
        {"render", sphere, "-o", folder / name, "--rendering-backend", backend},
        split("--resolution 32,32 --shading environment --light camera:0.5,0.6,0.7 --light "
              "point:1,2,3 --material specular=0.8,exponent=9 --anti-aliasing none --json - " +
              more))))["pictures"][0];
  };
  for (const char* backend : {"osmesa", "reference"}) {
    const Json terms = draw(backend, "a.pfm", "--terms")["terms"];
    ASSERT_EQ(terms.size(), 12u);
    EXPECT_EQ(terms["diffuse-1"], folder / "a.diffuse-1.pfm");
    draw(backend, "a.exr", "--terms");
    const Image picture = readImage(folder / "a.pfm");
    std::vector<double> sum(picture.values.size());
    for (const auto& [name, path] : terms.items()) {
      const Image image = readImage(path);
      if (name == "id") {
        // One object with one mesh and one material, or none.
        for (std::size_t i = 0; i < image.values.size(); i += 4)
          for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_EQ(image.values[i + c], image.values[i]);
            ASSERT_TRUE(image.values[i] == 0 || image.values[i] == -1);
          }
        const std::string exr = folder / "a.exr";
        const auto layers = glint::decodePictureLayers(glint::readFile(exr), exr, "id.mesh").layers;
        ASSERT_EQ(layers.size(), 1u);
        const auto& codes = std::get<2>(layers[0].image.values);
        const std::size_t channels = std::size_t(layers[0].image.channels);
        for (std::size_t i = 0; i < 32 * 32; ++i)
          ASSERT_EQ(codes[channels * i], image.values[4 * i]);
        continue;
      }
      if (name == "normal") continue;
      EXPECT_EQ(readImage(folder / "a.exr", name).values, image.values) << name;
      if (name == "depth") continue;
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += double(image.values[i]);
    }
    // Nine terms with a few roundings each, of values up to 4.
    for (std::size_t i = 0; i < sum.size(); ++i)
      if (i % 4 != 3) {
        ASSERT_NEAR(sum[i], double(picture.values[i]), 9 * 4 * 4 * 6e-8) << i;
      }
  }
  // The picture itself is the same as without the option.
  draw("reference", "b.pfm", "");
  EXPECT_EQ(contents(folder / "a.pfm"), contents(folder / "b.pfm"));
}

TEST(Sweep, IsASheetOfThePicturesThatItsStepsGive) {
  Folder folder("sweep");
  const auto draw = [&](const std::string& name, const std::string& options) {
    const Ran ran = runGlint(tiny({"render", sphere, "-o", folder / name}, split(options)));
    EXPECT_EQ(ran.status, 0) << ran.err;
    return readImage(folder / name);
  };
  // Logarithmic: 1, 10, 100.
  const Image sheet = draw("sheet.pfm", "--sweep exponent=1:100:3 --sweep exposure=-1:1:2");
  const int gap = 2, across = 32 + gap, down = sheet.height / 2;
  ASSERT_EQ(sheet.width, 3 * across + gap);
  const std::string exponents[] = {"1", "10", "100"};
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column) {
      const Image cell = draw("cell.pfm", "--material exponent=" + exponents[column] +
                                              " --exposure " + (row ? "1" : "-1"));
      for (int y = 0; y < 32; ++y)
        for (int i = 0; i < 4 * 32; ++i)
          ASSERT_EQ(sheet.row(row * down + gap + y)[4 * (column * across + gap) + i],
                    cell.row(y)[i])
              << row << " " << column;
      // There is a label below.
      float label = 0;
      for (int y = 32 + gap; y < down; ++y)
        for (int x = 0; x < 32; ++x)
          label += sheet.row(row * down + y)[4 * (column * across + gap + x)];
      EXPECT_GT(label, 20);
    }
  EXPECT_EQ(draw("named.png", "--sweep camera-azimuth-angle=0:90:7:linear").width,
            3 * across + gap);
}

TEST(Sweep, WrongOnesAreRefused) {
  Folder folder("wrong_sweeps");
  const std::pair<const char*, const char*> cases[] = {
      {"shine=1:2:3", "no numeric parameter"}, {"exponent", "KEY=FROM:TO:STEPS"},
      {"exponent=1:2", "KEY=FROM:TO:STEPS"},   {"exponent=1:2:1", "steps"},
      {"exponent=1:2:2.5", "steps"},           {"exponent=1:2:9999", "steps"},
      {"exponent=0:2:3", ":linear"},           {"exponent=1:2:3:even", "neither"},
      {"exponent=1:1e9:3", "exponent"},        {"metalness=0:2:3", "metalness"},
      {"exponent=a:2:3", "KEY=FROM:TO"},       {"shading=0:1:2", "no numeric parameter"},
      {"ior=1:nan:3", "KEY=FROM:TO"},          {"Nobody:ior=1:2:3", "Nobody"}};
  for (const auto& [sweep, expected] : cases) {
    SCOPED_TRACE(sweep);
    expectRefusal(runGlint(tiny({"render", sphere, "-o", folder / "a.png", "--sweep", sweep})),
                  expected);
  }
  EXPECT_THAT(folder.names(), testing::IsEmpty());
}

// A triangle that moves by 2 along x within a second.
TEST(Frames, AreMomentsOfTheAnimationBeforeOneCamera) {
  Sample sample;
  sample.triangle();
  sample.add(
      "animations",
      {{"name", "glide"},
       {"samplers",
        {{{"input", sample.accessor<float>("SCALAR", {0, 1})},
          {"output", sample.accessor<float>("VEC3", {0, 0, 0, 2, 0, 0})}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
  sample.json["accessors"][1].update({{"min", {0}}, {"max", {1}}});
  Folder folder("frames");
  const std::string model = sample.writeGltf().string();
  expectDone(runGlint(quick({"render", model, "-o", folder / "{frame}.png", "--frames", "4",
                             "--camera-direction", "0,0,-1", "--resolution", "64,64"})));
  // The centre of the model moves to the right by one step per frame.
  std::vector<double> places;
  Json camera;
  for (int i = 0; i < 4; ++i) {
    const std::string name = folder / (std::to_string(i) + ".png");
    const Image image = readImage(name);
    double sum = 0, weight = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const double seen = std::abs(image.row(y)[4 * x] - image.values[0]) > 1e-3;
        sum += x * seen;
        weight += seen;
      }
    ASSERT_GT(weight, 20);
    places.push_back(sum / weight);
    // Each records how it was made, and its look reproduces it.
    const Json look = Json::parse(readPictureText(name).at("glint-look"));
    EXPECT_EQ(look["animation-time"], 0.25 * i);
    if (i > 0) {
      EXPECT_EQ(look["camera-position"], camera);
    }
    camera = look["camera-position"];
    EXPECT_EQ(runGlint({"render", model, "-o", folder / "again.png", "--look", name,
                        "--rendering-backend", "osmesa"})
                  .status,
              0);
    EXPECT_EQ(readImage(folder / "again.png").values, image.values);
  }
  // Covered pixels round a place by half a pixel at most, and so the two ends of the line.
  for (int i = 1; i < 3; ++i)
    EXPECT_NEAR(places[std::size_t(i)], places[0] + i / 3.0 * (places[3] - places[0]), 1);
  EXPECT_GT(places[3] - places[0], 20);
  expectRefusal(runGlint(tiny({"render", sphere, "-o", folder / "s{frame}.png", "--frames", "2"})),
                "no animation");
}

TEST(Turntable, GoesRoundToTheRight) {
  Folder folder("turntable");
  expectDone(runGlint(quick(
      {"render", torus, "-o", folder / "{frame}.pfm", "--turntable", "12", "--shading", "flat"})));
  EXPECT_EQ(folder.names().size(), 12u);
  EXPECT_EQ(folder.names().front(), "00.pfm");
  for (const auto& [azimuth, frame] : {std::pair("0", "00"), {"30", "01"}, {"330", "11"}}) {
    expectDone(runGlint(quick({"render", torus, "-o", folder / "one.pfm", "--shading", "flat",
                               "--camera-azimuth-angle", azimuth})));
    EXPECT_EQ(contents(folder / "one.pfm"), contents(folder / (std::string(frame) + ".pfm")));
  }
}

}  // namespace glint::test::series_cli_test
