#include "glint/scene/gltf.h"

#include <map>
#include <new>
#include <optional>
#include <tuple>
#include <utility>

#include "glint/scene/gltf_document.h"
#include "glint/scene/gltf_material.h"
#include "glint/scene/gltf_mesh.h"
#include "glint/scene/gltf_nodes.h"
#include "glint/scene/gltf_texture.h"

namespace glint {
namespace {

using namespace gltf;

/// More pieces than a picture can show; many nodes may share a mesh of many primitives.
constexpr std::size_t maxInstances = std::size_t(1) << 22;

/// Places the meshes that the nodes show. A mesh is read once for each pose in which it stands.
class SceneBuilder {
 public:
  SceneBuilder(const Document& document, const NodeGraph& graph, Scene& scene, Messages& messages)
      : document_(document),
        graph_(graph),
        scene_(scene),
        budget_(document.geometryBytes, messages),
        messages_(messages) {}

  void place(std::size_t index) {
    const tinygltf::Node& node = document_.model.nodes[index];
    if (node.mesh < 0) return;
    const auto& mesh = document_.model.meshes[static_cast<std::size_t>(node.mesh)];
    Pose pose;
    pose.weights = node.weights.empty() ? mesh.weights : node.weights;
    budget_.read(pose.weights.size());
    if (!pose.morphs()) pose.weights.clear();
    for (const Part& part : parts(node.mesh, node.skin, std::move(pose))) {
      if (scene_.instances.size() == maxInstances) {
        messages_.fail("draws more than 4194304 pieces", "split the model");
      }
      scene_.instances.push_back({part.mesh, part.skinned ? glm::dmat4(1) : graph_.world[index]});
    }
  }

 private:
  struct Part {
    int mesh = 0;
    bool skinned = false;
  };
  using Key = std::tuple<int, int, std::vector<double>>;  // mesh, skin, weights

  const std::vector<Part>& parts(int mesh, int skin, Pose pose) {
    const auto [entry, isNew] = parts_.try_emplace(Key(mesh, skin, pose.weights));
    if (!isNew) return entry->second;
    if (skin >= 0) {
      pose.joints =
          jointMatrices(document_, static_cast<std::size_t>(skin), graph_, budget_, messages_);
    }
    const auto index = static_cast<std::size_t>(mesh);
    const std::size_t count = document_.model.meshes[index].primitives.size();
    budget_.read(count);
    for (std::size_t i = 0; i < count; ++i) {
      std::optional<BuiltMesh> built =
          buildMesh(document_, index, i, pose, scene_.materials, budget_, messages_);
      if (!built) continue;
      entry->second.push_back({static_cast<int>(scene_.meshes.size()), built->skinned});
      scene_.meshes.push_back(std::move(built->mesh));
    }
    return entry->second;
  }

  const Document& document_;
  const NodeGraph& graph_;
  Scene& scene_;
  Budget budget_;
  Messages& messages_;
  std::map<Key, std::vector<Part>> parts_;
};

}  // namespace

Scene loadGltf(const std::filesystem::path& path) {
  Messages messages(path);
  try {
    Document document = readDocument(path, messages);
    Scene scene;
    scene.name = path.stem().string();
    TextureReader textures(document, messages);
    scene.materials = readMaterials(document, textures, messages);
    scene.images = textures.takeImages();
    const NodeGraph graph = readNodes(document, messages);
    scene.cameras = readCameras(document, graph, messages);
    SceneBuilder builder(document, graph, scene, messages);
    for (const std::size_t node : graph.visible) builder.place(node);
    if (scene.instances.empty()) messages.warn("nothing to draw");
    scene.warnings = messages.take();
    return scene;
  } catch (const std::bad_alloc&) {
    messages.fail("does not fit into memory", "split the model");
  }
}

}  // namespace glint
