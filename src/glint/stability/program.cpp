#include "glint/stability/program.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "glint/reference/renderer.h"
#include "glint/render/composition.h"
#include "glint/scene/camera.h"
#include "glint/shading/safe.h"

namespace glint::stability {
namespace {

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

bool perVertex(const Variant& v) { return !isPerPixel(v.program); }

int lightsOf(const Variant& v) { return v.directionalLights + v.pointLights + v.spotLights; }

// Sets the contents of the uniform blocks. The vertex stage's transforms are identities, since its
// attributes are in eye space already.
constexpr const char* setBlocks = R"(
void setBlocks(vec3 toViewer, float schlickExponent, vec3 ambient, vec3 right, vec3 up, vec3 back,
               MaterialBlock m) {
  frame.toViewer = toViewer;
  frame.schlickExponent = schlickExponent;
  frame.ambientLight = ambient;
  frame.worldFromEye = mat4(mat3(right, up, back));
  frame.projection = mat4(1.0);
  draw.eyeFromModel = mat4(1.0);
  draw.normalMatrix = mat3(1.0);
  material = m;
}
)";

constexpr const char* pixelSurface = R"(
void setSurface(vec3 n, vec3 p, bool front) {
  surfaceFront = front;
#if !UNLIT
  vNormal = n;
#if PIXEL_POSITION
  vPosition = p;
#endif
#endif
  fragment = vec4(0.0);
}
vec3 surfaceRadiance() {
  surfaceMain();
  return fragment.rgb;
}
)";

// What the fragment stage does with the light that the vertex stage passes on.
constexpr const char* vertexSurface = R"(
void setSurface(vec3 n, vec3 p, bool front) {
  surfaceFront = front;
  position = p;
  normal = n;
#if FACE_CENTER
  faceCenter = p;
#endif
}
vec3 surfaceRadiance() {
  surfaceMain();
  LightSum sum = LightSum(vDiffuse, vec3(0.0));
#if SPECULAR
  sum.specular = vSpecular;
#endif
#if TWO_SIDED
  if (!surfaceFront) {
    sum.diffuse = vBackDiffuse;
#if SPECULAR
    sum.specular = vBackSpecular;
#endif
  }
#endif
  return surfaceColor(sum, material.color, material.metalness);
}
)";

template <typename Vector>
std::vector<float> floatsOf(const std::vector<Vector>& vectors) {
  std::vector<float> floats(vectors.size() * std::size_t(Vector::length()));
  if (!floats.empty()) std::memcpy(floats.data(), vectors.data(), floats.size() * sizeof(float));
  return floats;
}

template <typename Block>
std::vector<float> floatsOfBlock(const Block& block) {
  std::vector<float> floats(sizeof(Block) / sizeof(float));
  std::memcpy(floats.data(), &block, sizeof(Block));
  return floats;
}

Mesh unlitSquare() {
  Mesh mesh;
  mesh.positions = {
      {-0.25f, -0.25f, -1}, {0.25f, -0.25f, -1}, {0.25f, 0.25f, -1}, {-0.25f, 0.25f, -1}};
  mesh.normals.assign(4, glm::vec3(0, 0, 1));
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

}  // namespace

std::vector<std::vector<float>> blockColumns(const PointScene& scene) {
  const FrameBlock& frame = scene.list.frame;
  std::vector<std::vector<float>> columns{
      floatsOfBlock(frame.toViewer), {frame.schlickExponent}, floatsOfBlock(frame.ambientLight)};
  for (int i = 0; i < 3; ++i) columns.push_back(floatsOfBlock(glm::vec3(frame.worldFromEye[i])));
  columns.push_back(floatsOfBlock(scene.item().materialBlock));
  columns.back().resize(offsetof(MaterialBlock, unused) / sizeof(float));
  return columns;
}

