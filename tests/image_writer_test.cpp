#include "glint/image/picture_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>

#include "files.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/read_image.h"
#include "glint/image/srgb.h"

namespace glint::test::image_writer_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Writer : public ::testing::Test {
 protected:
  std::string in(const std::string& name) const { return folder_ / name; }

  /// Writes in bands of `band` rows; returns the number of NaN pixels.
  std::size_t save(const std::string& name, const glint::Image& image,
                   const glint::PictureOptions& options = {}, int band = 7) const {
    const auto writer = glint::openPictureWriter(in(name), image.width, image.height, options);
    for (int y = 0; y < image.height; y += band) {
      const int height = std::min(band, image.height - y);
      writer->write({image.width, height, {image.row(y), image.row(y + height)}});
    }
    writer->finish();
    return writer->nanPixels();
  }

  const Folder folder_{"writer"};
};

/// No two rows, columns or channels equal; premultiplied, values from 0 to 1, 10 % of them above.
glint::Image example(int width, int height, bool alpha = false) {
  glint::Image image{width, height, std::vector<float>(std::size_t(4) * width * height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      float* pixel = image.row(y) + 4 * x;
      pixel[3] = alpha ? (static_cast<float>(x % 4) + 1) / 4 : 1;
      for (int channel = 0; channel < 3; ++channel) {
        const int code = 37 * x + 101 * y + 71 * channel;
        pixel[channel] = pixel[3] * static_cast<float>(code % 281) / 255;
      }
    }
  }
  return image;
}

TEST_F(Writer, PngOf8BitsHoldsTheCodes) {
  const glint::Image image = example(33, 100);
  glint::PictureOptions options;
  options.exposureScale = 0.5f;
  EXPECT_EQ(save("a.png", image, options), 0u);
  const glint::Image read = glint::readImage(in("a.png"));
  ASSERT_EQ(read.width, 33);
  ASSERT_EQ(read.height, 100);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const float expected =
        i % 4 == 3 ? 1 : glint::decodeSrgb8(glint::encodeSrgb8(image.values[i] * 0.5f));
    ASSERT_EQ(read.values[i], expected) << i;
  }
}

TEST_F(Writer, PngOf16BitsIsWithinHalfACode) {
  const glint::Image image = example(33, 100);
  glint::PictureOptions options;
  options.bitDepth = 16;
  save("a.png", image, options);
  const glint::Image read = glint::readImage(in("a.png"));
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const float x = std::min(image.values[i], 1.0f);
    // Half a code times the steepest slope of the curve, 2.4 / 1.055, and the float's rounding.
    ASSERT_NEAR(read.values[i], x, 0.5 / 65535 * 2.4 / 1.055 + 6e-8) << i;
  }
}

TEST_F(Writer, PngWithAlphaIsStraightInTheFile) {
  const glint::Image image = example(32, 40, true);
  for (const int depth : {8, 16}) {
    glint::PictureOptions options;
    options.bitDepth = depth;
    options.alpha = true;
    save("a.png", image, options);
    const glint::Image read = glint::readImage(in("a.png"));
    const double code = depth == 8 ? 1 / 255.0 : 1 / 65535.0;
    for (std::size_t i = 0; i < image.values.size(); ++i) {
      const float alpha = image.values[i / 4 * 4 + 3];
      const float x = std::min(image.values[i], alpha);
      ASSERT_NEAR(read.values[i], x, code * 0.5 * (1 + 2.4 / 1.055) + 6e-8) << i;
    }
  }
}

TEST_F(Writer, PngWithoutAlphaIsThePictureOverBlack) {
  save("a.png", {1, 1, {0.5f, 0.25f, 0, 0.5f}});
  EXPECT_EQ(glint::readImage(in("a.png")).values[0], glint::decodeSrgb8(188));
}

