// Hostile files and typing mistakes: input files are never lost, and nothing runs out of control.

#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>

#include "command.h"
#include "glint/image/png_bytes.h"
#include "glint/image/read_image.h"
#include "gltf_sample.h"

namespace glint::test::safety_cli_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

namespace fs = std::filesystem;
using Bytes = std::vector<unsigned char>;

/// A PNG of one colour.
Bytes plainPng(int width, int height, int red = 200) {
  std::vector<std::uint8_t> rgba;
  for (std::size_t i = 0; i < std::size_t(width) * height; ++i)
    for (const int code : {red, 100, 50, 255}) rgba.push_back(std::uint8_t(code));
  const auto png = glint::pngOfRgba(rgba, width, height);
  const auto* begin = reinterpret_cast<const unsigned char*>(png.data());
  return {begin, begin + png.size()};
}

/// A triangle that shows an image, described by `image`, with its own material.
void show(Sample& sample, const Json& image, const std::string& name = "Paint") {
  const int source = sample.add("images", image);
  const int texture = sample.add("textures", {{"source", source}});
  const int material = sample.add(
      "materials",
      {{"name", name}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}});
  Json& primitive = sample.triangle();
  primitive["material"] = material;
  primitive["attributes"]["TEXCOORD_0"] = sample.accessor<float>("VEC2", {0, 0, 1, 0, 0, 1});
}

Json inView(Sample& sample, const Bytes& bytes) {
  return {{"bufferView", sample.view(bytes)}, {"mimeType", "image/png"}};
}

std::string write(const fs::path& path, const Bytes& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  return path.string();
}

Ran draw(const fs::path& model, const fs::path& out, const Arguments& more = {}) {
  return runGlint(quick({"render", model.string(), "-o", out.string()}, more));
}

/// The command line under a shell, to close descriptors and set limits.
Ran underShell(const std::string& prefix, const Arguments& arguments, const std::string& suffix,
               const std::string& folder) {
  std::string line = prefix + " exec '" GLINT_EXECUTABLE "'";
  for (const std::string& each : arguments) line += " '" + each + "'";
  line += " " + suffix;
  std::ofstream(folder + "/run.sh") << line;
  const std::string base = folder + "/ran";
  const int status = std::system(
      ("sh '" + folder + "/run.sh' > '" + base + ".out' 2> '" + base + ".err' < /dev/null")
          .c_str());
  Ran ran;
  if (WIFEXITED(status)) ran.status = WEXITSTATUS(status);
  ran.out = contents(base + ".out");
  ran.err = contents(base + ".err");
  for (const char* name : {"/run.sh", "/ran.out", "/ran.err"}) fs::remove(folder + name);
  return ran;
}

TEST(NoOutput, IsAFileThatIsRead) {
  Sample sample;
  const fs::path folder = sample.folder();
  const std::string texture = write(folder / "tree.png", plainPng(4, 4));
  show(sample, {{"uri", "tree.png"}});
  const fs::path model = sample.writeGltf("tree.gltf");
  fs::create_hard_link(texture, folder / "hard.png");
  fs::create_symlink("tree.png", folder / "soft.png");
  const std::string before = contents(texture), bin = contents((folder / "sample.bin").string());
  for (const char* name : {"{model}.png", "hard.png", "soft.png", "./tree.png"}) {
    SCOPED_TRACE(name);
    expectRefusal(draw(model, folder / name), "would be overwritten");
    EXPECT_EQ(contents(texture), before);
  }
  // For any output and any input.
  const std::string look = (folder / "l.json").string();
  std::ofstream(look) << R"({"glint-look": 1})";
  const std::string environment = write(folder / "env.png", plainPng(8, 4));
  const std::string list = (folder / "list").string();
  std::ofstream(list) << "tree.gltf\n" << model.string() << "\n";
  const std::vector<Arguments> commands{
      {"render", model.string(), "-o", (folder / "a.png").string(), "--look", look, "--json", look},
      {"render", model.string(), "-o", (folder / "a.png").string(), "--look", look, "--save-look",
       look},
      {"render", model.string(), "-o", environment, "--hdri-file", environment, "--shading",
       "environment"},
      {"render", "--from-list", list, "-o", list + ".png", "--json", list},
      {"info", model.string(), "--json", texture},
      {"info", model.string(), "--json", (folder / "sample.bin").string()},
  };
  for (const auto& command : commands) {
    SCOPED_TRACE(command.back());
    const std::string environmentBefore = contents(environment), listBefore = contents(list);
    const Ran ran = runGlint(command);
    EXPECT_EQ(ran.status, 2) << ran.err;
    EXPECT_EQ(contents(look), R"({"glint-look": 1})");
    EXPECT_EQ(contents(environment), environmentBefore);
    EXPECT_EQ(contents(list), listBefore);
    EXPECT_EQ(contents(texture), before);
    EXPECT_EQ(contents((folder / "sample.bin").string()), bin);
  }
}

