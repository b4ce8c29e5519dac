#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "glint/options/parameters.h"
#include "glint/scene/material_parameters.h"
#include "viewer/actions.h"
#include "viewer/effects.h"
#include "viewer/light_edit.h"
#include "viewer/materials.h"
#include "viewer/session.h"
#include "viewer/theme.h"

namespace glint::viewer {
namespace viewer_words_test {

using testing::HasSubstr;

bool finds(const std::vector<Finding>& all, Action action) {
  return std::ranges::any_of(all, [&](const Finding& f) { return f.action == action; });
}

TEST(Palette, FindsEveryActionByItsWordsAndItsKey) {
  for (const ActionInfo& info : actions()) {
    std::string words = std::string(info.help) + " " + std::string(info.section);
    std::ranges::transform(words, words.begin(),
                           [](unsigned char c) { return char(std::toupper(c)); });
    EXPECT_TRUE(finds(findings(words, {}), info.command)) << words;
    EXPECT_TRUE(finds(findings(keyText(info), {}), info.command)) << keyText(info);
  }
  EXPECT_EQ(findings("", {}).size(), actions().size());
  EXPECT_TRUE(findings("no such words", {}).empty());
  // In any order, also as parts of words; texts that begin with the word come first.
  EXPECT_EQ(findings("view front", {}).front().action, Action::front);
  EXPECT_TRUE(finds(findings("ompar diff", {}), Action::compareDifference));
}

TEST(Palette, FindsMaterialsWhateverTheCase) {
  const std::vector<std::string> names{"Material_13", "Glas", "material_1"};
  const auto found = findings("MATERIAL_13", names, true);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].material, 0);
  EXPECT_FALSE(found[0].action);
  EXPECT_EQ(findings("", names, true).size(), 3u);
  EXPECT_EQ(findings("glas", names).front().material, 1);
}

TEST(Menu, HoldsEveryActionOnce) {
  for (const ActionInfo& info : actions()) {
    int places = 0;
    for (const MenuInfo& menu : menus())
      places += int(std::ranges::count(menu.sections, info.section));
    EXPECT_EQ(places, 1) << info.section << ": " << info.help;
  }
}

// A text colour and a background that it has somewhere in the window.
struct ThemePair {
  std::string_view where;
  glm::dvec3 text, ground;
};

namespace theme_pairs {
using namespace theme;
constexpr ThemePair all[] = {{"rows", text, window},
                             {"dim rows", dim, window},
                             {"edited names", edited, window},
                             {"errors in the status line", error, window},
                             {"forms chosen", key, window},
                             {"the material under the pointer in its list", hovered, frame},
                             {"popups", text, popup},
                             {"dim text in popups and keys in the palette", dim, popup},
                             {"keys in the help", key, window},
                             {"errors of what is typed", error, popup},
                             {"fields", text, frame},
                             {"hints in fields", dim, frame},
                             {"fields under the pointer", text, frameHovered},
                             {"fields being dragged", text, frameActive},
                             {"a field that cannot be taken", text, wrongFrame},
                             {"buttons", text, button},
                             {"buttons under the pointer", text, buttonHovered},
                             {"pressed buttons and the tab shown", text, accent},
                             {"tabs under the pointer", text, bright},
                             {"headers and the selected material", text, header},
                             {"keys of the selected entry of the palette", dim, header},
                             {"headers under the pointer", text, headerHovered},
                             {"the menu bar", text, menu}};
}  // namespace theme_pairs

