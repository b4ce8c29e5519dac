// OpenEXR, Radiance HDR, JPEG and the metadata of pictures.

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfTiledOutputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/glm.hpp>

#include "damaged_pictures.h"
#include "files.h"
#include "glint/image/error.h"
#include "glint/image/exr_writer.h"
#include "glint/image/file.h"
#include "glint/image/picture_writer.h"
#include "glint/image/read_image.h"
#include "glint/image/stored_image.h"
#include "pictures.h"

namespace glint::test::image_formats_test {

using ::testing::HasSubstr;
using ::testing::Not;
using Bytes = std::vector<std::byte>;

std::string in(const std::string& name) { return glint::test::temporaryFolder() + "/" + name; }

/// Values that identify their pixel, channel and layer.
glint::Image numbered(int width, int height, float offset) {
  glint::Image image{width, height, std::vector<float>(std::size_t(4) * width * height)};
  for (std::size_t i = 0; i < image.values.size(); ++i)
    image.values[i] = offset + float(i) * 0.123f;
  return image;
}

TEST(Exr, LayersAndTextSurvive) {
  const glint::Image main = numbered(5, 70, 0), diffuse = numbered(5, 70, 1000);
  const glint::Image depth = numbered(5, 70, -500);
  const glint::ExrLayer layers[] = {
      {"", &main, "RGBA"}, {"diffuse", &diffuse, "RGB"}, {"depth", &depth, "Z"}};
  writeExr(in("layers.exr"), layers, {{"GL_RENDERER", "llvmpipe"}, {"look", "{\"é\": 1}"}});
  const glint::Image read = glint::readImage(in("layers.exr"));
  EXPECT_EQ(read.values, main.values);
  EXPECT_EQ(read.text.at("GL_RENDERER"), "llvmpipe");
  EXPECT_EQ(read.text.at("look"), "{\"é\": 1}");
  const glint::Image second = glint::readImage(in("layers.exr"), "diffuse");
  const glint::Image third = glint::readImage(in("layers.exr"), "depth");
  for (std::size_t i = 0; i < main.values.size(); ++i) {
    EXPECT_EQ(second.values[i], i % 4 == 3 ? 1 : diffuse.values[i]);
    EXPECT_EQ(third.values[i], i % 4 == 3 ? 1 : depth.values[i - i % 4]);
  }
  EXPECT_THAT(messageOf([] { glint::readImage(in("layers.exr"), "specular"); }),
              HasSubstr("layers.exr: no layer 'specular' in the EXR: name one of its layers: "
                        "depth.Z, diffuse"));
}

TEST(Exr, WrittenInPiecesWithAndWithoutAlpha) {
  for (const bool alpha : {false, true}) {
    glint::PictureOptions options;
    options.alpha = alpha;
    options.text = {{"look", "x"}};
    glint::Image rows = numbered(7, 20, 0);
    rows.values[0] = NAN;
    const auto writer = glint::openPictureWriter(in("pieces.exr"), 7, 40, options);
    writer->write(rows);
    writer->write(rows);
    writer->finish();
    EXPECT_EQ(writer->nanPixels(), 2u);
    const glint::Image read = glint::readImage(in("pieces.exr"));
    ASSERT_EQ(read.height, 40);
    EXPECT_TRUE(std::isnan(read.values[0]));
    for (std::size_t i = 1; i < read.values.size() / 2; ++i)
      EXPECT_EQ(read.values[i], alpha || i % 4 < 3 ? rows.values[i] : 1);
    EXPECT_EQ(read.text.at("look"), "x");
  }
}

TEST(Exr, AbandonedPicturesLeaveNothing) {
  { const auto writer = glint::openPictureWriter(in("abandoned.exr"), 7, 40, {}); }
  EXPECT_THAT(messageOf([] { glint::readFile(in("abandoned.exr")); }), HasSubstr("No such file"));
}

/// The file that OpenEXR's writer makes.
Bytes exrOf(const Imf::Header& header, const Imf::FrameBuffer& frame, int rows) {
  {
    Imf::OutputFile file(in("made.exr").c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(rows);
  }
  return glint::readFile(in("made.exr"));
}

TEST(Exr, EveryCompressionAndPixelType) {
  for (int compression = 0; compression < int(Imf::NUM_COMPRESSION_METHODS); ++compression) {
    for (const auto type : {Imf::HALF, Imf::FLOAT, Imf::UINT}) {
      Imf::Header header(33, 37);
      header.compression() = Imf::Compression(compression);
      std::vector<std::uint32_t> words(33 * 37);
      Imf::FrameBuffer frame;
      for (std::size_t i = 0; i < words.size(); ++i) {
        const float value = float(i / 200);  // exact as a half
        if (type == Imf::UINT) words[i] = std::uint32_t(value);
        if (type == Imf::FLOAT) std::memcpy(&words[i], &value, 4);
        const half small = value;
        if (type == Imf::HALF) std::memcpy(&words[i], &small, 2);
      }
      header.channels().insert("Y", Imf::Channel(type));
      frame.insert("Y", Imf::Slice(type, reinterpret_cast<char*>(words.data()), 4, 4 * 33));
      const glint::Image image = glint::decodeImage(exrOf(header, frame, 37), "a");
      const bool lossy = compression >= Imf::DWAA_COMPRESSION ||
                         (compression == Imf::PXR24_COMPRESSION && type == Imf::FLOAT) ||
                         compression == Imf::B44_COMPRESSION ||
                         compression == Imf::B44A_COMPRESSION;
      for (std::size_t i = 0; i < words.size(); ++i) {
        // B44 and DWA keep about six bits, linear or on a perceptual scale.
        EXPECT_NEAR(image.values[4 * i + 1], float(i / 200), lossy ? 0.2 : 0) << compression;
      }
    }
  }
}

TEST(Exr, DisplayWindowIsThePicture) {
  Imf::Header header(Imath::Box2i({10, 20}, {13, 22}), Imath::Box2i({12, 19}, {14, 21}));
  header.channels().insert("R", Imf::Channel(Imf::FLOAT));
  std::vector<float> values{1, 2, 3, 4, 5, 6, 7, 8, 9};
  Imf::FrameBuffer frame;
  frame.insert("R", Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow()));
  const glint::Image image = glint::decodeImage(exrOf(header, frame, 3), "a");
  ASSERT_EQ(image.width, 4);
  ASSERT_EQ(image.height, 3);
  const float red[12] = {0, 0, 4, 5, 0, 0, 7, 8, 0, 0, 0, 0};
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(image.values[4 * i], red[i]);
    EXPECT_EQ(image.values[4 * i + 1], 0);
    EXPECT_EQ(image.values[4 * i + 3], red[i] > 0 ? 1 : 0);
  }
}

