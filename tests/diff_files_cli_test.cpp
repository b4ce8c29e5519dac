// What `glint diff` compares of what files hold, and how folders are judged pair by pair.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "command.h"
#include "glint/image/exr_writer.h"
#include "glint/image/picture_writer.h"
#include "glint/image/read_image.h"

namespace diff_files_cli_test {

using glint::ExrLayer;
using glint::Image;
using glint::test::contents;
using glint::test::Folder;
using glint::test::Ran;
using glint::test::runGlint;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

Image filled(int width, int height, std::initializer_list<float> pixel) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    image.values.insert(image.values.end(), pixel.begin(), pixel.end());
  return image;
}

void write(const std::string& path, const Image& image) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  const auto writer = glint::openPictureWriter(path, image.width, image.height);
  writer->write(image);
  writer->finish();
}

void writeFile(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

class Files : public Folder {
 public:
  using Folder::Folder;
  Ran diff(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "diff");
    return runGlint(arguments, {.environment = {}, .folder = path()});
  }
};

const Image grey = filled(8, 6, {0.25f, 0.5f, 0.75f, 1});

TEST(DiffLayers, EveryChannelCounts) {
  const Files files("layers");
  Image normal = grey, moved = grey, depth = grey, deeper = grey;
  moved.values[0] += 0.5f;     // X of the first pixel
  deeper.values[4] = 1e6f;     // Z of the second
  depth.values[8] = INFINITY;  // the same in both: equal
  deeper.values[8] = INFINITY;
  const auto write = [&](const std::string& name, std::vector<ExrLayer> layers) {
    glint::writeExr(files / name, layers);
  };
  write("a.exr", {{"", &grey, "RGBA"}, {"normal", &normal, "XYZ"}, {"depth", &depth, "Z"}});
  write("moved.exr", {{"", &grey, "RGBA"}, {"normal", &moved, "XYZ"}, {"depth", &depth, "Z"}});
  write("deeper.exr", {{"", &grey, "RGBA"}, {"normal", &normal, "XYZ"}, {"depth", &deeper, "Z"}});
  write("less.exr", {{"", &grey, "RGBA"}, {"normal", &normal, "XYZ"}});
  write("xyz.exr", {{"", &normal, "XYZ"}});
  write("xyz2.exr", {{"", &moved, "XYZ"}});

  EXPECT_EQ(files.diff({"a.exr", "a.exr"}).status, 0);
  Ran ran = files.diff({"a.exr", "moved.exr"});
  EXPECT_EQ(ran.status, 1);
  EXPECT_THAT(ran.out, HasSubstr("layer normal.X"));
  ran = files.diff({"a.exr", "deeper.exr", "--metric", "max", "--threshold", "0.1"});
  EXPECT_EQ(ran.status, 1);
  EXPECT_THAT(ran.out, HasSubstr("depth.Z"));
  EXPECT_EQ(files.diff({"xyz.exr", "xyz2.exr"}).status, 1);
  // A layer that one of them lacks is a difference.
  ran = files.diff({"a.exr", "less.exr"});
  EXPECT_EQ(ran.status, 1);
  EXPECT_THAT(ran.out, HasSubstr("layer depth.Z is missing in the picture"));
  // One by its name; what the condition does not judge is told.
  EXPECT_EQ(files.diff({"a.exr", "moved.exr", "--layer", "depth"}).status, 0);
  EXPECT_EQ(files.diff({"a.exr", "moved.exr", "--layer", "normal"}).status, 1);
  ran = files.diff({"a.exr", "moved.exr", "--layer", "main"});
  EXPECT_EQ(ran.status, 0);
  EXPECT_THAT(ran.out, HasSubstr("not compared: layer "));
  EXPECT_EQ(files.diff({"a.exr", "moved.exr", "--layer", "nothing"}).status, 2);
  ran = files.diff({"a.exr", "moved.exr", "--metric", "flip", "--threshold", "0.1"});
  EXPECT_EQ(ran.status, 0);
  EXPECT_THAT(ran.out, HasSubstr("which no condition judges"));
}