TEST(NoOutput, OfConvertIsABufferOfTheModel) {
  Sample sample;
  sample.add("materials", {{"name", "Paint"}});
  sample.triangle()["material"] = 0;
  sample.buffers = Json::array({{{"uri", "b.gltf"}, {"byteLength", sample.binary.size()}}});
  const fs::path model = sample.writeGltf("o.gltf"), buffer = sample.folder() / "b.gltf";
  fs::rename(sample.folder() / "sample.bin", buffer);
  const std::string before = contents(buffer.string());
  const Ran ran =
      runGlint({"convert", model.string(), buffer.string(), "--material", "exponent=7"});
  EXPECT_EQ(ran.status, 2) << ran.err;
  EXPECT_EQ(contents(buffer.string()), before);
}

TEST(DeepNesting, IsRefusedInOneLineAndTheOtherModelsAreDrawn) {
  Sample sample;
  const fs::path folder = sample.folder();
  const std::string deep(100000, '[');
  std::ofstream(folder / "m.gltf") << R"({"asset": {"version": "2.0"}, "extras": )" << deep;
  std::ofstream(folder / "l.json") << R"({"glint-look": 1, "material": )" << deep;
  std::ofstream(folder / "c.json") << R"({"glint-costs": 1, "noise": )" << deep;
  expectRefusal(draw(folder / "m.gltf", folder / "a.png"), "nested");
  expectRefusal(runGlint({"info", (folder / "m.gltf").string()}), "nested");
  expectRefusal(runGlint({"convert", (folder / "m.gltf").string(), (folder / "n.gltf").string()}),
                "nested");
  expectRefusal(
      draw(shipped + "torus.glb", folder / "a.png", {"--look", (folder / "l.json").string()}),
      "nested");
  expectRefusal(draw(shipped + "torus.glb", folder / "a.png",
                     {"--max-error", "0.1", "--cost-table", (folder / "c.json").string()}),
                "nested");
  std::ofstream(folder / "list") << (folder / "m.gltf").string() << "\n"
                                 << shipped << "torus.glb\n";
  const Ran ran = runGlint(quick({"render", "--from-list", (folder / "list").string(), "-o",
                                  (folder / "{model}.png").string()}));
  EXPECT_EQ(ran.status, 2);
  EXPECT_TRUE(fs::exists(folder / "torus.png")) << ran.err;
}

TEST(Descriptors, ThatAreClosedAreTold) {
  Sample sample;
  const std::string folder = sample.folder().string();
  const Ran in =
      underShell("", {"render", "--from-list", "-", "-o", folder + "/{model}.png"}, "<&-", folder);
  expectRefusal(in, "standard input");
  const Ran out =
      underShell("", quick({"render", shipped + "torus.glb", "-o", "-"}), ">&-", folder);
  expectRefusal(out, "standard output");
  // A warning must not land in the report, which gets the lowest descriptor.
  sample.json["extensionsUsed"] = {"XY_unknown"};
  sample.triangle();
  const std::string model = sample.writeGltf().string(), report = folder + "/r.json";
  const Ran error = underShell(
      "", quick({"render", model, "-o", folder + "/a.png", "--json", report}), "2>&-", folder);
  EXPECT_EQ(error.status, 0);
  EXPECT_TRUE(Json::accept(contents(report)));
}

TEST(Limits, OfFileSizeAndOfTemporaryFoldersAreTold) {
  Sample sample;
  const std::string folder = sample.folder().string();
  const Ran size = underShell(
      "ulimit -f 1;", {"render", shipped + "teapot.glb", "-o", folder + "/a.exr"}, "", folder);
  expectRefusal(size, "ulimit -f");
  EXPECT_FALSE(fs::exists(folder + "/a.exr"));
  ASSERT_EQ(draw(shipped + "torus.glb", folder + "/a.png").status, 0);
  fs::copy_file(folder + "/a.png", folder + "/b.png");
  const Ran html =
      runGlint({"diff", folder + "/a.png", folder + "/b.png", "--html", folder + "/d.html"},
               {.environment = {{"TMPDIR", folder + "/none"}}});
  EXPECT_THAT(html.err, Not(HasSubstr("internal error")));
  EXPECT_LE(html.status, 2);
}

TEST(Resolution, HasNoShapeThatIsRefused) {
  Sample sample;
  for (const char* size : {"20,20000", "20000,20", "1,65535"}) {
    SCOPED_TRACE(size);
    const Ran ran = draw(shipped + "torus.glb", sample.folder() / "a.png", {"--resolution", size});
    ASSERT_EQ(ran.status, 0) << ran.err;
    const glint::Image image = glint::readImage((sample.folder() / "a.png").string());
    EXPECT_EQ(std::to_string(image.width) + "," + std::to_string(image.height), size);
  }
}

