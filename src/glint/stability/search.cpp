#include "glint/stability/search.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "glint/image/clock.h"
#include "glint/image/error.h"
#include "glint/scene/camera.h"
#include "glint/scene/look_text.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

constexpr std::uint64_t rowsOfBatch = 1 << 15;  // with one material and one look
constexpr std::size_t mostVariants = 128;       // more would compile for longer than they run
constexpr std::size_t mostFinds = 8;

// Makes every input of a point from a row's number and a seed, on the driver: uploading them would
// take longer than shading. PCG (O'Neill 2014) as the hash of Jarzynski and Olano (2020).
constexpr const char* generator = R"(
uint randomState = 0u;
uint nextRandom() {
  randomState = randomState * 747796405u + 2891336453u;
  uint word = ((randomState >> ((randomState >> 28u) + 4u)) ^ randomState) * 277803737u;
  return (word >> 22u) ^ word;
}
float drawUnit() { return float(nextRandom() >> 8u) * (1.0 / 16777216.0); }
float drawLog(float low, float high) { return exp2(mix(low, high, drawUnit())); }
vec3 drawDirection() {
  uint kind = nextRandom() & 7u;
  if (kind == 0u) return vec3(0.0, 0.0, drawUnit() < 0.5 ? -1.0 : 1.0);
  if (kind == 1u) return vec3(drawUnit() < 0.5 ? -1.0 : 1.0, 0.0, 0.0);
  float z = 2.0 * drawUnit() - 1.0, a = 6.2831853 * drawUnit();
  return vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(a), sin(a)), z);
}
vec3 drawNear(vec3 v) { return v + drawLog(-40.0, 0.0) * drawDirection(); }
bool isFinite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

vec3 drawnNormal, drawnPosition, drawnLight;
void drawInputs() {
  drawnNormal = drawDirection();
  uint kind = nextRandom() & 7u;
#if PER_PIXEL
  // As interpolated: of any length up to 1, and vanishing.
  drawnNormal *= kind == 0u ? 0.0 : kind == 1u ? drawLog(-120.0, 0.0) : mix(0.5, 1.0, drawUnit());
#endif
  vec3 toViewer = kind == 2u ? drawNear(drawnNormal) : kind == 3u ? -drawNear(drawnNormal) : drawDirection();
  float distance = kind == 4u ? drawLog(-120.0, 60.0) : kind == 5u ? 0.0 : drawLog(-6.0, 6.0);
  drawnPosition = -distance * toViewer;
}
void drawLights() {
#if LIGHTS > 0
  vec3 v = length(drawnPosition) > 0.0 ? -drawnPosition / max(length(drawnPosition), 1e-30) : vec3(0.0, 0.0, 1.0);
  for (int i = 0; i < LIGHTS; ++i) {
    uint kind = nextRandom() & 7u;
    vec3 n = drawnNormal, l = drawDirection();
    if (kind == 0u) l = drawNear(-v);
    if (kind == 1u) l = drawNear(2.0 * dot(n, v) * n - v);
    if (kind == 2u) l = vec3(0.0);
    float size = length(l);
    l = size > 1e-6 ? l / size : vec3(0.0);
    lights[i].intensity = vec3(drawLog(-20.0, 20.0), drawUnit(), kind == 3u ? 0.0 : 1e6);
    lights[i].fallsOff = 0.0;
    lights[i].axis = drawDirection();
    lights[i].cosOuter = cos(1.5707963 * drawUnit());
    vec3 between = l + vec3(0.0, 0.0, 1.0);
    float square = dot(between, between);
#if BLINN
    between = square > 1e-12 ? between / sqrt(square) : vec3(0.0);
#endif
    lights[i].halfway = between;
    lights[i].coneScale = drawLog(0.0, 30.0);
    if (i >= DIRECTIONAL_LIGHTS) l = drawnPosition + l * (kind == 4u ? drawLog(-100.0, 0.0) : drawLog(-3.0, 49.0));
    lights[i].position = l;
    lights[i].inverseRange = kind == 5u ? drawLog(-20.0, 20.0) : 0.0;
    drawnLight = l;
  }
#endif
}
void drawPoint(float row, float seed) {
  randomState = uint(row) * 1103515245u + uint(seed) * 12345u + 7u;
  nextRandom();
  drawInputs();
  drawLights();
  setSurface(drawnNormal, drawnPosition, (nextRandom() & 1u) == 0u);
}
)";

