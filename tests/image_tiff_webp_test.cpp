// TIFF and WebP: files built byte by byte from their specifications, and the values in them.

#include <gmock/gmock.h>

#include <cstring>
#include <string>

#include "glint/image/error.h"
#include "glint/image/picture_layers.h"

namespace glint::image_tiff_webp_test {

using std::string;
using testing::ElementsAre;
using testing::IsEmpty;

PictureLayers read(const string& file) {
  return glint::decodePictureLayers(std::as_bytes(std::span(file.data(), file.size())), "a", "all");
}

template <class Value>
std::vector<Value> valuesOf(const StoredImage& image) {
  return std::get<std::vector<Value>>(image.values);
}

/// A TIFF (version 6.0) of 2 x 2 pixels in one strip.
class Tiff {
 public:
  explicit Tiff(bool bigEndian = false) : big_(bigEndian) {}

  string number(std::uint32_t value, int size) const { return word(value, size); }

  /// Tags in ascending order, with values of 16 bits.
  struct Tag {
    int tag;
    std::vector<int> values;
  };

  string file(const string& pixels, std::vector<Tag> tags, std::uint32_t next = 0) const {
    // The directory follows the header and the pixels, long values follow the directory.
    const bool tiled =
        std::any_of(tags.begin(), tags.end(), [](const Tag& tag) { return tag.tag == 322; });
    tags.push_back({256, {2}});                                 // width
    tags.push_back({257, {2}});                                 // height
    tags.push_back({tiled ? 324 : 273, {8}});                   // position of the strip or tile
    tags.push_back({tiled ? 325 : 279, {int(pixels.size())}});  // its length
    if (!tiled) tags.push_back({278, {2}});                     // its rows
    std::sort(tags.begin(), tags.end(), [](auto& a, auto& b) { return a.tag < b.tag; });
    const std::size_t at = 8 + pixels.size() + pixels.size() % 2;
    const std::size_t behind = at + 2 + 12 * tags.size() + 4;
    string directory = word(std::uint32_t(tags.size()), 2), values;
    for (const Tag& tag : tags) {
      directory +=
          word(std::uint32_t(tag.tag), 2) + word(3, 2) + word(std::uint32_t(tag.values.size()), 4);
      string all;
      for (const int value : tag.values) all += word(std::uint32_t(value), 2);
      if (all.size() <= 4) {
        all.resize(4);
        directory += all;
      } else {
        directory += word(std::uint32_t(behind + values.size()), 4);
        values += all;
      }
    }
    string head = string(big_ ? "MM" : "II") + word(42, 2) + word(std::uint32_t(at), 4) + pixels;
    head.resize(at);
    return head + directory + word(next, 4) + values;
  }

 private:
  string word(std::uint32_t value, int size) const {
    string text;
    for (int i = 0; i < size; ++i) text += char(value >> 8 * (big_ ? size - 1 - i : i) & 255);
    return text;
  }

