// Points and lines on the driver against the reference, with every anti-aliasing: what they cover,
// and their colours.

#include <gmock/gmock.h>

#include <cstdio>

#include "glint/reference/renderer.h"
#include "glint/render/thin.h"
#include "glint/scene/look_text.h"
#include "random.h"
#include "stage.h"

namespace glint::test::points_and_lines_gl_test {

constexpr const char* everyAntiAliasing[] = {"none",   "msaa:2", "msaa:4",
                                             "ssaa:2", "ssaa:3", "ssaa:4"};

class PointsAndLines : public OnStage {
 protected:
  // The reference at the driver's sample positions, of which there may be more than asked for.
  Image reference(const Scene& scene, const Look& look) {
    ReferenceRenderer renderer(scene, {}, boundsOf(scene), look, 1);
    if (look.antiAliasing.mode == AntiAliasing::Mode::msaa) {
      std::vector<glm::dvec2> samples;
      for (const glm::vec2& place : RenderTarget(4, 4, look.antiAliasing.count).samplePositions())
        samples.push_back(glm::dvec2(place) - 0.5);
      samples_ = int(samples.size());
      renderer.sampleAt(std::move(samples));
    } else {
      samples_ = look.antiAliasing.mode == AntiAliasing::Mode::ssaa
                     ? look.antiAliasing.count * look.antiAliasing.count
                     : 1;
    }
    return renderer.draw();
  }

  // The driver snaps places to 1/256 of a pixel of its grid, in which a line is `width` wide. So
  // samples within 1/256 of one of two edges may differ: at most 4/256 of a grid's pixel of
  // `width`. A point has four edges as long as it is wide, of which each makes half as much of a
  // difference: 8/256.
  void expectSameCoverage(const Scene& scene, const Look& look, const std::string& what) {
    const Image truth = reference(scene, look), image = draw(scene, look);
    double covered = 0, other = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        covered += pixel(truth, x, y).a * samples_;
        other += std::abs(pixel(truth, x, y).a - pixel(image, x, y).a) * samples_;
      }
    const bool grid = look.antiAliasing.mode == AntiAliasing::Mode::ssaa;
    const int width = grid ? look.antiAliasing.count : 1;
    std::printf("%s: %.0f samples, %.0f of them differ\n", what.c_str(), covered, other);
    EXPECT_GT(covered, 100) << what;
    EXPECT_LE(other, covered * 8 / 256 / width) << what;
  }

  int samples_ = 1;
};

Look lookWith(const std::string& antiAliasing, glm::ivec2 resolution) {
  Look look;
  look.shading = Shading::phong;
  look.resolution = resolution;
  look.antiAliasing = parseAntiAliasing(antiAliasing);
  look.noBackground = true;
  return look;
}

// An orthographic camera that sees places from 0 to the resolution, in pixels, y upwards.
void lookAtPixels(Scene& scene, Look& look) {
  FileCamera camera;
  camera.orthographic = true;
  camera.halfHeight = look.resolution.y / 2.0;
  camera.world[3] = glm::dvec4(look.resolution.x / 2.0, look.resolution.y / 2.0, 100, 1);
  scene.cameras = {camera};
  look.cameraIndex = 0;
  look.clippingRange = glm::dvec2(1, 200);
}

Mesh thin(Topology topology, std::vector<glm::vec3> places) {
  Mesh mesh;
  mesh.topology = topology;
  mesh.positions = std::move(places);
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) mesh.indices.push_back(i);
  return mesh;
}

std::vector<glm::vec3> places(int count, glm::dvec2 low, glm::dvec2 high, unsigned seed) {
  Random random(seed);
  std::vector<glm::vec3> all;
  for (int i = 0; i < count; ++i) {
    const double x = random.unit(), y = random.unit();
    all.emplace_back(low + glm::dvec2(x, y) * (high - low), 20 * random.unit() - 10);
  }
  return all;
}

