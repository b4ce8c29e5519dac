// Which contents of files `glint diff` compares, and how pairs in folders are judged.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "command.h"
#include "glint/image/exr_writer.h"
#include "glint/image/read_image.h"
#include "pictures.h"

namespace glint::test::diff_files_cli_test {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

Image filled(int width, int height, std::initializer_list<float> pixel) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    image.values.insert(image.values.end(), pixel.begin(), pixel.end());
  return image;
}

void write(const std::string& path, const Image& image) { writePicture(path, image); }

class Files : public Folder {
 public:
  using Folder::Folder;
  Ran diff(const std::string& arguments) const { return runGlintIn(*this, "diff " + arguments); }
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

  EXPECT_EQ(files.diff("a.exr a.exr").status, 0);
  Ran ran = files.diff("a.exr moved.exr");
  EXPECT_EQ(ran.status, 1);
  EXPECT_THAT(ran.out, HasSubstr("layer normal.X"));
  ran = files.diff("a.exr deeper.exr --metric max --threshold 0.1");
  EXPECT_EQ(ran.status, 1);
  EXPECT_THAT(ran.out, HasSubstr("depth.Z"));
  EXPECT_EQ(files.diff("xyz.exr xyz2.exr").status, 1);
  // A layer that only one of them has is a difference.
  ran = files.diff("a.exr less.exr");
  EXPECT_EQ(ran.status, 1);
  EXPECT_THAT(ran.out, HasSubstr("layer depth.Z is missing in the picture"));
  // One layer by its name; differences that the condition does not judge are reported.
  EXPECT_EQ(files.diff("a.exr moved.exr --layer depth").status, 0);
  EXPECT_EQ(files.diff("a.exr moved.exr --layer normal").status, 1);
  ran = files.diff("a.exr moved.exr --layer main");
  EXPECT_EQ(ran.status, 0);
  EXPECT_THAT(ran.out, HasSubstr("not compared: layer "));
  EXPECT_EQ(files.diff("a.exr moved.exr --layer nothing").status, 2);
  ran = files.diff("a.exr moved.exr --metric flip --threshold 0.1");
  EXPECT_EQ(ran.status, 0);
  EXPECT_THAT(ran.out, HasSubstr("which no condition judges"));
  // If nothing is judged, nothing counts as the same.
  for (const std::string condition : {" --max-pixels 100%", " --metric flip --threshold 1"}) {
    ran = files.diff("xyz.exr xyz2.exr" + condition);
    EXPECT_EQ(ran.status, 1);
    EXPECT_THAT(ran.out, HasSubstr("it differs in 1 pixel (max 0.5), which no condition judges"));
    EXPECT_EQ(files.diff("xyz.exr xyz.exr" + condition).status, 0);
  }
}

TEST(DiffLayers, EqualInfinitiesAreEqual) {
  const Files files("infinities");
  Image a = grey, b = grey;
  a.values[0] = b.values[0] = INFINITY;
  b.values[5] += 0.001f;
  write(files / "a.exr", a);
  write(files / "b.exr", b);
  EXPECT_EQ(files.diff("a.exr b.exr --metric max --threshold 0.01").status, 0);
  b.values[0] = -INFINITY;
  write(files / "b.exr", b);
  EXPECT_EQ(files.diff("a.exr b.exr --metric max --threshold 1e9").status, 1);
  for (float& value : a.values) value = NAN;
  write(files / "nan.exr", a);
  const Ran ran = files.diff("nan.exr nan.exr --json -");
  EXPECT_EQ(ran.status, 0);
  EXPECT_TRUE(Json::parse(ran.out)["metrics"]["max"]["value"].is_null()) << ran.out;
}