// WCAG 2.1, "relative luminance"; its threshold is from an older draft of sRGB.
double luminanceOf(const glm::dvec3& srgb) {
  const auto linear = [](double x) {
    return x <= 0.03928 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(srgb.r) + 0.7152 * linear(srgb.g) + 0.0722 * linear(srgb.b);
}

// The contrast of two sRGB colours by WCAG 2.1, from 1 to 21; legible text needs at least 4.5.
double contrast(const glm::dvec3& a, const glm::dvec3& b) {
  const double la = luminanceOf(a), lb = luminanceOf(b);
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

TEST(Theme, EveryTextHasContrast) {
  EXPECT_NEAR(contrast({1, 1, 1}, {0, 0, 0}), 21, 1e-9);
  EXPECT_NEAR(contrast({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}), 1, 1e-12);
  // #767676 on white is WCAG's own example of just enough contrast.
  const double grey = 0x76 / 255.0;
  EXPECT_NEAR(contrast({grey, grey, grey}, {1, 1, 1}), 4.54, 0.005);
  for (const ThemePair& pair : theme_pairs::all)
    EXPECT_GE(contrast(pair.text, pair.ground), 4.5) << pair.where;
  // Elements other than text need 3 (WCAG 2.1, 1.4.11): boxes that are not ticked.
  EXPECT_GE(contrast(theme::edge, theme::window), 3);
  EXPECT_GE(contrast(theme::edge, theme::popup), 3);
}

// A parameter reported as having no effect does not change the inputs of the picture; parameters
// that the program environment uses have an effect there.
TEST(Effects, SayWhyAParameterDoesNothing) {
  Look look;
  for (const char* name : {"fresnel", "medium-ior", "schlick-exponent", "ior", "transmission",
                           "environment", "hdri-file", "environment-rotation", "blinn-factor"}) {
    EXPECT_NE(withoutEffect(look, nullptr, name), "") << name;
    look.shading = Shading::environment;
    look.fresnel = Fresnel::schlick;
    EXPECT_EQ(withoutEffect(look, nullptr, name), "") << name;
    look = Look{};
  }
  look.environmentBackground = true;
  EXPECT_EQ(withoutEffect(look, nullptr, "environment"), "");
  EXPECT_THAT(withoutEffect(look, nullptr, "background-color"), HasSubstr("environment"));
  look.noBackground = true;
  EXPECT_THAT(withoutEffect(look, nullptr, "background-color"), HasSubstr("transparent"));
  EXPECT_NE(withoutEffect(look, nullptr, "environment"), "");
  for (const MaterialParameter& p : materialParameters()) {
    if (p.name == "ior" || p.name == "transmission") continue;
    EXPECT_EQ(withoutEffect(Look{}, nullptr, p.name), "") << p.name;
  }
  for (const char* name : {"exposure", "camera-view-angle", "two-sided", "shading", "viewer"})
    EXPECT_EQ(withoutEffect(Look{}, nullptr, name), "") << name;
}

TEST(Differences, AreToldInWords) {
  Look a, b;
  EXPECT_TRUE(differences(a, b).empty());
  a.material["Gold"].exponent = 80;
  b.material["Gold"].exponent = 20;
  b.material[""].color = glm::dvec3(1, 0, 0);
  a.exposure = 1;
  b.resolution = {17, 19};  // not a difference between pictures
  const auto all = differences(a, b);
  ASSERT_EQ(all.size(), 3u);
  const auto named = [&](const std::string& what) {
    return *std::ranges::find(all, what, &Difference::what);
  };
  EXPECT_EQ(named("exponent of Gold").a, "80");
  EXPECT_EQ(named("exponent of Gold").b, "20");
  EXPECT_EQ(named("color of all materials").a, "-");
  EXPECT_EQ(named("color of all materials").b, "1, 0, 0");
  EXPECT_EQ(named("exposure").b, "0");
  EXPECT_THAT(sideText(all, true), HasSubstr("and 1 more"));
  EXPECT_NE(sideText(all, true), sideText(all, false));
}

TEST(LightSwitches, GoBackToWhatWas) {
  std::vector<Light> lights(3);
  lights[0].intensity = {1, 2, 3};
  lights[1].intensity = {0.5, 0.5, 0.5};
  lights[2].intensity = {4, 0, 0};
  const std::vector<Light> first = lights;
  SwitchedOff off;
  switchLight(lights, 1, off);
  EXPECT_EQ(lights[1].intensity, glm::dvec3(0.0));
  switchLight(lights, 1, off);
  EXPECT_EQ(lights, first);
  soloLight(lights, 2, off);
  EXPECT_EQ(lights[0].intensity, glm::dvec3(0.0));
  EXPECT_EQ(lights[2], first[2]);
  soloLight(lights, 0, off);  // solo for another one
  EXPECT_EQ(lights[0], first[0]);
  EXPECT_EQ(lights[2].intensity, glm::dvec3(0.0));
  soloLight(lights, 0, off);
  EXPECT_EQ(lights, first);
}

TEST(AllMaterials, TellThatTheirValuesAreMixed) {
  Session s;
  s.take(loadModel(std::string(GLINT_SOURCE_DIR) + "/models/chart.glb"));
  const auto& exponent =
      *std::ranges::find(materialParameters(), "exponent", &MaterialParameter::name);
  const ValueSpread spread = spreadOf(s.model->scene, s.document.a, exponent);
  EXPECT_TRUE(spread.mixed());
  EXPECT_LT(spread.least, spread.most);
  s.document.a.material[""].exponent = 33;
  EXPECT_FALSE(spreadOf(s.model->scene, s.document.a, exponent).mixed());
  EXPECT_EQ(spreadOf(s.model->scene, s.document.a, exponent).most, 33);
  s.document.a.material[""].color = glm::dvec3(0.5);
  EXPECT_TRUE(haveOneColor(s.model->scene, s.document.a));
  const std::string one = materialKey(s.model->scene, drawnMaterials(s.model->scene).front());
  s.document.a.material[one].color = glm::dvec3(0.25);
  EXPECT_FALSE(haveOneColor(s.model->scene, s.document.a));
}

}  // namespace viewer_words_test
}  // namespace glint::viewer
