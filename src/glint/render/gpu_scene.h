#pragma once

#include <map>
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

/// A scene's meshes and textures in the driver's memory, each put there when first needed; a
/// software driver reads long arrays where the scene has them. Lives and dies in one context; the
/// scene must outlive it, and its meshes may change only as pose() says.
class GpuScene {
 public:
  GpuScene(const Scene& scene, DecodedImages images);
  /// With the textures of another one, which must outlive it and whose scene has the same images.
  GpuScene(const Scene& scene, GpuScene& textures);

  /// Goes on with the same scene in another pose, in which the vertices of `changed` meshes are
  /// others.
  void pose(const Scene& scene, std::span<const int> changed);

  struct Geometry {
    VertexArray array;
    std::vector<Buffer> vertices;
    Buffer indices;
    const void* inPlace = nullptr;  ///< the mesh's positions, if the driver reads them there
    GLenum mode = 0;
    GLsizei count = 0;
    std::vector<TriangleRun> runs;  ///< of triangles
  };

  /// The mesh, or for the program `flat` its faces.
  const Geometry& geometry(int mesh, bool faces);

  /// Draws it, so many times, as the state stands; with other indices, as many as its own, if there
  /// are any.
  void draw(int mesh, bool faces, std::size_t times = 1, const Buffer* indices = nullptr);
  /// Finds what may be seen of it, for drawShown(); false if nothing is.
  bool findShown(int mesh, bool faces, const RunView& view);
  /// Draws what was found, in its order.
  void drawShown(int mesh, bool faces);

  /// Binds the texture to a unit, for glsl/texture.glsl: its sampler is part of the variant.
  void bindTexture(const Texture&, GLuint unit);

  /// Whether an image has been given, be it that it was not uploaded yet; of a normal map perhaps
  /// with the lengths of its normals.
  bool hasImage(int image, bool withNormalLengths) const;
  /// Those that are there already are replaced.
  void addImages(DecodedImages&& images);

  const Scene& scene() const { return *scene_; }

  /// What had to be done to textures since it was last asked, for people.
  std::vector<std::string> takeWarnings() { return std::exchange(warnings_, {}); }

 private:
  const Scene* scene_;
  bool inPlace_;
  DecodedImages images_;
  std::vector<std::string> warnings_;
  std::map<std::pair<int, bool>, Geometry> geometries_;
  struct Uploaded {
    TextureHandle texture;
    bool hasNormalLengths = false;
  };
  std::map<int, Uploaded> textures_;
  GpuScene* shared_ = nullptr;         ///< has the textures, if not null
  std::vector<std::uint32_t> firsts_;  ///< of the stretches found last
  std::vector<std::int32_t> counts_;
  QueueLimit queue_;
};

}  // namespace glint
