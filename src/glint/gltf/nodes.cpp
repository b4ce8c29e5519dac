#include "glint/gltf/nodes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <optional>

#include "glint/gltf/accessor.h"
#include "glint/gltf/normals.h"

namespace glint::gltf {
namespace {

constexpr double largestEntry = 1e30;

std::string labelOf(const Document& document, std::size_t node) {
  return named("nodes", node, document.model.nodes[node].name);
}

bool usable(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!(std::abs(matrix[column][row]) <= largestEntry)) return false;
    }
  }
  return true;
}

/// The rotation of a quaternion of any length except 0; the standard requires length 1.
glm::dmat3 rotation(const std::vector<double>& q, bool& broken) {
  const double largest = std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3])});
  broken = !(largest > 0);
  if (broken) return glm::dmat3(1);
  const double length = std::hypot(std::hypot(q[0] / largest, q[1] / largest),
                                   std::hypot(q[2] / largest, q[3] / largest));
  const double scale = 1 / (largest * length);
  const double x = q[0] * scale, y = q[1] * scale, z = q[2] * scale, w = q[3] * scale;
  return {glm::dvec3(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
          glm::dvec3(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
          glm::dvec3(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y))};
}

glm::dmat4 localMatrix(const Document& document, std::size_t index, Messages& messages) {
  const tinygltf::Node& node = document.model.nodes[index];
  glm::dmat4 local(1);
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i) local[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    const glm::dvec4 lastRow(local[0][3], local[1][3], local[2][3], local[3][3]);
    if (lastRow != glm::dvec4(0, 0, 0, 1)) {
      messages.warn(labelOf(document, index) +
                    ": the last row of its matrix is not 0 0 0 1 and is ignored");
    }
    for (int column = 0; column < 4; ++column) local[column][3] = column == 3 ? 1 : 0;
    return local;
  }
  glm::dmat3 linear(1);
  if (node.rotation.size() == 4) {
    bool broken = false;
    linear = rotation(node.rotation, broken);
    if (broken) messages.warn(labelOf(document, index) + ": its rotation is 0 and is ignored");
  }
  if (node.scale.size() == 3) {
    for (int k = 0; k < 3; ++k) linear[k] *= node.scale[static_cast<std::size_t>(k)];
  }
  for (int k = 0; k < 3; ++k) local[k] = glm::dvec4(linear[k], 0);
  if (node.translation.size() == 3) {
    local[3] = {node.translation[0], node.translation[1], node.translation[2], 1};
  }
  return local;
}

