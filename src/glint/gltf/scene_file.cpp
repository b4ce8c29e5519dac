#include "glint/gltf/scene_file.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <new>
#include <set>
#include <tuple>
#include <utility>

#include "glint/gltf/animation.h"
#include "glint/gltf/document.h"
#include "glint/gltf/material.h"
#include "glint/gltf/mesh.h"
#include "glint/gltf/nodes.h"
#include "glint/gltf/texture.h"
#include "glint/image/error.h"
#include "glint/scene/lights.h"

namespace glint {
namespace {

using namespace gltf;

/// More pieces than a picture can show; many nodes may share a mesh with many primitives.
constexpr std::size_t maxInstances = std::size_t(1) << 22;

/// The index of the entry with this name, or the index given as a number.
std::size_t findNamed(const std::vector<std::string>& names, const std::string& text,
                      const std::string& option, const std::string& kind,
                      const std::string& model) {
  if (const auto found = std::ranges::find(names, text); found != names.end())
    return static_cast<std::size_t>(found - names.begin());
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size() && number < names.size())
    return number;
  std::string known;
  for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 20); ++i) {
    const std::string name = glint::printable(names[i], 80);
    known += (i ? ", " : "") + std::to_string(i) + (name.empty() ? "" : " '" + name + "'");
  }
  throw InputError(
      option + ": " + model + " has no " + kind + " '" + glint::printable(text, 80) +
      "': " + (known.empty() ? "the file has none: leave the option out" : "use " + known));
}

}  // namespace

std::size_t findAnimation(const Scene& scene, const std::string& text) {
  if (text.empty()) return 0;
  std::vector<std::string> names;
  for (const FileAnimation& each : scene.animations) names.push_back(each.name);
  return findNamed(names, text, "--animation", "animation", scene.name);
}

PoseRequest poseOf(const Look& look) {
  return {look.animationTime, look.animation, look.scene, look.variant, look.up};
}

struct SceneFile::State {
  explicit State(const std::filesystem::path& path)
      : messages(path), document(readDocument(path, messages)) {
    name = start.name = path.stem().string();
    TextureReader textures(document, messages);
    start.materials = readMaterials(document, textures, messages);
    start.images = textures.takeImages();
    Budget budget(document.geometryBytes, messages);
    start.animations = listAnimations(document, budget, messages);
    start.extensions = std::move(document.extensions);
    for (const tinygltf::Scene& each : document.model.scenes)
      start.scenes.push_back(glint::printable(each.name, 80));
    for (const std::string& each : document.variants)
      start.variants.push_back(glint::printable(each, 80));
    start.skins = std::move(document.skins);
    start.morphs = std::move(document.morphs);
  }

  struct Part {
    int mesh = -1;
    bool drawn = false;
    bool skinned = false;
  };
  /// The primitives of a mesh in one shape.
  struct Shape {
    std::vector<Part> parts;
    bool stale = false;  ///< its primitives' materials have changed
    bool moves = false;  ///< its vertices may change with the pose
    int pass = 0;        ///< the number of the posing that built it
  };
  /// Mesh, skin, the node whose weights an animation moves (or -1), and static weights.
  using Key = std::tuple<int, int, int, std::vector<double>>;

  void applyAnimation(const PoseRequest& request, Scene& scene, Budget& budget);
  void play(std::size_t animation, double time, Budget& budget);
  void applyVariant(const std::string& wanted);
  int findScene(const std::string& text) const;
  void place(std::size_t node, const NodeGraph& graph, Scene& scene, Budget& budget);
  const std::vector<Part>& shape(const Key& key, Pose pose, const NodeGraph& graph, Scene& scene,
                                 Budget& budget);
  void build(const PoseRequest& request, Scene& scene);
  void placeLights(const NodeGraph& graph, Scene& scene);

  std::string name;  ///< of the model, in messages
  Messages messages;
  Document document;
  Scene start;
  std::map<std::size_t, Animation> animations;    ///< read so far
  std::map<std::size_t, tinygltf::Node> atRest;   ///< original nodes that an animation has moved
  std::set<std::size_t> weightsMoved;             ///< nodes, in the current pose
  std::optional<std::set<std::size_t>> lightsOn;  ///< nodes of the lights in use
  std::map<Key, Shape> shapes;
  std::string variant;  ///< of the primitives' current materials
  std::map<std::pair<std::size_t, std::size_t>, int> plain;  ///< primitives' default materials
  int pass = 0;
  std::vector<int> changed;
  std::set<std::string> told;
};

