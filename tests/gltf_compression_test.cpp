// Compressed geometry and images: files made here with the codecs' own encoders, then damaged.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>
#include <meshoptimizer.h>
#include <webp/encode.h>

#include <random>

#include "files.h"
#include "glint/image/texture.h"
#include "gltf_sample.h"

namespace gltf_compression_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Bytes = std::vector<std::uint8_t>;

/// A grid of triangles whose vertices and indices are compressed with meshoptimizer.
struct MeshoptSample : Sample {
  static constexpr std::uint32_t side = 9;
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
  Bytes packedVertices, packedIndices;

  MeshoptSample() {
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x)
        positions.insert(positions.end(), {float(x), float(y), float(x * y) / 8});
    for (std::uint32_t y = 0; y + 1 < side; ++y)
      for (std::uint32_t x = 0; x + 1 < side; ++x) {
        const std::uint32_t i = y * side + x;
        indices.insert(indices.end(), {i, i + 1, i + side, i + side, i + 1, i + side + 1});
      }
    const std::size_t count = positions.size() / 3;
    packedVertices.resize(meshopt_encodeVertexBufferBound(count, 12));
    packedVertices.resize(meshopt_encodeVertexBuffer(packedVertices.data(), packedVertices.size(),
                                                     positions.data(), count, 12));
    packedIndices.resize(meshopt_encodeIndexBufferBound(indices.size(), count));
    packedIndices.resize(meshopt_encodeIndexBuffer(packedIndices.data(), packedIndices.size(),
                                                   indices.data(), indices.size()));
    write();
  }

  /// Assembles the document; the views' own buffer is a fallback that does not exist.
  void write() {
    const auto packed = [&](const Bytes& bytes, Json extension, std::size_t plain) {
      while (binary.size() % 4) binary.push_back(0);
      extension["buffer"] = 0;
      extension["byteOffset"] = binary.size();
      extension["byteLength"] = bytes.size();
      binary.insert(binary.end(), bytes.begin(), bytes.end());
      Json view = {{"buffer", 1}, {"byteOffset", 0}, {"byteLength", plain}};
      view["extensions"]["EXT_meshopt_compression"] = extension;
      return add("bufferViews", view);
    };
    const std::size_t count = positions.size() / 3;
    const int vertexView = packed(
        packedVertices, {{"byteStride", 12}, {"count", count}, {"mode", "ATTRIBUTES"}}, 12 * count);
    const int indexView =
        packed(packedIndices, {{"byteStride", 4}, {"count", indices.size()}, {"mode", "TRIANGLES"}},
               4 * indices.size());
    add("accessors",
        {{"bufferView", vertexView}, {"componentType", 5126}, {"type", "VEC3"}, {"count", count}});
    add("accessors", {{"bufferView", indexView},
                      {"componentType", 5125},
                      {"type", "SCALAR"},
                      {"count", indices.size()}});
    primitive({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
    json["extensionsRequired"] = {"EXT_meshopt_compression"};
    finish();
  }

  void finish() {
    buffers = {{{"uri", "sample.bin"}, {"byteLength", binary.size()}},
               {{"byteLength", 1 << 16},
                {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  }

  Json& extension(std::size_t view) {
    return json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
  }
};

TEST(Meshopt, GeometryIsReadAsIfPlain) {
  MeshoptSample sample;
  const glint::Scene scene = sample.load();
  EXPECT_THAT(scene.warnings, IsEmpty());
  const glint::Mesh& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.indices.size(), sample.indices.size());
  double sum = 0, expected = 0;
  for (const std::uint32_t i : mesh.indices) sum += double(mesh.positions[i].z) + mesh.origin.z;
  for (const std::uint32_t i : sample.indices) expected += double(sample.positions[3 * i + 2]);
  EXPECT_EQ(sum, expected);
}

TEST(Meshopt, WhatDoesNotFitIsRefusedByPlace) {
  struct Case {
    void (*breakIt)(MeshoptSample&);
    const char* message;
  };
  const Case cases[] = {
      {[](MeshoptSample& s) { s.extension(0)["mode"] = "POINTS"; }, "unknown mode"},
      {[](MeshoptSample& s) { s.extension(0)["byteStride"] = 13; }, "byteStride"},
      {[](MeshoptSample& s) { s.extension(0)["byteStride"] = 0; }, "byteStride"},
      {[](MeshoptSample& s) { s.extension(1)["byteStride"] = 8; }, "byteStride"},
      {[](MeshoptSample& s) { s.extension(1)["count"] = 4; }, "multiple of 3"},
      {[](MeshoptSample& s) { s.extension(0)["count"] = 4000000000u; }, "far more than"},
      {[](MeshoptSample& s) { s.extension(0)["count"] = 12; }, ""},
      {[](MeshoptSample& s) { s.extension(0)["buffer"] = 7; }, "buffer"},
      {[](MeshoptSample& s) { s.extension(0)["byteOffset"] = 1 << 20; }, "extends past the end"},
      {[](MeshoptSample& s) { s.extension(0)["filter"] = "WARP"; }, "filter"},
      {[](MeshoptSample& s) { s.extension(1)["filter"] = "OCTAHEDRAL"; }, "filter"},
      {[](MeshoptSample& s) { s.json["bufferViews"][0]["byteLength"] = 60000; },
       "of its buffer view"},
      {[](MeshoptSample& s) { s.binary[0] ^= 0xff; }, "damaged"},
  };
  for (const Case& c : cases) {
    MeshoptSample sample;
    c.breakIt(sample);
    EXPECT_THAT(sample.error(), HasSubstr(c.message));
    EXPECT_THAT(sample.error(), HasSubstr("bufferViews["));
  }
}

/// Flips bytes of the binary part; loading may refuse but must not crash.
template <typename Sample>
void shake(int rounds) {
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < rounds; ++i) {
    Sample sample;
    for (int k = 0; k < 1 + i % 5; ++k)
      sample.binary[random() % sample.binary.size()] = std::uint8_t(random());
    if (i % 7 == 0) sample.json["bufferViews"][0]["byteLength"] = random() % 400;
    refused += !sample.error().empty();
  }
  EXPECT_GT(refused, 0);
}

TEST(Meshopt, DamagedDataNeverCrash) { shake<MeshoptSample>(200); }

/// Two triangles compressed with Draco.
struct DracoSample : Sample {
  DracoSample() {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int position =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int texcoord =
        builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    const float corners[4][3] = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 1}};
    const float places[4][2] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    for (int face = 0; face < 2; ++face) {
      const int c[3] = {0, face + 1, face + 2};
      builder.SetAttributeValuesForFace(position, draco::FaceIndex(face), corners[c[0]],
                                        corners[c[1]], corners[c[2]]);
      builder.SetAttributeValuesForFace(texcoord, draco::FaceIndex(face), places[c[0]],
                                        places[c[1]], places[c[2]]);
    }
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 12);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    const int packed =
        view(std::vector<std::uint8_t>(buffer.data(), buffer.data() + buffer.size()));
    add("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 4}});
    add("accessors", {{"componentType", 5126}, {"type", "VEC2"}, {"count", 4}});
    add("accessors", {{"componentType", 5123}, {"type", "SCALAR"}, {"count", 6}});
    Json& p = primitive({{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"indices", 2}});
    p["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", packed}, {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}};
    json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  }
  Json& extension() {
    return json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
  }
};

