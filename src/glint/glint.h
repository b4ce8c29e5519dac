#pragma once

// Pictures of glTF models for other programs. This and compare.h are a small interface on all the
// rest: a session, a model, a look; picture files and comparisons are in compare.h.
//
//     glint::Session session;
//     const glint::Model model = glint::Model::load("teapot.glb");
//     const glint::Image picture = session.draw(model, {{"shading", "gouraud"}});
//
// What cannot be used throws InputError, what else fails Error (a ContextError where there is no
// OpenGL): one line that says what, where and what to do.
//
// Threads: everything may be called from any thread. OpenGL is used by one call at a time in the
// whole process, others wait; nothing of it stays current in the calling thread afterwards. The
// backend "reference" has no OpenGL: its sessions draw side by side, each model in one at a time.
// fork(): a process that has opened a session with OpenGL cannot draw in its children, which
// throws; start those before, or use "reference" there.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "glint/image/error.h"
#include "glint/image/image.h"

namespace glint {

/// A look: the options of `glint render` that docs/options.md lists under "A look", by their names
/// without "--", and their values ("true" for a flag): {{"light", "point:0,3,2"}, {"resolution",
/// "256,256"}}. The last of a name counts; lights and materials add up. "look" takes a look file.
using Options = std::vector<std::pair<std::string, std::string>>;

/// Triangles given as arrays, in one material.
struct Arrays {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::uint32_t> indices;  ///< three a triangle, counter-clockwise from its front;
                                       ///< empty: the positions as they follow each other
  std::vector<std::array<float, 3>> normals;    ///< one a position, or empty: flat faces
  std::vector<std::array<float, 4>> colors;     ///< one a position, linear RGB and alpha in [0, 1],
                                                ///< or empty: they multiply the material's colour
  std::vector<std::array<float, 2>> texcoords;  ///< one a position, (0, 0) the upper left corner
  std::vector<std::byte> texture;               ///< PNG, JPEG or WebP in sRGB, or empty
  std::string name;                             ///< of the material, for the option "material"
  /// As --material takes it, "color=#c04020,exponent=50"; what it does not say is white and dull:
  /// ambient 1, diffuse 1, specular 0, exponent 20, metalness 0, ior 1.5, transmission 0.
  std::string material;
  bool twoSided = false;  ///< the back of triangles is drawn too
  /// From these positions to the world (+Y up), column by column; the last row is 0, 0, 0, 1.
  std::array<double, 16> place{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

/// What is drawn. Copies are the same model; it stays as long as one of them does.
class Model {
 public:
  /// A glTF 2.0 file, .gltf or .glb, with what it refers to.
  static Model load(const std::filesystem::path& path);
  /// The bytes of such a file, which refers to nothing outside of it (a .glb, or data: URIs).
  static Model fromMemory(std::span<const std::byte> file);
  static Model fromArrays(std::span<const Arrays> parts);

  /// What was mended or left out so far, one line each.
  std::vector<std::string> warnings() const;
  /// The sphere around all of it, world space, as the file stands: centre and radius.
  std::array<double, 4> bounds() const;

 private:
  friend class Session;
  struct State;
  explicit Model(std::shared_ptr<State> state);
  std::shared_ptr<State> state_;
};

/// 8-bit codes: RGBA, sRGB with straight alpha, rows from the top.
struct Codes {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;  ///< 4 * width * height
};

/// An OpenGL context with its programs and the models that it has drawn: to be kept from picture to
/// picture.
class Session {
 public:
  /// `backend` is auto, egl, egl-software, osmesa or reference (docs/options.md).
  explicit Session(const std::string& backend = "auto");
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  /// What draws: "osmesa: llvmpipe (LLVM 15.0.6, 256 bits)", "reference".
  std::string description() const;

  /// The picture in linear light, before exposure and encoding: colours premultiplied by alpha.
  Image draw(const Model& model, const Options& look = {});
  /// The picture as a PNG has it; alpha is 255 but with "no-background".
  Codes drawCodes(const Model& model, const Options& look = {});
  /// Parts of the picture by name, four floats a pixel: "depth" (world units along the view, three
  /// times, infinite where there is nothing), "normal" (unit, world space, 0 where there is none),
  /// "id" (the numbers of instance, mesh and material, -1 where there is none), whose fourth value
  /// is the coverage (1 or 0); and the terms of light whose sum the picture is: "ambient",
  /// "diffuse-0", "specular-0", "reflection", "refraction", "emission", "background". No names:
  /// all that the look has.
  std::map<std::string, Image> layers(const Model& model, const Options& look = {},
                                      const std::vector<std::string>& names = {"depth", "normal",
                                                                               "id"});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace glint
