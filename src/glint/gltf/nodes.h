#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "glint/gltf/document.h"
#include "glint/scene/scene.h"

namespace glint::gltf {

/// The nodes' transforms, and which nodes the scene shows.
struct NodeGraph {
  std::vector<glm::dmat4> world;     ///< node to world, one per node; last row 0 0 0 1
  std::vector<std::size_t> visible;  ///< parents before children, in the file's order
  /// Nodes whose meshes and lights are hidden (KHR_node_visibility), one entry per node.
  std::vector<bool> hidden;
};

/// Shows the scene with index `scene`; for -1 the one that the file selects, else its first, else
/// all root nodes. Everything is rotated so that `up` points along +Y. Fails on transforms that are
/// not finite or beyond 1e30, which no single-precision picture can hold.
NodeGraph readNodes(const Document& document, int scene, UpAxis up, Messages& messages);

/// The placements of a node's mesh in the node's space: one, or those of EXT_mesh_gpu_instancing.
std::vector<glm::dmat4> placesOf(const Document& document, std::size_t node, Budget& budget,
                                 Messages& messages);

/// The joint's world matrix times its inverse bind matrix, for each joint of a skin.
std::vector<glm::dmat4> jointMatrices(const Document& document, std::size_t skin,
                                      const NodeGraph& graph, Budget& budget, Messages& messages);

/// The lights of the nodes that the scene shows, in node order, with their nodes' indices. The
/// nodes' scale does not change a light. Values out of range are corrected with a warning.
std::vector<std::pair<std::size_t, FileLight>> readLights(Document& document,
                                                          const NodeGraph& graph,
                                                          Messages& messages);

/// The file's cameras as Scene::cameras has them. Their world matrices are reduced
/// to rotation and translation: a node's scale and shear do not change a camera.
std::vector<FileCamera> readCameras(Document& document, const NodeGraph& graph, Messages& messages);

}  // namespace glint::gltf