/// Sets the document's nodes to the pose; everything else then uses the document.
void SceneFile::State::applyAnimation(const PoseRequest& request, Scene& scene, Budget& budget) {
  for (const auto& [index, node] : atRest) document.model.nodes[index] = node;
  weightsMoved.clear();
  const bool all = request.animation == "all";
  if (!all && !request.animation.empty()) findAnimation(scene, request.animation);
  if (!request.time) return;
  if (scene.animations.empty()) {
    messages.warn("has no animation, shown at rest");
    return;
  }
  if (!all) return play(findAnimation(scene, request.animation), *request.time, budget);
  for (std::size_t i = 0; i < scene.animations.size(); ++i) play(i, *request.time, budget);
}

void SceneFile::State::play(std::size_t index, double time, Budget& budget) {
  auto found = animations.find(index);
  if (found == animations.end()) {
    found = animations.emplace(index, readAnimation(document, index, budget, messages)).first;
  }
  for (const Channel& channel : found->second.channels) {
    tinygltf::Node& node = document.model.nodes[channel.node];
    atRest.try_emplace(channel.node, node);
    std::vector<double> value = valueAt(found->second.keys[channel.keys], channel.width,
                                        channel.path == AnimatedPath::rotation, time);
    switch (channel.path) {
      case AnimatedPath::translation:
        node.translation = std::move(value);
        break;
      case AnimatedPath::rotation:
        node.rotation = std::move(value);
        break;
      case AnimatedPath::scale:
        node.scale = std::move(value);
        break;
      case AnimatedPath::weights:
        node.weights = std::move(value);
        weightsMoved.insert(channel.node);
        break;
    }
  }
}

/// Assigns a variant's materials to the primitives. The meshes are then rebuilt, since a material
/// determines which data of a primitive are read.
void SceneFile::State::applyVariant(const std::string& wanted) {
  if (wanted == variant) return;
  int number = -1;
  if (!wanted.empty()) {
    number = static_cast<int>(findNamed(document.variants, wanted, "--variant", "variant", name));
  }
  for (const auto& [place, materials] : document.pieces.variantMaterials) {
    int& material = document.model.meshes[place.first].primitives[place.second].material;
    const int standard = plain.try_emplace(place, material).first->second;
    const auto found = materials.find(number);
    material = found == materials.end() ? standard : found->second;
  }
  variant = wanted;
  for (auto& [key, shape] : shapes) shape.stale = true;
}

int SceneFile::State::findScene(const std::string& text) const {
  if (text.empty()) return -1;
  std::vector<std::string> names;
  for (const tinygltf::Scene& each : document.model.scenes) names.push_back(each.name);
  return static_cast<int>(findNamed(names, text, "--scene", "scene", name));
}

/// Builds a mesh once for each shape in which it is placed.
const std::vector<SceneFile::State::Part>& SceneFile::State::shape(const Key& key, Pose pose,
                                                                   const NodeGraph& graph,
                                                                   Scene& scene, Budget& budget) {
  const auto [entry, isNew] = shapes.try_emplace(key);
  Shape& result = entry->second;
  if (!isNew && !result.stale && (!result.moves || result.pass == pass)) return result.parts;
  result.stale = false;
  const int mesh = std::get<0>(key), skin = std::get<1>(key);
  result.moves = skin >= 0 || std::get<2>(key) >= 0;
  result.pass = pass;
  if (skin >= 0) {
    pose.joints = jointMatrices(document, static_cast<std::size_t>(skin), graph, budget, messages);
  }
  const auto index = static_cast<std::size_t>(mesh);
  const std::size_t count = document.model.meshes[index].primitives.size();
  budget.read(count);
  result.parts.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    Part& part = result.parts[i];
    std::optional<BuiltMesh> built =
        buildMesh(document, index, i, pose, scene.materials, budget, messages);
    part.drawn = built.has_value();
    if (!built) continue;
    part.skinned = built->skinned;
    if (part.mesh < 0) {
      part.mesh = static_cast<int>(scene.meshes.size());
      scene.meshes.emplace_back();
    }
    Mesh& made = scene.meshes[static_cast<std::size_t>(part.mesh)];
    // Findings about its texels hold in every pose with the same coordinates.
    built->mesh.opaqueTexels = made.opaqueTexels && made.texcoords == built->mesh.texcoords;
    made = std::move(built->mesh);
    made.fileMesh = mesh;
    changed.push_back(part.mesh);
  }
  return result.parts;
}

