#include "glint/options/parameters.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "glint/image/error.h"
#include "glint/options/parameter_kinds.h"
#include "glint/scene/look_text.h"

namespace glint {
namespace {

using namespace kinds;

Parameter lights() {
  Parameter p = custom(
      "light", "TYPE:...",
      "a light that replaces the model's lights and the default light; repeatable. "
      "directional:x,y,z[:r,g,b] (x,y,z points TO the light), point:x,y,z[:r,g,b], "
      "spot:x,y,z:dx,dy,dz:inner,outer[:r,g,b] (shines along d; angles in degrees), "
      "camera[@x,y,z][:r,g,b] (fixed to the eye; x,y,z points to the light in eye space, by "
      "default 0,0,1, along the view). Point and spot lights weaken with distance only if "
      ":falloff[,RANGE] is appended: with the square of the distance, the intensity being that "
      "at 1 world unit, and to 0 at RANGE",
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
  p.reset = [](Look& look) { look.light.reset(); };
  return p;
}

constexpr std::array<std::string_view, 6> upAxes = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

Parameter lightScale() {
  Parameter p = custom(
      "light-scale", "auto|FACTOR",
      "factor for the lights of the model file; auto chooses it from the model so that a white "
      "surface is not overexposed, whatever lux and candela the file gives [default: auto]",
      [](Look& look, const std::string& text) {
        look.lightScale.reset();
        if (text != "auto") look.lightScale = parseNumber(text, 0, 1e30, "--light-scale");
      },
      [](const Look& look) { return look.lightScale ? Json(*look.lightScale) : Json(); });
  p.reset = [](Look& look) { look.lightScale.reset(); };
  return p;
}

// The forms of the lobe in the syntax of --highlight.
std::string formNames() {
  std::string names;
  for (const HighlightRow& each : highlightRows())
    names += (names.empty() ? "" : ", ") + std::string(each.name) +
             (!each.hasGamma() ? ""
              : each.hasTable  ? ":N"
                               : ":G");
  return names;
}

Parameter highlight() {
  Parameter p = custom(
      "highlight", "FORM[/N,FORM...]",
      "how the specular lobe is computed: " + formNames() +
          " (G = 1, 2, 4, ... 64; N = 16, 32, ... 1024); exact is computed stably from the "
          "difference vector; pow is the textbook's pow(dot); integer computes whole exponents "
          "from 1 to 128 by squaring and others exactly; table interpolates linearly between N "
          "steps of the cosine; docs/approximations.md describes the others; exact/2,lyon:8 uses "
          "the first form for the two brightest lights and the second for the others",
      [](Look& look, const std::string& text) {
        look.highlight = parseHighlights(text, "--highlight");
      },
      [](const Look& look) { return Json(highlightText(look.highlight)); });
  finish(p, ParameterKind::choice, &Look::highlight);
  p.words = highlightTexts();
  return p;
}

Json materialEdits(const Look& look) {
  Json all = Json::object();
  for (const auto& [name, edit] : look.material) {
    Json one = Json::object();
    for (const auto& p : materialParameters())
      if (edit.*p.edit) one[std::string(p.name)] = *(edit.*p.edit);
    if (edit.color) one["color"] = toJson(*edit.color);
    if (edit.highlight) one["highlight"] = highlightText(*edit.highlight);
    if (edit.fresnel) one["fresnel"] = fresnelText(*edit.fresnel);
    for (const SwitchedTexture& t : switchedTextures())
      if (edit.*t.edit) one[std::string(t.name)] = *(edit.*t.edit);
    all[name] = one;
  }
  return all.empty() ? Json() : all;
}

Parameter materials() {
  std::string names;
  for (const MaterialParameter& each : materialParameters()) names += std::string(each.name) + ", ";
  Parameter p = custom(
      "material", "[NAME:|NAME#N:|#N:]key=value,...",
      "set parameters of every material, of those called NAME, of the N-th of these, or of the "
      "file's N-th (N from 0; put a name that contains = or ends in #N in quotation marks): " +
          names +
          "color; color-texture, normal-texture and emission-texture on or off; and the forms "
          "highlight and fresnel; with metalness 1 the highlight has the material's colour, as on "
          "real metals, with 0 it is white (the lecture notes' text says the opposite of their "
          "formula, which is used); repeatable",
      [](Look& look, const std::string& text) { parseMaterialEdit(look, text); }, materialEdits);
  p.repeatable = true;
  p.reset = [](Look& look) { look.material.clear(); };
  return p;
}

Parameter maxError() {
  const auto parse = [](const std::string& text) {
    try {
      return parseNumber(text.substr(0, text.size() - (text.ends_with("code") ? 4 : 0)), 0, 1e6,
                         "");
    } catch (const InputError&) {
      throw InputError("--max-error: '" + text + "' is not a number from 0 to 1e+06, nor Ncode");
    }
  };
  Parameter p = numbers<double>(
      ParameterKind::number, "max-error", "E|Ncode",
      "use the cheapest forms within this error: those of lobe and reflectance whose proven "
      "error for this scene is at most E in linear light, or with Ncode N codes of the 8-bit "
      "picture after exposure; the exact forms if no others are within it",
      0, 1e6, &Look::maxError, parse);
  p = then(std::move(p), [](Look& look) { look.maxErrorInCodes = false; });
  p.read = [read = p.read](Look& look, const std::string& text) {
    read(look, text);
    look.maxErrorInCodes = text.ends_with("code");
  };
  p.save = [save = p.save](const Look& look) {
    if (!look.maxErrorInCodes || !look.maxError) return save(look);
    return Json(save(look).dump() + "code");
  };
  p.reset = [](Look& look) { look.maxError.reset(), look.maxErrorInCodes = false; };
  return slider(std::move(p), 1e-5, 1, true);
}

Parameter intrinsics() {
  Parameter p = custom(
      "camera-intrinsics", "FX,FY,CX,CY",
      "lens of a calibrated camera, in pixels, instead of the view angle: focal lengths across "
      "and down, and the principal point from the picture's top left corner (the first pixel's "
      "centre is at 0.5,0.5; in OpenCV it is at 0,0, so add 0.5 to its CX and CY)",
      [](Look& look, const std::string& text) {
        look.cameraIntrinsics = parseIntrinsics(text);
        look.cameraViewAngle.reset();
        look.cameraOrthographic = false;
      },
      [](const Look& look) {
        if (!look.cameraIntrinsics) return Json();
        const glm::dvec4& v = *look.cameraIntrinsics;
        return Json::array({v.x, v.y, v.z, v.w});
      });
  return resetting(std::move(p), &Look::cameraIntrinsics);
}

// Called by parameters that replace a lens: whichever of the two is set last counts.
void dropIntrinsics(Look& look) { look.cameraIntrinsics.reset(); }

void dropIntrinsicsIfParallel(Look& look) {
  if (look.cameraOrthographic) dropIntrinsics(look);
}

constexpr std::array<std::string_view, 2> viewerNames{"local", "infinite"};

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
      {choice("shading", shadingTexts(), &Look::shading,
              "where light is computed: once per face, per vertex, or per pixel by Phong or "
              "Blinn-Phong; environment adds reflection and refraction to Blinn-Phong; auto is "
              "phong, or flat or gouraud where --max-error allows"),
       highlight(),
       choice("fresnel", fresnelTexts(), &Look::fresnel,
              "how the program environment computes the reflectance: exact (without "
              "cancellation), the textbook's equations, Schlick's approximation, the same with "
              "the power computed by exp2, or a rational function fitted to the index"),
       maxError(),
       text("cost-table", "FILE", &Look::costTable,
            "file with the cost of each form on a driver (from glint study --measure-costs); "
            "--max-error uses it instead of the table that ships with glint"),
       slider(number("blinn-factor", "FACTOR", 0, 1e3, &Look::blinnFactor,
                     "Blinn's exponent as a multiple of Phong's"),
              0, 16, false),
       choice("normalization", normalizationNames, &Look::normalization,
              "multiply each highlight so that it keeps its light when its exponent n changes; "
              "specular is then the share of light that it reflects; none is the lecture notes' "
              "formula, without a factor; simple is (n+2)/2 for Phong and (n+8)/8 for "
              "Blinn-Phong, meant for a highlight with N.L; exact is the factor with which the "
              "notes' formula reflects that share along the normal"),
       slider(number("schlick-exponent", "X", 0, 1e3, &Look::schlickExponent,
                     "exponent of Schlick's approximation"),
              0, 20, false),
       materials(),
       flag("two-sided", &Look::twoSided,
            "draw back faces too, with the normal turned to the viewer; otherwise only those of "
            "doubleSided materials are drawn")});
  section("Lights and environment",
          {color("ambient-light", &Look::ambientLight,
                 "light from all directions, added to all other lights"),
           lights(), flag("no-lights", &Look::noLights, "use ambient light only"), lightScale(),
           choice("viewer", viewerNames, &Look::viewer,
                  "direction to the viewer; local: from each point; infinite: one direction for "
                  "the whole picture"),
           slider(number("medium-ior", "N", 1e-3, 1e3, &Look::mediumIor,
                         "index of refraction of the medium around the viewer"),
                  1, 3, false, 1, "n1"),
           choice("environment", environmentTexts(), &Look::environment,
                  "what the program environment reflects and refracts"),
           text("hdri-file", "FILE", &Look::hdriFile,
                "an equirectangular picture instead of --environment, with -Z at its "
                "centre: Radiance .hdr, OpenEXR, PNG, JPEG or PFM"),
           slider(number("environment-rotation", "DEGREES", -1e6, 1e6, &Look::environmentRotation,
                         "turn the environment about +Y"),
                  -180, 180, false),
           flag("environment-background", &Look::environmentBackground,
                "show the environment behind the model")});
  section(
      "Camera",
      {vector("camera-position", 1e30, &Look::cameraPosition,
              "position of the camera [default: from the model's size]"),
       vector("camera-focal-point", 1e30, &Look::cameraFocalPoint,
              "the point that the camera looks at [default: the model's centre]"),
       direction("camera-view-up", &Look::cameraViewUp, "up direction [default: 0,1,0]"),
       then(slider(number("camera-view-angle", "DEGREES", smallestViewAngle, largestViewAngle,
                          &Look::cameraViewAngle, "vertical angle of view [default: 30]"),
                   1, 120, false, 30),
            dropIntrinsics),
       intrinsics(),
       direction("camera-direction", &Look::cameraDirection,
                 "direction in which the camera looks (unless position and focal point are given)"),
       slider(number("camera-azimuth-angle", "DEGREES", -1e6, 1e6, &Look::cameraAzimuthAngle,
                     "turn the placed camera about the focal point, to its right"),
              -180, 180, false),
       slider(number("camera-elevation-angle", "DEGREES", -1e6, 1e6, &Look::cameraElevationAngle,
                     "turn the placed camera about the focal point, upwards (after the azimuth)"),
              -90, 90, false),
       slider(number("camera-zoom-factor", "FACTOR", 1e-6, 1e6, &Look::cameraZoomFactor,
                     "how much of the picture the model's bounding sphere fills (unless "
                     "--camera-position is given)"),
              0.05, 20, true),
       then(flag("camera-orthographic", &Look::cameraOrthographic,
                 "parallel projection; half the picture's height is the distance to the focal "
                 "point times tan(view angle / 2)"),
            dropIntrinsicsIfParallel),
       resetting(
           custom(
               "camera-index", "N", "use the camera that has index N in the file, counted from 0",
               [](Look& look, const std::string& text) {
                 look.cameraIndex = int(parseInteger(text, 0, 1 << 30, "--camera-index"));
               },
               [](const Look& look) {
                 return look.cameraIndex ? Json(*look.cameraIndex) : Json();
               }),
           &Look::cameraIndex),
       resetting(
           custom(
               "clipping-range", "NEAR,FAR",
               "nearest and farthest distance along the view that is drawn [default: from the "
               "scene]",
               [](Look& look, const std::string& text) { look.clippingRange = parseRange(text); },
               [](const Look& look) {
                 return look.clippingRange
                            ? Json::array({look.clippingRange->x, look.clippingRange->y})
                            : Json();
               }),
           &Look::clippingRange)});
  section(
      "Animation",
      {slider(
           number("animation-time", "SECONDS", 0, 1e9, &Look::animationTime,
                  "time in the animation; after its end the last pose is kept [default: the file's "
                  "rest pose]"),
           0, 10, false),
       text("animation", "NAME|N|all", &Look::animation,
            "animation of the file, or all of them at once [default: the first]")});
  section("Model",
          {text("scene", "NAME|N", &Look::scene, "scene of the file [default: the file's own]"),
           text("variant", "NAME|N", &Look::variant,
                "material variant (KHR_materials_variants) [default: none]"),
           choice("up", std::span<const std::string_view>(upAxes), &Look::up,
                  "axis of the model that points up; its cameras and lights turn with it")});
  section(
      "Picture",
      {resetting(
           custom(
               "resolution", "W,H", "width and height in pixels",
               [](Look& look, const std::string& text) { look.resolution = parseResolution(text); },
               [](const Look& look) {
                 return Json::array({look.resolution.x, look.resolution.y});
               }),
           &Look::resolution),
       resetting(custom(
                     "anti-aliasing", "none|msaa:N|ssaa:N",
                     "samples per pixel, averaged in linear light; msaa: N coverage samples, "
                     "shaded once for each triangle; ssaa: N x N shaded samples",
                     [](Look& look, const std::string& text) {
                       look.antiAliasing = parseAntiAliasing(text);
                     },
                     [](const Look& look) { return Json(antiAliasingText(look.antiAliasing)); }),
                 &Look::antiAliasing),
       switchable(
           choice("specular-antialiasing", specularAntialiasingNames, &Look::specularAntialiasing,
                  "widen highlights that are narrower than a pixel, so that they do not flicker; "
                  "they are dimmed so that their total light stays the same. Without a value, or "
                  "with =kaplanyan, by how much the normals of neighbouring pixels differ; with "
                  "=toksvig, by how much detail of the normal map is lost in its smaller levels; "
                  "with =none, not at all. For programs that shade pixels"),
           "none", "kaplanyan"),
       color("background-color", &Look::backgroundColor, "colour behind the model"),
       flag("no-background", &Look::noBackground, "make the background transparent"),
       slider(number("exposure", "EV", -64, 64, &Look::exposure,
                     "multiply the picture by 2^EV before it is encoded"),
              -8, 8, false)});
  return table;
}

}  // namespace

std::span<const Parameter> lookParameters() {
  static const std::vector<Parameter> table = makeTable();
  return table;
}

void setParameter(Look& look, std::string_view name, const std::string& text) {
  for (const Parameter& p : lookParameters())
    if (p.name == name) return p.read(look, text);
  throw InputError("a look has no option '" + std::string(name) + "': see glint render --help");
}

std::vector<std::string> Parameter::choices() const {
  if (!words.empty()) return words;
  std::vector<std::string> parts(1);
  for (char c : value) {
    if (c == '|')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

}  // namespace glint
