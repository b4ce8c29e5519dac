#include "glint/image/metrics.h"

#include <cmath>
#include <limits>

namespace glint::detail {
namespace {

double rootOfMean(double sum, std::size_t count) { return std::sqrt(sum / double(count)); }

double peakSignalToNoise(const ValueSums& s) {
  const double rmse = rootOfMean(s.square, s.count);
  return rmse == 0 ? std::numeric_limits<double>::infinity() : 0 - 20 * std::log10(rmse);
}

constexpr MetricRow metrics[] = {
    {"max", [](const ValueSums& s) { return s.count > 0 ? s.largest : std::nan(""); }},
    {"mean", [](const ValueSums& s) { return s.absolute / double(s.count); }},
    {"rmse", [](const ValueSums& s) { return rootOfMean(s.square, s.count); }},
    {"relative-rmse", [](const ValueSums& s) { return rootOfMean(s.relative, s.count); }},
    {"psnr", peakSignalToNoise, true},
    {"pixels"},
    {"ssim", nullptr, true},
    {"flip"},
    {"hdr-flip"},
};

}  // namespace

std::span<const MetricRow> metricRows() { return metrics; }

}  // namespace glint::detail