  bool big_;
};

constexpr int bits = 258, compression = 259, photometric = 262, samples = 277, colours = 320,
              extra = 338, format = 339, orientation = 274;
const string twelve("\1\2\3\4\5\6\7\10\11\12\13\14");  // 1 to 12

TEST(TiffFile, ColoursInBothByteOrders) {
  for (const bool big : {false, true}) {
    const Tiff tiff(big);
    const PictureLayers rgb =
        read(tiff.file(twelve, {{bits, {8, 8, 8}}, {photometric, {2}}, {samples, {3}}}));
    const StoredImage& image = rgb.layers[0].image;
    EXPECT_EQ(image.channels, 3);
    EXPECT_THAT(valuesOf<std::uint8_t>(image), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
    EXPECT_THAT(rgb.skipped, IsEmpty());
    EXPECT_THAT(image.unfollowed, IsEmpty());
    string words, floats;
    for (const int value : {0, 1000, 40000, 65535}) words += tiff.number(std::uint32_t(value), 2);
    EXPECT_THAT(valuesOf<std::uint16_t>(
                    read(tiff.file(words, {{bits, {16}}, {photometric, {1}}})).layers[0].image),
                ElementsAre(0, 0, 0, 1000, 1000, 1000, 40000, 40000, 40000, 65535, 65535, 65535));
    for (const float value : {0.25f, -1.0f, 7.5f, 1e-9f}) {
      std::uint32_t word = 0;
      std::memcpy(&word, &value, 4);
      floats += tiff.number(word, 4);
    }
    const StoredImage linear =
        read(tiff.file(floats, {{bits, {32}}, {photometric, {1}}, {format, {3}}})).layers[0].image;
    EXPECT_FALSE(linear.isEncoded());
    EXPECT_THAT(valuesOf<float>(linear), ElementsAre(0.25f, 0.25f, 0.25f, -1, -1, -1, 7.5f, 7.5f,
                                                     7.5f, 1e-9f, 1e-9f, 1e-9f));
  }
}

TEST(TiffFile, AlphaPalettesPlanesAndPackedBits) {
  const Tiff tiff;
  const auto codes = [&](const string& pixels, std::vector<Tiff::Tag> tags) {
    return valuesOf<std::uint8_t>(read(tiff.file(pixels, std::move(tags))).layers[0].image);
  };
  // Associated alpha is divided out: 64 * 255 / 128 is 127.5.
  string four;
  for (int i = 0; i < 4; ++i) four += string("\x40\x20\0\x80", 4);
  const std::vector<Tiff::Tag> rgba{{bits, {8, 8, 8, 8}}, {photometric, {2}}, {samples, {4}}};
  auto associated = rgba, straight = rgba;
  associated.push_back({extra, {1}});
  straight.push_back({extra, {2}});
  auto found = codes(four, associated);
  EXPECT_EQ(std::vector<std::uint8_t>(found.begin(), found.begin() + 4),
            (std::vector<std::uint8_t>{128, 64, 0, 128}));
  found = codes(four, straight);
  EXPECT_EQ(std::vector<std::uint8_t>(found.begin(), found.begin() + 4),
            (std::vector<std::uint8_t>{64, 32, 0, 128}));
  // A palette with 16 bits per colour: 256 reds, greens and blues.
  std::vector<int> map(768);
  for (int i = 0; i < 256; ++i) {
    map[std::size_t(i)] = 257 * i;
    map[std::size_t(256 + i)] = 257 * (255 - i);
    map[std::size_t(512 + i)] = 257 * 9;
  }
  EXPECT_THAT(codes(string("\0\1\2\xff", 4), {{bits, {8}}, {photometric, {3}}, {colours, map}}),
              ElementsAre(0, 255, 9, 255, 1, 254, 9, 255, 2, 253, 9, 255, 255, 0, 9, 255));
  // Where white is 0.
  EXPECT_THAT(
      codes(string("\0\1\2\xff", 4), {{bits, {8}}, {photometric, {0}}}),
      ElementsAre(255, 255, 255, 255, 254, 254, 254, 255, 253, 253, 253, 255, 0, 0, 0, 255));
  // Packed, row by row: three literal bytes and three times 7; six times 9.
  EXPECT_THAT(
      codes(string("\2\1\2\3\xfe\7\xfb\x9", 8),
            {{bits, {8, 8, 8}}, {compression, {32773}}, {photometric, {2}}, {samples, {3}}}),
      ElementsAre(1, 2, 3, 7, 7, 7, 9, 9, 9, 9, 9, 9));
}

// Tiles have at least 16 x 16 pixels; those beyond the picture are ignored.
TEST(TiffFile, Tiles) {
  const Tiff tiff;
  string tile(16 * 16 * 2, '\x7f');
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) {
      const string word = tiff.number(std::uint32_t(1000 * (2 * y + x) + 1), 2);
      tile.replace(std::size_t(2 * (16 * y + x)), 2, word);
    }
  EXPECT_THAT(
      valuesOf<std::uint16_t>(
          read(tiff.file(tile, {{bits, {16}}, {photometric, {1}}, {322, {16}}, {323, {16}}}))
              .layers[0]
              .image),
      ElementsAre(1, 1, 1, 1001, 1001, 1001, 2001, 2001, 2001, 3001, 3001, 3001));
}

TEST(TiffFile, WhatIsNotFollowedAndOtherPagesAreTold) {
  const Tiff tiff;
  const std::vector<Tiff::Tag> rgb{{bits, {8, 8, 8}}, {photometric, {2}}, {samples, {3}}};
  auto turned = rgb;
  turned.push_back({orientation, {6}});
  EXPECT_EQ(read(tiff.file(twelve, turned)).layers[0].image.unfollowed.at("EXIF orientation"), "6");
  // A second directory, with the same page again.
  EXPECT_THAT(read(tiff.file(twelve, rgb, 20)).skipped, ElementsAre("the pages after the first"));
  // Truncated anywhere, it is refused unless all that matters was there.
  const string whole = tiff.file(twelve, rgb);
  for (std::size_t size = 8; size < whole.size(); ++size) {
    try {
      EXPECT_THAT(valuesOf<std::uint8_t>(read(whole.substr(0, size)).layers[0].image),
                  ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12))
          << size;
    } catch (const glint::InputError&) {
    }
  }
}

/// Bits as WebP's lossless format packs them: lowest first.
class Bits {
 public:
  Bits& add(unsigned value, int count) {
    for (int i = 0; i < count; ++i, ++at_) {
      if (at_ % 8 == 0) text += '\0';
      text.back() = char(text.back() | (value >> i & 1) << at_ % 8);
    }
    return *this;
  }
  /// A prefix code of one or of two symbols.
  Bits& code(std::vector<unsigned> symbols) {
    add(1, 1).add(unsigned(symbols.size() - 1), 1).add(1, 1);
    for (const unsigned symbol : symbols) add(symbol, 8);
    return *this;
  }
  string text;

 private:
  int at_ = 0;
};

// "WebP lossless bitstream specification": 2 x 2 pixels, no transforms. Red, blue and alpha have
// one value, green has two, chosen by one bit per pixel.
TEST(WebpFile, LosslessCodesAndAlpha) {
  Bits stream;
  stream.add(0x2f, 8).add(1, 14).add(1, 14).add(1, 1).add(0, 3);  // size minus one, alpha, version
  stream.add(0, 1).add(0, 1).add(0, 1);                           // no transform, cache, groups
  stream.code({20, 210}).code({77}).code({5}).code({128}).code({0});
  stream.add(0, 1).add(1, 1).add(1, 1).add(0, 1);
  string data = stream.text;
  const auto size = [](std::size_t n) { return string{char(n & 255), char(n >> 8), 0, 0}; };
  string chunk = "VP8L" + size(data.size()) + data;
  if (chunk.size() % 2 == 1) chunk += '\0';
  const StoredImage image = read("RIFF" + size(4 + chunk.size()) + "WEBP" + chunk).layers[0].image;
  EXPECT_EQ(image.width, 2);
  EXPECT_THAT(valuesOf<std::uint8_t>(image),
              ElementsAre(77, 20, 5, 128, 77, 210, 5, 128, 77, 210, 5, 128, 77, 20, 5, 128));
}

}  // namespace glint::image_tiff_webp_test
