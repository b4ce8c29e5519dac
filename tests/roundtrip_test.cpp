// Everything that can be set can be saved: random looks from the parameter table and random edits
// of the panel are restored from text and from pictures bit for bit, material parameters from model
// files.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "glint/gltf/patch.h"
#include "glint/gltf/scene_file.h"
#include "glint/image/file.h"
#include "glint/image/image.h"
#include "glint/scene/look_text.h"
#include "glint/scene/material_key.h"
#include "glint/scene/material_parameters.h"
#include "gltf_sample.h"
#include "looks.h"
#include "pictures.h"
#include "random.h"
#include "viewer/edits.h"
#include "viewer/light_edit.h"
#include "viewer/look_merge.h"
#include "viewer/session.h"

namespace glint::test::roundtrip_test {

/// Texts for every parameter of the table, over their whole ranges.
class Texts : public test::Random {
 public:
  using Random::Random;

  double number(double min, double max) {
    if (min == 0 && max == 0) min = -1e30, max = 1e30;
    switch (below(5)) {
      case 0:
        return min;
      case 1:
        return max;
      case 2:
        return std::clamp(std::round(min + (max - min) * unit()), min, max);
      case 3:  // near 0, and of any magnitude
        return std::clamp((coin() ? 1 : -1) * log(1e-300, 1), min, max);
      default:
        return min + (max - min) * unit();
    }
  }
  std::string vector(double min, double max) {
    return numberText(number(min, max)) + "," + numberText(number(min, max)) + "," +
           numberText(number(min, max));
  }
  std::string direction(double limit) {
    const std::string text = vector(-limit, limit);
    return text.find_first_of("123456789") == text.npos ? "0,0,1" : text;
  }
  std::string word() {
    static const std::vector<std::string> words{
        "a",     "b c",  "a=b",       "x,y",         "n:m",
        "Red#2", "#1",   "\"q\"",     "\\",          "\xc3\xa4\xe2\x82\xac",
        "0",     "all",  "tab\there", "line\nbreak", "[1]",
        "{}",    "true", "1e3",       " ",           "--",
        "a\"#3"};
    return words[std::size_t(below(int(words.size())))];
  }
  std::string form() {
    static const std::vector<std::string> forms = highlightTexts();
    std::string text = forms[std::size_t(below(int(forms.size())))];
    for (int i = below(4); i > 0; --i)
      text +=
          "/" + std::to_string(1 + below(20)) + "," + forms[std::size_t(below(int(forms.size())))];
    return text;
  }
  std::string light() {
    const std::string color = coin() ? ":" + vector(0, 1e6) : "";
    const std::string end = coin()   ? ""
                            : coin() ? ":falloff"
                                     : ":falloff," + numberText(log(1e-30, 1e30));
    switch (below(5)) {
      case 0:
        return "directional:" + direction(1e30) + color;
      case 1:
        return "point:" + vector(-1e30, 1e30) + color + end;
      case 2: {
        const double inner = 89 * unit(), outer = inner + (90 - inner) * log(1e-3, 1);
        return "spot:" + vector(-1e30, 1e30) + ":" + direction(1e30) + ":" + numberText(inner) +
               "," + numberText(outer) + color + end;
      }
      case 3:
        return "camera@" + direction(1e30) + color;
      default:
        return "camera" + color;
    }
  }
  /// A valid text for the parameter; empty for a parameter unknown here.
  std::string of(const Parameter& p) {
    if (p.kind == ParameterKind::flag) return coin() ? "true" : "false";
    if (p.kind == ParameterKind::number) return numberText(number(p.min, p.max));
    if (p.kind == ParameterKind::vector) return vector(p.min, p.max);
    if (p.kind == ParameterKind::direction) return direction(p.max);
    if (p.kind == ParameterKind::color) return vector(p.min, p.max);
    if (p.name == "highlight") return form();
    if (p.kind == ParameterKind::choice) {
      const auto words = p.choices();
      return words[std::size_t(below(int(words.size())))];
    }
    if (p.name == "light") return light();
    if (p.name == "light-scale") return coin() ? "auto" : numberText(log(1e-30, 1e30));
    if (p.name == "camera-index") return std::to_string(below(1 << 30));
    if (p.name == "camera-intrinsics")
      return numberText(log(1e-3, 1e6)) + "," + numberText(log(1e-3, 1e6)) + "," +
             numberText(log(1e-3, 1e6)) + "," + numberText(-log(1e-3, 1e6));
    if (p.name == "clipping-range") {
      const double near = log(1e-30, 1e20);
      return numberText(near) + "," + numberText(near * log(1.0001, 1e9));
    }
    if (p.name == "resolution")
      return std::to_string(1 + below(65535)) + "," + std::to_string(1 + below(65535));
    if (p.name == "anti-aliasing")
      return coin()   ? "none"
             : coin() ? "msaa:" + std::to_string(1 + below(64))
                      : "ssaa:" + std::to_string(1 + below(16));
    if (p.name == "animation" || p.name == "scene" || p.name == "variant" ||
        p.name == "hdri-file" || p.name == "cost-table")
      return word();
    return {};
  }

