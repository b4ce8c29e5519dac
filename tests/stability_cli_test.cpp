// `glint stability` as a user runs it.

#include <gmock/gmock.h>

#include <set>

#include "command.h"

namespace glint::test::stability_cli_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

Ran stability(const Arguments& arguments) {
  return runGlint(joined({"stability", "--rendering-backend", "osmesa"}, arguments));
}

TEST(StabilityCommand, ListsTheWholeCatalogue) {
  const Ran ran = runGlint({"stability", "--list"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  const std::pair<char, int> counts[] = {{'A', 19}, {'B', 10}, {'C', 16}, {'D', 12}, {'K', 17},
                                         {'F', 13}, {'G', 11}, {'H', 10}, {'I', 10}};
  int all = 0;
  for (const auto& [letter, count] : counts) {
    all += count;
    for (int i = 1; i <= count; ++i)
      EXPECT_THAT(ran.out, HasSubstr("\n  " + std::string(1, letter) + std::to_string(i) + " "));
    EXPECT_EQ(ran.out.find("\n  " + std::string(1, letter) + std::to_string(count + 1) + " "),
              std::string::npos);
  }
  EXPECT_EQ(all, 118);
  EXPECT_THAT(runGlint({"stability", "--list", "--case", "k12"}).out, HasSubstr("Brewster"));
}

TEST(StabilityCommand, ACaseThatPassesAndOneThatFails) {
  const Ran good = stability({"--case", "d4", "--case", "H1"});
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_THAT(good.out,
              AllOf(HasSubstr("catalogue: 2 of 2 cases pass"), HasSubstr("--highlight exact")));
  const Ran bad = stability({"--case", "D4", "--highlight", "pow"});
  EXPECT_EQ(bad.status, 1) << bad.err;
  EXPECT_THAT(bad.out, AllOf(HasSubstr("FAIL D4"), HasSubstr("levels), allowed"),
                             HasSubstr("catalogue: 0 of 1 cases pass")));
}

TEST(StabilityCommand, ReportAndPage) {
  Folder folder("stability");
  const Json json =
      reportOf(stability({"--case", "K1", "--json", "-", "--output", folder / "new/page"}));
  EXPECT_TRUE(json.at("passed"));
  EXPECT_EQ(json.at("cases").at(0).at("id"), "K1");
  EXPECT_FALSE(json.at("cases").at(0).at("checks").empty());
  EXPECT_EQ(json.at("backend"), "osmesa");
  const std::string page = glint::test::contents(folder / "new/page/stability.html");
  EXPECT_THAT(page, AllOf(StartsWith("<!DOCTYPE html>"), HasSubstr("\"plots\":[{"),
                          HasSubstr("cos^1e6"), testing::EndsWith("</html>\n")));
  // Self-contained.
  EXPECT_EQ(page.find("src=\""), std::string::npos);
  EXPECT_EQ(page.find("<link"), std::string::npos);
}

TEST(StabilityCommand, Refusals) {
  expectRefusal(stability({"--case", "Z9"}), "--case Z9: no such case: see glint stability --list");
  expectRefusal(stability({"--case", ""}), "--case");
  expectRefusal(stability({"--group", "E"}), "--group E: no such group: use one of A, B, C");
  expectRefusal(stability({"--group", "AB"}), "no such group");
  expectRefusal(stability({"--highlight", "toon"}), "--highlight: 'toon' is not");
  expectRefusal(stability({"--fresnel", "x"}), "--fresnel: 'x' is not");
  expectRefusal(stability({"--schlick-exponent", "-1"}), "--schlick-exponent: '-1' is not");
  expectRefusal(stability({"--search", "many"}), "--search");
  expectRefusal(stability({"--search", "-5"}), "--search");
  expectRefusal(stability({"--glsl", "/nonexistent"}), "--glsl /nonexistent: not a folder");
  expectRefusal(stability({"--lst"}), "did you mean '--list'");
  expectRefusal(stability({"extra"}), "unexpected 'extra'");
  expectRefusal(runGlint({"stability", "--rendering-backend", "reference"}),
                "the suite tests a driver");
  expectRefusal(runGlint({"stability", "--rendering-backend", "vulkan"}), "vulkan");
  Folder folder("refusals");
  std::ofstream(folder / "file") << "x";
  expectRefusal(stability({"--case", "H1", "--output", folder / "file"}),
                "cannot make this folder");
  expectRefusal(stability({"--case", "H1", "--json", "/proc/none/r.json"}), "/proc/none");
  // No empty folder is left, either.
  expectRefusal(stability({"--glsl", "/nonexistent", "--output", folder / "new/page"}),
                "not a folder");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
}

TEST(StabilityCommand, NoContextIsStatus3) {
  glint::test::CommandOptions options;
  options.environment = {{"LD_LIBRARY_PATH", GLINT_BINARY_DIR "/tests/fake/no-context"}};
  expectRefusal(runGlint({"stability", "--rendering-backend", "egl-software"}, options), "egl", 3);
}

}  // namespace glint::test::stability_cli_test