PointScene::PointScene(const Look& given, const Material& material) : look(given) {
  scene.name = "points";
  scene.meshes.push_back(unlitSquare());
  scene.materials.push_back(material);
  scene.instances.push_back({0, glm::dmat4(1)});
  look.cameraPosition = glm::dvec3(0);
  look.cameraFocalPoint = glm::dvec3(0, 0, -1);
  look.resolution = {1, 1};
  look.antiAliasing = {AntiAliasing::Mode::none, 1};
  list = makeDrawList(scene, boundsOf(scene), look);
}

std::string programText(const Variant& variant, const GlslSources& sources) {
  const ComposedProgram composed = compose(variant, sources, false);
  std::string text = perVertex(variant) && !variant.unlit ? composed.vertex : composed.fragment;
  text.erase(0, text.find('\n') + 1);  // #version
  // A block without an instance name leaves its members as variables; the others become structs.
  const std::string lightBlock = "layout(std140) uniform LightBlock {";
  if (const auto at = text.find(lightBlock); at != std::string::npos) {
    const auto end = text.find("};", at);
    text.erase(end, 2);
    text.erase(at, lightBlock.size());
  }
  const std::pair<const char*, const char*> changes[] = {
      {"layout(std140) uniform ", "struct "},
      {"#define VERTEX_OUT in\n", "#define VERTEX_OUT\n"},
      {"#define VERTEX_OUT out\n", "#define VERTEX_OUT\n"},
      {"#define VARYING centroid\n", "#define VARYING\n"},
      {"#define CARRIED flat\n", "#define CARRIED\n"},
      {"VARYING in ", ""},
      {"VARYING out ", ""},
      {"out vec4 fragment;", "vec4 fragment;"},
      {"void main()", "void surfaceMain()"},
      {"invariant gl_Position;", ""},
      // The exponent may differ from point to point, so its table's entries are computed.
      {"float tableEntry(int table, int place) { return lobeTables[table + (place >> 2)][place & "
       "3]; "
       "}",
       "float atStep(int steps, int place);"},
      {"tableEntry(table, ", "atStep(steps, "},
      {"gl_FrontFacing", "surfaceFront"},
      {"gl_Position", "surfacePosition"},
      {"discard;", "{ fragment = vec4(0.0); return; }"}};
  for (const auto& [from, to] : changes) replaceAll(text, from, to);
  for (int i = 0; i < 8; ++i)
    replaceAll(text, "layout(location = " + std::to_string(i) + ") in ", "");
  text = "bool surfaceFront = true;\nvec4 surfacePosition;\n#define FACE_CENTER " +
         std::to_string(variant.program == Shading::flat) + "\n" + text;
  if (variant.unlit) return text;
  if (lobeTableRows(variant) > 0)
    text +=
        "float atStep(int steps, int place) {\n"
        "  return lobeExact(1.0 - float(place) / float(steps), material.exponent);\n}\n";
  return text + "#line 1 90\n" + setBlocks + (perVertex(variant) ? vertexSurface : pixelSurface);
}

Probe& Programs::probe(const Variant& variant) {
  std::unique_ptr<Probe>& probe = probes_[variant];
  if (!probe) {
    ProbeText text;
    text.text = programText(variant, sources_);
    probe = std::make_unique<Probe>(sources_, text);
  }
  return *probe;
}

std::vector<glm::vec3> Programs::shade(const PointScene& scene, const Points& points) {
  const Variant& variant = scene.item().variant;
  std::vector<std::vector<float>> columns{
      floatsOf(points.normals), floatsOf(points.positions), {points.front ? 1.0f : 0.0f}};
  std::string function =
      "vec3 shadePoint(vec3 n, vec3 p, float front, " + std::string(blockArguments);
  for (std::vector<float>& column : blockColumns(scene)) columns.push_back(std::move(column));
  std::string body;
  for (int i = 0; i < lightsOf(variant); ++i) {
    const std::string number = std::to_string(i);
    function += ", Light light" + number;
    body += "  lights[" + number + "] = light" + number + ";\n";
    const LightEntry& entry = scene.list.lights[std::size_t(i)];
    std::vector<float> column;
    for (std::size_t row = 0; row < std::max<std::size_t>(points.lights.size(), 1); ++row) {
      LightEntry own = entry;
      if (!points.lights.empty()) own.position = points.lights[row];
      const std::vector<float> floats = floatsOfBlock(own);
      column.insert(column.end(), floats.begin(), floats.end());
    }
    columns.push_back(std::move(column));
  }
  function += ") {\n" + std::string(setTheBlocks) + body +
              "  setSurface(n, p, front > 0.5);\n  return surfaceRadiance();\n}";
  const std::vector<float> floats = probe(variant).run(function, {columns.begin(), columns.end()});
  std::vector<glm::vec3> colors(points.size());
  std::memcpy(colors.data(), floats.data(), floats.size() * sizeof(float));
  return colors;
}

