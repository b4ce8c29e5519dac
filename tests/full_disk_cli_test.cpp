// A full disk at every output: one line, a status that reports it, no half-written file.

#include <gmock/gmock.h>

#include <cstdlib>

#include "command.h"

namespace glint::test::full_disk_cli_test {

using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

/// The commands with all their outputs, written to the folder out/ of their working folder.
std::vector<Arguments> commands() {
  const std::string torus = shipped + "torus.glb";
  const auto render = [&](const std::string& words) {
    return joined({"render", torus},
                  split("--resolution 64,48 --rendering-backend osmesa -o " + words));
  };
  return {
      render("out/a.png"),
      render("out/a.png --bit-depth 16"),
      render("out/a.exr"),
      render("out/a.jpg"),
      render("out/a.webp --quality 100"),
      render("out/a --output-format raw"),
      render("out/a.pfm"),
      render("out/a.exr --terms"),
      render("out/a.png --terms"),
      render("out/{frame}.png --turntable 3"),
      render("out/a.png --sweep exponent=1:100:2"),
      render("null.png --json out/a.json"),
      render("null.png --save-look out/a.json"),
      render("out/new/a.png"),
      {"info", torus, "--json", "out/a.json"},
      {"info", torus, "--save-look", "out/a.json", "--material", "exponent=3"},
      {"backends", "--json", "out/b.json"},
      {"convert", torus, "out/a.glb", "--material", "exponent=7"},
      {"environment", "sky", "-o", "out/a.exr"},
      {"diff", "a.png", "b.png", "--output", "out/d.png"},
      {"diff", "a.png", "b.png", "--html", "out/d.html"},
      {"diff", "a.png", "b.png", "--html", "out/d.html", "--pictures-beside"},
      {"diff", "a.png", "b.png", "--json", "out/d.json"},
      {"diff", "a.png", "b.png", "--junit", "out/d.xml"},
      {"diff", "a.png", "b.png", "--markdown", "out/d.md"},
      {"diff", "out", "new", "--update"},
      {"study", "--quick", "--resolution", "32,32", "--repetitions", "3", "--highlight", "exact",
       "--fresnel", "exact", "--rendering-backend", "osmesa", "--output", "out", "--json",
       "out/s.json", "--markdown", "out/s.md"},
      {"stability", "--case", "d4", "--rendering-backend", "osmesa", "--output", "out"},
      {"stability", "--case", "d4", "--rendering-backend", "osmesa", "--json", "out/s.json"},
  };
}

/// The inputs of the commands.
void prepare(const Folder& folder) {
  fs::create_symlink("/dev/null", folder / "null.png");
  for (const char* name : {"a.png", "b.png"}) {
    const Ran ran =
        runGlint({"render", shipped + "torus.glb", "-o", folder / name, "--resolution", "64,48",
                  "--rendering-backend", "osmesa", "--exposure", name[0] == 'a' ? "0" : "1"});
    ASSERT_EQ(ran.status, 0) << ran.err;
  }
  fs::create_directory(folder / "new");
  fs::copy_file(folder / "b.png", folder / "new/b.png");
}

std::vector<std::string> leftIn(const std::string& folder) {
  std::vector<std::string> left;
  if (!fs::exists(folder)) return left;
  for (const auto& each : fs::recursive_directory_iterator(folder))
    if (each.is_regular_file())
      left.push_back(each.path().filename().string() + ", " + std::to_string(each.file_size()) +
                     " bytes");
  return left;
}

TEST(FullDisk, OfEachOutputLeavesNothing) {
  const Folder folder("full");
  prepare(folder);
  for (const Arguments& command : commands()) {
    std::string text;
    for (const std::string& word : command) text += word + " ";
    SCOPED_TRACE(text);
    const Ran ran =
        runGlint(command, {.timeoutSeconds = 120, .folder = folder.path(), .fileLimit = 200});
    EXPECT_EQ(ran.status, 2) << ran.out << ran.err;
    EXPECT_THAT(ran.err, testing::AnyOf(HasSubstr("raise the limit of file sizes (ulimit -f)"),
                                        HasSubstr("set TMPDIR to a folder with free space")));
    EXPECT_THAT(ran.err, Not(HasSubstr("internal error")));
    EXPECT_THAT(leftIn(folder / "out"), testing::IsEmpty());
    EXPECT_FALSE(fs::exists(folder / "out")) << "a folder is left";
    fs::remove_all(folder / "out");
  }
}

// A real disk of 8 KiB, if the system allows one to be made.
TEST(FullDisk, ThatIsOneIsTold) {
  const Folder folder("disk");
  prepare(folder);
  fs::create_directory(folder / "out");
  const auto inside = [&](const std::string& what) {
    std::ofstream(folder / "run.sh") << "mount -t tmpfs -o size=8k none out || exit 99\n" << what;
    const int status = std::system(
        // Root needs no user namespace. In a chroot it cannot have one, and the new root is not a
        // mount point of its own.
        ("cd '" + folder.path() +
         "' && unshare $(unshare -m true && echo -m || "
         "{ unshare -rm true && echo -rm || echo -m --propagation unchanged; }) " +
         "sh run.sh > out.txt 2> err.txt")
            .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  if (inside("true") != 0) GTEST_SKIP() << "no disk can be mounted here";
  for (const Arguments& command : commands()) {
    std::string text = "'" GLINT_EXECUTABLE "'";
    for (const std::string& word : command) text += " '" + word + "'";
    SCOPED_TRACE(text);
    // Filled except for one page, which the folder's own entries need.
    const int status = inside("head -c 8192 /dev/zero > out/full 2> /dev/null; " + text +
                              "; status=$?; rm -f out/full; find out -type f >&2; exit $status");
    const std::string said = contents(folder / "err.txt");
    EXPECT_EQ(status, 2) << said;
    EXPECT_THAT(said, HasSubstr("No space left on device"));
    EXPECT_THAT(said, Not(HasSubstr("\nout/"))) << said;
  }
}

TEST(FullDisk, UnderAReportOfAListIsNoReaderThatWentAway) {
  const Folder folder("report");
  std::ofstream(folder / "list") << shipped << "torus.glb\n";
  const Ran ran = runGlint({"render", "--from-list", folder / "list", "-o", folder / "{n}.png",
                            "--resolution", "32,32", "--rendering-backend", "osmesa"},
                           {.fullOut = true});
  EXPECT_NE(ran.status, 0);
  EXPECT_THAT(ran.err, HasSubstr("No space left on device"));
  EXPECT_THAT(ran.err, Not(HasSubstr("the reader of the output")));
}

}  // namespace glint::test::full_disk_cli_test
