#include "glint/gltf/document.h"

#include <algorithm>

#include "glint/gltf/check.h"
#include "glint/gltf/compression.h"
#include "glint/gltf/extensions.h"
#include "glint/gltf/file.h"
#include "glint/gltf/geometry_reader.h"

namespace glint::gltf {
namespace {

/// Longer stretches are read in pieces, each when it is needed.
constexpr std::uint64_t maxHeldBytes = std::uint64_t(16) << 20;

/// More than any GPU holds; many buffers may name the same large file.
constexpr std::uint64_t maxGeometryBytes = std::uint64_t(8) << 30;

ByteSource openBuffer(Cursor buffer, std::size_t index, const Container& container,
                      const std::filesystem::path& model, bool& absent, Messages& messages) {
  const char* const meshopt = "EXT_meshopt_compression";
  const std::string label = "buffers[" + std::to_string(index) + "]";
  const auto wanted =
      static_cast<std::uint64_t>(buffer.member("byteLength").integer(0, 0, INT64_MAX));
  ByteSource source;
  if (const Cursor uri = buffer.member("uri"); uri.exists()) {
    std::string error;
    const std::string text = uri.text();
    source = openUri(text, model, error);
    if (const std::string oddity = oddityOf(text); !oddity.empty())
      messages.warn(label + ", the file \"" + printableUri(text) + "\", " + oddity);
    if (!error.empty()) {
      messages.fail(label + ", the file \"" + printableUri(text) + "\", " + error,
                    error == liesOutside ? "use a model whose files are next to it"
                                         : "put it there or export the model as .glb");
    }
  } else if (index == 0 && container.binary) {
    source = *container.binary;
  } else if (readsCompression(meshopt) && buffer.member("extensions").member(meshopt).exists()) {
    return ByteSource(std::vector<unsigned char>());  // a placeholder for the compressed data
  } else {
    absent = true;
    return source;
  }
  if (source.size() < wanted) {
    messages.fail(label + " declares " + std::to_string(wanted) + " bytes but has " +
                  std::to_string(source.size()));
  }
  return source;
}

std::vector<ViewPlace> placeViews(Cursor root) {
  std::vector<ViewPlace> views;
  for (const Cursor view : root.member("bufferViews")) {
    const auto number = [&](const char* key) {
      return static_cast<std::uint64_t>(view.member(key).integer(0, 0, INT64_MAX));
    };
    views.push_back({number("buffer"), number("byteOffset"), number("byteLength")});
  }
  return views;
}

/// How far from its beginning accessors read each buffer view; 0: no accessor uses it.
std::vector<std::uint64_t> endsOfViews(Cursor root, std::size_t count) {
  std::vector<std::uint64_t> ends(count, 0);
  const auto use = [&](Cursor owner, std::uint64_t bytes) {
    const int view = owner.member("bufferView").index(count);
    if (view < 0) return;
    std::uint64_t& end = ends[static_cast<std::size_t>(view)];
    const auto offset =
        static_cast<std::uint64_t>(owner.member("byteOffset").integer(0, 0, INT64_MAX));
    end = std::max(end, offset + bytes);
  };
  const Cursor views = root.member("bufferViews");
  for (const Cursor accessor : root.member("accessors")) {
    const int view = accessor.member("bufferView").index(count);
    if (view >= 0)
      use(accessor,
          spanOfElements(
              accessor,
              views.item(static_cast<std::size_t>(view)).member("byteStride").integer(0, 0, 252)));
    const Cursor sparse = accessor.member("sparse");
    if (!sparse.exists()) continue;
    const auto values =
        static_cast<std::uint64_t>(sparse.member("count").integer(0, 0, UINT32_MAX));
    const Cursor indices = sparse.member("indices");
    use(indices, values * static_cast<std::uint64_t>(componentBytes(
                              indices.member("componentType").integer(0, 0, INT32_MAX))));
    // An element of VEC4 or MAT4 has at most 64 bytes; any excess is cut at the view's end.
    use(sparse.member("values"), values * 64);
  }
  return ends;
}

std::vector<std::string> readVariants(Cursor root) {
  std::vector<std::string> names;
  for (const Cursor variant :
       root.member("extensions").member("KHR_materials_variants").member("variants"))
    names.push_back(variant.name());
  return names;
}

/// Whether more than one pose can be requested, in which case primitives' data are read repeatedly.
bool canMove(Cursor root, const Document& document) {
  return root.member("animations").size() > 0 || root.member("skins").size() > 0 ||
         !document.morphs.empty() || !readVariants(root).empty();
}

/// Finds the stretch of each buffer that contains the views used by accessors, and reads it.
void readGeometry(Cursor root, Document& document, const Messages& messages) {
  const std::vector<std::uint64_t> used = endsOfViews(root, document.views.size());
  document.stretches.resize(document.buffers.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] == 0) continue;
    const ViewPlace& view = document.views[i];
    if (document.absent[view.buffer]) continue;
    Document::Stretch& stretch = document.stretches[view.buffer];
    const std::uint64_t end = view.offset + std::min(used[i], view.size);
    stretch.first = stretch.end > 0 ? std::min(stretch.first, view.offset) : view.offset;
    stretch.end = std::max(stretch.end, end);
  }
  const bool moves = canMove(root, document);
  for (std::size_t i = 0; i < document.stretches.size(); ++i) {
    Document::Stretch& stretch = document.stretches[i];
    stretch.end = std::max(stretch.first, stretch.end);
    document.geometryBytes += stretch.end - stretch.first;
    if (document.geometryBytes > maxGeometryBytes) {
      messages.fail("its buffers are larger than 8 GiB", "split the model");
    }
    if (!moves && stretch.end - stretch.first > maxHeldBytes) continue;
    stretch.bytes.resize(stretch.end - stretch.first);
    if (!stretch.bytes.empty() &&
        !document.buffers[i].read(stretch.bytes.data(), stretch.first, stretch.bytes.size())) {
      messages.fail("buffers[" + std::to_string(i) + "] cannot be read", "check the disk");
    }
  }
}

