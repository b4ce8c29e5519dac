#include "glint/gltf/texture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string_view>
#include <tuple>

#include "glint/gltf/file.h"
#include "glint/image/texture.h"

namespace glint::gltf {
namespace {

/// More than any picture whose pixels could be drawn.
constexpr std::uint64_t maxImageBytes = std::uint64_t(256) << 20;
/// The highest texture coordinate set that is read; the standard requires two sets.
constexpr std::int64_t maxTexcoord = 15;

/// The format, determined from the first bytes: a mimeType is often wrong.
const char* formatOf(const std::vector<std::byte>& bytes) {
  const auto startsWith = [&](std::size_t offset, std::string_view magic) {
    return bytes.size() >= offset + magic.size() &&
           std::memcmp(bytes.data() + offset, magic.data(), magic.size()) == 0;
  };
  if (startsWith(0, "\x89PNG\r\n\x1a\n")) return "PNG";
  if (startsWith(0, "\xff\xd8\xff")) return "JPEG";
  if (startsWith(0, "RIFF") && startsWith(8, "WEBP")) return "WebP";
  if (startsWith(0, "\xabKTX ")) return "KTX";
  return "unknown";
}

/// Whether there is no end marker after the last scan of a JPEG. None occurs within a scan by
/// chance: a byte 0xff of its data is followed by 0.
bool lacksEnd(const std::vector<std::byte>& bytes) {
  const auto is = [&](std::size_t i, unsigned marker) {
    return bytes[i] == std::byte(0xff) && bytes[i + 1] == std::byte(marker);
  };
  for (std::size_t i = bytes.size() - 1; i-- > 0;) {
    if (is(i, 0xd9)) return false;
    if (is(i, 0xda)) return true;
  }
  return true;
}

Wrap wrapOf(std::int64_t value) {
  return value == 33071 ? Wrap::clampToEdge : value == 33648 ? Wrap::mirroredRepeat : Wrap::repeat;
}

}  // namespace

TextureReader::TextureReader(Document& document, Messages& messages)
    : document_(document), messages_(messages), root_(document.json, messages) {}

namespace {

/// uv' = offset + rotation (scale uv); the rotation is counter-clockwise where v runs downwards.
glm::dmat3x2 transformOf(Cursor from) {
  const auto pair = [&](const char* key, double fallback) {
    const Cursor list = from.member(key);
    list.checkNumbers(2);
    if (!list.exists()) return glm::dvec2(fallback);
    return glm::dvec2(list.item(0).number(0), list.item(1).number(0));
  };
  const glm::dvec2 offset = pair("offset", 0), scale = pair("scale", 1);
  const double angle = from.member("rotation").number(0);
  const double c = std::cos(angle), s = std::sin(angle);
  return {glm::dvec2(c, -s) * scale.x, glm::dvec2(s, c) * scale.y, offset};
}

}  // namespace

std::optional<Texture> TextureReader::read(Cursor info, TextureUse use) {
  if (!info.exists()) return std::nullopt;
  const Cursor textures = root_.member("textures");
  const auto index = static_cast<std::size_t>(info.required("index").index(textures.size()));
  const Cursor transform = info.member("extensions").member("KHR_texture_transform");
  const std::int64_t texcoord =
      transform.member("texCoord")
          .integer(info.member("texCoord").integer(0, 0, INT32_MAX), 0, INT32_MAX);
  const Cursor texture = textures.item(index);
  const std::size_t images = root_.member("images").size();
  int image = texture.member("source").index(images);
  if (canDecodeWebp()) {
    const Cursor webp = texture.member("extensions").member("EXT_texture_webp").member("source");
    if (webp.exists()) image = webp.index(images);
  }
  const char* const basisu = "KHR_texture_basisu";
  if (texture.member("extensions").member(basisu).exists()) {
    messages_.warn(texture.path() + " is compressed (KHR_texture_basisu), " +
                   (image < 0 ? "which is not read, and has no other image: left out"
                              : "which is not read: its other image is used"));
    if (image < 0) return std::nullopt;
  }
  if (texcoord > maxTexcoord) {
    messages_.warn(info.path() + " uses texture coordinates " + std::to_string(texcoord) +
                   ", which are beyond " + std::to_string(maxTexcoord) + ", and is left out");
    return std::nullopt;
  }
  if (image < 0) {
    messages_.warn(texture.path() + " has no readable image and is left out");
    return std::nullopt;
  }
  Texture result;
  result.image = imageSlot(static_cast<std::size_t>(image), use);
  result.texcoord = static_cast<int>(texcoord);
  result.sampler = sampler(texture);
  if (transform.exists()) result.transform = transformOf(transform);
  if (result.image < 0) return std::nullopt;
  return result;
}

Texture TextureReader::glossTexture(const Texture& from, const GlossPicture& made) {
  Texture result = from;
  const auto isTheSame = [&](const std::pair<std::pair<int, GlossPicture>, int>& known) {
    const auto& [image, other] = known.first;
    return image == from.image && other.isColor == made.isColor && other.other == made.other &&
           other.factors.diffuse == made.factors.diffuse &&
           other.factors.specular == made.factors.specular &&
           other.factors.glossiness == made.factors.glossiness;
  };
  if (const auto known = std::ranges::find_if(glosses_, isTheSame); known != glosses_.end()) {
    result.image = known->second;
    return result;
  }
  result.image = static_cast<int>(images_.size());
  EncodedImage image = images_[static_cast<std::size_t>(from.image)];
  image.name += made.isColor ? " as colours" : " as numbers";
  image.isData = !made.isColor;
  image.gloss = made;
  images_.push_back(std::move(image));
  glosses_.push_back({{from.image, made}, result.image});
  return result;
}

int TextureReader::imageSlot(std::size_t index, TextureUse use) {
  if (const auto known = slots_.find({index, use}); known != slots_.end()) return known->second;
  int& slot = slots_[{index, use}];
  slot = -1;
  const Cursor image = root_.member("images").item(index);
  // A data URI is its own source; using it as a key would copy the image.
  const std::string uri = image.member("uri").text();
  const int view = image.member("bufferView").index(document_.views.size());
  std::string source = view >= 0        ? "view " + std::to_string(view)
                       : isDataUri(uri) ? "image " + std::to_string(index)
                                        : "file " + uri;
  if (use == TextureUse::numbers) source += " as data";
  if (use == TextureUse::normals) source += " as normals";
  if (const auto known = slotsBySource_.find(source); known != slotsBySource_.end()) {
    return slot = known->second;
  }
  std::string error;
  EncodedImage loaded;
  loaded.bytes = load(image, loaded.name, error);
  if (error.empty()) {
    // Exporters write a picture once per material that uses it.
    if (const int twin = equalImage(loaded.bytes, use); twin >= 0)
      return slotsBySource_[source] = slot = twin;
    if (formatOf(loaded.bytes) == std::string_view("JPEG") && lacksEnd(loaded.bytes))
      messages_.warn("the image " + loaded.name + " is a truncated JPEG");
    slot = static_cast<int>(images_.size());
    loaded.isData = use != TextureUse::colors;
    loaded.isNormalMap = use == TextureUse::normals;
    images_.push_back(std::move(loaded));
  } else {
    messages_.warn("the image " + loaded.name + " " + error + ", drawn without it");
  }
  return slotsBySource_[source] = slot;
}

int TextureReader::equalImage(const std::vector<std::byte>& bytes, TextureUse use) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t hash = std::hash<std::string_view>()(text);
  const auto [first, end] = slotsByHash_.equal_range(hash);
  for (auto it = first; it != end; ++it) {
    const EncodedImage& known = images_[static_cast<std::size_t>(it->second)];
    if (known.isData == (use != TextureUse::colors) &&
        known.isNormalMap == (use == TextureUse::normals) && known.bytes == bytes)
      return it->second;
  }
  slotsByHash_.emplace(hash, static_cast<int>(images_.size()));
  return -1;
}

