#include "glint/render/composition.h"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "glint/render/features.h"
#include "glint/scene/look_text.h"
#include "glint/shading/pbr_conversion.h"
#include "glint/shading/specular_filter.h"

namespace glint {
namespace {

std::string header(bool fileNames) {
  return fileNames ? "#version 330 core\n#extension GL_ARB_shading_language_include : enable\n"
                   : "#version 330 core\n";
}

// Keeps the shading point of a partly covered pixel inside the triangle; comes right after the
// header.
std::string multisampleText(bool multisampled) {
  if (!multisampled) return "#define SHADES_AT_OFFSET 0\n#define VARYING\n";
  return R"(#ifdef GL_ARB_gpu_shader5
#extension GL_ARB_gpu_shader5 : require
#define SHADES_AT_OFFSET 1
#define VARYING
#else
#define SHADES_AT_OFFSET 0
#define VARYING centroid
#endif
)";
}

std::string define(std::string_view name, int value) {
  return "#define " + std::string(name) + " " + std::to_string(value) + "\n";
}

// With a decimal point, as GLSL floats need.
std::string realText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%#.9g", value);
  return text;
}

std::string stageDefines(bool vertex) {
  return define("VERTEX_STAGE", vertex) + "#define VERTEX_OUT " + (vertex ? "out" : "in") + "\n";
}

std::string environmentDefines(Environment environment) {
  return define("ENVIRONMENT_STUDIO", 0) + define("ENVIRONMENT_SKY", 1) +
         define("ENVIRONMENT_WHITE", 2) + define("ENVIRONMENT_IMAGE", 3) +
         define("ENVIRONMENT_MAP", int(environment));
}

bool isPerVertex(const Variant& v) { return !v.unlit && !isPerPixel(v.program); }

// Whether the fragment stage reads textures.
bool readsTextures(const Variant& v) {
  return v.colorTexture || v.emissionTexture || v.normalTexture ||
         (v.textured != 0 && !isPerVertex(v));
}

// The coordinates of a parameter texture, in the stage that reads it.
std::string placeText(const Variant& v, std::size_t texture) {
  const int place = v.parameterPlaces[texture];
  if (place < 0) return "vColorTexcoord";
  return std::string(isPerVertex(v) ? "parameterTexcoords[" : "vParameterTexcoords[") +
         std::to_string(place) + "]";
}

std::string parameterDefines(const Variant& v) {
  constexpr std::pair<const char*, unsigned> parameters[] = {
      {"AMBIENT", textured::ambient},     {"DIFFUSE", textured::diffuse},
      {"SPECULAR", textured::specular},   {"EXPONENT", textured::exponent},
      {"METALNESS", textured::metalness}, {"TRANSMISSION", textured::transmission}};
  std::string text = define("PER_PIXEL", !isPerVertex(v));
  text += define("PARAMETER_TEXTURES", v.textured != 0);
  for (const auto& [name, bit] : parameters)
    text += define((std::string("TEXTURED_") + name).c_str(), (v.textured & bit) != 0);
  constexpr const char* names[] = {"METALLIC_ROUGHNESS", "OCCLUSION", "SPECULAR", "TRANSMISSION"};
  for (std::size_t i = 0; i < 4; ++i)
    text += std::string("#define ") + names[i] + "_PLACE " + placeText(v, i) + "\n";
  if (v.textured == 0) return text;
  if (v.normalized)
    text += "#define NORMALIZATION(n) " +
            std::string(normalizationGlsl(v.normalization, usesBlinn(v.program))) + "(n)\n";
  return text + "#define METAL_DIFFUSE " + realText(metalDiffuse) +
         "\n#define SMALLEST_ROUGHNESS " + realText(smallestRoughness) + "\n";
}

// A Rule of texture.glsl.
std::string ruleText(const Sampler& s, bool isData) {
  const auto number = [](auto value) { return std::to_string(int(value)); };
  const auto truth = [](bool value) { return value ? "true" : "false"; };
  return "Rule(" + number(s.wrapS) + ", " + number(s.wrapT) + ", " +
         truth(s.magnify == Filter::linear) + ", " + truth(s.minify == Filter::linear) + ", " +
         number(s.mip) + ", " + truth(isData) + ")";
}

std::string textureDefines(const Variant& v) {
  constexpr const char* names[] = {"COLOR",     "EMISSION", "NORMAL",      "METALLIC_ROUGHNESS",
                                   "OCCLUSION", "SPECULAR", "TRANSMISSION"};
  constexpr std::size_t coded = 2;  // the first ones: the others hold numbers
  std::string text = define("CODED_TEXTURES", v.colorTexture || v.emissionTexture);
  for (std::size_t i = 0; i < std::size(names); ++i) {
    Sampler sampler = v.samplers[i];
    // Vertices and faces read the full-size level.
    if (i > 2 && isPerVertex(v)) sampler.mip = MipFilter::none;
    text += std::string("#define ") + names[i] + "_RULE " + ruleText(sampler, i >= coded) + "\n";
  }
  return text;
}