TEST(DiffLayers, PremultipliedColoursAreComparedAsStored) {
  const Files files("premultiplied");
  Image a = filled(4, 4, {1e-5f, 0, 0, 1e-5f}), b = filled(4, 4, {1.1e-4f, 0, 0, 1e-5f});
  write(files / "a.exr", a);
  write(files / "b.exr", b);
  for (const char* alpha : {"straight", "ignored"}) {
    const Ran ran =
        files.diff(std::string("a.exr b.exr --metric max --threshold 1.1e-4 --alpha ") + alpha);
    EXPECT_EQ(ran.status, 0) << alpha << ": " << ran.out;
  }
}

TEST(DiffConditions, AllMustHold) {
  const Files files("all");
  Image b = grey;
  for (int i = 0; i < 4; ++i) b.values[std::size_t(4 * i)] = 1;
  write(files / "a.png", grey);
  write(files / "b.png", b);
  EXPECT_EQ(files.diff("a.png b.png --max-pixels 4 --max-pixels 5%").status, 1);
  EXPECT_EQ(files.diff("a.png b.png --max-pixels 5% --max-pixels 4").status, 1);
  EXPECT_EQ(files.diff("a.png b.png --max-pixels 4 --max-pixels 9%").status, 0);
  // The worst window of 2 x 2 has two.
  EXPECT_EQ(files.diff("a.png b.png --window 2 --max-pixels 2").status, 0);
  EXPECT_EQ(files.diff("a.png b.png --window 2 --max-pixels 1").status, 1);
  // A percentage refers to the window: two of four.
  EXPECT_EQ(files.diff("a.png b.png --window 2 --max-pixels 50%").status, 0);
  EXPECT_THAT(files.diff("a.png b.png --window 2 --max-pixels 49%").out,
              HasSubstr("2 pixels are over the tolerance of 0.1, the limit is 1.96"));
  // Options that need a count are not silently ignored.
  for (const std::string option : {"--window 2", "--shift 1", "--ignore-anti-aliasing"}) {
    EXPECT_THAT(files.diff("a.png b.png " + option).err,
                HasSubstr(split(option)[0] + ": it modifies --max-pixels"));
    EXPECT_EQ(files.diff("a.png b.png " + option + " --metric pixels --threshold 4").status, 0);
  }
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
  EXPECT_EQ(files.diff("a.png b.png --max-pixels 0").status, 1);
  EXPECT_EQ(files.diff("a.png b.png --max-pixels 0 --shift 1").status, 0);
  EXPECT_EQ(files.diff("a.png b.png --shift 1").status, 2);
}

TEST(DiffConditions, OfPairsByAFile) {
  const Files files("conditions");
  Image b = grey;
  b.values[0] = 1;
  for (const char* name : {"loose/one.png", "strict/one.png", "two.png"}) {
    write(files / ("x/" + std::string(name)), grey);
    write(files / ("y/" + std::string(name)), b);
  }
  writeText(files / "x/glint-diff.txt", "# pattern and options\nloose --max-pixels 1\n*.png\n");
  Ran ran = files.diff("x y");
  EXPECT_THAT(ran.out, HasSubstr("3 pairs: 0 same, 3 differ"));  // the last matching line counts
  writeText(files / "x/glint-diff.txt", "*.png\n\nloose --max-pixels 1\r\n");
  ran = files.diff("x y");
  EXPECT_THAT(ran.out, HasSubstr("3 pairs: 1 same, 2 differ"));
  writeText(files / "other.txt", "*o.png --metric max --threshold 1\n");
  EXPECT_THAT(files.diff("x y --conditions other.txt").out, HasSubstr("3 pairs: 1 same, 2 differ"));
  writeText(files / "other.txt", "\n*o.png --metric most\n");
  ran = files.diff("x y --conditions other.txt");
  EXPECT_EQ(ran.status, 2);
  writeText(files / "other.txt", "\n*o.png --threshold 1\n");
  EXPECT_THAT(files.diff("x y --conditions other.txt").err, HasSubstr("other.txt:2: "));
  // Updating by a folder and by a pattern; pruning.
  EXPECT_THAT(files.diff("x y --update strict").err,
              HasSubstr("replaced the baseline x/strict/one.png"));
  EXPECT_THAT(files.diff("x y --update t*.png").err, HasSubstr("replaced the baseline x/two.png"));
  write(files / "x/gone.png", grey);
  EXPECT_EQ(files.diff("x y").status, 2);
  EXPECT_THAT(files.diff("x y --prune").err, HasSubstr("removed the baseline x/gone.png"));
  EXPECT_EQ(files.diff("x y").status, 0);
}

