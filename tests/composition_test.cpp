// The GLSL composed for variants; needs no GL.

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "glint/image/error.h"
#include "glint/render/composition.h"
#include "glint/render/glsl_builtin.h"
#include "variants.h"

namespace glint::test::composition_test {

using testing::HasSubstr;
using testing::Not;

// Evaluates the conditional directives of a text and keeps what the driver compiles. Fails on an
// #if that uses an undefined name (which would silently be 0), on unbalanced #ifs and on a name
// defined twice. Conditions consist of names, numbers, !, &&, ||, ==, !=, > and brackets.
class Preprocessor {
 public:
  std::string run(const std::string& text) {
    std::istringstream lines(text);
    std::string out;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("#define ")) {
        if (!isOn()) continue;
        std::istringstream words(line.substr(8));
        std::string name, value;
        words >> name >> value;
        EXPECT_TRUE(defined_.emplace(name, value).second) << name << " is defined twice";
      } else if (line.starts_with("#undef ")) {
        if (isOn()) {
          EXPECT_EQ(defined_.erase(line.substr(7)), 1u) << line;
        }
      } else if (line.starts_with("#ifdef ")) {  // for driver extensions; there are none here
        stack_.push_back({isOn(), false});
        on_ = false;
      } else if (line.starts_with("#if ")) {
        stack_.push_back({isOn(), false});
        branch(line.substr(4));
      } else if (line.starts_with("#elif ")) {
        branch(line.substr(6));
      } else if (line.starts_with("#else")) {
        on_ = stack_.back().first && !stack_.back().second;
        stack_.back().second = true;
      } else if (line.starts_with("#endif")) {
        EXPECT_FALSE(stack_.empty());
        on_ = stack_.back().first;
        stack_.pop_back();
      } else {
        EXPECT_TRUE(!line.starts_with("#") || line.starts_with("#version") ||
                    line.starts_with("#line") || line.starts_with("#extension"))
            << line;
        if (isOn()) out += line.substr(0, line.find("//")) + "\n";
      }
    }
    EXPECT_TRUE(stack_.empty());
    return out;
  }

 private:
  bool isOn() const { return on_; }
  void branch(const std::string& condition) {
    if (!stack_.back().first) {
      on_ = false;
      return;
    }
    on_ = !stack_.back().second && value(condition);
    stack_.back().second = stack_.back().second || on_;
  }
  bool value(std::string text) {
    at_ = 0;
    text_ = std::move(text);
    const int result = disjunction();
    return result != 0;
  }
  void skip() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool take(const std::string& token) {
    skip();
    if (text_.compare(at_, token.size(), token) != 0) return false;
    at_ += token.size();
    return true;
  }
  int disjunction() {
    int a = conjunction();
    while (take("||")) a = conjunction() || a;
    return a;
  }
  int conjunction() {
    int a = comparison();
    while (take("&&")) a = comparison() && a;
    return a;
  }
  int comparison() {
    const int a = unary();
    if (take("==")) return a == unary();
    if (take("!=")) return a != unary();
    if (take(">")) return a > unary();
    return a;
  }
  int unary() {
    if (take("!")) return !unary();
    if (take("(")) {
      const int a = disjunction();
      EXPECT_TRUE(take(")")) << text_;
      return a;
    }
    skip();
    std::string word;
    while (at_ < text_.size() && (std::isalnum(text_[at_]) || text_[at_] == '_'))
      word += text_[at_++];
    if (word.empty()) {
      ADD_FAILURE() << "cannot read '" << text_ << "'";
      at_ = text_.size();
      return 0;
    }
    if (std::isdigit(word[0])) return std::stoi(word);
    const auto found = defined_.find(word);
    EXPECT_NE(found, defined_.end()) << word << " is not defined";
    return found == defined_.end() ? 0 : std::stoi(found->second);
  }

  std::map<std::string, std::string> defined_;
  std::vector<std::pair<bool, bool>> stack_;  // is the outer block on; was a branch taken
  bool on_ = true;
  std::string text_;
  std::size_t at_ = 0;
};

