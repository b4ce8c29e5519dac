#include "glint/image/png_unpack.h"

#include <libdeflate.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

namespace glint::detail {
namespace {

std::uint32_t bigEndian(const std::byte* p) {
  return std::uint32_t(p[0]) << 24 | std::uint32_t(p[1]) << 16 | std::uint32_t(p[2]) << 8 |
         std::uint32_t(p[3]);
}

/// Finds the compressed pixels of a PNG: sets `pixels`, concatenating several chunks in `joined`.
/// Returns false if a chunk is damaged or would change what the codes mean (tRNS).
bool gather(std::span<const std::byte> png, std::vector<std::byte>& joined,
            std::span<const std::byte>& pixels) {
  bool ended = false;
  for (std::size_t at = 8; !ended;) {
    if (png.size() - at < 12) return false;
    const std::size_t size = bigEndian(&png[at]);
    if (size > png.size() - at - 12) return false;
    const std::string_view kind(reinterpret_cast<const char*>(&png[at + 4]), 4);
    if (libdeflate_crc32(0, &png[at + 4], size + 4) != bigEndian(&png[at + 8 + size])) return false;
    const std::span<const std::byte> data = png.subspan(at + 8, size);
    if (kind == "tRNS") return false;
    if (kind == "IDAT") {
      // A single chunk is used in place.
      if (!pixels.empty() && joined.empty()) joined.assign(pixels.begin(), pixels.end());
      if (pixels.empty()) {
        pixels = data;
      } else {
        joined.insert(joined.end(), data.begin(), data.end());
      }
    }
    ended = kind == "IEND";
    at += size + 12;
  }
  if (!joined.empty()) pixels = joined;
  return !pixels.empty();
}

/// The PNG filter's Paeth predictor: left, above or upper left, whichever is nearest to
/// left + above - upper left.
inline int paeth(int a, int b, int c) {
  const int pa = std::abs(b - c), pb = std::abs(a - c), pc = std::abs(a + b - 2 * c);
  const int other = pb <= pc ? b : c;
  return pa <= pb && pa <= pc ? a : other;
}

/// Undoes the filter of one row (PNG, section 9.2). `above` is the previous row, or zeros.
template <int step>
bool unfilter(int filter, const std::uint8_t* __restrict in, const std::uint8_t* __restrict above,
              std::uint8_t* __restrict out, std::size_t size) {
  switch (filter) {
    case 0:
      std::memcpy(out, in, size);
      return true;
    case 1: {
      std::uint8_t left[step] = {};
      for (std::size_t i = 0; i < size; i += step)
        for (int c = 0; c < step; ++c)
          out[i + c] = left[c] = static_cast<std::uint8_t>(in[i + c] + left[c]);
      return true;
    }
    case 2:
      for (std::size_t i = 0; i < size; ++i) out[i] = static_cast<std::uint8_t>(in[i] + above[i]);
      return true;
    case 3: {
      std::uint8_t left[step] = {};
      for (std::size_t i = 0; i < size; i += step)
        for (int c = 0; c < step; ++c)
          out[i + c] = left[c] =
              static_cast<std::uint8_t>(in[i + c] + (left[c] + above[i + c]) / 2);
      return true;
    }
    case 4: {
      int left[step] = {}, corner[step] = {};
      for (std::size_t i = 0; i < size; i += step)
        for (int c = 0; c < step; ++c) {
          const int up = above[i + c];
          left[c] = (in[i + c] + paeth(left[c], up, corner[c])) & 255;
          corner[c] = up;
          out[i + c] = static_cast<std::uint8_t>(left[c]);
        }
      return true;
    }
    default:
      return false;
  }
}

}  // namespace

bool unpackPng(std::span<const std::byte> png, int width, int height, int channels,
               std::vector<std::uint8_t>& codes) {
  std::vector<std::byte> joined;
  std::span<const std::byte> pixels;
  if (!gather(png, joined, pixels)) return false;
  const std::size_t rowSize = std::size_t(channels) * width, size = (rowSize + 1) * height;
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflater(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  // Fresh memory costs more than the work done in it, so rows are unfiltered in place, each through
  // a copy.
  codes.resize(size);
  if (!inflater || libdeflate_zlib_decompress(inflater.get(), pixels.data(), pixels.size(),
                                              codes.data(), size, nullptr) != LIBDEFLATE_SUCCESS)
    return false;
  std::vector<std::uint8_t> row(rowSize);
  const std::vector<std::uint8_t> zeros(rowSize);
  const std::uint8_t* above = zeros.data();
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* in = codes.data() + (rowSize + 1) * y;
    std::uint8_t* out = codes.data() + rowSize * y;
    const int filter = in[0];
    std::memcpy(row.data(), in + 1, rowSize);
    if (!(channels == 3 ? unfilter<3>(filter, row.data(), above, out, rowSize)
                        : unfilter<4>(filter, row.data(), above, out, rowSize)))
      return false;
    above = out;
  }
  codes.resize(rowSize * height);
  return true;
}

}  // namespace glint::detail
