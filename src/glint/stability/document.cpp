#include "glint/stability/document.h"

#include <unistd.h>

#include <cstring>
#include <span>

#include "glint/gltf/scene_file.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/read_files.h"

namespace glint::stability {

Document::Document() {
  std::error_code error;
  const auto base = std::filesystem::temp_directory_path(error);
  std::string name = (base / "glint-stability-XXXXXX").string();
  if (error || !mkdtemp(name.data()))
    throw InputError(
        "cannot make a temporary folder: set TMPDIR to an existing folder that can be written");
  folder_ = name;
}

Document::~Document() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

int Document::view(const void* data, std::size_t bytes) {
  const std::size_t offset = binary_.size();
  const auto* begin = static_cast<const unsigned char*>(data);
  binary_.insert(binary_.end(), begin, begin + bytes);
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
  return int(json["bufferViews"].size()) - 1;
}

template <class Value>
int Document::add(const std::string& type, int componentType, const std::vector<Value>& values) {
  const std::size_t components = type == "SCALAR" ? 1 : std::size_t(type[3] - '0');
  json["accessors"].push_back({{"bufferView", view(values.data(), values.size() * sizeof(Value))},
                               {"componentType", componentType},
                               {"type", type},
                               {"count", values.size() / components}});
  return int(json["accessors"].size()) - 1;
}

int Document::accessor(const std::string& type, const std::vector<float>& values) {
  return add(type, 5126, values);
}

int Document::indices(const std::vector<std::uint32_t>& values) {
  return add("SCALAR", 5125, values);
}

int Document::shorts(const std::string& type, const std::vector<std::uint16_t>& values) {
  return add(type, 5123, values);
}

void Document::show(nlohmann::json primitive) {
  json["meshes"].push_back({{"primitives", {std::move(primitive)}}});
  json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
  json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
}

void Document::triangle(const std::vector<float>& normals) {
  nlohmann::json attributes = {{"POSITION", accessor("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0})}};
  if (!normals.empty()) attributes["NORMAL"] = accessor("VEC3", normals);
  show({{"attributes", attributes}});
}

Scene Document::load() {
  nlohmann::json whole = json;
  if (!binary_.empty()) whole["buffers"] = {{{"byteLength", binary_.size()}}};
  std::string text = whole.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::vector<unsigned char> body = binary_;
  body.resize((body.size() + 3) / 4 * 4, 0);
  const auto number = [](std::size_t value) {
    const auto word = std::uint32_t(value);
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &word, 4);
    return bytes;
  };
  const std::size_t size = 12 + 8 + text.size() + (body.empty() ? 0 : 8 + body.size());
  std::string file = "glTF" + number(2) + number(size) + number(text.size()) + "JSON" + text;
  if (!body.empty()) {
    file += number(body.size()) + std::string("BIN\0", 4);
    file.append(body.begin(), body.end());
  }
  const std::string path = (folder_ / "case.glb").string();
  forgetReadFile(path);  // the previous case's file is not read any more
  OutputFile output(path);
  output.write(file);
  output.commit();
  return loadGltf(path);
}

}  // namespace glint::stability