/// The quarter or half turn that maps an axis to +Y.
glm::dmat4 upright(UpAxis up) {
  glm::dmat4 m(1);
  const auto rows = [&](const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z) {
    m = glm::dmat4(glm::transpose(glm::dmat3(x, y, z)));
  };
  switch (up) {
    case UpAxis::plusX:
      rows({0, -1, 0}, {1, 0, 0}, {0, 0, 1});
      break;
    case UpAxis::minusX:
      rows({0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
      break;
    case UpAxis::plusY:
      break;
    case UpAxis::minusY:
      rows({1, 0, 0}, {0, -1, 0}, {0, 0, -1});
      break;
    case UpAxis::plusZ:
      rows({1, 0, 0}, {0, 0, 1}, {0, -1, 0});
      break;
    case UpAxis::minusZ:
      rows({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
      break;
  }
  return m;
}

/// Reads the camera from the file's object; `unusable`, with a warning, if it cannot be shown.
FileCamera readCamera(Cursor camera, Messages& messages) {
  FileCamera result;
  result.name = camera.name();
  const std::string type = camera.required("type").text();
  const auto reject = [&](const std::string& what) {
    messages.warn(camera.path() + " " + what + " and is left out");
    result.unusable = what;
    return result;
  };
  double near = 0, far = 0;
  if (type == "perspective") {
    const Cursor lens = camera.required("perspective");
    result.viewAngle = lens.required("yfov").number(0);
    if (!(result.viewAngle > 0 && result.viewAngle < std::numbers::pi)) {
      return reject("has a yfov outside 0 to pi");
    }
    result.aspect = lens.member("aspectRatio").number(0);
    near = lens.member("znear").number(0);
    far = lens.member("zfar").number(0);
  } else if (type == "orthographic") {
    const Cursor lens = camera.required("orthographic");
    result.orthographic = true;
    result.halfHeight = std::abs(lens.required("ymag").number(0));
    if (!(result.halfHeight > 0)) return reject("has a ymag of 0");
    result.aspect = std::abs(lens.required("xmag").number(0)) / result.halfHeight;
    if (!(result.aspect > 0)) return reject("has an xmag of 0");
    near = lens.member("znear").number(0);
    far = lens.member("zfar").number(0);
  } else {
    return reject("is neither perspective nor orthographic");
  }
  if (!(result.aspect > 0 && result.aspect < 1e6)) result.aspect = 0;
  result.near = near > 0 ? near : 0;
  result.far = far > result.near ? far : 0;
  return result;
}

/// Places the camera where its node is.
void placeCamera(FileCamera& camera, const Document& document, const NodeGraph& graph,
                 std::size_t node, Messages& messages) {
  const glm::dmat4& world = graph.world[node];
  const glm::dvec3 back = direction(glm::dvec3(world[2]));
  const glm::dvec3 upward = direction(glm::dvec3(world[1]));
  const glm::dvec3 up = direction(upward - glm::dot(upward, back) * back);
  if (glm::length(back) < 0.5 || glm::length(up) < 0.5) {
    messages.warn(labelOf(document, node) + " has scale 0, so its camera is left out");
    camera.unusable = "is at a node of scale 0";
    return;
  }
  camera.world = glm::dmat4(glm::dvec4(glm::cross(up, back), 0), glm::dvec4(up, 0),
                            glm::dvec4(back, 0), world[3]);
}

/// Fills the light from the file's object; false, with a warning, if it is not usable.
bool readLight(Cursor from, FileLight& light, Messages& messages) {
  light.name = from.name();
  const std::string type = from.required("type").text();
  const bool spot = type == "spot";
  if (!spot && type != "point" && type != "directional") {
    messages.warn(from.path() + " is neither directional, point nor spot and is left out");
    return false;
  }
  light.type = spot              ? FileLight::Type::spot
               : type == "point" ? FileLight::Type::point
                                 : FileLight::Type::directional;
  const auto within = [&](const char* what, double value, double least, double most) {
    const double mended = value >= least ? std::min(value, most) : least;
    if (mended != value) {
      messages.warn(from.path() + " has the " + what + " " + Json(value).dump() +
                    ", out of range: " + Json(mended).dump() + " is used");
    }
    return mended;
  };
  const double intensity = within("intensity", from.member("intensity").number(1), 0, 1e30);
  const Cursor color = from.member("color");
  color.checkNumbers(3);
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = color.exists() ? color.item(k).number(1) : 1;
    light.intensity[static_cast<int>(k)] =
        std::min(intensity * within("colour", share, 0, 1e6), 1e30);
  }
  const double range = from.member("range").number(0);
  light.range = range > 0 && range < 1e30 ? range : 0;
  if (!spot) return true;
  const Cursor cone = from.member("spot");
  constexpr double quarter = std::numbers::pi / 2;
  light.outerAngle = within(
      "outerConeAngle", cone.member("outerConeAngle").number(std::numbers::pi / 4), 1e-4, quarter);
  // The standard requires it to be below the outer angle; this leaves the narrowest possible edge.
  light.innerAngle = within("innerConeAngle", cone.member("innerConeAngle").number(0), 0,
                            light.outerAngle * (1 - 1e-6));
  return true;
}

}  // namespace

NodeGraph readNodes(const Document& document, int scene, UpAxis up, Messages& messages) {
  const auto& nodes = document.model.nodes;
  NodeGraph graph;
  graph.world.assign(nodes.size(), glm::dmat4(1));
  graph.hidden.assign(nodes.size(), false);
  std::vector<bool> isChild(nodes.size(), false);
  for (const auto& node : nodes) {
    for (const int child : node.children) isChild[static_cast<std::size_t>(child)] = true;
  }

  // Explicit stacks: a chain of a million nodes would overflow the call stack.
  std::vector<int> roots, open;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    if (isChild[i]) continue;
    graph.world[i] = upright(up) * localMatrix(document, i, messages);
    open.push_back(static_cast<int>(i));
  }
  roots.assign(open.rbegin(), open.rend());
  while (!open.empty()) {
    const auto node = static_cast<std::size_t>(open.back());
    open.pop_back();
    if (!usable(graph.world[node])) {
      messages.fail(labelOf(document, node) +
                    " has a transform that is not finite or exceeds 1e30");
    }
    for (const int child : nodes[node].children) {
      const auto index = static_cast<std::size_t>(child);
      graph.world[index] = graph.world[node] * localMatrix(document, index, messages);
      open.push_back(child);
    }
  }

  const auto& scenes = document.model.scenes;
  if (!scenes.empty()) {
    const int chosen = scene >= 0 ? scene : std::max(document.model.defaultScene, 0);
    roots = scenes[static_cast<std::size_t>(chosen)].nodes;
  }
  std::vector<bool> seen(nodes.size(), false);
  open.assign(roots.rbegin(), roots.rend());
  while (!open.empty()) {
    const auto node = static_cast<std::size_t>(open.back());
    open.pop_back();
    if (seen[node]) continue;
    seen[node] = true;
    graph.visible.push_back(node);
    if (!document.nodeExtensions[node].visible) graph.hidden[node] = true;
    for (const int child : nodes[node].children) {
      if (graph.hidden[node]) graph.hidden[static_cast<std::size_t>(child)] = true;
    }
    open.insert(open.end(), nodes[node].children.rbegin(), nodes[node].children.rend());
  }
  return graph;
}

std::vector<glm::dmat4> placesOf(const Document& document, std::size_t node, Budget& budget,
                                 Messages& messages) {
  const auto found = document.pieces.instancing.find(node);
  if (found == document.pieces.instancing.end()) return {glm::dmat4(1)};
  std::optional<std::size_t> count;
  const auto read = [&](const char* name, int components) {
    std::vector<double> values;
    const auto attribute = found->second.find(name);
    if (attribute == found->second.end()) return values;
    const std::string label = labelOf(document, node) + " EXT_mesh_gpu_instancing " + name;
    const AccessorView view = openAccessor(document, attribute->second, label, budget, messages);
    if (view.components != components || (count && *count != view.count)) {
      messages.fail(label + " must have " + std::to_string(components) +
                    " components per instance, and as many instances as the others");
    }
    count = view.count;
    budget.read(view.count * static_cast<std::size_t>(components));
    return readFlat(view);
  };
  const auto shifts = read("TRANSLATION", 3), turns = read("ROTATION", 4),
             scales = read("SCALE", 3);
  std::vector<glm::dmat4> places(count.value_or(1), glm::dmat4(1));
  for (std::size_t i = 0; i < places.size(); ++i) {
    glm::dmat3 linear(1);
    if (!turns.empty()) {
      const auto first = turns.begin() + static_cast<std::ptrdiff_t>(4 * i);
      bool broken = false;
      linear = rotation({first, first + 4}, broken);
    }
    for (int k = 0; k < 3; ++k) {
      const std::size_t at = 3 * i + static_cast<std::size_t>(k);
      if (!scales.empty()) linear[k] *= scales[at];
      if (!shifts.empty()) places[i][3][k] = shifts[at];
    }
    for (int k = 0; k < 3; ++k) places[i][k] = glm::dvec4(linear[k], 0);
    if (!usable(places[i])) {
      messages.fail(labelOf(document, node) + ", instance " + std::to_string(i) +
                    " has a transform that is not finite or exceeds 1e30");
    }
  }
  return places;
}

std::vector<glm::dmat4> jointMatrices(const Document& document, std::size_t index,
                                      const NodeGraph& graph, Budget& budget, Messages& messages) {
  const tinygltf::Skin& skin = document.model.skins[index];
  budget.read(skin.joints.size());
  std::vector<glm::dmat4> matrices;
  matrices.reserve(skin.joints.size());
  for (const int joint : skin.joints) {
    matrices.push_back(graph.world[static_cast<std::size_t>(joint)]);
  }
  if (skin.inverseBindMatrices < 0) return matrices;
  const std::string label = named("skins", index, skin.name);
  const AccessorView view =
      openAccessor(document, skin.inverseBindMatrices, label, budget, messages);
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    float values[16];
    std::memcpy(values, view.data + i * view.stride, sizeof values);
    glm::dmat4 inverseBind;
    for (int k = 0; k < 16; ++k) inverseBind[k / 4][k % 4] = k % 4 == 3 ? k == 15 : values[k];
    matrices[i] = matrices[i] * inverseBind;
    if (!usable(matrices[i])) {
      messages.fail(label + ", joint " + std::to_string(i) +
                    " has a matrix that is not finite or exceeds 1e30");
    }
  }
  return matrices;
}