TEST(Draco, GeometryIsReadAsIfPlain) {
  DracoSample sample;
  const glint::Scene scene = sample.load();
  EXPECT_THAT(scene.warnings, IsEmpty());
  const glint::Mesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.indices.size(), 6u);
  glm::dvec3 sum(0);
  for (const std::uint32_t i : mesh.indices) sum += mesh.origin + glm::dvec3(mesh.positions[i]);
  // 14 bits over 4 units leave 1.2e-4 per corner; the corners are used 2, 1, 2 and 1 times.
  EXPECT_NEAR(sum.x, 12, 1e-3);
  EXPECT_NEAR(sum.y, 12, 1e-3);
  EXPECT_NEAR(sum.z, 1, 1e-3);
}

TEST(Draco, WhatDoesNotFitIsRefusedByPlace) {
  struct Case {
    void (*breakIt)(DracoSample&);
    const char* message;
  };
  const Case cases[] = {
      {[](DracoSample& s) { s.extension()["attributes"]["POSITION"] = 9; }, "does not have"},
      {[](DracoSample& s) { s.extension()["attributes"]["POSITION"] = "x"; }, "POSITION"},
      {[](DracoSample& s) { s.extension()["bufferView"] = 5; }, "bufferView"},
      {[](DracoSample& s) { s.extension().erase("attributes"); }, "attributes is missing"},
      {[](DracoSample& s) { s.json["accessors"][1]["type"] = "VEC4"; }, "fewer components"},
      {[](DracoSample& s) { s.json["accessors"][0]["type"] = "MAT4"; }, "not a vector"},
      {[](DracoSample& s) { s.json["bufferViews"][0]["byteLength"] = 20; }, "damaged"},
      {[](DracoSample& s) { s.binary[0] = 'X'; }, "damaged"},
  };
  for (const Case& c : cases) {
    DracoSample sample;
    c.breakIt(sample);
    EXPECT_THAT(sample.error(), HasSubstr(c.message));
  }
}

