#include "glint/gltf/check.h"

#include <algorithm>
#include <climits>
#include <vector>

#include "glint/gltf/extensions.h"

namespace glint::gltf {
namespace {

/// More bytes than any file has, yet small enough that sums of a few cannot overflow.
constexpr std::int64_t maxBytes = std::int64_t(1) << 48;

/// "2.0" gives {2, 0}; {-1, 0} if it is not a version.
std::pair<int, int> versionOf(const std::string& text) {
  int major = -1, minor = 0, used = 0;
  if (std::sscanf(text.c_str(), "%4d.%4d%n", &major, &minor, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size()) {
    return {-1, 0};
  }
  return {major, minor};
}

void checkAsset(Cursor root, const Messages& messages) {
  const char* const advice = "export it as glTF 2.0";
  const Cursor asset = root.required("asset");
  const std::string version = asset.required("version").text();
  if (versionOf(version).first != 2) {
    messages.fail("is glTF version \"" + printable(version, 20) + "\", only 2.x is supported",
                  advice);
  }
  const std::string least = asset.member("minVersion").text("2.0");
  if (versionOf(least) != std::pair(2, 0)) {
    messages.fail("needs glTF version \"" + printable(least, 20) + "\", only 2.0 is supported",
                  advice);
  }
}

void checkExtensions(Cursor root, Messages& messages) {
  for (const FileExtension& extension : extensionsOf(root)) {
    if (extension.use != FileExtension::Use::ignored) continue;
    if (extension.required) {
      messages.fail("requires the extension " + extension.name + ", which is " + extension.note,
                    "export it without that extension");
    }
    messages.warn("the extension " + extension.name + " is " + extension.note + " and is ignored");
  }
}

}  // namespace

std::int64_t componentBytes(std::int64_t componentType) {
  switch (componentType) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

namespace {

/// Bytes of one element, including the padding of matrix columns to four bytes; 0 if unknown. For
/// the `last` element the padding after its last column may be missing.
std::int64_t elementBytes(const std::string& type, std::int64_t component, bool last = false) {
  const auto columns = [&](std::int64_t n) {
    const std::int64_t padded = (n * component + 3) / 4 * 4;
    return last ? (n - 1) * padded + n * component : n * padded;
  };
  if (type == "SCALAR") return component;
  if (type == "VEC2") return 2 * component;
  if (type == "VEC3") return 3 * component;
  if (type == "VEC4") return 4 * component;
  if (type == "MAT2") return columns(2);
  if (type == "MAT3") return columns(3);
  if (type == "MAT4") return columns(4);
  return 0;
}

struct View {
  std::int64_t bytes = 0;
  std::int64_t stride = 0;  ///< 0 if none is given
};

std::vector<View> checkViews(Cursor root) {
  std::vector<std::int64_t> sizes;
  for (const Cursor buffer : root.member("buffers")) {
    sizes.push_back(buffer.required("byteLength").integer(0, 0, maxBytes));
    buffer.member("uri").text();
  }
  std::vector<View> views;
  for (const Cursor view : root.member("bufferViews")) {
    const int buffer = view.required("buffer").index(sizes.size());
    const std::int64_t offset = view.member("byteOffset").integer(0, 0, maxBytes);
    const std::int64_t bytes = view.required("byteLength").integer(0, 0, maxBytes);
    if (offset + bytes > sizes[static_cast<std::size_t>(buffer)]) {
      view.fail("ends at byte " + std::to_string(offset + bytes) + " of buffers[" +
                std::to_string(buffer) + "], which has " +
                std::to_string(sizes[static_cast<std::size_t>(buffer)]));
    }
    const std::int64_t stride = view.member("byteStride").integer(0, 0, 252);
    if (stride % 4 != 0) view.member("byteStride").fail("must be a multiple of 4");
    view.member("target").integer(0, 0, INT_MAX);
    views.push_back({bytes, stride});
  }
  return views;
}

/// Checks that `count` elements starting at `offset`, `stride` apart, the last with `bytes` bytes,
/// lie in the view.
void checkSpan(Cursor where, const View& view, std::int64_t offset, std::int64_t count,
               std::int64_t bytes, std::int64_t stride) {
  if (count == 0) return;
  if (count > maxBytes / 256 || offset + (count - 1) * stride + bytes > view.bytes) {
    where.fail("extends past the end of its buffer view, which has " + std::to_string(view.bytes) +
               " bytes");
  }
}

void checkSparse(Cursor sparse, const std::vector<View>& views, std::int64_t accessorCount,
                 std::int64_t bytes, std::int64_t lastBytes) {
  const std::int64_t count =
      sparse.required("count").integer(0, 0, std::min<std::int64_t>(accessorCount, INT_MAX));
  for (const char* part : {"indices", "values"}) {
    const Cursor cursor = sparse.required(part);
    const auto view = static_cast<std::size_t>(cursor.required("bufferView").index(views.size()));
    const std::int64_t offset = cursor.member("byteOffset").integer(0, 0, INT_MAX);
    std::int64_t size = bytes, last = lastBytes;
    if (part == std::string_view("indices")) {
      const std::int64_t type = cursor.required("componentType").integer(0, 0, INT_MAX);
      if (type != 5121 && type != 5123 && type != 5125) {
        cursor.member("componentType").fail("must be 5121, 5123 or 5125");
      }
      size = last = componentBytes(type);
    }
    checkSpan(cursor, views[view], offset, count, last, size);
  }
}

void checkAccessors(Cursor root, const std::vector<View>& views) {
  for (const Cursor accessor : root.member("accessors")) {
    const std::int64_t component =
        componentBytes(accessor.required("componentType").integer(0, 0, INT_MAX));
    if (component == 0) accessor.member("componentType").fail("is not defined in glTF 2.0");
    const std::int64_t bytes = elementBytes(accessor.required("type").text(), component);
    if (bytes == 0) accessor.member("type").fail("is not defined in glTF 2.0");
    const std::int64_t lastBytes = elementBytes(accessor.member("type").text(), component, true);
    const std::int64_t count = accessor.required("count").integer(0, 0, UINT32_MAX);
    const std::int64_t offset = accessor.member("byteOffset").integer(0, 0, maxBytes);
    accessor.member("normalized").boolean(false);
    if (const Cursor view = accessor.member("bufferView"); view.exists()) {
      const View& target = views[static_cast<std::size_t>(view.index(views.size()))];
      if (target.stride != 0 && target.stride < lastBytes) {
        accessor.fail("has elements of " + std::to_string(bytes) +
                      " bytes in a buffer view of byteStride " + std::to_string(target.stride));
      }
      checkSpan(accessor, target, offset, count, lastBytes, target.stride ? target.stride : bytes);
    }
    if (const Cursor sparse = accessor.member("sparse"); sparse.exists()) {
      checkSparse(sparse, views, count, bytes, lastBytes);
    }
  }
}

void checkAttributes(Cursor attributes, std::size_t accessors) {
  attributes.forEachMember([&](Cursor attribute) { attribute.index(accessors); });
}

/// Each entry takes a kilobyte, even an empty object; genuine models have some hundreds.
void checkCounts(Cursor root) {
  constexpr std::size_t most = 1 << 16;
  for (const char* list : {"materials", "textures", "images", "samplers", "animations", "skins"}) {
    const std::size_t count = root.member(list).size();
    if (count > most)
      root.member(list).fail("has " + std::to_string(count) + " entries, more than " +
                             std::to_string(most));
  }
}

void checkMeshes(Cursor root) {
  const std::size_t accessors = root.member("accessors").size();
  const std::size_t materials = root.member("materials").size();
  for (const Cursor mesh : root.member("meshes")) {
    mesh.member("weights").checkNumbers(0);
    for (const Cursor primitive : mesh.required("primitives")) {
      primitive.member("mode").integer(4, 0, 6);
      primitive.member("material").index(materials);
      checkAttributes(primitive.required("attributes"), accessors);
      for (const Cursor target : primitive.member("targets")) checkAttributes(target, accessors);
      const Cursor indices = primitive.member("indices");
      const int accessor = indices.index(accessors);
      if (accessor < 0) continue;
      const Cursor list = root.member("accessors").item(static_cast<std::size_t>(accessor));
      const std::int64_t type = list.member("componentType").integer(0, 0, INT_MAX);
      if (list.member("type").text() != "SCALAR" ||
          (type != 5121 && type != 5123 && type != 5125)) {
        indices.fail("refers to an accessor that is not of unsigned integers");
      }
    }
  }
}

void checkNodes(Cursor root) {
  const Cursor nodes = root.member("nodes");
  const std::size_t count = nodes.size();
  std::vector<int> parent(count, -1);
  std::vector<std::vector<std::size_t>> children(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Cursor node = nodes.item(i);
    node.member("mesh").index(root.member("meshes").size());
    node.member("skin").index(root.member("skins").size());
    node.member("camera").index(root.member("cameras").size());
    node.member("matrix").checkNumbers(16);
    node.member("translation").checkNumbers(3);
    node.member("rotation").checkNumbers(4);
    node.member("scale").checkNumbers(3);
    node.member("weights").checkNumbers(0);
    for (const Cursor each : node.member("children")) {
      const auto child = static_cast<std::size_t>(each.index(count));
      if (parent[child] >= 0) {
        each.fail("is node " + std::to_string(child) + ", already a child of node " +
                  std::to_string(parent[child]));
      }
      parent[child] = static_cast<int>(i);
      children[i].push_back(child);
    }
  }
  // Since nodes have at most one parent, a node that no root leads to is in a cycle or below one.
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < count; ++i) {
    if (parent[i] < 0) open.push_back(i);
  }
  std::vector<bool> reached(count, false);
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    reached[node] = true;
    open.insert(open.end(), children[node].begin(), children[node].end());
  }
  if (const auto lost = std::ranges::find(reached, false); lost != reached.end()) {
    nodes.item(static_cast<std::size_t>(lost - reached.begin())).fail("is its own ancestor");
  }
}

void checkScenesAndSkins(Cursor root) {
  const std::size_t nodes = root.member("nodes").size();
  const Cursor scenes = root.member("scenes");
  for (const Cursor scene : scenes) {
    for (const Cursor node : scene.member("nodes")) node.index(nodes);
  }
  // A file without scenes is a library of parts; "scene" then has nothing to refer to.
  if (scenes.size() > 0) {
    root.member("scene").index(scenes.size());
  } else {
    root.member("scene").integer(0, 0, INT_MAX);
  }
  for (const Cursor skin : root.member("skins")) {
    const Cursor joints = skin.required("joints");
    for (const Cursor joint : joints) joint.index(nodes);
    if (joints.size() == 0) joints.fail("is empty");
    const Cursor matrices = skin.member("inverseBindMatrices");
    const int accessor = matrices.index(root.member("accessors").size());
    if (accessor < 0) continue;
    const Cursor list = root.member("accessors").item(static_cast<std::size_t>(accessor));
    if (list.member("type").text() != "MAT4" ||
        list.member("componentType").integer(0, 0, INT_MAX) != 5126 ||
        list.member("count").integer(0, 0, UINT32_MAX) < static_cast<std::int64_t>(joints.size())) {
      matrices.fail("must refer to an accessor with a MAT4 of floats for each joint");
    }
  }
}

}  // namespace

std::uint64_t spanOfElements(Cursor accessor, std::int64_t stride) {
  const std::int64_t component =
      componentBytes(accessor.member("componentType").integer(0, 0, INT_MAX));
  const std::string type = accessor.member("type").text();
  const std::int64_t count = accessor.member("count").integer(0, 0, UINT32_MAX);
  if (count == 0) return 0;
  if (stride == 0) stride = elementBytes(type, component);
  return static_cast<std::uint64_t>((count - 1) * stride + elementBytes(type, component, true));
}

void checkDocument(Json& document, Messages& messages) {
  const Cursor root(document, messages);
  checkAsset(root, messages);
  checkExtensions(root, messages);
  checkStructure(document, messages);
}

void checkStructure(Json& document, const Messages& messages) {
  const Cursor root(document, messages);
  checkCounts(root);
  checkAccessors(root, checkViews(root));
  checkMeshes(root);
  checkNodes(root);
  checkScenesAndSkins(root);
}

}  // namespace glint::gltf
