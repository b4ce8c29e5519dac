#pragma once

// Pictures in files, for tests to read.

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>
#include <string>

#include "files.h"
#include "glint/image/picture_writer.h"

namespace glint::test {

/// Makes missing folders.
inline void writePicture(const std::string& path, const Image& image,
                         const PictureOptions& options = {}) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  const auto writer = openPictureWriter(path, image.width, image.height, options);
  writer->write(image);
  writer->finish();
}

/// The path of an environment that has this radiance in each direction.
inline std::string environmentPicture(
    const std::string& name, int rows,
    const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
  const std::string path = temporaryFolder() + "/" + name + ".pfm";
  // Written once, because files that were read must not be overwritten.
  if (std::filesystem::exists(path)) return path;
  const double texel = std::numbers::pi / rows;
  Image image{2 * rows, rows, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double down = texel * (y + 0.5), turn = texel * (x + 0.5) - std::numbers::pi;
      const glm::dvec3 e = radiance(
          {std::sin(down) * std::sin(turn), std::cos(down), -std::sin(down) * std::cos(turn)});
      image.values.insert(image.values.end(), {float(e.r), float(e.g), float(e.b), 1.0f});
    }
  writePicture(path, image);
  return path;
}

}  // namespace glint::test