  void editMaterial(Look& look) {
    MaterialEdit& edit = look.material[materialKeyOf(word())];
    for (const MaterialParameter& p : materialParameters())
      if (coin()) edit.*p.edit = number(p.min, p.max);
    if (coin()) edit.color = parseVector(vector(0, 1e6), 0, 1e6, "color");
    if (coin()) edit.highlight = parseHighlights(form(), "highlight");
    if (coin()) edit.fresnel = Fresnel(below(int(fresnelTexts().size())));
    for (const SwitchedTexture& t : switchedTextures())
      if (coin()) edit.*t.edit = coin();
    if (edit == MaterialEdit{}) edit.ior = 1.25;
  }

  Look look() {
    Look look;
    for (const Parameter& p : lookParameters()) {
      if (coin()) continue;
      if (p.name == "material") {
        for (int i = 1 + below(3); i > 0; --i) editMaterial(look);
        continue;
      }
      for (int i = p.repeatable ? 1 + below(4) : 1; i > 0; --i) {
        const std::string text = of(p);
        EXPECT_FALSE(text.empty()) << p.name << " has no random texts here: give it some";
        if (!text.empty()) p.read(look, text);
      }
    }
    return look;
  }

 private:
  /// A name in the syntax of keys: in quotation marks if necessary.
  static std::string materialKeyOf(const std::string& name) {
    Material material;
    material.name = name;
    return materialKey(material);
  }
};

// Parameters of a light that its type does not use are not saved.
Look withoutRest(Look look) {
  if (!look.light) return look;
  for (Light& light : *look.light) {
    const bool placed = light.type == Light::Type::point || light.type == Light::Type::spot;
    if (!placed) light.position = {}, light.fallsOff = false;
    if (light.type == Light::Type::point) light.direction = {};
    if (light.type != Light::Type::spot) light.innerAngle = 0, light.outerAngle = 45;
    if (!light.fallsOff) light.range = 0;
  }
  return look;
}

TEST(RoundTrip, OfEveryParameterThroughTextAndPictures) {
  Texts texts(11);
  const std::string folder = test::temporaryFolder();
  const int draws = test::drawsOf("GLINT_ROUNDTRIP_DRAWS", 2000);
  for (int i = 0; i < draws; ++i) {
    const Look look = texts.look();
    const std::string text = saveLook(look);
    ASSERT_EQ(lookOf(text), look) << text;
    ASSERT_EQ(saveLook(lookOf(text)), text);
    if (i % 20 != 0) continue;
    for (const char* name : {"/look.png", "/look.exr"}) {
      PictureOptions options;
      options.text = {{"glint-look", text}};
      writePicture(folder + name, {1, 1, {0, 0, 0, 1}}, options);
      Look back;
      readLookFile(back, folder + name);
      ASSERT_EQ(back, look) << name;
    }
  }
}

std::string optionText(const Parameter& p, const ParameterValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return numberText(*number);
  if (const auto* on = std::get_if<bool>(&value)) return *on ? "true" : "false";
  if (const auto* at = std::get_if<std::size_t>(&value)) return p.choices()[*at];
  const auto& v = std::get<glm::dvec3>(value);
  return numberText(v.x) + "," + numberText(v.y) + "," + numberText(v.z);
}

// As the panel sets them, with the consequences, such as removing a calibrated lens.
TEST(RoundTrip, OfEveryValueWithoutItsText) {
  Texts texts(7);
  for (int i = 0; i < 200; ++i) {
    const Look from = texts.look(), before = texts.look();
    for (const Parameter& p : lookParameters()) {
      EXPECT_EQ(p.get == nullptr, p.kind == ParameterKind::text || p.name == "highlight") << p.name;
      const ParameterValue value = p.get ? p.get(from) : ParameterValue();
      if (value == ParameterValue()) continue;
      Look set = before, read = before;
      p.set(set, value);
      p.read(read, optionText(p, value));
      EXPECT_EQ(set, read) << p.name;
      EXPECT_EQ(p.get(set), value) << p.name;
    }
  }
}

TEST(RoundTrip, AValueOutOfRangeIsRefusedAsItsTextIs) {
  for (const Parameter& p : lookParameters()) {
    if (!p.get || p.kind == ParameterKind::flag || p.kind == ParameterKind::choice) continue;
    std::vector<ParameterValue> wrong;
    for (const double number : {2 * p.min - 1, 2 * p.max + 1, std::nan("")})
      if (p.kind == ParameterKind::number)
        wrong.emplace_back(number);
      else
        wrong.emplace_back(glm::dvec3(0, number, 0));
    if (p.kind == ParameterKind::direction) wrong.emplace_back(glm::dvec3(0.0));
    for (const ParameterValue& value : wrong) {
      const auto said = [&](const auto& change) -> std::string {
        Look look;
        try {
          change(look);
        } catch (const InputError& error) {
          EXPECT_EQ(look, Look{}) << p.name;
          return error.what();
        }
        return "nothing";
      };
      const std::string text = optionText(p, value);
      const std::string refused = said([&](Look& look) { p.set(look, value); });
      EXPECT_EQ(refused, said([&](Look& look) { p.read(look, text); })) << p.name;
      EXPECT_TRUE(refused.starts_with("--" + p.name + ": '" + text + "'")) << refused;
    }
  }
}

// As the panel's list of lights edits them, and every action of the keyboard.
TEST(RoundTrip, OfEveryEditOfTheWindow) {
  test::Random random(5);
  for (const char* model : {"preview.glb", "bend.glb", "lights.glb"}) {
    viewer::Session session;
    session.take(viewer::loadModel(std::string(GLINT_SOURCE_DIR) + "/models/" + model));
    Look& look = session.document.a;
    for (int i = 0; i < 3000; ++i) {
      if (random.below(4) == 0 && look.light && !look.light->empty()) {
        Light& light = (*look.light)[std::size_t(random.below(int(look.light->size())))];
        const bool placed = light.type == Light::Type::point || light.type == Light::Type::spot;
        if (!placed || random.coin())
          viewer::changeType(light, Light::Type(random.below(4)), session.model->bounds,
                             glm::dmat3(1.0));
        else
          viewer::setFallOff(light, random.coin(), session.model->bounds);
      } else {
        viewer::edit(session, viewer::Action(random.below(int(viewer::Action::count))));
      }
      const std::string text = saveLook(look);
      Look back;
      ASSERT_NO_THROW(back = lookOf(text)) << text;
      ASSERT_EQ(withoutRest(back), withoutRest(look));
      ASSERT_EQ(saveLook(back), text);
    }
  }
}

TEST(RoundTrip, OfMaterialsThroughAModelsFile) {
  Texts texts(3);
  Sample sample;
  for (int i = 0; i < 5; ++i)
    sample.add("materials", {{"name", i < 3 ? "Red" : "m" + std::to_string(i)}});
  sample.triangle()["material"] = 0;
  for (const auto& path : {sample.writeGltf(), sample.writeGlb()}) {
    const auto bytes = readFile(path.string());
    for (int i = 0; i < 100; ++i) {
      std::vector<MaterialPatch> patches;
      for (std::size_t m = 0; m < 5; ++m) {
        MaterialPatch& patch = patches.emplace_back();
        patch.index = m;
        for (const MaterialParameter& p : materialParameters())
          patch.values.*p.value = texts.number(p.min, p.max);
        patch.values.color = parseVector(texts.vector(0, 1e6), 0, 1e6, "color");
        patch.switchedOff = unsigned(i + int(m)) % 8;
      }
      const auto patched = patchGltf(bytes, patches, "a");
      const auto copy =
          sample.writeText({reinterpret_cast<const char*>(patched.data()), patched.size()},
                           "copy" + path.filename().string());
      const Scene scene = loadGltf(copy);
      for (const MaterialPatch& patch : patches) {
        const ShadingParameters& is = scene.materials[patch.index].shading;
        for (const MaterialParameter& p : materialParameters())
          ASSERT_EQ(is.*p.value, patch.values.*p.value) << p.name;
        ASSERT_EQ(is.color, patch.values.color);
        ASSERT_EQ(scene.materials[patch.index].switchedOff, patch.switchedOff);
      }
    }
  }
}

// A look file changed by another program during unsaved edits.
TEST(RoundTrip, OfALookThatChangesUnderEdits) {
  using viewer::mergedLook;
  Texts texts(8);
  for (int i = 0; i < 300; ++i) {
    const Look base = texts.look(), other = texts.look();
    ASSERT_EQ(mergedLook(base, base, other), other);
    ASSERT_EQ(mergedLook(other, base, base), other);
    ASSERT_EQ(mergedLook(other, base, other), other);
  }
  Look base, mine, theirs;
  base.exposure = 1;
  base.material["a"].exponent = 5;
  mine = theirs = base;
  mine.material["a"].ior = 1.25;
  mine.light.emplace();
  theirs.exposure = 2;
  theirs.material["a"].exponent = 6;
  theirs.material["b"].ior = 2;
  const Look merged = mergedLook(mine, base, theirs);
  EXPECT_EQ(merged.exposure, 2);
  EXPECT_EQ(merged.material.at("a").exponent, 6);
  EXPECT_EQ(merged.material.at("a").ior, 1.25);
  EXPECT_EQ(merged.material.at("b").ior, 2);
  ASSERT_TRUE(merged.light);
  EXPECT_TRUE(merged.light->empty());
}

}  // namespace glint::test::roundtrip_test
