// The syntax of options and look files.

#include <gmock/gmock.h>

#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "glint/image/error.h"
#include "glint/image/srgb.h"
#include "glint/options/parameters.h"
#include "scenes.h"

namespace glint {
void PrintTo(const Look& look, std::ostream* out) { *out << saveLook(look); }
}  // namespace glint

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

namespace glint::test::look_test {

const Parameter& parameter(const std::string& name) {
  for (const Parameter& p : glint::lookParameters())
    if (p.name == name) return p;
  throw std::runtime_error("no parameter " + name);
}

Look with(const std::string& name, const std::string& text) {
  Look look;
  parameter(name).read(look, text);
  return look;
}

std::string failure(const std::function<void()>& call) {
  try {
    call();
  } catch (const glint::InputError& error) {
    return error.what();
  }
  return "no error";
}

Look read(const std::string& json) {
  Look look;
  glint::readLook(look, json, "a.json");
  return look;
}

using Change = std::function<void(Look&)>;

struct Good {
  const char *name, *text;
  Change change;
};

Light light(Light::Type type, glm::dvec3 position, glm::dvec3 direction, glm::dvec3 intensity,
            double inner = 0, double outer = 45) {
  return {type, position, direction, inner, outer, intensity};
}

// The look that each option's text gives, starting from the default, written by hand.
const std::vector<Good>& goodTexts() {
  using glint::Environment, glint::Fresnel, glint::Highlight, glint::Shading, glint::Viewer;
  const auto material = [](const char* name, auto edit) {
    return [=](Look& l) { edit(l.material[name]); };
  };
  static const std::vector<Good> table{
      {"shading", "flat", [](Look& l) { l.shading = Shading::flat; }},
      {"shading", "gouraud", [](Look& l) { l.shading = Shading::gouraud; }},
      {"shading", "phong", [](Look&) {}},
      {"shading", "blinn-phong", [](Look& l) { l.shading = Shading::blinnPhong; }},
      {"shading", "environment", [](Look& l) { l.shading = Shading::environment; }},
      {"shading", "auto", [](Look& l) { l.shading = Shading::automatic; }},
      {"max-error", "0", [](Look& l) { l.maxError = 0; }},
      {"max-error", "1e-3", [](Look& l) { l.maxError = 1e-3; }},
      {"max-error", "1.5code",
       [](Look& l) {
         l.maxError = 1.5;
         l.maxErrorInCodes = true;
       }},
      {"highlight", "exact", [](Look&) {}},
      {"highlight", "pow", [](Look& l) { l.highlight = Highlight::pow; }},
      {"highlight", "integer", [](Look& l) { l.highlight = Highlight::integer; }},
      {"highlight", "lyon:8",
       [](Look& l) {
         l.highlight = {Highlight::lyon, 8};
       }},
      {"highlight", "lyon-tuned:1",
       [](Look& l) {
         l.highlight = {Highlight::lyonTuned, 1};
       }},
      {"highlight", "lyon-cross:64",
       [](Look& l) {
         l.highlight = {Highlight::lyonCross, 64};
       }},
      {"highlight", "pade:+4",
       [](Look& l) {
         l.highlight = {Highlight::pade, 4};
       }},
      {"highlight", "gaussian", [](Look& l) { l.highlight = Highlight::gaussian; }},
      {"highlight", "none", [](Look& l) { l.highlight = Highlight::none; }},
      {"highlight", "exact/2,lyon:8",
       [](Look& l) {
         l.highlight.dimmer = {{{Highlight::lyon, 8}, 2}};
       }},
      {"highlight", "pade:4/1,pow/1,pow/3,none",
       [](Look& l) {
         l.highlight = {Highlight::pade, 4};
         l.highlight.dimmer = {{Highlight::pow, 1}, {Highlight::none, 5}};
       }},
      {"fresnel", "schlick-exp2", [](Look& l) { l.fresnel = Fresnel::schlickExp2; }},
      {"fresnel", "rational", [](Look& l) { l.fresnel = Fresnel::rational; }},
      {"fresnel", "exact", [](Look&) {}},
      {"fresnel", "textbook", [](Look& l) { l.fresnel = Fresnel::textbook; }},
      {"fresnel", "schlick", [](Look& l) { l.fresnel = Fresnel::schlick; }},
      {"normalization", "exact", [](Look& l) { l.normalization = glint::Normalization::exact; }},
      {"specular-antialiasing", "toksvig",
       [](Look& l) { l.specularAntialiasing = SpecularAntialiasing::toksvig; }},
      {"blinn-factor", "3.5", [](Look& l) { l.blinnFactor = 3.5; }},
      {"blinn-factor", "0", [](Look& l) { l.blinnFactor = 0; }},
      {"schlick-exponent", "4", [](Look& l) { l.schlickExponent = 4; }},
      {"material", "exponent=80", material("", [](auto& m) { m.exponent = 80; })},
      {"material", "Helmet:metalness=1,color=0.8,0.2,0.1,exponent=50",
       material("Helmet",
                [](auto& m) {
                  m.metalness = 1;
                  m.color = glm::dvec3(0.8, 0.2, 0.1);
                  m.exponent = 50;
                })},
      {"material", "color=#ffffff,ior=1.33",
       material("",
                [](auto& m) {
                  m.color = glm::dvec3(1);
                  m.ior = 1.33;
                })},
      {"material", "a:b:highlight=lyon:8,exponent=3",
       material("a:b",
                [](auto& m) {
                  m.highlight = glint::HighlightForm(Highlight::lyon, 8);
                  m.exponent = 3;
                })},
      {"material", "highlight=exact/1,gaussian/7,none,exponent=3",
       material("",
                [](auto& m) {
                  m.highlight = glint::HighlightForms();
                  m.highlight->add(Highlight::gaussian, 1);
                  m.highlight->add(Highlight::none, 8);
                  m.exponent = 3;
                })},
      {"material", "highlight=pow,fresnel=rational",
       material("",
                [](auto& m) {
                  m.highlight = Highlight::pow;
                  m.fresnel = Fresnel::rational;
                })},
      {"material", "a:b, c:specular=0.5", material("a:b, c", [](auto& m) { m.specular = 0.5; })},
      {"material", "ambient=0,diffuse=1e6,specular=0,exponent=0,metalness=0,ior=1e-3",
       material("",
                [](auto& m) {
                  m.ambient = 0;
                  m.diffuse = 1e6;
                  m.specular = 0;
                  m.exponent = 0;
                  m.metalness = 0;
                  m.ior = 1e-3;
                })},
      {"two-sided", "true", [](Look& l) { l.twoSided = true; }},
      {"two-sided", "false", [](Look&) {}},
      {"ambient-light", "0,0.5,1",
       [](Look& l) {
         l.ambientLight = {0, 0.5, 1};
       }},
      {"ambient-light", "#FFffff", [](Look& l) { l.ambientLight = glm::dvec3(1); }},
      {"light", "directional:1,2,-3",
       [](Look& l) {
         l.light = {light(Light::Type::directional, {}, {1, 2, -3}, glm::dvec3(1))};
       }},
      {"light", "directional:1e-300,0,0:0.5,0,1e6",
       [](Look& l) {
         l.light = {light(Light::Type::directional, {}, {1e-300, 0, 0}, {0.5, 0, 1e6})};
       }},
      {"light", "point:-1,+2,.5:#000000",
       [](Look& l) {
         l.light = {light(Light::Type::point, {-1, 2, 0.5}, {}, glm::dvec3(0))};
       }},
      {"light", "point:-1,2,3:0.5,0,2:falloff",
       [](Look& l) {
         l.light = {light(Light::Type::point, {-1, 2, 3}, {}, {0.5, 0, 2})};
         l.light->front().fallsOff = true;
       }},
      {"light", "spot:0,3,0:0,-1,0:0,90:falloff,2.5",
       [](Look& l) {
         l.light = {light(Light::Type::spot, {0, 3, 0}, {0, -1, 0}, glm::dvec3(1), 0, 90)};
         l.light->front().fallsOff = true;
         l.light->front().range = 2.5;
       }},
      {"light", "spot:0,3,0:0,-1,0:10,20:1,1,0",
       [](Look& l) {
         l.light = {light(Light::Type::spot, {0, 3, 0}, {0, -1, 0}, {1, 1, 0}, 10, 20)};
       }},
      {"light", "spot:0,3,0:0,-1,0:0,90",
       [](Look& l) {
         l.light = {light(Light::Type::spot, {0, 3, 0}, {0, -1, 0}, glm::dvec3(1), 0, 90)};
       }},
      {"light", "camera",
       [](Look& l) {
         l.light = {light(Light::Type::camera, {}, {0, 0, 1}, glm::dvec3(1))};
       }},
      {"light", "camera:2,3,4",
       [](Look& l) {
         l.light = {light(Light::Type::camera, {}, {0, 0, 1}, {2, 3, 4})};
       }},
      {"no-lights", "true", [](Look& l) { l.noLights = true; }},
      {"viewer", "infinite", [](Look& l) { l.viewer = Viewer::infinite; }},
      {"viewer", "local", [](Look&) {}},
      {"medium-ior", "1.33", [](Look& l) { l.mediumIor = 1.33; }},
      {"environment", "sky", [](Look& l) { l.environment = Environment::sky; }},
      {"environment", "white", [](Look& l) { l.environment = Environment::white; }},
      {"environment", "studio", [](Look&) {}},
      {"environment-rotation", "-90", [](Look& l) { l.environmentRotation = -90; }},
      {"environment-background", "true", [](Look& l) { l.environmentBackground = true; }},
      {"camera-position", "-1,2,3", [](Look& l) { l.cameraPosition = glm::dvec3(-1, 2, 3); }},
      {"camera-focal-point", "0,0,0", [](Look& l) { l.cameraFocalPoint = glm::dvec3(0); }},
      {"camera-view-up", "0,0,1", [](Look& l) { l.cameraViewUp = glm::dvec3(0, 0, 1); }},
      {"camera-view-angle", "179.9", [](Look& l) { l.cameraViewAngle = 179.9; }},
      {"camera-intrinsics", "800,801.5,-3,240.5",
       [](Look& l) { l.cameraIntrinsics = glm::dvec4(800, 801.5, -3, 240.5); }},
      {"camera-direction", "0,0,-1", [](Look& l) { l.cameraDirection = glm::dvec3(0, 0, -1); }},
      {"camera-azimuth-angle", "-30", [](Look& l) { l.cameraAzimuthAngle = -30; }},
      {"camera-elevation-angle", "15", [](Look& l) { l.cameraElevationAngle = 15; }},
      {"camera-zoom-factor", "1.5", [](Look& l) { l.cameraZoomFactor = 1.5; }},
      {"camera-orthographic", "true", [](Look& l) { l.cameraOrthographic = true; }},
      {"camera-index", "3", [](Look& l) { l.cameraIndex = 3; }},
      {"animation-time", "1.5", [](Look& l) { l.animationTime = 1.5; }},
      {"animation", "Walk, 2", [](Look& l) { l.animation = "Walk, 2"; }},
      {"scene", "Night", [](Look& l) { l.scene = "Night"; }},
      {"variant", "street, worn", [](Look& l) { l.variant = "street, worn"; }},
      {"up", "-X", [](Look& l) { l.up = glint::UpAxis::minusX; }},
      {"hdri-file", "a b.hdr", [](Look& l) { l.hdriFile = "a b.hdr"; }},
      {"cost-table", "my costs.json", [](Look& l) { l.costTable = "my costs.json"; }},
      {"light-scale", "0.01", [](Look& l) { l.lightScale = 0.01; }},
      {"light-scale", "auto", [](Look& l) { l.lightScale.reset(); }},
      {"clipping-range", "0.1,1e7", [](Look& l) { l.clippingRange = glm::dvec2(0.1, 1e7); }},
      {"resolution", "640,480",
       [](Look& l) {
         l.resolution = {640, 480};
       }},
      {"resolution", "65535,1",
       [](Look& l) {
         l.resolution = {65535, 1};
       }},
      {"anti-aliasing", "none",
       [](Look& l) {
         l.antiAliasing = {AntiAliasing::Mode::none, 1};
       }},
      {"anti-aliasing", "msaa:8",
       [](Look& l) {
         l.antiAliasing = {AntiAliasing::Mode::msaa, 8};
       }},
      {"anti-aliasing", "ssaa:3",
       [](Look& l) {
         l.antiAliasing = {AntiAliasing::Mode::ssaa, 3};
       }},
      {"background-color", "1,0,0.25",
       [](Look& l) {
         l.backgroundColor = {1, 0, 0.25};
       }},
      {"background-color", "#333333",
       [](Look& l) { l.backgroundColor = glm::dvec3(glint::decodeSrgb8(0x33)); }},
      {"no-background", "true", [](Look& l) { l.noBackground = true; }},
      {"exposure", "-1.5", [](Look& l) { l.exposure = -1.5; }},
  };
  return table;
}

const std::map<std::string, std::vector<std::string>>& badTexts() {
  static const std::map<std::string, std::vector<std::string>> table{
      {"shading", {"", "Phong", "phon", "automatic", "blinnphong"}},
      {"highlight",
       {"",
        "lyon",
        "lyon:",
        "lyon:0",
        "lyon:3",
        "lyon:128",
        "lyon:-8",
        "lyon:8:8",
        "lyon:8.0",
        "pade",
        "gaussian:8",
        "exact:1",
        "integer:4",
        "Exact",
        "lyontuned:8",
        "exact/2",
        "exact,lyon:8",
        "exact/0,pow",
        "exact/129,pow",
        "exact/x,pow",
        "exact/2,pow/3",
        "/2,pow",
        "exact/2/3,pow",
        "exact/1,pow/1,exact/1,pow/1,exact"}},
      {"fresnel", {"", "Rational", "schlick-exp", "rational:2"}},
      {"max-error",
       {"", "x", "-1", "-1e-9", "nan", "inf", "1e7", "0.1 ", "code", "1codes", "1 code"}},
      {"normalization", {"", "x", "Exact", "2"}},
      {"specular-antialiasing", {"", "yes", "Toksvig"}},
      {"blinn-factor", {"", "x", "-1", "1001", "nan", "inf", "4 ", "4,", "0x10"}},
      {"schlick-exponent", {"", "-0.1", "1e9", "nan"}},
      {"material",
       {"a:,ior=2",
        "",
        "=1",
        "exponent",
        "exponent=",
        "exponent=x",
        "exponent=-1",
        "exponent=nan",
        "exponent=1e7",
        "exponent=1,2",
        "metalness=1.1",
        "metalness=-0.1",
        "ior=0",
        "ior=1001",
        "colour=1,1,1",
        "color=1,1",
        "color=1,1,1,1",
        "color=#12345",
        "color=-1,0,0",
        "Helmet:",
        "Helmet:=1",
        "ambient=1e7",
        "diffuse=inf",
        "specular=-1",
        "highlight=",
        "highlight=lyon",
        "highlight=exact,1",
        "fresnel=lyon:8"}},
      {"two-sided", {"", "yes", "1", "True"}},
      {"ambient-light",
       {"", "1", "1,1", "1,1,1,1", "-1,0,0", "nan,0,0", "#12", "#gggggg", "1e7,0,0"}},
      {"light",
       {"",
        "sun",
        "directional",
        "directional:",
        "directional:1,2",
        "directional:0,0,0",
        "directional:1,2,3:1",
        "directional:1,2,3:1,1,1:1",
        "directional:nan,0,0",
        "directional:inf,0,0",
        "point",
        "point:1,2,3:-1,0,0",
        "point:1,2,3:falloff:1,1,1",
        "point:1,2,3:falloff,-1",
        "point:1,2,3:falloff,nan",
        "point:1,2,3:falloff,",
        "point:1,2,3:fallof",
        "point:1,2,3:falloff2",
        "directional:1,2,3:falloff",
        "camera:falloff",
        "spot:0,0,0:0,0,0:1,2",
        "spot:0,0,0:0,1,0",
        "spot:0,0,0:0,1,0:20,10",
        "spot:0,0,0:0,1,0:10,10",
        "spot:0,0,0:0,1,0:0,91",
        "spot:0,0,0:0,1,0:-1,20",
        "spot:0,0,0:0,1,0:nan,20",
        "camera:1",
        "camera:1,1,1:1",
        "Directional:1,2,3"}},
      {"no-lights", {"", "on"}},
      {"viewer", {"", "far"}},
      {"medium-ior", {"", "0", "-1", "1e4", "nan", "inf"}},
      {"environment", {"", "black", "Studio"}},
      {"environment-rotation", {"", "nan", "1e7", "90deg"}},
      {"environment-background", {"", "2"}},
      {"camera-position",
       {"", "1,2", "1,2,3,4", "1,2,x", "inf,0,0", "nan,0,0", "1e31,0,0", "1, 2,3"}},
      {"camera-focal-point", {"", "1,2", "nan,0,0"}},
      {"camera-view-up", {"", "0,0,0", "0,-0,0", "1,2", "nan,0,0"}},
      {"camera-view-angle", {"", "0", "-30", "180", "nan"}},
      {"camera-direction", {"", "0,0,0", "1,2", "inf,0,0"}},
      {"camera-azimuth-angle", {"", "x", "nan", "1e7"}},
      {"camera-elevation-angle", {"", "x", "inf"}},
      {"camera-intrinsics",
       {"", "800", "800,800,320", "0,800,320,240", "-800,800,320,240", "800,800,320,240,0",
        "nan,800,320,240", "800,800,inf,240", "1e8,800,320,240", "800,800,x,240"}},
      {"camera-zoom-factor", {"", "0", "-1", "nan"}},
      {"camera-orthographic", {"", "maybe"}},
      {"camera-index", {"", "-1", "1.5", "x", "99999999999999999999"}},
      {"animation-time", {"", "-1", "x", "nan", "1e10"}},
      {"animation", {""}},
      {"scene", {""}},
      {"variant", {""}},
      {"up", {"", "Z", "+W", "+y"}},
      {"hdri-file", {""}},
      {"cost-table", {""}},
      {"light-scale", {"", "-1", "x", "inf"}},
      {"clipping-range",
       {"", "1", "0,1", "-1,1", "2,1", "1,1", "1,nan", "nan,1", "1,inf", "1,2,3"}},
      {"resolution", {"", "640", "640x480", "0,480", "640,-1", "65536,1", "1.5,2", "1,2,3"}},
      {"anti-aliasing",
       {"", "4", "msaa", "msaa:", "msaa:0", "msaa:65", "ssaa:0", "ssaa:17", "msaa:2.5", "none:1",
        "msaa:4:4", "taa:2"}},
      {"background-color", {"", "black", "#12345", "1,1"}},
      {"no-background", {"", "0"}},
      {"exposure", {"", "x", "65", "-65", "nan"}},
  };
  return table;
}

class RandomLooks {
 public:
  explicit RandomLooks(unsigned seed) : random_(seed) {}

