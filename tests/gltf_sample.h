#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "glint/gltf/scene_file.h"
#include "glint/image/error.h"

/// A small glTF document that tests build and break.
class Sample {
 public:
  using Json = nlohmann::json;

  /// The document; `buffers` is filled in when it is written.
  Json json = {{"asset", {{"version", "2.0"}}}};
  std::vector<unsigned char> binary;
  /// Replaces the content of `buffers`, unless null.
  Json buffers;

  Sample() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) /
              (std::string("glint_") + test->test_suite_name() + "_" + test->name() + "_" +
               std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~Sample() { std::filesystem::remove_all(folder_); }
  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

  template <typename Value>
  int view(const std::vector<Value>& values) {
    while (binary.size() % 4 != 0) binary.push_back(0);
    const std::size_t offset = binary.size(), bytes = values.size() * sizeof(Value);
    binary.resize(offset + bytes);
    if (bytes > 0) std::memcpy(&binary[offset], values.data(), bytes);
    return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
  }

  /// An accessor with a buffer view of its own; the component type follows from Value.
  template <typename Value>
  int accessor(const std::string& type, const std::vector<Value>& values) {
    const std::size_t components = type == "SCALAR" ? 1
                                   : type == "MAT4" ? 16
                                                    : static_cast<std::size_t>(type[3] - '0');
    return add("accessors", {{"bufferView", view(values)},
                             {"componentType", componentType(Value())},
                             {"type", type},
                             {"count", values.size() / components}});
  }

  /// Appends to a list of the document and returns the index.
  int add(const std::string& list, Json value) {
    json[list].push_back(std::move(value));
    return static_cast<int>(json[list].size()) - 1;
  }

  /// A mesh with one primitive, and a node in the scene that shows it.
  Json& primitive(Json value) {
    const int mesh = add("meshes", {{"name", "Part"}, {"primitives", {std::move(value)}}});
    show({{"mesh", mesh}});
    return json["meshes"][static_cast<std::size_t>(mesh)]["primitives"][0];
  }

  int show(Json node) {
    const int index = add("nodes", std::move(node));
    json["scenes"][0]["nodes"].push_back(index);
    return index;
  }

  /// One triangle in the plane z = 0, counter-clockwise seen from +Z, without normals.
  Json& triangle() {
    return primitive(
        {{"attributes", {{"POSITION", accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
  }

  std::filesystem::path writeGltf(const std::string& name = "sample.gltf") {
    std::ofstream(folder_ / "sample.bin", std::ios::binary)
        .write(reinterpret_cast<const char*>(binary.data()),
               static_cast<std::streamsize>(binary.size()));
    return writeText(document({{"uri", "sample.bin"}}).dump(), name);
  }

  std::filesystem::path writeGlb(const std::string& name = "sample.glb") {
    std::string text = document({}).dump();
    while (text.size() % 4 != 0) text += ' ';
    std::string body = number(text.size()) + "JSON" + text;
    if (!binary.empty()) {
      body += number(binary.size()) + std::string("BIN\0", 4);
      body.append(binary.begin(), binary.end());
    }
    return writeText("glTF" + number(2) + number(body.size() + 12) + body, name);
  }

  std::filesystem::path writeText(const std::string& text, const std::string& name) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  glint::Scene load() { return glint::loadGltf(writeGltf()); }

  /// The error message with which loading is refused; empty if it succeeds.
  std::string error() { return errorOf(writeGltf()); }

  /// The same for any file. Checks that the message is one line that begins with the path.
  static std::string errorOf(const std::filesystem::path& path) {
    try {
      glint::loadGltf(path);
      return {};
    } catch (const glint::InputError& error) {
      std::string line = error.what();
      EXPECT_EQ(line.find('\n'), line.npos) << line;
      EXPECT_EQ(line.rfind(path.string() + ": ", 0), 0u) << line;
      return line.substr(std::min(line.size(), path.string().size() + 2));
    }
  }

  static std::string number(std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &word, 4);
    return bytes;
  }

 private:
  static int componentType(std::int8_t) { return 5120; }
  static int componentType(std::uint8_t) { return 5121; }
  static int componentType(std::int16_t) { return 5122; }
  static int componentType(std::uint16_t) { return 5123; }
  static int componentType(std::uint32_t) { return 5125; }
  static int componentType(float) { return 5126; }

  Json document(Json buffer) {
    Json whole = json;
    buffer["byteLength"] = binary.size();
    if (!buffers.is_null()) {
      whole["buffers"] = buffers;
    } else if (!binary.empty()) {
      whole["buffers"] = Json::array({buffer});
    }
    return whole;
  }

  std::filesystem::path folder_;
};