std::vector<Document::NodeExtension> readNodeExtensions(Cursor root) {
  const std::size_t lights = lightsOf(root).size();
  std::vector<Document::NodeExtension> result;
  for (const Cursor node : root.member("nodes")) {
    const Cursor extensions = node.member("extensions");
    result.push_back({extensions.member("KHR_lights_punctual").member("light").index(lights),
                      extensions.member("KHR_node_visibility").member("visible").boolean(true)});
  }
  return result;
}

/// Removes the primitives' indices and returns them in order (-1: none). tinygltf refuses indices
/// without a buffer view, but zeros and their replacements in a sparse accessor are valid.
std::vector<int> takeIndices(Cursor root) {
  std::vector<int> result;
  for (const Cursor mesh : root.member("meshes")) {
    for (const Cursor primitive : mesh.member("primitives")) {
      result.push_back(primitive.member("indices").index(root.member("accessors").size()));
      primitive.json().erase("indices");
    }
  }
  return result;
}

/// Extension data of primitives and nodes.
Document::Pieces readPieces(Cursor root) {
  Document::Pieces pieces;
  const std::size_t accessors = root.member("accessors").size();
  const std::size_t materials = root.member("materials").size();
  const Cursor meshes = root.member("meshes");
  const std::size_t variants = readVariants(root).size();
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const Cursor primitives = meshes.item(i).member("primitives");
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      const Cursor extensions = primitives.item(k).member("extensions");
      for (const Cursor mapping : extensions.member("KHR_materials_variants").member("mappings")) {
        const int material = mapping.required("material").index(materials);
        for (const Cursor variant : mapping.required("variants"))
          pieces.variantMaterials[{i, k}][variant.index(variants)] = material;
      }
    }
  }
  const Cursor nodes = root.member("nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Cursor attributes =
        nodes.item(i).member("extensions").member("EXT_mesh_gpu_instancing").member("attributes");
    attributes.forEachMember([&](Cursor attribute) {
      pieces.instancing[i][attribute.key()] = attribute.index(accessors);
    });
  }
  return pieces;
}

/// Data that glint does not read need not reach tinygltf.
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

/// The part of the document for tinygltf, removed from `json`, with one placeholder buffer.
std::string takeGeometry(Json& json) {
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
  part["buffers"] = {{{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}}};
  if (part.contains("bufferViews")) {
    for (Json& view : part["bufferViews"]) view["buffer"] = 0;
  }
  return part.dump();
}

}  // namespace

int Document::absentBufferOf(int accessor) const {
  const auto absentView = [&](int view) {
    if (view < 0) return -1;
    const std::size_t buffer = views[static_cast<std::size_t>(view)].buffer;
    return absent[buffer] ? static_cast<int>(buffer) : -1;
  };
  const tinygltf::Accessor& a = model.accessors[static_cast<std::size_t>(accessor)];
  int found = absentView(a.bufferView);
  if (a.sparse.isSparse) {
    found = std::max(found, absentView(a.sparse.indices.bufferView));
    found = std::max(found, absentView(a.sparse.values.bufferView));
  }
  return found;
}

Cursor lightsOf(Cursor root) {
  return root.member("extensions").member("KHR_lights_punctual").member("lights");
}

Document readDocument(const std::filesystem::path& path, Messages& messages) {
  Container container = readContainer(path, messages);
  Document document;
  document.path = path;
  document.json = parseJson(container.json, messages);
  container.json = {};
  checkDocument(document.json, messages);
  const Cursor root(document.json, messages);
  const Cursor list = root.member("buffers");
  for (std::size_t i = 0; i < list.size(); ++i) {
    bool absent = false;
    document.buffers.push_back(openBuffer(list.item(i), i, container, path, absent, messages));
    document.absent.push_back(absent);
  }
  if (decompress(document, messages)) checkStructure(document.json, messages);
  document.absent.resize(document.buffers.size(), false);
  document.views = placeViews(root);
  document.nodeExtensions = readNodeExtensions(root);
  document.extensions = extensionsOf(root);
  document.skins = skinsOf(root);
  document.morphs = morphsOf(root);
  readGeometry(root, document, messages);
  const std::vector<int> indices = takeIndices(root);
  document.variants = readVariants(root);
  document.pieces = readPieces(root);
  const std::string geometry = takeGeometry(document.json);
  if (const std::string error = readGeometryModel(document.model, geometry); !error.empty()) {
    messages.fail("is not glTF 2.0, " + printable(error));
  }
  auto next = indices.begin();
  for (auto& mesh : document.model.meshes) {
    for (auto& primitive : mesh.primitives) primitive.indices = *next++;
  }
  return document;
}

Budget::Budget(std::uint64_t geometryBytes, const Messages& messages)
    : readable_((std::uint64_t(1) << 25) + 64 * geometryBytes),
      keepable_(std::min((std::uint64_t(1) << 22) + 4 * geometryBytes, std::uint64_t(1) << 28)),
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
  messages_->fail("expands to far more vertices than its data allow", "split the model");
}

}  // namespace glint::gltf