  Look next() {
    Look l;
    l.shading = glint::Shading(index(6));
    if (coin()) l.maxError = number(0, 1e6);
    l.highlight = highlight();
    l.fresnel = glint::Fresnel(index(5));
    l.blinnFactor = number(0, 1e3);
    l.schlickExponent = number(0, 1e3);
    for (const char* name : {"", "a", "b: c,d"})
      if (coin()) l.material[name] = edit();
    l.ambientLight = vector(0, 1e6);
    if (coin()) {
      l.light.emplace();
      for (int i = index(5); i > 0; --i) l.light->push_back(light());
    }
    l.noLights = coin();
    l.viewer = glint::Viewer(index(2));
    l.mediumIor = number(1e-3, 1e3);
    l.environment = glint::Environment(index(3));
    l.environmentRotation = number(-1e6, 1e6);
    l.environmentBackground = coin();
    l.twoSided = coin();
    l.normalization = glint::Normalization(index(3));
    l.specularAntialiasing = SpecularAntialiasing(index(3));
    if (coin()) l.cameraPosition = vector(-1e30, 1e30);
    if (coin()) l.cameraFocalPoint = vector(-1, 1);
    if (coin()) l.cameraDirection = vector(1e-6, 1e6);
    if (coin()) l.cameraViewUp = vector(-1, -1e-3);
    if (coin()) l.cameraViewAngle = number(1e-5, 179.9);
    l.cameraAzimuthAngle = number(-1e6, 1e6);
    l.cameraElevationAngle = number(-90, 90);
    l.cameraZoomFactor = number(1e-6, 1e6);
    l.cameraOrthographic = coin();
    if (coin()) {  // replaces both
      l.cameraIntrinsics = {number(1e-3, 1e7), number(1e-3, 1e7), number(-1e7, 1e7), 0};
      l.cameraViewAngle.reset();
      l.cameraOrthographic = false;
    }
    if (coin()) l.cameraIndex = index(1 << 30);
    if (coin()) l.animationTime = number(0, 1e9);
    if (coin()) l.animation = "take 2";
    if (coin()) l.hdriFile = "room.exr";
    if (coin()) l.costTable = "costs.json";
    if (coin()) l.lightScale = number(0, 1e30);
    if (coin()) l.clippingRange = glm::dvec2(number(1e-3, 1), number(2, 1e30));
    l.resolution = {1 + index(65535), 1 + index(65535)};
    const AntiAliasing kinds[] = {{AntiAliasing::Mode::none, 1},
                                  {AntiAliasing::Mode::msaa, 1 + index(64)},
                                  {AntiAliasing::Mode::ssaa, 1 + index(16)}};
    l.antiAliasing = kinds[index(3)];
    l.backgroundColor = vector(0, 1);
    l.noBackground = coin();
    l.exposure = number(-64, 64);
    return l;
  }