TEST_F(Writer, PngSaysSrgbAndHasTheTexts) {
  glint::PictureOptions options;
  options.text = {{"Software", "glint"}, {"Comment", "caf\xc3\xa9"}};
  save("a.png", example(3, 3), options);
  const auto bytes = glint::readFile(in("a.png"));
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_THAT(text, HasSubstr(std::string("sRGB\0", 5)));
  EXPECT_THAT(text, HasSubstr(std::string("tEXtSoftware\0glint", 18)));
  EXPECT_THAT(text, HasSubstr("iTXtComment"));
  EXPECT_THAT(text, HasSubstr("caf\xc3\xa9"));
  options.text = {{std::string(80, 'k'), ""}};
  EXPECT_THROW(save("b.png", example(3, 3), options), glint::Error);
}

TEST_F(Writer, PfmIsLinearLittleEndianAndBottomUp) {
  glint::PictureOptions options;
  options.exposureScale = 8;  // ignored for PFM
  save("a.pfm", {1, 2, {0.5f, -1, 2, 1, 3, 4, 5, 0.5f}}, options, 1);
  const auto bytes = glint::readFile(in("a.pfm"));
  const std::string header = "PF\n1 2\n-1.0\n";
  ASSERT_EQ(bytes.size(), header.size() + 24);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), header.size()), header);
  const std::vector<std::byte> first(bytes.begin() + 12, bytes.begin() + 16);
  EXPECT_EQ(first, (std::vector<std::byte>{std::byte(0), std::byte(0), std::byte(0x40),
                                           std::byte(0x40)}));  // 3.0f of the lower row
}

TEST_F(Writer, PfmComesBackBitForBit) {
  const glint::Image image = example(5, 131);
  save("a.PFM", image, {}, 50);
  EXPECT_EQ(glint::readImage(in("a.PFM")).values, image.values);
}

TEST_F(Writer, NanPixelsAreCountedInEveryFormat) {
  glint::Image image = example(100, 100);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  image.values[0] = image.values[1] = nan;
  image.values[4 * 7777 + 2] = nan;
  glint::PictureOptions deep;
  deep.bitDepth = 16;
  EXPECT_EQ(save("a.png", image), 2u);
  EXPECT_EQ(save("b.png", image, deep), 2u);
  EXPECT_EQ(save("c.pfm", image), 2u);
  EXPECT_TRUE(std::isnan(glint::readImage(in("c.pfm")).values[1]));
}

