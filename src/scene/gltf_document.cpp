#include "glint/scene/gltf_document.h"

#include <algorithm>
#include <charconv>

#include "glint/scene/gltf_check.h"
#include "glint/scene/gltf_file.h"

namespace glint::gltf {
namespace {

using Bytes = std::vector<unsigned char>;

/// More than any GPU holds; many buffers may name the same large file.
constexpr std::uint64_t maxBufferBytes = std::uint64_t(8) << 30;

Bytes readBuffer(Cursor buffer, std::size_t index, Container& container,
                 const std::filesystem::path& folder, const Messages& messages) {
  const std::string label = "buffers[" + std::to_string(index) + "]";
  const auto wanted =
      static_cast<std::uint64_t>(buffer.member("byteLength").integer(0, 0, INT64_MAX));
  Bytes bytes;
  if (const Cursor uri = buffer.member("uri"); uri.exists()) {
    std::string error;
    const std::string text = uri.text();
    bytes = readUri<unsigned char>(text, folder, wanted, error);
    if (!error.empty()) {
      messages.fail(label + ", the file \"" + printableUri(text) + "\", " + error,
                    "put it there or export the model as .glb");
    }
  } else if (index == 0 && container.binary) {
    bytes = std::move(*container.binary);
  } else {
    messages.fail(label + " has neither a uri nor a binary GLB chunk");
  }
  if (bytes.size() < wanted) {
    messages.fail(label + " tells " + std::to_string(wanted) + " bytes and has " +
                  std::to_string(bytes.size()));
  }
  bytes.resize(wanted);
  return bytes;
}

std::vector<Bytes> readBuffers(Cursor root, Container& container,
                               const std::filesystem::path& folder, const Messages& messages) {
  const Cursor list = root.member("buffers");
  std::vector<Bytes> buffers;
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    total += static_cast<std::uint64_t>(list.item(i).member("byteLength").integer(0, 0, INT64_MAX));
    if (total > maxBufferBytes) {
      messages.fail("its buffers hold more than 8 GiB", "split the model");
    }
    buffers.push_back(readBuffer(list.item(i), i, container, folder, messages));
  }
  return buffers;
}

/// What glint does not read, tinygltf need not either.
void dropExtras(Json& json) {
  if (json.is_object()) {
    json.erase("extensions");
    json.erase("extras");
  }
  if (!json.is_structured()) return;
  for (Json& value : json) {
    if (value.is_structured()) dropExtras(value);
  }
}

/// The part of the document that tinygltf reads, taken out of `json`. Buffers are named by their
/// number, under which the callbacks hand them over.
std::string takeGeometry(Json& json, const std::vector<Bytes>& buffers) {
  Json part = {{"asset", {{"version", "2.0"}}}};
  for (const char* section : {"bufferViews", "accessors", "meshes", "nodes", "skins", "scenes"}) {
    const auto found = json.find(section);
    if (found == json.end()) continue;
    part[section] = std::move(*found);
    json.erase(found);
    dropExtras(part[section]);
  }
  if (part.contains("accessors")) {
    for (Json& accessor : part["accessors"]) {
      accessor.erase("min");
      accessor.erase("max");
    }
  }
  if (const auto scene = json.find("scene"); scene != json.end()) part["scene"] = *scene;
  json.erase("buffers");
  Json& list = part["buffers"] = Json::array();
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    list.push_back({{"byteLength", buffers[i].size()}, {"uri", std::to_string(i)}});
  }
  return part.dump();
}

bool readNumberedBuffer(Bytes* out, std::string*, const std::string& name, void* user) {
  auto& buffers = *static_cast<std::vector<Bytes>*>(user);
  std::size_t index = buffers.size();
  std::from_chars(name.data(), name.data() + name.size(), index);
  if (index >= buffers.size()) return false;
  out->swap(buffers[index]);
  return true;
}

}  // namespace

Document readDocument(const std::filesystem::path& path, Messages& messages) {
  Container container = readContainer(path, messages);
  Document document;
  document.path = path;
  document.json = parseJson(container.json, messages);
  container.json = {};
  checkDocument(document.json, messages);
  std::vector<Bytes> buffers =
      readBuffers(Cursor(document.json, messages), container, path.parent_path(), messages);
  for (Bytes& buffer : buffers) {
    document.bufferBytes += buffer.size();
    if (buffer.empty()) buffer.push_back(0);  // tinygltf takes an empty file for a missing one
  }

  const std::string geometry = takeGeometry(document.json, buffers);
  tinygltf::TinyGLTF reader;
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = [](const std::string&, void*) { return true; };
  callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
  callbacks.ReadWholeFile = readNumberedBuffer;
  callbacks.user_data = &buffers;
  reader.SetFsCallbacks(callbacks);
  std::string errors, warnings;
  if (!reader.LoadASCIIFromString(&document.model, &errors, &warnings, geometry.data(),
                                  static_cast<unsigned>(geometry.size()), "")) {
    messages.fail("is not glTF 2.0, " + printable(errors));
  }
  return document;
}

Budget::Budget(std::uint64_t bufferBytes, const Messages& messages)
    : readable_((std::uint64_t(1) << 26) + 64 * bufferBytes),
      keepable_(std::min((std::uint64_t(1) << 24) + 4 * bufferBytes, std::uint64_t(1) << 28)),
      messages_(&messages) {}

void Budget::read(std::uint64_t elements) {
  if (elements > readable_) exceeded();
  readable_ -= elements;
}

void Budget::keep(std::uint64_t vertices) {
  if (vertices > keepable_) exceeded();
  keepable_ -= vertices;
}

void Budget::exceeded() const {
  messages_->fail("unfolds to far more vertices than it holds data for", "split the model");
}

}  // namespace glint::gltf
