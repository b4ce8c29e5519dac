#include <gtest/gtest.h>

#include "scenes.h"
#include "viewer/choice.h"
#include "viewer/reference_task.h"

namespace glint::viewer {
namespace viewer_choice_test {

// A ball whose picture is accurate enough with gouraud if there is no highlight.
struct Ball {
  Scene scene = test::sceneOf(test::sphere(48, 24), test::materialOf(0.1, 0.8, 0.5, 20));
  Bounds bounds = boundsOf(scene);
  Look look;
  Chooser chooser;
  Ball() { look.maxError = 0.02; }
  auto choose(bool moves = false) {
    return chooser.choose(scene, bounds, look, look.resolution, moves);
  }
};

TEST(ViewerChoice, IsThatOfGlintRender) {
  for (const Shading shading : {Shading::phong, Shading::environment, Shading::automatic})
    for (const bool budget : {true, false}) {
      Ball ball;
      ball.look.shading = shading;
      ball.look.highlight = {Highlight::pade, 4};
      ball.look.exposure = 1;
      ball.look.antiAliasing = {AntiAliasing::Mode::ssaa, 2};
      const std::string name = ball.scene.materials[0].name;
      ball.look.material[name].diffuse = 0.7;
      ball.look.material[name].highlight = Highlight::pow;
      if (!budget) ball.look.maxError.reset();
      const Look drawn = withChoice(ball.look, *ball.choose());
      EXPECT_FALSE(leavesOpen(drawn));
      EXPECT_EQ(drawn, resolveLook(ball.scene, ball.bounds, ball.look).look);
    }
}

TEST(ViewerChoice, IsKeptWhileWhatItDependsOnStays) {
  Ball ball;
  const auto first = ball.choose();
  ASSERT_EQ(first->choices.size(), 1u);
  EXPECT_NE(first->choices[0].highlight, HighlightForm());
  ball.look.exposure = 2;
  ball.look.antiAliasing = {AntiAliasing::Mode::none, 1};
  EXPECT_EQ(ball.choose(), first);
  ball.look.maxError = 1e-7;
  const auto exact = ball.choose();
  EXPECT_EQ(exact->choices[0].highlight, HighlightForm());
  ball.look.maxError = 0.02;
  EXPECT_EQ(ball.choose(), first);
  ball.chooser.forget();
  EXPECT_NE(ball.choose(), first);
}

TEST(ViewerChoice, OfAnotherCameraServesWhileSomethingMoves) {
  Ball ball;
  const auto first = ball.choose();
  ball.look.cameraAzimuthAngle = 30;
  EXPECT_EQ(ball.choose(true), first);
  EXPECT_NE(ball.choose(false), first);
  // An edit triggers a choice at once, and for the size of the whole picture.
  ball.look.material[""].diffuse = 0.3;
  const auto edited = ball.choose(true);
  EXPECT_NE(edited, first);
  EXPECT_EQ(edited->look.resolution, ball.look.resolution);
}

TEST(ViewerChoice, TheReferenceHasTheProgramChosenAndExactForms) {
  Ball ball;
  ball.look.shading = Shading::automatic;
  ball.look.maxError = 0.1;
  ball.look.material[""].specular = 0;
  const Look drawn = withChoice(ball.look, *ball.choose());
  EXPECT_EQ(drawn.shading, Shading::gouraud);
  const Look exact = exactLook(drawn);
  EXPECT_EQ(exact.shading, Shading::gouraud);
  EXPECT_EQ(exact.highlight, HighlightForm());
  EXPECT_FALSE(leavesOpen(exact));
}

}  // namespace viewer_choice_test
}  // namespace glint::viewer
