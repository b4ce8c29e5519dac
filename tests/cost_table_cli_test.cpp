// --cost-table as a user gives it.

#include <gmock/gmock.h>

#include <fstream>

#include "command.h"

namespace glint::test::cost_table_cli_test {

using testing::AllOf;
using testing::HasSubstr;

const std::string teapot = GLINT_SOURCE_DIR "/models/teapot.glb";

/// A table in which one form of the lobe is nearly free.
Json tableFor(const std::string& cheap) {
  Json table{{"glint-costs", 1},
             {"highlight",
              {{"exact", 100},
               {"pow", 99},
               {"integer", std::vector<double>(13, 99)},
               {"lyon", std::vector<double>(7, 99)},
               {"lyon-cross", std::vector<double>(7, 99)},
               {"pade", std::vector<double>(7, 99)},
               {"gaussian", 99},
               {"table", std::vector<double>(7, 99)}}},
             {"fresnel",
              {{"exact", 100},
               {"textbook", 100},
               {"schlick", 100},
               {"schlick-exponent", 100},
               {"schlick-exp2", 100},
               {"rational", 100}}}};
  table["fresnel-denser-side"] = table["fresnel"];
  table["highlight"][cheap] = 1;
  return table;
}

class CostTableCommand : public testing::Test {
 protected:
  std::string written(const std::string& text) {
    std::ofstream(folder_ / "costs.json") << text;
    return folder_ / "costs.json";
  }
  /// The choice that a command reports with --json -.
  static Json choice(const Arguments& arguments) {
    const Json json = reportOf(runGlint(joined(
        arguments, split("--max-error 0.05 --material specular=0.5,exponent=300 --json -"))));
    return json.contains("choice") ? json["choice"] : json["pictures"][0]["choice"];
  }
  Folder folder_{"cost-table"};
};

TEST_F(CostTableCommand, IsWhatTheChoiceGoesBy) {
  const Json shipped = choice({"info", teapot});
  EXPECT_EQ(shipped["costs"], "shipped");
  const std::string file = written(tableFor("gaussian").dump());
  const Json measured = choice({"info", teapot, "--cost-table", file});
  EXPECT_EQ(measured["costs"], file);
  EXPECT_EQ(measured["materials"][0]["highlight"], "gaussian");
  EXPECT_NE(shipped["materials"][0]["highlight"], "gaussian");
  written(tableFor("pow").dump());
  const Json drawn = choice(quick({"render", teapot, "-o", folder_ / "a.png", "--cost-table", file,
                                   "--save-look", folder_ / "look.json"}));
  EXPECT_EQ(drawn["costs"], file);
  EXPECT_EQ(drawn["materials"][0]["highlight"], "pow");
  const Json look = Json::parse(contents(folder_ / "look.json"));
  EXPECT_EQ(look["highlight"], "pow");
  EXPECT_FALSE(look.contains("cost-table"));
  EXPECT_FALSE(look.contains("max-error"));
}

// One line and status 2, before anything is drawn and whether or not there is a choice to make.
TEST_F(CostTableCommand, RefusesWhatIsNoTable) {
  Json newer = tableFor("pow");
  newer["glint-costs"] = 2;
  const std::pair<std::string, const char*> wrong[] = {
      {"no JSON", "is not valid JSON"}, {"{}", "is not a cost table"}, {newer.dump(), "version 2"}};
  for (const auto& [text, words] : wrong)
    for (const char* command : {"info", "render", "study"}) {
      Arguments arguments{command, teapot, "--cost-table", written(text)};
      if (command == std::string("render"))
        arguments = joined(arguments, {"-o", folder_ / "a.png"});
      const Ran ran = runGlint(arguments);
      expectRefusal(ran, words);
      EXPECT_THAT(ran.err, AllOf(HasSubstr("costs.json: "), HasSubstr("study --measure-costs")));
    }
  expectRefusal(runGlint({"info", teapot, "--cost-table", folder_ / "none.json"}), "none.json");
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"costs.json"});
}

// Existing pictures were chosen with the file's earlier content.
TEST_F(CostTableCommand, AnotherTableIsAnotherPictureForResume) {
  const std::string file = written(tableFor("gaussian").dump());
  const auto skipped = [&] {
    return reportOf(
               runGlint(quick({"render", teapot, "-o", folder_ / "a.png", "--cost-table", file,
                               "--max-error", "0.05", "--resume", "--json", "-"})))["pictures"][0]
        .contains("skipped");
  };
  EXPECT_FALSE(skipped());
  EXPECT_TRUE(skipped());
  written(tableFor("pow").dump());
  EXPECT_FALSE(skipped());
}

}  // namespace glint::test::cost_table_cli_test
