#include "term_files.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "glint/image/exr_writer.h"
#include "glint/image/srgb.h"
#include "output_names.h"

namespace glint {
namespace {

using Kind = PictureTerm::Kind;

// Gives each instance a colour: bright, with hues spread by the golden ratio; black for no surface.
void colorIds(Image& image) {
  for (std::size_t i = 0; i < image.values.size(); i += 4) {
    float* const p = image.values.data() + i;
    const double turn = double(p[0]) * 0.6180339887498949;
    const bool none = p[0] < 0;
    for (int c = 0; c < 3; ++c) {
      const double wave = std::cos(2 * std::numbers::pi * (turn + c / 3.0));
      p[c] = none ? 0.0f : float(srgbLinear(0.6 + 0.35 * wave));
    }
  }
}

void makeVisible(const PictureTerm& term, Image& image) {
  if (term.kind == Kind::ids) return colorIds(image);
  float nearest = INFINITY, farthest = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 4)
    if (std::isfinite(image.values[i])) {
      nearest = std::min(nearest, image.values[i]);
      farthest = std::max(farthest, image.values[i]);
    }
  const double range = farthest > nearest ? double(farthest) - nearest : 1;
  for (std::size_t i = 0; i < image.values.size(); i += 4) {
    float* const p = image.values.data() + i;
    for (int c = 0; c < 3; ++c) {
      if (term.kind == Kind::normal)
        p[c] = p[3] > 0 ? float(srgbLinear((double(p[c]) + 1) / 2)) : 0;
      else
        p[c] = std::isfinite(p[c]) ? float(srgbLinear((double(farthest) - p[c]) / range)) : 0;
    }
  }
}

std::size_t nanPixels(const Image& image) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 4)
    count += std::isnan(image.values[i] + image.values[i + 1] + image.values[i + 2]);
  return count;
}

std::size_t writeFile(const std::string& path, const Image& image, const PictureOptions& options) {
  const auto writer = openPictureWriter(path, image.width, image.height, options);
  writer->write(image);
  writer->finish();
  return writer->nanPixels();
}

}  // namespace

std::string termOutput(const std::string& output, const PictureFormat& format,
                       const PictureTerm& term) {
  return format.id == PictureFormat::Id::exr ? output : withWord(output, term.name);
}

std::size_t writeTerms(const std::string& output, DrawnTerms& drawn,
                       const PictureOptions& options) {
  if (options.format->id == PictureFormat::Id::exr) {
    std::vector<ExrLayer> layers{{"", &drawn.picture, options.alpha ? "RGBA" : "RGB"}};
    for (const auto& [term, image] : drawn.terms) {
      layers.push_back({term.name, &image,
                        term.kind == Kind::normal  ? "XYZ"
                        : term.kind == Kind::depth ? "Z"
                                                   : "RGB"});
      if (term.kind == Kind::ids) layers.back().words = {"instance", "mesh", "material"};
    }
    writeExr(output, layers, {options.text.begin(), options.text.end()});
    return nanPixels(drawn.picture);
  }
  for (auto& [term, image] : drawn.terms) {
    PictureOptions own = options;
    own.alpha = false;
    // The key belongs only to the picture, which is written last.
    std::erase_if(own.text, [](const auto& each) { return each.first == "glint-key"; });
    own.text.emplace_back("glint-term", term.name);
    if (!term.isLight() && !options.format->isFloat) {
      makeVisible(term, image);
      own.exposureScale = 1;
    }
    writeFile(termOutput(output, *options.format, term), image, own);
  }
  return writeFile(output, drawn.picture, options);
}

}  // namespace glint