TEST(DiffConditions, MasksPatternsAndWhatNamesNoPair) {
  const Files files("masks");
  Image b = grey, mask = filled(8, 6, {1, 1, 1, 1});
  b.values[0] = 1;
  for (int c = 0; c < 3; ++c) mask.values[std::size_t(c)] = 0;
  for (const char* name : {"one.png", "[o]ne.png"}) {
    write(files / ("x/" + std::string(name)), grey);
    write(files / ("y/" + std::string(name)), b);
  }
  write(files / "x/masks/clock.png", mask);
  // The mask in A is neither missing nor pruned; an exact name takes precedence over a pattern.
  writeText(files / "x/glint-diff.txt",
            "[o]ne.png --mask masks/clock.png\none.png --max-pixels 1\nnone.png --max-pixels 3\n");
  Ran ran = files.diff("x y --prune");
  EXPECT_EQ(ran.status, 0) << ran.out;
  EXPECT_THAT(ran.out, HasSubstr("2 pairs: 2 same"));
  EXPECT_EQ(ran.err, "glint: x/glint-diff.txt:3: none.png: names no pair: check the pattern\n");
  EXPECT_EQ(contents(files / "x/masks/clock.png").substr(1, 3), "PNG");
  writeText(files / "none.txt", "");
  EXPECT_EQ(files.diff("x y --mask x/masks/clock.png --conditions none.txt").status, 0);
  // The same with --update.
  std::filesystem::remove(files / "x/glint-diff.txt");
  std::filesystem::remove_all(files / "x/masks");
  EXPECT_EQ(files.diff("x y --update [o]ne.png").err, "glint: replaced the baseline x/[o]ne.png\n");
  write(files / "x/-one.png", grey);
  write(files / "y/-one.png", b);
  EXPECT_EQ(files.diff("x y --update ./-one.png").err, "glint: replaced the baseline x/-one.png\n");
  EXPECT_EQ(files.diff("x y --update [o]ne*").err, "glint: replaced the baseline x/one.png\n");
  write(files / "x/gone.png", grey);
  EXPECT_THAT(files.diff("x y --prune").out, HasSubstr("; 1 baseline removed\n"));
  // For single pictures these options have no meaning.
  for (const std::string option : {"--prune", "--conditions none.txt"})
    EXPECT_THAT(files.diff("x/one.png y/one.png " + option).err, HasSubstr(split(option)[0]));
}

TEST(DiffBaselines, TheNearestCounts) {
  const Files files("nearest");
  Image b = grey;
  b.values[0] = 1;
  write(files / "x/one.png", grey);
  write(files / "x/one_1.png", b);
  write(files / "y/one.png", b);
  const Ran ran = files.diff("x y");
  EXPECT_EQ(ran.status, 0) << ran.out;
  EXPECT_THAT(ran.out, HasSubstr("1 pair: 1 same"));
  EXPECT_EQ(files.diff("x/one.png y/one.png").status, 0);
  // If it has a picture of its own, it is a pair.
  write(files / "y/one_1.png", b);
  EXPECT_THAT(files.diff("x y").out, HasSubstr("2 pairs: 1 same, 1 differ"));
}

