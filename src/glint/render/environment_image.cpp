#include "glint/render/environment_image.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <numbers>

#include "glint/image/error.h"
#include "glint/image/file.h"
#include "glint/image/read_image.h"
#include "glint/render/decode.h"

namespace glint {
namespace {

using Level = EnvironmentImage::Level;
constexpr double pi = std::numbers::pi;

struct Span {
  int first = 0;
  std::vector<double> weights;  ///< of `first` and those after it; their sum is 1
};

/// The texels, of `from` in all, that each of `to` texels covers; `weight(i)` scales the share of
/// texel i.
template <typename Weight>
std::vector<Span> spansOf(int from, int to, const Weight& weight) {
  std::vector<Span> spans(static_cast<std::size_t>(to));
  for (int i = 0; i < to; ++i) {
    Span& span = spans[std::size_t(i)];
    const double begin = double(from) * i / to, end = double(from) * (i + 1) / to;
    span.first = int(begin);
    double sum = 0;
    for (int t = span.first; t < from && t < end; ++t) {
      const double overlap = std::min(end, t + 1.0) - std::max(begin, double(t));
      span.weights.push_back(overlap * weight(t));
      sum += span.weights.back();
    }
    for (double& w : span.weights) w /= sum;
  }
  return spans;
}

Level halved(const Level& from) {
  Level to{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
  to.rgb.reserve(std::size_t(3) * to.width * to.height);
  const auto columns = spansOf(from.width, to.width, [](int) { return 1.0; });
  // A row's share of the sphere is proportional to the sine of its distance from the pole.
  const auto rows = spansOf(from.height, to.height,
                            [&](int row) { return std::sin((row + 0.5) * pi / from.height); });
  for (const Span& row : rows)
    for (const Span& column : columns) {
      glm::dvec3 sum(0.0);
      for (std::size_t y = 0; y < row.weights.size(); ++y)
        for (std::size_t x = 0; x < column.weights.size(); ++x) {
          const float* t = &from.rgb[std::size_t(3) * ((std::size_t(row.first) + y) * from.width +
                                                       std::size_t(column.first) + x)];
          sum += row.weights[y] * column.weights[x] * glm::dvec3(t[0], t[1], t[2]);
        }
      for (int c = 0; c < 3; ++c) to.rgb.push_back(float(sum[c]));
    }
  return to;
}

/// The parts of a row that vary as the cosine and the sine of the longitude.
struct FirstHarmonic {
  glm::dvec3 cosine{0.0}, sine{0.0};
};

/// Cosine (x) and sine (y) of the longitudes of a row's texels.
std::vector<glm::dvec2> longitudes(int count) {
  std::vector<glm::dvec2> around;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * (i + 0.5) / count;
    around.emplace_back(std::cos(angle), std::sin(angle));
  }
  return around;
}

FirstHarmonic firstHarmonic(const float* row, const std::vector<glm::dvec2>& around) {
  FirstHarmonic h;
  const double each = 2.0 / double(around.size());
  for (const glm::dvec2& at : around) {
    const glm::dvec3 value(row[0], row[1], row[2]);
    h.cosine += each * at.x * value;
    h.sine += each * at.y * value;
    row += 3;
  }
  return h;
}

std::vector<FirstHarmonic> firstHarmonics(const Level& level) {
  const auto around = longitudes(level.width);
  std::vector<FirstHarmonic> all;
  for (int y = 0; y < level.height; ++y)
    all.push_back(firstHarmonic(&level.rgb[std::size_t(3) * level.width * y], around));
  return all;
}

/// The harmonics of the next level: means along the meridian, not over the area. A radiance that is
/// linear in direction has the amplitude sin(distance from the pole), whose mean by area belongs to
/// a place nearer to the equator than the row's middle.
std::vector<FirstHarmonic> halved(const std::vector<FirstHarmonic>& from, int rows) {
  std::vector<FirstHarmonic> to;
  for (const Span& span : spansOf(int(from.size()), rows, [](int) { return 1.0; })) {
    FirstHarmonic& h = to.emplace_back();
    for (std::size_t i = 0; i < span.weights.size(); ++i) {
      h.cosine += span.weights[i] * from[std::size_t(span.first) + i].cosine;
      h.sine += span.weights[i] * from[std::size_t(span.first) + i].sine;
    }
  }
  return to;
}

/// Gives a row the first harmonic `wanted`, or as much of it as leaves no texel below 0: light is
/// never negative.
void keepFirstHarmonic(float* row, const std::vector<glm::dvec2>& around,
                       const FirstHarmonic& wanted) {
  const int count = int(around.size());
  if (count < 4) return;
  const FirstHarmonic now = firstHarmonic(row, around);
  for (int c = 0; c < 3; ++c) {
    const double cosine = wanted.cosine[c] - now.cosine[c], sine = wanted.sine[c] - now.sine[c];
    const auto missing = [&](int i) {
      const glm::dvec2& at = around[std::size_t(i)];
      return cosine * at.x + sine * at.y;
    };
    double share = 1;
    for (int i = 0; i < count; ++i)
      if (const double more = missing(i); row[3 * i + c] + share * more < 0)
        share = double(row[3 * i + c]) / -more;
    for (int i = 0; i < count; ++i)
      row[3 * i + c] = float(std::max(row[3 * i + c] + share * missing(i), 0.0));
  }
}

/// Replaces each texel by the mean of the row over `width` texels around it, wrapping around the
/// sphere.
void widenRow(float* row, int count, double width) {
  if (width <= 1) return;
  std::vector<glm::dvec3> sums(std::size_t(count) + 1, glm::dvec3(0.0));
  for (int i = 0; i < count; ++i)
    sums[std::size_t(i) + 1] =
        sums[std::size_t(i)] + glm::dvec3(row[3 * i], row[3 * i + 1], row[3 * i + 2]);
  const auto before = [&](double x) {  // the integral up to x, which may lie beyond the row's ends
    const double round = std::floor(x / count);
    x -= round * count;
    const std::size_t i = std::min(std::size_t(x), std::size_t(count) - 1);
    return sums[std::size_t(count)] * round + sums[i] + (x - double(i)) * (sums[i + 1] - sums[i]);
  };
  width = std::min(width, double(count));
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 mean = (before(i + 0.5 + width / 2) - before(i + 0.5 - width / 2)) / width;
    for (int c = 0; c < 3; ++c) row[3 * i + c] = float(std::max(mean[c], 0.0));
  }
}

void widenTowardsPoles(Level& level, const std::vector<FirstHarmonic>& harmonics) {
  const auto around = longitudes(level.width);
  for (int y = 0; y < level.height; ++y) {
    const double sine = std::sin((y + 0.5) * pi / level.height);
    // In the row next to a pole, a texel's height reaches around the pole.
    const bool pole = y == 0 || y == level.height - 1;
    const double width = pole ? level.width : level.width / (2 * level.height * sine);
    float* row = &level.rgb[std::size_t(3) * level.width * y];
    widenRow(row, level.width, width);
    keepFirstHarmonic(row, around, harmonics[std::size_t(y)]);
  }
}

/// Interpolates linearly between the texels of a row, wrapping around the sphere.
glm::dvec3 along(const Level& level, double u, int row) {
  const double x = u * level.width - 0.5, left = std::floor(x), share = x - left;
  const auto texel = [&](double column) {
    const int i = int(column - level.width * std::floor(column / level.width));
    const float* t = &level.rgb[std::size_t(3) * (std::size_t(row) * level.width + i)];
    return glm::dvec3(t[0], t[1], t[2]);
  };
  return (1 - share) * texel(left) + share * texel(left + 1);
}

glm::dvec3 bilinear(const Level& level, double u, double v) {
  const double y = v * level.height - 0.5, top = std::floor(y), share = y - top;
  const auto row = [&](int j) {
    if (j < 0) return along(level, u + 0.5, 0);
    if (j >= level.height) return along(level, u + 0.5, level.height - 1);
    return along(level, u, j);
  };
  return (1 - share) * row(int(top)) + share * row(int(top) + 1);
}

std::shared_ptr<const EnvironmentImage> readEnvironment(const std::string& path) {
  Image image;
  try {
    const std::vector<std::byte> bytes = readFile(path);
    // Decoded to floats, a single picture may take three times the limit.
    constexpr std::uint64_t perPixel = 4 * sizeof(float);
    const std::uint64_t most = 3 * decodeLimit(bytes.size());
    const PictureLimit limit(most / perPixel, "decoded they take more than " +
                                                  std::to_string(most >> 20) +
                                                  " MiB: make it smaller or raise --decode-limit");
    image = decodeImage(bytes, path);
  } catch (const InputError& error) {
    throw InputError("--hdri-file: " + std::string(error.what()));
  }
  // In place: a copy would double the memory of a large picture.
  std::vector<float>& rgb = image.values;
  const std::size_t count = std::size_t(image.width) * image.height;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c) rgb[3 * i + c] = rgb[4 * i + c];
  rgb.resize(3 * count);
  auto result = std::make_shared<EnvironmentImage>(
      makeEnvironmentImage(image.width, image.height, std::move(rgb)));
  result->name = path;
  return result;
}

}  // namespace

