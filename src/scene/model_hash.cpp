#include "glint/scene/model_hash.h"

#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "gltf_file.h"

namespace glint {
namespace {

using Json = nlohmann::json;

// FNV-1a's step on words of eight bytes, with the high half mixed down, since a product carries
// nothing to its lower bits.
std::uint64_t step(std::uint64_t state, std::uint64_t word) {
  state = (state ^ word) * 0x100000001b3u;
  return state ^ (state >> 32);
}

// The names of other files, in the order of the document.
std::vector<std::string> filesNamed(std::string_view json) {
  std::vector<std::string> names;
  const Json document = Json::parse(json, nullptr, false);
  if (!document.is_object()) return names;
  for (const char* list : {"buffers", "images"}) {
    const auto found = document.find(list);
    if (found == document.end() || !found->is_array()) continue;
    for (const Json& each : *found) {
      if (!each.is_object() || !each.contains("uri") || !each["uri"].is_string()) continue;
      const auto& uri = each["uri"].get_ref<const std::string&>();
      if (!uri.starts_with("data:")) names.push_back(uri);
    }
  }
  return names;
}

// The JSON of a model file as it stands in it; empty for other files.
std::string_view jsonIn(std::string_view file) {
  if (!file.starts_with("glTF")) return file;
  if (file.size() < 20) return {};
  std::uint32_t length = 0;
  for (std::size_t i = 0; i < 4; ++i)
    length |= std::uint32_t(static_cast<unsigned char>(file[12 + i])) << (8 * i);
  return file.substr(20, length);
}

}  // namespace

void Hash::add(std::string_view bytes) {
  std::uint64_t state = step(state_, bytes.size());
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t word = 0;
    for (std::size_t b = 0; b < 8; ++b)
      word |= std::uint64_t(static_cast<unsigned char>(bytes[i + b])) << (8 * b);
    state = step(state, word);
  }
  for (; i < bytes.size(); ++i) state = step(state, static_cast<unsigned char>(bytes[i]));
  state_ = state;
}

std::string Hash::text() const {
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[state_ >> shift & 15];
  return digits;
}

std::string modelHash(const std::string& path) {
  Hash hash;
  const auto addFile = [&](const std::string& name) -> std::vector<std::byte> {
    std::vector<std::byte> bytes;
    try {
      bytes = readFile(name);
    } catch (const InputError&) {
    }
    hash.add({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return bytes;
  };
  const auto bytes = addFile(path);
  const std::string_view json = jsonIn({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (json.find("\"uri\"") == std::string_view::npos) return hash.text();
  const auto folder = std::filesystem::path(path).parent_path();
  for (const std::string& name : filesNamed(json)) {
    std::string error;
    const gltf::ByteSource source = gltf::openUri(name, folder, error);
    std::vector<char> part(std::size_t(1) << 20);
    for (std::uint64_t at = 0; at < source.size(); at += part.size()) {
      const auto count = std::size_t(std::min<std::uint64_t>(part.size(), source.size() - at));
      if (!source.read(part.data(), at, count)) break;
      hash.add({part.data(), count});
    }
  }
  return hash.text();
}

}  // namespace glint
