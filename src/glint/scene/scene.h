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

/// What a mesh is drawn as. Strips, fans and loops are turned into these on loading.
enum class Topology { points, lines, triangles };

/// One thing to draw with one material: a glTF primitive, validated and made ready for upload.
/// Every index is within range and every value finite; triangles have unit normals.
struct Mesh {
  Topology topology = Topology::triangles;
  /// Model space; `positions` are relative to it. Not zero only where the mesh lies so far from its
  /// own origin that float positions would lose digits when transformed.
  glm::dvec3 origin{0.0};
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< unit length, one a position; triangles always have them,
                                   ///< points and lines without are unlit
  /// xyz unit, to where the normal map's picture goes right, w its handedness (1 or -1), one a
  /// position; empty unless the material has a normal map that the mesh has coordinates for.
  std::vector<glm::vec4> tangents;
  /// Linear RGB and alpha, one a position, or empty (glTF COLOR_0).
  std::vector<glm::vec4> colors;
  /// texcoords[set] has one a position, or is empty; only sets that the material's textures read.
  /// A set that a texture reads may be missing: the mesh is then drawn without that texture.
  std::vector<std::vector<glm::vec2>> texcoords;
  std::vector<std::uint32_t> indices;  ///< never empty for a mesh that is drawn
  /// Some triangle's vertex normals are so far apart that a mean of them may vanish.
  bool normalsMayCancel = false;
  /// Alpha is 1 in all texels that it shows of its material's colour texture: known once that is
  /// decoded, and found out only where the material blends.
  bool opaqueTexels = false;
  int material = 0;   ///< index into Scene::materials
  int fileMesh = -1;  ///< place of the mesh it is a primitive of in its file; -1: of none
};

enum class Wrap { repeat, clampToEdge, mirroredRepeat };
enum class Filter { nearest, linear };
enum class MipFilter { none, nearest, linear };

/// How a texture is sampled, as in glTF. A texture without sampler repeats, with trilinear filter.
struct Sampler {
  Filter magnify = Filter::linear;
  Filter minify = Filter::linear;
  MipFilter mip = MipFilter::linear;
  Wrap wrapS = Wrap::repeat;
  Wrap wrapT = Wrap::repeat;

  auto operator<=>(const Sampler&) const = default;
};

/// How a picture is made of the two of KHR_materials_pbrSpecularGlossiness, texel by texel by
/// convertSpecularGlossiness().
struct GlossPicture {
  bool isColor = false;  ///< gives C and alpha; else G roughness, B metallic, A reflectance
  int other = -1;        ///< the picture beside the bytes, in Scene::images; -1: white
  SpecularGlossiness factors;
};

/// A picture as it stands in the file: PNG, JPEG or WebP bytes, decoded only when a program reads
/// it.
struct EncodedImage {
  std::string name;  ///< for messages: the file, or the place in the model file
  std::vector<std::byte> bytes;
  bool isData = false;  ///< numbers, as of a normal map, not colours in sRGB
  /// What is made of it: of the diffuse picture its colours, of the other one its numbers.
  std::optional<GlossPicture> gloss{};
  bool isNormalMap = false;  ///< read as nothing else: its alpha is free (normal_lengths.h)
};

