// glint study, as a user runs it, with pictures of a few pixels.

#include <gmock/gmock.h>

#include <set>

#include "command.h"

namespace glint::test::study_cli_test {

using testing::HasSubstr;
using testing::Not;

const std::string sphere = GLINT_SOURCE_DIR "/models/sphere-series/sphere-3.glb";

/// Three frames of a few pixels may have any spread.
Ran study(const std::string& options) {
  const bool limited = options.find("--spread-limit") != options.npos;
  return runGlint(split("study --quick --resolution 48,48 --repetitions 3 " + options +
                        (limited ? "" : " --spread-limit 1e6")));
}

// Only the exact forms, which omits the series; study_page_test.py has a whole study.
TEST(StudyCommand, TellsTimesErrorsAndFrontsOfTheBuiltInSphere) {
  const std::string file = temporaryFolder() + "/results.md";
  const Ran ran = study("--highlight exact --fresnel exact --json - --markdown " + file);
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_THAT(contents(file), HasSubstr("glint study --quick --repetitions 3"));
  const Json json = Json::parse(ran.out);
  EXPECT_TRUE(json["complete"].get<bool>()) << json["missing"];
  EXPECT_EQ(json["triangles"], 20480);
  EXPECT_GT(json["mask"]["pixels"].get<int>(), 800);
  EXPECT_EQ(json["floors"].size(), 2u);
  for (const char* clock : {"wall", "cpu"})
    EXPECT_GE(json["clocks"][clock]["controls"].size(), 2u) << clock;
  EXPECT_EQ(json["clock"], "wall");
  EXPECT_FALSE(json["clocks"].contains("gpu"));  // there is none
  EXPECT_TRUE(json["noFront"].is_null());
  std::set<std::string> names;
  for (const Json& v : json["variants"]) {
    SCOPED_TRACE(v["name"]);
    names.insert(v["name"]);
    EXPECT_EQ(v["times"]["wall"]["frames"], 3);
    EXPECT_GT(v["times"]["wall"]["minimum"].get<double>(), 0);
    EXPECT_LE(v["times"]["wall"]["minimum"], v["times"]["wall"]["median"]);
    EXPECT_EQ(v["times"]["cpu"]["frames"], 3);
    EXPECT_GT(v["times"]["cpu"]["maximum"].get<double>(), 0);
    const Json& e = v["errors"][0];
    EXPECT_GT(e["rmse"].get<double>(), 0);
    EXPECT_LE(e["rmse"], e["max"]);
    EXPECT_LE(e["p999"], e["max"]);
    // Each is on the front or dominated by one that is.
    EXPECT_TRUE(e["fronts"]["rmse"].is_boolean() || e["fronts"]["rmse"].is_string());
    // Exact forms differ only by rounding, at most 1e-5 + 4e-6 sqrt(4 alpha) in accuracy.md.
    if (v["shading"] != "flat" && v["shading"] != "gouraud") {
      EXPECT_LT(e["max"].get<double>(), 1e-5 + 4e-6 * std::sqrt(160));
    }
    // The whole error is at most the sum of its parts.
    EXPECT_LE(e["max"].get<double>(), 1.0001 * (v["parts"]["shading"]["max"].get<double>() +
                                                v["parts"]["interpolation"]["max"].get<double>()));
  }
  EXPECT_EQ(names, (std::set<std::string>{"flat exact", "gouraud exact", "phong exact",
                                          "blinn-phong exact", "environment exact"}));
  EXPECT_EQ(json["fronts"].size(), 15u);
  // Against the supersampled picture, too: outlines add to the error inside.
  EXPECT_EQ(json["wholeTruths"].size(), 3u);
  for (const Json& v : json["variants"]) {
    SCOPED_TRACE(v["name"]);
    EXPECT_GT(v["whole"]["inside"]["rmse"].get<double>(), 0);
    EXPECT_GT(v["whole"]["picture"]["max"].get<double>(), 0.01);
    if (v["shading"] == "phong") {
      EXPECT_GT(v["whole"]["inside"]["max"], v["errors"][0]["max"]);
    }
  }
  EXPECT_EQ(json["advice"]["forms"].size(), 3u);
  EXPECT_THAT(json["advice"]["text"].get<std::string>(),
              HasSubstr("What to use for sphere (built in) at 48 x 48 pixels by phong"));
  EXPECT_THAT(contents(file), HasSubstr("## What to use"));
  EXPECT_TRUE(json["series"].empty());
}

// No spread is 0, so nothing is concluded, and every output says what to do.
TEST(StudyCommand, MakesNoFrontOfWhatItCannotTell) {
  const Folder folder("study-no-front");
  const Ran ran = study("--highlight exact --fresnel exact --spread-limit 0 --clock cpu --output " +
                        folder / "out" + " --markdown " + folder / "results.md");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json json = Json::parse(contents(folder / "out/study.json"));
  EXPECT_EQ(json["clock"], "cpu");
  const std::string why = json["noFront"];
  EXPECT_THAT(why, HasSubstr("There is no front: in CPU time"));
  EXPECT_THAT(why, HasSubstr("when the machine is idle"));
  EXPECT_TRUE(json["fronts"].empty());
  for (const Json& v : json["variants"]) EXPECT_TRUE(v["errors"][0]["fronts"].empty());
  EXPECT_THAT(ran.out, HasSubstr(why));
  EXPECT_THAT(ran.out, Not(HasSubstr("on the front")));
  const std::string words = contents(folder / "results.md");
  EXPECT_THAT(words, HasSubstr("**" + why + "**"));
  EXPECT_THAT(words, Not(HasSubstr("## The fronts")));
  EXPECT_THAT(contents(folder / "out/study.csv"), Not(HasSubstr(",yes,")));
}

TEST(StudyCommand, StudiesOnlyWhatIsAskedFor) {
  const Ran ran = study(sphere + " --shading phong --json -");
  ASSERT_EQ(ran.status, 0) << ran.err;
  // The model's material has no highlight: all forms are one.
  const Json json = Json::parse(ran.out);
  ASSERT_EQ(json["variants"].size(), 1u);
  EXPECT_EQ(json["variants"][0]["name"], "phong exact");
}

// A form that is in no list, with any parameter: by every program that has it, and by no other.
TEST(StudyCommand, StudiesAnyFormThatIsAskedFor) {
  const Ran lobes = study("--highlight lyon:8");
  EXPECT_EQ(lobes.status, 0) << lobes.err;
  EXPECT_THAT(lobes.out, HasSubstr("blinn-phong lyon:8"));
  EXPECT_THAT(lobes.out, Not(HasSubstr("environment")));
  const Ran fresnels = study("--fresnel rational");
  EXPECT_EQ(fresnels.status, 0) << fresnels.err;
  EXPECT_THAT(fresnels.out, HasSubstr("environment rational"));
  EXPECT_THAT(fresnels.out, Not(HasSubstr("gouraud")));
}

TEST(StudyCommand, EndsWithWhatThereIsWhenTheTimeIsUp) {
  const Json json = reportOf(study("--time-budget 0.001 --json -"));
  EXPECT_FALSE(json["complete"].get<bool>());
  EXPECT_FALSE(json["missing"].empty());
}

TEST(StudyCommand, KeepsWhatIsDoneWhenInterrupted) {
  const std::string folder = temporaryFolder() + "/interrupted";
  // Ctrl-C after two seconds, long before all those frames are done.
  const std::string command = "timeout --foreground --preserve-status -s INT 2 " GLINT_EXECUTABLE
                              " study --resolution 64,64 --shading phong --highlight exact"
                              " --repetitions 100000 --output " +
                              folder + " > /dev/null 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const Json json = Json::parse(contents(folder + "/study.json"));
  EXPECT_FALSE(json["complete"].get<bool>());
  EXPECT_FALSE(json["missing"].empty());
  // On a very busy machine there may not even be an error.
  for (const Json& v : json["variants"]) EXPECT_GT(v["errors"][0]["rmse"].get<double>(), 0);
  EXPECT_THAT(contents(folder + "/study.html"), HasSubstr("</html>"));
  EXPECT_THAT(contents(folder + "/study.svg"), HasSubstr("</svg>"));
  EXPECT_THAT(contents(folder + "/study.csv"), HasSubstr("variant,against"));
}

TEST(StudyCommand, RefusesWhatItCannotDo) {
  expectRefusal(study("--rendering-backend reference"),
                "a study measures GL against the reference");
  expectRefusal(study("--anti-aliasing ssaa:2"), "single samples");
  expectRefusal(study("no-such.glb"), "no-such.glb");
  expectRefusal(study("--time-budget 0"), "--time-budget");
  expectRefusal(study("--clock sundial"), "--clock");
  expectRefusal(study("--clock gpu --rendering-backend osmesa"), "--clock gpu");
  expectRefusal(study("--repetitions 0"), "--repetitions");
  expectRefusal(study("--material Nobody:ior=2"), "Nobody");
  expectRefusal(study("--measure-costs /tmp/costs.json"), "leave --quick out");
  expectRefusal(study("--cost-table /no/such.json"), "/no/such.json");
  expectRefusal(study("--camera-position 0,0,9 --camera-focal-point 0,0,20"), "no pixel");
}

// A model with nothing to compare: one line, without the model's other warnings.
TEST(StudyCommand, SaysOneLineOfAnEmptyModel) {
  const Folder folder("study-empty");
  std::ofstream(folder / "empty.gltf") << R"({"asset": {"version": "2.0"}})";
  const Ran ran = study(folder / "empty.gltf" + " --output " + folder / "deep/report");
  expectRefusal(ran, "empty: no pixel");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"empty.gltf"});  // nor an empty folder
}