/// The text of a function over one random point: its signature, the drawing of the point, and
/// `body`.
std::string ofRandomPoint(const std::string& result, const std::string& body) {
  return result + "(float row, float seed, " + blockArguments + ") {\n" + setTheBlocks +
         "  drawPoint(row, seed);\n" + body + "}";
}

/// A probe of a variant with the generator after its text.
std::unique_ptr<Probe> searchProbe(const Variant& variant, const GlslSources& sources) {
  ProbeText text;
  text.text = "#define PER_PIXEL " + std::to_string(isPerPixel(variant.program)) + "\n" +
              programText(variant, sources) + generator;
  return std::make_unique<Probe>(sources, text);
}

double strength(Random& random) {
  const int kind = random.below(4);
  return kind == 0 ? 0 : kind == 1 ? 1 : kind == 2 ? 1e6 : std::pow(10, random.between(-6, 6));
}

Material randomMaterial(Random& random) {
  Material m;
  m.shading.ambient = strength(random);
  m.shading.diffuse = strength(random);
  m.shading.specular = strength(random);
  const int kind = random.below(4);
  m.shading.exponent = kind == 0 ? 0 : kind == 1 ? 1e6 : std::pow(10, random.between(-3, 6));
  m.shading.metalness = random.below(3) == 0 ? 1 : random.below(2) == 0 ? 0 : random.unit();
  const int index = random.below(5);
  m.shading.ior = index == 0   ? 1
                  : index == 1 ? 1 + std::exp2(-random.between(5, 24))
                  : index == 2 ? 1e-3
                  : index == 3 ? 1e3
                               : std::pow(10, random.between(-3, 3));
  for (int i = 0; i < 3; ++i) m.shading.color[i] = strength(random);
  m.shading.transmission = random.below(3) == 0 ? 0 : random.below(2) == 0 ? 1 : random.unit();
  m.alpha = random.below(2) == 0 ? 1 : random.unit();
  if (random.below(4) == 0) m.alphaMode = AlphaMode::blend;
  m.doubleSided = random.below(2) == 0;
  if (random.below(4) == 0) m.emission = glm::dvec3(strength(random));
  return m;
}

Light::Type typeOf(int i) {
  return i == 0 ? Light::Type::directional : i == 1 ? Light::Type::point : Light::Type::spot;
}

Look randomPointLook(Bench& bench, Random& random) {
  Look look = bench.look(everyShading[random.below(5)]);
  look.ambientLight = glm::dvec3(strength(random));
  look.viewer = random.below(4) == 0 ? Viewer::infinite : Viewer::local;
  look.environment = Environment(random.below(3));
  look.environmentRotation = random.between(-180, 180);
  look.mediumIor = random.below(2) == 0 ? 1 : std::pow(10, random.between(-3, 3));
  look.blinnFactor = random.below(2) == 0 ? 4 : std::pow(10, random.between(-3, 3));
  look.light.emplace();
  for (int i = 0, n = random.below(3); i < n; ++i) {
    Light light = directional({0, 0, 1});
    light.type = typeOf(random.below(3));
    light.fallsOff = light.type != Light::Type::directional && random.below(2) == 0;
    look.light->push_back(light);
  }
  return look;
}

std::string materialText(const Material& m) {
  const ShadingParameters& s = m.shading;
  return "ambient " + numberText(s.ambient) + " diffuse " + numberText(s.diffuse) + " specular " +
         numberText(s.specular) + " exponent " + numberText(s.exponent) + " metalness " +
         numberText(s.metalness) + " ior " + numberText(s.ior) + " color " + vectorText(s.color) +
         " transmission " + numberText(m.shading.transmission);
}

