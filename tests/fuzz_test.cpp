// All functions that read bytes or text from outside, on small randomly damaged inputs: the targets
// of tests/fuzz without a fuzzer. GLINT_FUZZ_DRAWS increases their number.

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "fuzz/targets.h"
#include "glint/budget/cost_file.h"
#include "glint/image/file.h"
#include "glint/image/image.h"
#include "glint/options/parameters.h"
#include "gltf_sample.h"
#include "jpeg.h"
#include "pictures.h"
#include "random.h"
#include "textures.h"

namespace glint::test::fuzz_test {

using Bytes = std::vector<std::byte>;

Bytes codes(int width, int height) {
  return png(width, height,
             [](int x, int y) { return glm::ivec4(40 * x % 256, 30 * y % 256, 90, 255 - x); });
}

Bytes written(const std::filesystem::path& path) {
  Image image{5, 4, {}};
  for (int i = 0; i < 4 * 5 * 4; ++i) image.values.push_back(float(i) / 40);
  PictureOptions options;
  options.alpha = true;
  options.text = {{"glint-look", "{}"}};
  writePicture(path.string(), image, options);
  return readFile(path.string());
}

/// Grey, 2 x 2, uncompressed, one strip.
std::string tiff() {
  std::string file("II*\0\x08\0\0\0\x07\0", 10);
  const auto entry = [&](int tag, int value) {
    for (const int each : {tag & 255, tag >> 8, 4, 0, 1, 0, 0, 0, value, 0, 0, 0})
      file += static_cast<char>(each);
  };
  entry(256, 2), entry(257, 2), entry(258, 8), entry(262, 1), entry(273, 98), entry(278, 2);
  entry(279, 4);
  return file + std::string("\0\0\0\0", 4) + "abcd";
}

std::map<std::string, std::vector<Bytes>> seedsIn(Sample& sample) {
  const Bytes png = codes(9, 7);
  const auto* begin = reinterpret_cast<const unsigned char*>(png.data());
  const int view = sample.view(std::vector<unsigned char>(begin, begin + png.size()));
  sample.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
  sample.add("textures", {{"source", 0}});
  sample.add("materials",
             {{"name", "a"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  sample.triangle()["material"] = 0;
  sample.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      sample.accessor<float>("VEC2", {0, 0, 1, 0, 0, 1});
  sample.json["meshes"][0]["primitives"][0]["indices"] =
      sample.accessor<std::uint16_t>("SCALAR", {0, 1, 2});
  const auto file = [&](const char* name) { return sample.folder() / name; };
  Look look;
  look.material["a#1"].color = glm::dvec3(0.1, 0.2, 0.3);
  look.light = {Light{.type = Light::Type::camera, .direction = {1, 2, 3}}};
  return {
      {"gltf", {readFile(sample.writeGlb()), readFile(sample.writeGltf())}},
      {"png", {png, written(file("a.png"))}},
      {"jpeg", {makeJpeg(3, false), makeJpeg(3, true)}},
      // The smallest lossless one: one pixel.
      {"webp",
       {bytesOf(std::string("RIFF\x1a\0\0\0WEBPVP8L\x0d\0\0\0/\0\0\0\x10\x07\x10\x11\x11\x88"
                            "\x88\xfe\x07\0",
                            34))}},
      {"exr", {written(file("a.exr"))}},
      {"hdr", {bytesOf("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\nabcdefghijklmnop")}},
      {"pfm", {written(file("a.pfm"))}},
      {"tiff", {bytesOf(tiff())}},
      {"simple",
       {bytesOf("P6 2 2 255\nabcdefghijkl"), bytesOf("P2 2 2 9\n1 2 3 4"),
        bytesOf(
            std::string("BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\2\0\0\0\1\0\x18\0", 30) +
            std::string(24, '\0') + "abcdef00ghijkl00"),
        bytesOf(std::string("BM\x2a\0\0\0\0\0\0\0\x1a\0\0\0\xc\0\0\0\2\0\2\0\1\0\x18\0", 26) +
                "abcdef00ghijkl00"),
        bytesOf(std::string("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\x18\0", 18) + "abcdefghijkl")}},
      {"look", {bytesOf(saveLook(look)), bytesOf(saveLook(Look()))}},
      {"material",
       {bytesOf("color=#c04020,exponent=200"), bytesOf("\"a=b\"#1:ior=1.5,specular=1")}},
      {"light",
       {bytesOf("spot:0,1,2:3,4,5:10,20:1,1,1:falloff,9"), bytesOf("camera@1,2,3:1,0.5,0"),
        bytesOf("directional:1,2,3")}},
      {"list", {bytesOf("a.glb\nb.glb\tb.png\r\n\nc.glb")}},
      {"costs", {bytesOf(costFileText({}))}},
  };
}

class Mutations : public Random {
 public:
  using Random::Random;

  Bytes of(Bytes bytes) {
    for (int i = 1 + below(4); i > 0; --i) change(bytes);
    return bytes;
  }

 private:
  std::size_t place(const Bytes& bytes) { return std::size_t(below(int(bytes.size()))); }

  void change(Bytes& bytes) {
    if (bytes.empty()) return;
    constexpr int telling[] = {0, 1, 0x7f, 0x80, 0xff, '"', '[', '-', '9', ',', '\n', '\t'};
    const std::size_t at = place(bytes), other = place(bytes);
    switch (below(6)) {
      case 0:
        bytes[at] = std::byte(1 << below(8)) ^ bytes[at];
        break;
      case 1:
        bytes[at] = std::byte(telling[below(12)]);
        break;
      case 2:  // a length or an offset that is far too large
        for (std::size_t i = at; i < std::min(at + 4, bytes.size()); ++i)
          bytes[i] = std::byte(0xff);
        break;
      case 3:
        bytes.resize(at);
        break;
      case 4:
        bytes.erase(bytes.begin() + std::ptrdiff_t(std::min(at, other)),
                    bytes.begin() +
                        std::ptrdiff_t(std::min(std::max(at, other), std::min(at, other) + 16)));
        break;
      default: {
        const Bytes part(bytes.begin() + std::ptrdiff_t(at),
                         bytes.begin() + std::ptrdiff_t(std::min(at + 16, bytes.size())));
        bytes.insert(bytes.begin() + std::ptrdiff_t(other), part.begin(), part.end());
      }
    }
  }
};

TEST(Fuzz, DamagedInputsAreReadOrRefused) {
  Sample sample;
  const auto seeds = seedsIn(sample);
  const int draws = drawsOf("GLINT_FUZZ_DRAWS", 300);
  for (const FuzzTarget& target : fuzzTargets()) {
    SCOPED_TRACE(target.name);
    const std::vector<Bytes>& own = seeds.at(std::string(target.name));
    for (const Bytes& seed : own) ASSERT_NO_THROW(target.run(seed));
    Mutations mutations(7);
    for (int i = 0; i < draws; ++i) {
      const Bytes input = mutations.of(own[std::size_t(mutations.below(int(own.size())))]);
      ASSERT_NO_THROW(target.run(input)) << i;
    }
  }
}

}  // namespace glint::test::fuzz_test
