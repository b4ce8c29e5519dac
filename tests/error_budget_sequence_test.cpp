// --max-error in picture codes, over several pictures, and near lamps.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "glint/budget/error_budget.h"
#include "glint/budget/scene_distance.h"
#include "glint/image/srgb.h"
#include "glint/scene/look_text.h"
#include "glint/shading/bounds.h"
#include "random.h"
#include "scenes.h"

namespace glint::test::error_budget_sequence_test {

TEST(ErrorBudgetInCodes, KeepsEveryCodeWithinThem) {
  Random r(11);
  for (int i = 0; i < 200000; ++i) {
    Look look;
    look.maxError = 1 + r.below(3);
    look.maxErrorInCodes = true;
    look.exposure = r.coin() ? 0 : 8 * r.unit() - 4;
    const double budget = *errorBudget(look), scale = std::exp2(look.exposure);
    const double x = (r.coin() ? r.log(1e-4, 1) : r.unit()) / scale;
    const auto code = [&](double value) { return int(encodeSrgb8(float(value * scale))); };
    ASSERT_LE(code(x + budget * (1 - 1e-6)) - code(x), int(*look.maxError))
        << x << " exposure " << look.exposure;
  }
}

TEST(ErrorBudgetInCodes, IsTheLinearOneWithoutThem) {
  Look look;
  EXPECT_FALSE(errorBudget(look));
  look.maxError = 0.02;
  EXPECT_EQ(*errorBudget(look), 0.02);
}

// A sphere that approaches a lamp and leaves it again: the choice is the one needed at the nearest
// position.
TEST(ErrorBudgetOfASequence, IsOneChoiceWithinItInEveryPicture) {
  std::vector<Scene> scenes;
  for (const double z : {-20.0, -1.0, 2.5, 0.0})
    scenes.push_back(
        sceneOf(sphere(24, 12), materialOf(0.1, 0.5, 0.6, 60), translation({0, 0, z})));
  Look look;
  look.maxError = 0.02;
  Light lamp = directional({0, 0, 1});
  lamp.type = Light::Type::point;
  lamp.position = {0, 0, 4};
  lamp.fallsOff = true;
  look.light = {lamp};
  const ResolvedLook all = resolveSequence(scenes.size(), [&](std::size_t i) {
    return LookAtScene{scenes[i], boundsOf(scenes[i]), look};
  });
  const ResolvedLook dim = resolveLook(scenes[0], boundsOf(scenes[0]), look),
                     bright = resolveLook(scenes[2], boundsOf(scenes[2]), look);
  EXPECT_NE(dim.look.highlight, bright.look.highlight);
  EXPECT_EQ(all.look.highlight, bright.look.highlight);
  EXPECT_GE(all.bound, bright.bound * (1 - 1e-12));
  const Look shown = withChoice(look, all);
  EXPECT_EQ(shown.highlight, all.look.highlight);
  EXPECT_FALSE(shown.maxError);
}

// Compared with the nearest of many points on the triangles.
TEST(SceneDistance, IsThatOfTheNearestPlace) {
  Random r(5);
  for (int i = 0; i < 200; ++i) {
    const glm::dmat4 world =
        translation(r.direction()) * rotation(7 * r.unit()) * scaling({1, r.log(0.1, 3), 1});
    const Scene scene = sceneOf(r.coin() ? quad() : sphere(7, 5), {}, world);
    const SceneDistance distance(scene);
    const glm::dvec3 place = r.log(0.01, 10) * r.direction();
    const Mesh& mesh = scene.meshes[0];
    double nearest = 1e9;
    constexpr int steps = 40;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
      const auto corner = [&](std::size_t k) {
        return glm::dvec3(world * glm::dvec4(mesh.positions[mesh.indices[t + k]], 1));
      };
      const glm::dvec3 a = corner(0), b = corner(1), c = corner(2);
      for (int x = 0; x <= steps; ++x)
        for (int y = 0; x + y <= steps; ++y)
          nearest = std::min(nearest, glm::length(a + double(x) / steps * (b - a) +
                                                  double(y) / steps * (c - a) - place));
    }
    const double found = distance.to(place);
    EXPECT_LE(found, nearest + 1e-12);
    EXPECT_GE(found, nearest - 8.0 / steps);  // edges are up to 12 long
  }
  EXPECT_TRUE(std::isinf(SceneDistance(Scene{}).to({0, 0, 0})));
}

// A lamp above a plane, at a thousandth of the viewing distance: the bound includes how far floats
// turn the light, an order of magnitude above the 4.6e-4 measured.
TEST(ErrorBudgetNearLamps, CountsWhatPositionsAreOffBy) {
  const Scene scene = sceneOf(quad(), materialOf(0, 1, 0.5, 30));
  for (const double height : {1e-2, 1e-3}) {
    Look look;
    look.maxError = 1e-3;
    look.cameraPosition = glm::dvec3(0, 0, 10);
    look.cameraFocalPoint = glm::dvec3(0);
    Light lamp = directional({0, 0, 1});
    lamp.type = Light::Type::point;
    lamp.position = {0, 0, height};
    look.light = {lamp};
    const ResolvedLook resolved = resolveLook(scene, boundsOf(scene), look);
    EXPECT_GT(resolved.bound, 4.6e-6 / height) << height;
    EXPECT_LT(resolved.bound, 1e-2 / height * 1e-1) << height;
    look.light->front().position.z = 10;
    EXPECT_LT(resolveLook(scene, boundsOf(scene), look).bound, 1e-3);
  }
}

// The exact lobe with its difference vector turned by an error.
TEST(LobeTurnBound, HoldsForEveryTurn) {
  Random r(8);
  for (int i = 0; i < 200000; ++i) {
    const double alpha = r.log(0.1, 1e5), turn = r.log(1e-7, 1), angle = 1.5 * r.unit();
    const auto lobe = [&](double difference) {
      const double base = 1 - difference * difference / 2;
      return base > 0 ? std::pow(base, alpha) : 0.0;
    };
    const double moved = std::abs(lobe(angle + turn) - lobe(angle));
    ASSERT_LE(moved, lobeTurnBound(alpha, false, turn) * (1 + 1e-9) + 1e-15)
        << "exponent " << alpha << " at " << angle << " turned by " << turn;
  }
}

}  // namespace glint::test::error_budget_sequence_test