TEST(Decoding, WhatIsLongerThanTexturesAreIsScaledDown) {
  Sample sample;
  show(sample, inView(sample, plainPng(20000, 4)));
  const Ran ran = draw(sample.writeGlb(), sample.folder() / "a.png");
  EXPECT_EQ(ran.status, 0);
  ASSERT_EQ(ran.errorLines().size(), 1u) << ran.err;
  EXPECT_THAT(ran.err, AllOf(HasSubstr("20000 x 4 pixels is reduced to 10000 x 2 pixels"),
                             HasSubstr("16384")));
  // The colour is still the texture's and not that of a material without one.
  Sample small;
  show(small, inView(small, plainPng(8, 8)));
  ASSERT_EQ(draw(small.writeGlb(), small.folder() / "b.png").status, 0);
  EXPECT_EQ(glint::readImage((sample.folder() / "a.png").string()).values,
            glint::readImage((small.folder() / "b.png").string()).values);
}

TEST(Decoding, KeepsToALimitForTheSum) {
  Sample sample;
  // 2048 x 2048 takes 16 MiB, 21.3 with the mip levels; each is a different picture.
  for (int i = 0; i < 3; ++i) show(sample, inView(sample, plainPng(2048, 2048, i)));
  const fs::path model = sample.writeGlb(), out = sample.folder() / "a.png";
  const Ran plenty = draw(model, out);
  EXPECT_EQ(plenty.status, 0);
  EXPECT_THAT(plenty.err, IsEmpty());
  // For 40 x 30 pixels a size of 1024 is enough: 16 MiB in all; textures are reduced in turn until
  // they fit.
  const Ran tight = draw(model, out, {"--decode-limit", "17"});
  EXPECT_EQ(tight.status, 0);
  ASSERT_EQ(tight.errorLines().size(), 3u) << tight.err;
  EXPECT_THAT(tight.err, HasSubstr("2048 x 2048 pixels is reduced to 1024 x 1024 pixels"));
  expectRefusal(draw(model, sample.folder() / "b.png", {"--decode-limit", "15.9"}),
                "make it smaller or raise --decode-limit");
  EXPECT_FALSE(fs::exists(sample.folder() / "b.png"));
  // A large picture needs all of them.
  expectRefusal(draw(model, out, {"--decode-limit", "17", "--resolution", "1025,4"}),
                "take 64 MiB, more than 17 MiB");
}

TEST(Decoding, EqualPicturesCountOnce) {
  Sample sample;
  const Bytes png = plainPng(1024, 1024);
  for (int i = 0; i < 20; ++i) show(sample, inView(sample, png), "Paint" + std::to_string(i));
  const Ran ran = draw(sample.writeGlb(), sample.folder() / "a.png", {"--decode-limit", "6"});
  EXPECT_EQ(ran.status, 0);
  EXPECT_THAT(ran.err, IsEmpty());
}

TEST(Reading, StopsAtWhatIsNeeded) {
  Sample sample;
  sample.triangle();
  const fs::path model = sample.writeGltf();
  std::error_code error;
  // Holes: a terabyte that takes no room on the disk.
  fs::resize_file(sample.folder() / "sample.bin", std::uintmax_t(1) << 40, error);
  if (error) GTEST_SKIP() << "this file system has no files of a terabyte";
  const auto start = std::chrono::steady_clock::now();
  const Ran ran = draw(model, sample.folder() / "a.png");
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  // A buffer of that length, of which a few bytes are used.
  sample.buffers = Json::array({{{"uri", "sample.bin"}, {"byteLength", std::uint64_t(1) << 40}}});
  sample.json["bufferViews"][0]["byteLength"] = std::uint64_t(1) << 40;
  std::ofstream(sample.folder() / "wide.gltf") << [&] {
    Json whole = sample.json;
    whole["buffers"] = sample.buffers;
    return whole.dump();
  }();
  const Ran wide = draw(sample.folder() / "wide.gltf", sample.folder() / "b.png");
  EXPECT_EQ(wide.status, 0) << wide.err;
  EXPECT_LT(wide.peakKib, 1 << 20);
}

TEST(Reading, OfAnEndlessImageIsRefused) {
  Sample sample;
  show(sample, {{"uri", "tree.png"}});
  const fs::path model = sample.writeGltf(), picture = sample.folder() / "tree.png";
  for (const bool isPng : {false, true}) {
    write(picture, isPng ? plainPng(4, 4) : Bytes{});
    std::error_code error;
    fs::resize_file(picture, std::uintmax_t(1) << 40, error);
    if (error) GTEST_SKIP() << "this file system has no files of a terabyte";
    const Ran ran = draw(model, sample.folder() / "a.png");
    EXPECT_EQ(ran.status, 0);
    EXPECT_THAT(ran.err, HasSubstr("drawn without it"));
    EXPECT_LT(ran.peakKib, 1 << 20);
  }
}

