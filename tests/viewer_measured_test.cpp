#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <vector>

#include "files.h"
#include "glint/image/error.h"
#include "viewer/measured.h"

namespace glint::viewer {
namespace viewer_measured_test {

using std::numbers::pi;
namespace fs = std::filesystem;

// The light at a bin's centre, as in the format; written independently of the code that reads it.
void directions(glm::ivec3 bins, int h, int d, int p, glm::dvec3& L, glm::dvec3& V) {
  const double low = double(h) / bins.x, high = double(h + 1) / bins.x;
  const double a = pi / 2 * (low * low + high * high) / 2, t = pi / 2 * (d + 0.5) / bins.y,
               f = pi * (p + 0.5) / bins.z;
  const auto place = [&](double x, double y, double z) {
    return glm::dvec3(std::cos(a) * x + std::sin(a) * z, y, -std::sin(a) * x + std::cos(a) * z);
  };
  L = place(std::sin(t) * std::cos(f), std::sin(t) * std::sin(f), std::cos(t));
  V = place(-std::sin(t) * std::cos(f), -std::sin(t) * std::sin(f), std::cos(t));
}

// Writes a measured material computed from a model, in a file with few bins.
fs::path written(const fs::path& path, const ShadingParameters& s, const FitForm& form) {
  const glm::ivec3 bins(90, 30, 36);
  const double scale[3] = {1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
  std::vector<double> values[3];
  for (int h = 0; h < bins.x; ++h)
    for (int d = 0; d < bins.y; ++d)
      for (int p = 0; p < bins.z; ++p) {
        glm::dvec3 L, V;
        directions(bins, h, d, p, L, V);
        const bool seen = L.z > 1e-3 && V.z > 1e-3;
        const glm::dvec3 light = seen ? modelLight(s, form, L, V) / (pi * L.z) : glm::dvec3(-1.0);
        for (int c = 0; c < 3; ++c) values[c].push_back(seen ? light[c] / scale[c] : -1);
      }
  std::ofstream file(path, std::ios::binary);
  const std::int32_t header[3] = {bins.x, bins.y, bins.z};
  file.write(reinterpret_cast<const char*>(header), sizeof header);
  for (const auto& channel : values)
    file.write(reinterpret_cast<const char*>(channel.data()),
               std::streamsize(channel.size() * sizeof(double)));
  return path;
}

ShadingParameters paint() {
  ShadingParameters s;
  s.color = {0.6, 0.2, 0.05};
  s.diffuse = 0.8;
  s.specular = 0.4;
  s.exponent = 35;
  s.metalness = 0;
  return s;
}

ShadingParameters gold() {
  ShadingParameters s;
  s.color = {1, 0.7, 0.3};
  s.diffuse = 0.05;
  s.specular = 3;
  s.exponent = 120;
  s.metalness = 1;
  return s;
}

TEST(Measured, ReadsWhatStandsInTheFile) {
  const test::Folder folder("measured");
  const ShadingParameters s = paint();
  const MeasuredMaterial m(written(folder / "paint.binary", s, {}));
  EXPECT_EQ(m.bins(), glm::ivec3(90, 30, 36));
  int compared = 0;
  for (const int h : {2, 20, 45})
    for (const int d : {1, 9, 15})
      for (const int p : {0, 11, 35}) {
        glm::dvec3 L, V;
        directions(m.bins(), h, d, p, L, V);
        if (L.z < 0.01 || V.z < 0.01) continue;
        const glm::dvec3 light = m.light(L, V), expected = modelLight(s, {}, L, V);
        // The file stores the values to float precision.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(light[c], expected[c], 1e-6 * (1 + expected[c]));
        // Reciprocal except for the cosine, like the format: the half vector is the same.
        const glm::dvec3 back = m.light(V, L) / V.z * L.z;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], light[c], 0.05 * light[c] + 1e-9);
        ++compared;
      }
  EXPECT_GT(compared, 15);
  EXPECT_TRUE(std::isnan(m.light({0, 0, -1}, {0, 0, 1}).x));
}

// Fitting a model's own light recovers the model, with either lobe; the other lobe fits less well.
TEST(Measured, TheFitFindsTheModelAgain) {
  const test::Folder folder("measured");
  for (const FitForm form : {FitForm{false, 4}, FitForm{true, 4}})
    for (const ShadingParameters& s : {paint(), gold()}) {
      const MeasuredMaterial m(written(folder / "a.binary", s, form));
      ShadingParameters from;
      from.ior = 1.8;
      const ShadingParameters fit = fitted(m, form, from);
      EXPECT_NEAR(fit.exponent, s.exponent, 0.01 * s.exponent);
      EXPECT_NEAR(fit.metalness, s.metalness, 0.02);
      const glm::dvec3 diffuse = fit.diffuse * fit.color, expected = s.diffuse * s.color;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(diffuse[c], expected[c], 0.01 * s.specular);
      EXPECT_EQ(fit.ior, 1.8);
      const FitError right = errorOf(m, fit, form);
      EXPECT_LT(right.relative, 0.01);
      ShadingParameters wrong = fit;
      wrong.exponent *= 1.5;
      EXPECT_GT(errorOf(m, wrong, form).rmse, 5 * right.rmse);
      const FitForm other{!form.blinn, 4};
      const FitError far = errorOf(m, fitted(m, other, from), other);
      EXPECT_GT(far.rmse, 3 * right.rmse);
    }
}

TEST(Measured, RefusesWhatIsNone) {
  const test::Folder folder("measured");
  const auto refuses = [&](const fs::path& path) {
    EXPECT_THAT(test::messageOf([&] { MeasuredMaterial m(path); }),
                testing::HasSubstr(path.filename().string()));
  };
  refuses(folder / "missing.binary");
  const auto file = [&](const char* name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
  };
  refuses(file("empty.binary", ""));
  refuses(file("short.binary", std::string("\x5a\0\0\0\x5a\0\0\0\xb4\0\0\0 and no more", 25)));
  refuses(file("huge.binary", std::string(12, '\x7f')));
  refuses(file("negative.binary", std::string(12, '\xff')));
  refuses(folder.path());
}

}  // namespace viewer_measured_test
}  // namespace glint::viewer