std::vector<std::byte> TextureReader::load(Cursor image, std::string& name, std::string& error) {
  name = image.path();
  const int viewIndex = image.member("bufferView").index(document_.views.size());
  const Cursor uri = image.member("uri");
  std::vector<std::byte> bytes;
  const auto take = [&](const ByteSource& source, std::uint64_t offset, std::uint64_t size) {
    if (size > maxImageBytes) {
      error = "has more than 256 MiB";
      return;
    }
    // A file that is not a picture is not read any further.
    bytes.resize(std::min<std::uint64_t>(size, 16));
    if (!source.read(bytes.data(), offset, bytes.size())) error = "cannot be read";
    const std::string_view format = formatOf(bytes);
    if (error.empty() && format != "PNG" && format != "JPEG" &&
        !(format == "WebP" && canDecodeWebp()))
      error = "is neither PNG nor JPEG (" + std::string(format) + ")";
    if (!error.empty()) return;
    bytes.resize(size);
    if (!source.read(bytes.data(), offset, bytes.size())) error = "cannot be read";
  };
  if (viewIndex >= 0) {
    const ViewPlace& view = document_.views[static_cast<std::size_t>(viewIndex)];
    take(document_.buffers[view.buffer], view.offset, view.size);
  } else if (uri.exists()) {
    const std::string text = uri.text();
    if (!isDataUri(text)) name = printableUri(text);
    if (const std::string oddity = oddityOf(text); !oddity.empty())
      messages_.warn("the image " + printableUri(text) + " " + oddity);
    const ByteSource source = openUri(text, document_.path, error);
    if (error == liesOutside)
      messages_.fail("the image " + name + " " + error, "use a model whose files are next to it");
    if (error.empty()) take(source, 0, source.size());
  } else {
    error = "has neither a bufferView nor a uri";
  }
  return bytes;
}

Sampler TextureReader::sampler(Cursor texture) {
  Sampler result;
  const Cursor samplers = root_.member("samplers");
  const int index = texture.member("sampler").index(samplers.size());
  if (index < 0) return result;
  const Cursor sampler = samplers.item(static_cast<std::size_t>(index));
  if (sampler.member("magFilter").integer(9729, 0, INT32_MAX) == 9728) {
    result.magnify = Filter::nearest;
  }
  constexpr std::tuple<int, Filter, MipFilter> filters[] = {
      {9728, Filter::nearest, MipFilter::none},
      {9729, Filter::linear, MipFilter::none},
      {9984, Filter::nearest, MipFilter::nearest},
      {9985, Filter::linear, MipFilter::nearest},
      {9986, Filter::nearest, MipFilter::linear}};
  const std::int64_t asked = sampler.member("minFilter").integer(9987, 0, INT32_MAX);
  for (const auto& [value, minify, mip] : filters)
    if (value == asked) result = {result.magnify, minify, mip};
  result.wrapS = wrapOf(sampler.member("wrapS").integer(10497, 0, INT32_MAX));
  result.wrapT = wrapOf(sampler.member("wrapT").integer(10497, 0, INT32_MAX));
  return result;
}

}  // namespace glint::gltf
