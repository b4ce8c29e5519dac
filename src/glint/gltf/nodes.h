#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "glint/gltf/document.h"
#include "glint/scene/scene.h"

namespace glint::gltf {

/// Where the nodes stand and which of them the scene shows.
struct NodeGraph {
  std::vector<glm::dmat4> world;     ///< node to world, one a node; last row 0 0 0 1
  std::vector<std::size_t> visible;  ///< parents before children, in the file's order
  /// Nodes whose meshes and lights are hidden (KHR_node_visibility), one entry a node.
  std::vector<bool> hidden;
};

/// The scene shown is that number `scene`; for -1 the one that the file names, else its first, else
/// all root nodes. The whole is turned so that `up` points along +Y. Fails on
/// transforms that are not finite or beyond 1e30, which no single-precision picture can hold.
NodeGraph readNodes(const Document& document, int scene, UpAxis up, Messages& messages);

/// Where a node's mesh stands in the node's space: once, or as often as EXT_mesh_gpu_instancing
/// says.
std::vector<glm::dmat4> placesOf(const Document& document, std::size_t node, Budget& budget,
                                 Messages& messages);

/// Joint's world times inverse bind matrix, for each joint of a skin.
std::vector<glm::dmat4> jointMatrices(const Document& document, std::size_t skin,
                                      const NodeGraph& graph, Budget& budget, Messages& messages);

/// The lights of the nodes that the scene shows, in the order of the nodes, and their nodes.
/// The nodes' scale does not change a light. What is out of range is mended with a warning.
std::vector<std::pair<std::size_t, FileLight>> readLights(Document& document,
                                                          const NodeGraph& graph,
                                                          Messages& messages);

/// The cameras of the nodes that the scene shows, in the order of the nodes, their world matrices
/// made rotations and translations: scale and shear of the node do not change a camera.
std::vector<FileCamera> readCameras(Document& document, const NodeGraph& graph, Messages& messages);

}  // namespace glint::gltf
