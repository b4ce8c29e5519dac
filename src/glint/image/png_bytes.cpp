#include "glint/image/png_bytes.h"

#include <spng.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <string>

#include "glint/image/error.h"

namespace glint {
namespace {

struct FreeContext {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};

void check(int result) {
  if (result != 0) throw Error(std::string("PNG in memory: ") + spng_strerror(result));
}

std::vector<std::byte> encode(std::span<const std::uint8_t> codes, int width, int height, int kind,
                              std::span<const std::array<std::uint8_t, 3>> palette = {}) {
  const std::unique_ptr<spng_ctx, FreeContext> png(spng_ctx_new(SPNG_CTX_ENCODER));
  if (!png) throw std::bad_alloc();
  check(spng_set_option(png.get(), SPNG_ENCODE_TO_BUFFER, 1));
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(width);
  header.height = static_cast<std::uint32_t>(height);
  header.bit_depth = 8;
  header.color_type = static_cast<std::uint8_t>(kind);
  check(spng_set_ihdr(png.get(), &header));
  check(spng_set_srgb(png.get(), 0));  // perceptual
  if (!palette.empty()) {
    spng_plte entries{};
    entries.n_entries = static_cast<std::uint32_t>(palette.size());
    for (std::size_t i = 0; i < palette.size(); ++i)
      entries.entries[i] = {palette[i][0], palette[i][1], palette[i][2], 255};
    check(spng_set_plte(png.get(), &entries));
  }
  check(
      spng_encode_image(png.get(), codes.data(), codes.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE));
  std::size_t size = 0;
  int error = 0;
  const std::unique_ptr<void, void (*)(void*)> buffer(spng_get_png_buffer(png.get(), &size, &error),
                                                      std::free);
  check(error);
  const auto* bytes = static_cast<const std::byte*>(buffer.get());
  return {bytes, bytes + size};
}

}  // namespace

std::vector<std::byte> pngOfRgb(std::span<const std::uint8_t> rgb, int width, int height) {
  return encode(rgb, width, height, SPNG_COLOR_TYPE_TRUECOLOR);
}

std::vector<std::byte> pngOfRgba(std::span<const std::uint8_t> rgba, int width, int height) {
  return encode(rgba, width, height, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA);
}

std::vector<std::byte> pngOfIndices(std::span<const std::uint8_t> indices, int width, int height,
                                    std::span<const std::array<std::uint8_t, 3>> palette) {
  return encode(indices, width, height, SPNG_COLOR_TYPE_INDEXED, palette);
}

}  // namespace glint
