#pragma once

#include <string>
#include <vector>

#include "glint/image/image.h"
#include "glint/render/draw_list.h"

namespace glint {

class GpuScene;
class Renderer;

/// A part of a picture. Those of light - all but normal, depth and ids - add up to the picture:
/// each is a picture of the whole scene in which every surface shows that part alone, with the
/// coverage, the blending and the anti-aliasing of the picture.
struct PictureTerm {
  enum class Kind {
    ambient,     ///< m_a C A, of what transmits light times 1 - t, as the next two
    diffuse,     ///< m_d C I_m N.L of one light
    specular,    ///< m_s S I_m lobe of one light
    reflection,  ///< F E(reflect) of the program environment
    refraction,  ///< t (1 - F) C E(refract), likewise
    emission,    ///< emission, and the colour of what is unlit
    background,  ///< what is seen beside and through the surfaces
    normal,      ///< of opaque surfaces as shading has it, unit, world space; 0 where there is none
    depth,       ///< distance along the view, world units; infinite where there is nothing opaque
    ids,         ///< idsOf() the opaque surface, -1 where there is none; alpha 1 and 0
  };
  Kind kind = Kind::ambient;
  int light = 0;     ///< of diffuse and specular: its place in lightsOf() the look
  std::string name;  ///< "ambient", "diffuse-0", ...

  bool isLight() const { return kind < Kind::normal; }
};

/// The terms of a picture: reflection and refraction of the program environment alone, the
/// background unless it is transparent. Lights that shine have the numbers of their places among
/// those given, from 0.
std::vector<PictureTerm> termsOf(const DrawList&, const Look&);

/// The look that a term is drawn with: terms of light over nothing; the others are those at the
/// pixel's centre, without anti-aliasing.
Look termLook(const PictureTerm&, Look);

/// What a draw shows: the number of the instance (its place in Scene::objects, of a scene without
/// them in Scene::instances), of the mesh (its place in the file, of a scene without one in
/// Scene::meshes) and of the material (its place in Scene::materials, which is that in the file;
/// the one after the file's last is glTF's default material). Exact in float below 2^24.
glm::vec3 idsOf(const Scene&, const DrawItem&);

/// Draws a term. `look` is that of the picture.
Image drawTerm(Renderer&, GpuScene&, const Bounds&, const Look& look, const PictureTerm&);

}  // namespace glint