void SceneFile::State::place(std::size_t index, const NodeGraph& graph, Scene& scene,
                             Budget& budget) {
  const tinygltf::Node& node = document.model.nodes[index];
  if (node.mesh < 0 || graph.hidden[index]) return;
  const auto& mesh = document.model.meshes[static_cast<std::size_t>(node.mesh)];
  Pose pose;
  pose.weights = node.weights.empty() ? mesh.weights : node.weights;
  budget.read(pose.weights.size());
  if (!pose.morphs()) pose.weights.clear();
  const bool moves = weightsMoved.contains(index);
  const Key key(node.mesh, node.skin, moves ? static_cast<int>(index) : -1,
                moves ? std::vector<double>() : pose.weights);
  const std::vector<glm::dmat4> places = placesOf(document, index, budget, messages);
  const int first = static_cast<int>(scene.objects.size());
  int placed = 0;
  for (const Part& part : shape(key, std::move(pose), graph, scene, budget)) {
    if (!part.drawn) continue;
    if (scene.instances.size() + places.size() > maxInstances) {
      messages.fail("has more than 4194304 draws", "split the model");
    }
    // A skinned mesh is positioned by its joints, whatever its node's transform.
    if (part.skinned) {
      scene.instances.push_back({part.mesh, glm::dmat4(1), first});
      placed = std::max(placed, 1);
      continue;
    }
    placed = static_cast<int>(places.size());
    for (int i = 0; i < placed; ++i) {
      const glm::dmat4 world = graph.world[index] * places[static_cast<std::size_t>(i)];
      scene.instances.push_back({part.mesh, world, first + i});
    }
  }
  scene.objects.resize(scene.objects.size() + static_cast<std::size_t>(placed),
                       {static_cast<int>(index), node.mesh});
}

void SceneFile::State::placeLights(const NodeGraph& graph, Scene& scene) {
  scene.lights.clear();
  std::vector<std::size_t> nodes;
  for (auto& [node, light] : readLights(document, graph, messages)) {
    if (lightsOn && !lightsOn->contains(node)) continue;
    nodes.push_back(node);
    scene.lights.push_back(std::move(light));
  }
  if (lightsOn || scene.lights.empty()) return;
  const LightMeter meter = meterLights(scene);
  scene.lightScale = meter.scale;
  const bool hasSurface = std::ranges::any_of(scene.instances, [&](const Instance& instance) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    return mesh.topology == Topology::triangles &&
           !scene.materials[static_cast<std::size_t>(mesh.material)].unlit;
  });
  for (std::size_t i = 0; hasSurface && i < scene.lights.size(); ++i) {
    if (meter.shares[i] > 0 || scene.lights[i].intensity == glm::dvec3(0)) continue;
    messages.warn("the light " + named("nodes", nodes[i], document.model.nodes[nodes[i]].name) +
                  " reaches no surface from its front, so it lights nothing");
  }
  lightsOn.emplace(nodes.begin(), nodes.end());
  if (nodes.size() <= maxLights) return;
  messages.warn("has " + std::to_string(nodes.size()) + " lights: only the " +
                std::to_string(maxLights) + " that contribute most are used");
  std::vector<std::size_t> order(nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return meter.shares[i]; });
  order.erase(order.begin() + std::ptrdiff_t(maxLights), order.end());
  std::ranges::sort(order);
  std::vector<FileLight> kept;
  lightsOn->clear();
  for (const std::size_t i : order) {
    kept.push_back(std::move(scene.lights[i]));
    lightsOn->insert(nodes[i]);
  }
  scene.lights = std::move(kept);
}

void SceneFile::State::build(const PoseRequest& request, Scene& scene) {
  try {
    Budget budget(document.geometryBytes, messages);
    ++pass;
    changed.clear();
    applyAnimation(request, scene, budget);
    applyVariant(request.variant);
    const NodeGraph graph = readNodes(document, findScene(request.scene), request.up, messages);
    scene.cameras = readCameras(document, graph, messages);
    scene.instances.clear();
    scene.objects.clear();
    for (const std::size_t node : graph.visible) place(node, graph, scene, budget);
    if (scene.instances.empty()) messages.warn("nothing to draw");
    placeLights(graph, scene);
    for (std::string& warning : messages.take()) {
      if (told.insert(warning).second) scene.warnings.push_back(std::move(warning));
    }
  } catch (const std::bad_alloc&) {
    messages.fail("does not fit into memory", "split the model");
  }
}

SceneFile::SceneFile(const std::filesystem::path& path) {
  try {
    state_ = std::make_unique<State>(path);
  } catch (const std::bad_alloc&) {
    gltf::Messages(path).fail("does not fit into memory", "split the model");
  }
}

SceneFile::~SceneFile() = default;
SceneFile::SceneFile(SceneFile&&) noexcept = default;
SceneFile& SceneFile::operator=(SceneFile&&) noexcept = default;

Scene SceneFile::take(const PoseRequest& request) {
  Scene scene = std::move(state_->start);
  // The lights' scale is measured in the rest pose, so that it is the same at every time.
  PoseRequest rest = request;
  rest.time.reset();
  if (request.time && gltf::lightsOf(gltf::Cursor(state_->document.json, state_->messages)).size())
    state_->build(rest, scene);
  state_->build(request, scene);
  return scene;
}

std::vector<int> SceneFile::pose(Scene& scene, const PoseRequest& request) {
  state_->build(request, scene);
  return std::move(state_->changed);
}

Scene loadGltf(const std::filesystem::path& path, const PoseRequest& request) {
  return SceneFile(path).take(request);
}

}  // namespace glint
