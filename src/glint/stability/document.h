#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "glint/scene/scene.h"

namespace glint::stability {

/// A glTF document that a case assembles, written as .glb into a temporary folder that is removed
/// with it.
class Document {
 public:
  Document();
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  nlohmann::json json = {{"asset", {{"version", "2.0"}}}};

  /// Adds an accessor of floats or of 32-bit indices with its own buffer view.
  int accessor(const std::string& type, const std::vector<float>& values);
  int indices(const std::vector<std::uint32_t>& values);
  /// The same for 16-bit numbers, as joints are.
  int shorts(const std::string& type, const std::vector<std::uint16_t>& values);
  /// Adds a mesh of this one primitive, and a node that shows it.
  void show(nlohmann::json primitive);
  /// Adds a triangle in the plane z = 0, counter-clockwise seen from +Z, with these normals (9
  /// floats) or without any.
  void triangle(const std::vector<float>& normals = {});

  /// The scene of the file. Throws InputError.
  Scene load();

 private:
  template <class Value>
  int add(const std::string& type, int componentType, const std::vector<Value>& values);
  int view(const void* data, std::size_t bytes);

  std::filesystem::path folder_;
  std::vector<unsigned char> binary_;
};

}  // namespace glint::stability
