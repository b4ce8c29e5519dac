#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "glint/scene/look.h"
#include "glint/shading/pbr_conversion.h"

namespace glint {

/// How a mesh is drawn. Strips, fans and loops are converted to these on loading.
enum class Topology { points, lines, triangles };

/// A drawable with one material: a glTF primitive, validated and ready for upload. Every index is
/// in range and every value finite; triangles have unit normals.
struct Mesh {
  Topology topology = Topology::triangles;
  /// Model space; `positions` are relative to it. Only non-zero if the mesh is so far from its own
  /// origin that float positions would lose digits when transformed.
  glm::dvec3 origin{0.0};
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< unit length, one per position; triangles always have them,
                                   ///< points and lines without are unlit
  /// xyz: unit vector towards the right of the normal map's picture; w: its handedness (1 or -1).
  /// One per position; empty unless the material has a normal map and the mesh has coordinates for
  /// it.
  std::vector<glm::vec4> tangents;
  /// Linear RGB and alpha, one per position, or empty (glTF COLOR_0).
  std::vector<glm::vec4> colors;
  /// texcoords[set] has one per position, or is empty; only sets that the material's textures use.
  /// A set that a texture uses may be missing: the mesh is then drawn without that texture.
  std::vector<std::vector<glm::vec2>> texcoords;
  std::vector<std::uint32_t> indices;  ///< never empty for a mesh that is drawn
  /// In some triangle the vertex normals are so far apart that their interpolation may vanish.
  bool normalsMayCancel = false;
  /// Alpha is 1 in all texels of the colour texture that the mesh shows. Known once the texture is
  /// decoded, and only determined if the material blends.
  bool opaqueTexels = false;
  int material = 0;   ///< index into Scene::materials
  int fileMesh = -1;  ///< index in the file of the mesh whose primitive this is; -1: none
};

enum class Wrap { repeat, clampToEdge, mirroredRepeat };
enum class Filter { nearest, linear };
enum class MipFilter { none, nearest, linear };

/// How a texture is sampled, as in glTF. A texture without a sampler repeats and is filtered
/// trilinearly.
struct Sampler {
  Filter magnify = Filter::linear;
  Filter minify = Filter::linear;
  MipFilter mip = MipFilter::linear;
  Wrap wrapS = Wrap::repeat;
  Wrap wrapT = Wrap::repeat;

