#include "glint/scene/parameters.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "glint/image/error.h"
#include "look_text.h"

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

// The kinds of parameters. Each takes the member of Look that it reads and saves.

Parameter number(std::string name, std::string unit, double min, double max, double Look::*member,
                 std::string help) {
  auto read = [=](Look& look, const std::string& text) {
    look.*member = parseNumber(text, min, max, "--" + name);
  };
  return {name, {},    unit,
          help, false, min,
          max,  read,  [=](const Look& look) { return Json(look.*member); }};
}

Parameter number(std::string name, std::string unit, double min, double max,
                 std::optional<double> Look::*member, std::string help) {
  auto read = [=](Look& look, const std::string& text) {
    look.*member = parseNumber(text, min, max, "--" + name);
  };
  return {
      name, {},    unit,
      help, false, min,
      max,  read,  [=](const Look& look) { return look.*member ? Json(*(look.*member)) : Json(); }};
}

Parameter flag(std::string name, bool Look::*member, std::string help) {
  auto read = [=](Look& look, const std::string& text) {
    if (text != "true" && text != "false")
      throw InputError("--" + name + ": '" + text + "' is not true or false");
    look.*member = text == "true";
  };
  return {
      name, {}, {}, help, false, 0, 0, read, [=](const Look& look) { return Json(look.*member); }};
}

template <typename Enum, std::size_t n>
Parameter choice(std::string name, const std::array<std::string_view, n>& names, Enum Look::*member,
                 std::string help) {
  std::string value;
  for (const auto& each : names) value += (value.empty() ? "" : "|") + std::string(each);
  auto read = [=](Look& look, const std::string& text) {
    look.*member = Enum(parseChoice(text, names, "--" + name));
  };
  return {name, {},    value,
          help, false, 0,
          0,    read,  [=](const Look& look) {
            return Json(names[std::size_t(look.*member)]); }};
}

Parameter vector(std::string name, double limit, std::optional<glm::dvec3> Look::*member,
                 std::string help) {
  auto read = [=](Look& look, const std::string& text) {
    look.*member = parseVector(text, -limit, limit, "--" + name);
  };
  return {name,
          {},
          "x,y,z",
          help,
          false,
          -limit,
          limit,
          read,
          [=](const Look& look) {
            return look.*member ? toJson(*(look.*member)) : Json(); }};
}

Parameter direction(std::string name, std::optional<glm::dvec3> Look::*member, std::string help) {
  Parameter p = vector(std::move(name), 1e6, member, std::move(help));
  p.read = [read = p.read, name = p.name, member](Look& look, const std::string& text) {
    read(look, text);
    if (*(look.*member) == glm::dvec3(0.0))
      throw InputError("--" + name + ": '" + text + "' has no direction: give another than 0,0,0");
  };
  return p;
}

Parameter color(std::string name, glm::dvec3 Look::*member, std::string help) {
  auto read = [=](Look& look, const std::string& text) {
    look.*member = parseColor(text, "--" + name);
  };
  return {name, {},    "r,g,b|#rrggbb",
          help, false, 0,
          1e6,  read,  [=](const Look& look) { return toJson(look.*member); }};
}

Parameter custom(std::string name, std::string value, std::string help,
                 std::function<void(Look&, const std::string&)> read,
                 std::function<Json(const Look&)> save) {
  return {name, {}, value, help, false, 0, 0, std::move(read), std::move(save)};
}

Parameter lights() {
  Parameter p = custom(
      "light", "TYPE:...",
      "a light; repeatable; replaces the default one. directional:x,y,z[:r,g,b] (x,y,z points TO "
      "the light), point:x,y,z[:r,g,b] (constant intensity), spot:x,y,z:dx,dy,dz:inner,outer"
      "[:r,g,b] (shines along d; degrees), camera[:r,g,b] (shines along the view)",
      [](Look& look, const std::string& text) {
        const Light light = parseLight(text);
        if (!look.light) look.light.emplace();
        if (look.light->size() == maxLights)
          throw InputError("--light: more than " + std::to_string(maxLights) +
                           " lights: give fewer");
        look.light->push_back(light);
      },
      [](const Look& look) {
        if (!look.light) return Json();
        Json list = Json::array();
        for (const Light& light : *look.light) list.push_back(lightText(light));
        return list;
      });
  p.repeatable = true;
  return p;
}

