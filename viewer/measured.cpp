#include "measured.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <numbers>

#include "glint/image/error.h"
#include "glint/shading/angles.h"
#include "glint/shading/lobe.h"

namespace glint::viewer {
namespace {

using std::numbers::pi;

// From the format: the stored values are camera counts.
constexpr double channelScale[3] = {1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
constexpr std::int64_t mostValues = 1 << 24;

// v rotated about a unit axis.
glm::dvec3 turnedAbout(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1 - c));
}

struct Pair {
  glm::dvec3 L, V;
  double weight;
  glm::dvec3 measured;
};

// Pairs of directions at the bin centres. The measure over both hemispheres is
// dL dV = 4 cos(d) dH dD (Torrance and Sparrow's Jacobian), where dH and dD are each a sine times
// the differentials of the angles.
std::vector<Pair> pairsOf(const MeasuredMaterial& m) {
  const glm::ivec3 bins = m.bins();
  const int stepD = std::max(1, bins.y / 30), stepP = std::max(1, bins.z / 18);
  const double horizon = std::cos(80 * radians);
  std::vector<Pair> pairs;
  for (int h = 0; h < bins.x; ++h) {
    // The bin's edges; the format spaces them as angle = (index / bins)^2 of a right angle.
    const double low = pi / 2 * std::pow(double(h) / bins.x, 2);
    const double high = pi / 2 * std::pow(double(h + 1) / bins.x, 2);
    const double halfAngle = (low + high) / 2;
    for (int d = stepD / 2; d < bins.y; d += stepD) {
      const double difference = pi / 2 * (d + 0.5) / bins.y;
      for (int p = stepP / 2; p < bins.z; p += stepP) {
        const double phi = pi * (p + 0.5) / bins.z;
        const glm::dvec3 out(std::sin(difference) * std::cos(phi),
                             std::sin(difference) * std::sin(phi), std::cos(difference));
        Pair pair;
        pair.L = turnedAbout(out, {0, 1, 0}, halfAngle);
        const glm::dvec3 H(std::sin(halfAngle), 0, std::cos(halfAngle));
        pair.V = 2 * glm::dot(pair.L, H) * H - pair.L;
        if (pair.L.z < horizon || pair.V.z < horizon) continue;
        pair.measured = m.light(pair.L, pair.V);
        if (!std::isfinite(pair.measured.x)) continue;
        pair.weight =
            std::sin(halfAngle) * (high - low) * std::sin(difference) * std::cos(difference);
        pairs.push_back(pair);
      }
    }
  }
  return pairs;
}

double lambdaOf(const FitForm& form, const Pair& p) {
  const glm::dvec3 N(0, 0, 1);
  return form.blinn ? blinnLambda(N, p.L, p.V) : phongLambda(N, p.L, p.V);
}

double alphaOf(const FitForm& form, double exponent) {
  return form.blinn ? form.blinnFactor * exponent : exponent;
}

FitError errorOf(const std::vector<Pair>& pairs, const ShadingParameters& s, const FitForm& form) {
  double squares = 0, all = 0, weights = 0;
  FitError error;
  for (const Pair& p : pairs) {
    const glm::dvec3 d = modelLight(s, form, p.L, p.V) - p.measured;
    squares += p.weight * glm::dot(d, d);
    all += p.weight * glm::dot(p.measured, p.measured);
    weights += 3 * p.weight;
    for (int c = 0; c < 3; ++c) error.largest = std::max(error.largest, std::abs(d[c]));
  }
  if (weights > 0) error.rmse = std::sqrt(squares / weights);
  error.relative = all > 0 ? std::sqrt(squares / all) : 0;
  return error;
}

// For one exponent, the best-fitting diffuse and specular light per channel, none negative.
struct Parts {
  glm::dvec3 diffuse{0.0}, specular{0.0};
  double squares = 0;  // the remaining error, up to a constant
};

Parts partsFor(const std::vector<Pair>& pairs, const std::vector<double>& lambdas, double alpha) {
  double dd = 0, ds = 0, ss = 0;
  glm::dvec3 md(0.0), ms(0.0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Pair& p = pairs[i];
    const double diffuse = p.L.z, lobe = lobeExact(lambdas[i], alpha);
    dd += p.weight * diffuse * diffuse;
    ds += p.weight * diffuse * lobe;
    ss += p.weight * lobe * lobe;
    md += p.weight * diffuse * p.measured;
    ms += p.weight * lobe * p.measured;
  }
  Parts parts;
  const double det = dd * ss - ds * ds;
  for (int c = 0; c < 3; ++c) {
    double d = 0, s = 0;
    if (det > 1e-12 * dd * ss) {
      d = (ss * md[c] - ds * ms[c]) / det;
      s = (dd * ms[c] - ds * md[c]) / det;
    }
    if (!(det > 1e-12 * dd * ss) || s < 0) d = dd > 0 ? md[c] / dd : 0, s = 0;
    if (d < 0) d = 0, s = ss > 0 ? std::max(ms[c] / ss, 0.0) : 0;
    parts.diffuse[c] = d;
    parts.specular[c] = s;
    parts.squares += d * d * dd + 2 * d * s * ds + s * s * ss - 2 * (d * md[c] + s * ms[c]);
  }
  return parts;
}

// The parts as parameters of a material of colour `color`: specular light as the least-squares fit
// of m_s (m_sm C + 1 - m_sm), diffuse light as m_d C.
ShadingParameters parametersFor(const Parts& parts, const glm::dvec3& color,
                                const ShadingParameters& from) {
  ShadingParameters s = from;
  const glm::dvec3 C = color, k = parts.specular;
  s.color = C;
  const double cc = glm::dot(C, C), c1 = C.r + C.g + C.b, ck = glm::dot(C, k), k1 = k.r + k.g + k.b;
  s.diffuse = cc > 0 ? glm::dot(C, parts.diffuse) / cc : 0;
  const double det = 3 * cc - c1 * c1;
  double u = 0, v = 0;
  if (det > 1e-9 * cc) {
    u = (3 * ck - c1 * k1) / det;
    v = (cc * k1 - c1 * ck) / det;
  }
  if (!(det > 1e-9 * cc) || u < 0) u = 0, v = k1 / 3;
  if (v < 0) v = 0, u = cc > 0 ? ck / cc : 0;
  s.specular = u + v;
  s.metalness = u + v > 0 ? u / (u + v) : 0;
  return s;
}

}  // namespace