void searchPoints(Bench& bench, std::uint64_t evaluations, SearchReport& report,
                  const std::function<void(double)>& progress) {
  std::vector<float> rows(rowsOfBatch);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = float(i);
  std::map<Variant, std::unique_ptr<Probe>> probes;
  Random random(97);
  const std::string function =
      ofRandomPoint("float search",
                    "  vec3 c = surfaceRadiance();\n  return isFinite(c.x) && isFinite(c.y) && "
                    "isFinite(c.z) ? 0.0 : 1.0;\n");
  std::vector<float> results(rowsOfBatch);
  while (report.evaluations < evaluations) {
    const Material material = randomMaterial(random);
    const PointScene scene(randomPointLook(bench, random), material);
    if (scene.list.items.empty() || scene.item().variant.unlit) continue;
    if (probes.size() >= mostVariants && !probes.contains(scene.item().variant)) continue;
    std::unique_ptr<Probe>& probe = probes[scene.item().variant];
    if (!probe) probe = searchProbe(scene.item().variant, bench.sources());
    std::vector<std::vector<float>> columns{rows, {float(random.below(1 << 24))}};
    for (std::vector<float>& column : blockColumns(scene)) columns.push_back(std::move(column));
    const std::vector<std::span<const float>> spans(columns.begin(), columns.end());
    probe->run(function, spans, results);
    report.evaluations += rowsOfBatch;
    ++report.materials;
    for (std::size_t row = 0; row < results.size(); ++row) {
      if (results[row] == 0) continue;
      ++report.notFinite;
      if (report.finds.size() >= mostFinds) continue;
      columns[0] = {rows[row]};
      std::string text = std::string(shadingName(scene.look.shading));
      for (const char* name : {"drawnNormal", "drawnPosition", "drawnLight"}) {
        const auto v = probe->run(
            ofRandomPoint("vec3 tell" + std::string(name), "  return " + std::string(name) + ";\n"),
            {columns.begin(), columns.end()});
        text += " " + std::string(name + 5) + " " + vectorText({v[0], v[1], v[2]});
      }
      report.finds.push_back(text + " " + materialText(material));
    }
    if (progress) progress(double(report.evaluations) / double(evaluations));
  }
  report.variants = probes.size();
}

double anySize(Random& random, bool pathological) {
  return pathological ? std::pow(10, random.between(-30, 30)) : std::pow(10, random.between(-2, 2));
}

Mesh randomMesh(Random& random, bool pathological) {
  Mesh mesh;
  const int triangleCount = 1 + random.below(12);
  const double size = anySize(random, pathological && random.below(2) == 0);
  glm::dvec3 place(0);
  if (pathological && random.below(3) == 0)
    place = randomDirections(1, unsigned(random.below(1 << 20)))[0] * size * 1e5;
  for (int i = 0; i < 3 * triangleCount; ++i) {
    glm::dvec3 p(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    if (pathological && random.below(4) == 0) p *= glm::dvec3(1, 0, 0);
    if (pathological && random.below(8) == 0) p = glm::dvec3(0);
    if (pathological && random.below(16) == 0) p *= std::pow(10, random.between(-6, 6));
    mesh.positions.emplace_back(place + p * size);
    mesh.normals.emplace_back(randomDirections(1, unsigned(random.below(1 << 20)))[0]);
    mesh.indices.push_back(
        std::uint32_t(pathological && random.below(4) == 0 ? random.below(i + 1) : i));
  }
  if (random.below(2) == 0)
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      mesh.colors.emplace_back(random.unit(), random.below(2), pathological ? strength(random) : 1,
                               random.unit());
  mesh.normalsMayCancel = random.below(2) == 0;
  if (pathological && random.below(4) == 0)
    mesh.normals.assign(mesh.normals.size(), glm::vec3(0, 0, -1));
  return mesh;
}

glm::dmat4 randomWorld(Random& random, bool pathological) {
  glm::dvec3 scale(1);
  if (pathological)
    for (int i = 0; i < 3; ++i)
      scale[i] = random.below(4) == 0   ? 0
                 : random.below(3) == 0 ? std::pow(10, random.between(-20, 20))
                                        : -1;
  return translation({random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)}) *
         rotation(random.between(0, 6)) * scaling(scale);
}

}  // namespace

