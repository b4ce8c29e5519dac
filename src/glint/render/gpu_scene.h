#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "glint/gl/handles.h"
#include "glint/gl/queue_limit.h"
#include "glint/render/decode.h"
#include "glint/render/triangle_runs.h"
#include "glint/scene/scene.h"

namespace glint {

/// A scene's meshes and textures in the driver's memory, each uploaded when first needed; a
/// software driver reads long arrays from the scene's own memory. Belongs to one context for its
/// whole lifetime; the scene must outlive it, and its meshes may change only as pose() says.
class GpuScene {
 public:
  GpuScene(const Scene& scene, DecodedImages images);
  /// Shares the textures of another one, which must outlive it and whose scene has the same images.
  GpuScene(const Scene& scene, GpuScene& textures);

  /// Continues with the same scene in another pose, in which the vertices of the `changed` meshes
  /// differ.
  void pose(const Scene& scene, std::span<const int> changed);

  struct Geometry {
    VertexArray array;
    std::vector<Buffer> vertices;
    Buffer indices;
    const void* inPlace = nullptr;  ///< the mesh's positions, if the driver reads them there
    GLenum mode = 0;
    GLsizei count = 0;
    std::vector<TriangleRun> runs;  ///< only for triangles
  };

  /// The mesh, or its faces for the program `flat`.
  const Geometry& geometry(int mesh, bool faces);

  /// Draws the mesh `times` times with the current GL state. `indices`, if given, replace its own
  /// and must be as many.
  void draw(int mesh, bool faces, std::size_t times = 1, const Buffer* indices = nullptr);
  /// Finds the parts of the mesh that may be seen, for drawShown(); false if there are none.
  bool findShown(int mesh, bool faces, const RunView& view);
  /// Draws the parts found, in the mesh's order.
  void drawShown(int mesh, bool faces);

  /// Binds the texture to a unit, for glsl/texture.glsl: its sampler is part of the variant.
  void bindTexture(const Texture&, GLuint unit);

  /// Whether an image has been given, uploaded or not; for a normal map, with the lengths of its
  /// normals if asked for.
  bool hasImage(int image, bool withNormalLengths) const;
  /// Replaces images that are there already.
  void addImages(DecodedImages&& images);

  const Scene& scene() const { return *scene_; }

  /// Adds a warning, unless it is empty or was given before.
  void warn(const std::string& text) {
    if (!text.empty() && warned_.insert(text).second) warnings_.push_back(text);
  }
  /// Warnings since the last call, for users.
  std::vector<std::string> takeWarnings() { return std::exchange(warnings_, {}); }

 private:
  const Scene* scene_;
  bool inPlace_;
  DecodedImages images_;
  std::vector<std::string> warnings_;
  std::set<std::string> warned_;
  std::map<std::pair<int, bool>, Geometry> geometries_;
  struct Uploaded {
    TextureHandle texture;
    bool hasNormalLengths = false;
  };
  std::map<int, Uploaded> textures_;
  GpuScene* shared_ = nullptr;         ///< has the textures, if not null
  std::vector<std::uint32_t> firsts_;  ///< of the index ranges found last
  std::vector<std::int32_t> counts_;
  QueueLimit queue_;
};

}  // namespace glint
