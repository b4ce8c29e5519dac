// `glint convert`: the file written looks as `--material` draws it, and all else is unchanged.

#include <gmock/gmock.h>

#include <cmath>

#include "command.h"
#include "gltf_text.h"
#include "scenes.h"

namespace glint::test::convert_cli_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string edit =
    "ambient=0.7,diffuse=0.9,specular=0.6,exponent=33.3,metalness=0.25,ior=1.7,color=0.1,0.4,0.9";

void expectRefusalBesideWarnings(const Ran& ran, const std::string& part) {
  EXPECT_EQ(ran.status, 2);
  std::vector<std::string> lines = ran.errorLines();
  std::erase_if(lines, [](const std::string& line) { return line.starts_with("glint: warning"); });
  ASSERT_EQ(lines.size(), 1u) << ran.err;
  EXPECT_THAT(lines[0], HasSubstr(part));
}

// The picture's values only, because its metadata contains the look.
std::string drawn(const Folder& folder, const std::string& model, const Arguments& more = {}) {
  const Ran ran = runGlint(
      quick({"render", model, "-o", folder / "drawn.pfm", "--shading", "environment"}, more));
  EXPECT_EQ(ran.status, 0) << ran.err;
  return contents(folder / "drawn.pfm");
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
}

// A two-file model with content that a careless writer would lose.
std::string peculiar(const Folder& folder, const std::string& name = "model") {
  const std::string path =
      glint::test::writeGltf(name, glint::test::sphere(12, 8), nullptr, folder.path());
  std::string text = contents(path);
  replace(
      text, "{\"accessors\"",
      "{ \"extensionsUsed\" : [\"EXT_of_ours\"],\n  \"extensions\": {\"EXT_of_ours\": {\"big\": "
      "12345678901234567890, \"e\": 1.50e+02, \"z\": [ ], \"a\": null}},\n\"accessors\"");
  std::ofstream(path) << text;
  return path;
}

TEST(Convert, WhatIsWrittenIsWhatTheEditDraws) {
  Folder folder("convert");
  const std::string inputs[] = {shipped + "teapot.glb", shipped + "sphere.glb", peculiar(folder)};
  for (const std::string& in : inputs) {
    const std::string ending = in.substr(in.rfind('.')), out = folder / ("out" + ending);
    const Ran ran = runGlint({"convert", in, out, "--material", edit});
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(drawn(folder, out), drawn(folder, in, {"--material", edit})) << in;
    EXPECT_NE(drawn(folder, out), drawn(folder, in)) << in;
    // Converting again without edits: the same bytes.
    EXPECT_EQ(runGlint({"convert", out, folder / ("again" + ending)}).status, 0);
    EXPECT_EQ(contents(out), contents(folder / ("again" + ending)));
  }
}

/// Roughness, metallic and a share of the reflectance, in all of its channels.
constexpr const char* texels =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAG0lEQVR42mP4H3Di//+eqGkM/0/IRf3P+yUHAGQm"
    "ClZ1fPDOAAAAAElFTkSuQmCC";

/// Gives the material a texture that `use` puts into it; x and y are the texture coordinates.
void addTexture(Json& json, void (*use)(Json& material)) {
  Json positions = json["bufferViews"][0];
  positions["byteStride"] = 12;
  json["bufferViews"].push_back(positions);
  json["accessors"].push_back({{"bufferView", 3},
                               {"componentType", 5126},
                               {"count", json["accessors"][0]["count"]},
                               {"type", "VEC2"}});
  json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 3;
  json["images"] = {{{"uri", texels}}};
  json["textures"] = {{{"source", 0}}};
  use(json["materials"][0]);
}