double EnvironmentImage::levelFor(double spread) const {
  const double level = std::log2(spread * levels[0].height / (std::numbers::sqrt3 * pi));
  return level > 0 ? std::min(level, double(levels.size() - 1)) : 0;
}

glm::dvec3 EnvironmentImage::radiance(const glm::dvec3& direction, double spread) const {
  const double across = std::hypot(direction.x, direction.z);
  const double u = 0.5 + std::atan2(direction.x, -direction.z) / (2 * pi);
  const double v = std::atan2(across, direction.y) / pi;
  const double level = levelFor(spread);
  const std::size_t lower = std::size_t(level);
  const double share = level - double(lower);
  const glm::dvec3 fine = bilinear(levels[lower], u, v);
  return share > 0 ? (1 - share) * fine + share * bilinear(levels[lower + 1], u, v) : fine;
}

EnvironmentImage makeEnvironmentImage(int width, int height, std::vector<float> rgb) {
  EnvironmentImage image;
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    bool corrected = false;
    for (std::size_t c = i; c < i + 3; ++c) {
      corrected = corrected || !(rgb[c] >= 0) || !std::isfinite(rgb[c]);
      rgb[c] = rgb[c] > 0 ? std::min(rgb[c], 1e30f) : 0.0f;
    }
    image.corrected += corrected;
  }
  Level level{width, height, std::move(rgb)};
  while (std::max(level.width, level.height) > maxTextureSide) level = halved(level);
  image.levels.push_back(std::move(level));
  std::vector<FirstHarmonic> harmonics = firstHarmonics(image.levels[0]);
  // Each is made from the one before, as it was before widening.
  const Level* finer = &image.levels[0];
  while (finer->width > 1 || finer->height > 1) {
    level = halved(*finer);
    finer = &level;
    harmonics = halved(harmonics, level.height);
    image.levels.push_back(level);
    widenTowardsPoles(image.levels.back(), harmonics);
  }
  return image;
}

std::shared_ptr<const EnvironmentImage> environmentImageFor(const Look& look) {
  const bool shown =
      look.shading == Shading::environment || (look.environmentBackground && !look.noBackground);
  if (look.hdriFile.empty() || !shown) return nullptr;
  static std::mutex mutex;
  static std::shared_ptr<const EnvironmentImage> last;
  static std::filesystem::file_time_type lastTime;
  std::error_code error;
  const auto time = std::filesystem::last_write_time(look.hdriFile, error);
  const std::lock_guard lock(mutex);
  if (!last || error || last->name != look.hdriFile || time != lastTime) {
    last.reset();  // first: both at once would double the memory
    last = readEnvironment(look.hdriFile);
    lastTime = time;
  }
  return last;
}

}  // namespace glint
