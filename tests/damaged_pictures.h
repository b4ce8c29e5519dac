#pragma once

// Randomly damaged pictures: a few in everyday runs, many under the label "long".

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "glint/image/error.h"
#include "glint/image/exr_writer.h"
#include "glint/image/file.h"
#include "glint/image/read_image.h"
#include "gltf_text.h"

namespace glint::test {

/// Truncated and damaged copies give a picture or a one-line error. Bytes before `first` are not
/// damaged.
inline void expectSurvived(const std::vector<std::byte>& bytes, unsigned seed, int rounds,
                           std::size_t first = 0) {
  std::mt19937 random(seed);
  int refused = 0;
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::byte> damaged = bytes;
    if (round % 3 == 0) damaged.resize(random() % bytes.size());
    for (std::size_t flips = random() % 6; flips > 0 && !damaged.empty(); --flips) {
      const std::size_t near =
          random() % 2 == 0 ? std::min<std::size_t>(400, damaged.size()) : damaged.size();
      const std::size_t at = random() % near;
      if (at >= first) damaged[at] = std::byte(random() % 3 == 0 ? 255 : random() % 256);
    }
    try {
      const Image image = decodeImage(damaged, "test");
      ASSERT_EQ(image.values.size(), std::size_t(4) * image.width * image.height);
    } catch (const InputError& error) {
      ++refused;
      ASSERT_THAT(error.what(), ::testing::Not(::testing::HasSubstr("\n")));
    }
  }
  EXPECT_GT(refused, rounds / 10);
}

/// An OpenEXR file with two layers. If the header is damaged too, many copies claim to be large,
/// which takes time.
inline void expectExrSurvived(int rounds, bool headerToo) {
  Image image{20, 20, std::vector<float>(std::size_t(4) * 20 * 20)};
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = float(i) * 0.123f;
  const ExrLayer layers[] = {{"", &image, "RGBA"}, {"z", &image, "Z"}};
  const std::string path = temporaryFolder() + "/damaged.exr";
  writeExr(path, layers, {{"look", "x"}});
  expectSurvived(readFile(path), 1, rounds, headerToo ? 0 : 400);
}

/// A Radiance file of three rows in runs.
inline void expectHdrSurvived(int rounds) {
  std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nSOFTWARE=test\n\n-Y 3 +X 10\n";
  for (int row = 0; row < 3; ++row) {
    text += std::string("\2\2\0\12", 4);
    for (int channel = 0; channel < 4; ++channel) text += "\x88\x80\2\x80\x80";
  }
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  expectSurvived({bytes.begin(), bytes.end()}, 2, rounds);
}

}  // namespace glint::test