// A texture leaves the specular strength to the conversion, which reads the numbers that are
// written for other viewers; --normalization shows the share that the strength was converted from.
TEST(Convert, WhatIsConvertedForEachPixelStays) {
  Folder folder("convert_textures");
  const auto sphere = glint::test::sphere(12, 8);
  const auto model = [&](const std::string& name, void (*change)(nlohmann::json&)) {
    return glint::test::writeGltf(name, sphere, change, folder.path());
  };
  const std::string inputs[] = {
      model("plain",
            [](Json& json) {
              json["materials"][0]["pbrMetallicRoughness"] = {{"metallicFactor", 0.3},
                                                              {"roughnessFactor", 0.4}};
            }),
      model("metallic",
            [](Json& json) {
              addTexture(json, [](Json& material) {
                material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
              });
            }),
      model("specular", [](Json& json) {
        addTexture(json, [](Json& material) {
          material["pbrMetallicRoughness"] = {{"metallicFactor", 0.3}, {"roughnessFactor", 0.4}};
          material["extensions"]["KHR_materials_specular"]["specularTexture"] = {{"index", 0}};
        });
        json["extensionsUsed"] = {"KHR_materials_specular"};
      })};
  const std::string out = folder / "out.gltf";
  for (const std::string& in : inputs)
    for (const char* edited : {"ior=2.4", "exponent=50,metalness=0.7", "ambient=0.5"}) {
      expectDone(runGlint({"convert", in, out, "--material", edited}));
      EXPECT_NE(drawn(folder, out), drawn(folder, in)) << in << " " << edited;
      for (const char* normalization : {"none", "simple"})
        EXPECT_EQ(drawn(folder, out, {"--normalization", normalization}),
                  drawn(folder, in, {"--normalization", normalization, "--material", edited}))
            << in << " " << edited << " " << normalization;
    }
}

// The look's normalization is not the file's.
TEST(Convert, ALooksNormalizationIsNotWritten) {
  Folder folder("convert_normalization");
  const std::string in = shipped + "torus.glb";
  std::ofstream(folder / "a.json")
      << R"({"glint-look": 1, "normalization": "simple", "material": {"": {"ambient": 0.5}}})";
  expectDone(runGlint({"convert", in, folder / "a.glb", "--look", folder / "a.json"}));
  expectDone(runGlint({"convert", in, folder / "b.glb", "--material", "ambient=0.5"}));
  EXPECT_EQ(contents(folder / "a.glb"), contents(folder / "b.glb"));
}

TEST(Convert, EverythingElseStays) {
  Folder folder("convert_keeps");
  const std::string in = peculiar(folder);
  runGlint({"convert", in, folder / "out.gltf", "--material", edit});
  std::string before = contents(in), after = contents(folder / "out.gltf");
  // The text differs only in the material and the list of extensions.
  for (std::string* text : {&before, &after}) {
    const auto begin = text->find("\"materials\":["), end = text->find("],\"meshes\"");
    ASSERT_LT(begin, end);
    text->erase(begin, end - begin);
    const auto used = text->find("[\"EXT_of_ours\"");
    text->erase(used, text->find(']', used) - used);
  }
  EXPECT_EQ(before, after);
  const Json material = Json::parse(contents(folder / "out.gltf"))["materials"][0];
  EXPECT_EQ(material["name"], "paint");
  EXPECT_EQ(material["extras"]["glint"]["exponent"], 33.3);
  EXPECT_EQ(material["pbrMetallicRoughness"]["metallicFactor"], 0.25);
  // (2 / (4 exponent + 2))^(1/4)
  EXPECT_NEAR(material["pbrMetallicRoughness"]["roughnessFactor"].get<double>(),
              std::pow(2 / (4 * 33.3 + 2), 0.25), 1e-12);
  EXPECT_EQ(material["extensions"]["KHR_materials_ior"]["ior"], 1.7);

  // In a GLB, everything after the JSON is unchanged.
  runGlint({"convert", shipped + "teapot.glb", folder / "out.glb", "--material", edit});
  const std::string glb = contents(shipped + "teapot.glb"), edited = contents(folder / "out.glb");
  const auto jsonLength = [](const std::string& file) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i)
      length |= std::size_t(static_cast<unsigned char>(file[12 + i])) << (8 * i);
    return length;
  };
  EXPECT_EQ(glb.substr(20 + jsonLength(glb)), edited.substr(20 + jsonLength(edited)));
}