TEST(DiffLayers, EqualInfinitiesAreEqual) {
  const Files files("infinities");
  Image a = grey, b = grey;
  a.values[0] = b.values[0] = INFINITY;
  b.values[5] += 0.001f;
  write(files / "a.exr", a);
  write(files / "b.exr", b);
  EXPECT_EQ(files.diff({"a.exr", "b.exr", "--metric", "max", "--threshold", "0.01"}).status, 0);
  b.values[0] = -INFINITY;
  write(files / "b.exr", b);
  EXPECT_EQ(files.diff({"a.exr", "b.exr", "--metric", "max", "--threshold", "1e9"}).status, 1);
  for (float& value : a.values) value = NAN;
  write(files / "nan.exr", a);
  const Ran ran = files.diff({"nan.exr", "nan.exr", "--json", "-"});
  EXPECT_EQ(ran.status, 0);
  EXPECT_TRUE(Json::parse(ran.out)["metrics"]["max"]["value"].is_null()) << ran.out;
}

TEST(DiffLayers, PremultipliedColoursAreComparedAsStored) {
  const Files files("premultiplied");
  Image a = filled(4, 4, {1e-5f, 0, 0, 1e-5f}), b = filled(4, 4, {1.1e-4f, 0, 0, 1e-5f});
  write(files / "a.exr", a);
  write(files / "b.exr", b);
  for (const char* alpha : {"straight", "ignored"}) {
    const Ran ran = files.diff(
        {"a.exr", "b.exr", "--alpha", alpha, "--metric", "max", "--threshold", "1.1e-4"});
    EXPECT_EQ(ran.status, 0) << alpha << ": " << ran.out;
  }
}

TEST(DiffConditions, AllMustHold) {
  const Files files("all");
  Image b = grey;
  for (int i = 0; i < 4; ++i) b.values[std::size_t(4 * i)] = 1;
  write(files / "a.png", grey);
  write(files / "b.png", b);
  EXPECT_EQ(files.diff({"a.png", "b.png", "--max-pixels", "4", "--max-pixels", "5%"}).status, 1);
  EXPECT_EQ(files.diff({"a.png", "b.png", "--max-pixels", "5%", "--max-pixels", "4"}).status, 1);
  EXPECT_EQ(files.diff({"a.png", "b.png", "--max-pixels", "4", "--max-pixels", "9%"}).status, 0);
  // In the worst window of 2 x 2 there are two.
  EXPECT_EQ(files.diff({"a.png", "b.png", "--window", "2", "--max-pixels", "2"}).status, 0);
  EXPECT_EQ(files.diff({"a.png", "b.png", "--window", "2", "--max-pixels", "1"}).status, 1);
}

TEST(DiffConditions, WhatMovedByAPixel) {
  const Files files("shift");
  Image a = grey, b = grey;
  for (int y = 0; y < 6; ++y) {
    a.values[std::size_t(4 * (8 * y + 3))] = 1;
    b.values[std::size_t(4 * (8 * y + 4))] = 1;
  }
  write(files / "a.png", a);
  write(files / "b.png", b);
  EXPECT_EQ(files.diff({"a.png", "b.png", "--max-pixels", "0"}).status, 1);
  EXPECT_EQ(files.diff({"a.png", "b.png", "--max-pixels", "0", "--shift", "1"}).status, 0);
  EXPECT_EQ(files.diff({"a.png", "b.png", "--shift", "1"}).status, 2);
}

TEST(DiffConditions, OfPairsByAFile) {
  const Files files("conditions");
  Image b = grey;
  b.values[0] = 1;
  for (const char* name : {"loose/one.png", "strict/one.png", "two.png"}) {
    write(files / ("x/" + std::string(name)), grey);
    write(files / ("y/" + std::string(name)), b);
  }
  writeFile(files / "x/glint-diff.txt", "# pattern and options\nloose --max-pixels 1\n*.png\n");
  Ran ran = files.diff({"x", "y"});
  EXPECT_THAT(ran.out, HasSubstr("3 pairs: 0 same, 3 differ"));  // the last line counts
  writeFile(files / "x/glint-diff.txt", "*.png\n\nloose --max-pixels 1\r\n");
  ran = files.diff({"x", "y"});
  EXPECT_THAT(ran.out, HasSubstr("3 pairs: 1 same, 2 differ"));
  writeFile(files / "other.txt", "*o.png --metric max --threshold 1\n");
  EXPECT_THAT(files.diff({"x", "y", "--conditions", "other.txt"}).out,
              HasSubstr("3 pairs: 1 same, 2 differ"));
  writeFile(files / "other.txt", "\n*o.png --metric most\n");
  ran = files.diff({"x", "y", "--conditions", "other.txt"});
  EXPECT_EQ(ran.status, 2);
  writeFile(files / "other.txt", "\n*o.png --threshold 1\n");
  EXPECT_THAT(files.diff({"x", "y", "--conditions", "other.txt"}).err, HasSubstr("other.txt:2: "));
  // What is updated, by a folder and by a pattern; what is pruned.
  EXPECT_THAT(files.diff({"x", "y", "--update", "strict"}).err,
              HasSubstr("replaced the baseline x/strict/one.png"));
  EXPECT_THAT(files.diff({"x", "y", "--update", "t*.png"}).err,
              HasSubstr("replaced the baseline x/two.png"));
  write(files / "x/gone.png", grey);
  EXPECT_EQ(files.diff({"x", "y"}).status, 2);
  EXPECT_THAT(files.diff({"x", "y", "--prune"}).err, HasSubstr("removed the baseline x/gone.png"));
  EXPECT_EQ(files.diff({"x", "y"}).status, 0);
}

