// Containers, URIs and files: the sources of a model.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "glint/gltf/messages.h"
#include "gltf_sample.h"

namespace gltf_file_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = Sample::Json;

TEST(GltfFile, GltfGlbAndDataUriGiveTheSameScene) {
  Sample sample;
  sample.triangle();
  EXPECT_EQ(glint::loadGltf(sample.writeGltf()).meshes.at(0).positions.at(1).x, 1);
  EXPECT_EQ(glint::loadGltf(sample.writeGlb()).meshes.at(0).positions.at(1).x, 1);
  // 36 bytes: nine floats, the fourth and the eighth 1.0.
  for (const char* type : {"application/octet-stream;base64", "application/gltf-buffer;BASE64",
                           "; base64 ", ";charset=x;Base64"}) {
    sample.buffers = {{{"byteLength", 36},
                       {"uri", "data:" + std::string(type) +
                                   ",AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}};
    const glint::Scene scene = sample.load();
    EXPECT_EQ(scene.meshes.at(0).positions.at(1), glm::vec3(1, 0, 0)) << type;
    EXPECT_EQ(scene.meshes.at(0).positions.at(2), glm::vec3(0, 1, 0)) << type;
    EXPECT_EQ(scene.name, "sample");
    EXPECT_THAT(scene.warnings, ElementsAre());
  }
}

TEST(GltfFile, KindIsToldByContent) {
  Sample sample;
  sample.triangle();
  const auto path = sample.writeGlb("binary.gltf");
  EXPECT_EQ(glint::loadGltf(path).meshes.size(), 1u);
}

TEST(GltfFile, UriIsPercentDecoded) {
  Sample sample;
  sample.triangle();
  sample.writeGltf();
  std::filesystem::rename(sample.folder() / "sample.bin", sample.folder() / "a b%.bin");
  for (const char* uri : {"a%20b%25.bin", "a b%.bin", "./a%20b%.bin"}) {
    sample.buffers = {{{"byteLength", 36}, {"uri", uri}}};
    EXPECT_EQ(sample.error(), "") << uri;
  }
}

TEST(GltfFile, MissingBufferIsNamed) {
  Sample sample;
  sample.triangle();
  sample.buffers = {{{"byteLength", 36}, {"uri", "gone.bin"}}};
  EXPECT_EQ(sample.error(),
            "buffers[0], the file \"gone.bin\", does not exist: put it there or export the model "
            "as .glb");
  sample.buffers = {{{"byteLength", 36}, {"uri", "http://host/gone.bin"}}};
  EXPECT_THAT(sample.error(), HasSubstr("is not a file next to the model"));
  sample.buffers = {{{"byteLength", 36}, {"uri", "%00"}}};
  EXPECT_THAT(sample.error(), HasSubstr("is not a file name"));
  sample.buffers = {{{"byteLength", 36}}};
  // Valid, but there is nothing to draw in it.
  const glint::Scene scene = sample.load();
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_THAT(scene.warnings.at(0), HasSubstr("neither a uri nor a binary GLB chunk"));
}

TEST(GltfFile, DevicesFifosAndFoldersAreRefused) {
  Sample sample;
  sample.triangle();
  ASSERT_EQ(::mkfifo((sample.folder() / "fifo").c_str(), 0600), 0);
  EXPECT_THAT(Sample::errorOf(sample.folder() / "fifo"), StartsWith("is not a regular file"));
  EXPECT_THAT(Sample::errorOf(sample.folder()), StartsWith("is a folder"));
  EXPECT_THAT(Sample::errorOf("/dev/zero"), StartsWith("is not a regular file"));
  EXPECT_THAT(Sample::errorOf(sample.folder() / "none.glb"), StartsWith("does not exist"));
  for (const char* uri : {"fifo", ".", "/dev/zero"}) {
    sample.buffers = {{{"byteLength", 36}, {"uri", uri}}};
    EXPECT_THAT(sample.error(), HasSubstr("buffers[0]")) << uri;
  }
}

TEST(GltfFile, OtherFilesAreRefused) {
  Sample sample;
  const auto errorOf = [&](const std::string& text) {
    return Sample::errorOf(sample.writeText(text, "file.glb"));
  };
  EXPECT_THAT(errorOf(""), StartsWith("is empty"));
  EXPECT_THAT(errorOf("solid cube"), StartsWith("is neither GLB nor JSON"));
  EXPECT_THAT(errorOf("{"), StartsWith("not valid JSON"));
  EXPECT_THAT(errorOf("   "), StartsWith("not valid JSON"));
  EXPECT_THAT(errorOf("{\"a\": \"\xff\"}"), StartsWith("not valid JSON"));
  EXPECT_THAT(errorOf("{\"a\": 1e999}"), StartsWith("not valid JSON"));
  EXPECT_THAT(errorOf("{}"), StartsWith("asset is missing"));
  EXPECT_THAT(errorOf("{\"a\":" + std::string(100000, '[')), HasSubstr("nested more than 64"));
  EXPECT_THAT(errorOf("\xef\xbb\xbf{\"asset\":{\"version\":\"2.0\"}}"), "");
}

TEST(GltfFile, DamagedGlbIsRefused) {
  Sample sample;
  const std::string json = "{\"asset\":{\"version\":\"2.0\"}}  ";
  const auto errorOf = [&](const std::string& text) {
    return Sample::errorOf(sample.writeText(text, "file.glb"));
  };
  const auto glb = [&](std::size_t version, std::size_t length, std::size_t chunk,
                       const std::string& type) {
    return "glTF" + Sample::number(version) + Sample::number(length) + Sample::number(chunk) +
           type + json;
  };
  const std::size_t whole = 20 + json.size();
  EXPECT_EQ(errorOf(glb(2, whole, json.size(), "JSON")), "");
  EXPECT_EQ(errorOf(glb(2, whole, json.size(), "JSON") + "behind the end"), "");
  EXPECT_THAT(errorOf("glTF"), StartsWith("ends in its GLB header"));
  EXPECT_THAT(errorOf(glb(1, whole, json.size(), "JSON")), StartsWith("is GLB version 1"));
  EXPECT_THAT(errorOf(glb(2, whole + 1, json.size(), "JSON")), StartsWith("is truncated"));
  EXPECT_THAT(errorOf(glb(2, whole, 0xffffffff, "JSON")), HasSubstr("extends past the end"));
  EXPECT_THAT(errorOf(glb(2, whole, json.size(), "NOSJ")), HasSubstr("is not JSON"));
  EXPECT_THAT(errorOf(glb(2, 12, json.size(), "JSON")), StartsWith("has no JSON chunk"));
}

TEST(GltfFile, TruncationAnywhereIsAnError) {
  Sample sample;
  sample.triangle();
  std::ifstream in(sample.writeGlb(), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(Sample::errorOf(sample.writeText(whole.substr(0, size), "cut.glb")), "") << size;
  }
}

TEST(GltfFile, MessagesAreOneCleanLine) {
  using glint::gltf::printable;
  EXPECT_EQ(printable("a\nb\x1b[31m\x7f"), R"(a\nb\x1b[31m\x7f)");
  EXPECT_EQ(printable("Gr\xc3\xbc\xc3\x9f"), "Gr\xc3\xbc\xc3\x9f");
  EXPECT_EQ(printable("\xc3\x28\xff\xed\xa0\x80\xc2\x9b"), R"(\xc3(\xff\xed\xa0\x80\u009b)");
  EXPECT_EQ(printable("abcdef", 3), "abc...");
  EXPECT_EQ(printable("a\xc3\xbc", 2), "a...");
}

}  // namespace gltf_file_test