TEST(Confine, RefusesWhatLiesOutsideOfTheModelsFolder) {
  Sample sample;
  const fs::path folder = sample.folder(), inner = folder / "inner";
  fs::create_directories(inner / "below");
  write(folder / "out.png", plainPng(4, 4));
  write(inner / "in.png", plainPng(4, 4));
  write(inner / "below/in.png", plainPng(4, 4));
  fs::create_symlink("../out.png", inner / "link.png");
  fs::create_symlink("in.png", inner / "good.png");
  fs::create_symlink("..", inner / "up");
  show(sample, {{"uri", "in.png"}});
  const auto model = [&](const std::string& image, const std::string& buffer) {
    Json whole = sample.json;
    whole["images"][0]["uri"] = image;
    whole["buffers"] = Json::array({{{"uri", buffer}, {"byteLength", sample.binary.size()}}});
    std::ofstream(inner / "m.gltf") << whole.dump();
    return (inner / "m.gltf").string();
  };
  write(inner / "in.bin", sample.binary);
  write(folder / "out.bin", sample.binary);
  const auto commands = [&](const std::string& path) {
    return std::vector<Arguments>{
        quick({"render", path, "-o", (folder / "a.png").string()}),
        {"info", path},
        {"convert", path, (inner / "new.gltf").string(), "--material", "exponent=7"}};
  };
  struct Case {
    std::string image, buffer;
    bool good;
  };
  const std::vector<Case> cases{
      {"in.png", "in.bin", true},       {"below/in.png", "in.bin", true},
      {"good.png", "in.bin", true},     {"below/../in.png", "in.bin", true},
      {"../out.png", "in.bin", false},  {"link.png", "in.bin", false},
      {"up/out.png", "in.bin", false},  {"%2e%2e/out.png", "in.bin", false},
      {"..\\out.png", "in.bin", false}, {(folder / "out.png").string(), "in.bin", false},
      {"in.png", "../out.bin", false},  {"in.png", (folder / "out.bin").string(), false}};
  for (const Case& each : cases) {
    SCOPED_TRACE(each.image + " " + each.buffer);
    const std::string path = model(each.image, each.buffer);
    for (auto command : commands(path)) {
      SCOPED_TRACE(command.front());
      EXPECT_EQ(runGlint(command).status, 0);
      command.push_back("--confine");
      const Ran ran = runGlint(command);
      EXPECT_EQ(ran.status, each.good ? 0 : 2) << ran.err;
      if (!each.good) {
        EXPECT_THAT(ran.err, HasSubstr("is outside the model's folder"));
      }
    }
  }
  // The model itself may also be a link that leads out.
  fs::rename(inner / "m.gltf", folder / "m.gltf");
  fs::create_symlink("../m.gltf", inner / "m.gltf");
  expectRefusal(runGlint({"info", (inner / "m.gltf").string(), "--confine"}),
                "is outside the model's folder");
}

TEST(Converting, TakesATimeThatGrowsWithTheFile) {
  Sample sample;
  for (int i = 0; i < 8000; ++i)
    sample.add("materials", {{"name", "m" + std::to_string(i)}, {"doubleSided", true}});
  sample.triangle()["material"] = 0;
  const fs::path model = sample.writeGltf();  // about half a megabyte
  const auto start = std::chrono::steady_clock::now();
  const Ran ran = runGlint({"convert", model.string(), (sample.folder() / "out.gltf").string(),
                            "--material", "exponent=7"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  // A second, plus a margin for a busy machine; a quadratic algorithm took more than ten minutes.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(Names, DoNotReachATerminalAsTheyAre) {
  Sample sample;
  sample.add("materials", {{"name", std::string("\x1b[2J\nred\0x", 9)}});
  sample.add("cameras", {{"name", "\x1b]0;t\x07"},
                         {"type", "perspective"},
                         {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  sample.show({{"camera", 0}, {"name", "\x1b[1m"}});
  sample.triangle()["material"] = 0;
  const Ran ran = runGlint({"info", sample.writeGltf().string()});
  EXPECT_EQ(ran.status, 0);
  for (const std::string& text : {ran.out, ran.err}) {
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_EQ(text.find('\0'), std::string::npos);
    EXPECT_EQ(text.find('\x07'), std::string::npos);
  }
  EXPECT_THAT(ran.out, HasSubstr(R"(\x1b[2J\nred)"));
}

}  // namespace glint::test::safety_cli_test