TEST(DiffSizes, LongSidesAndOtherSizes) {
  const Files files("sizes");
  Image a = filled(2, 23046, {0.5f, 0.5f, 0.5f, 1}), b = a;
  b.values[std::size_t(4 * 2 * 20000)] = 0;
  write(files / "a.png", a);
  write(files / "b.png", b);
  EXPECT_EQ(files.diff("a.png a.png").status, 0);
  EXPECT_THAT(files.diff("a.png b.png").out, HasSubstr("worst at 0,20000"));
  // With different sizes the rest counts as transparent, also in the difference picture.
  write(files / "small.png", grey);
  write(files / "wide.png", filled(10, 6, {0.25f, 0.5f, 0.75f, 1}));
  const Ran ran = files.diff("small.png wide.png -o d.png --metric max --threshold 9");
  EXPECT_EQ(ran.status, 1);
  EXPECT_THAT(ran.out, HasSubstr("12 of 60 pixels differ"));
  const Image difference = glint::readImage(files / "d.png");
  EXPECT_EQ(difference.width, 10);
  EXPECT_GT(difference.row(3)[4 * 9], 0.05f);
}

// Pages larger than 64 MiB are read by rows: memory stays below that of one page (83 MB).
TEST(DiffSizes, LargePagesAreNotHeld) {
  const Files files("pages");
  constexpr int width = 1200, height = 23046;
  for (const char* name : {"a.png", "b.png", "longer.png"}) {
    const int rows = height + 4 * (name[0] == 'l');
    const auto writer = glint::openPictureWriter(files / name, width, rows);
    Image row = filled(width, 1, {0.25f, 0.5f, 0.75f, 1});
    for (int y = 0; y < rows; ++y) {
      row.values[std::size_t(4 * (y % width))] = 0.9f;
      float& one = row.values[4 * 7 + 1];
      const float green = std::exchange(one, name[0] == 'b' && y == 20000 ? 0 : one);
      writer->write(row);
      one = green;
    }
    writer->finish();
  }
  const auto expectSmall = [](const Ran& ran) { EXPECT_LT(ran.peakKib, 60 << 10) << ran.out; };
  Ran ran = files.diff("a.png b.png");
  EXPECT_THAT(ran.out,
              HasSubstr("1 of 27655200 pixels differ (1 pixel differs); worst at 7,20000"));
  expectSmall(ran);
  ran = files.diff("a.png b.png --max-pixels 1 -o d.png");
  EXPECT_EQ(ran.status, 0) << ran.out;
  expectSmall(ran);
  ran = files.diff("a.png longer.png");
  EXPECT_THAT(ran.out, HasSubstr("4800 of 27660000 pixels differ"));
  expectSmall(ran);
  // A damaged picture does not become a baseline, wherever the damage is.
  const std::string whole = contents(files / "b.png");
  writeText(files / "cut.png", whole.substr(0, whole.size() - 20));
  EXPECT_EQ(files.diff("a.png cut.png --update").status, 2);
  EXPECT_EQ(files.diff("cut.png cut.png --update").status, 2);
  ran = files.diff("new.png cut.png --update");
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.err, HasSubstr("cut.png: the PNG is damaged"));
  EXPECT_THAT(files.names(), Not(testing::Contains("new.png")));
  EXPECT_NE(contents(files / "a.png"), contents(files / "cut.png"));
}