TEST(Exr, PartsTilesAndChroma) {
  Imf::Header headers[2] = {{3, 2}, {3, 2}};
  std::vector<float> values{1, 2, 3, 4, 5, 6};
  for (int part = 0; part < 2; ++part) {
    headers[part].setName(part == 0 ? "left" : "right");
    headers[part].setType(Imf::SCANLINEIMAGE);
    headers[part].channels().insert("Y", Imf::Channel(Imf::FLOAT));
  }
  {
    Imf::MultiPartOutputFile file(in("parts.exr").c_str(), headers, 2);
    for (int part = 0; part < 2; ++part) {
      Imf::OutputPart output(file, part);
      Imf::FrameBuffer frame;
      frame.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 12));
      output.setFrameBuffer(frame);
      output.writePixels(2);
      values[0] = 9;
    }
  }
  EXPECT_EQ(glint::readImage(in("parts.exr")).values[0], 1);
  EXPECT_EQ(glint::readImage(in("parts.exr"), "left").values[0], 1);
  EXPECT_EQ(glint::readImage(in("parts.exr"), "right").values[0], 9);

  Imf::Header tiled(3, 2);
  tiled.setTileDescription(Imf::TileDescription(2, 2));
  tiled.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  {
    Imf::TiledOutputFile file(in("tiles.exr").c_str(), tiled);
    Imf::FrameBuffer frame;
    frame.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 12));
    file.setFrameBuffer(frame);
    file.writeTiles(0, 1, 0, 0);
  }
  EXPECT_EQ(glint::readImage(in("tiles.exr")).values[4 * 5], 6);

  {
    Imf::RgbaOutputFile file(in("chroma.exr").c_str(), 4, 4, Imf::WRITE_YC);
    const std::vector<Imf::Rgba> pixels(16, Imf::Rgba(0.5f, 0.25f, 0.125f));
    file.setFrameBuffer(pixels.data(), 1, 4);
    file.writePixels(4);
  }
  const glint::Image chroma = glint::readImage(in("chroma.exr"));
  // Luminance keeps about 9 of a half's 11 bits, and so does chroma.
  EXPECT_NEAR(chroma.values[4 * 5], 0.5, 0.004);
  EXPECT_NEAR(chroma.values[4 * 5 + 1], 0.25, 0.004);
  EXPECT_NEAR(chroma.values[4 * 5 + 2], 0.125, 0.004);
}