/// Which texture and which texture coordinates a material reads; empty means none.
struct Texture {
  int image = 0;  ///< index into Scene::images
  int texcoord = 0;
  Sampler sampler;
  /// From the mesh's coordinates to those of the picture: columns for u, v and 1
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

/// Parameters that textures give, as bits: where a material has a texture for them they are
/// computed from its texels, pixel by pixel, in place of the number in ShadingParameters. A number
/// that the user gives takes the texture's place.
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

/// Textures of numbers, not colours, and what they multiply (docs/materials.md has the formulas).
struct ParameterTextures {
  std::optional<Texture> metallicRoughness;  ///< G roughness, B metallic
  std::optional<Texture> occlusion;          ///< R share of the ambient light
  std::optional<Texture> specular;         ///< A share of the reflectance (KHR_materials_specular)
  std::optional<Texture> transmission;     ///< R share of t (KHR_materials_transmission)
  double metallic = 1.0, roughness = 1.0;  ///< [0, 1]
  double reflectance = 0.04;  ///< of the dielectric at normal incidence, with its strength, [0, 1]
  double occlusionStrength = 1.0;  ///< [0, 1]
};

/// Textures that are not read though the material has them, as bits.
namespace switchedOff {
enum : unsigned { color = 1, normal = 2, emission = 4 };
}

struct Material {
  /// Never empty: one without a name is called "#N", N its place in the file from 0, and glTF's
  /// default material "#default".
  std::string name;
  int index = -1;           ///< its place in Scene::materials, -1: not in one
  int nth = 0;              ///< its place among those of its name
  bool nameShared = false;  ///< others have its name
  ShadingParameters shading;
  /// The share of the arriving light that the highlight reflects, from which shading.specular was
  /// converted: what m_s is under --normalization. Empty where the file gives m_s itself.
  std::optional<double> highlightShare = {};
  double alpha = 1.0;        ///< multiplies the texture's and the vertex colour's, [0, 1]
  glm::dvec3 emission{0.0};  ///< linear radiance added to the sum
  std::optional<Texture> colorTexture;     ///< sRGB colour and alpha
  std::optional<Texture> emissionTexture;  ///< sRGB
  std::optional<Texture> normalTexture;    ///< x right, y up, z out of the surface: 2 texel - 1
  double normalScale = 1.0;                ///< multiplies its x and y
  ParameterTextures parameterTextures;
  unsigned textured = 0;     ///< bits of namespace textured: what those textures give
  unsigned switchedOff = 0;  ///< bits of namespace switchedOff, as extras.glint says
  /// What the file says of it that no program has anything for, as "the ..." for messages.
  std::vector<std::string> unusedProperties;
  AlphaMode alphaMode = AlphaMode::opaque;
  double alphaCutoff = 0.5;  ///< for AlphaMode::mask
  bool doubleSided = false;
  bool unlit = false;  ///< shows colour alone
  /// The forms that a look gives this material in place of its own.
  std::optional<HighlightForms> highlight;
  std::optional<Fresnel> fresnel;
};

/// One mesh placed in the world.
struct Instance {
  int mesh = 0;
  glm::dmat4 world{1.0};  ///< model to world; the last row is 0 0 0 1
  int object = -1;        ///< index into Scene::objects; -1: it is none of them
};

/// A mesh of the file that stands somewhere: all of its primitives together.
struct FileObject {
  int node = 0, mesh = 0;  ///< places in the file
};

/// A camera of the file. It looks along -Z of its own space, +Y up; `world` is a rigid motion.
struct FileCamera {
  std::string name;
  glm::dmat4 world{1.0};
  bool orthographic = false;
  double viewAngle = 0.6;   ///< radians, vertical; perspective only
  double halfHeight = 1.0;  ///< world units; orthographic only
  double aspect = 0.0;      ///< width / height of its frame; 0 where the picture decides
  double near = 0.0;        ///< 0 where the file gives none
  double far = 0.0;         ///< 0 where the file gives none (infinite)
};

/// A light of the file (KHR_lights_punctual).
struct FileLight {
  enum class Type { directional, point, spot };
  std::string name;
  Type type = Type::directional;
  glm::dvec3 position{0.0};        ///< world; point and spot
  glm::dvec3 direction{0, 0, -1};  ///< unit, world: the way it shines; directional and spot
  /// Colour times intensity, linear: lux (directional) or candela (point and spot; metres are world
  /// units), components [0, 1e30].
  glm::dvec3 intensity{1.0};
  double range = 0;  ///< world units: no light beyond; 0 where there is no such end
  double innerAngle = 0.0, outerAngle = 0.785398163397448;  ///< radians from the spot's axis
};

struct FileAnimation {
  std::string name;     ///< may be empty
  double duration = 0;  ///< seconds, from 0 to its last key
};

/// An extension of glTF that the file names, and what is made of it.
struct FileExtension {
  enum class Use { read, approximated, ignored, unseen };  ///< unseen: nothing of it shows
  std::string name;
  Use use = Use::ignored;
  std::string note;       ///< how far, may be empty; or why not, to follow "which is"
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

/// All that is drawn, by value. World space: +Y up, right-handed, metres by glTF's word.
struct Scene {
  std::string name;  ///< file name without folder and ending
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<FileObject> objects;  ///< of a file; empty where a scene was made otherwise
  std::vector<Material> materials;  ///< never empty: the last one is glTF's default material
  std::vector<EncodedImage> images;
  std::vector<FileCamera> cameras;
  std::vector<FileLight> lights;
  /// What the file's lights are multiplied by unless a look says otherwise; see lights.h.
  double lightScale = 1;
  std::vector<FileAnimation> animations;
  std::vector<std::string> scenes;        ///< names of all that the file has, which may be empty
  std::vector<std::string> variants;      ///< likewise, of its materials
  std::vector<FileExtension> extensions;  ///< for `glint info`, as are skins and morphs
  std::vector<FileSkin> skins;
  std::vector<FileMorph> morphs;
  std::vector<std::string> warnings;  ///< one line each
};

}  // namespace glint