TEST_F(Writer, UnfinishedPicturesLeaveNothing) {
  for (const char* name : {"a.png", "a.pfm"}) {
    const auto writer = glint::openPictureWriter(in(name), 100, 200);
    writer->write(example(100, 150));
    EXPECT_THROW(writer->finish(), glint::Error);
    EXPECT_THROW(writer->write(example(100, 51)), glint::Error);
    EXPECT_THROW(writer->write(example(99, 10)), glint::Error);
  }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(Writer, FullDiskIsReported) {
  fs::create_symlink("/dev/full", in("full.png"));
  fs::create_symlink("/dev/full", in("full.pfm"));
  for (const char* name : {"full.png", "full.pfm"}) {
    EXPECT_THAT(messageOf([&] { save(name, example(2000, 300)); }),
                HasSubstr("No space left on device"))
        << name;
  }
}

TEST_F(Writer, EndingsAndSizesThatDoNotWorkAreRefused) {
  const auto open = [&](const std::string& name, int width = 1, int height = 1, int depth = 8) {
    glint::PictureOptions options;
    options.bitDepth = depth;
    return messageOf([&] { glint::openPictureWriter(in(name), width, height, options); });
  };
  EXPECT_THAT(open("a.bmp"), HasSubstr("BMP cannot be written: use .png, .jpg"));
  EXPECT_THAT(open("png"), HasSubstr(".exr or .pfm"));
  EXPECT_THAT(open("a.xyz"), HasSubstr("is not that of a known format"));
  EXPECT_THAT(open("a.jpg", 65501), HasSubstr("JPEG has at most 65500 pixels per side"));
  EXPECT_THAT(open("a.webp", 1, 16384), HasSubstr("WebP has at most 16383 pixels per side"));
  for (const int quality : {0, 101, -1}) {
    glint::PictureOptions options;
    options.quality = quality;
    EXPECT_THAT(messageOf([&] { glint::openPictureWriter(in("a.jpg"), 1, 1, options); }),
                HasSubstr("from 1 to 100"));
  }
  EXPECT_THAT(open("a.png", 0), HasSubstr("0 x 1"));
  EXPECT_THAT(open("a.png", 1, -5), HasSubstr("1 x -5"));
  EXPECT_THAT(open("a.png", 1, 1, 12), HasSubstr("8 or 16"));
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

// A smooth picture, as produced by shading.
glint::Image smooth(int width, int height, bool alpha) {
  glint::Image image{width, height, std::vector<float>(std::size_t(4) * width * height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      float* pixel = image.row(y) + 4 * x;
      const float u = float(x) / float(width), v = float(y) / float(height);
      pixel[3] = alpha ? 0.25f + 0.75f * u : 1;
      pixel[0] = pixel[3] * u;
      pixel[1] = pixel[3] * v;
      pixel[2] = pixel[3] * (1 - u) * v;
    }
  }
  return image;
}

double meanDifference(const glint::Image& a, const glint::Image& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    sum += std::abs(double(a.values[i]) - double(b.values[i]));
  return sum / double(a.values.size());
}

// The picture read back is close: about a code and a half off at the default quality, far more at
// the lowest, which gives a smaller file.
TEST_F(Writer, JpegAndWebpAreNearThePicture) {
  const glint::Image image = smooth(67, 45, false);
  for (const std::string name : {"a.jpg", "a.JPEG", "a.webp"}) {
    glint::PictureOptions options;
    EXPECT_EQ(save(name, image, options), 0u);
    const double near = meanDifference(glint::readImage(in(name)), image);
    EXPECT_LT(near, 0.01) << name;
    const auto size = fs::file_size(in(name));
    options.quality = 1;
    save(name, image, options);
    EXPECT_GT(meanDifference(glint::readImage(in(name)), image), 2 * near) << name;
    EXPECT_LT(fs::file_size(in(name)), size / 2) << name;
  }
  // NaN is counted; exposure is applied.
  glint::Image one{1, 1, {NAN, 0, 0, 1}};
  EXPECT_EQ(save("b.jpg", one), 1u);
  EXPECT_EQ(save("b.webp", one), 1u);
  glint::PictureOptions dark;
  dark.exposureScale = 0.25f;
  save("c.jpg", image, dark);
  EXPECT_GT(meanDifference(glint::readImage(in("c.jpg")), image), 0.1);
}

TEST_F(Writer, WebpOfQuality100IsThePng) {
  for (const bool alpha : {false, true}) {
    glint::PictureOptions options;
    options.quality = 100;
    options.alpha = alpha;
    const glint::Image image = example(33, 20, alpha);
    save("a.webp", image, options);
    save("a.png", image, options);
    EXPECT_EQ(glint::readImage(in("a.webp")).values, glint::readImage(in("a.png")).values);
  }
}

TEST_F(Writer, AlphaIsInTheWebpAndNotInTheJpeg) {
  const glint::Image image = smooth(64, 32, true);
  glint::PictureOptions options;
  options.alpha = true;
  save("a.webp", image, options);
  EXPECT_LT(meanDifference(glint::readImage(in("a.webp")), image), 0.01);
  save("a.jpg", image, options);
  glint::Image overBlack = image;
  for (std::size_t i = 3; i < overBlack.values.size(); i += 4) overBlack.values[i] = 1;
  EXPECT_LT(meanDifference(glint::readImage(in("a.jpg")), overBlack), 0.01);
}

TEST_F(Writer, RawHasAHeaderAndTheFloats) {
  glint::Image image = example(5, 9, true);
  image.values[7] = -0.25f;
  image.values[8] = 1e30f;
  for (const bool alpha : {false, true}) {
    glint::PictureOptions options;
    options.alpha = alpha;
    options.exposureScale = 8;  // ignored
    options.format = &glint::pictureFormat(glint::PictureFormat::Id::raw);
    save("a.png", image, options, 4);
    const auto bytes = glint::readFile(in("a.png"));
    const std::size_t channels = alpha ? 4 : 3;
    ASSERT_EQ(bytes.size(), 16 + 4 * channels * 45);
    const auto word = [&](std::size_t i) {
      std::uint32_t value = 0;
      for (std::size_t k = 4; k-- > 0;) value = value << 8 | std::uint32_t(bytes[4 * i + k]);
      return value;
    };
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), 4), "GLNT");
    EXPECT_EQ(word(1), 5u);
    EXPECT_EQ(word(2), 9u);
    EXPECT_EQ(word(3), channels);
    for (std::size_t i = 0; i < 45; ++i)
      for (std::size_t c = 0; c < channels; ++c)
        ASSERT_EQ(std::bit_cast<float>(word(4 + channels * i + c)), image.values[4 * i + c]);
  }
}

