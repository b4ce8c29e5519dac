#include "glint/gltf/model_hash.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "glint/gltf/file.h"
#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/json_text.h"

namespace glint {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t maxBytes = std::uint64_t(8) << 30, maxImageBytes = std::uint64_t(256) << 20;
// A GLB chunk up to this size is hashed whole, which is faster than determining which part is
// needed.
constexpr std::uint64_t smallChunk = std::uint64_t(64) << 20;

// FNV-1a's step on eight-byte words, with the high half mixed down, since a product carries nothing
// to its lower bits.
std::uint64_t step(std::uint64_t state, std::uint64_t word) {
  state = (state ^ word) * 0x100000001b3u;
  return state ^ (state >> 32);
}

std::uint64_t numberOf(const Json& from, const char* key) {
  const auto found = from.find(key);
  const bool known = found != from.end() && found->is_number_unsigned();
  return known ? std::min(found->get<std::uint64_t>(), maxBytes) : 0;
}

// How much of the data that a file refers to can be needed for loading it.
class Needs {
 public:
  explicit Needs(const Json& root) : root_(root) {
    each("bufferViews", [&](const Json&) { views_.push_back(0); });
    each("accessors", [&](const Json& accessor) {
      useElements(accessor, numberOf(accessor, "count"));
      const auto sparse = accessor.find("sparse");
      if (sparse == accessor.end() || !sparse->is_object()) return;
      for (const Json& part : *sparse)
        if (part.is_object()) useElements(part, numberOf(*sparse, "count"));
    });
    for (auto it = root.begin(); it != root.end(); ++it)
      if (it.key() != "accessors") useWhole(*it, it.key() == "images" ? maxImageBytes : maxBytes);
  }

  /// Bytes needed of the GLB chunk, which is the first buffer if that has no name.
  std::uint64_t chunk() const {
    const std::vector<std::uint64_t> all = ends();
    const auto buffers = root_.find("buffers");
    const bool has = buffers != root_.end() && buffers->is_array() && !buffers->empty() &&
                     !(*buffers)[0].contains("uri");
    return has && !all.empty() ? all[0] : 0;
  }

  /// Bytes needed of each file by name, in order; `whole`: all, or none if it is larger than any
  /// picture.
  std::vector<std::pair<std::string, std::uint64_t>> files() const {
    const std::vector<std::uint64_t> ends = this->ends();
    std::vector<std::pair<std::string, std::uint64_t>> files;
    std::map<std::string, std::size_t> places;
    const auto name = [&](const Json& item, std::uint64_t bytes) {
      const auto uri = item.find("uri");
      if (uri == item.end() || !uri->is_string()) return;
      const auto& text = uri->get_ref<const std::string&>();
      if (gltf::isDataUri(text)) return;
      const auto [place, isNew] = places.try_emplace(text, files.size());
      if (isNew) files.emplace_back(text, 0);
      files[place->second].second = std::max(files[place->second].second, bytes);
    };
    std::size_t number = 0;
    each("buffers", [&](const Json& item) {
      name(item, number < ends.size() ? ends[number] : 0);
      ++number;
    });
    each("images", [&](const Json& item) { name(item, whole); });
    return files;
  }

  static constexpr std::uint64_t whole = UINT64_MAX;

 private:
  template <typename Take>
  void each(const char* list, const Take& take) const {
    const auto found = root_.find(list);
    if (found == root_.end() || !found->is_array()) return;
    static const Json nothing = Json::object();
    for (const Json& item : *found) take(item.is_object() ? item : nothing);
  }

  // The end of the needed part of each buffer.
  std::vector<std::uint64_t> ends() const {
    std::vector<std::uint64_t> ends;
    const auto use = [&](const Json& view, std::uint64_t bytes) {
      const std::uint64_t buffer = numberOf(view, "buffer");
      if (buffer >= 1u << 20 || bytes == 0) return;
      if (ends.size() <= buffer) ends.resize(buffer + 1, 0);
      ends[buffer] = std::max(ends[buffer], numberOf(view, "byteOffset") + bytes);
    };
    std::size_t number = 0;
    each("bufferViews", [&](const Json& view) {
      use(view, std::min(views_[number++], numberOf(view, "byteLength")));
      const auto extensions = view.find("extensions");
      if (extensions == view.end() || !extensions->is_object()) return;
      for (const Json& extension : *extensions)  // EXT_meshopt_compression
        if (extension.is_object()) use(extension, numberOf(extension, "byteLength"));
    });
    return ends;
  }

  // A user of a view: there are at most 252 bytes between elements.
  void useElements(const Json& from, std::uint64_t count) {
    if (from.contains("bufferView"))
      use(numberOf(from, "bufferView"), numberOf(from, "byteOffset") + 256 * count);
  }

  void use(std::uint64_t view, std::uint64_t bytes) {
    if (view < views_.size()) views_[view] = std::max(views_[view], bytes);
  }

  // Any other user of a view reads all of it, unless it is larger than `most`.
  void useWhole(const Json& json, std::uint64_t most) {
    if (json.is_object() && json.contains("bufferView")) {
      const std::uint64_t view = numberOf(json, "bufferView");
      const auto list = root_.find("bufferViews");
      if (view < views_.size() && numberOf((*list)[view], "byteLength") <= most) use(view, most);
    }
    if (!json.is_structured()) return;
    for (const Json& item : json)
      if (item.is_structured()) useWhole(item, most);
  }

  const Json& root_;
  std::vector<std::uint64_t> views_;  ///< bytes needed from each view's beginning
};

// Adds the beginning of a source; false if it cannot be read.
template <typename Source>
bool addBytes(Hash& hash, const Source& source, std::uint64_t size) {
  std::vector<char> part(std::size_t(1) << 16);
  for (std::uint64_t at = 0; at < size; at += part.size()) {
    const auto count = std::size_t(std::min<std::uint64_t>(part.size(), size - at));
    if (!source.read(part.data(), at, count)) return false;
    hash.add({part.data(), count});
  }
  return true;
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
  try {
    const gltf::Container container = gltf::readContainer(path, gltf::Messages(path));
    hash.add(container.json);
    const std::uint64_t chunk = container.binary ? container.binary->size() : 0;
    const bool names = container.json.find("\"uri\"") != std::string::npos;
    if (!names && chunk <= smallChunk) {
      if (chunk > 0) addBytes(hash, *container.binary, chunk);
      return hash.text();
    }
    std::string error;
    const auto root = parseJsonText<Json>(container.json, error);
    if (!root || !root->is_object()) return hash.text();
    const Needs needs(*root);
    if (chunk > 0) addBytes(hash, *container.binary, std::min(chunk, needs.chunk()));
    std::uint64_t left = maxBytes;
    for (const auto& [name, needed] : needs.files()) {
      error.clear();
      const gltf::ByteSource source = gltf::openUri(name, path, error);
      std::uint64_t size = std::min({needed, source.size(), left});
      if (needed == Needs::whole && source.size() > maxImageBytes) size = 0;
      addBytes(hash, source, size);
      left -= size;
    }
  } catch (const InputError&) {
  } catch (const std::bad_alloc&) {
  }
  return hash.text();
}

std::string fileHash(const std::string& path) {
  Hash hash;
  std::string error;
  const gltf::RegularFile file(path, {}, error);
  if (error.empty()) addBytes(hash, file, std::min<std::uint64_t>(file.size(), maxFileBytes));
  return hash.text();
}

}  // namespace glint
