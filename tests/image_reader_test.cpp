#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <random>

#include "files.h"
#include "glint/image/error.h"
#include "glint/image/read_image.h"
#include "glint/image/srgb.h"
#include "glint/image/texture.h"
#include "jpeg.h"

namespace glint::test::image_reader_test {

using Bytes = std::vector<std::byte>;
using ::testing::HasSubstr;
using ::testing::Not;

void append32(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift);
}

std::uint32_t crcOf(std::string_view text) {
  std::uint32_t crc = ~0u;
  for (const char letter : text) {
    crc ^= static_cast<unsigned char>(letter);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return ~crc;
}

std::string chunk(const std::string& type, const std::string& data) {
  std::string out;
  append32(out, static_cast<std::uint32_t>(data.size()));
  out += type + data;
  append32(out, crcOf(type + data));
  return out;
}

/// A PNG built from the filtered rows of the file (at most 65535 bytes).
Bytes makePng(std::uint32_t width, std::uint32_t height, int depth, int type,
              const std::string& rows, const std::string& ancillary = "", bool interlaced = false) {
  std::string header;
  append32(header, width);
  append32(header, height);
  for (const int value : {depth, type, 0, 0, int(interlaced)}) header += static_cast<char>(value);
  const auto size = static_cast<std::uint32_t>(rows.size());
  std::string zlib = "\x78\x01\x01";  // one stored block
  for (const std::uint32_t value : {size & 255, size >> 8, ~size & 255, ~size >> 8 & 255}) {
    zlib += static_cast<char>(value);
  }
  std::uint32_t a = 1, b = 0;
  for (const char letter : rows) {
    a = (a + static_cast<unsigned char>(letter)) % 65521;
    b = (b + a) % 65521;
  }
  zlib += rows;
  append32(zlib, b << 16 | a);
  return bytesOf("\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + ancillary + chunk("IDAT", zlib) +
                 chunk("IEND", ""));
}

const std::vector<std::uint8_t>& texels(const Bytes& png) {
  static glint::ByteImage image;
  image = glint::decodeTexture(png, "test");
  return image.values;
}

TEST(Texture, PngOfEveryColourType) {
  using Values = std::vector<std::uint8_t>;
  const std::string zero(1, '\0');
  EXPECT_EQ(texels(makePng(1, 1, 8, 2, zero + "\1\2\3")), (Values{1, 2, 3, 255}));
  EXPECT_EQ(texels(makePng(1, 1, 8, 6, zero + "\1\2\3\4")), (Values{1, 2, 3, 4}));
  EXPECT_EQ(texels(makePng(1, 1, 8, 0, zero + "\7")), (Values{7, 7, 7, 255}));
  EXPECT_EQ(texels(makePng(1, 1, 8, 4, zero + "\7\5")), (Values{7, 7, 7, 5}));
  EXPECT_EQ(texels(makePng(2, 1, 1, 0, zero + "\x40")), (Values{0, 0, 0, 255, 255, 255, 255, 255}));
  EXPECT_EQ(texels(makePng(1, 1, 4, 0, zero + "\x50")), (Values{85, 85, 85, 255}));
  EXPECT_EQ(texels(makePng(1, 1, 16, 2, zero + std::string("\1\xff\2\0\3\0", 6))),
            (Values{1, 2, 3, 255}));
  const std::string palette = chunk("PLTE", "\1\2\3\4\5\6") + chunk("tRNS", "\x09");
  EXPECT_EQ(texels(makePng(2, 1, 8, 3, zero + zero + "\1", palette)),
            (Values{1, 2, 3, 9, 4, 5, 6, 255}));
}

TEST(Texture, PngRowsAreFromTheTopAndInterlacedOnesInOrder) {
  const std::string zero(1, '\0');
  const std::vector<std::uint8_t> expected{1, 1, 1, 255, 2, 2, 2, 255, 3, 3, 3, 255, 4, 4, 4, 255};
  EXPECT_EQ(texels(makePng(2, 2, 8, 0, zero + "\1\2" + zero + "\3\4")), expected);
  EXPECT_EQ(texels(makePng(2, 2, 8, 0, zero + "\1" + zero + "\2" + zero + "\3\4", "", true)),
            expected);
}

TEST(Texture, JpegOfEveryKind) {
  for (const int components : {1, 3, 4}) {
    for (const bool progressive : {false, true}) {
      const auto image = glint::decodeTexture(makeJpeg(components, progressive), "test");
      ASSERT_EQ(image.width, 20);
      ASSERT_EQ(image.height, 12);
      const std::uint8_t* pixel = &image.values[4 * (20 * 3 + 10)];  // x 10, y 3
      // Chroma at half resolution and quality 95 change a smooth colour by a few codes.
      const int red = 40 + 8 * 10, green = 200 - 9 * 3, blue = 90;
      const int scale = components == 4 ? 200 : 255;  // Adobe's CMYK: complements times black
      EXPECT_NEAR(pixel[0], red * scale / 255, 6);
      EXPECT_NEAR(pixel[1], components == 1 ? red : green * scale / 255, 6);
      EXPECT_NEAR(pixel[2], components == 1 ? red : blue * scale / 255, 6);
      EXPECT_EQ(pixel[3], 255);
    }
  }
}

/// Every prefix is refused with one line, or gives the whole picture if only the last `tail` bytes
/// are missing: a JPEG's end marker, the checksum of a PNG's empty last chunk.
void expectPrefixesRefused(const Bytes& bytes, std::size_t tail) {
  const auto whole = glint::decodeTexture(bytes, "whole").values;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Bytes prefix(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    try {
      const auto image = glint::decodeTexture(prefix, "cut.bin");
      ASSERT_GE(size + tail, bytes.size()) << "accepted " << size << " bytes";
      ASSERT_EQ(image.values, whole);
    } catch (const glint::InputError& error) {
      ASSERT_THAT(error.what(), ::testing::StartsWith("cut.bin: "));
      ASSERT_THAT(error.what(), Not(HasSubstr("\n")));
    }
  }
}

TEST(Texture, CutFilesAreRefusedAtEveryLength) {
  const std::string rows = [] {
    std::string all;
    for (int y = 0; y < 10; ++y) all += std::string(1, '\0') + std::string(40, char('a' + y));
    return all;
  }();
  expectPrefixesRefused(makePng(10, 10, 8, 6, rows), 4);
  for (const int components : {1, 3, 4}) {
    expectPrefixesRefused(makeJpeg(components, false), 2);
    expectPrefixesRefused(makeJpeg(components, true), 2);
  }
}

/// Whatever its faults, a file gives a picture or an InputError, quickly and quietly.
void expectFlipsSurvived(const Bytes& bytes, unsigned seed) {
  std::mt19937 random(seed);
  ::testing::internal::CaptureStderr();
  int refused = 0;
  for (std::size_t i = 0; i < 4 * bytes.size(); ++i) {
    Bytes damaged = bytes;
    // Every byte in turn, then several at once.
    for (std::size_t flips = i < bytes.size() ? 1 : 1 + random() % 8; flips > 0; --flips) {
      const std::size_t at = i < bytes.size() ? i : random() % bytes.size();
      damaged[at] ^= std::byte(1 + random() % 255);
    }
    try {
      const auto image = glint::decodeTexture(damaged, "test");
      ASSERT_EQ(image.values.size(), std::size_t(4) * image.width * image.height);
    } catch (const glint::InputError& error) {
      ++refused;
      ASSERT_THAT(error.what(), Not(HasSubstr("\n")));
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(refused, 0);
}

TEST(Texture, FlippedBytesAreSurvived) {
  expectFlipsSurvived(makePng(3, 3, 8, 2, std::string(30, '\0')), 1);
  expectFlipsSurvived(makeJpeg(3, false), 2);
  expectFlipsSurvived(makeJpeg(3, true), 3);
  expectFlipsSurvived(makeJpeg(4, false), 4);
}

TEST(Texture, GiantsAreRefusedAtOnce) {
  const auto begin = std::chrono::steady_clock::now();
  const std::string row(100, '\0');
  EXPECT_THAT(messageOf([&] { glint::decodeTexture(makePng(1048577, 1, 8, 6, row), "a"); }),
              HasSubstr("1048577 x 1 pixels are too many: at most 1048576 per side"));
  EXPECT_THAT(
      messageOf([&] { glint::decodeTexture(makePng(0x7fffffff, 0x7fffffff, 8, 6, row), "a"); }),
      HasSubstr("PNG is damaged (arithmetic overflow)"));
  EXPECT_THAT(messageOf([&] { glint::decodeTexture(makePng(16384, 16384, 16, 6, row), "a"); }),
              HasSubstr("truncated"));
  // The JPEG's size follows its SOF0 marker: length, precision, height, width.
  Bytes jpeg = makeJpeg(3, false);
  for (std::size_t i = 0; i + 8 < jpeg.size(); ++i) {
    if (jpeg[i] != std::byte(0xff) || jpeg[i + 1] != std::byte(0xc0)) continue;
    jpeg[i + 5] = jpeg[i + 7] = std::byte(0x40);
    jpeg[i + 6] = jpeg[i + 8] = std::byte(0);
    break;
  }
  EXPECT_THAT(messageOf([&] { glint::decodeTexture(jpeg, "a"); }), HasSubstr("JPEG is damaged"));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(seconds.count(), 2.0);
}

TEST(Texture, OtherFormatsAreRefused) {
  EXPECT_EQ(messageOf([] { glint::decodeTexture(bytesOf("GIF89a"), "m.glb: image 2"); }),
            "m.glb: image 2: neither PNG nor JPEG: convert it to one of them");
  EXPECT_THAT(messageOf([] { glint::decodeTexture({}, "a"); }), HasSubstr("neither"));
}

TEST(Image, PngIsDecodedToLinearPremultiplied) {
  const std::string zero(1, '\0');
  const auto deep = glint::decodeImage(
      makePng(1, 1, 16, 6, zero + "\xbb\xbb" + "\xff\xff" + zero + zero + "\x80" + zero), "a");
  const float alpha = 0x8000 / 65535.0f;
  EXPECT_NEAR(deep.values[0], glint::decodeSrgb16(0xbbbb) * alpha, 1e-7);
  EXPECT_EQ(deep.values[1], alpha);
  EXPECT_EQ(deep.values[2], 0.0f);
  EXPECT_EQ(deep.values[3], alpha);
  const auto plain = glint::decodeImage(makePng(1, 1, 8, 2, zero + "\xbb\x80\xff"), "a");
  EXPECT_EQ(plain.values,
            (std::vector<float>{glint::decodeSrgb8(0xbb), glint::decodeSrgb8(0x80), 1, 1}));
}

Bytes makePfm(const std::string& header, std::initializer_list<float> values, bool swap = false) {
  Bytes bytes = bytesOf(header);
  for (const float value : values) {
    Bytes four(4);
    std::memcpy(four.data(), &value, 4);
    if (swap) std::reverse(four.begin(), four.end());
    bytes.insert(bytes.end(), four.begin(), four.end());
  }
  return bytes;
}

TEST(Image, PfmOfBothOrdersAndKinds) {
  const std::vector<float> expected{2, 2, 2, 1, -3, -3, -3, 1};  // rows from the top
  EXPECT_EQ(glint::decodeImage(makePfm("Pf\n1 2\n-1.0\n", {-3, 2}), "a").values, expected);
  EXPECT_EQ(glint::decodeImage(makePfm("Pf 1 2 1\n", {-3, 2}, true), "a").values, expected);
  EXPECT_EQ(glint::decodeImage(makePfm("PF\n1 1\n-2e0\n", {1, 2, 3}), "a").values,
            (std::vector<float>{1, 2, 3, 1}));
  EXPECT_EQ(glint::decodeImage(makePfm("PF\r\n1 1\r\n1.0\n", {1, 2, 3}, true), "a").values,
            (std::vector<float>{1, 2, 3, 1}));
}

TEST(Image, DamagedPfmIsRefused) {
  const auto message = [](const std::string& header) {
    return messageOf([&] { glint::decodeImage(makePfm(header, {1, 2, 3}), "a.pfm"); });
  };
  EXPECT_EQ(message("PF\n1 1\n-1\n"), "no error");
  for (const char* header : {"PF\n0 1\n-1\n", "PF\n-1 1\n-1\n", "PF\n1 1\n0\n", "PF\n1 1\nnan\n",
                             "PF\n1 x\n-1\n", "PF\n1 1 1", "PF\n99999999999 1\n-1\n", "PF\n"}) {
    EXPECT_THAT(message(header), HasSubstr("a.pfm: the PFM's header is damaged")) << header;
  }
  EXPECT_THAT(message("PF\n2 1\n-1\n"), HasSubstr("truncated"));
  EXPECT_THAT(message("PF\n16384 16384\n-1\n"), HasSubstr("truncated"));
  EXPECT_THAT(message("PF\n4000000000 4000000000\n-1\n"), HasSubstr("too many"));
}

}  // namespace glint::test::image_reader_test