TEST(Convert, TakesTheMaterialsOfALookAndOfAPicture) {
  Folder folder("convert_look");
  const std::string in = shipped + "sphere.glb";
  runGlint(quick({"render", in, "-o", folder / "a.png", "--material", edit, "--save-look",
                  folder / "a.json"}));
  for (const char* look : {"a.png", "a.json"}) {
    expectDone(runGlint({"convert", in, folder / "out.glb", "--look", folder / look}));
    EXPECT_EQ(drawn(folder, folder / "out.glb"), drawn(folder, in, {"--material", edit}));
  }
  // Options take precedence over the look.
  expectDone(runGlint({"convert", in, folder / "out.glb", "--look", folder / "a.json", "--material",
                       "exponent=5"}));
  EXPECT_EQ(drawn(folder, folder / "out.glb"),
            drawn(folder, in, {"--material", edit + ",exponent=5"}));
}

TEST(Convert, FilesBesideTheModelGoWithIt) {
  Folder folder("convert_files"), other("convert_other");
  const std::string in = peculiar(folder), out = other / "out.gltf";
  EXPECT_EQ(runGlint({"convert", in, out, "--material", edit}).status, 0);
  EXPECT_THAT(other.names(), ElementsAre("model.bin", "out.gltf"));
  EXPECT_EQ(contents(folder / "model.bin"), contents(other / "model.bin"));
  EXPECT_EQ(drawn(folder, out), drawn(folder, in, {"--material", edit}));
  // Again: the copies exist already. A different file of that name is not overwritten.
  EXPECT_EQ(runGlint({"convert", in, out, "--material", edit}).status, 0);
  std::ofstream(other / "model.bin") << "something else";
  std::filesystem::remove(out);
  expectRefusalBesideWarnings(runGlint({"convert", in, out, "--material", edit}),
                              "already exists and differs");
  EXPECT_EQ(contents(other / "model.bin"), "something else");
  EXPECT_THAT(other.names(), ElementsAre("model.bin"));
  // Names that lead out of the folder are not followed.
  std::filesystem::create_directories(folder / "inner");
  std::string text = contents(in);
  replace(text, "\"model.bin\"", "\"../model.bin\"");
  std::ofstream(folder / "inner/model.gltf") << text;
  expectRefusalBesideWarnings(
      runGlint({"convert", folder / "inner/model.gltf", out, "--material", edit}),
      "outside its folder");
  EXPECT_THAT(other.names(), ElementsAre("model.bin"));
}

TEST(Convert, TheModelItselfOnlyIfAsked) {
  Folder folder("convert_in_place");
  const std::string in = folder / "a.glb";
  std::filesystem::copy_file(shipped + "sphere.glb", in);
  const std::string before = contents(in);
  expectRefusalBesideWarnings(runGlint({"convert", in, in, "--material", edit}), "--in-place");
  expectRefusalBesideWarnings(runGlint({"convert", in, folder / "../convert_in_place/a.glb"}),
                              "--in-place");
  EXPECT_EQ(contents(in), before);
  expectDone(runGlint({"convert", in, in, "--in-place", "--material", edit}));
  EXPECT_EQ(drawn(folder, in), drawn(folder, shipped + "sphere.glb", {"--material", edit}));
}

TEST(Convert, WhatCannotBe) {
  Folder folder("convert_wrong");
  const std::string in = shipped + "sphere.glb";
  const auto refused = [](const Arguments& arguments, const std::string& part) {
    expectRefusalBesideWarnings(runGlint(joined({"convert"}, arguments)), part);
  };
  refused({in, folder / "a.gltf", "--material", edit}, ".glb");
  refused({in, folder / "a.png", "--material", edit}, ".glb");
  refused({in, folder / "a.glb", "--material", "shine=1"}, "shine");
  refused({in, folder / "a.glb", "--material", "Nobody:ior=2"}, "Nobody");
  refused({folder / "none.glb", folder / "a.glb"}, "none.glb");
  refused({in, "/proc/none/a.glb", "--material", edit}, "/proc/none");
  refused({in}, "OUT");
  EXPECT_THAT(folder.names(), IsEmpty());
  const Ran nothing = runGlint({"convert", in, folder / "a.glb"});
  EXPECT_EQ(nothing.status, 0);
  EXPECT_THAT(nothing.err, HasSubstr("warning"));
  EXPECT_EQ(contents(in), contents(folder / "a.glb"));
}

}  // namespace glint::test::convert_cli_test
