#pragma once

#include <string>
#include <vector>

#include "glint/image/image.h"
#include "glint/render/draw_list.h"

namespace glint {

class GpuScene;
class Renderer;

/// A part of a picture. The terms of light (all except normal, depth and ids) add up to the
/// picture: each is a picture of the whole scene in which every surface shows only that part, with
/// the picture's coverage, blending and anti-aliasing.
struct PictureTerm {
  enum class Kind {
    ambient,     ///< m_a C A, times 1 - t where light is transmitted; so for the next two
    diffuse,     ///< m_d C I_m N.L of one light
    specular,    ///< m_s S I_m lobe of one light
    reflection,  ///< F E(reflect) of the program environment
    refraction,  ///< t (1 - F) C E(refract), likewise
    emission,    ///< emission, and the colour of what is unlit
    background,  ///< what is seen around and through the surfaces
    normal,      ///< shading normal of opaque surfaces, unit, world space; 0 where there is none
    depth,       ///< distance along the view, world units; infinite where there is nothing opaque
    ids,         ///< idsOf() the opaque surface, alpha 1; where there is none -1, alpha 0
  };
  Kind kind = Kind::ambient;
  int light = 0;     ///< of diffuse and specular: its index in lightsOf(look)
  std::string name;  ///< "ambient", "diffuse-0", ...

  bool isLight() const { return kind < Kind::normal; }
};

/// The terms of a picture: reflection and refraction only with the program environment, the
/// background unless it is transparent. Lights that shine are numbered by their place among those
/// given, from 0.
std::vector<PictureTerm> termsOf(const DrawList&, const Look&);

/// The look that a term is drawn with: terms of light over a transparent background (except the
/// background itself), the others at the pixel's centre, without anti-aliasing.
Look termLook(const PictureTerm&, Look);

/// What a draw shows, as indices: of the instance in Scene::objects (in Scene::instances if it
/// belongs to none), of the mesh in the file (in Scene::meshes if the file has none), and of the
/// material in Scene::materials, which is also that in the file (the one after the file's last is
/// glTF's default material). Exact in float below 2^24.
glm::vec3 idsOf(const Scene&, const DrawItem&);

/// Draws a term. `look` is that of the picture.
Image drawTerm(Renderer&, GpuScene&, const Bounds&, const Look& look, const PictureTerm&);

}  // namespace glint