std::string defines(const Variant& v) {
  std::string text;
  for (const Feature& feature : features()) text += define(feature.define, feature.value(v));
  const bool textures = readsTextures(v);
  const bool image =
      !v.unlit && v.program == Shading::environment && v.environment == Environment::image;
  text += define("TEXTURES", textures);
  if (textures || v.textured != 0) text += textureDefines(v);
  text += define("LEVELS_OF_DETAIL", textures || image || v.specularAntialiasing);
  constexpr const char* outputs[] = {"RADIANCE", "POSITION",   "NORMAL",         "COLOR",
                                     "EMISSION", "DEPTH",      "SHADING_NORMAL", "IDS",
                                     "SUM",      "REFLECTION", "REFRACTION"};
  int number = 0;
  for (const char* output : outputs)
    text += std::string("#define OUTPUT_") + output + " " + std::to_string(number++) + "\n";
  text += define("OUTPUT", int(v.output));
  text += parameterDefines(v);
  const int lights = v.directionalLights + v.pointLights + v.spotLights;
  text += define("LIGHTS", lights);
  text += define("LOBE_FORMS", lights > 0 ? int(v.dimmer.size()) + 1 : 0);
  if (const int rows = lobeTableRows(v)) text += define("LOBE_TABLES", rows);
  text += define("BLINN", usesBlinn(v.program));
  const bool perFace = v.program == Shading::flat;
  text += std::string("#define CARRIED ") + (perFace ? "flat" : "VARYING") + "\n";
  text += std::string("#define CARRIED_AT(varying) ") +
          (perFace ? "varying" : "AT_PLACE(varying)") + "\n";
  if (!v.unlit && v.program == Shading::environment) text += environmentDefines(v.environment);
  return text;
}

// What a form reads in place of an exponent that varies: its row's shape(), which is linear in the
// exponent.
std::string shapeText(const HighlightRow& form, int gamma) {
  const glm::dvec2 at0 = form.shape(0, gamma), slope = form.shape(1, gamma) - at0;
  return "(vec2(" + realText(slope.x) + ", " + realText(slope.y) + ") * p.exponent + vec2(" +
         realText(at0.x) + ", " + realText(at0.y) + "))";
}

// The #defines that lights.glsl is composed with, for each form of the highlight.
std::vector<std::string> lobeDefines(const Variant& v) {
  std::vector<Variant::Dimmer> forms{{v.highlight, 0, 0, 0}};
  forms.insert(forms.end(), v.dimmer.begin(), v.dimmer.end());
  forms.push_back({{}, v.directionalLights, v.pointLights, v.spotLights});
  constexpr const char* shapes[] = {"material.lobe", "material.secondLobe", "material.thirdLobe",
                                    "material.fourthLobe"};
  const bool varies = (v.textured & textured::exponent) != 0 || v.specularAntialiasing;
  std::vector<std::string> texts;
  int table = 0;
  for (std::size_t i = 0; i + 1 < forms.size(); ++i) {
    const Variant::Dimmer &from = forms[i], &end = forms[i + 1];
    std::string text;
    const auto set = [&](const char* name, const std::string& value) {
      if (i > 0) text += std::string("#undef ") + name + "\n";
      text += std::string("#define ") + name + " " + value + "\n";
    };
    const auto range = [&](const char* type, int first, int begin, int stop) {
      set((std::string(type) + "_FROM").c_str(), std::to_string(first + begin));
      set((std::string(type) + "_END").c_str(), std::to_string(first + stop));
    };
    const std::string number = std::to_string(i);
    const HighlightRow& form = row(from.form.form);
    const bool lobe = v.specular && !form.glsl.empty();
    set("ADD_LIGHTS", "addLights" + number);
    set("ADD_LIGHT", "addLight" + number);
    set("LOBE_OF", "lobeOf" + number);
    set("LOBE", std::to_string(int(lobe)));
    set("LOBE_TAKES_COSINE", std::to_string(int(form.takesCosine)));
    set("LOBE_SHAPE", !lobe         ? "vec2(0.0)"
                      : !form.shape ? "vec2(p.exponent)"
                      : varies      ? shapeText(form, from.form.gamma)
                                    : shapes[i]);
    set("LOBE_EVEN", lobe && !form.atZero && varies ? "!(p.exponent > 0.0)" : "false");
    set("POWER", std::to_string(from.form.gamma));
    set("TABLE", std::to_string(table));
    if (lobe) table += lobeTableRows(from.form);
    range("DIRECTIONAL", 0, from.directional, end.directional);
    range("POINT", v.directionalLights, from.point, end.point);
    range("SPOT", v.directionalLights + v.pointLights, from.spot, end.spot);
    if (lobe)
      text += "float lobeOf" + number + "(float x, vec2 shape) { return " + std::string(form.glsl) +
              "; }\n";
    texts.push_back(std::move(text));
  }
  return texts;
}

// The reflectance in the variant's form, for environment.glsl.
std::string reflectanceFunction(const Variant& v) {
  if (v.program != Shading::environment || !v.dielectric) return {};
  const std::string form(v.schlickFifth
                             ? "fresnelSchlickFifth(cosine, boundary, material.normalReflectance)"
                             : row(v.fresnel).glsl);
  return "float reflectance(float cosine, Boundary boundary) { return " + form + "; }\n";
}

