#include "glint/render/composition.h"
#include "glint/scene/look_text.h"

#include <algorithm>
#include <vector>

namespace glint {
namespace {

std::string header(bool fileNames) {
  return fileNames ? "#version 330 core\n#extension GL_ARB_shading_language_include : enable\n"
                   : "#version 330 core\n";
}

// What shades a pixel that is partly covered without leaving the triangle; before everything else.
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

std::string define(const char* name, int value) {
  return std::string("#define ") + name + " " + std::to_string(value) + "\n";
}

std::string stageDefines(bool vertex) {
  return define("VERTEX_STAGE", vertex) + "#define VERTEX_OUT " + (vertex ? "out" : "in") + "\n";
}

std::string environmentDefines(Environment environment) {
  return define("ENVIRONMENT_STUDIO", 0) + define("ENVIRONMENT_SKY", 1) +
         define("ENVIRONMENT_WHITE", 2) + define("ENVIRONMENT_IMAGE", 3) +
         define("ENVIRONMENT_MAP", int(environment));
}

std::string defines(const Variant& v) {
  std::string text;
  text += define("UNLIT", v.unlit);
  text += define("VERTEX_COLORS", v.vertexColors);
  text += define("COLOR_TEXTURE", v.colorTexture);
  text += define("ALPHA_MASK", v.alphaMask);
  text += define("ALPHA_BLEND", v.alphaBlend);
  text += define("EMISSION", v.emission);
  text += define("EMISSION_TEXTURE", v.emissionTexture);
  text += define("TEXTURES", v.colorTexture || v.emissionTexture || v.normalTexture);
  const bool image = v.program == Shading::environment && v.environment == Environment::image;
  text += define("LEVELS_OF_DETAIL",
                 v.colorTexture || v.emissionTexture || v.normalTexture || (image && !v.unlit));
  constexpr const char* outputs[] = {"RADIANCE",   "POSITION",  "NORMAL",         "COLOR",
                                     "EMISSION",   "DEPTH",     "SHADING_NORMAL", "SUM",
                                     "REFLECTION", "REFRACTION"};
  int number = 0;
  for (const char* output : outputs)
    text += std::string("#define OUTPUT_") + output + " " + std::to_string(number++) + "\n";
  text += define("OUTPUT", int(v.output));
  if (v.unlit)
    return text + define("LIGHTS", 0) + define("OPAQUE_OUTPUT", 0) + define("NORMAL_TEXTURE", 0);
  const int lights = v.directionalLights + v.pointLights + v.spotLights;
  text += define("LIGHTS", lights);
  text += define("DIRECTIONAL_LIGHTS", v.directionalLights);
  text += define("POINT_LIGHTS", v.pointLights);
  text += define("SPOT_LIGHTS", v.spotLights);
  text += define("LIGHT_FALLOFF", v.lightFalloff);
  text += define("DIFFUSE", v.diffuse);
  text += define("SPECULAR", v.specular);
  constexpr const char* lobes[] = {"EXACT",      "POW",  "INTEGER",  "LYON", "LYON_TUNED",
                                   "LYON_CROSS", "PADE", "GAUSSIAN", "NONE"};
  int form = 0;
  for (const char* lobe : lobes) text += define((std::string("HIGHLIGHT_") + lobe).c_str(), form++);
  text += define("LOBE_FORMS", lights > 0 ? int(v.dimmer.size()) + 1 : 0);
  text += define("BLINN", v.program == Shading::blinnPhong || v.program == Shading::environment);
  text += define("CONSTANT_VIEW", v.constantView);
  text += define("UNEVEN_SCALE", v.unevenScale);
  text += define("PIXEL_POSITION", v.pixelPosition);
  text += define("VANISHING_NORMAL", v.vanishingNormal);
  text += define("NORMAL_TEXTURE", v.normalTexture);
  text += define("TWO_SIDED", v.twoSided);
  const bool perFace = v.program == Shading::flat;
  text += std::string("#define CARRIED ") + (perFace ? "flat" : "VARYING") + "\n";
  text += std::string("#define CARRIED_AT(varying) ") +
          (perFace ? "varying" : "AT_PLACE(varying)") + "\n";
  // What environment sees through a surface is refracted, not blended.
  text += define("OPAQUE_OUTPUT", v.program == Shading::environment);
  if (v.program == Shading::environment) {
    text += environmentDefines(v.environment);
    constexpr const char* forms[] = {"EXACT", "TEXTBOOK", "SCHLICK", "SCHLICK_EXP2", "RATIONAL"};
    for (int i = 0; i < 5; ++i) text += define((std::string("FRESNEL_") + forms[i]).c_str(), i);
    text += define("FRESNEL", int(v.fresnel));
    text += define("SCHLICK_FIFTH", v.schlickFifth);
    text += define("DENSER_SIDE", v.denserSide);
    text += define("DIELECTRIC", v.dielectric);
    text += define("METAL", v.metal);
    text += define("REFRACTION", v.refraction);
  }
  return text;
}

// What lights.glsl is composed with for each form of the highlight.
std::vector<std::string> lobeDefines(const Variant& v) {
  std::vector<Variant::Dimmer> forms{{v.highlight, 0, 0, 0}};
  forms.insert(forms.end(), v.dimmer.begin(), v.dimmer.end());
  forms.push_back({{}, v.directionalLights, v.pointLights, v.spotLights});
  constexpr const char* shapes[] = {"material.lobe.xy", "material.lobe.zw",
                                    "material.dimmerLobe.xy", "material.dimmerLobe.zw"};
  std::vector<std::string> texts;
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
    const Highlight form = from.form.form;
    const bool lobe = v.specular && form != Highlight::none;
    set("ADD_LIGHTS", "addLights" + number);
    set("ADD_LIGHT", "addLight" + number);
    set("LOBE_OF", "lobeOf" + number);
    set("LOBE", std::to_string(int(lobe)));
    set("HIGHLIGHT", std::to_string(int(form)));
    set("LOBE_POWER", std::to_string(from.form.gamma));
    set("LOBE_SHAPE", !lobe                                                ? "vec2(0.0)"
                      : form == Highlight::exact || form == Highlight::pow ? "material.strength.ww"
                                                                           : shapes[i]);
    range("DIRECTIONAL", 0, from.directional, end.directional);
    range("POINT", v.directionalLights, from.point, end.point);
    range("SPOT", v.directionalLights + v.pointLights, from.spot, end.spot);
    texts.push_back(std::move(text));
  }
  return texts;
}

// A file and what is defined before it.
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

ComposedProgram compose(const Variant& v, const GlslSources& sources, bool fileNames) {
  const std::string name(v.unlit ? "unlit" : shadingName(v.program));
  std::vector<Part> files{{"vector.glsl"}, {"blocks.glsl"}};
  if (!v.unlit) {
    const bool perVertex = v.program == Shading::flat || v.program == Shading::gouraud;
    if (v.specular) files.insert(files.begin() + 1, {"lobe.glsl"});
    if (v.program == Shading::environment)
      files.insert(files.end(), {{"fresnel.glsl"}, {"environment_map.glsl"}});
    files.push_back({"light_sum.glsl"});
    if (v.directionalLights + v.pointLights + v.spotLights > 0)
      for (const std::string& defines : lobeDefines(v)) files.push_back({"lights.glsl", defines});
    files.insert(files.end(), {{"sum.glsl"}, {perVertex ? "per_vertex.glsl" : "per_pixel.glsl"}});
    std::string file = name + ".glsl";  // Mesa's #line takes no '-' in names
    std::replace(file.begin(), file.end(), '-', '_');
    files.push_back({file});
  }
  const std::string head = header(fileNames) + multisampleText(v.multisampled);
  const std::string features = defines(v);
  std::vector<Part> vertex = files, fragment = files;
  const auto blocks = std::ranges::find(fragment, "blocks.glsl", &Part::file);
  fragment.insert(blocks + 1, {"sampling.glsl"});
  vertex.push_back({"vertex.glsl"});
  fragment.push_back({"fragment.glsl"});
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
  const std::string features = define("LIGHTS", 0) + define("TEXTURES", 0) +
                               define("LEVELS_OF_DETAIL", environment == Environment::image) +
                               environmentDefines(environment);
  return {"background", join(head + stageDefines(true) + features, vertex, sources, fileNames),
          join(head + stageDefines(false) + features, fragment, sources, fileNames)};
}

}  // namespace glint