Json materialEdits(const Look& look) {
  Json all = Json::object();
  for (const auto& [name, edit] : look.material) {
    Json one = Json::object();
    for (const auto& p : materialParameters())
      if (edit.*p.edit) one[std::string(p.name)] = *(edit.*p.edit);
    if (edit.color) one["color"] = toJson(*edit.color);
    all[name] = one;
  }
  return all.empty() ? Json() : all;
}

Parameter materials() {
  Parameter p = custom(
      "material", "[NAME:]key=value,...",
      "sets parameters of every material, or of NAME: ambient, diffuse, specular, exponent, "
      "metalness (1: highlight in the material's colour, as real metals have it; 0: white; "
      "the notes' words say the opposite of their formula, which stands here), ior, color; "
      "repeatable",
      [](Look& look, const std::string& text) { parseMaterialEdit(look, text); }, materialEdits);
  p.repeatable = true;
  return p;
}

constexpr std::array<std::string_view, 5> shadingNames{"flat", "gouraud", "phong", "blinn-phong",
                                                       "environment"};
constexpr std::array<std::string_view, 2> highlightNames{"exact", "pow"};
constexpr std::array<std::string_view, 3> fresnelNames{"exact", "textbook", "schlick"};
constexpr std::array<std::string_view, 2> viewerNames{"local", "infinite"};
constexpr std::array<std::string_view, 3> environmentNames{"studio", "sky", "white"};

std::vector<Parameter> makeTable() {
  std::vector<Parameter> table;
  auto section = [&](const char* name, std::vector<Parameter> parameters) {
    for (Parameter& p : parameters) {
      p.section = name;
      table.push_back(std::move(p));
    }
  };
  section(
      "Shading",
      {choice("shading", shadingNames, &Look::shading,
              "what is computed where: once per face, per vertex, or per pixel by Phong or "
              "Blinn-Phong; environment adds reflection and refraction to Blinn-Phong"),
       choice("highlight", highlightNames, &Look::highlight,
              "form of the lobe: exact, from the difference vector (stable), or the textbook's "
              "pow(dot)"),
       choice("fresnel", fresnelNames, &Look::fresnel,
              "form of the reflectance in environment: exact without cancellation, the textbook's, "
              "or Schlick's approximation"),
       number("blinn-factor", "FACTOR", 0, 1e3, &Look::blinnFactor,
              "Blinn's exponent as a multiple of Phong's"),
       number("schlick-exponent", "X", 0, 1e3, &Look::schlickExponent,
              "exponent of Schlick's approximation"),
       materials(),
       flag("two-sided", &Look::twoSided,
            "draw the back faces of every material, lit by the normal turned to the viewer; "
            "otherwise only those of doubleSided materials")});
  section("Lights and environment",
          {color("ambient-light", &Look::ambientLight,
                 "light from everywhere, whatever lights there are"),
           lights(), flag("no-lights", &Look::noLights, "ambient light alone"),
           choice("viewer", viewerNames, &Look::viewer,
                  "infinite: one direction to the viewer for the whole picture, as in the notes"),
           number("medium-ior", "N", 1e-3, 1e3, &Look::mediumIor,
                  "index of refraction of what the viewer is in (the notes' n1)"),
           choice("environment", environmentNames, &Look::environment,
                  "what the program environment reflects and refracts"),
           number("environment-rotation", "DEGREES", -1e6, 1e6, &Look::environmentRotation,
                  "turns the environment about +Y"),
           flag("environment-background", &Look::environmentBackground,
                "show the environment behind the model")});
  section(
      "Camera",
      {vector("camera-position", 1e30, &Look::cameraPosition, "where the eye is"),
       vector("camera-focal-point", 1e30, &Look::cameraFocalPoint, "what the camera looks at"),
       direction("camera-view-up", &Look::cameraViewUp, "which way is up; +Y unless given"),
       number("camera-view-angle", "DEGREES", 1e-5, 179.9, &Look::cameraViewAngle,
              "vertical; 30 unless given"),
       direction("camera-direction", &Look::cameraDirection,
                 "the way the camera looks, if not given by position and focal point"),
       number("camera-azimuth-angle", "DEGREES", -1e6, 1e6, &Look::cameraAzimuthAngle,
              "then turns the camera about the focal point, to its right"),
       number("camera-elevation-angle", "DEGREES", -1e6, 1e6, &Look::cameraElevationAngle,
              "then turns the camera about the focal point, upwards"),
       number("camera-zoom-factor", "FACTOR", 1e-6, 1e6, &Look::cameraZoomFactor,
              "share of the picture that the model's bounding sphere fills, where the camera's "
              "position is not given"),
       flag("camera-orthographic", &Look::cameraOrthographic,
            "parallel projection; the picture's half height is the distance to the focal point "
            "times tan(view angle / 2)"),
       custom(
           "camera-index", "N", "use camera N of the file, from 0",
           [](Look& look, const std::string& text) {
             look.cameraIndex = int(parseInteger(text, 0, 1 << 30, "--camera-index"));
           },
           [](const Look& look) { return look.cameraIndex ? Json(*look.cameraIndex) : Json(); }),
       custom(
           "clipping-range", "NEAR,FAR",
           "distances along the view between which things are drawn; from the scene unless given",
           [](Look& look, const std::string& text) { look.clippingRange = parseRange(text); },
           [](const Look& look) {
             return look.clippingRange ? Json::array({look.clippingRange->x, look.clippingRange->y})
                                       : Json();
           })});
  section(
      "Picture",
      {custom(
           "resolution", "W,H", "width and height in pixels",
           [](Look& look, const std::string& text) { look.resolution = parseResolution(text); },
           [](const Look& look) {
             return Json::array({look.resolution.x, look.resolution.y});
           }),
       custom(
           "anti-aliasing", "none|msaa:N|ssaa:N",
           "msaa: N samples of coverage a pixel; ssaa: N x N pixels shaded for each of the "
           "picture's; resolved in linear light",
           [](Look& look, const std::string& text) { look.antiAliasing = parseAntiAliasing(text); },
           [](const Look& look) { return Json(antiAliasingText(look.antiAliasing)); }),
       color("background-color", &Look::backgroundColor, "behind the model"),
       flag("no-background", &Look::noBackground, "transparent instead"),
       number("exposure", "EV", -64, 64, &Look::exposure,
              "multiplies the picture by 2^EV before it is encoded")});
  return table;
}

}  // namespace

