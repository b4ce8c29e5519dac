// Inputs larger than they look: headers that claim more than fits, files with holes, and models
// from stdin that name files.

#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>

#include "gltf_sample.h"
#include "running.h"

namespace glint::test::safety_limits_cli_test {

using testing::HasSubstr;

namespace fs = std::filesystem;
// The memory of a run that reads only headers, and draws; a sanitizer keeps freed memory.
#ifdef __SANITIZE_ADDRESS__
constexpr long fewKib = 1 << 20;
#else
constexpr long fewKib = 300 << 10;
#endif

std::string littleEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 0; shift < 32; shift += 8) bytes += char(value >> shift & 255);
  return bytes;
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + littleEndian(std::uint32_t(value.size())) + value;
}

/// An OpenEXR file of RGB halves with its header and an empty line table.
std::string exrOf(int width, int height) {
  std::string channels, box;
  for (const char* name : {"B", "G", "R"})
    channels += name + std::string(1, '\0') + littleEndian(1) + littleEndian(0) + littleEndian(1) +
                littleEndian(1);
  for (const int side : {0, 0, width - 1, height - 1}) box += littleEndian(std::uint32_t(side));
  const std::string one("\0\0\x80\x3f", 4);
  return littleEndian(20000630) + littleEndian(2) +
         attribute("channels", "chlist", channels + '\0') +
         attribute("compression", "compression", "\3") + attribute("dataWindow", "box2i", box) +
         attribute("displayWindow", "box2i", box) +
         attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
         attribute("pixelAspectRatio", "float", one) +
         attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
         attribute("screenWindowWidth", "float", one) + '\0' +
         std::string(std::size_t(8) * std::size_t((height + 15) / 16), '\0');
}

std::string hdrOf(int width, int height) {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
         std::to_string(width) + "\n" + std::string(4000, '\2');
}

/// Extends a file with a hole, which takes no room on the disk; false if that is not supported.
bool lengthen(const std::string& path, std::uintmax_t size) {
  std::error_code error;
  fs::resize_file(path, size, error);
  return !error;
}

Ran lit(const std::string& environment, const std::string& out, const Arguments& more = {}) {
  return runGlint(quick({"render", shipped + "torus.glb", "-o", out, "--shading", "environment",
                         "--hdri-file", environment},
                        more));
}

TEST(EnvironmentPicture, IsRefusedByItsHeader) {
  const Folder folder("environments");
  struct Case {
    std::string name, bytes;
  };
  const std::vector<Case> cases{
      {"wide.hdr", hdrOf(100000, 50000)},  // 5 billion pixels
      {"wide.exr", exrOf(100000, 50000)},
      {"large.hdr", hdrOf(10000, 8000)},  // 1.2 GiB as floats, from a few kilobytes
      {"large.exr", exrOf(10000, 8000)},
      {"wide.pfm", "PF\n100000 50000\n-1.0\n" + std::string(100, '\0')},
  };
  for (const Case& each : cases) {
    SCOPED_TRACE(each.name);
    writeText(folder / each.name, each.bytes);
    const Ran ran = lit(folder / each.name, folder / "a.png");
    expectRefusal(ran, each.name + ": ");
    EXPECT_THAT(ran.err, HasSubstr("pixels are too many"));
    EXPECT_THAT(ran.err, HasSubstr("raise --decode-limit"));
    EXPECT_LT(ran.peakKib, fewKib);
    EXPECT_FALSE(fs::exists(folder / "a.png"));
  }
}

TEST(EnvironmentPicture, KeepsToTheDecodeLimit) {
  const Folder folder("environment");
  // 512 x 256 pixels, all 1: 2 MiB as floats, and three times 0.66 MiB.
  std::string picture = "PF\n512 256\n-1.0\n";
  for (int i = 0; i < 3 * 512 * 256; ++i) picture += std::string("\0\0\x80\x3f", 4);
  writeText(folder / "e.pfm", picture);
  EXPECT_EQ(lit(folder / "e.pfm", folder / "a.png").status, 0);
  EXPECT_EQ(lit(folder / "e.pfm", folder / "a.png", {"--decode-limit", "1"}).status, 0);
  writeText(folder / "large.pfm", "PF\n512 512\n-1.0\n" + std::string(3 * 4 * 512 * 512, '\0'));
  expectRefusal(lit(folder / "large.pfm", folder / "b.png", {"--decode-limit", "1"}),
                "512 x 512 pixels are too many: decoded they take more than 3 MiB");
}