TEST(DiffBaselines, TheNearestCounts) {
  const Files files("nearest");
  Image b = grey;
  b.values[0] = 1;
  write(files / "x/one.png", grey);
  write(files / "x/one_1.png", b);
  write(files / "y/one.png", b);
  const Ran ran = files.diff({"x", "y"});
  EXPECT_EQ(ran.status, 0) << ran.out;
  EXPECT_THAT(ran.out, HasSubstr("1 pair: 1 same"));
  EXPECT_EQ(files.diff({"x/one.png", "y/one.png"}).status, 0);
  // With a picture of its own it is a pair.
  write(files / "y/one_1.png", b);
  EXPECT_THAT(files.diff({"x", "y"}).out, HasSubstr("2 pairs: 1 same, 1 differ"));
}

TEST(DiffSizes, LongSidesAndOtherSizes) {
  const Files files("sizes");
  Image a = filled(2, 23046, {0.5f, 0.5f, 0.5f, 1}), b = a;
  b.values[std::size_t(4 * 2 * 20000)] = 0;
  write(files / "a.png", a);
  write(files / "b.png", b);
  EXPECT_EQ(files.diff({"a.png", "a.png"}).status, 0);
  EXPECT_THAT(files.diff({"a.png", "b.png"}).out, HasSubstr("worst at 0,20000"));
  // Of other sizes the rest counts as transparent, in the picture of the difference, too.
  write(files / "small.png", grey);
  write(files / "wide.png", filled(10, 6, {0.25f, 0.5f, 0.75f, 1}));
  const Ran ran =
      files.diff({"small.png", "wide.png", "-o", "d.png", "--metric", "max", "--threshold", "9"});
  EXPECT_EQ(ran.status, 1);
  EXPECT_THAT(ran.out, HasSubstr("12 of 60 pixels differ"));
  const Image difference = glint::readImage(files / "d.png");
  EXPECT_EQ(difference.width, 10);
  EXPECT_GT(difference.row(3)[4 * 9], 0.05f);
}

TEST(DiffReports, MarkdownOfAMergeRequest) {
  const Files files("markdown");
  Image b = grey;
  b.values[0] = 1;
  write(files / "x/one|two_<b>.png", grey);
  write(files / "y/one|two_<b>.png", b);
  const Ran ran = files.diff({"x", "y", "--markdown", "-"});
  EXPECT_EQ(ran.status, 1);
  EXPECT_THAT(ran.out, HasSubstr("### Pictures: 1 differs\n"));
  EXPECT_THAT(ran.out, HasSubstr("| one\\|two\\_\\<b>.png | differs |"));
  EXPECT_THAT(ran.out, HasSubstr("`glint diff x y --update`"));
}

TEST(DiffReports, PicturesBesideThePage) {
  const Files files("beside");
  Image b = grey;
  b.values[0] = 1;
  write(files / "x/one.png", grey);
  write(files / "y/one.png", b);
  EXPECT_EQ(files.diff({"x", "y", "--html", "r.html", "--pictures-beside"}).status, 1);
  EXPECT_THAT(contents(files / "r.html.pictures/a0.js"), HasSubstr("picture('a0','iVBOR"));
  EXPECT_THAT(contents(files / "r.html"), Not(HasSubstr("id=\"a0\"")));
  EXPECT_EQ(files.diff({"x", "y", "--pictures-beside"}).status, 2);
}

}  // namespace diff_files_cli_test
