// Help and usage: the layout of every command's help, that its examples run as printed, and the
// shorthands.

#include <gmock/gmock.h>

#include <sstream>

#include "command.h"
#include "glint/options/parameters.h"

namespace glint::test::help_cli_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const std::vector<std::string> commands{"render",  "view", "diff",        "study",   "stability",
                                        "convert", "info", "environment", "backends"};
const std::vector<std::pair<std::string, std::string>> noDisplay{{"DISPLAY", ""},
                                                                 {"WAYLAND_DISPLAY", ""}};

std::string helpOf(const std::string& command) {
  const Ran ran = runGlint({command, "--help"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  return ran.out;
}

/// Splits a command line into words as a shell does; supports only single quotes and *.glb.
std::vector<std::string> shellWords(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  bool quoted = false;
  for (const char c : line + " ") {
    if (c == '\'') {
      quoted = !quoted;
    } else if (c != ' ' || quoted) {
      word += c;
    } else if (!word.empty()) {
      words.push_back(word == "*.glb" ? "helmet.glb" : word);
      word.clear();
    }
  }
  return words;
}

TEST(Help, IsWithin80ColumnsAndHasExamples) {
  for (const std::string& command : commands) {
    SCOPED_TRACE(command);
    const std::string text = helpOf(command);
    EXPECT_THAT(text, AllOf(HasSubstr("Usage: glint " + command), HasSubstr("\nExamples:\n"),
                            testing::Not(HasSubstr("\n\n\n"))));
    for (const std::string& line : linesOf(text)) EXPECT_LE(line.size(), 80u) << line;
    // A range belongs in the sentence, not in the value's name, where the parser puts it.
    for (const char* range : {" in [", ":NONNEGATIVE", ":POSITIVE"})
      EXPECT_THAT(text, testing::Not(HasSubstr(range)));
  }
  for (const std::string& line : linesOf(runGlint({"--help"}).out)) EXPECT_LE(line.size(), 80u);
}

// People first copy the examples that the help prints, so each must run. Studies and windows are
// cut short: by a time budget, and by the lack of a display.
TEST(Help, ExamplesRunAsPrinted) {
  Folder folder("examples");
  std::filesystem::copy_file(shipped + "sphere.glb", folder / "helmet.glb");
  const auto run = [&](std::vector<std::string> words) {
    return runGlint(words,
                    {.environment = noDisplay, .timeoutSeconds = 120, .folder = folder.path()});
  };
  const std::vector<std::string> small{"--resolution", "40,30"};
  for (const char* made : {"baselines", "pictures", "thumbs", "turn"})
    std::filesystem::create_directory(folder / made);
  // Made again for each command, because examples overwrite some of them.
  const auto makePictures = [&] {
    for (const char* picture :
         {"a.png", "b.png", "baseline.png", "baselines/a.png", "pictures/a.png"})
      ASSERT_EQ(run({"render", "helmet.glb", "-o", picture, "--resolution", "40,30"}).status, 0);
  };
  makePictures();
  ASSERT_EQ(
      run({"render", "helmet.glb", "-o", "c.png", "--resolution", "40,30", "--save-look", "a.json"})
          .status,
      0);
  std::vector<std::string> pages{""};
  pages.insert(pages.end(), commands.begin(), commands.end());
  for (const std::string& command : pages) {
    const std::string text = command.empty() ? runGlint({"--help"}).out : helpOf(command);
    makePictures();
    std::size_t count = 0;
    for (const std::string& line : linesOf(text.substr(text.find("Examples:")))) {
      if (!line.starts_with("  glint ")) continue;
      ++count;
      SCOPED_TRACE(line);
      std::vector<std::string> words = shellWords(line.substr(8));
      // It takes a minute and has no time budget; the tests of cost tables run it.
      if (testing::Value(words, testing::Contains("--measure-costs"))) continue;
      const std::string first = words.front();
      const bool window = first == "view" || first == "helmet.glb";
      if (first == "render") words.insert(words.end(), small.begin(), small.end());
      if (first == "study") words.insert(words.end(), {"--time-budget", "0.5"});
      if (first == "stability") words.push_back("--list");
      const Ran ran = run(words);
      if (window)
        EXPECT_THAT(ran.err, HasSubstr("glint render")) << ran.status;
      else
        EXPECT_EQ(ran.status, 0) << ran.err;
    }
    EXPECT_GE(count, 2u) << command;
  }
}

TEST(Help, ListsEveryOptionOfTheTable) {
  for (const char* command : {"render", "info"}) {
    const Ran ran = runGlint({command, "--help"});
    expectDone(ran);
    for (const glint::Parameter& p : glint::lookParameters())
      EXPECT_THAT(ran.out, HasSubstr("--" + p.name)) << command;
    for (const char* option : {"--look", "--save-look", "--json", "--help"})
      EXPECT_THAT(ran.out, HasSubstr(option)) << command;
  }
  EXPECT_THAT(runGlint({"render", "--help"}).out,
              AllOf(HasSubstr("--output"), HasSubstr("--bit-depth"), HasSubstr("--glsl"),
                    HasSubstr("--rendering-backend")));
}

TEST(Help, OfTheProgramListsTheCommands) {
  const Ran ran = runGlint({"--help"});
  expectDone(ran);
  EXPECT_THAT(ran.out, AllOf(HasSubstr("render"), HasSubstr("info"), HasSubstr("backends")));
  const Ran version = runGlint({"--version"});
  expectDone(version);
  EXPECT_THAT(version.out, testing::MatchesRegex("glint [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(Help, ByTheWordHelp) {
  EXPECT_EQ(runGlint({"help"}).out, runGlint({"--help"}).out);
  for (const char* command : {"render", "diff", "backends"})
    EXPECT_EQ(runGlint({"help", command}).out, helpOf(command));
  const Ran unknown = runGlint({"help", "rendre"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean 'render'?"));
  EXPECT_THAT(unknown.out, IsEmpty());
}

TEST(Help, VersionByALetter) {
  const Ran letter = runGlint({"-V"});
  EXPECT_EQ(letter.status, 0) << letter.err;
  EXPECT_THAT(letter.out, StartsWith("glint "));
  EXPECT_EQ(letter.out, runGlint({"--version"}).out);
}

// As f3d users type it. Without a display the one line says what works without it.
TEST(Help, AModelAloneIsShown) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{shipped + "sphere.glb"},
                                                {shipped + "sphere.glb", "--shading", "gouraud"},
                                                {"--shading", "gouraud", shipped + "sphere.glb"},
                                                {"view", shipped + "sphere.glb"}}) {
    SCOPED_TRACE(testing::PrintToString(words));
    const Ran ran = runGlint(words, {.environment = noDisplay});
    EXPECT_NE(ran.status, 0);
    ASSERT_EQ(ran.errorLines().size(), 1u) << ran.err;
    EXPECT_THAT(ran.err, AllOf(StartsWith("glint: "), HasSubstr("glint render")));
  }
}

TEST(Help, ATypoIsAnsweredEvenWhereSomethingElseIsMissing) {
  const auto answer = [](std::vector<std::string> words) {
    const Ran ran = runGlint(words, {.environment = noDisplay});
    EXPECT_EQ(ran.status, 2);
    EXPECT_EQ(ran.errorLines().size(), 1u) << ran.err;
    return ran.err;
  };
  EXPECT_THAT(answer({"render", "--shadin", "flat"}), HasSubstr("did you mean '--shading'?"));
  EXPECT_THAT(answer({"render", "a.glb", "--outptu", "a.png"}),
              HasSubstr("did you mean '--output'?"));
  EXPECT_THAT(answer({"render", "a.glb", "--hdri", "a.exr"}),
              HasSubstr("did you mean '--hdri-file'?"));
  EXPECT_THAT(answer({"render", "a.glb", "--turntabel=3"}),
              HasSubstr("did you mean '--turntable'?"));
  EXPECT_THAT(answer({"info", "--jsn", "-"}), HasSubstr("did you mean '--json'?"));
  EXPECT_THAT(answer({"convert", "a.glb", "--materail", "ior=1"}),
              HasSubstr("did you mean '--material'?"));
  EXPECT_THAT(answer({"environment", "--outpt", "a.exr"}), HasSubstr("did you mean '--output'?"));
  EXPECT_THAT(answer({"--hlep"}), HasSubstr("did you mean '--help'?"));
  EXPECT_THAT(answer({"view", "a.glb", "--shadin", "flat"}),
              HasSubstr("did you mean '--shading'?"));
  EXPECT_THAT(answer({"view", "--qqqqqq"}), HasSubstr("see glint view --help"));
  EXPECT_THAT(answer({"rendre", "a.glb", "-o", "a.png"}), HasSubstr("did you mean 'render'?"));
}

}  // namespace glint::test::help_cli_test
