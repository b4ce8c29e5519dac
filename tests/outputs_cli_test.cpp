// Output features for programs and desktops: formats by name, floats on stdout, thumbnails, and
// list lines with more than a path.

#include <gmock/gmock.h>

#include <bit>
#include <cstring>

#include "command.h"
#include "glint/image/read_image.h"

namespace glint::test::outputs_cli_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string torus = shipped + "torus.glb";

Ran render(const std::string& out, const std::string& options = "") {
  return runGlint(quick({"render", torus, "-o", out}, split(options)));
}

/// A picture of --output-format raw, read as another program would.
struct RawPicture {
  std::uint32_t width = 0, height = 0, channels = 0;
  std::vector<float> values;
};

std::vector<RawPicture> rawPictures(const std::string& bytes) {
  std::vector<RawPicture> pictures;
  std::size_t at = 0;
  const auto word = [&] {
    std::uint32_t value = 0;
    for (int k = 0; k < 4; ++k)
      value |= std::uint32_t(static_cast<unsigned char>(bytes.at(at++))) << (8 * k);
    return value;
  };
  while (at < bytes.size()) {
    EXPECT_EQ(bytes.substr(at, 4), "GLNT");
    at += 4;
    RawPicture& picture = pictures.emplace_back();
    picture.width = word();
    picture.height = word();
    picture.channels = word();
    const std::size_t count = std::size_t(picture.width) * picture.height * picture.channels;
    for (std::size_t i = 0; i < count; ++i) picture.values.push_back(std::bit_cast<float>(word()));
  }
  return pictures;
}

double meanDifference(const glint::Image& a, const glint::Image& b) {
  if (a.values.size() != b.values.size()) return INFINITY;
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    sum += std::abs(double(a.values[i]) - double(b.values[i]));
  return sum / double(a.values.size());
}

TEST(Formats, JpegAndWebpAreThePicture) {
  Folder folder("formats");
  ASSERT_EQ(render(folder / "a.png").status, 0);
  const glint::Image png = readImage(folder / "a.png");
  for (const char* name : {"a.jpg", "a.JPEG", "a.webp"}) {
    expectDone(render(folder / name));
    EXPECT_LT(meanDifference(readImage(folder / name), png), 0.02) << name;
  }
  EXPECT_EQ(render(folder / "b.webp", "--quality 100").status, 0);
  EXPECT_EQ(readImage(folder / "b.webp").values, png.values);
  EXPECT_EQ(render(folder / "b.jpg", "--quality 5").status, 0);
  EXPECT_LT(contents(folder / "b.jpg").size(), contents(folder / "a.jpg").size());
  expectRefusal(render(folder / "c.png", "--quality 50"), "--quality: only for JPEG and WebP");
  expectRefusal(render(folder / "c.jpg", "--quality 0"), "--quality");
  expectRefusal(render(folder / "c.jpg", "--bit-depth 16"), "--bit-depth: only for PNG");
  expectRefusal(render(folder / "c.jpg", "--resume"), "--resume");
  expectRefusal(render(folder / "c.png", "--output-format gif"), "png, jpg, webp");
  EXPECT_FALSE(std::filesystem::exists(folder / "c.png"));
}

TEST(Formats, WithoutTransparencyAreOverBlack) {
  Folder folder("opaque");
  for (const std::string name : {"a.jpg", "a.pfm"}) {
    const Ran ran = render(folder / name, "--no-background");
    if (name == "a.jpg") {
      EXPECT_EQ(ran.status, 0) << ran.err;
      EXPECT_THAT(ran.err, HasSubstr("has no transparency: transparent parts become black"));
    } else {
      expectDone(ran);
    }
    EXPECT_LT(readImage(folder / name).values[0], 0.01f);
    EXPECT_EQ(readImage(folder / name).values[3], 1);
  }
  const Ran ran = render(folder / "a.webp", "--no-background");
  EXPECT_THAT(ran.err, IsEmpty());
  EXPECT_EQ(readImage(folder / "a.webp").values[3], 0);
}

// Thumbnailers name files without an extension, or with a random one.
TEST(Formats, AreAPngWhereTheEndingTellsNone) {
  Folder folder("endings");
  ASSERT_EQ(render(folder / "a.png").status, 0);
  for (const char* name : {"thumb", "thumb.XA71PZ", "two.png.new"}) {
    const Ran ran = render(folder / name);
    EXPECT_EQ(ran.status, 0) << ran.err;
    ASSERT_EQ(ran.errorLines().size(), 1u) << ran.err;
    EXPECT_THAT(ran.err, AllOf(HasSubstr("warning"), HasSubstr(name), HasSubstr("PNG")));
    EXPECT_EQ(contents(folder / name), contents(folder / "a.png"));
  }
  const Ran ran = render(folder / "thumb", "--output-format png");
  EXPECT_THAT(ran.err, IsEmpty());
  EXPECT_EQ(render(folder / "other", "--output-format jpg").status, 0);
  EXPECT_EQ(contents(folder / "other").substr(0, 2), "\xFF\xD8");
  expectRefusal(render(folder / "a.tif"), "TIFF cannot be written");
}