std::string fragmentOf(const Variant& v) {
  return Preprocessor().run(compose(v, GlslSources(), false).fragment);
}

TEST(Composition, ComposesEveryVariantOfABroadSample) {
  for (const Variant& v : glint::test::sampledVariants())
    for (bool names : {false, true}) {
      const ComposedProgram program = compose(v, GlslSources(), names);
      EXPECT_FALSE(program.name.empty());
      for (const std::string& text : {program.vertex, program.fragment}) {
        EXPECT_TRUE(text.starts_with("#version 330 core\n"));
        EXPECT_EQ(text.find("#extension") != std::string::npos, names || v.multisampled);
        const std::string left = Preprocessor().run(text);
        EXPECT_THAT(left, HasSubstr("void main()"));
      }
      if (testing::Test::HasFailure()) return;
    }
}

TEST(Composition, IsAFunctionOfTheVariant) {
  std::set<std::string> texts;
  const auto sample = glint::test::sampledVariants();
  for (const Variant& v : sample) {
    const ComposedProgram a = compose(v, GlslSources(), true), b = compose(v, GlslSources(), true);
    EXPECT_EQ(a.vertex, b.vertex);
    EXPECT_EQ(a.fragment, b.fragment);
    texts.insert(a.vertex + a.fragment);
  }
  EXPECT_EQ(texts.size(), sample.size()) << "two variants have one text: one of them is needless";
}

TEST(Composition, HoldsOnlyWhatTheVariantNeeds) {
  using glint::Shading;
  for (const Variant& v : glint::test::sampledVariants()) {
    const ComposedProgram program = compose(v, GlslSources(), false);
    const std::string vertex = Preprocessor().run(program.vertex),
                      fragment = Preprocessor().run(program.fragment), both = vertex + fragment;
    const auto holds = [&](const char* what) { return both.find(what) != std::string::npos; };
    const int lights = v.directionalLights + v.pointLights + v.spotLights;
    EXPECT_EQ(holds("sampler2D"),
              v.colorTexture || v.emissionTexture || v.normalTexture || v.textured != 0)
        << program.name;
    EXPECT_EQ(holds("LightBlock"), lights > 0) << program.name;
    EXPECT_EQ(holds("for ("), lights > 0) << program.name;
    EXPECT_EQ(holds("discard"), v.alphaMask) << program.name;
    EXPECT_EQ(holds("vertexColor"), v.vertexColors) << program.name;
    constexpr const char* lobes[] = {"return lobeExact(",   "return lobePow(",
                                     "return lobeInteger(", "return lobeLyon(",
                                     "return lobeLyon(",    "return lobeLyonCross(",
                                     "return lobePade(",    "return lobeGaussian(",
                                     "return lobeTable(",   "none"};
    std::set<std::string_view> forms;  // a form that no light uses is absent
    if (v.specular) forms.insert(lobes[int(v.highlight.form)]);
    for (const Variant::Dimmer& each : v.dimmer) forms.insert(lobes[int(each.form.form)]);
    for (const char* lobe : lobes)
      EXPECT_EQ(holds(lobe), forms.contains(lobe) && lobe != std::string_view("none"))
          << program.name << " " << lobe;
    constexpr const char* reflectances[] = {
        "return fresnelExact(",       "return fresnelTextbook(", "return fresnelSchlick(",
        "return fresnelSchlickExp2(", "return fresnelRational(", "return fresnelSchlickFifth("};
    for (const char* each : reflectances) {
      const bool used = v.dielectric &&
                        each == std::string_view(reflectances[v.schlickFifth ? 5 : int(v.fresnel)]);
      EXPECT_EQ(holds(each), used) << program.name << " " << each;
    }
    EXPECT_EQ(holds("environmentRadiance"), v.program == Shading::environment && !v.unlit)
        << program.name;
    EXPECT_EQ(holds("float t = "), v.refraction) << program.name;
    EXPECT_EQ(holds("b.e < 0.0"), v.denserSide) << program.name;
    EXPECT_EQ(holds("vPosition"), v.pixelPosition) << program.name;
    const bool image =
        v.program == Shading::environment && !v.unlit && v.environment == glint::Environment::image;
    const bool textures = v.colorTexture || v.emissionTexture || v.normalTexture ||
                          (v.textured != 0 && (v.unlit || isPerPixel(v.program)));
    EXPECT_EQ(holds("dFdx"), v.vanishingNormal || textures || image || v.specularAntialiasing)
        << program.name;
    EXPECT_EQ(holds("filteredParameters"), v.specularAntialiasing) << program.name;
    EXPECT_EQ(holds("normalTurn"), v.specularAntialiasing && !v.toksvig) << program.name;
    EXPECT_EQ(holds("texel.a"), v.toksvig) << program.name;
    EXPECT_EQ(holds("LobeTableBlock"), lobeTableRows(v) > 0) << program.name;
    EXPECT_EQ(holds("Normalization"), v.normalized) << program.name;
    EXPECT_EQ(holds("gl_FrontFacing"), v.twoSided || v.vanishingNormal) << program.name;
  }
}

