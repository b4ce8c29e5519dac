#include "glint/image/difference_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "glint/image/code_picture.h"
#include "glint/image/compared_rows.h"

namespace glint {
namespace {

std::uint8_t shownCode(float encoded) {
  const float code = std::clamp(std::isnan(encoded) ? 1.0f : encoded, 0.0f, 1.0f) * 255;
  return static_cast<std::uint8_t>(std::lround(code));
}

/// |a - b| for a row of 8-bit codes if all of it is opaque; otherwise false.
bool differencesOfCodes(const detail::ComparedRows& rows, int y, double scale,
                        std::vector<std::uint8_t>& shown) {
  if (!rows.comparesCodes() || rows.ignoresSome()) return false;
  std::array<std::uint8_t, 256> codes{};
  for (std::size_t i = 0; i < 256; ++i) codes[i] = shownCode(float(i) / 255 * float(scale));
  std::vector<std::uint8_t> copyA, copyB;
  const std::uint8_t *a = rows.codesA(y, copyA), *b = rows.codesB(y, copyB);
  const auto step = std::size_t(rows.codeChannels());
  std::uint8_t* out = shown.data();
  for (int x = 0; x < rows.width(); ++x, a += step, b += step, out += 3) {
    if (step == 4 && (a[3] & b[3]) != 255) return false;
    for (int c = 0; c < 3; ++c) out[c] = codes[std::size_t(std::abs(a[c] - b[c]))];
  }
  return true;
}

}  // namespace

struct FlipPicture::Parts {
  detail::CodePicture picture;
  std::vector<std::uint8_t> row;
};

FlipPicture::FlipPicture(const std::string& path, int width, int height)
    : parts_(new Parts{{path, width, height}, std::vector<std::uint8_t>(std::size_t(3) * width)}) {}

FlipPicture::~FlipPicture() = default;

void FlipPicture::add(const float* errors) {
  std::vector<std::uint8_t>& row = parts_->row;
  std::array<std::uint8_t, 3> none{};
  magma(0, none.data());
  for (std::size_t i = 0; i < row.size(); i += 3, ++errors) {
    if (*errors > 0) {
      magma(*errors, &row[i]);
    } else {
      std::copy(none.begin(), none.end(), &row[i]);
    }
  }
  parts_->picture.add(row);
}

void FlipPicture::finish() { parts_->picture.finish(); }

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
  const std::size_t third = std::size_t(3) * width;
  detail::CodePicture picture(path, beside ? 3 * width : width, height);
  std::vector<std::uint8_t> row(beside ? 3 * third : third);
  std::vector<float> va(std::size_t(4) * width), vb(va.size());
  std::vector<unsigned char> counts(std::size_t(width), 1);
  for (int y = 0; y < height; ++y) {
    if (!beside && !rows.ignoresSome() && rows.codesAreEqual(y)) {
      picture.addBlack();
      continue;
    }
    if (!beside && differencesOfCodes(rows, y, scale, row)) {
      picture.add(row);
      continue;
    }
    rows.encoded(y, va.data(), vb.data());
    if (rows.ignoresSome()) rows.counted(y, counts.data());
    for (std::size_t x = 0; x < counts.size(); ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t from = 4 * x + c, to = 3 * x + c;
        const float difference = std::fabs(va[from] - vb[from]) * float(scale);
        row[beside ? to + 2 * third : to] = shownCode(counts[x] ? difference : 0.5f);
        if (!beside) continue;
        row[to] = shownCode(va[from]);
        row[to + third] = shownCode(vb[from]);
      }
    picture.add(row);
  }
  picture.finish();
}

}  // namespace glint
