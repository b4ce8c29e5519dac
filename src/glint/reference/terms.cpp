#include "glint/reference/terms.h"

#include <limits>

#include "glint/reference/renderer.h"

namespace glint {
namespace {

using Kind = PictureTerm::Kind;

}  // namespace

Image drawReferenceTerm(const Scene& scene, const DecodedImages& images, const Bounds& bounds,
                        const Look& look, const PictureTerm& term) {
  const Look own = termLook(term, look);
  ReferenceRenderer renderer(scene, images, bounds, own);
  if (term.isLight()) {
    renderer.keep(term);
    return renderer.draw();
  }
  const Camera& camera = renderer.stage().camera;
  Image image{look.resolution.x, look.resolution.y, {}};
  image.values.reserve(std::size_t(4) * image.width * image.height);
  for (const reference::Attributes& a : renderer.attributes(0, look.resolution.y)) {
    glm::dvec3 value(term.kind == Kind::depth ? std::numeric_limits<double>::infinity() : 0.0);
    if (a.item >= 0 && term.kind == Kind::depth) value = glm::dvec3(-a.position.z * camera.unit);
    if (a.item >= 0 && term.kind == Kind::normal) {
      const reference::Surface& surface = renderer.stage().items[std::size_t(a.item)].surface;
      if (!surface.unlit) value = camera.axes * reference::shadingNormal(surface, a);
    }
    if (term.kind == Kind::ids)
      value = a.item < 0 ? glm::dvec3(-1.0)
                         : glm::dvec3(idsOf(scene, renderer.list().items[std::size_t(a.item)]));
    for (int c = 0; c < 3; ++c) image.values.push_back(float(value[c]));
    image.values.push_back(a.item >= 0 ? 1.0f : 0.0f);
  }
  return image;
}

void ReferenceRenderer::keep(const PictureTerm& term) {
  const bool one = term.kind == Kind::diffuse || term.kind == Kind::specular;
  std::erase_if(stage_.frame.lights,
                [&](const auto& light) { return !one || light.number != term.light; });
  if (term.kind != Kind::ambient) stage_.frame.ambientLight = glm::dvec3(0.0);
  for (reference::Item& item : stage_.items) {
    if (term.kind != Kind::emission) {
      item.emission = glm::dvec3(0.0);
      if (item.surface.unlit) item.color = glm::dvec4(0, 0, 0, item.color.a);
    }
    if (term.kind == Kind::diffuse) {
      item.surface.numbers.specular = 0;
      item.textured &= ~textured::specular;
    }
    if (term.kind == Kind::specular) {
      item.surface.numbers.diffuse = 0;
      item.textured &= ~textured::diffuse;
    }
    item.surface.part = term.kind == Kind::reflection   ? reference::Part::reflection
                        : term.kind == Kind::refraction ? reference::Part::refraction
                                                        : reference::Part::sum;
  }
}

}  // namespace glint
