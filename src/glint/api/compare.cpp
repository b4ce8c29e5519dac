#include "glint/compare.h"

#include <algorithm>

#include "glint/image/compare.h"
#include "glint/image/picture_writer.h"
#include "glint/image/read_image.h"
#include "glint/image/srgb.h"

namespace glint {
namespace {

CompareOptions optionsOf(const CompareRules& rules) {
  CompareOptions options;
  for (const auto& [metric, limit] : rules.limits) options.conditions.push_back({metric, limit});
  options.metrics = rules.metrics;
  options.tolerance = rules.tolerance;
  if (rules.ignoreAlpha) options.alpha = AlphaUse::ignored;
  return options;
}

Differences differencesOf(const StoredImage& a, const StoredImage& b, const CompareRules& rules) {
  CompareOptions options = optionsOf(rules);
  Differences result;
  options.flipMap = [&](int, const float* errors) {
    result.map.insert(result.map.end(), errors, errors + a.width);
  };
  if (a.width != b.width || a.height != b.height) options.flipMap = nullptr;
  const Comparison found = compare(a, b, options);
  result.same = found.same;
  result.values = found.values;
  result.failures = found.failures;
  result.worst = found.worstText();
  result.width = found.width;
  result.height = found.height;
  return result;
}

// Image or Codes.
template <typename Picture>
StoredImage storedOf(const Picture& picture) {
  if (picture.width < 1 || picture.height < 1 ||
      picture.values.size() != std::size_t(4) * picture.width * picture.height)
    throw InputError("a picture of " + std::to_string(picture.width) + " x " +
                     std::to_string(picture.height) + " pixels with " +
                     std::to_string(picture.values.size()) +
                     " values: give four per pixel and at least one pixel");
  return {picture.width, picture.height, 4, picture.values};
}

void writeWhole(const std::string& path, const Image& picture, bool alpha) {
  PictureOptions options;
  options.alpha = alpha;
  const auto writer = openPictureWriter(path, picture.width, picture.height, options);
  writer->write(picture);
  writer->finish();
}

}  // namespace

Differences comparePictures(const Image& a, const Image& b, const CompareRules& rules) {
  return differencesOf(storedOf(a), storedOf(b), rules);
}

Differences comparePictures(const Codes& a, const Codes& b, const CompareRules& rules) {
  return differencesOf(storedOf(a), storedOf(b), rules);
}

Differences compareFiles(const std::string& a, const std::string& b, const CompareRules& rules) {
  return differencesOf(readStoredImage(a), readStoredImage(b), rules);
}

Codes encoded(const Image& picture, float scale) {
  (void)storedOf(picture);  // throws if invalid
  Codes codes{picture.width, picture.height, std::vector<std::uint8_t>(picture.values.size())};
  encodeSrgb8(picture.values.data(), picture.values.size() / 4, scale, codes.values.data());
  return codes;
}

Image readPicture(const std::string& path) { return readImage(path); }

void writePicture(const std::string& path, const Image& picture) {
  (void)storedOf(picture);  // throws if invalid
  bool opaque = true;
  for (std::size_t i = 3; i < picture.values.size(); i += 4)
    opaque = opaque && picture.values[i] >= 1;
  writeWhole(
      path, picture,
      !opaque && !path.ends_with(".jpg") && !path.ends_with(".jpeg") && !path.ends_with(".pfm"));
}

void writePicture(const std::string& path, const Codes& picture) {
  const StoredImage stored = storedOf(picture);
  Image linear{picture.width, picture.height, std::vector<float>(picture.values.size())};
  stored.linearRows(0, picture.height, linear.values.data());
  writePicture(path, linear);
}

}  // namespace glint