std::span<const Parameter> lookParameters() {
  static const std::vector<Parameter> table = makeTable();
  return table;
}

std::span<const MaterialParameter> materialParameters() {
  using P = ShadingParameters;
  using E = MaterialEdit;
  static const MaterialParameter table[] = {
      {"ambient", "m_a: share of the ambient light", 0, 1e6, &P::ambient, &E::ambient},
      {"diffuse", "m_d: strength of diffuse reflection", 0, 1e6, &P::diffuse, &E::diffuse},
      {"specular", "m_s: strength of the highlight", 0, 1e6, &P::specular, &E::specular},
      {"exponent", "m_sp: Phong's exponent", 0, 1e6, &P::exponent, &E::exponent},
      {"metalness", "m_sm: 1 colours the highlight, 0 leaves it white", 0, 1, &P::metalness,
       &E::metalness},
      {"ior", "n: index of refraction", 1e-3, 1e3, &P::ior, &E::ior},
  };
  return table;
}

Material editedMaterial(const Material& material, const Look& look) {
  Material edited = material;
  for (const std::string& name : {std::string(), material.name}) {
    const auto found = look.material.find(name);
    if (found == look.material.end()) continue;
    const MaterialEdit& edit = found->second;
    for (const auto& p : materialParameters())
      if (edit.*p.edit) edited.shading.*p.value = *(edit.*p.edit);
    if (edit.color) edited.shading.color = *edit.color;
  }
  return edited;
}

void checkMaterialNames(const Scene& scene, const Look& look) {
  for (const auto& [name, edit] : look.material) {
    const auto has = [&](const Material& m) { return m.name == name; };
    if (name.empty() || std::any_of(scene.materials.begin(), scene.materials.end(), has)) continue;
    std::string names;
    for (const Material& m : scene.materials)
      if (!m.name.empty()) names += (names.empty() ? "'" : ", '") + m.name + "'";
    throw InputError(
        "--material: " + scene.name + " has no material '" + name + "': " +
        (names.empty() ? "its materials have no names: leave NAME: out" : "use one of " + names));
  }
}

}  // namespace glint