MeasuredMaterial::MeasuredMaterial(const std::filesystem::path& path) : path_(path) {
  const std::string name = path.string();
  std::ifstream file(path, std::ios::binary);
  std::int32_t header[3];
  if (!file) throw InputError(name + ": cannot be read: check the path");
  if (!file.read(reinterpret_cast<char*>(header), sizeof header))
    throw InputError(name + ": too short for a measured material: give a MERL .binary file");
  std::int64_t count = 1;
  for (const std::int32_t n : header) {
    if (n < 1 || n > 4096)
      throw InputError(name + ": not a measured material: give a MERL .binary file");
    count *= n;
  }
  std::error_code none;
  const auto size = std::filesystem::file_size(path, none);
  if (none || count > mostValues ||
      size != sizeof header + std::uint64_t(count) * 3 * sizeof(double))
    throw InputError(name + ": holds " + std::to_string(size) + " bytes, but its header declares " +
                     std::to_string(header[0]) + " x " + std::to_string(header[1]) + " x " +
                     std::to_string(header[2]) + " values: copy the file again");
  bins_ = {header[0], header[1], header[2]};
  std::vector<double> values(std::size_t(count), 0.0);
  for (int c = 0; c < 3; ++c) {
    if (!file.read(reinterpret_cast<char*>(values.data()),
                   std::streamsize(values.size() * sizeof(double))))
      throw InputError(name + ": ends too early: copy the file again");
    values_[c].reserve(values.size());
    for (const double v : values)
      values_[c].push_back(v >= 0 && v < 1e30 ? float(v * channelScale[c])
                                              : std::numeric_limits<float>::quiet_NaN());
  }
}

