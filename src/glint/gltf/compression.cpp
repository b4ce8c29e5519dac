#include "glint/gltf/compression.h"

#include <cstring>
#include <limits>
#include <set>
#include <vector>

#include "glint/gltf/draco.h"
#include "glint/gltf/meshopt.h"

namespace glint::gltf {
namespace {

/// More than this per compressed byte is an attack; the codecs' best is about a hundred.
constexpr std::uint64_t maxGrowth = 512;
constexpr std::int64_t maxCompressedBytes = std::int64_t(1) << 32;

constexpr const char* meshopt = "EXT_meshopt_compression";
constexpr const char* draco = "KHR_draco_mesh_compression";

class Decompressor {
 public:
  Decompressor(Document& document, const Messages& messages)
      : document_(document), messages_(messages), root_(document.json, messages) {}

  bool run() {
    if (readsCompression(meshopt)) decodeViews();
    if (readsCompression(draco)) decodePrimitives();
    return changed_;
  }

 private:
  std::vector<unsigned char> read(Cursor place, std::size_t buffer, std::uint64_t offset,
                                  std::uint64_t size) {
    std::vector<unsigned char> bytes;
    const ByteSource& source = document_.buffers[buffer];
    if (offset > source.size() || size > source.size() - offset) {
      place.fail("extends past the end of buffers[" + std::to_string(buffer) + "], which has " +
                 std::to_string(source.size()) + " bytes");
    }
    bytes.resize(size);
    if (!source.read(bytes.data(), offset, bytes.size())) place.fail("cannot be read");
    return bytes;
  }

  int addBuffer(std::vector<unsigned char> bytes) {
    document_.json["buffers"].push_back({{"byteLength", bytes.size()}});
    document_.buffers.emplace_back(std::move(bytes));
    changed_ = true;
    return static_cast<int>(document_.buffers.size()) - 1;
  }

  void decodeViews() {
    for (const Cursor view : root_.member("bufferViews")) {
      const Cursor from = view.member("extensions").member(meshopt);
      if (!from.exists()) continue;
      const auto number = [&](const char* key) {
        return static_cast<std::uint64_t>(from.member(key).integer(0, 0, maxCompressedBytes));
      };
      const auto buffer =
          static_cast<std::size_t>(from.required("buffer").index(document_.buffers.size()));
      const std::vector<unsigned char> packed =
          read(from, buffer, number("byteOffset"), number("byteLength"));
      MeshoptStream stream;
      stream.count = number("count");
      stream.stride = number("byteStride");
      stream.mode = from.required("mode").text();
      stream.filter = from.member("filter").text("NONE");
      if (stream.stride > 256 || stream.count * stream.stride > maxGrowth * (packed.size() + 64))
        from.fail("expands to far more than its data allow");
      std::vector<unsigned char> plain(stream.count * stream.stride);
      if (const std::string error = decodeMeshopt(stream, packed, plain); !error.empty())
        from.fail(error);
      const auto told =
          static_cast<std::uint64_t>(view.required("byteLength").integer(0, 0, maxCompressedBytes));
      if (told > plain.size()) {
        from.fail("holds " + std::to_string(plain.size()) + " bytes of the " +
                  std::to_string(told) + " of its buffer view");
      }
      view.json()["buffer"] = addBuffer(std::move(plain));
      view.json()["byteOffset"] = 0;
    }
  }

  /// Adds an accessor with its own buffer.
  std::size_t addAccessor(Json accessor, std::vector<unsigned char> bytes) {
    Json& views = document_.json["bufferViews"];
    const std::size_t size = bytes.size();
    views.push_back({{"buffer", addBuffer(std::move(bytes))}, {"byteLength", size}});
    accessor["bufferView"] = views.size() - 1;
    accessor.erase("byteOffset");
    accessor.erase("sparse");
    Json& accessors = document_.json["accessors"];
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
  }

  void decodePrimitives() {
    for (const Cursor mesh : root_.member("meshes"))
      for (const Cursor primitive : mesh.member("primitives")) decodePrimitive(primitive);
  }

  void decodePrimitive(Cursor primitive) {
    const Cursor from = primitive.member("extensions").member(draco);
    if (!from.exists()) return;
    const Cursor views = root_.member("bufferViews");
    const auto view = static_cast<std::size_t>(from.required("bufferView").index(views.size()));
    const auto number = [&](const char* key) {
      return static_cast<std::uint64_t>(
          views.item(view).member(key).integer(0, 0, maxCompressedBytes));
    };
    const std::vector<unsigned char> packed =
        read(from,
             static_cast<std::size_t>(
                 views.item(view).required("buffer").index(document_.buffers.size())),
             number("byteOffset"), number("byteLength"));
    DracoMesh mesh(packed, maxGrowth);
    if (!mesh.error().empty()) from.fail(mesh.error());
    const std::size_t accessors = root_.member("accessors").size();
    std::vector<std::pair<std::string, std::size_t>> made;
    from.required("attributes").forEachMember([&](Cursor attribute) {
      const std::int64_t id = attribute.integer(0, 0, INT32_MAX);
      const std::string name = attribute.key();
      const Cursor target = primitive.member("attributes").member(name.c_str());
      if (!target.exists()) return;
      const Cursor accessor =
          root_.member("accessors").item(static_cast<std::size_t>(target.index(accessors)));
      Json description = accessor.json();
      std::vector<unsigned char> bytes;
      const std::string error = mesh.readAttribute(
          static_cast<std::uint32_t>(id),
          static_cast<int>(accessor.required("componentType").integer(0, 0, 1 << 16)),
          accessor.required("type").text(), bytes);
      if (!error.empty()) attribute.fail(error);
      description["count"] = mesh.points();
      made.emplace_back(name, addAccessor(std::move(description), std::move(bytes)));
    });
    for (const auto& [name, accessor] : made) primitive.json()["attributes"][name] = accessor;
    std::vector<unsigned char> bytes = mesh.indices();
    const std::size_t count = bytes.size() / 4;
    primitive.json()["indices"] = addAccessor(
        {{"componentType", 5125}, {"type", "SCALAR"}, {"count", count}}, std::move(bytes));
    primitive.json()["mode"] = 4;
  }

  Document& document_;
  const Messages& messages_;
  Cursor root_;
  bool changed_ = false;
};

}  // namespace

bool readsCompression(const std::string& extension) {
  return (extension == meshopt && hasMeshopt()) || (extension == draco && hasDraco());
}

bool decompress(Document& document, const Messages& messages) {
  return Decompressor(document, messages).run();
}

}  // namespace glint::gltf