TEST(Draco, DamagedDataNeverCrash) { shake<DracoSample>(200); }

Bytes webp(int width, int height) {
  Bytes pixels;
  for (int i = 0; i < width * height; ++i)
    pixels.insert(pixels.end(), {std::uint8_t(i), std::uint8_t(2 * i), 7, std::uint8_t(255 - i)});
  std::uint8_t* packed = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(pixels.data(), width, height, 4 * width, &packed);
  Bytes bytes(packed, packed + size);
  WebPFree(packed);
  return bytes;
}

TEST(Webp, PixelsAreThoseEncoded) {
  const Bytes bytes = webp(5, 3);
  const glint::ByteImage image = glint::decodeTexture(std::as_bytes(std::span(bytes)), "a.webp");
  ASSERT_EQ(image.width, 5);
  ASSERT_EQ(image.height, 3);
  for (int i = 0; i < 15; ++i) {
    EXPECT_EQ(image.values[std::size_t(4 * i)], i);
    EXPECT_EQ(image.values[std::size_t(4 * i + 1)], 2 * i);
    EXPECT_EQ(image.values[std::size_t(4 * i + 3)], 255 - i);
  }
}

TEST(Webp, TakesThePlaceOfTheFallback) {
  Sample sample;
  sample.triangle()["material"] = 0;
  sample.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      sample.accessor<float>("VEC2", {0, 1, 1, 1, 0, 0});
  sample.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  sample.json["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
  sample.json["images"] = {{{"bufferView", sample.view(webp(4, 4))}, {"mimeType", "image/webp"}}};
  sample.json["extensionsRequired"] = {"EXT_texture_webp"};
  const glint::Scene scene = sample.load();
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_TRUE(scene.materials.at(0).colorTexture.has_value());
}

TEST(Webp, DamagedDataAreRefusedInOneLine) {
  const Bytes good = webp(16, 16);
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    Bytes bytes = good;
    if (i % 2) bytes.resize(random() % bytes.size());
    for (int k = 0; k < i % 4 && !bytes.empty(); ++k)
      bytes[random() % bytes.size()] = std::uint8_t(random());
    glint::test::messageOf(
        [&] { glint::decodeTexture(std::as_bytes(std::span(bytes)), "a.webp"); });
  }
}

}  // namespace gltf_compression_test