std::vector<std::pair<std::size_t, FileLight>> readLights(Document& document,
                                                          const NodeGraph& graph,
                                                          Messages& messages) {
  const Cursor list = lightsOf(Cursor(document.json, messages));
  std::vector<std::pair<std::size_t, FileLight>> lights;
  for (const std::size_t node : graph.visible) {
    const int index = document.nodeExtensions[node].light;
    if (index < 0 || graph.hidden[node]) continue;
    FileLight light;
    if (!readLight(list.item(static_cast<std::size_t>(index)), light, messages)) continue;
    const glm::dmat4& world = graph.world[node];
    light.position = glm::dvec3(world[3]);
    light.direction = -direction(glm::dvec3(world[2]));
    if (light.type != FileLight::Type::point && glm::length(light.direction) < 0.5) {
      messages.warn(labelOf(document, node) + " has scale 0, so its light is left out");
      continue;
    }
    lights.emplace_back(node, std::move(light));
  }
  return lights;
}

std::vector<FileCamera> readCameras(Document& document, const NodeGraph& graph,
                                    Messages& messages) {
  const Cursor list = Cursor(document.json, messages).member("cameras");
  std::vector<std::vector<std::size_t>> users(list.size());
  for (const std::size_t node : graph.visible) {
    const int index = document.model.nodes[node].camera;
    if (index >= 0) users[static_cast<std::size_t>(index)].push_back(node);
  }
  // A camera that cannot be shown keeps its place, so that the others keep their numbers.
  std::vector<FileCamera> cameras(users.size()), further;
  for (std::size_t i = 0; i < users.size(); ++i) {
    if (users[i].empty()) {
      cameras[i].name = list.item(i).name();
      cameras[i].unusable = "is used by no node of the scene";
      continue;
    }
    const FileCamera camera = readCamera(list.item(i), messages);
    cameras[i] = camera;
    if (!camera.unusable.empty()) continue;
    for (const std::size_t node : users[i]) {
      const bool first = node == users[i].front();
      const std::string& nodeName = document.model.nodes[node].name;
      FileCamera& placed = first ? cameras[i] : further.emplace_back(camera);
      // Further ones have the same camera's name: the node's tells them apart.
      if (placed.name.empty() || (!first && !nodeName.empty())) placed.name = nodeName;
      placeCamera(placed, document, graph, node, messages);
    }
  }
  cameras.insert(cameras.end(), further.begin(), further.end());
  return cameras;
}

}  // namespace glint::gltf
