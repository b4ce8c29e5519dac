#include "report_pictures.h"

#include <libdeflate.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>

#include "glint/image/png_bytes.h"

namespace glint {
namespace {

bool begins(std::span<const std::byte> file, std::initializer_list<int> magic) {
  return file.size() > magic.size() &&
         std::equal(magic.begin(), magic.end(), file.begin(),
                    [](int m, std::byte b) { return std::byte(m) == b; });
}

std::uint8_t codeOf(float encoded) {
  const float code = std::clamp(std::isnan(encoded) ? 1.0f : encoded, 0.0f, 1.0f) * 255;
  return static_cast<std::uint8_t>(std::lround(code));
}

}  // namespace

std::vector<std::byte> browserPicture(std::span<const std::byte> file, const PictureLayer& layer,
                                      std::pair<float, float> range) {
  const bool webp = begins(file, {'R', 'I', 'F', 'F'});
  if (begins(file, {0x89, 'P', 'N', 'G'}) || begins(file, {0xff, 0xd8, 0xff}) || webp)
    return {file.begin(), file.end()};
  const StoredImage& image = layer.image;
  const bool alpha = layer.colour && image.channels == 4;
  const std::size_t channels = alpha ? 4 : 3, width = std::size_t(image.width);
  std::vector<std::uint8_t> codes(channels * width * std::size_t(image.height));
  std::vector<float> row(4 * width);
  std::uint8_t* out = codes.data();
  for (int y = 0; y < image.height; ++y) {
    layer.colour ? image.encodedRows(y, 1, row.data()) : image.storedRows(y, 1, row.data());
    for (std::size_t x = 0; x < width; ++x)
      for (std::size_t c = 0; c < channels; ++c) {
        const float value = row[4 * x + c];
        const float span = range.second - range.first;
        *out++ = codeOf(layer.colour ? value : span > 0 ? (value - range.first) / span : 0);
      }
  }
  return alpha ? pngOfRgba(codes, image.width, image.height)
               : pngOfRgb(codes, image.width, image.height);
}

std::vector<std::byte> trueValues(const PictureLayer& layer) {
  const StoredImage& image = layer.image;
  if (image.values.index() == 0 ||
      std::uint64_t(image.width) * std::uint64_t(image.height) > std::uint64_t(1) << 22)
    return {};
  const bool codes = image.isEncoded();
  std::vector<float> values;
  if (codes) {
    const auto& words = std::get<1>(image.values);
    values.assign(words.begin(), words.end());
  } else {
    values = std::get<2>(image.values);
  }
  const nlohmann::ordered_json head{{"width", image.width},
                                    {"height", image.height},
                                    {"channels", image.channels},
                                    {"linear", !codes},
                                    {"colour", layer.colour}};
  const std::string text = head.dump() + "\n";
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> deflater(
      libdeflate_alloc_compressor(4), libdeflate_free_compressor);
  if (!deflater) return {};
  const std::size_t size = values.size() * sizeof(float);
  std::vector<std::byte> bytes(text.size() + libdeflate_zlib_compress_bound(deflater.get(), size));
  std::memcpy(bytes.data(), text.data(), text.size());
  const std::size_t packed = libdeflate_zlib_compress(
      deflater.get(), values.data(), size, bytes.data() + text.size(), bytes.size() - text.size());
  bytes.resize(text.size() + packed);
  return packed > 0 ? bytes : std::vector<std::byte>();
}

std::vector<std::byte> thumbnailOf(const StoredImage& image) {
  constexpr int side = 48;
  const double step = std::max(1.0, std::max(image.width, image.height) / double(side));
  const int width = std::max(1, int(image.width / step)),
            height = std::max(1, int(image.height / step));
  std::vector<std::uint8_t> codes;
  std::vector<float> row(std::size_t(4) * image.width);
  for (int y = 0; y < height; ++y) {
    // A few samples per pixel: enough to recognise a picture.
    std::vector<float> sums(std::size_t(3) * width);
    constexpr int samples = 3;
    for (int k = 0; k < samples; ++k) {
      image.encodedRows(std::min(image.height - 1, int((y + (k + 0.5) / samples) * step)), 1,
                        row.data());
      for (int x = 0; x < width; ++x)
        for (int i = 0; i < samples; ++i) {
          const int from = std::min(image.width - 1, int((x + (i + 0.5) / samples) * step));
          for (int c = 0; c < 3; ++c) {
            const float value = row[std::size_t(4 * from + c)];
            sums[std::size_t(3 * x + c)] +=
                std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 1;
          }
        }
    }
    for (const float sum : sums) codes.push_back(codeOf(sum / (samples * samples)));
  }
  return pngOfRgb(codes, width, height);
}

}  // namespace glint