// Some beyond the picture's border, of which a part shows.
TEST_P(PointsAndLines, CoverTheSamplesOfTheReference) {
  for (const std::string antiAliasing : everyAntiAliasing) {
    Look look = lookWith(antiAliasing, {64, 48});
    Scene points = sceneOf(thin(Topology::points, places(800, {-2, -2}, {66, 50}, 1)));
    lookAtPixels(points, look);
    expectSameCoverage(points, look, antiAliasing + " points");
    Scene lines = sceneOf(thin(Topology::lines, places(60, {-20, -20}, {84, 68}, 2)));
    lookAtPixels(lines, look);
    expectSameCoverage(lines, look, antiAliasing + " lines");
    // Shorter than a pixel up to a few.
    std::vector<glm::vec3> ends = places(400, {1, 1}, {63, 47}, 3);
    for (std::size_t i = 0; i < ends.size(); i += 2)
      ends[i + 1] = ends[i] + 0.1f * (ends[i + 1] - ends[i]);
    Scene dashes = sceneOf(thin(Topology::lines, ends));
    lookAtPixels(dashes, look);
    expectSameCoverage(dashes, look, antiAliasing + " dashes");
  }
}

// The same in perspective, through the near and the far plane, by way of a mesh in front of them.
TEST_P(PointsAndLines, CoverTheSamplesInPerspective) {
  for (const std::string antiAliasing : everyAntiAliasing) {
    Look look = lookWith(antiAliasing, {64, 48});
    Scene scene = sceneOf(thin(Topology::lines, places(80, {-3, -3}, {3, 3}, 4)));
    for (glm::vec3& place : scene.meshes[0].positions) place.z *= 0.3f;
    FileCamera camera;
    camera.viewAngle = 1;
    camera.world[3] = glm::dvec4(0, 0, 4, 1);
    scene.cameras = {camera};
    look.cameraIndex = 0;
    look.clippingRange = glm::dvec2(2, 6);
    expectSameCoverage(scene, look, antiAliasing + " in perspective");
  }
}

// Blended ones are drawn layer by layer, within the box of their places.
TEST_P(PointsAndLines, CoverTheSamplesWhenBlended) {
  for (const std::string antiAliasing : {"none", "msaa:4", "ssaa:4", "ssaa:16"})
    for (const Topology topology : {Topology::points, Topology::lines}) {
      Look look = lookWith(antiAliasing, {32, 24});
      Material half;
      half.alpha = 0.5;
      half.alphaMode = glint::AlphaMode::blend;
      // Level lines apart, so that no sample has two of them; the ends are on a common box.
      std::vector<glm::vec3> ends;
      for (int i = 0; i < 8; ++i) {
        ends.emplace_back(4.3f + 0.1f * float(i), 2.4f + 2.2f * float(i), 0);
        ends.emplace_back(27.3f, 2.4f + 2.2f * float(i), 0);
      }
      Scene scene = sceneOf(thin(topology, ends), half);
      lookAtPixels(scene, look);
      const Image truth = reference(scene, look), image = draw(scene, look);
      double sum = 0, other = 0;
      for (std::size_t i = 3; i < truth.values.size(); i += 4) {
        sum += double(truth.values[i]);
        other += std::abs(double(truth.values[i]) - double(image.values[i]));
      }
      const double expected = topology == Topology::points ? 16 * 0.5 : 8 * 22.65 * 0.5;
      EXPECT_NEAR(sum, expected, topology == Topology::points ? 1e-5 : 3) << antiAliasing;
      EXPECT_LE(other, sum * 8 / 256) << antiAliasing << " topology " << int(topology);
    }
}

