#include "glint/gltf/geometry_reader.h"

#include <tiny_gltf.h>

#include <charconv>
#include <limits>
#include <type_traits>

namespace glint::gltf {
namespace {

using Buffers = std::vector<std::vector<unsigned char>>;

/// The buffer that a file's name stands for, or null.
std::vector<unsigned char>* numberedBuffer(const std::string& name, void* user) {
  auto& buffers = *static_cast<Buffers*>(user);
  std::size_t index = buffers.size();
  std::from_chars(name.data(), name.data() + name.size(), index);
  return index < buffers.size() ? &buffers[index] : nullptr;
}

bool readNumbered(std::vector<unsigned char>* out, std::string*, const std::string& name,
                  void* user) {
  std::vector<unsigned char>* buffer = numberedBuffer(name, user);
  if (buffer == nullptr) return false;
  out->swap(*buffer);
  return true;
}

/// Versions from 2.9 on take no callbacks unless all are there, the sizes of files too, and refuse
/// files above 2 GiB unless told otherwise.
template <class Callbacks>
void addLaterCallbacks(Callbacks& callbacks) {
  if constexpr (requires { callbacks.GetFileSizeInBytes; })
    callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string& name,
                                      void* user) {
      const auto* buffer = numberedBuffer(name, user);
      if (buffer != nullptr) *size = buffer->size();
      return buffer != nullptr;
    };
}

template <class Reader, class Callbacks>
bool setCallbacks(Reader& reader, const Callbacks& callbacks) {
  if constexpr (requires { reader.SetMaxExternalFileSize(std::size_t()); })
    reader.SetMaxExternalFileSize(std::numeric_limits<std::size_t>::max());
  if constexpr (std::is_void_v<decltype(reader.SetFsCallbacks(callbacks))>) {
    reader.SetFsCallbacks(callbacks);
    return true;
  } else {
    return reader.SetFsCallbacks(callbacks);
  }
}

}  // namespace

std::string readGeometryModel(tinygltf::Model& model, const std::string& text, Buffers& buffers) {
  tinygltf::TinyGLTF reader;
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = [](const std::string&, void*) { return true; };
  callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
  callbacks.ReadWholeFile = readNumbered;
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                                void*) { return false; };
  callbacks.user_data = &buffers;
  addLaterCallbacks(callbacks);
  if (!setCallbacks(reader, callbacks)) return "this version of tinygltf reads no buffers";
  // The parameter that tells the length has 32 bits.
  if (text.size() > std::numeric_limits<unsigned>::max()) return "its text has more than 4 GiB";
  std::string errors, warnings;
  if (!reader.LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                  static_cast<unsigned>(text.size()), ""))
    return errors.empty() ? "for a reason that tinygltf does not tell" : errors;
  return {};
}

}  // namespace glint::gltf