glm::dvec3 MeasuredMaterial::light(const glm::dvec3& L, const glm::dvec3& V) const {
  const glm::dvec3 nothing(std::numeric_limits<double>::quiet_NaN());
  const glm::dvec3 sum = L + V;
  const double length = glm::length(sum);
  if (!(L.z > 0) || !(V.z > 0) || !(length > 0)) return nothing;
  const glm::dvec3 H = sum / length;
  const double halfAngle = std::acos(std::clamp(H.z, -1.0, 1.0));
  const double around = std::atan2(H.y, H.x);
  const glm::dvec3 d = turnedAbout(turnedAbout(L, {0, 0, 1}, -around), {0, 1, 0}, -halfAngle);
  double phi = std::atan2(d.y, d.x);
  if (phi < 0) phi += pi;
  const auto index = [](double share, int bins) {
    return std::size_t(std::clamp(int(share * bins), 0, bins - 1));
  };
  const std::size_t h = index(std::sqrt(halfAngle / (pi / 2)), bins_.x);
  const std::size_t t = index(std::acos(std::clamp(d.z, -1.0, 1.0)) / (pi / 2), bins_.y);
  const std::size_t p = index(phi / pi, bins_.z);
  const std::size_t at = p + std::size_t(bins_.z) * (t + std::size_t(bins_.y) * h);
  return glm::dvec3(values_[0][at], values_[1][at], values_[2][at]) * (pi * L.z);
}

glm::dvec3 modelLight(const ShadingParameters& s, const FitForm& form, const glm::dvec3& L,
                      const glm::dvec3& V) {
  if (!(L.z > 0)) return glm::dvec3(0.0);
  const double lobe = lobeExact(lambdaOf(form, {L, V, 0, {}}), alphaOf(form, s.exponent));
  const glm::dvec3 S = s.metalness * s.color + (1 - s.metalness);
  return s.diffuse * s.color * L.z + s.specular * S * lobe;
}

FitError errorOf(const MeasuredMaterial& m, const ShadingParameters& s, const FitForm& form) {
  return errorOf(pairsOf(m), s, form);
}

ShadingParameters fitted(const MeasuredMaterial& m, const FitForm& form,
                         const ShadingParameters& from) {
  const std::vector<Pair> pairs = pairsOf(m);
  if (pairs.empty()) throw InputError(m.path().string() + ": has no measured values");
  std::vector<double> lambdas;
  for (const Pair& p : pairs) lambdas.push_back(lambdaOf(form, p));
  const auto left = [&](double logExponent) {
    return partsFor(pairs, lambdas, alphaOf(form, std::exp(logExponent))).squares;
  };
  // The error may have several minima: first a coarse search, then refinement around the lowest.
  const double least = std::log(0.25), most = std::log(20000.0);
  constexpr int steps = 36;
  double best = least, lowest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i) {
    const double at = least + (most - least) * i / steps;
    if (const double here = left(at); here < lowest) lowest = here, best = at;
  }
  double low = best - (most - least) / steps, high = best + (most - least) / steps;
  const double golden = (std::sqrt(5.0) - 1) / 2;
  for (int i = 0; i < 18; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (left(a) < left(b) ? high : low) = left(a) < left(b) ? b : a;
  }
  ShadingParameters start = from;
  start.exponent = std::exp((low + high) / 2);
  const Parts parts = partsFor(pairs, lambdas, alphaOf(form, start.exponent));
  // The hue of the diffuse light or, as for metals, that of the highlight: whichever fits better.
  ShadingParameters nearest = start;
  double error = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& hue : {parts.diffuse, parts.specular}) {
    const double strongest = std::max({hue.r, hue.g, hue.b});
    if (!(strongest > 0)) continue;
    const glm::dvec3 color = hue / std::max(strongest, 1.0);
    ShadingParameters candidate = parametersFor(parts, color, start);
    for (double* x :
         {&candidate.diffuse, &candidate.specular, &candidate.exponent, &candidate.metalness,
          &candidate.color.r, &candidate.color.g, &candidate.color.b}) {
      const double place = *x > 0 ? std::pow(10.0, std::floor(std::log10(*x)) - 3) : 1;
      *x = std::round(*x / place) * place;  // four digits
    }
    const double its = errorOf(pairs, candidate, form).rmse;
    if (its < error) error = its, nearest = candidate;
  }
  return nearest;
}

}  // namespace glint::viewer