  auto operator<=>(const Sampler&) const = default;
};

/// How to convert the two pictures of KHR_materials_pbrSpecularGlossiness into one, texel by texel
/// with convertSpecularGlossiness().
struct GlossPicture {
  bool isColor = false;  ///< gives C and alpha; else G roughness, B metallic, A reflectance
  int other = -1;        ///< the second picture, in Scene::images; -1: white
  SpecularGlossiness factors;
};

/// A picture as stored in the file: PNG, JPEG or WebP bytes, decoded only when needed.
struct EncodedImage {
  std::string name;  ///< for messages: the file, or the place in the model file
  std::vector<std::byte> bytes;
  bool isData = false;  ///< numbers, as in a normal map, not sRGB colours
  /// The conversion: the diffuse picture becomes colours, the other one numbers.
  std::optional<GlossPicture> gloss{};
  bool isNormalMap = false;  ///< used for nothing else, so its alpha is free (normal_lengths.h)
};

/// The picture and texture coordinates that a material uses; empty means none.
struct Texture {
  int image = 0;  ///< index into Scene::images
  int texcoord = 0;
  Sampler sampler;
  /// From the mesh's texture coordinates to the picture's: columns for u, v and 1
  /// (KHR_texture_transform).
  glm::dmat3x2 transform{1.0};
};

enum class AlphaMode { opaque, mask, blend };

/// Phong's material: what `extras.glint`, `--material` and the panel set.
struct ShadingParameters {
  double ambient = 1.0;    ///< m_a, [0, 1e6]
  double diffuse = 1.0;    ///< m_d, [0, 1e6]
  double specular = 0.0;   ///< m_s, [0, 1e6]
  double exponent = 20.0;  ///< m_sp, Phong's alpha, [0, 1e6]
  double metalness = 0.0;  ///< m_sm in [0, 1]: 1 colours the highlight by `color`, 0 is white
  double ior = 1.5;        ///< n, [1e-3, 1e3]
  glm::dvec3 color{1.0};   ///< C, linear, components [0, 1e6]; multiplies texture and vertex colour
  double transmission = 0.0;  ///< t in [0, 1], read by the program `environment`
};

/// Parameters that textures supply, as bits. Where a material has such a texture, the parameter is
/// computed per pixel from its texels instead of the number in ShadingParameters. A number given by
/// the user replaces the texture.
namespace textured {
enum : unsigned {
  ambient = 1,
  diffuse = 2,
  specular = 4,
  exponent = 8,
  metalness = 16,
  transmission = 32
};
}

/// Textures of numbers, not colours, and their factors (formulas in docs/materials.md).
struct ParameterTextures {
  std::optional<Texture> metallicRoughness;  ///< G roughness, B metallic
  std::optional<Texture> occlusion;          ///< R share of the ambient light
  std::optional<Texture> specular;         ///< A share of the reflectance (KHR_materials_specular)
  std::optional<Texture> transmission;     ///< R share of t (KHR_materials_transmission)
  double metallic = 1.0, roughness = 1.0;  ///< [0, 1]
  double reflectance = 0.04;  ///< of the dielectric at normal incidence, strength included, [0, 1]
  double occlusionStrength = 1.0;  ///< [0, 1]
};

/// Textures that are not used although the material has them, as bits.
namespace switchedOff {
enum : unsigned { color = 1, normal = 2, emission = 4 };
}

struct Material {
  /// Never empty: a nameless one is called "#N", N its index in the file from 0, and glTF's default
  /// material "#default".
  std::string name;
  int index = -1;           ///< index into Scene::materials, -1: not in a scene
  int nth = 0;              ///< index among the materials of the same name
  bool nameShared = false;  ///< other materials have the same name
  ShadingParameters shading;
  /// The share of the arriving light that the highlight reflects, from which shading.specular was
  /// converted; replaces m_s with --normalization. Empty if the file gives m_s itself.
  std::optional<double> highlightShare = {};
  double alpha = 1.0;        ///< multiplied by the texture's and the vertex colour's, [0, 1]
  glm::dvec3 emission{0.0};  ///< linear radiance added to the sum
  std::optional<Texture> colorTexture;     ///< sRGB colour and alpha
  std::optional<Texture> emissionTexture;  ///< sRGB
  std::optional<Texture> normalTexture;    ///< x right, y up, z out of the surface: 2 texel - 1
  double normalScale = 1.0;                ///< multiplies its x and y
  ParameterTextures parameterTextures;
  unsigned textured = 0;     ///< bits of namespace textured: what those textures supply
  unsigned switchedOff = 0;  ///< bits of namespace switchedOff, from extras.glint
  /// Properties in the file that no program uses, as "the ..." for messages.
  std::vector<std::string> unusedProperties;
  AlphaMode alphaMode = AlphaMode::opaque;
  double alphaCutoff = 0.5;  ///< for AlphaMode::mask
  bool doubleSided = false;
  bool unlit = false;  ///< shows only its colour
  /// Forms that a look sets for this material instead of its own.
  std::optional<HighlightForms> highlight;
  std::optional<Fresnel> fresnel;
};

/// One mesh placed in the world.
struct Instance {
  int mesh = 0;
  glm::dmat4 world{1.0};  ///< model to world; the last row is 0 0 0 1
  int object = -1;        ///< index into Scene::objects; -1: none
};

/// A mesh of the file placed by a node: all of its primitives together.
struct FileObject {
  int node = 0, mesh = 0;  ///< indices in the file
};

/// A camera of the file. It looks along -Z of its own space, +Y up; `world` is a rigid motion.
struct FileCamera {
  std::string name;
  glm::dmat4 world{1.0};
  bool orthographic = false;
  double viewAngle = 0.6;   ///< radians, vertical; perspective only
  double halfHeight = 1.0;  ///< world units; orthographic only
  double aspect = 0.0;      ///< width / height of its frame; 0: determined by the picture
  double near = 0.0;        ///< 0 if the file gives none
  double far = 0.0;         ///< 0 if the file gives none (infinite)
  /// Why it cannot be shown, as "is ..." or "has ..." for messages; empty if it can.
  std::string unusable = {};
};

/// A light of the file (KHR_lights_punctual).
struct FileLight {
  enum class Type { directional, point, spot };
  std::string name;
  Type type = Type::directional;
  glm::dvec3 position{0.0};        ///< world; point and spot
  glm::dvec3 direction{0, 0, -1};  ///< unit, world: where it shines; directional and spot
  /// Colour times intensity, linear: lux (directional) or candela (point and spot; metres are world
  /// units), components [0, 1e30].
  glm::dvec3 intensity{1.0};
  double range = 0;  ///< world units: no light beyond; 0 for unlimited
  double innerAngle = 0.0, outerAngle = 0.785398163397448;  ///< radians from the spot's axis
};

struct FileAnimation {
  std::string name;     ///< may be empty
  double duration = 0;  ///< seconds, from 0 to the last key frame
};

/// A glTF extension that the file names, and how it is handled.
struct FileExtension {
  enum class Use { read, approximated, ignored, unseen };  ///< unseen: has no visible effect
  std::string name;
  Use use = Use::ignored;
  std::string note;       ///< extent of support, may be empty; or the reason, to follow "which is"
  bool required = false;  ///< by the file
};

struct FileSkin {
  std::string name;                 ///< may be empty
  std::vector<std::string> joints;  ///< their nodes' names, which may be empty
};

/// A mesh of the file that has morph targets.
struct FileMorph {
  std::string name;                  ///< may be empty
  std::vector<std::string> targets;  ///< their names, which may be empty
};

/// Everything that is drawn, by value. World space: +Y up, right-handed, metres as glTF defines.
struct Scene {
  std::string name;  ///< file name without folder and extension
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<FileObject> objects;  ///< from a file; empty if the scene was made otherwise
  std::vector<Material> materials;  ///< never empty: the last one is glTF's default material
  std::vector<EncodedImage> images;
  /// At the index that each has in the file, placed by the first node of the scene that uses it;
  /// then, camera by camera, by the further nodes that use one.
  std::vector<FileCamera> cameras;
  std::vector<FileLight> lights;
  /// The factor for the file's lights unless a look sets one; see lights.h.
  double lightScale = 1;
  std::vector<FileAnimation> animations;
  std::vector<std::string> scenes;        ///< of all scenes in the file; names may be empty
  std::vector<std::string> variants;      ///< likewise, of its material variants
  std::vector<FileExtension> extensions;  ///< for `glint info`, as are skins and morphs
  std::vector<FileSkin> skins;
  std::vector<FileMorph> morphs;
  std::vector<std::string> warnings;  ///< one line each
};

}  // namespace glint