// The choice for a budget appears with the others, within its bound.
TEST(StudyCommand, ShowsWhatABudgetChooses) {
  const Ran ran = study("--max-error 0.01 --highlight exact --fresnel exact --json -");
  ASSERT_EQ(ran.status, 0) << ran.err;
  int chosen = 0;
  const Json json = Json::parse(ran.out);
  for (const Json& v : json["variants"]) {
    if (!v.contains("bound")) continue;
    SCOPED_TRACE(v["name"]);
    ++chosen;
    EXPECT_THAT(v["name"].get<std::string>(), testing::StartsWith("max-error 0.01: "));
    EXPECT_LE(v["bound"].get<double>(), 0.01);
    // The bound does not include the driver's interpolation.
    EXPECT_LE(v["parts"]["shading"]["max"].get<double>(), v["bound"].get<double>());
    EXPECT_EQ(v["times"]["wall"]["frames"], 3);
  }
  EXPECT_EQ(chosen, 3);  // phong, blinn-phong, environment
  const Ran automatic =
      study("--max-error 0.01 --shading auto --highlight exact --fresnel exact --json -");
  ASSERT_EQ(automatic.status, 0) << automatic.err;
  EXPECT_EQ(Json::parse(automatic.out)["variants"].size(), 5u + 3u);
}

TEST(StudyCommand, TellsWhatHalfFloatsLose) {
  const Ran ran = runGlint({"study", "--half-precision", "-"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  // docs/approximations.md has this table, followed by the driver's behaviour.
  const std::size_t end = ran.out.find("\n\n");
  ASSERT_NE(end, std::string::npos);
  EXPECT_THAT(contents(GLINT_SOURCE_DIR "/docs/approximations.md"),
              HasSubstr(ran.out.substr(0, end)));
  EXPECT_THAT(ran.out.substr(end), HasSubstr("`mediump`"));
  expectRefusal(runGlint({"study", "--half-precision", "-", "--quick"}), "leave --quick out");
}

TEST(StudyCommand, LeavesNoTableOfCostsWhenInterrupted) {
  const Folder folder("study-costs");
  const std::string command = "timeout --foreground --preserve-status -s INT 1.5 " GLINT_EXECUTABLE
                              " study --measure-costs " +
                              folder / "costs.json" + " > /dev/null 2>&1";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGINT);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace glint::test::study_cli_test
