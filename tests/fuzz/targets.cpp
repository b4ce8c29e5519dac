#include "targets.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "cli/model_list.h"
#include "glint/budget/cost_file.h"
#include "glint/gltf/patch.h"
#include "glint/gltf/scene_file.h"
#include "glint/image/decoders.h"
#include "glint/image/error.h"
#include "glint/image/picture_layers.h"
#include "glint/image/read_image.h"
#include "glint/image/texture.h"
#include "glint/options/parameters.h"
#include "glint/render/decode.h"
#include "glint/scene/look_text.h"

namespace glint::test {
namespace {

using Bytes = std::span<const std::byte>;

/// Fails in a way that a fuzzer reports as a crash.
void mustHold(bool condition) {
  if (!condition) std::abort();
}

std::string textOf(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A file in memory with these bytes.
class File {
 public:
  explicit File(Bytes bytes) : file_(memfd_create("input", MFD_CLOEXEC)) {
    mustHold(file_ >= 0 && write(file_, bytes.data(), bytes.size()) == ssize_t(bytes.size()));
    lseek(file_, 0, SEEK_SET);
  }
  ~File() { close(file_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

template <typename Work>
void refusing(const Work& work) {
  try {
    work();
  } catch (const InputError&) {
    // Its message is made safe for one line where it is printed.
  }
}

void gltf(Bytes bytes) {
  const File file(bytes);
  refusing([&] {
    Scene scene = loadGltf(file.path());
    for (const Mesh& mesh : scene.meshes)
      for (const auto index : mesh.indices) mustHold(index < mesh.positions.size());
    limitDecoding(std::uint64_t(64) << 20);
    Look look;
    look.shading = Shading::environment;
    decodeImages(scene, look);
  });
  refusing([&] {
    MaterialPatch patch;
    patch.values.exponent = 7;
    const auto patched = patchGltf(bytes, {patch}, "a.gltf");
    mustHold(!patched.empty());
  });
}

/// Larger pictures are skipped: they are slow and find nothing more.
bool isSmall(const TextureHeader& header) {
  return std::uint64_t(header.width) * std::uint64_t(header.height) <= 1u << 22;
}

template <bool (*isFormat)(Bytes)>
void texture(Bytes bytes) {
  if (!isFormat(bytes)) return;
  refusing([&] {
    const TextureHeader header = textureHeader(bytes, "a");
    if (!isSmall(header)) return;
    const ByteImage image = decodeTexture(bytes, "a");
    mustHold(image.width == header.width && image.height == header.height);
    mustHold(image.values.size() == std::size_t(4) * image.width * image.height);
    const ByteImage half = decodeTexture(bytes, "a", 1, true);
    mustHold(half.values.size() == std::size_t(4) * half.width * half.height);
    decodeStoredImage(bytes, "a");
  });
}

template <bool (*isFormat)(Bytes)>
void picture(Bytes bytes) {
  if (!isFormat(bytes)) return;
  refusing([&] {
    const PictureLayers all = decodePictureLayers(bytes, "a", "all");
    for (const PictureLayer& layer : all.layers)
      mustHold(std::visit([](const auto& values) { return values.size(); }, layer.image.values) ==
               std::size_t(layer.image.channels) * layer.image.width * layer.image.height);
    // Read row by row, it has the same values.
    const StoredImage rows = decodePictureLayers(bytes, "a", "main", 0).layers[0].image;
    const StoredImage& held = all.layers[0].image;
    if (!rows.window || std::uint64_t(held.width) * std::uint64_t(held.height) > 1 << 20) return;
    std::vector<float> expected(std::size_t(4) * held.width), found(expected.size());
    for (int y = held.height; y-- > 0;) {
      held.storedRows(y, 1, expected.data());
      rows.storedRows(y, 1, found.data());
      mustHold(expected == found);
    }
  });
}

bool isSimple(Bytes bytes) {
  return detail::isPnm(bytes) || detail::isBmp(bytes) || detail::isTga(bytes);
}

/// Saving what was read gives a text with the same meaning.
void comesBack(const Look& look) {
  const std::string text = saveLook(look);
  Look back;
  readLook(back, text, "a.json");
  mustHold(saveLook(back) == text);
}

void look(Bytes bytes) {
  refusing([&] {
    Look read;
    readLook(read, textOf(bytes), "a.json");
    comesBack(read);
  });
}

void material(Bytes bytes) {
  refusing([&] {
    Look read;
    parseMaterialEdit(read, textOf(bytes));
    comesBack(read);
  });
}

void light(Bytes bytes) {
  refusing([&] {
    const Light read = parseLight(textOf(bytes));
    mustHold(parseLight(lightText(read)) == read);
  });
}

void list(Bytes bytes) {
  const File file(bytes);
  refusing([&] {
    ModelList models(file.path());
    while (const auto entry = models.next())
      mustHold(!entry->model.empty() || !entry->error.empty());
  });
}

void costs(Bytes bytes) {
  const File file(bytes);
  refusing([&] { readCostFile(file.path()); });
}

constexpr FuzzTarget targets[] = {
    {"gltf", gltf},
    {"png", texture<detail::isPng>},
    {"jpeg", texture<detail::isJpeg>},
    {"webp", texture<detail::isWebp>},
    {"exr", picture<detail::isExr>},
    {"hdr", picture<detail::isHdr>},
    {"pfm", picture<detail::isPfm>},
    {"tiff", picture<detail::isTiff>},
    {"simple", picture<isSimple>},
    {"look", look},
    {"material", material},
    {"light", light},
    {"list", list},
    {"costs", costs},
};

}  // namespace

std::span<const FuzzTarget> fuzzTargets() { return targets; }

}  // namespace glint::test