std::string filterDefines(const Variant& v) {
  return "#define PIXEL_VARIANCE " + realText(pixelVariance) + "\n#define LARGEST_WIDENING " +
         realText(largestWidening) + "\n#define EXPONENTS_PER_BLINN " +
         (usesBlinn(v.program) ? "1.0" : "4.0") + "\n";
}

// A file and the #defines before it.
struct Part {
  std::string file, defines = {};
};

std::string join(const std::string& head, const std::vector<Part>& parts,
                 const GlslSources& sources, bool fileNames) {
  std::string text = head;
  int number = 0;
  for (const auto& [file, defines] : parts) {
    text +=
        defines + "#line 1 " + (fileNames ? "\"" + file + "\"" : std::to_string(++number)) + "\n";
    text += sources.text(file);
  }
  return text;
}

}  // namespace

ComposedProgram compose(const Variant& v, const GlslSources& sources, bool fileNames,
                        int instances) {
  const std::string name(v.unlit ? "unlit" : shadingName(v.program));
  std::vector<Part> files{{"vector.glsl"}, {"blocks.glsl"}};
  if (!v.unlit) {
    if (v.specular) files.insert(files.begin() + 1, {"lobe.glsl"});
    if (lobeTableRows(v) > 0) files.insert(files.begin() + 1, {"lobe_table.glsl"});
    if (v.normalized) files.insert(files.begin() + 1, {"normalization.glsl"});
    if (v.program == Shading::environment)
      files.insert(files.end(), {{"fresnel.glsl"}, {"environment_map.glsl"}});
    files.insert(files.end(), {{"parameters.glsl"}, {"light_sum.glsl"}});
    if (v.directionalLights + v.pointLights + v.spotLights > 0)
      for (const std::string& defines : lobeDefines(v)) files.push_back({"lights.glsl", defines});
    files.insert(files.end(),
                 {{"sum.glsl"}, {isPerVertex(v) ? "per_vertex.glsl" : "per_pixel.glsl"}});
    if (v.specularAntialiasing) files.push_back({"specular_filter.glsl", filterDefines(v)});
    std::string file = name + ".glsl";  // Mesa's #line takes no '-' in names
    std::replace(file.begin(), file.end(), '-', '_');
    files.push_back({file, reflectanceFunction(v)});
  }
  const std::string head = header(fileNames) + multisampleText(v.multisampled);
  const std::string features = define("INSTANCES", instances) + defines(v);
  std::vector<Part> vertex = files, fragment = files;
  const auto blocks = std::ranges::find(fragment, "blocks.glsl", &Part::file);
  fragment.insert(blocks + 1, {"sampling.glsl"});
  if (readsTextures(v)) fragment.insert(fragment.begin() + 1, {"texture.glsl"});
  if (v.textured != 0 && isPerVertex(v)) vertex.insert(vertex.begin() + 1, {"texture.glsl"});
  vertex.push_back({"vertex.glsl"});
  fragment.push_back({"fragment.glsl"});
  if (v.textured != 0) (isPerVertex(v) ? vertex : fragment).push_back({"parameter_textures.glsl"});
  return {name, join(head + stageDefines(true) + features, vertex, sources, fileNames),
          join(head + stageDefines(false) + features, fragment, sources, fileNames)};
}

ComposedProgram composeBackground(Environment environment, const GlslSources& sources,
                                  bool fileNames) {
  const std::vector<Part> vertex{{"vector.glsl"}, {"blocks.glsl"}, {"background.glsl"}};
  const std::vector<Part> fragment{{"vector.glsl"},
                                   {"blocks.glsl"},
                                   {"sampling.glsl"},
                                   {"environment_map.glsl"},
                                   {"background.glsl"}};
  // The background covers every sample.
  const std::string head = header(fileNames) + multisampleText(false);
  const std::string features = define("INSTANCES", 1) + define("LIGHTS", 0) +
                               define("TEXTURES", 0) +
                               define("LEVELS_OF_DETAIL", environment == Environment::image) +
                               environmentDefines(environment);
  return {"background", join(head + stageDefines(true) + features, vertex, sources, fileNames),
          join(head + stageDefines(false) + features, fragment, sources, fileNames)};
}

ComposedProgram composeLayer(bool multisampled, bool reversedDepth, const GlslSources& sources,
                             bool fileNames) {
  const std::vector<Part> files{{"blocks.glsl"}, {"layer.glsl"}};
  const std::string features = define("INSTANCES", 1) + define("LIGHTS", 0) +
                               define("MULTISAMPLED", multisampled) +
                               define("REVERSED_DEPTH", reversedDepth);
  const std::string head = header(fileNames);
  const std::string samples =
      multisampled ? "#extension GL_ARB_sample_shading : require\n" : std::string();
  return {"layer", join(head + stageDefines(true) + features, files, sources, fileNames),
          join(head + samples + stageDefines(false) + features, files, sources, fileNames)};
}

}  // namespace glint
