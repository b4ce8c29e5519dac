// --max-error in codes of the 8-bit picture, as a user gives it.

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "command.h"
#include "glint/image/stored_image.h"

namespace glint::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

const std::string teapot = GLINT_SOURCE_DIR "/models/teapot.glb";

class MaxErrorInCodes : public testing::Test {
 protected:
  /// Draws it and gives what was chosen.
  Json drawn(const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> arguments{"render",
                                       teapot,
                                       "-o",
                                       folder_ / name,
                                       "--resolution",
                                       "96,96",
                                       "--anti-aliasing",
                                       "none",
                                       "--material",
                                       "specular=0.5,exponent=60",
                                       "--json",
                                       "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = runGlint(arguments);
    EXPECT_EQ(ran.status, 0) << ran.err;
    return ran.status == 0 ? Json::parse(ran.out)["pictures"][0] : Json();
  }
  Folder folder_{"max-error"};
};

// After exposure: a code is 2^EV times as wide a step for what is 2^EV times as dark.
TEST_F(MaxErrorInCodes, IsAnErrorInLinearLight) {
  for (const double exposure : {0.0, 3.0}) {
    const std::string ev = std::to_string(exposure);
    const double linear = 2 / (255 * 12.92) / std::exp2(exposure);
    const Json codes = drawn("codes.png", {"--max-error", "2code", "--exposure", ev})["choice"];
    const Json same =
        drawn("same.png", {"--max-error", Json(linear).dump(), "--exposure", ev})["choice"];
    EXPECT_EQ(codes["codes"], 2.0);
    EXPECT_NEAR(codes["max-error"].get<double>(), linear, 1e-12);
    EXPECT_EQ(codes["materials"], same["materials"]);
    EXPECT_LE(codes["bound"].get<double>(), linear);
    EXPECT_EQ(contents(folder_ / "codes.png"), contents(folder_ / "same.png"));
  }
}

// What the bound promises: no code is off by more, beside the picture in exact forms.
TEST_F(MaxErrorInCodes, NoCodeIsOffByMore) {
  drawn("exact.png", {});
  const StoredImage exact = readStoredImage(folder_ / "exact.png");
  for (const int most : {1, 4, 20}) {
    const Json picture = drawn("form.png", {"--max-error", std::to_string(most) + "code"});
    EXPECT_NE(picture["choice"]["materials"][0]["highlight"], "exact") << most;
    EXPECT_GE(picture["ms"]["choose"].get<double>(), 0.0);
    const StoredImage form = readStoredImage(folder_ / "form.png");
    int worst = 0;
    for (int y = 0; y < 96; ++y) {
      std::vector<float> a(4 * 96), b(4 * 96);
      exact.encodedRows(y, 1, a.data());
      form.encodedRows(y, 1, b.data());
      for (std::size_t i = 0; i < a.size(); ++i)
        worst = std::max(worst, int(std::lround(255 * std::abs(a[i] - b[i]))));
    }
    EXPECT_LE(worst, most);
    EXPECT_GT(most == 20 ? worst : 1, 0);  // it is another picture
  }
}

TEST_F(MaxErrorInCodes, RefusesWhatIsNoNumberOfCodes) {
  for (const char* wrong : {"code", "-1code", "1codes", "1 code", "nancode", "infcode", "1code2"}) {
    const Ran ran =
        runGlint({"render", teapot, "-o", folder_ / "a.png", std::string("--max-error=") + wrong});
    EXPECT_EQ(ran.status, 2) << wrong;
    EXPECT_EQ(ran.errorLines().size(), 1u) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("max-error"));
  }
  EXPECT_TRUE(folder_.names().empty());
}

// What is reported is the number given; a saved look has the forms instead, and draws the same.
TEST_F(MaxErrorInCodes, IsReportedAndSavedAsForms) {
  const Ran info = runGlint({"info", teapot, "--max-error", "1.5code", "--json", "-"});
  ASSERT_EQ(info.status, 0) << info.err;
  EXPECT_EQ(Json::parse(info.out)["choice"]["codes"], 1.5);
  drawn("a.png", {"--max-error", "1.5code", "--save-look", folder_ / "look.json"});
  EXPECT_FALSE(Json::parse(contents(folder_ / "look.json")).contains("max-error"));
  drawn("b.png", {"--look", folder_ / "look.json"});
  const StoredImage a = readStoredImage(folder_ / "a.png"), b = readStoredImage(folder_ / "b.png");
  std::vector<float> of(4 * 96 * 96), as(of.size());
  a.encodedRows(0, 96, of.data());
  b.encodedRows(0, 96, as.data());
  EXPECT_EQ(of, as);
}

}  // namespace
}  // namespace glint::test