std::vector<float> Programs::reflectance(const PointScene& scene, const std::vector<float>& cosines,
                                         bool entering) {
  std::vector<std::vector<float>> columns{cosines, {entering ? 1.0f : 0.0f}};
  for (std::vector<float>& column : blockColumns(scene)) columns.push_back(std::move(column));
  return probe(scene.item().variant)
      .run("float reflectanceAt(float cosine, float entering, " + std::string(blockArguments) +
               ") {\n" + setTheBlocks +
               "  vec4 b = entering > 0.5 ? material.entering : material.leaving;\n"
               "  return reflectance(cosine, Boundary(b.x, b.y, b.z, b.w));\n}",
           {columns.begin(), columns.end()});
}

namespace {

/// The reference's view of the point scene, built once for many points.
class ReferencePoints {
 public:
  explicit ReferencePoints(const PointScene& scene)
      : stage_(scene.scene, DecodedImages{}, scene.list, scene.look), frame_(stage_.frame) {}

  const reference::Surface& surface() const { return stage_.items.front().surface; }

  glm::dvec3 shade(const glm::dvec3& normal, const glm::dvec3& position, const glm::vec3* light,
                   bool front) {
    if (light && !frame_.lights.empty()) frame_.lights.front().place = glm::dvec3(*light);
    reference::Attributes a;
    a.item = 0;
    a.front = front;
    a.position = position;
    a.normal = normal;
    a.faceNormal = glm::dvec3(0, 0, 1);
    a.base = stage_.items.front().color;
    a.numbers = surface().numbers;
    const Shading program = surface().program;
    if (!isPerPixel(program)) {
      const glm::dvec3 unit = safeNormalize(normal);
      const glm::dvec3 n = surface().twoSided && !front ? -unit : unit;
      const reference::Terms carried =
          reference::lightAt(frame_, surface(), a.numbers, position, n);
      a.matte = carried.matte;
      a.specular = carried.specular;
    }
    return reference::shade(frame_, surface(), a).radiance;
  }

 private:
  reference::Stage stage_;
  reference::Frame frame_;
};

}  // namespace

std::vector<glm::dvec3> referenceShade(const PointScene& scene, const Points& points) {
  ReferencePoints reference(scene);
  std::vector<glm::dvec3> colors;
  for (std::size_t i = 0; i < points.size(); ++i)
    colors.push_back(reference.shade(glm::dvec3(points.normals[i]), glm::dvec3(points.positions[i]),
                                     points.lights.empty() ? nullptr : &points.lights[i],
                                     points.front));
  return colors;
}

std::vector<double> referenceReflectance(const PointScene& scene, const std::vector<float>& cosines,
                                         bool entering) {
  // In a white room without lights, a dielectric shows its reflectance.
  ReferencePoints reference(scene);
  std::vector<double> values;
  for (float cosine : cosines) {
    const double c = std::clamp(double(cosine), 0.0, 1.0);
    const glm::dvec3 n(0, 0, entering ? 1 : -1), p(std::sqrt((1 - c) * (1 + c)), 0, -c);
    values.push_back(reference.shade(n, p, nullptr, entering).x);
  }
  return values;
}

}  // namespace glint::stability