Bytes hdr(const std::string& size, const std::string& pixels,
          const std::string& format = "32-bit_rle_rgbe") {
  return bytesOf("#?RADIANCE\nFORMAT=" + format + "\nSOFTWARE=test\n\n" + size + "\n" + pixels);
}

TEST(Hdr, ThreeWaysToStoreRows) {
  const std::string one = "\x80\x80\x80\x81", two = "\x40\x20\x10\x82";
  const glint::Image plain = glint::decodeImage(hdr("-Y 2 +X 1", one + two), "a");
  EXPECT_EQ(plain.values, (std::vector<float>{1, 1, 1, 1, 1, 0.5, 0.25, 1}));
  EXPECT_EQ(plain.text.at("SOFTWARE"), "test");
  EXPECT_EQ(glint::decodeImage(hdr("+Y 2 +X 1", two + one), "a").values, plain.values);
  EXPECT_EQ(glint::decodeImage(hdr("-Y 1 -X 2", two + one), "a").values, plain.values);
  // Old run-length encoding: 3 + 256 repeats of the first pixel.
  const glint::Image old =
      glint::decodeImage(hdr("-Y 1 +X 261", one + "\1\1\1\3" + "\1\1\1\1" + two), "a");
  for (std::size_t i = 0; i < 261; ++i) EXPECT_EQ(old.values[4 * i + 2], i < 260 ? 1 : 0.25) << i;
  // New run-length encoding: a channel of ten values, as a run of 8 and two literals.
  std::string row("\2\2\0\12", 4);
  for (const char* value : {"\x80", "\x40", "\x20", "\x81"})
    row += std::string("\x88") + value + "\2" + value + value;
  const glint::Image fresh = glint::decodeImage(hdr("-Y 1 +X 10", row), "a");
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(fresh.values[4 * i], 1);
    EXPECT_EQ(fresh.values[4 * i + 2], 0.25);
  }
  // An exponent of 0 is black for any mantissas.
  EXPECT_EQ(glint::decodeImage(hdr("-Y 1 +X 1", std::string("\x80\x80\x80\0", 4)), "a").values[0],
            0);
}

TEST(Hdr, DamageIsNamed) {
  const auto message = [](const Bytes& bytes) {
    return messageOf([&] { glint::decodeImage(bytes, "a.hdr"); });
  };
  EXPECT_THAT(message(hdr("-Y 2 +X 1", "\x80\x80\x80\x81")),
              HasSubstr("a.hdr: the HDR is truncated"));
  EXPECT_THAT(message(hdr("-Y 1 +X 2", std::string("\1\1\1\1") + "\1\1\1\1")), HasSubstr("runs"));
  EXPECT_THAT(message(hdr("-Y 16000 +X 16000", "\x80\x80\x80\x81")), HasSubstr("too many"));
  EXPECT_THAT(message(hdr("-Y 0 +X 1", "")), HasSubstr("size is damaged"));
  EXPECT_THAT(message(hdr("+X 1 -Y 1", "\x80\x80\x80\x81")), HasSubstr("stored by columns"));
  EXPECT_THAT(message(hdr("-Y 1 +X 1", "\x80\x80\x80\x81", "32-bit_rle_xyze")),
              HasSubstr("convert it to 32-bit_rle_rgbe"));
}

