// Each guard of the shaders is removed, one at a time: a named case of the suite must fail.

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>

#include "glint/gl/context.h"
#include "glint/options/parameters.h"
#include "glint/stability/suite.h"
#include "gltf_text.h"

namespace glint::test::stability_mutation_long_test {

struct Guard {
  const char *file, *text, *without;
  const char* caught;  ///< the case that fails without the guard; empty: none can
  const char* reason;  ///< what the guard is for, or why no case can fail
  const char *highlight = "exact", *fresnel = "exact";
};

const Guard guards[] = {
    {"vector.glsl", "return square > 0.0 && square < 3.0e38 ? v / sqrt(square) : vec3(0.0);",
     "return v / sqrt(square);", "A1", "unit of the zero vector"},
    {"vector.glsl", "size > 1.0995116e12 ? 1.2924697e-26 : ", "", "A5", "long vectors are scaled"},
    {"vector.glsl", "size < 9.094947e-13 ? 7.7371252e25 : ", "", "A3", "short vectors are scaled"},
    {"lobe.glsl", "return lambda < 1.0 ? exp2(1.44269504089 * exponent * log1m(lambda)) : 0.0;",
     "return exp2(1.44269504089 * exponent * log1m(lambda));", "D1",
     "the far side, also at exponent 0"},
    {"lobe.glsl", "return x > 0.5 ? log2(1.0 - x) * 0.69314718056 : -2.0 * s * series;",
     "return log2(1.0 - x) * 0.69314718056;", "D3", "the series near the peak"},
    {"lobe.glsl", "return cosine > 0.0 ? pow(min(cosine, 1.0), exponent) : 0.0;",
     "return pow(min(cosine, 1.0), exponent);", "D6", "pow of a negative base"},
    {"lobe.glsl", "pow(min(cosine, 1.0), exponent)", "pow(cosine, exponent)", "D10",
     "cosines above 1"},
    {"fresnel.glsl", "float c = clamp(cosine, 0.0, 1.0), g2 = refractedSquare(c, b);\n  float q",
     "float c = max(cosine, 0.0), g2 = refractedSquare(c, b);\n  float q", "K7", "cosines above 1"},
    {"fresnel.glsl", "float c = clamp(cosine, 0.0, 1.0), g2 = refractedSquare(c, b);\n  float q",
     "float c = min(cosine, 1.0), g2 = refractedSquare(c, b);\n  float q", "",
     "for a negative cosine R is the reciprocal of one below 1, and the minimum gives 1"},
    {"fresnel.glsl", "return b.e == 0.0 ? 0.0 : g2 > 0.0", "return g2 > 0.0", "K2",
     "equal indices"},
    {"fresnel.glsl", "g2 > 0.0 ? min(0.5 * (rs * rs + rp * rp), 1.0) : 1.0;",
     "min(0.5 * (rs * rs + rp * rp), 1.0);", "",
     "with g = 0 below the critical cosine |rs| and |rp| are at least 1, and the minimum gives 1"},
    {"fresnel.glsl", "float g = sqrt(max(g2, 0.0));", "float g = sqrt(g2);", "",
     "a root of a negative number is undefined, but what comes of it is not chosen"},
    {"fresnel.glsl", "g2 > 0.0 ? min(0.5 * (rs * rs + rp * rp), 1.0) : 1.0;",
     "g2 > 0.0 ? 0.5 * (rs * rs + rp * rp) : 1.0;", "P13", "grazing incidence rounds above 1"},
    {"fresnel.glsl", "((c - b.critical) - b.criticalRest) * (c + b.critical)", "b.e + c * c", "P8",
     "the product that keeps its digits at the critical angle"},
    {"fresnel.glsl", "((c - b.critical) - b.criticalRest)", "(c - b.critical)", "P8",
     "the critical cosine in two floats"},
    {"fresnel.glsl", "if (sin2 >= 1.0 || b.e == 0.0) return b.e == 0.0 ? 0.0 : 1.0;",
     "if (b.e == 0.0) return 0.0;", "",
     "the root is NaN in total reflection, and min(NaN, 1) is 1 on this driver", "exact",
     "textbook"},
    {"fresnel.glsl", "if (sin2 >= 1.0 || b.e == 0.0) return b.e == 0.0 ? 0.0 : 1.0;",
     "if (sin2 >= 1.0) return 1.0;", "K2", "equal indices in the textbook's form", "exact",
     "textbook"},
    {"lobe.glsl", "return powerOf(max(1.0 - lambda, 0.0), exponent);",
     "return powerOf(1.0 - lambda, exponent);", "C6", "the far side of a whole exponent",
     "integer"},
    {"lobe.glsl", "return powerOf(max(1.0 - beta * lambda, 0.0), gamma);",
     "return powerOf(1.0 - beta * lambda, gamma);", "D9", "Lyon's skirt ends"},
    {"lobe.glsl", "return lambda < 1.0 ? powerOf(base, gamma) : 0.0;",
     "return powerOf(base, gamma);", "C6", "the far side of the cross product's form",
     "lyon-cross:8"},
    {"lobe.glsl", "float base = max(1.0 - halfBeta * (lambda * (2.0 - lambda)), 0.0);",
     "float base = 1.0 - halfBeta * (lambda * (2.0 - lambda));", "P2",
     "the skirt of the cross product's form ends", "lyon-cross:8"},
    {"lobe.glsl", "return top > 0.0 ? powerOf(top / (2.0 + rises * lambda), gamma) : 0.0;",
     "return powerOf(top / (2.0 + rises * lambda), gamma);", "C6", "the skirt of Pade's form ends",
     "pade:8"},
    {"fresnel.glsl", "float c = clamp(cosine, 0.0, 1.0);\n#if DENSER_SIDE",
     "float c = min(cosine, 1.0);\n#if DENSER_SIDE", "K8", "negative cosines of Schlick's", "exact",
     "rational"},
    {"fresnel.glsl", "float c = clamp(cosine, 0.0, 1.0);\n#if DENSER_SIDE",
     "float c = max(cosine, 0.0);\n#if DENSER_SIDE", "K7", "cosines above 1 of Schlick's", "exact",
     "rational"},
    {"fresnel.glsl", "sqrt(max(refractedSquare(c, b), 0.0) / b.square)",
     "sqrt(refractedSquare(c, b) / b.square)", "K11", "total reflection of Schlick's", "exact",
     "rational"},
    {"fresnel.glsl", "return b.e == 0.0 ? 0.0 : c > 0.0 ?", "return c > 0.0 ?", "K2",
     "equal indices of Schlick's", "exact", "rational"},
    {"fresnel.glsl", "x > 0.0 ? pow(x, exponent) : exponent > 0.0 ? 0.0 : 1.0", "pow(x, exponent)",
     "K15", "pow(0, 0) of Schlick's at normal incidence"},
    {"lights.glsl", "if (!(cosLight > 0.0)) return;", "", "C10", "the gate N.L > 0"},
    {"lights.glsl", "if (!(cosLight > 0.0)) return;", "if (!(cosLight >= 0.0)) return;", "C3",
     "the gate is open above 0 alone"},
    {"lights.glsl", "if (!(square > 1e-12)) return;", "", "C8", "the half vector where L = -V"},
    {"lights.glsl", "vec3 h = isConstant ? between : between / sqrt(square);", "vec3 h = between;",
     "C1", "the half vector is unit"},
    {"lights.glsl", "* lights[i].coneScale, 0.0, 1.0);", "* lights[i].coneScale, -1e30, 1.0);",
     "P11", "outside a spot's cone"},
    {"lights.glsl", "* lights[i].coneScale, 0.0, 1.0);", "* lights[i].coneScale, 0.0, 1e30);",
     "P11", "inside a spot's cone"},
    {"sum.glsl",
     "return square > 0.0 && square < 3.0e38 ? position / -sqrt(square) : vec3(0.0, 0.0, 1.0);",
     "return position / -sqrt(square);", "C13", "the eye on the surface"},
    {"lights.glsl", "ADD_LIGHT(sum, n, v, safeUnit(way), intensity",
     "ADD_LIGHT(sum, n, v, unit(way), intensity", "C12", "point lights near and far"},
    {"lights.glsl", "l = safeUnit(way);", "l = unit(way);", "C12", "spots near and far"},
    {"light_sum.glsl", "max(dot(way, way), 1e-12)", "dot(way, way)", "P14", "a lamp at the place"},
    {"light_sum.glsl", "return clamp(1.0 - ratio * ratio, 0.0, 1.0) / square;",
     "return (1.0 - ratio * ratio) / square;", "P14", "a lamp beyond its range"},
    {"sum.glsl", "addLights1(sum, position, n, v, p);", "", "P16", "lights of the second form"},
    {"per_pixel.glsl", "vec3 n = unit(surfaceNormal(at));", "vec3 n = surfaceNormal(at);", "I3",
     "interpolated normals are made unit"},
    {"per_pixel.glsl", "if (!(dot(n, n) > 1e-6)) n = face;", "", "I1", "normals that cancel"},
    {"per_pixel.glsl", "if (!gl_FrontFacing) face = -face;", "", "I1",
     "the face's normal is that of its front"},
    {"per_pixel.glsl", "safeUnit(cross(dFdx(vPosition), dFdy(vPosition)))",
     "unit(cross(dFdx(vPosition), dFdy(vPosition)))", "I6", "small pixels of a far view"},
    {"per_pixel.glsl", "if (!gl_FrontFacing) n = -n;", "", "C9", "back faces turn their normal"},
    {"per_vertex.glsl", "sum = sumLights(point, -n, v, p);", "sum = sumLights(point, n, v, p);",
     "C9", "back faces turn their normal, per vertex"},
    {"per_vertex.glsl", "if (!gl_FrontFacing) {", "if (false) {", "G9",
     "the side of a pixel, per vertex"},
    {"environment.glsl", "float x = 1.0 - clamp(cosine, 0.0, 1.0)", "float x = 1.0 - cosine", "K8",
     "negative cosines of a metal"},
    {"environment.glsl", "if (refractedSquare(clamp(cosine, 0.0, 1.0), boundary) > 0.0) {",
     "if (true) {", "K11", "nothing is refracted in total reflection"},
    {"environment.glsl", "sqrt(max(1.0 - dot(along, along), 0.0))", "sqrt(1.0 - dot(along, along))",
     "", "a NaN direction counts as none, where next to nothing is refracted"},
    {"environment.glsl", "if (!gl_FrontFacing) b = material.leaving;", "", "K11",
     "which side light comes from"},
    {"vertex.glsl", "n = safeUnit(n);", "", "B1", "normals under uneven scales"},
    {"vertex.glsl", "n = safeUnit(n);", "n = unit(n);", "B6", "scales that are almost 0"},
    {"vector.glsl", "return mix(vec4(0.0), min(value, 1e30), greaterThan(value, vec4(0.0)));",
     "return value;", "P15", "light and colours that are no numbers"},
    {"environment_map.glsl", "turnsOf(d.x, -d.z)", "turnsOf(-d.x, -d.z)", "M1",
     "the environment mirrored"},
    {"environment_map.glsl", "turnsOf(sqrt(d.x * d.x + d.z * d.z), d.y)",
     "turnsOf(sqrt(d.x * d.x + d.z * d.z), -d.y)", "M1", "the environment upside down"},
    {"environment_map.glsl", "turnsOf(d.x, -d.z)", "turnsOf(-d.z, -d.x)", "M1",
     "the environment turned by 90 degrees"},
    {"environment_map.glsl", "if (!(beyond > 0.0)) return here;", "return here;", "M1",
     "what lies beyond a pole's row"},
    {"environment.glsl", "mat3(frame.worldFromEye) * eyeDirection",
     "eyeDirection * mat3(frame.worldFromEye)", "M2", "the environment turned the wrong way"},
    {"environment.glsl", "mat3(frame.worldFromEye) * eyeDirection", "eyeDirection", "M3",
     "the environment fixed to the viewer"},
    {"environment_map.glsl", "float back = max(-d.z, 0.0)", "float back = max(d.z, 0.0)", "M4",
     "a built-in environment turned around"},
    {"environment.glsl", "/ sqrt(boundary.square);", "/ boundary.square;", "M5",
     "refraction by a wrong index"},
    {"environment.glsl", "/ sqrt(boundary.square);", "* sqrt(boundary.square);", "M5",
     "refraction by the index of the other side"},
    {"environment.glsl", "t * (1.0 - f) * base.rgb * environmentToward",
     "t * (1.0 - f) * environmentToward", "M5", "what is refracted has the material's colour"},
    {"environment.glsl", "return 2.0 * dot(p.normal, p.view) * p.normal - p.view;",
     "return p.view - 2.0 * dot(p.normal, p.view) * p.normal;", "M1", "reflection backwards"},
    {"per_pixel.glsl", "m.y * at.tangent.w * cross", "-m.y * at.tangent.w * cross", "M6",
     "green of a normal map is up"},
    {"per_pixel.glsl", "m.y * at.tangent.w * cross", "m.y * cross", "M7", "handedness"},
    {"per_pixel.glsl", "m.xy *= draw.normalScale;", "", "M8", "the scale of a normal map"},
    {"vertex.glsl", "vColorTexcoord = colorTexcoord;",
     "vColorTexcoord = vec2(colorTexcoord.x, 1.0 - colorTexcoord.y);", "M9",
     "a texture upside down"},
    {"fragment.glsl",
     "emission *= TEXTURE_AT(emissionTexture, EMISSION_RULE, vEmissionTexcoord).rgb;", "", "M10",
     "emission textures"},
    {"fragment.glsl", "fragment = vec4(radiance, base.a);", "fragment = vec4(radiance, 1.0);",
     "M11", "alpha"},
    {"background.glsl", "mat3(frame.worldFromEye) * ray", "ray", "M12",
     "the background stands still when the viewer turns"},
    {"sampling.glsl", "0.5 * log2(square)", "log2(square)", "M13", "the level of detail"},
    {"sampling.glsl", "shadingPlace = inMiddle ? vec2(0.0) : sum / float(covered);",
     "shadingPlace = vec2(0.0);", "M15", "nothing is shaded outside its triangle"},
    {"fragment.glsl", "if (base.a < material.alphaCutoff) discard;", "", "P12", "masks"},
    {"fragment.glsl", "if (base.a < material.alphaCutoff) discard;",
     "if (base.a <= material.alphaCutoff) discard;", "P12", "the cutoff itself is there"},
};

class Mutation : public testing::TestWithParam<Guard> {
 protected:
  static void SetUpTestSuite() {
    context_ = openContext(Backend::osmesa).release();
    context_->makeCurrent();
  }
  static void TearDownTestSuite() {
    context_->release();
    delete context_;
  }