// A picture drawn in several tiles or bands is one picture: each tile draws its part of a point or
// a line whose middle is in another.
TEST_P(PointsAndLines, CrossTheBordersOfTiles) {
  struct Case {
    const char* antiAliasing;
    glm::ivec2 resolution;
  };
  for (const Case& each : {Case{"ssaa:4", {2100, 24}}, Case{"ssaa:4", {24, 2100}},
                           Case{"msaa:4", {8200, 24}}, Case{"msaa:4", {24, 8200}}}) {
    Look look = lookWith(each.antiAliasing, each.resolution);
    const TileLayout layout = tilesFor(look.resolution, look.antiAliasing);
    const bool across = each.resolution.x > each.resolution.y;
    ASSERT_EQ(layout.bands.size() * layout.bands[0].size(), 2u);
    const double border =
        across ? layout.tileWidth : look.resolution.y - layout.bandHeight;  // y upwards
    glm::dvec2 low(0.5), high(23.5);
    low[across ? 0 : 1] = border - 1;
    high[across ? 0 : 1] = border + 1;
    for (const Topology topology : {Topology::points, Topology::lines}) {
      Scene scene = sceneOf(thin(topology, places(240, low, high, 5)));
      lookAtPixels(scene, look);
      expectSameCoverage(scene, look, std::string(each.antiAliasing) + " at a border");
    }
  }
}

// Triangles drawn after points and lines have the bits that they have without them.
TEST_P(PointsAndLines, LeaveTrianglesAlone) {
  for (const std::string antiAliasing : {"msaa:4", "ssaa:3"}) {
    Look look = lookWith(antiAliasing, {32, 24});
    look.light = {directional({0.3, 0.5, 1})};
    const Mesh ball = sphere(24, 12);
    Scene alone = sceneOf(ball), both = sceneOf(thin(Topology::points, {{-2, 1.3f, 0}}));
    both.meshes.push_back(thin(Topology::lines, {{-2.1f, 0, 0}, {-1.9f, 0.5f, 0}}));
    both.meshes.push_back(ball);
    both.instances.push_back({1, glm::dmat4(1)});
    both.instances.push_back({2, glm::dmat4(1)});
    FileCamera camera;
    camera.viewAngle = 1;
    camera.world[3] = glm::dvec4(-0.3, 0.1, 4, 1);
    alone.cameras = both.cameras = {camera};
    look.cameraIndex = 0;
    look.clippingRange = glm::dvec2(2, 6);
    const Image expected = draw(alone, look), image = draw(both, look);
    int covered = 0, thins = 0;
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 32; ++x) {
        if (pixel(expected, x, y).a == 0) {
          thins += pixel(image, x, y).a > 0;
          continue;
        }
        ++covered;
        EXPECT_EQ(pixel(image, x, y), pixel(expected, x, y)) << x << "," << y;
      }
    EXPECT_GT(covered, 90);
    EXPECT_GT(thins, 3);
    GLfloat width = 0, size = 0;
    glGetFloatv(GL_LINE_WIDTH, &width);
    glGetFloatv(GL_POINT_SIZE, &size);
    EXPECT_EQ(width, 1);
    EXPECT_EQ(size, 1);
  }
}

// Red grows from 1 to 2 along a line. Without multisampling the driver computes what the reference
// does, to a few roundings of places of up to 64 samples. With it, Mesa 22.3 takes the values half
// a pixel too far to the right and up: 0.7072 pixels along the line. Where the pixel's centre is up
// to 0.7072 pixels beyond an end, which has the reference's value, that comes on top.
TEST_P(PointsAndLines, HaveTheReferencesValues) {
  for (const std::string antiAliasing : everyAntiAliasing) {
    double worst = 0;
    int compared = 0;
    for (unsigned seed = 0; seed < 30; ++seed) {
      Look look = lookWith(antiAliasing, {16, 16});
      Mesh line = thin(Topology::lines, places(2, {1, 1}, {15, 15}, 100 + seed));
      line.colors = {{1, 1, 0, 1}, {2, 1, 0, 1}};
      const double length =
          glm::distance(glm::dvec2(line.positions[0]), glm::dvec2(line.positions[1]));
      Scene scene = sceneOf(line);
      lookAtPixels(scene, look);
      const Image truth = reference(scene, look), image = draw(scene, look);
      for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
          const glm::dvec4 expected = pixel(truth, x, y), actual = pixel(image, x, y);
          if (expected.a != actual.a || expected.a == 0) continue;
          ++compared;
          worst = std::max(worst, std::abs(expected.r - actual.r) / expected.a * length);
        }
    }
    std::printf("%s: %d pixels, off by up to %.2g pixels along the line\n", antiAliasing.c_str(),
                compared, worst);
    EXPECT_GT(compared, 200) << antiAliasing;
    const bool multisampled = antiAliasing.starts_with("msaa");
    EXPECT_LE(worst, multisampled ? 2 * 0.7072 : 1e-4) << antiAliasing;
  }
}

