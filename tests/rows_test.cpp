// Large pictures, of which only a few rows are held at a time, compare like small ones.

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "glint/image/compare.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/picture_layers.h"
#include "glint/image/png_bytes.h"
#include "gltf_text.h"
#include "pictures.h"

namespace glint::test::rows_test {

using Bytes = std::vector<std::byte>;

/// More rows than are kept.
constexpr int width = 7, height = 2600;

std::vector<std::uint8_t> noise(int channels, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> codes(std::size_t(channels) * width * height);
  for (std::uint8_t& code : codes) code = std::uint8_t(random());
  return codes;
}

Bytes ppm(int largest, unsigned seed) {
  const std::string head = "P6 " + std::to_string(width) + " " + std::to_string(height) + " " +
                           std::to_string(largest) + "\n";
  const auto codes = noise(largest > 255 ? 6 : 3, seed);
  Bytes bytes(head.size() + codes.size());
  std::memcpy(bytes.data(), head.data(), head.size());
  std::memcpy(bytes.data() + head.size(), codes.data(), codes.size());
  return bytes;
}

Bytes pngOf16Bits() {
  const std::string path = glint::test::temporaryFolder() + "/sixteen.png";
  glint::PictureOptions options;
  options.bitDepth = 16;
  options.alpha = true;
  Image image{width, height, std::vector<float>(std::size_t(4) * width * height)};
  std::mt19937 random(3);
  for (std::size_t i = 0; i < image.values.size(); ++i)
    image.values[i] = i % 4 == 3 ? 1.0f : float(random() % 1000) / 999;
  writePicture(path, image, options);
  return glint::readFile(path);
}

StoredImage held(const Bytes& bytes) {
  return glint::decodePictureLayers(bytes, "a", "all").layers[0].image;
}

StoredImage byRows(const Bytes& bytes) {
  StoredImage image = glint::decodePictureLayers(bytes, "a", "all", 0).layers[0].image;
  EXPECT_TRUE(image.window);
  return image;
}

TEST(Rows, AreThoseOfTheWholePicture) {
  const Bytes files[] = {glint::pngOfRgb(noise(3, 1), width, height),
                         glint::pngOfRgba(noise(4, 2), width, height), pngOf16Bits(), ppm(255, 4),
                         ppm(999, 5)};
  for (const Bytes& file : files) {
    const StoredImage whole = held(file), rows = byRows(file);
    EXPECT_EQ(whole.values.index(), rows.values.index());
    EXPECT_EQ(whole.channels, rows.channels);
    const auto expectRows = [&](int first, int count) {
      std::vector<float> expected(std::size_t(4) * width * count), found(expected.size());
      for (const auto read :
           {&StoredImage::linearRows, &StoredImage::encodedRows, &StoredImage::storedRows}) {
        (whole.*read)(first, count, expected.data());
        (rows.*read)(first, count, found.data());
        EXPECT_EQ(expected, found) << first;
      }
    };
    expectRows(0, 3);
    expectRows(2000, 600);  // forwards, over a thousand rows
    expectRows(1900, 50);   // still kept
    expectRows(5, 1);       // from the beginning again
    expectRows(0, height);
  }
}

void expectSame(const Comparison& a, const Comparison& b) {
  EXPECT_EQ(a.values, b.values);
  EXPECT_EQ(a.differing, b.differing);
  EXPECT_EQ(a.alphaDiffering, b.alphaDiffering);
  EXPECT_EQ(a.failures, b.failures);
  EXPECT_EQ(a.worstText(), b.worstText());
  EXPECT_EQ(a.regions.size(), b.regions.size());
}

TEST(Rows, GiveTheSameComparison) {
  for (const int channels : {3, 4}) {
    auto codes = noise(channels, 7);
    const auto png = [&] {
      return channels == 3 ? glint::pngOfRgb(codes, width, height)
                           : glint::pngOfRgba(codes, width, height);
    };
    const Bytes a = png();
    for (std::size_t i = 0; i < codes.size(); i += 701) codes[i] ^= 0x55;
    const Bytes b = png();
    CompareOptions options;
    for (const std::string& name : glint::metricNames())
      if (name != "hdr-flip") options.metrics.push_back(name);
    options.regions = true;
    options.maxPixels = {{3}};
    for (const int kind : {0, 1, 2, 3}) {
      if (kind == 1) options.shift = 2;
      if (kind == 2) options.window = 40;
      if (kind == 3) options.ignored = {{1, 5, 3, 900}};
      options.flip.threads = 1 + 2 * kind;
      expectSame(compare(held(a), held(b), options), compare(byRows(a), byRows(b), options));
    }
  }
  // With different sizes, padded.
  const Bytes tall = glint::pngOfRgb(noise(3, 8), width, height),
              flat = glint::pngOfRgb(noise(3, 9), height, width);
  CompareOptions options;
  options.metrics = {"max", "pixels"};
  expectSame(compare(held(tall), held(flat), options),
             compare(byRows(tall), byRows(flat), options));
}

// Damage is found where it is, and no picture equals a truncated one.
TEST(Rows, DamageIsFound) {
  const Bytes whole = glint::pngOfRgb(noise(3, 1), width, height);
  for (const std::size_t less : {std::size_t(13), whole.size() / 2}) {
    const Bytes cut(whole.begin(), whole.end() - std::ptrdiff_t(less));
    EXPECT_THROW(compare(byRows(cut), byRows(whole)), glint::InputError) << less;
    EXPECT_THROW(compare(byRows(whole), byRows(cut)), glint::InputError) << less;
  }
}

}  // namespace glint::test::rows_test
