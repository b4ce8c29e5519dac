// The files in models/: that the program makes exactly these files, and that their contents are
// right, by formulas that the program does not use.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "models_file.h"

namespace models_test {

using namespace shipped;

const std::vector<std::string> names = {"sphere.glb",
                                        "torus.glb",
                                        "teapot.glb",
                                        "torus-knot.glb",
                                        "preview.glb",
                                        "chart.glb",
                                        "bend.glb",
                                        "morph.glb",
                                        "lights.glb",
                                        "sphere-series/sphere-1.glb",
                                        "sphere-series/sphere-2.glb",
                                        "sphere-series/sphere-3.glb",
                                        "sphere-series/sphere-4.glb",
                                        "sphere-series/sphere-5.glb",
                                        "sphere-series/sphere-6.glb"};

TEST(Models, ShippedFilesAreThoseThatTheProgramMakes) {
  const std::filesystem::path made = testing::TempDir() + "glint_models_test";
  std::filesystem::remove_all(made);
  const std::string command =
      "\"" GLINT_BINARY_DIR "/models/make_models\" \"" + made.string() + "\"";
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  for (const std::string& name : names) {
    EXPECT_TRUE(readFile(made / name) == readFile(folder / name)) << name;
  }
  std::filesystem::remove_all(made);
}

TEST(Models, TakeLittleRoom) {
  std::uintmax_t size = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    size += entry.is_regular_file() ? entry.file_size() : 0;
  }
  EXPECT_LT(size, 3'000'000u);
}

TEST(Models, ContainersAreWhole) {
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const std::string bytes = readFile(folder / name);
    ASSERT_GT(bytes.size(), 28u);
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(wordAt(bytes, 4), 2u);
    EXPECT_EQ(wordAt(bytes, 8), bytes.size());
    const std::size_t jsonLength = wordAt(bytes, 12);
    EXPECT_EQ(jsonLength % 4, 0u);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(wordAt(bytes, 20 + jsonLength), bytes.size() - 28 - jsonLength);
    EXPECT_EQ(bytes.substr(24 + jsonLength, 4), std::string("BIN\0", 4));
    EXPECT_EQ(bytes.size() % 4, 0u);
  }
}

TEST(Models, DocumentsSayWhatTheBuffersHold) {
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const Model model = load(name);
    const json& document = model.document;
    EXPECT_EQ(document["asset"]["version"], "2.0");
    EXPECT_EQ(document["asset"]["generator"], "glint");
    EXPECT_EQ(document["asset"]["copyright"], "MIT, the glint authors");
    EXPECT_EQ(document["buffers"][0]["byteLength"], model.buffer.size());

    glm::dvec3 least = model.positions.front(), most = least;
    for (const glm::dvec3& position : model.positions) {
      least = glm::min(least, position);
      most = glm::max(most, position);
    }
    const json& bounds =
        document["accessors"]
                [document["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<int>()];
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(bounds["min"][i], least[i]);
      EXPECT_EQ(bounds["max"][i], most[i]);
    }

    EXPECT_EQ(model.normals.size(), model.positions.size());
    std::vector<bool> isUsed(model.positions.size(), false);
    for (const std::uint32_t index : model.indices) {
      ASSERT_LT(index, model.positions.size());
      isUsed[index] = true;
    }
    EXPECT_TRUE(std::find(isUsed.begin(), isUsed.end(), false) == isUsed.end());
    for (const glm::dvec3& normal : model.normals) {
      ASSERT_NEAR(glm::length(normal), 1.0, 1e-7);
    }
    expectFacesFollowNormals(model);

    const json& phong = document["materials"][0]["extras"]["glint"];
    for (const char* key :
         {"ambient", "diffuse", "specular", "exponent", "metalness", "ior", "color"}) {
      EXPECT_TRUE(phong.contains(key)) << key;
    }
  }
}

TEST(Sphere, LiesOnTheUnitSphere) {
  const Model model = load("sphere.glb");
  EXPECT_EQ(model.triangleCount(), 5040u);
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    ASSERT_NEAR(glm::length(model.positions[i]), 1.0, 1e-7);
    ASSERT_EQ(model.normals[i], model.positions[i]);
  }
  EXPECT_EQ(openEdges(model), 0u);
  // A polyhedron with 72 by 36 faces inside the sphere lacks a fraction of the order of
  // (2 pi/72)^2.
  EXPECT_NEAR(volume(model) / (4.0 / 3.0 * std::numbers::pi), 1.0, 0.0076);
}

