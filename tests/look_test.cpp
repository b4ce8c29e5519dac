// The texts of options.

#include <gmock/gmock.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "files.h"
#include "glint/image/srgb.h"
#include "looks.h"
#include "scenes.h"

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

namespace glint::test::look_test {

/// A text of an option and the look that it makes of the default one.
struct Good {
  std::string name, text;
  Look look;
};

class GoodTexts {
 public:
  template <typename Change>
  void change(const std::string& name, const std::string& text, const Change& apply) {
    apply(all.emplace_back(Good{name, text, {}}).look);
  }
  /// Texts that set a member, and the values that they set it to.
  template <typename Value>
  void member(const std::string& name, Value Look::*which,
              std::initializer_list<std::pair<const char*, Value>> rows) {
    for (const auto& row : rows)
      change(name, row.first, [&](Look& look) { look.*which = row.second; });
  }
  template <typename Change>
  void material(const std::string& name, const std::string& text, const Change& apply) {
    change("material", text, [&](Look& look) { apply(look.material[name]); });
  }

  std::vector<Good> all;
};

std::optional<std::vector<Light>> light(Light::Type type, glm::dvec3 position, glm::dvec3 direction,
                                        glm::dvec3 intensity = glm::dvec3(1), double inner = 0,
                                        double outer = 45, bool fallsOff = false,
                                        double range = 0) {
  return std::vector<Light>{{type, position, direction, inner, outer, intensity, fallsOff, range}};
}

HighlightForms byLight(const HighlightForm& brightest, std::vector<HighlightForms::Dimmer> dimmer) {
  HighlightForms forms = brightest;
  forms.dimmer = std::move(dimmer);
  return forms;
}

// The look that each option's text gives, starting from the default, written by hand.
std::vector<Good> goodTexts() {
  using Type = Light::Type;
  using Mode = AntiAliasing::Mode;
  const Look plain;
  const glm::dvec3 one(1);
  GoodTexts good;
  good.member("shading", &Look::shading,
              {{"flat", Shading::flat},
               {"gouraud", Shading::gouraud},
               {"phong", plain.shading},
               {"blinn-phong", Shading::blinnPhong},
               {"environment", Shading::environment},
               {"auto", Shading::automatic}});
  good.member("max-error", &Look::maxError, {{"0", 0.0}, {"1e-3", 1e-3}});
  good.change("max-error", "1.5code", [](Look& l) {
    l.maxError = 1.5;
    l.maxErrorInCodes = true;
  });
  good.member("highlight", &Look::highlight,
              {{"exact", plain.highlight},
               {"pow", Highlight::pow},
               {"integer", Highlight::integer},
               {"lyon:8", {Highlight::lyon, 8}},
               {"lyon-tuned:1", {Highlight::lyonTuned, 1}},
               {"lyon-cross:64", {Highlight::lyonCross, 64}},
               {"pade:+4", {Highlight::pade, 4}},
               {"gaussian", Highlight::gaussian},
               {"none", Highlight::none},
               {"exact/2,lyon:8", byLight({}, {{{Highlight::lyon, 8}, 2}})},
               {"pade:4/1,pow/1,pow/3,none",
                byLight({Highlight::pade, 4}, {{Highlight::pow, 1}, {Highlight::none, 5}})}});
  good.member("fresnel", &Look::fresnel,
              {{"schlick-exp2", Fresnel::schlickExp2},
               {"rational", Fresnel::rational},
               {"exact", plain.fresnel},
               {"textbook", Fresnel::textbook},
               {"schlick", Fresnel::schlick}});
  good.member("normalization", &Look::normalization, {{"exact", Normalization::exact}});
  good.member("specular-antialiasing", &Look::specularAntialiasing,
              {{"toksvig", SpecularAntialiasing::toksvig}});
  good.member("blinn-factor", &Look::blinnFactor, {{"3.5", 3.5}, {"0", 0.0}});
  good.member("schlick-exponent", &Look::schlickExponent, {{"4", 4.0}});
  good.material("", "exponent=80", [](auto& m) { m.exponent = 80; });
  good.material("Helmet", "Helmet:metalness=1,color=0.8,0.2,0.1,exponent=50", [](auto& m) {
    m.metalness = 1;
    m.color = glm::dvec3(0.8, 0.2, 0.1);
    m.exponent = 50;
  });
  good.material("", "color=#ffffff,ior=1.33", [](auto& m) {
    m.color = glm::dvec3(1);
    m.ior = 1.33;
  });
  good.material("a:b", "a:b:highlight=lyon:8,exponent=3", [](auto& m) {
    m.highlight = HighlightForm(Highlight::lyon, 8);
    m.exponent = 3;
  });
  good.material("", "highlight=exact/1,gaussian/7,none,exponent=3", [](auto& m) {
    m.highlight = HighlightForms();
    m.highlight->add(Highlight::gaussian, 1);
    m.highlight->add(Highlight::none, 8);
    m.exponent = 3;
  });
  good.material("", "highlight=pow,fresnel=rational", [](auto& m) {
    m.highlight = Highlight::pow;
    m.fresnel = Fresnel::rational;
  });
  good.material("a:b, c", "a:b, c:specular=0.5", [](auto& m) { m.specular = 0.5; });
  good.material("", "ambient=0,diffuse=1e6,specular=0,exponent=0,metalness=0,ior=1e-3",
                [](auto& m) {
                  m.ambient = m.specular = m.exponent = m.metalness = 0;
                  m.diffuse = 1e6;
                  m.ior = 1e-3;
                });
  good.member("two-sided", &Look::twoSided, {{"true", true}, {"false", plain.twoSided}});
  good.member("ambient-light", &Look::ambientLight, {{"0,0.5,1", {0, 0.5, 1}}, {"#FFffff", one}});
  good.member("light", &Look::light,
              {{"directional:1,2,-3", light(Type::directional, {}, {1, 2, -3})},
               {"directional:1e-300,0,0:0.5,0,1e6",
                light(Type::directional, {}, {1e-300, 0, 0}, {0.5, 0, 1e6})},
               {"point:-1,+2,.5:#000000", light(Type::point, {-1, 2, 0.5}, {}, {})},
               {"point:-1,2,3:0.5,0,2:falloff",
                light(Type::point, {-1, 2, 3}, {}, {0.5, 0, 2}, 0, 45, true)},
               {"spot:0,3,0:0,-1,0:0,90:falloff,2.5",
                light(Type::spot, {0, 3, 0}, {0, -1, 0}, one, 0, 90, true, 2.5)},
               {"spot:0,3,0:0,-1,0:10,20:1,1,0",
                light(Type::spot, {0, 3, 0}, {0, -1, 0}, {1, 1, 0}, 10, 20)},
               {"spot:0,3,0:0,-1,0:0,90", light(Type::spot, {0, 3, 0}, {0, -1, 0}, one, 0, 90)},
               {"camera", light(Type::camera, {}, {0, 0, 1})},
               {"camera:2,3,4", light(Type::camera, {}, {0, 0, 1}, {2, 3, 4})}});
  good.member("no-lights", &Look::noLights, {{"true", true}});
  good.member("viewer", &Look::viewer, {{"infinite", Viewer::infinite}, {"local", plain.viewer}});
  good.member("medium-ior", &Look::mediumIor, {{"1.33", 1.33}});
  good.member(
      "environment", &Look::environment,
      {{"sky", Environment::sky}, {"white", Environment::white}, {"studio", plain.environment}});
  good.member("environment-rotation", &Look::environmentRotation, {{"-90", -90.0}});
  good.member("environment-background", &Look::environmentBackground, {{"true", true}});
  good.member("camera-position", &Look::cameraPosition, {{"-1,2,3", glm::dvec3(-1, 2, 3)}});
  good.member("camera-focal-point", &Look::cameraFocalPoint, {{"0,0,0", glm::dvec3(0)}});
  good.member("camera-view-up", &Look::cameraViewUp, {{"0,0,1", glm::dvec3(0, 0, 1)}});
  good.member("camera-view-angle", &Look::cameraViewAngle, {{"179.9", 179.9}});
  good.member("camera-intrinsics", &Look::cameraIntrinsics,
              {{"800,801.5,-3,240.5", glm::dvec4(800, 801.5, -3, 240.5)}});
  good.member("camera-direction", &Look::cameraDirection, {{"0,0,-1", glm::dvec3(0, 0, -1)}});
  good.member("camera-azimuth-angle", &Look::cameraAzimuthAngle, {{"-30", -30.0}});
  good.member("camera-elevation-angle", &Look::cameraElevationAngle, {{"15", 15.0}});
  good.member("camera-zoom-factor", &Look::cameraZoomFactor, {{"1.5", 1.5}});
  good.member("camera-orthographic", &Look::cameraOrthographic, {{"true", true}});
  good.member("camera-index", &Look::cameraIndex, {{"3", 3}});
  good.member("animation-time", &Look::animationTime, {{"1.5", 1.5}});
  good.member("animation", &Look::animation, {{"Walk, 2", "Walk, 2"}});
  good.member("scene", &Look::scene, {{"Night", "Night"}});
  good.member("variant", &Look::variant, {{"street, worn", "street, worn"}});
  good.member("up", &Look::up, {{"-X", UpAxis::minusX}});
  good.member("hdri-file", &Look::hdriFile, {{"a b.hdr", "a b.hdr"}});
  good.member("cost-table", &Look::costTable, {{"my costs.json", "my costs.json"}});
  good.member("light-scale", &Look::lightScale, {{"0.01", 0.01}, {"auto", plain.lightScale}});
  good.member("clipping-range", &Look::clippingRange, {{"0.1,1e7", glm::dvec2(0.1, 1e7)}});
  good.member("resolution", &Look::resolution, {{"640,480", {640, 480}}, {"65535,1", {65535, 1}}});
  good.member(
      "anti-aliasing", &Look::antiAliasing,
      {{"none", {Mode::none, 1}}, {"msaa:8", {Mode::msaa, 8}}, {"ssaa:3", {Mode::ssaa, 3}}});
  good.member("background-color", &Look::backgroundColor,
              {{"1,0,0.25", {1, 0, 0.25}}, {"#333333", glm::dvec3(decodeSrgb8(0x33))}});
  good.member("no-background", &Look::noBackground, {{"true", true}});
  good.member("exposure", &Look::exposure, {{"-1.5", -1.5}});
  return good.all;
}

/// Texts that an option refuses, with | between them: the first of each is empty.
const std::map<std::string, std::string> badTexts{
    {"shading", "|Phong|phon|automatic|blinnphong"},
    {"highlight",
     "|lyon|lyon:|lyon:0|lyon:3|lyon:128|lyon:-8|lyon:8:8|lyon:8.0|pade|gaussian:8"
     "|exact:1|integer:4|Exact|lyontuned:8|exact/2|exact,lyon:8|exact/0,pow"
     "|exact/129,pow|exact/x,pow|exact/2,pow/3|/2,pow|exact/2/3,pow"
     "|exact/1,pow/1,exact/1,pow/1,exact"},
    {"fresnel", "|Rational|schlick-exp|rational:2"},
    {"max-error", "|x|-1|-1e-9|nan|inf|1e7|0.1 |code|1codes|1 code"},
    {"normalization", "|x|Exact|2"},
    {"specular-antialiasing", "|yes|Toksvig"},
    {"blinn-factor", "|x|-1|1001|nan|inf|4 |4,|0x10"},
    {"schlick-exponent", "|-0.1|1e9|nan"},
    {"material",
     "|a:,ior=2|=1|exponent|exponent=|exponent=x|exponent=-1|exponent=nan"
     "|exponent=1e7|exponent=1,2|metalness=1.1|metalness=-0.1|ior=0|ior=1001"
     "|colour=1,1,1|color=1,1|color=1,1,1,1|color=#12345|color=-1,0,0|Helmet:"
     "|Helmet:=1|ambient=1e7|diffuse=inf|specular=-1|highlight=|highlight=lyon"
     "|highlight=exact,1|fresnel=lyon:8"},
    {"two-sided", "|yes|1|True"},
    {"ambient-light", "|1|1,1|1,1,1,1|-1,0,0|nan,0,0|#12|#gggggg|1e7,0,0"},
    {"light",
     "|sun|directional|directional:|directional:1,2|directional:0,0,0"
     "|directional:1,2,3:1|directional:1,2,3:1,1,1:1|directional:nan,0,0"
     "|directional:inf,0,0|point|point:1,2,3:-1,0,0|point:1,2,3:falloff:1,1,1"
     "|point:1,2,3:falloff,-1|point:1,2,3:falloff,nan|point:1,2,3:falloff,"
     "|point:1,2,3:fallof|point:1,2,3:falloff2|directional:1,2,3:falloff"
     "|camera:falloff|spot:0,0,0:0,0,0:1,2|spot:0,0,0:0,1,0|spot:0,0,0:0,1,0:20,10"
     "|spot:0,0,0:0,1,0:10,10|spot:0,0,0:0,1,0:0,91|spot:0,0,0:0,1,0:-1,20"
     "|spot:0,0,0:0,1,0:nan,20|camera:1|camera:1,1,1:1|Directional:1,2,3"},
    {"no-lights", "|on"},
    {"viewer", "|far"},
    {"medium-ior", "|0|-1|1e4|nan|inf"},
    {"environment", "|black|Studio"},
    {"environment-rotation", "|nan|1e7|90deg"},
    {"environment-background", "|2"},
    {"camera-position", "|1,2|1,2,3,4|1,2,x|inf,0,0|nan,0,0|1e31,0,0|1, 2,3"},
    {"camera-focal-point", "|1,2|nan,0,0"},
    {"camera-view-up", "|0,0,0|0,-0,0|1,2|nan,0,0"},
    {"camera-view-angle", "|0|-30|180|nan"},
    {"camera-direction", "|0,0,0|1,2|inf,0,0"},
    {"camera-azimuth-angle", "|x|nan|1e7"},
    {"camera-elevation-angle", "|x|inf"},
    {"camera-intrinsics",
     "|800|800,800,320|0,800,320,240|-800,800,320,240|800,800,320,240,0"
     "|nan,800,320,240|800,800,inf,240|1e8,800,320,240|800,800,x,240"},
    {"camera-zoom-factor", "|0|-1|nan"},
    {"camera-orthographic", "|maybe"},
    {"camera-index", "|-1|1.5|x|99999999999999999999"},
    {"animation-time", "|-1|x|nan|1e10"},
    {"animation", ""},
    {"scene", ""},
    {"variant", ""},
    {"up", "|Z|+W|+y"},
    {"hdri-file", ""},
    {"cost-table", ""},
    {"light-scale", "|-1|x|inf"},
    {"clipping-range", "|1|0,1|-1,1|2,1|1,1|1,nan|nan,1|1,inf|1,2,3"},
    {"resolution", "|640|640x480|0,480|640,-1|65536,1|1.5,2|1,2,3"},
    {"anti-aliasing", "|4|msaa|msaa:|msaa:0|msaa:65|ssaa:0|ssaa:17|msaa:2.5|none:1|msaa:4:4|taa:2"},
    {"background-color", "|black|#12345|1,1"},
    {"no-background", "|0"},
    {"exposure", "|x|65|-65|nan"},
};

TEST(LookTexts, GoodOnesSetWhatTheyName) {
  std::set<std::string> seen;
  for (const Good& good : goodTexts()) {
    seen.insert(good.name);
    Look look;
    EXPECT_NO_THROW(look = with(good.name, good.text)) << good.name << " " << good.text;
    EXPECT_EQ(look, good.look) << good.name << " " << good.text;
  }
  for (const Parameter& p : lookParameters())
    EXPECT_TRUE(seen.contains(p.name)) << "no good text of --" << p.name << " is tried";
}

TEST(LookTexts, BadOnesAreRefusedByName) {
  for (const Parameter& p : lookParameters())
    EXPECT_TRUE(badTexts.contains(p.name)) << "no bad text of --" << p.name << " is tried";
  for (const auto& [name, texts] : badTexts)
    for (const std::string& text : partsOf(texts)) {
      const std::string message = messageOf([&, &n = name] { with(n, text); });
      EXPECT_THAT(message, AllOf(StartsWith("--" + name), HasSubstr(": "), Not(HasSubstr("\n"))))
          << name << " '" << text << "'";
    }
}

TEST(LookTexts, EveryParameterTellsWhatItIs) {
  std::set<std::string> names;
  for (const Parameter& p : lookParameters()) {
    EXPECT_TRUE(names.insert(p.name).second) << p.name;
    EXPECT_FALSE(p.help.empty()) << p.name;
    EXPECT_FALSE(p.section.empty()) << p.name;
    EXPECT_EQ(p.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos) << p.name;
  }
}

TEST(LookTexts, RepeatedMaterialsAddUp) {
  Look look;
  for (const char* text : {"exponent=5", "specular=0.5,exponent=7", "a:ior=2"})
    parameter("material").read(look, text);
  EXPECT_EQ(look.material[""].exponent, 7);
  EXPECT_EQ(look.material[""].specular, 0.5);
  EXPECT_EQ(look.material["a"].ior, 2);
  EXPECT_FALSE(look.material["a"].exponent);
}

TEST(LookTexts, LightsAddUpToTheLimit) {
  Look look;
  for (int i = 0; i < 128; ++i) parameter("light").read(look, "point:0,0,1");
  EXPECT_EQ(look.light->size(), 128u);
  EXPECT_THAT(messageOf([&] { parameter("light").read(look, "camera"); }), HasSubstr("128"));
}

TEST(LookTexts, HexColoursAreSrgb) {
  EXPECT_EQ(float(Look{}.backgroundColor.r), decodeSrgb8(0x33));  // the default, #333333
  // IEC 61966-2-1: 0x80 = 128 / 255 is ((0.50196 + 0.055) / 1.055)^2.4; the table is float.
  const double expected = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);
  EXPECT_NEAR(with("background-color", "#800000").backgroundColor.r, expected, 3e-8);
  EXPECT_EQ(with("background-color", "#800000").backgroundColor.g, 0);
}