TEST(Raw, IsTheFloatsOfThePfm) {
  Folder folder("raw");
  ASSERT_EQ(render(folder / "a.pfm").status, 0);
  const glint::Image pfm = readImage(folder / "a.pfm");
  const Ran ran = render("-", "--output-format raw");
  EXPECT_EQ(ran.status, 0) << ran.err;
  const auto pictures = rawPictures(ran.out);
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_EQ(pictures[0].width, 40u);
  EXPECT_EQ(pictures[0].height, 30u);
  ASSERT_EQ(pictures[0].channels, 3u);
  for (std::size_t i = 0; i < 40 * 30; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_EQ(pictures[0].values[3 * i + c], pfm.values[4 * i + c]);
  // Transparent ones have premultiplied alpha, as in an EXR.
  ASSERT_EQ(render(folder / "a.exr", "--no-background").status, 0);
  const auto transparent = rawPictures(render("-", "--output-format raw --no-background").out);
  ASSERT_EQ(transparent.size(), 1u);
  EXPECT_EQ(transparent[0].channels, 4u);
  EXPECT_EQ(transparent[0].values, readImage(folder / "a.exr").values);
}

TEST(Raw, SeveralFollowEachOther) {
  Folder folder("raws");
  const std::string turning = "--turntable 3";
  ASSERT_EQ(render(folder / "{frame}.pfm", turning).status, 0);
  const Ran ran = render("-", "--output-format raw --turntable 3");
  EXPECT_EQ(ran.status, 0) << ran.err;
  const auto pictures = rawPictures(ran.out);
  ASSERT_EQ(pictures.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const glint::Image frame = readImage(folder / (std::to_string(k) + ".pfm"));
    for (std::size_t i = 0; i < 40 * 30; ++i)
      ASSERT_EQ(pictures[k].values[3 * i], frame.values[4 * i]);
  }
  // In formats without an end marker, stdout can hold only one picture.
  expectRefusal(render("-", turning), "{frame}");
  expectRefusal(render("-", "--output-format exr"), "needs a regular file");
}

TEST(ListOfJson, LinesHaveLooksOfTheirOwn) {
  Folder folder("json_lines");
  std::ofstream(folder / "red.json")
      << R"({"glint-look": 1, "material": {"": {"color": [0.6, 0.02, 0.01]}}})";
  std::ofstream(folder / "list")
      << R"({"model": ")" << torus << R"(", "output": ")" << (folder / "a.png") << R"("})"
      << "\n"
      << R"({"model": ")" << torus << R"(", "look": {"camera-azimuth-angle": 40,)"
      << R"( "resolution": [20, 10], "material": {"": {"exponent": 5}}}})"
      << "\n"
      << R"({"look": ")" << (folder / "red.json") << R"(", "model": ")" << torus << R"("})"
      << "\n"
      << torus << "\t" << (folder / "d.png") << "\n";
  const Arguments list = quick({"render", "--from-list", folder / "list", "-o", folder / "{n}.png",
                                "--shading", "blinn-phong"});
  expectDone(runGlint(list));
  EXPECT_THAT(folder.names(), ElementsAre("1.png", "2.png", "a.png", "d.png", "list", "red.json"));
  EXPECT_EQ(contents(folder / "a.png"), contents(folder / "d.png"));
  EXPECT_EQ(readImage(folder / "1.png").width, 20);
  // The same as the options give.
  const auto same = [&](const std::string& name, const std::string& options) {
    EXPECT_EQ(render(folder / "x.png", "--shading blinn-phong " + options).status, 0);
    EXPECT_EQ(contents(folder / "x.png"), contents(folder / name)) << name;
  };
  same("a.png", "");
  same("2.png", "--material color=0.6,0.02,0.01");
  same("1.png", "--camera-azimuth-angle 40 --resolution 20,10 --material exponent=5");
  // Nothing is made again, since each picture records its own look.
  for (const Json& line : jsonLines(runGlint(joined(list, {"--resume"})).out))
    EXPECT_TRUE(line.value("skipped", false));
}

TEST(ListOfJson, WhatIsSaidOfAModelBeatsTheRunsLook) {
  Folder folder("json_over");
  const auto expectSame = [&](const std::string& look, const std::string& beaten,
                              const std::string& options) {
    std::ofstream(folder / "list")
        << R"({"model": ")" << torus << R"(", "look": )" << look << "}\n";
    const Ran ran = runGlint(
        quick({"render", "--from-list", folder / "list", "-o", folder / "a.png"}, split(beaten)));
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(render(folder / "b.png", options).status, 0);
    EXPECT_EQ(contents(folder / "a.png"), contents(folder / "b.png")) << look;
  };
  const std::string light = R"({"light": ["directional:1,2,3"]})";
  expectSame(light, "--no-lights", "--light directional:1,2,3");
  expectSame(light, "--light camera", "--light directional:1,2,3");
  // An edit of all materials takes precedence over one by name.
  expectSame(R"({"material": {"": {"exponent": 3}}})", "--material #0:exponent=90",
             "--material exponent=3");
  expectSame(R"({"camera-intrinsics": [40, 40, 10, 20]})", "--camera-view-angle 70",
             "--camera-intrinsics 40,40,10,20");
}

TEST(ListOfJson, WrongLinesFailAlone) {
  Folder folder("json_wrong");
  const std::pair<std::string, std::string> lines[] = {
      {R"({"model": )", "JSON"},
      {R"({"model": "a.glb")", "JSON"},
      {R"({})", "no \"model\""},
      {R"({"model": 7})", "\"model\": give a string"},
      {R"({"model": ""})", "\"model\": give a string"},
      {R"({"model": "a.glb", "output": []})", "\"output\": give a string"},
      {R"({"model": "a.glb", "look": 7})", "\"look\": give an object"},
      {R"({"model": "a.glb", "lok": {}})", "unknown key \"lok\""},
      {R"({"model": "none.glb"})", "none.glb"},
      {R"({"model": ")" + torus + R"(", "look": {"shadin": 1}})", "unknown key \"shadin\""},
      {R"({"model": ")" + torus + R"(", "look": {"exposure": "x"}})", "exposure"},
      {R"({"model": ")" + torus + R"(", "look": "none.json"})", "none.json"},
      {R"({"model": ")" + torus + R"(", "look": {"glint-look": 2}})", "glint-look"},
      {R"({"model": ")" + torus + R"(", "look": {"camera-index": 9}})", "camera-index"},
      {R"({"model": "-"})", "stdin: is empty"},
      {"\tx.png", "TAB"},
      {"a.glb\tb\tc", "TAB"},
      {std::string(70, '[') + "{", "["},
  };
  std::ofstream list(folder / "list");
  for (const auto& [line, part] : lines) list << line << "\n";
  list << torus << "\n";
  list.close();
  const Ran ran =
      runGlint(quick({"render", "--from-list", folder / "list", "-o", folder / "{n}.png"}));
  EXPECT_EQ(ran.status, 2);
  const auto told = jsonLines(ran.out);
  ASSERT_EQ(told.size(), std::size(lines) + 1);
  for (std::size_t i = 0; i < std::size(lines); ++i) {
    EXPECT_EQ(told[i]["status"], 2) << lines[i].first;
    EXPECT_THAT(told[i]["error"], HasSubstr(lines[i].second)) << lines[i].first;
  }
  EXPECT_EQ(told.back()["status"], 0);
  EXPECT_THAT(ran.err, HasSubstr("line 3: no \"model\""));
  EXPECT_THAT(folder.names(), ElementsAre("18.png", "list"));
}

// The installed entry, filled in as a file manager does.
TEST(Thumbnailer, MakesAPictureOfTheSizeAskedFor) {
  Folder folder("thumbnails");
  std::string command;
  std::istringstream entry(contents(GLINT_SOURCE_DIR "/packaging/glint.thumbnailer"));
  for (std::string line; std::getline(entry, line);)
    if (line.starts_with("Exec=")) command = line.substr(5);
  ASSERT_TRUE(command.starts_with("glint render "));
  std::filesystem::copy_file(torus, folder / "a model.glb");
  // The path, as the entry requests it, and the URI that another one might use.
  for (const std::string& model :
       {folder / "a model.glb", "file://" + (folder / "a%20model.glb")}) {
    Arguments arguments;
    std::istringstream words(command);
    for (std::string word; words >> word;) {
      const auto fill = [&](const std::string& what, const std::string& with) {
        for (auto at = word.find(what); at != std::string::npos; at = word.find(what))
          word.replace(at, what.size(), with);
      };
      fill("%i", model);
      fill("%o", folder / "out.X7PQ2M");
      fill("%s", "96");
      arguments.push_back(word);
    }
    arguments.erase(arguments.begin());
    expectDone(runGlint(arguments));
    const glint::Image picture = readImage(folder / "out.X7PQ2M");
    EXPECT_EQ(picture.width, 96);
    EXPECT_EQ(picture.height, 96);
    EXPECT_EQ(picture.values[3], 0);  // transparent next to the model
    EXPECT_EQ(picture.values[4 * (96 * 48 + 20) + 3], 1);
    std::filesystem::remove(folder / "out.X7PQ2M");
  }
}

}  // namespace glint::test::outputs_cli_test
