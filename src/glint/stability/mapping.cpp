// Group M: what is looked up, and where. This file has the cases of environment pictures and the
// list of all cases; those of textures are in mapping_textures.cpp.

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "glint/image/picture_writer.h"
#include "glint/scene/look_text.h"
#include "glint/shading/environment_map.h"
#include "glint/shading/fresnel.h"
#include "glint/shading/safe.h"
#include "glint/stability/bench.h"
#include "glint/stability/mapping_textures.h"
#include "glint/stability/scenes.h"

namespace glint::stability {
namespace {

constexpr double texel = pi / 128;  // of the compass picture, radians

/// A radiance that differs in every direction: one channel for each axis.
glm::dvec3 compass(const glm::dvec3& d) { return 0.5 + 0.25 * d; }

/// Bilinear filtering is off by h^2 / 8 of the second derivatives along both axes, 0.25 each,
/// across a pole too. Directions, coordinates and the filter in floats add 2e-6.
constexpr double compassTolerance = 0.25 * texel * texel / 4 + 2e-6;

/// The compass as a file that exists while the program runs: once read, it is not written again.
class CompassPicture {
 public:
  static std::string path() {
    static const CompassPicture picture;
    return picture.path_.string();
  }
  CompassPicture(const CompassPicture&) = delete;
  CompassPicture& operator=(const CompassPicture&) = delete;
  ~CompassPicture() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

 private:
  CompassPicture()
      : path_(std::filesystem::temp_directory_path() /
              ("glint-compass-" + std::to_string(getpid()) + ".pfm")) {
    Image image{256, 128, {}};
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const double down = texel * (y + 0.5), turn = texel * (x + 0.5) - pi;
        const glm::dvec3 e = compass(
            {std::sin(down) * std::sin(turn), std::cos(down), -std::sin(down) * std::cos(turn)});
        image.values.insert(image.values.end(), {float(e.r), float(e.g), float(e.b), 1.0f});
      }
    const auto writer = openPictureWriter(path_.string(), image.width, image.height);
    writer->write(image);
    writer->finish();
  }

