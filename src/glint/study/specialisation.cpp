#include <algorithm>
#include <cmath>

#include "glint/scene/look_text.h"
#include "glint/study/series.h"
#include "glint/study/statistics.h"

// What "only what the scene needs" saves: compares with the same picture by shaders that contain
// everything.
namespace glint {
namespace {

/// Too little light to change any float of a picture, yet its terms are computed.
constexpr double almostNothing = 1e-30;

/// The scene with everything that a shader may read: white textures and vertex colours, and
/// emission that is as good as dark.
Scene withEverything(Scene scene) {
  const int white = int(scene.images.size());
  scene.images.push_back({"white", {}});
  Texture texture;
  texture.image = white;
  texture.sampler.mip = MipFilter::none;
  for (Mesh& mesh : scene.meshes) {
    if (mesh.topology != Topology::triangles) continue;
    if (mesh.colors.empty()) mesh.colors.assign(mesh.positions.size(), glm::vec4(1));
    if (mesh.texcoords.empty()) mesh.texcoords.emplace_back();
    for (auto& set : mesh.texcoords)
      if (set.empty()) set.assign(mesh.positions.size(), glm::vec2(0));
  }
  for (Material& material : scene.materials) {
    if (!material.colorTexture) material.colorTexture = texture;
    if (material.emission == glm::dvec3(0.0)) material.emission = glm::dvec3(almostNothing);
    if (!material.emissionTexture) material.emissionTexture = texture;
    if (material.alphaMode == AlphaMode::opaque) {
      material.alphaMode = AlphaMode::mask;
      material.alphaCutoff = 0;
    }
  }
  return scene;
}

Look withAllLights(Look look) {
  std::vector<Light> lights = lightsOf(look);
  for (const Light::Type type : {Light::Type::directional, Light::Type::point, Light::Type::spot}) {
    Light light;
    light.type = type;
    light.direction = {0.3, -1, -0.5};
    light.position = {1, 2, 3};
    light.innerAngle = 20;
    light.intensity = glm::dvec3(almostNothing);
    lights.push_back(light);
  }
  look.light = lights;
  look.noLights = false;
  return look;
}

DrawList withAllFeatures(DrawList list) {
  for (DrawItem& item : list.items) {
    Variant& v = item.variant;
    if (v.unlit) continue;
    v.diffuse = v.specular = v.unevenScale = v.twoSided = v.vanishingNormal = true;
    v.pixelPosition = true;
    v.constantView = false;
    if (v.program == Shading::environment)
      v.dielectric = v.metal = v.refraction = v.denserSide = true;
  }
  return list;
}

Specialisation compared(const SeriesTools& tools, const StudyScene& general, GpuScene& generalGpu,
                        Shading program) {
  const Look look = exactLook(tools.look, program), allLook = withAllLights(look);
  const DrawList own = makeDrawList(tools.scene.scene, tools.scene.bounds, look);
  const DrawList all = withAllFeatures(makeDrawList(general.scene, general.bounds, allLook));
  Specialisation s;
  s.program = shadingName(program);
  std::vector<double> compile, first, generalCompile, generalFirst;
  for (int i = 0; i < (tools.quick ? 3 : 7); ++i) {
    if (tools.stopped()) return s;
    const auto begin = [](GpuScene& gpu, const DrawList& list, const Look& of,
                          std::vector<double>& compiles, std::vector<double>& firsts) {
      Renderer renderer;  // has compiled nothing yet
      Renderer::Picture picture = renderer.begin(gpu, list, of);
      compiles.push_back(picture.times().compile);
      firsts.push_back(timeOnce(picture));
    };
    begin(tools.gpu, own, look, compile, first);
    begin(generalGpu, all, allLook, generalCompile, generalFirst);
  }
  s.compile = quantile(compile, 0.5);
  s.first = quantile(first, 0.5);
  s.generalCompile = quantile(generalCompile, 0.5);
  s.generalFirst = quantile(generalFirst, 0.5);

  const Image a = tools.renderer.draw(tools.gpu, own, look);
  const Image b = tools.renderer.draw(generalGpu, all, allLook);
  for (std::size_t i = 0; i < a.values.size(); ++i)
    s.difference = std::max(s.difference, std::abs(double(a.values[i]) - double(b.values[i])));
  Renderer::Picture ownPicture = tools.renderer.begin(tools.gpu, own, look);
  Renderer::Picture allPicture = tools.renderer.begin(generalGpu, all, allLook);
  Renderer::Picture* const pictures[] = {&ownPicture, &allPicture};
  auto times = timeInTurn(pictures, tools.timing(2 * tools.rounds));
  s.times = std::move(times[0]);
  s.generalTimes = std::move(times[1]);
  return s;
}

}  // namespace

std::vector<Specialisation> specialisations(const SeriesTools& tools) {
  DecodedImages images = tools.scene.images;
  images[int(tools.scene.scene.images.size())] = {{1, 1, 4, {255, 255, 255, 255}}, {}};
  const StudyScene general(withEverything(tools.scene.scene), std::move(images));
  GpuScene gpu(general.scene, general.images);
  std::vector<Specialisation> all;
  for (const Shading program : {Shading::phong, Shading::environment}) {
    all.push_back(compared(tools, general, gpu, program));
    if (all.back().times.wall.empty()) all.pop_back();
    tools.tell(program == Shading::phong ? 0.5 : 1);
  }
  return all;
}

}  // namespace glint