TEST(DamagedExr, AsksForNoMoreThanItHas) {
  const Folder folder("exr");
  // An attribute that claims to have two gigabytes.
  std::string bytes = exrOf(8, 8);
  const std::size_t at = bytes.find("chlist") + 7;
  bytes.replace(at, 4, littleEndian(0x7fffffff));
  writeText(folder / "a.exr", bytes);
  const Ran ran = lit(folder / "a.exr", folder / "a.png");
  expectRefusal(ran, "the EXR is truncated");
  EXPECT_LT(ran.peakKib, fewKib);
  const Ran compared = runGlint({"diff", folder / "a.exr", folder / "a.exr"});
  EXPECT_EQ(compared.status, 2);
  EXPECT_LT(compared.peakKib, fewKib);
}

TEST(Holes, OfAFileAreNotRead) {
  const Folder folder("holes");
  writeText(folder / "nothing", "");
  writeText(folder / "begun.gltf", "{");
  if (!lengthen(folder / "nothing", std::uintmax_t(1) << 40) ||
      !lengthen(folder / "begun.gltf", std::uintmax_t(1) << 40))
    GTEST_SKIP() << "this file system has no files of a terabyte";
  const std::string torus = shipped + "torus.glb", out = folder / "a.png";
  const std::vector<std::vector<std::string>> commands{
      quick({"render", folder / "nothing", "-o", out}),
      quick({"render", folder / "begun.gltf", "-o", out}),
      {"info", folder / "begun.gltf"},
      {"convert", folder / "begun.gltf", folder / "b.gltf", "--material", "exponent=7"},
      quick({"render", torus, "-o", out, "--look", folder / "nothing"}),
      quick({"render", torus, "-o", out, "--max-error", "0.1", "--cost-table", folder / "nothing"}),
      quick({"render", torus, "-o", out, "--shading", "environment", "--hdri-file",
             folder / "nothing"}),
      {"diff", folder / "nothing", folder / "nothing"},
      quick({"render", "--from-list", folder / "nothing", "-o", folder / "{n}.png"}),
  };
  for (const auto& command : commands) {
    SCOPED_TRACE(testing::PrintToString(command));
    const auto start = std::chrono::steady_clock::now();
    const Ran ran = runGlint(command);
    EXPECT_EQ(ran.status, 2) << ran.err;
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    EXPECT_LT(ran.peakKib, fewKib);
  }
}

TEST(Holes, OfAGlbAreNotRead) {
  Sample sample;
  sample.triangle();
  // As long as a GLB can be, of which 36 bytes are used.
  constexpr std::uint32_t chunk = 0xf0000000;
  Json whole = sample.json;
  whole["buffers"] = Json::array({{{"byteLength", chunk}}});
  std::string text = whole.dump();
  text.append(-text.size() % 4, ' ');
  const std::string head = littleEndian(std::uint32_t(text.size())) + "JSON" + text;
  const std::string bytes = "glTF" + littleEndian(2) +
                            littleEndian(std::uint32_t(12 + head.size() + 8 + chunk)) + head +
                            littleEndian(chunk) + std::string("BIN\0", 4) +
                            std::string(sample.binary.begin(), sample.binary.end());
  const std::string model = (sample.folder() / "m.glb").string();
  writeText(model, bytes);
  if (!lengthen(model, 12 + head.size() + 8 + std::uintmax_t(chunk)))
    GTEST_SKIP() << "this file system has no files of four gigabytes";
  const auto secondsOf = [&](const std::string& of) {
    const auto start = std::chrono::steady_clock::now();
    const Ran ran = runGlint(quick({"render", of, "-o", (sample.folder() / "a.png").string()}));
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_LT(ran.peakKib, fewKib);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  // Four gigabytes take seconds to read and hash.
  const double sound = secondsOf(sample.writeGlb().string());
  EXPECT_LT(secondsOf(model), 1 + 3 * sound);
}

TEST(Confine, TakesAModelFromStdinThatNamesNoFiles) {
  Sample sample;
  sample.triangle();
  const fs::path folder = sample.folder();
  const std::string picture = (folder / "a.png").string();
  const Arguments draw = quick({"render", "-", "--confine", "-o", picture});
  const fs::path whole = sample.writeGlb();
  EXPECT_EQ(piped(contents(whole.string()), {"info", "-", "--confine"}).status, 0);
  const Ran drawn = piped(contents(whole.string()), draw);
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_TRUE(fs::exists(picture));
  fs::remove(picture);
  // Whatever it names: an absolute path, a relative one, or an open file of the process.
  const std::string absolute = (folder / "sample.bin").string();
  for (const std::string& name : {absolute, std::string("sample.bin"), std::string("0"),
                                  std::string("../maps"), std::string("../../../etc/passwd")}) {
    SCOPED_TRACE(name);
    sample.buffers = Json::array({{{"uri", name}, {"byteLength", sample.binary.size()}}});
    expectRefusal(piped(contents(sample.writeGltf().string()), draw), "stdin: buffers[0]");
    EXPECT_FALSE(fs::exists(picture));
  }
}

TEST(Memory, OfJsonKeepsToAMultipleOfTheFile) {
  Sample sample;
  const auto peakOf = [&](const std::string& list, std::size_t bytes, const std::string& item) {
    std::string text = R"({"asset": {"version": "2.0"}, "scene": 0, ")" + list + "\": [" + item;
    while (text.size() < bytes) text += "," + item;
    text += "]}";
    const Ran ran = runGlint({"info", sample.writeText(text, "m.gltf").string()});
    EXPECT_LE(ran.status, 2);
    return ran.peakKib * 1024;
  };
  const long base = peakOf("nodes", 1, "{}");
  constexpr long size = 2 << 20;
  // Inputs whose few bytes need the most memory: empty texts, long ones, numbers, and nesting.
  const std::string deep = std::string(50, '[') + std::string(50, ']');
  const std::string named = R"({"name":")" + std::string(100000, 'x') + R"("})";
  for (const std::string& item :
       {std::string(R"("")"), std::string("1e9"), deep, named, std::string(R"({"":{"":{}}})"),
        std::string(R"({"extras":{"a":[]}})")})
    for (const char* list : {"extras", "materials"})
      EXPECT_LT(peakOf(list, size, item) - base, 128 * size) << list << " " << item.substr(0, 40);
  // Nothing, and minimal items.
  for (const char* item :
       {"{}", R"({"abc":123})", R"({"a":1})", "[]", "0", R"({"name":""})", R"({"mesh":0})"})
    for (const char* list : {"nodes", "materials", "textures", "meshes", "accessors", "animations",
                             "extras", "scenes"}) {
      // As docs/safety.md says.
      EXPECT_LT(peakOf(list, size, item) - base, 128 * size) << list << " " << item;
    }
}

