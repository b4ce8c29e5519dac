#include <cmath>
#include <numbers>
#include <random>

#include "glint/image/mipmaps.h"
#include "glint/render/normal_lengths.h"
#include "glint/study/scene.h"

namespace glint {
namespace {

/// The standard deviation of each slope. Its variance, 0.0225, is as wide as Phong's lobe with
/// exponent 11.
constexpr double bumpSlope = 0.15;
constexpr int mapWidth = 1024, mapHeight = 512, sphereColumns = 96, sphereRows = 48;

/// Random waves in all directions, 8 to 12 texels long: many to a pixel that reads a smaller level,
/// and smooth from texel to texel, since filtering between texels would otherwise remove some of
/// them.
struct Wave {
  int across, down;  ///< periods in the map, so that it repeats
  double phase;
};

ByteImage bumps() {
  constexpr int count = 24;
  std::mt19937 random(1);
  const auto unit = [&] { return double(random()) / 4294967296.0; };
  std::vector<Wave> waves;
  for (int i = 0; i < count; ++i) {
    const double turn = std::numbers::pi * unit(), length = 8 + 4 * unit();
    waves.push_back({int(std::lround(mapWidth / length * std::cos(turn))),
                     int(std::lround(mapHeight / length * std::sin(turn))),
                     2 * std::numbers::pi * unit()});
  }
  const auto code = [](double x) { return std::uint8_t(std::lround(127.5 * (1 + x))); };
  ByteImage image{mapWidth, mapHeight, 4, {}};
  image.values.reserve(std::size_t(4) * mapWidth * mapHeight);
  for (int row = 0; row < mapHeight; ++row)
    for (int column = 0; column < mapWidth; ++column) {
      glm::dvec2 slope(0);
      for (const Wave& w : waves) {
        // Texels are square, so that a wave's slopes are proportional to its periods in texels.
        const glm::dvec2 way(double(w.across) / mapWidth, double(w.down) / mapHeight);
        const double at = 2 * std::numbers::pi * (way.x * column + way.y * row) + w.phase;
        slope += std::cos(at) / glm::length(way) * way;
      }
      slope *=
          2 * bumpSlope / std::sqrt(double(count));  // each wave has variance 1 / 4 in x and in y
      const double scale = 1 / std::hypot(slope.x, slope.y, 1.0);
      for (const double n : {scale * slope.x, scale * slope.y, scale})
        image.values.push_back(code(n));
      image.values.push_back(255);
    }
  return image;
}

}  // namespace

Scene bumpySphereScene(const ShadingParameters& shading) {
  using std::numbers::pi;
  Mesh mesh;
  mesh.texcoords.resize(1);
  for (int row = 0; row <= sphereRows; ++row)
    for (int column = 0; column <= sphereColumns; ++column) {
      const double down = pi * row / sphereRows, around = 2 * pi * column / sphereColumns;
      const glm::dvec3 n(std::sin(down) * std::sin(around), std::cos(down),
                         std::sin(down) * std::cos(around));
      mesh.positions.emplace_back(n);
      mesh.normals.emplace_back(n);
      mesh.tangents.emplace_back(float(std::cos(around)), 0.0f, float(-std::sin(around)), 1.0f);
      mesh.texcoords[0].emplace_back(float(column) / sphereColumns, float(row) / sphereRows);
    }
  const auto at = [](int row, int column) {
    return std::uint32_t(row * (sphereColumns + 1) + column);
  };
  for (int row = 0; row < sphereRows; ++row)
    for (int column = 0; column < sphereColumns; ++column) {
      if (row > 0)
        mesh.indices.insert(mesh.indices.end(),
                            {at(row, column), at(row + 1, column), at(row, column + 1)});
      if (row + 1 < sphereRows)
        mesh.indices.insert(mesh.indices.end(),
                            {at(row, column + 1), at(row + 1, column), at(row + 1, column + 1)});
    }
  Material material;
  material.name = "Bumps";
  material.shading = shading;
  material.normalTexture = Texture{};
  Scene scene = sceneOf("bumpy sphere", std::move(mesh), material);
  EncodedImage image;
  image.name = "bumps";
  image.isData = image.isNormalMap = true;
  scene.images.push_back(std::move(image));
  return scene;
}

DecodedImages bumpyImages() {
  DecodedImage decoded{bumps(), {}, true};
  decoded.mipLevels = mipLevels(decoded.image, true);
  writeNormalLengths(decoded);
  DecodedImages images;
  images[0] = std::move(decoded);
  return images;
}

}  // namespace glint
