#include "glint/gltf/model_hash.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "glint/gltf/file.h"
#include "glint/gltf/patch.h"
#include "glint/image/error.h"
#include "glint/image/file.h"

namespace glint {
namespace {

// FNV-1a's step on words of eight bytes, with the high half mixed down, since a product carries
// nothing to its lower bits.
std::uint64_t step(std::uint64_t state, std::uint64_t word) {
  state = (state ^ word) * 0x100000001b3u;
  return state ^ (state >> 32);
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
  std::vector<std::byte> bytes;
  try {
    bytes = readFile(path);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    hash.add(text);
    if (text.find("\"uri\"") == std::string_view::npos) return hash.text();
    const auto folder = std::filesystem::path(path).parent_path();
    std::vector<char> part(std::size_t(1) << 16);
    for (const std::string& name : referredFiles(bytes, path)) {
      std::string error;
      const gltf::ByteSource source = gltf::openUri(name, folder, error);
      for (std::uint64_t at = 0; at < source.size(); at += part.size()) {
        const auto count = std::size_t(std::min<std::uint64_t>(part.size(), source.size() - at));
        if (!source.read(part.data(), at, count)) break;
        hash.add({part.data(), count});
      }
    }
  } catch (const InputError&) {
  }
  return hash.text();
}

}  // namespace glint