RandomScene randomScene(const Look& base, Random& random, bool pathological) {
  RandomScene made{{}, base};
  Scene& scene = made.scene;
  Look& look = made.look;
  scene.name = "random";
  for (int i = 0, n = 1 + random.below(2); i < n; ++i) {
    Material material = randomMaterial(random);
    if (!pathological) {
      material.shading.color = glm::dvec3(random.unit(), random.unit(), random.unit());
      material.shading.ambient = material.shading.diffuse = 1;
    }
    material.emission = glm::dvec3(0);  // fewer variants to compile
    Mesh mesh = randomMesh(random, pathological);
    mesh.material = i;
    scene.materials.push_back(material);
    scene.instances.push_back({i, randomWorld(random, pathological)});
    scene.meshes.push_back(std::move(mesh));
  }
  look.resolution = {16, 16};
  look.shading = everyShading[random.below(5)];
  look.backgroundColor = glm::dvec3(0.1);
  look.ambientLight = glm::dvec3(0.25);
  Light light = directional({random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
  light.type = typeOf(random.below(3));
  light.position = light.direction * anySize(random, pathological);
  if (pathological && random.below(4) == 0) light.direction = {0, 0, -1};
  look.light = {light};
  if (random.below(2) == 0) {
    look.cameraPosition =
        glm::dvec3(random.between(-4, 4), random.between(-4, 4), random.between(-4, 4)) *
        anySize(random, pathological && random.below(2) == 0);
    if (random.below(2) == 0) look.cameraFocalPoint = glm::dvec3(0);
  }
  if (pathological) {
    const double angles[] = {1e-5, 1e-3, 30, 179, 179.9};
    look.cameraViewAngle = angles[random.below(5)];
    if (random.below(4) == 0) look.cameraViewUp = glm::dvec3(0, 0, 1);
    if (random.below(4) == 0) look.clippingRange = glm::dvec2(1e-20, 1e20);
  }
  return made;
}

SearchReport searchNotFinite(Bench& bench, std::uint64_t evaluations,
                             const std::function<void(double)>& progress) {
  SearchReport report;
  const auto started = Clock::now();
  searchPoints(bench, evaluations, report, [&](double share) {
    if (progress) progress(share / 2);
  });
  report.pointSeconds = secondsSince(started);
  const auto drawing = Clock::now();
  const std::uint64_t scenes = evaluations / 10000;
  Random random(101);
  const auto finite = [](const Image& image) {
    return std::all_of(image.values.begin(), image.values.end(),
                       [](float x) { return std::isfinite(x); });
  };
  std::set<Variant> compiled;
  const auto isNew = [&](const RandomScene& made) {
    const DrawList list = makeDrawList(made.scene, boundsOf(made.scene), made.look);
    std::set<Variant> own;
    for (const DrawItem& item : list.items) own.insert(item.variant);
    const auto known = [&](const Variant& v) { return compiled.contains(v); };
    if (std::all_of(own.begin(), own.end(), known)) return false;
    if (compiled.size() >= 2 * mostVariants) return true;
    compiled.insert(own.begin(), own.end());
    return false;
  };
  for (std::uint64_t i = 0; i < scenes; ++i) {
    const bool pathological = i % 2 == 1;
    RandomScene made = randomScene(bench.look(), random, pathological);
    for (int again = 0; again < 1000 && isNew(made); ++again)
      made = randomScene(bench.look(), random, pathological);
    ++report.scenes;
    report.pathological += pathological;
    try {
      const bool good = finite(bench.draw(made.scene, made.look));
      const bool reference = finite(bench.reference(made.scene, made.look));
      if (good && reference) continue;
      ++report.notFinite;
      if (report.finds.size() < mostFinds)
        report.finds.push_back("scene " + std::to_string(i) + (good ? " in the reference" : "") +
                               ", " + std::string(shadingName(made.look.shading)) + " " +
                               materialText(made.scene.materials[0]));
    } catch (const InputError&) {
      ++report.refused;
    }
    if (progress) progress(0.5 + 0.5 * double(i) / double(scenes));
  }
  report.sceneSeconds = secondsSince(drawing);
  return report;
}

std::string searchText(const SearchReport& r) {
  std::string text =
      "search: " + std::to_string(r.evaluations) + " points through " + std::to_string(r.variants) +
      " variants with " + std::to_string(r.materials) + " materials, " + std::to_string(r.scenes) +
      " scenes, " + std::to_string(r.pathological) + " of them pathological (" +
      std::to_string(r.refused) + " refused), in " +
      numberText(std::round(r.pointSeconds + r.sceneSeconds)) +
      " s: " + (r.notFinite ? std::to_string(r.notFinite) + " not finite" : "all finite") + "\n";
  for (const std::string& find : r.finds) text += "    " + find + "\n";
  return text;
}

nlohmann::ordered_json searchJson(const SearchReport& r) {
  return {{"points", r.evaluations},
          {"variants", r.variants},
          {"materials", r.materials},
          {"scenes", r.scenes},
          {"pathological", r.pathological},
          {"refused", r.refused},
          {"notFinite", r.notFinite},
          {"finds", r.finds},
          {"seconds", r.pointSeconds + r.sceneSeconds}};
}

}  // namespace glint::stability