TEST(PngText, SurvivesWithItsLetters) {
  glint::PictureOptions options;
  options.text = {{"GL_RENDERER", "llvmpipe (LLVM 15)"}, {"look", "caf\u00e9"}};
  writePicture(in("text.png"), numbered(3, 3, 0), options);
  const glint::Image image = glint::readImage(in("text.png"));
  EXPECT_EQ(image.text.at("GL_RENDERER"), "llvmpipe (LLVM 15)");
  EXPECT_EQ(image.text.at("look"), "caf\u00e9");
}

/// Two pixels per row: the upper row 1 2 3, 4 5 6, the lower one 7 8 9, 10 11 12.
std::vector<std::uint8_t> twoByTwo() { return {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}; }

struct SimpleFile {
  const char* name;
  Bytes bytes;
};

std::vector<SimpleFile> simpleFiles() {
  using std::string;
  // Rows from the bottom, blue first, each padded to four bytes.
  const string bmpRows("\x9\x8\x7\xc\xb\xa\0\0\3\2\1\6\5\4\0\0", 16);
  const string tgaRows("\x9\x8\x7\xc\xb\xa\3\2\1\6\5\4", 12);
  const string bmp("BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\2\0\0\0\1\0\x18\0", 30);
  const string core("BM\x2a\0\0\0\0\0\0\0\x1a\0\0\0\xc\0\0\0\2\0\2\0\1\0\x18\0", 26);
  const string tga("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\x18\0", 18);
  string runs = tga;
  runs[2] = 10;
  string wide = "P6 # sixteen bits\n2 2\n65535\n";
  for (const std::uint8_t value : twoByTwo()) wide += string(2, char(value));
  const auto codes = twoByTwo();
  return {{"BMP", bytesOf(bmp + string(24, '\0') + bmpRows)},
          {"BMP, the first header", bytesOf(core + bmpRows)},
          {"TGA", bytesOf(tga + tgaRows)},
          {"TGA in runs", bytesOf(runs + "\1" + tgaRows.substr(0, 6) + "\1" + tgaRows.substr(6))},
          {"PPM", bytesOf("P6 2 2 255\n" + string(codes.begin(), codes.end()))},
          {"PPM of 16 bits", bytesOf(wide)}};
}

TEST(Formats, SmallOnesHoldWhatTheirBytesSay) {
  for (const SimpleFile& file : simpleFiles()) {
    SCOPED_TRACE(file.name);
    const glint::StoredImage image = glint::decodeStoredImage(file.bytes, "x");
    EXPECT_EQ(glm::ivec2(image.width, image.height), glm::ivec2(2));
    ASSERT_EQ(image.channels, 3);
    const auto expected = twoByTwo();
    if (const auto* wide = std::get_if<1>(&image.values))
      for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ((*wide)[i], 257 * expected[i]);
    else
      EXPECT_EQ(std::get<0>(image.values), expected);
  }
}

// Refused wherever they end; no byte beyond that is read (a sanitizer would report it).
TEST(Formats, SmallOnesThatEndEarlyAreRefused) {
  for (const SimpleFile& file : simpleFiles())
    for (std::size_t size = 0; size < file.bytes.size(); ++size) {
      SCOPED_TRACE(std::string(file.name) + " " + std::to_string(size));
      const Bytes part(file.bytes.begin(), file.bytes.begin() + std::ptrdiff_t(size));
      try {
        (void)glint::decodeStoredImage(part, "x");
        // The padding of the last row may be missing.
        EXPECT_GE(size + 2, file.bytes.size());
      } catch (const glint::InputError&) {
      }
    }
}

TEST(Formats, DamagedFilesAreSurvived) {
  glint::test::expectExrSurvived(200, false);
  glint::test::expectHdrSurvived(200);
}

}  // namespace glint::test::image_formats_test