TEST(DiffInput, FromStdin) {
  const Files files("stdin");
  Image b = grey;
  b.values[0] = 1;
  write(files / "a.png", grey);
  write(files / "b.png", b);
  write(files / "a.exr", grey);
  const auto piped = [&](const std::string& input, const std::string& arguments) {
    return runGlint(split("diff " + arguments), {.folder = files.path(), .input = files / input});
  };
  EXPECT_THAT(piped("a.png", "a.png -").out, HasSubstr("stdin: same, equal in every pixel"));
  EXPECT_EQ(piped("a.png", "- a.png").status, 0);
  EXPECT_EQ(piped("a.exr", "a.exr -").status, 0);
  const Ran ran = piped("b.png", "a.png - --json - --html r.html");
  EXPECT_EQ(ran.status, 1);
  EXPECT_EQ(Json::parse(ran.out)["differing"], 1);
  EXPECT_THAT(contents(files / "r.html"), HasSubstr("id=\"b0\""));
  EXPECT_EQ(piped("b.png", "- a.png -o d.png --max-pixels 1").status, 0);
  // All baselines are tried.
  write(files / "a_1.png", b);
  EXPECT_THAT(piped("b.png", "a.png -").out, HasSubstr("compared with a_1.png"));
  EXPECT_THAT(piped("b.png", "- -").err, HasSubstr("only one of the two can come from stdin"));
  EXPECT_EQ(piped("b.png", "a.png - --update").status, 2);
  EXPECT_EQ(piped("b.png", "- a.png --update").status, 2);
  EXPECT_THAT(piped("/dev/null", "a.png -").err, HasSubstr("stdin: "));
  EXPECT_EQ(files.diff("a.png -").status, 2);
  EXPECT_THAT(files.names(), Not(testing::Contains("-")));
}

TEST(DiffReports, MarkdownOfAMergeRequest) {
  const Files files("markdown");
  Image b = grey;
  b.values[0] = 1;
  write(files / "x/one|two_<b>&$.png", grey);
  write(files / "y/one|two_<b>&$.png", b);
  const Ran ran = files.diff("x y --markdown -");
  EXPECT_EQ(ran.status, 1);
  EXPECT_THAT(ran.out, HasSubstr("### Pictures: 1 differs\n"));
  EXPECT_THAT(ran.out, HasSubstr("| one\\|two\\_\\<b>\\&\\$.png | differs |"));
  EXPECT_THAT(ran.out, HasSubstr("`glint diff x y --update`"));
}

TEST(DiffPicture, OnStdoutAndBesideThePage) {
  const Files files("stdout");
  Image b = grey;
  b.values[0] = 1;
  write(files / "a.png", grey);
  write(files / "b.png", b);
  // Nothing except the picture is written to stdout.
  for (const std::string kind : {"flip", "absolute"}) {
    ASSERT_EQ(files.diff("a.png b.png -o d.png --difference " + kind).status, 1);
    const Ran ran = files.diff("a.png b.png -o - --difference " + kind);
    EXPECT_EQ(ran.status, 1) << ran.err;
    EXPECT_EQ(ran.out, contents(files / "d.png"));
  }
  // The page has its own map, because JPEG would change its colours and |a - b| is another picture.
  const auto mapOf = [&](const std::string& output) {
    const std::string kind = output == "a.jpg" ? "absolute" : "flip";
    EXPECT_EQ(files.diff("a.png b.png --html r.html --difference " + kind + " -o " + output).status,
              1);
    const std::string page = contents(files / "r.html"), begin = "id=\"m0\">";
    const auto at = page.find(begin);
    return page.substr(at, page.find('<', at) - at);
  };
  EXPECT_THAT(mapOf("d.png"), HasSubstr("iVBOR"));
  for (const char* output : {"d.jpg", "a.jpg", "d.exr", "-"})
    EXPECT_EQ(mapOf(output), mapOf("d.png"));
}

TEST(DiffReports, PicturesBesideThePage) {
  const Files files("beside");
  Image b = grey;
  b.values[0] = 1;
  write(files / "x/one.png", grey);
  write(files / "y/one.png", b);
  EXPECT_EQ(files.diff("x y --html r.html --pictures-beside").status, 1);
  EXPECT_THAT(contents(files / "r.html.pictures/a0.js"), HasSubstr("picture('a0','iVBOR"));
  EXPECT_THAT(contents(files / "r.html"), Not(HasSubstr("id=\"a0\"")));
  EXPECT_EQ(files.diff("x y --pictures-beside").status, 2);
}

}  // namespace glint::test::diff_files_cli_test