  std::filesystem::path path_;
};

Material mirror() {
  Material m = litMaterial(0, 0, 1);
  m.shading.color = glm::dvec3(1);
  m.shading.metalness = 1;
  return m;
}

Look environmentLook(Bench& bench, const std::string& picture) {
  Look look = parallel(bench.look(Shading::environment), {0, 0, 1}, 3);
  look.fresnel = Fresnel::exact;
  look.hdriFile = picture;
  return look;
}

/// The normal that reflects the direction +Z into d.
glm::dvec3 halfWay(const glm::dvec3& d) {
  return safeNormalize(safeNormalize(d) + glm::dvec3(0, 0, 1));
}

const glm::dvec3 directions[] = {{0, 0, 1},     {1, 0, 0},  {-1, 0, 0},     {0, 1, 0},
                                 {0, -1, 0},    {1, 2, -2}, {-2, 1, -1},    {1e-3, 1, 0},
                                 {0, -1, 2e-3}, {3, -1, 5}, {1e-4, 0.2, 1}, {-1e-4, -0.2, 1}};

/// The environment turned by the angle about +Y shows in the direction d what was in this direction
/// before.
glm::dvec3 before(const glm::dvec3& d, double angle) {
  const double c = std::cos(angle * degrees), s = std::sin(angle * degrees);
  return {c * d.x - s * d.z, d.y, s * d.x + c * d.z};
}

void m1(Bench& bench, Record& record) {
  for (const glm::dvec3& d : directions) {
    const Look look = environmentLook(bench, CompassPicture::path());
    const Scene scene = sceneOf(square(halfWay(d)), mirror());
    record.color("a mirror that shows " + vectorText(d), middle(bench.draw(scene, look)),
                 compass(safeNormalize(d)), compassTolerance);
    record.color("the reference's", middle(bench.reference(scene, look)), compass(safeNormalize(d)),
                 compassTolerance);
  }
}

void m2(Bench& bench, Record& record) {
  for (const double angle : {90.0, -35.0, 180.0})
    for (const glm::dvec3& d : directions) {
      Look look = environmentLook(bench, CompassPicture::path());
      look.environmentRotation = angle;
      const Scene scene = sceneOf(square(halfWay(d)), mirror());
      const glm::dvec3 expected = compass(before(safeNormalize(d), angle));
      const std::string what = "turned by " + numberText(angle) + ", " + vectorText(d);
      record.color(what, middle(bench.draw(scene, look)), expected, compassTolerance);
      record.color(what + ", the reference", middle(bench.reference(scene, look)), expected,
                   compassTolerance);
    }
}

// A ball's middle shows what is behind the viewer.
void m3(Bench& bench, Record& record) {
  for (const glm::dvec3& d :
       {glm::dvec3(1, 0.3, 0.2), {-1, 0.5, 2}, {0.2, -1, -0.3}, {-1, 1, -1}}) {
    Look look = parallel(bench.look(Shading::environment), d, 65);
    look.hdriFile = CompassPicture::path();
    // A ball of 96 x 48: its normals between vertices 3.75 degrees apart are off by (0.065)^2 / 8
    // at most, and a row of the picture above its middle turns the reflection by 2 * 2 / 65 / 2.
    record.color("a ball seen from " + vectorText(d),
                 middle(bench.draw(sceneOf(sphere(96, 48), mirror()), look)),
                 compass(safeNormalize(d)), 0.25 * 2e-3 + compassTolerance);
  }
}

void m4(Bench& bench, Record& record) {
  const std::pair<Environment, BuiltinEnvironment> maps[] = {
      {Environment::studio, BuiltinEnvironment::studio},
      {Environment::sky, BuiltinEnvironment::sky}};
  for (const auto& [map, truth] : maps)
    for (const double angle : {0.0, 70.0})
      for (const glm::dvec3& d : directions) {
        Look look = environmentLook(bench, "");
        look.environment = map;
        look.environmentRotation = angle;
        // Their steepest edge rises by 32 per radian, and directions are off by 1e-6; the look-up
        // itself is off by 1e-5.
        record.color((map == Environment::sky ? "sky towards " : "studio towards ") + vectorText(d),
                     middle(bench.draw(sceneOf(square(halfWay(d)), mirror()), look)),
                     environmentRadiance(truth, before(safeNormalize(d), angle)), 32e-6 + 1e-5);
      }
}

void m5(Bench& bench, Record& record) {
  for (const bool behind : {false, true})
    for (const double medium : {1.0, 1.33})
      for (const double ior : {1.5, 1.2})
        for (const glm::dvec3& tilt : {glm::dvec3(0, 0, 1), {0.3, 0.2, 1}, {-0.2, 0.4, 1}}) {
          const glm::dvec3 n = safeNormalize(tilt), v(0, 0, 1), color(0.9, 0.5, 0.2);
          Material glass = litMaterial(0, 0, 1);
          glass.shading.color = color;
          glass.shading.ior = ior;
          glass.shading.transmission = 0.75;
          glass.doubleSided = true;
          Mesh mesh = square(behind ? -n : n);
          if (behind) mesh.indices = {0, 2, 1, 0, 3, 2};
          Look look = environmentLook(bench, CompassPicture::path());
          look.mediumIor = medium;
          const double n1 = behind ? ior : medium, n2 = behind ? medium : ior;
          const double cosine = glm::dot(n, v), ratio = n1 / n2;
          const double square = 1 - ratio * ratio * (1 - cosine * cosine);
          const double r = square > 0 ? fresnelExact(cosine, n1, n2) : 1;
          glm::dvec3 expected = r * compass(2 * cosine * n - v);
          if (square > 0)
            expected +=
                0.75 * (1 - r) * color * compass(ratio * (cosine * n - v) - std::sqrt(square) * n);
          const std::string what = std::string(behind ? "leaving " : "entering ") +
                                   numberText(ior) + " from " + numberText(medium) + ", normal " +
                                   vectorText(n);
          const Scene scene = sceneOf(mesh, glass);
          record.color(what, middle(bench.draw(scene, look)), expected, compassTolerance + 1e-5);
          record.color(what + ", the reference", middle(bench.reference(scene, look)), expected,
                       compassTolerance + 1e-5);
        }
}

void m12(Bench& bench, Record& record) {
  for (const glm::dvec3& eye : {glm::dvec3(0, 0, 3), {2, 1, -2}, {-1, -2, 0.5}}) {
    Look look = bench.look(Shading::phong);
    look.hdriFile = CompassPicture::path();
    look.environmentBackground = true;
    look.environmentRotation = 25;
    look.resolution = {33, 17};
    look.cameraPosition = eye;
    look.cameraFocalPoint = glm::dvec3(0);
    look.cameraViewAngle = 60;
    Scene away = sceneOf(square({0, 0, 1}, 1e-3f), unlitMaterial(glm::dvec3(1)),
                         translation(-40.0 * eye + glm::dvec3(0, 300, 0)));
    const Image image = bench.draw(away, look);
    const glm::dvec3 back = safeNormalize(eye),
                     right = safeNormalize(glm::cross(glm::dvec3(0, 1, 0), back)),
                     up = glm::cross(back, right);
    const double half = std::tan(30 * degrees);
    // A pixel is a fourteenth of a radian wide: the mean over it is off by s^2 / 12 of 0.25, and
    // that of the levels by as much.
    for (const glm::ivec2 place : {glm::ivec2(0, 0), {32, 0}, {0, 16}, {32, 16}, {16, 8}}) {
      const glm::dvec3 ray = right * (((place.x + 0.5) / 33 * 2 - 1) * half * 33 / 17) +
                             up * ((1 - (place.y + 0.5) / 17 * 2) * half) - back;
      record.color("behind the model from " + vectorText(eye), at(image, place.x, place.y),
                   compass(before(safeNormalize(ray), 25)),
                   0.25 * 0.07 * 0.07 / 4 + compassTolerance);
    }
  }
}

const char* const compassReason = "mirrored, upside down or turned pictures look right to the eye";

const Case cases[] = {
    {"M1", "a mirror that shows the axes, poles and seam of a picture",
     "what the picture has there", "4e-5: h^2 / 4 of its bend", compassReason,
     "u = 1/2 + atan2(x, -z) / 2 pi, v = acos(y) / pi; beyond a pole's row lies its other side",
     m1},
    {"M2", "the same, the environment turned by 90, -35 and 180 degrees", "what stood there before",
     "4e-5", "the sign of the angle", "about +Y, from +Z towards +X", m2},
    {"M3", "a mirroring ball seen from four sides", "its middle shows what is behind the viewer",
     "5e-4: facets", "the transform of the eye transposed", "", m3},
    {"M4", "the built-in environments in a mirror, turned and not", "their formulas", "4.2e-5",
     compassReason, "", m4},
    {"M5", "glass with tilted normals, entering and leaving, in air and water",
     "R E(reflected) + t (1 - R) C E(refracted)", "5e-5",
     "refraction by n in place of 1/n; without C; into the wrong side", "", m5},
    {"M6", "a normal map's red, and its green", "the normal leans right; up", "2e-6",
     "maps of the other convention", "green is up, as in glTF", m6},
    {"M7", "a tangent of handedness -1", "green leans down", "2e-6", "mirrored coordinates", "",
     m7},
    {"M8", "a normal map scaled by 0.25 and 2", "red and green scaled, blue not", "2e-6", "", "",
     m8},
    {"M9", "four texels, by every program, lit and unlit", "the file's first row is at the top",
     "1e-6", "upside down", "v is 0 at the top, as in glTF", m9},
    {"M10", "an emission texture", "factor times texel", "3e-6", "ignored", "", m10},
    {"M11", "alpha of a texture and of the material, blended", "their product covers", "1e-6",
     "ignored", "", m11},
    {"M12", "the environment behind the model from three places", "what lies along each ray",
     "4e-4", "the background turned against the reflections", "", m12},
    {"M13", "64 texels over 64 to 9 pixels, levels of one colour each", "log2 of the ratio",
     "5e-5: steps of coordinates are differences of floats", "estimates of the level",
     "the longest step within the square of 2 x 2 pixels", m13},
    {"M14", "two texels by every rule of wrapping; every 15th code", "linear light; the curve",
     "1e-6; 1e-7", "filtered before decoding; 8-bit filters", "decoded before filtering", m14},
    {"M15", "multisampled: thin triangles of colours from 0.4 to 0.6", "nothing below or above",
     "1e-6", "extrapolation beyond the triangle",
     "a pixel covered in part is shaded at the mean of the samples covered", m15},
};

}  // namespace

std::span<const Case> mappingCases() { return cases; }

}  // namespace glint::stability