 private:
  int index(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  bool coin() { return index(2) == 1; }
  // Whole, short and long numbers, over all magnitudes of the range.
  double number(double min, double max) {
    const double x = std::uniform_real_distribution<double>(0, 1)(random_);
    const double y = min + (max - min) * (coin() ? x : std::pow(x, 12));
    return coin() ? y : std::clamp(std::round(y), min, max);
  }
  glm::dvec3 vector(double min, double max) {
    return {number(min, max), number(min, max), number(min, max)};
  }
  glint::MaterialEdit edit() {
    glint::MaterialEdit e;
    e.exponent = number(0, 1e6);
    if (coin()) e.ambient = number(0, 1e6);
    if (coin()) e.diffuse = number(0, 1);
    if (coin()) e.specular = number(0, 1);
    if (coin()) e.metalness = number(0, 1);
    if (coin()) e.ior = number(1e-3, 1e3);
    if (coin()) e.color = vector(0, 1);
    if (coin()) e.highlight = highlight();
    if (coin()) e.fresnel = glint::Fresnel(index(5));
    return e;
  }
  glint::HighlightForm form() {
    const auto& form = glint::highlightRows()[std::size_t(index(10))];
    return {form.form, form.hasGamma() ? form.leastGamma << index(7) : 0};
  }
  glint::HighlightForms highlight() {
    glint::HighlightForms forms = form();
    for (int from = 1 + index(5); coin() && forms.dimmer.size() < forms.mostDimmer;
         from += 1 + index(30))
      forms.add(form(), from);
    return forms;
  }
  Light light() {
    Light l;
    l.type = Light::Type(index(4));
    l.intensity = vector(0, 1e6);
    if (l.type == Light::Type::camera) l.direction = {0, 0, 1};
    if (l.type == Light::Type::point || l.type == Light::Type::spot)
      l.position = vector(-1e30, 1e30);
    if (l.type == Light::Type::directional || l.type == Light::Type::spot)
      l.direction = vector(1e-3, 1e30);
    if (l.type == Light::Type::spot) {
      l.innerAngle = number(0, 30);
      l.outerAngle = number(31, 90);
    }
    return l;
  }

  std::mt19937 random_;
};

TEST(LookTexts, GoodOnesSetWhatTheyName) {
  std::set<std::string> seen;
  for (const Good& good : goodTexts()) {
    seen.insert(good.name);
    Look expected;
    good.change(expected);
    Look look;
    EXPECT_NO_THROW(look = with(good.name, good.text)) << good.name << " " << good.text;
    EXPECT_EQ(look, expected) << good.name << " " << good.text;
  }
  for (const Parameter& p : glint::lookParameters())
    EXPECT_TRUE(seen.contains(p.name)) << "no good text of --" << p.name << " is tried";
}

TEST(LookTexts, BadOnesAreRefusedByName) {
  for (const Parameter& p : glint::lookParameters())
    EXPECT_TRUE(badTexts().contains(p.name)) << "no bad text of --" << p.name << " is tried";
  for (const auto& [name, texts] : badTexts())
    for (const std::string& text : texts) {
      const std::string message = failure([&, &n = name] { with(n, text); });
      EXPECT_THAT(message, AllOf(StartsWith("--" + name), HasSubstr(": "), Not(HasSubstr("\n"))))
          << name << " '" << text << "'";
    }
}

TEST(LookTexts, EveryParameterTellsWhatItIs) {
  std::set<std::string> names;
  for (const Parameter& p : glint::lookParameters()) {
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
  EXPECT_THAT(failure([&] { parameter("light").read(look, "camera"); }), HasSubstr("128"));
}

TEST(LookTexts, HexColoursAreSrgb) {
  EXPECT_EQ(float(Look{}.backgroundColor.r), glint::decodeSrgb8(0x33));  // the default, #333333
  // IEC 61966-2-1: 0x80 = 128 / 255 is ((0.50196 + 0.055) / 1.055)^2.4; the table is float.
  const double expected = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);
  EXPECT_NEAR(with("background-color", "#800000").backgroundColor.r, expected, 3e-8);
  EXPECT_EQ(with("background-color", "#800000").backgroundColor.g, 0);
}

TEST(LookFiles, RoundTripEveryLook) {
  EXPECT_EQ(read(glint::saveLook(Look{})), Look{});
  RandomLooks looks(2);
  for (int i = 0; i < 300; ++i) {
    const Look look = looks.next();
    const std::string text = glint::saveLook(look);
    Look back;
    ASSERT_NO_THROW(back = read(text)) << text;
    ASSERT_EQ(back, look);
    ASSERT_EQ(glint::saveLook(back), text);
  }
}

TEST(LookFiles, RoundTripEveryGoodText) {
  for (const Good& good : goodTexts()) {
    const Look look = with(good.name, good.text);
    EXPECT_EQ(read(glint::saveLook(look)), look) << good.name << " " << good.text;
  }
}

// The example in the documentation.
TEST(LookFiles, ReadTheExample) {
  const Look look = read(R"({"glint-look": 1, "shading": "phong", "highlight": "exact",
      "camera-position": [0, 1, 4], "light": ["directional:1,1,1:1,1,1"],
      "resolution": [1024, 1024], "material": {"": {"exponent": 80},
      "Helmet": {"metalness": 1, "color": [0.8, 0.2, 0.1]}}})");
  EXPECT_EQ(look.cameraPosition, glm::dvec3(0, 1, 4));
  ASSERT_TRUE(look.light && look.light->size() == 1);
  EXPECT_EQ(look.light->front().direction, glm::dvec3(1));
  EXPECT_EQ(look.material.at("").exponent, 80);
  EXPECT_EQ(look.material.at("Helmet").color, glm::dvec3(0.8, 0.2, 0.1));
}

TEST(LookFiles, KeepWhatTheyDoNotName) {
  Look look;
  look.exposure = 2;
  look.light = {glint::test::directional({1, 0, 0})};
  glint::readLook(look, R"({"glint-look": 1, "blinn-factor": 2})", "a.json");
  EXPECT_EQ(look.exposure, 2);
  EXPECT_EQ(look.blinnFactor, 2);
  EXPECT_EQ(look.light->size(), 1u);
  glint::readLook(look, R"({"glint-look": 1, "light": []})", "a.json");
  EXPECT_TRUE(look.light && look.light->empty());  // no lights at all, not the default one
}

TEST(LookFiles, WrongOnesAreRefusedByFileAndKey) {
  const std::pair<const char*, const char*> files[] = {
      {"", "not a look file"},
      {"[]", "not a look file"},
      {"{", "not a look file"},
      {"{}", "glint-look"},
      {R"({"glint-look": 2})", "glint-look"},
      {R"({"glint-look": "1"})", "glint-look"},
      {R"({"glint-look": 1, "shadin": "flat"})", "unknown key \"shadin\""},
      {R"({"glint-look": 1, "shading": 1})", "shading"},
      {R"({"glint-look": 1, "shading": null})", "shading"},
      {R"({"glint-look": 1, "resolution": [1, "2"]})", "resolution"},
      {R"({"glint-look": 1, "resolution": [1, 2, 3]})", "resolution"},
      {R"({"glint-look": 1, "resolution": [1.5, 2]})", "resolution"},
      {R"({"glint-look": 1, "two-sided": 1})", "two-sided"},
      {R"({"glint-look": 1, "light": "camera"})", "light"},
      {R"({"glint-look": 1, "light": [1]})", "light"},
      {R"({"glint-look": 1, "material": []})", "material"},
      {R"({"glint-look": 1, "material": {"": {"shine": 1}}})", "shine"},
      {R"({"glint-look": 1, "material": {"a": {"color": [1, 2]}}})", "color"},
      {R"({"glint-look": 1, "material": {"a": 1}})", "material"},
      {R"({"glint-look": 1, "exposure": 18446744073709551615})", "exposure"},
      {R"({"glint-look": 1, "exposure": 1e999})", "a.json"},
      {R"({"glint-look": 1, "camera-index": 18446744073709551615})", "camera-index"},
      {R"({"glint-look": 1, "camera-view-up": [0, 0, 0]})", "camera-view-up"},
      {R"({"glint-look": 1, "camera-intrinsics": [9, 9, 5, 5], "camera-view-angle": 30})",
       "camera-view-angle"},
      {R"({"glint-look": 1, "camera-intrinsics": [9, 9, 5, 5], "camera-orthographic": true})",
       "camera-orthographic"},
  };
  for (const auto& [text, part] : files) {
    const std::string message = failure([&, t = text] { read(t); });
    EXPECT_THAT(message, AllOf(StartsWith("a.json: "), HasSubstr(part), Not(HasSubstr("\n"))))
        << text;
  }
}

TEST(MaterialEdits, NameBeatsAllBeatsModel) {
  glint::Material a = glint::test::materialOf(1, 0.8, 0.5, 20, 0.25);
  a.name = "a";
  Look look;
  EXPECT_EQ(glint::editedMaterial(a, look).shading.exponent, 20);
  parameter("material").read(look, "exponent=40,specular=0.1");
  parameter("material").read(look, "a:exponent=60");
  parameter("material").read(look, "b:exponent=80");
  const glint::ShadingParameters edited = glint::editedMaterial(a, look).shading;
  EXPECT_EQ(edited.exponent, 60);
  EXPECT_EQ(edited.specular, 0.1);
  EXPECT_EQ(edited.diffuse, 0.8);
  EXPECT_EQ(edited.metalness, 0.25);
  a.name.clear();
  EXPECT_EQ(glint::editedMaterial(a, look).shading.exponent, 40);
}

TEST(MaterialEdits, OfMaterialsThatDoNotExistAreRefused) {
  glint::Material a;
  a.name = "a";
  const glint::Scene scene = glint::test::sceneOf(glint::test::quad(), a);
  Look look = with("material", "a:exponent=1");
  EXPECT_NO_THROW(glint::checkMaterialNames(scene, look));
  look = with("material", "B:exponent=1");
  EXPECT_THAT(failure([&] { glint::checkMaterialNames(scene, look); }),
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