TEST(Sphere, TextureCoordinatesAreLongitudeAndLatitude) {
  const Model model = load("sphere.glb");
  ASSERT_EQ(model.texcoords.size(), model.positions.size());
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const glm::dvec3 p = model.positions[i];
    const glm::dvec2 uv = model.texcoords[i];
    // Both by the arc tangent, whose error is that of p divided by the distance from the axis.
    const double fromAxis = std::hypot(p.x, p.z);
    ASSERT_NEAR(uv.y, std::atan2(fromAxis, p.y) / std::numbers::pi, 1e-7);
    if (fromAxis > 0.0) {
      const double turns = std::atan2(p.x, p.z) / (2.0 * std::numbers::pi) + 0.5;
      // The seam has u = 0 and u = 1; the arc tangent gives one of the two.
      ASSERT_NEAR(std::remainder(uv.x - turns, 1.0), 0.0, 1e-7 / fromAxis);
    }
  }
  for (std::size_t t = 0; t < model.triangleCount(); ++t) {  // no triangle spans the seam
    const auto u = [&](int i) { return model.texcoords[model.indices[3 * t + i]].x; };
    ASSERT_LT(std::max({u(0), u(1), u(2)}) - std::min({u(0), u(1), u(2)}), 1.01 / 72.0);
  }
}

TEST(Torus, FulfilsItsEquation) {
  const double major = 0.75, minor = 0.25;
  const Model model = load("torus.glb");
  EXPECT_EQ(model.triangleCount(), 6144u);
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const glm::dvec3 p = model.positions[i];
    const double fromAxis = std::hypot(p.x, p.z);
    // The distance from the tube's circle changes by at most the rounding of p.
    ASSERT_NEAR(std::hypot(fromAxis - major, p.y), minor, rounding);
    const glm::dvec3 middle = major / fromAxis * glm::dvec3(p.x, 0.0, p.z);
    // `middle` moves by major/fromAxis <= 1.5 times the change of p: (1 + 1.5) / minor times the
    // rounding of p, and that of the normal itself.
    ASSERT_LT(glm::distance(model.normals[i], (p - middle) / minor), 11.0 * rounding);
  }
  EXPECT_EQ(openEdges(model), 0u);
  const double exact = 2.0 * std::numbers::pi * std::numbers::pi * major * minor * minor;
  EXPECT_NEAR(volume(model) / exact, 1.0, 0.01);
}

TEST(SphereSeries, RefinesByFour) {
  double largestEdge = 4.0 / std::sqrt(10.0 + 2.0 * std::sqrt(5.0));  // of the icosahedron
  double missingVolume = 0.0;
  for (int level = 1; level <= 6; ++level) {
    SCOPED_TRACE(level);
    const Model model = load("sphere-series/sphere-" + std::to_string(level) + ".glb");
    const std::size_t triangles = std::size_t(20) << (2 * level);
    EXPECT_EQ(model.triangleCount(), triangles);
    EXPECT_EQ(model.positions.size(), triangles / 2 + 2);  // Euler's formula
    EXPECT_EQ(openEdges(model), 0u);
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
      ASSERT_NEAR(glm::length(model.positions[i]), 1.0, 1e-7);
      ASSERT_EQ(model.normals[i], model.positions[i]);
    }

    // The largest triangle is the equilateral one in the middle of an icosahedron's face. Its edges
    // have the arc a and the chord 2 sin(a/2); the triangle of its midpoints has the chord
    // tan(a/2), which tends to half of that.
    double edge = 0.0;
    for (std::size_t t = 0; t < model.triangleCount(); ++t) {
      for (int i = 0; i < 3; ++i) {
        edge = std::max(edge, glm::distance(model.corner(t, i), model.corner(t, (i + 1) % 3)));
      }
    }
    const double expected = std::tan(std::asin(largestEdge / 2.0));
    EXPECT_NEAR(edge, expected, 3.1 * rounding);  // two ends, and the error of the previous level
    EXPECT_LT(edge / largestEdge, level == 1 ? 0.59 : 0.53);
    // The missing volume is a series in the square of the edge: it falls by a factor of four per
    // level, up to a term of the order of that square.
    const double missing = 4.0 / 3.0 * std::numbers::pi - volume(model);
    EXPECT_GT(missing, 0.0);
    if (level > 1) {
      EXPECT_NEAR(missingVolume / missing, 4.0, largestEdge * largestEdge);
    }
    largestEdge = edge;
    missingVolume = missing;
  }
}

TEST(SphereSeries, HasNoVertexAtASpecialPlace) {
  const Model model = load("sphere-series/sphere-6.glb");  // has the vertices of all others
  for (const glm::dvec3& p : model.positions) {
    ASSERT_GT(std::min({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1e-5);
    ASSERT_LT(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1.0 - 2e-5);
  }
}

}  // namespace models_test
