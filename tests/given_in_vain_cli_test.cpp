// What was asked for but cannot be had: options with empty values, input that never comes.

#include <gmock/gmock.h>

#include <cstdlib>

#include "command.h"

namespace glint::test::given_in_vain_cli_test {

const std::string sphere = shipped + "sphere.glb";

// Mostly "$VARIABLE" of a script where it is not set: a comparison must not be left out.
TEST(EmptyValues, AreRefusedByName) {
  Folder folder("empty_values");
  const std::string out = folder / "a.png";
  for (const char* option :
       {"--reference", "--look", "--glsl", "--save-look", "--json", "--hdri-file", "--material",
        "--animation", "--shading", "--rendering-backend"})
    expectRefusal(runGlint(quick({"render", sphere, "-o", out, option, ""})),
                  std::string(option) + ": '' is empty: give ");
  expectRefusal(runGlint(quick({"render", sphere, "-o", out, "--reference="})), "--reference: ''");
  for (const char* option : {"--mask", "--layer", "--html", "--junit", "--metric", "--conditions"})
    expectRefusal(runGlint({"diff", out, out, option, ""}),
                  std::string(option) + ": '' is empty: give ");
  expectRefusal(runGlint({"convert", sphere, out, "--look", ""}), "--look: '' is empty");
  EXPECT_THAT(folder.names(), testing::IsEmpty());
}

// The first signal ends what waits for a pipe: a second one, or SIGKILL, must not be needed.
TEST(Signals, EndWhatWaitsForInput) {
  Folder folder("waiting_for_input");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const auto statusOf = [&](const std::string& arguments) {
    const std::string command = "timeout --preserve-status -k 10 1 " GLINT_EXECUTABLE
                                " render -o " +
                                (folder / "a.png") + " " + arguments + " 2> /dev/null";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  EXPECT_EQ(statusOf("--from-list " + (folder / "pipe")), 128 + SIGTERM);  // nobody opens it
  const int writer = open((folder / "pipe").c_str(), O_RDWR);
  ASSERT_GE(writer, 0);
  EXPECT_EQ(statusOf("--from-list " + (folder / "pipe")), 128 + SIGTERM);  // nothing is written
  EXPECT_EQ(statusOf("- < " + (folder / "pipe")), 128 + SIGTERM);
  close(writer);
  EXPECT_THAT(folder.names(), testing::ElementsAre("pipe"));
}

// A system's error about a file is not one about threads.
TEST(LinkLoops, AreCalledSo) {
  Folder folder("link_loop");
  std::filesystem::create_symlink("loop", folder / "loop");
  expectRefusal(
      runGlint(quick({"render", sphere, "-o", folder / "a.png", "--reference", folder / "loop"})),
      "loop: Too many levels of symbolic links: check the path");
}

}  // namespace glint::test::given_in_vain_cli_test