TEST(PictureFormats, AreToldByEndingsAndBytes) {
  using glint::PictureFormat;
  const auto of = [](const char* path) {
    const PictureFormat* format = glint::pictureFormatOf(path);
    return format ? std::string(format->name) : "none";
  };
  EXPECT_EQ(of("a/b.Png"), "PNG");
  EXPECT_EQ(of("a.jpeg"), "JPEG");
  EXPECT_EQ(of("a.JPG"), "JPEG");
  EXPECT_EQ(of("a.png/b"), "none");
  EXPECT_EQ(of("png"), "none");
  EXPECT_EQ(of("a."), "none");
  EXPECT_EQ(of("a.raw"), "none");
  for (const PictureFormat& each : glint::pictureFormats()) {
    EXPECT_EQ(glint::pictureFormatNamed(each.name), &each);
    for (const std::string_view ending : each.endings)
      if (!ending.empty()) {
        EXPECT_EQ(glint::pictureFormatOf("x" + std::string(ending)), &each);
      }
  }
  EXPECT_EQ(glint::pictureFormatNamed("jpg"), glint::pictureFormatNamed("jpeg"));
  EXPECT_EQ(glint::pictureFormatNamed(""), nullptr);
}

// The bytes written are those of the format requested.
TEST_F(Writer, WritesTheFormatThatIsAskedFor) {
  const glint::Image image = example(8, 8);
  for (const glint::PictureFormat& each : glint::pictureFormats()) {
    if (!each.isWritten || each.id == glint::PictureFormat::Id::raw) continue;
    glint::PictureOptions options;
    options.format = &each;
    save("a.gif", image, options);
    EXPECT_EQ(glint::pictureFormatIn(glint::readFile(in("a.gif"))), &each) << each.name;
  }
}

TEST_F(Writer, MinusIsAPngOnStandardOutput) {
  const glint::Image image = example(20, 20);
  save("a.png", image);
  std::fflush(stdout);
  const int saved = ::dup(STDOUT_FILENO);
  std::FILE* file = std::fopen(in("out").c_str(), "w");
  ASSERT_NE(file, nullptr);
  ::dup2(::fileno(file), STDOUT_FILENO);
  const auto writer = glint::openPictureWriter("-", 20, 20);
  writer->write(image);
  writer->finish();
  ::dup2(saved, STDOUT_FILENO);
  ::close(saved);
  std::fclose(file);
  EXPECT_EQ(glint::readFile(in("out")), glint::readFile(in("a.png")));
}

}  // namespace glint::test::image_writer_test