  static inline Context* context_ = nullptr;
};

std::string textWithout(const Guard& guard) {
  std::string text = GlslSources().text(guard.file);
  const std::string from = guard.text;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << guard.file << " no longer has: " << from;
  if (at == std::string::npos) return text;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << guard.file << " has it twice: " << from;
  return text.replace(at, from.size(), guard.without);
}

TEST_P(Mutation, IsCaught) {
  const Guard& guard = GetParam();
  const std::string folder = test::temporaryFolder() + "/mutation";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/" + guard.file) << textWithout(guard);
  Look forms;
  setParameter(forms, "highlight", guard.highlight);
  setParameter(forms, "fresnel", guard.fresnel);
  stability::Selection selection;
  if (*guard.caught) {
    selection.ids = {guard.caught};
  } else {
    selection.groups = {"K"};
    selection.ids = {"P8", "P13"};
  }
  const auto failures = [&](GlslSources sources) {
    stability::Bench bench(forms, std::move(sources), setParameter);
    std::set<std::string_view> failed;
    for (const stability::CaseResult& r : stability::runCases(bench, selection))
      if (!r.passed()) failed.insert(r.item->id);
    return failed;
  };
  const auto with = failures({}), without = failures(GlslSources(folder));
  if (*guard.caught) {
    EXPECT_THAT(with, testing::IsEmpty());
    EXPECT_THAT(without, testing::ElementsAre(guard.caught)) << guard.file << ": " << guard.reason;
  } else {
    EXPECT_EQ(without, with) << guard.file << ": " << guard.reason;
  }
}

INSTANTIATE_TEST_SUITE_P(Guards, Mutation, testing::ValuesIn(guards),
                         [](const testing::TestParamInfo<Guard>& tested) {
                           std::string file = tested.param.file;
                           file.resize(file.find('.'));
                           std::erase(file, '_');
                           return file + std::to_string(tested.index) +
                                  (*tested.param.caught ? "_" + std::string(tested.param.caught)
                                                        : std::string("_equivalent"));
                         });

}  // namespace glint::test::stability_mutation_long_test