// Lit ones, with normals of their own, also seen in a mirror: both sides of a double-sided material
// are the front of a point or a line. One point or line in each row of pixels.
TEST_P(PointsAndLines, AreLitAsInTheReference) {
  for (const Shading shading :
       {Shading::flat, Shading::gouraud, Shading::phong, Shading::blinnPhong, Shading::environment})
    for (const Topology topology : {Topology::points, Topology::lines})
      for (const std::string antiAliasing : {"none", "msaa:4", "ssaa:3"}) {
        Look look = lookWith(antiAliasing, {32, 32});
        look.shading = shading;
        look.environment = Environment::white;
        look.light = {directional({0.3, 0.4, 1})};
        Random random(9);
        std::vector<glm::vec3> ends;
        for (int i = 0; i < 15; ++i) {
          ends.emplace_back(2.3 + random.unit(), 1.4 + 2 * i, 0);
          ends.emplace_back(20.3 + 9 * random.unit(), 1.4 + 2 * i, 0);
        }
        Mesh mesh = thin(topology, ends);
        for (const glm::vec3& end : ends) {
          const glm::dvec3 tilt = 0.8 * random.direction();
          const bool front = int(end.y) % 4 == 1;  // with both ends of a line on one side
          mesh.normals.emplace_back(glm::normalize(tilt + glm::dvec3(0, 0, front ? 1 : -1)));
        }
        Material material = materialOf(0.5, 0.6, 0.3, 8);
        material.doubleSided = true;
        Scene scene = sceneOf(mesh, material);
        scene.instances[0].world =
            translation({32, 0, 0}) * scaling({-1, 1, 1});  // mirrored left to right
        lookAtPixels(scene, look);
        const Image truth = reference(scene, look), image = draw(scene, look);
        // With msaa the driver's values are half a pixel further, see below, and go on for half a
        // pixel beyond an end: by one of at least 17 pixels, along which they change by at most 2,
        // nowhere more than twice as fast as evenly.
        const bool shifted =
            topology == Topology::lines && antiAliasing == "msaa:4" && shading != Shading::flat;
        const double bound = shifted ? 4.0 / 17 : 1e-5;
        int compared = 0;
        for (int y = 0; y < 32; ++y)
          for (int x = 0; x < 32; ++x) {
            const glm::dvec4 expected = pixel(truth, x, y), actual = pixel(image, x, y);
            if (expected.a != actual.a || expected.a == 0) continue;
            ++compared;
            for (int c = 0; c < 3; ++c)
              EXPECT_NEAR(actual[c], expected[c], bound)
                  << antiAliasing << " " << x << "," << y << " program " << int(shading);
          }
        EXPECT_GT(compared, topology == Topology::points ? 25 : 300);
      }
}

// Neither context is forward-compatible, and llvmpipe's points and lines are up to 255 wide.
TEST_P(PointsAndLines, CanBeAsWideAsAnySsaa) {
  const ThinLimits limits = thinLimits();
  EXPECT_GE(limits.point, 16);
  EXPECT_GE(limits.line, 16);
}

INSTANTIATE_TEST_SUITE_P(Backends, PointsAndLines, softwareBackends(), nameOfBackend);

}  // namespace glint::test::points_and_lines_gl_test