TEST(Memory, TooLittleToBeginWithIsTold) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "a sanitizer needs terabytes of addresses";
#endif
  const Folder folder("little");
  const std::string err = folder / "err";
  for (const int limit : {60000, 100000, 150000}) {  // KiB
    SCOPED_TRACE(limit);
    const int status = std::system(("ulimit -v " + std::to_string(limit) + "; exec '" +
                                    GLINT_EXECUTABLE "' info x.glb > /dev/null 2> '" + err + "'")
                                       .c_str());
    ASSERT_TRUE(WIFEXITED(status)) << contents(err);
    // 127: there is not even room for the libraries.
    EXPECT_THAT(WEXITSTATUS(status), testing::AnyOf(2, 127)) << contents(err);
    EXPECT_THAT(contents(err), testing::Not(HasSubstr("terminate")));
  }
}

// A driver that waits for threads that it could not start would wait for ever.
TEST(Threads, FewOrNoneAreEnough) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "a sanitizer starts threads of its own";
#endif
  const Folder folder("threads");
  const std::string preload = GLINT_BINARY_DIR "/tests/fake/no-threads/libthreads.so";
  ASSERT_TRUE(fs::exists(preload));
  for (const char* backend : {"osmesa", "egl-software"})
    for (const char* threads : {"0", "1", "2", "4", "7"}) {
      SCOPED_TRACE(std::string(backend) + " " + threads);
      const Ran ran = runGlint(
          {"render", shipped + "torus.glb", shipped + "sphere.glb", "-o", folder / "{model}.png",
           "--resolution", "32,32", "--rendering-backend", backend},
          {.environment = {{"LD_PRELOAD", preload}, {"THREADS", threads}}});
      EXPECT_EQ(ran.status, 0) << ran.err;
      EXPECT_EQ(ran.err, "");
    }
}

TEST(Threads, OfALimitedAddressSpaceToo) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "a sanitizer needs terabytes of addresses";
#endif
  const Folder folder("addresses");
  for (int limit = 300000; limit <= 700000; limit += 50000) {  // KiB
    const int status =
        std::system(("ulimit -v " + std::to_string(limit) + "; exec timeout -k 1 60 '" +
                     GLINT_EXECUTABLE "' render '" + shipped + "torus.glb" + "' -o '" +
                     (folder / "x.png") + "' --rendering-backend osmesa 2> /dev/null")
                        .c_str());
    ASSERT_TRUE(WIFEXITED(status)) << limit;
    EXPECT_THAT(WEXITSTATUS(status), testing::AnyOf(0, 1, 2, 3)) << limit;
  }
}

}  // namespace glint::test::safety_limits_cli_test