TEST(LookFiles, RoundTripEveryGoodText) {
  for (const Good& good : goodTexts()) {
    const Look look = with(good.name, good.text);
    EXPECT_EQ(lookOf(saveLook(look)), look) << good.name << " " << good.text;
  }
}

TEST(MaterialEdits, NameBeatsAllBeatsModel) {
  Material a = materialOf(1, 0.8, 0.5, 20, 0.25);
  a.name = "a";
  Look look;
  EXPECT_EQ(editedMaterial(a, look).shading.exponent, 20);
  parameter("material").read(look, "exponent=40,specular=0.1");
  parameter("material").read(look, "a:exponent=60");
  parameter("material").read(look, "b:exponent=80");
  const ShadingParameters edited = editedMaterial(a, look).shading;
  EXPECT_EQ(edited.exponent, 60);
  EXPECT_EQ(edited.specular, 0.1);
  EXPECT_EQ(edited.diffuse, 0.8);
  EXPECT_EQ(edited.metalness, 0.25);
  a.name.clear();
  EXPECT_EQ(editedMaterial(a, look).shading.exponent, 40);
}

TEST(MaterialEdits, OfMaterialsThatDoNotExistAreRefused) {
  Material a;
  a.name = "a";
  const Scene scene = sceneOf(quad(), a);
  Look look = with("material", "a:exponent=1");
  EXPECT_NO_THROW(checkMaterialNames(scene, look));
  look = with("material", "B:exponent=1");
  EXPECT_THAT(messageOf([&] { checkMaterialNames(scene, look); }),
              AllOf(HasSubstr("'B'"), HasSubstr("use one of 'a'")));
}

TEST(SpecularAntialiasingOption, AloneIsASwitch) {
  const auto of = [](const std::string& text) {
    return lookFrom({{"specular-antialiasing", text}}).specularAntialiasing;
  };
  EXPECT_EQ(of("true"), SpecularAntialiasing::kaplanyan);  // like the option without a value
  EXPECT_EQ(of("false"), SpecularAntialiasing::none);
  EXPECT_EQ(of("toksvig"), SpecularAntialiasing::toksvig);
}

}  // namespace glint::test::look_test
