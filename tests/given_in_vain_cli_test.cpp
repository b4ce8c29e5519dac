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

// What a file cannot hold, or has no place for, is said.
TEST(Convert, SaysWhatTheFileDoesNotHold) {
  Folder folder("convert_in_vain");
  const Ran form = runGlint({"convert", sphere, folder / "a.glb", "--material", "highlight=none"});
  EXPECT_EQ(form.status, 0);
  EXPECT_THAT(form.err, testing::HasSubstr("highlight and fresnel are not parameters"));
  std::ofstream(folder / "empty.gltf") << R"({"asset":{"version":"2.0"}})";
  const Ran none =
      runGlint({"convert", folder / "empty.gltf", folder / "b.gltf", "--material", "exponent=2"});
  EXPECT_EQ(none.status, 0);
  EXPECT_THAT(none.err, testing::HasSubstr("has no material that --material or the look edits"));
  EXPECT_EQ(contents(folder / "b.gltf"), contents(folder / "empty.gltf"));
}

// A baseline that cannot be looked at is not one that is missing: status 2, not 4.
TEST(Baselines, ThatCannotBeReadAreNotMissing) {
  Folder folder("unreadable_baseline");
  std::filesystem::create_symlink("loop.png", folder / "loop.png");
  const std::string picture = std::string(GLINT_SOURCE_DIR) + "/docs/programs.png";
  const std::string words = "loop.png: Too many levels of symbolic links";
  expectRefusal(runGlint({"diff", folder / "loop.png", picture}), words);
  expectRefusal(runGlint({"diff", picture, folder / "loop.png"}), words);
}

// What the picture is compared with must be of its kind; both are named.
TEST(Render, AReferenceOfAnotherKindIsNamed) {
  Folder folder("reference_kind");
  expectDone(runGlint(quick({"render", sphere, "-o", folder / "a.png"})));
  expectRefusal(
      runGlint(quick({"render", sphere, "-o", folder / "a.exr", "--reference", folder / "a.png"})),
      "a.exr and " + (folder / "a.png") + ": one is sRGB, the other linear light");
}

// Without a place for its cache Mesa would print a line of its own.
TEST(Environment, AHomeThatCannotBeWrittenIsNoMatter) {
  Folder folder("no_home");
  const CommandOptions nowhere{.environment = {{"HOME", "/proc/none"},
                                               {"XDG_CACHE_HOME", ""},
                                               {"MESA_SHADER_CACHE_DIR", ""}}};
  expectDone(runGlint(quick({"render", sphere, "-o", folder / "a.png"}), nowhere));
}

// A system's error about a file is not one about threads.
TEST(LinkLoops, AreCalledSo) {
  Folder folder("link_loop");
  std::filesystem::create_symlink("loop", folder / "loop");
  expectRefusal(
      runGlint(quick({"render", sphere, "-o", folder / "a.png", "--reference", folder / "loop"})),
      "loop: Too many levels of symbolic links: check where its links lead");
}

}  // namespace glint::test::given_in_vain_cli_test