TEST(Composition, EveryFileIsUsedSomewhere) {
  std::set<std::string> used;
  const auto add = [&](const ComposedProgram& program) {
    const std::regex line("#line 1 \"([a-z_]+\\.glsl)\"");
    const std::string text = program.vertex + program.fragment;
    for (std::sregex_iterator i(text.begin(), text.end(), line), end; i != end; ++i)
      used.insert((*i)[1]);
  };
  for (const Variant& v : glint::test::sampledVariants()) add(compose(v, GlslSources(), true));
  add(glint::composeBackground(glint::Environment::studio, GlslSources(), true));
  add(glint::composeLayer(false, false, GlslSources(), true));
  for (const auto& [name, text] : glint::builtinGlsl()) EXPECT_TRUE(used.contains(name)) << name;
}

TEST(Composition, BackgroundsCompose) {
  for (auto environment :
       {glint::Environment::studio, glint::Environment::sky, glint::Environment::white})
    for (bool names : {false, true}) {
      const ComposedProgram program = glint::composeBackground(environment, GlslSources(), names);
      EXPECT_THAT(Preprocessor().run(program.vertex), HasSubstr("gl_VertexID"));
      EXPECT_THAT(Preprocessor().run(program.fragment), HasSubstr("environmentRadiance"));
    }
}

TEST(Composition, LitVariantsCarryTheirFunctions) {
  Variant v;
  v.directionalLights = 1;
  v.diffuse = true;
  EXPECT_THAT(fragmentOf(v), Not(HasSubstr("sum.specular += ")));
  v.specular = true;
  EXPECT_THAT(fragmentOf(v), HasSubstr("sum.specular += "));
}

TEST(GlslSources, TakesFilesFromAFolder) {
  const std::filesystem::path folder = testing::TempDir() + "glint_glsl_sources";
  std::filesystem::remove_all(folder);
  EXPECT_THROW(GlslSources{folder}, glint::InputError);  // missing
  std::filesystem::create_directories(folder);
  EXPECT_THROW(GlslSources{folder}, glint::InputError);  // none of the files exists
  std::ofstream(folder / "phong.glsl") << "// mine\n";
  const GlslSources sources(folder);
  EXPECT_EQ(sources.text("phong.glsl"), "// mine\n");
  EXPECT_EQ(sources.text("lobe.glsl"), GlslSources().text("lobe.glsl"));
  std::filesystem::remove_all(folder);
}

TEST(GlslSources, AreThoseOfTheFolder) {
  for (const auto& entry : std::filesystem::directory_iterator(GLINT_SOURCE_DIR "/glsl")) {
    std::ifstream file(entry.path());
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_EQ(GlslSources().text(entry.path().filename().string()), text.str()) << entry.path();
  }
}

}  // namespace glint::test::composition_test
