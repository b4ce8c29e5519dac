#include "glint/image/difference_picture.h"

#include <algorithm>
#include <cmath>

#include "glint/image/compared_rows.h"
#include "glint/image/picture_writer.h"
#include "glint/image/srgb.h"

namespace glint {
namespace {

/// Linear light whose 8-bit code is that of an sRGB value in [0, 1].
float linearOf(float encoded) {
  const float code = std::clamp(std::isnan(encoded) ? 1.0f : encoded, 0.0f, 1.0f) * 255;
  return decodeSrgb8(static_cast<std::uint8_t>(std::lround(code)));
}

}  // namespace

struct FlipPicture::Parts {
  std::unique_ptr<PictureWriter> writer;
  Image row;
};

FlipPicture::FlipPicture(const std::string& path, int width, int height)
    : parts_(new Parts{openPictureWriter(path, width, height), {width, 1, {}}}) {
  parts_->row.values.assign(std::size_t(4) * width, 1.0f);
}

FlipPicture::~FlipPicture() = default;

void FlipPicture::add(const float* errors) {
  Image& row = parts_->row;
  for (int x = 0; x < row.width; ++x) {
    unsigned char rgb[3];
    magma(errors[x], rgb);
    for (int c = 0; c < 3; ++c) row.values[std::size_t(4 * x + c)] = decodeSrgb8(rgb[c]);
  }
  parts_->writer->write(row);
}

void FlipPicture::finish() { parts_->writer->finish(); }

void writeDifference(const std::string& path, const StoredImage& a, const StoredImage& b,
                     const CompareOptions& options, DifferenceKind kind, double scale) {
  if (a.width != b.width || a.height != b.height) {
    const int wide = std::max(a.width, b.width), high = std::max(a.height, b.height);
    CompareOptions all = options;
    all.mask = nullptr;
    writeDifference(path, padded(a, wide, high), padded(b, wide, high), all, kind, scale);
    return;
  }
  const detail::ComparedRows rows(a, b, options);
  if (kind == DifferenceKind::flip) {
    FlipPicture picture(path, rows.width(), rows.height());
    flip(rows.linearA(), rows.linearB(), options.flip,
         [&](int, const float* errors) { picture.add(errors); });
    picture.finish();
    return;
  }
  const int width = rows.width(), height = rows.height();
  const bool beside = kind == DifferenceKind::sideBySide;
  const int outWidth = beside ? 3 * width : width;
  const auto writer = openPictureWriter(path, outWidth, height);
  Image row{outWidth, 1, std::vector<float>(std::size_t(4) * outWidth, 1.0f)};
  std::vector<float> va(std::size_t(4) * width), vb(va.size());
  std::vector<unsigned char> counts(std::size_t(width), 1);
  for (int y = 0; y < height; ++y) {
    rows.encoded(y, va.data(), vb.data());
    if (rows.ignoresSome()) rows.counted(y, counts.data());
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = std::size_t(4 * x + c);
        const float difference = std::fabs(va[i] - vb[i]) * float(scale);
        const float shown = counts[std::size_t(x)] ? difference : 0.5f;
        if (beside) {
          row.values[i] = linearOf(va[i]);
          row.values[i + std::size_t(4) * width] = linearOf(vb[i]);
          row.values[i + std::size_t(8) * width] = linearOf(shown);
        } else {
          row.values[i] = linearOf(shown);
        }
      }
    writer->write(row);
  }
  writer->finish();
}

}  // namespace glint
