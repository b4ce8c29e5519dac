#include "glint/image/picture_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/read_image.h"
#include "glint/image/srgb.h"

namespace image_writer_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Writer : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = fs::temp_directory_path() / "glint-writer-XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string in(const std::string& name) const { return folder_ / name; }

  /// Writes in bands of `band` rows; the number of NaN pixels.
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

  fs::path folder_;
};

/// No two rows, columns or channels alike; premultiplied, values from 0 to 1, 10 % of them above.
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

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const glint::InputError& error) {
    return error.what();
  }
  return "no error";
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
  options.exposureScale = 8;  // not for PFM
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
  EXPECT_TRUE(fs::is_empty(folder_));
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
  EXPECT_THAT(open("a.jpg"), HasSubstr("use .png, .exr or .pfm"));
  EXPECT_THAT(open("png"), HasSubstr("use .png, .exr or .pfm"));
  EXPECT_THAT(open("a.png", 0), HasSubstr("0 x 1"));
  EXPECT_THAT(open("a.png", 1, -5), HasSubstr("1 x -5"));
  EXPECT_THAT(open("a.png", 1, 1, 12), HasSubstr("8 or 16"));
  EXPECT_TRUE(fs::is_empty(folder_));
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

}  // namespace image_writer_test
