#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <limits>

#include "reference_scenes.h"
#include "scenes.h"
#include "viewer/error_map.h"
#include "viewer/pace.h"
#include "viewer/reference_task.h"
#include "viewer/worker.h"

namespace glint::viewer {
namespace viewer_background_test {

using namespace std::chrono_literals;

void waitFor(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (!condition() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(1ms);
  ASSERT_TRUE(condition());
}

TEST(Worker, QueuedJobsAreAllDoneInOrderEvenAtTheEnd) {
  std::vector<int> done;
  bool ended = false;
  {
    Worker worker([&] { done.push_back(-1); }, [&] { ended = true; });
    for (int i = 0; i < 20; ++i)
      worker.queue([&, i](const std::atomic<bool>& stop) {
        EXPECT_FALSE(stop);
        std::this_thread::sleep_for(1ms);
        done.push_back(i);
      });
  }
  ASSERT_EQ(done.size(), 21u);
  for (int i = 0; i < 21; ++i) EXPECT_EQ(done[std::size_t(i)], i - 1);
  EXPECT_TRUE(ended);
}

TEST(Worker, OnlyTheLatestIsDoneAndTheOneThatRunsIsTold) {
  std::atomic<bool> running = false, told = false;
  std::atomic<int> last = 0, count = 0;
  Worker worker;
  worker.latest([&](const std::atomic<bool>& stop) {
    running = true;
    waitFor([&] { return stop.load(); });
    told = true;
  });
  waitFor([&] { return running.load(); });
  for (int i = 1; i <= 50; ++i)
    worker.latest([&, i](const std::atomic<bool>& stop) {
      EXPECT_FALSE(stop);
      last = i;
      ++count;
    });
  waitFor([&] { return worker.idle(); });
  EXPECT_TRUE(told);
  EXPECT_EQ(last, 50);
  EXPECT_LE(count, 50);
  worker.latest([&](const std::atomic<bool>&) { last = 51; });
  waitFor([&] { return last == 51; });
}

std::shared_ptr<const Model> teapot() {
  static const std::shared_ptr<const Model> model =
      loadModel(std::string(GLINT_SOURCE_DIR) + "/models/teapot.glb");
  return model;
}

Image drawn(const Look& look) {
  return ReferenceRenderer(teapot()->scene, *teapot()->images, teapot()->bounds, look, 1).draw();
}

TEST(ReferenceTask, AResizeWhileOneIsDrawnStartsAgain) {
  const Look first = scenes::plainLook(600, 500), second = scenes::plainLook(60, 50);
  std::atomic<int> progressed = 0;
  ReferenceTask task([&] { ++progressed; });
  task.want(teapot(), first);
  waitFor([&] { return task.picture()->rows > 0; });
  const auto abandoned = task.picture();
  task.want(teapot(), second);
  EXPECT_NE(task.picture(), abandoned);
  waitFor([&] { return task.picture()->done(); });
  EXPECT_EQ(task.picture()->linear.values, drawn(second).values);
  EXPECT_LT(abandoned->rows, first.resolution.y);  // cancelled
  const auto kept = task.picture();
  task.want(teapot(), second);
  EXPECT_EQ(task.picture(), kept);  // nothing has changed
  EXPECT_GT(progressed, 0);
}

TEST(ReferenceTask, DrawsTheExactFormsWithoutMultisampling) {
  Look look = scenes::plainLook(48, 40);
  const Image exact = drawn(look);
  look.highlight = Highlight::pow;
  look.material[""].highlight = HighlightForm(Highlight::lyon, 2);
  look.antiAliasing = {AntiAliasing::Mode::msaa, 4};
  ReferenceTask task;
  task.want(teapot(), look);
  waitFor([&] { return task.picture()->done(); });
  EXPECT_EQ(task.picture()->linear.values, exact.values);
  look.cameraIndex = 7;  // the file has none
  task.want(teapot(), look);
  waitFor([&] { return task.picture()->failed.load(); });
  EXPECT_NE(task.picture()->error.find("camera"), std::string::npos);
  task.stop();
  EXPECT_EQ(task.picture(), nullptr);
}

// Two squares, one behind the other, seen along the view without perspective. The nearer one ends
// so close to the right of a column's pixel centres that vertices snapped to 1/256 of a pixel may
// cover them. The visible surface there is the square behind, far from any edge of its own.
std::shared_ptr<const Model> squares(double left) {
  auto model = std::make_shared<Model>();
  model->scene = test::sceneOf(test::quad());
  Mesh& behind = model->scene.meshes[0];
  behind.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  Mesh front = behind;
  const float x = float(left);
  front.positions = {{x, -1, 0.5f}, {1, -1, 0.5f}, {1, 1, 0.5f}, {x, 1, 0.5f}};
  model->scene.meshes.push_back(front);
  model->scene.instances = {{0, glm::dmat4(1)}, {1, glm::dmat4(1)}};
  model->bounds = boundsOf(model->scene);
  model->images = std::make_shared<const DecodedImages>();
  return model;
}

TEST(ReferenceTask, KnowsWhereANearerSurfaceMayReachASample) {
  constexpr int size = 64, column = 20;
  Look look = scenes::plainLook(size, size);
  look.cameraPosition = {0, 0, 5};
  look.cameraFocalPoint = {0, 0, 0};
  look.cameraOrthographic = true;
  const auto any = squares(0);
  const double reach = cameraFor(any->scene, any->bounds, look).halfHeight;
  for (const auto& [edge, marked] : {std::pair{column + 0.5 + 1.0 / 300, true},
                                     {column + 0.5 + 1.0 / 20, false},
                                     {column + 0.5 - 1.0 / 300, true}}) {
    const auto model = squares((edge / size * 2 - 1) * reach);
    ReferenceTask task;
    task.want(model, look);
    waitFor([&] { return task.picture()->done() || task.picture()->failed; });
    ASSERT_TRUE(task.picture()->done()) << task.picture()->error;
    const ReferencePicture& p = *task.picture();
    for (const int row : {10, 25, 50}) {
      const auto at = [&](int x) { return bool(p.edges[std::size_t(size * row + x)]); };
      EXPECT_EQ(at(column), marked) << edge;
      EXPECT_FALSE(at(column - 2));
      EXPECT_FALSE(at(column + 2));
    }
  }
}

// A surface is not left out for being steep or finely tessellated.
TEST(ReferenceTask, LeavesOutFewPixelsOfASmoothSurface) {
  Look look = scenes::plainLook(200, 200, Shading::gouraud);
  ReferenceTask task;
  const std::shared_ptr<const Model> model =
      loadModel(std::string(GLINT_SOURCE_DIR) + "/models/sphere.glb");
  task.want(model, look);
  waitFor([&] { return task.picture()->done(); });
  std::size_t edges = 0;
  for (const std::uint8_t e : task.picture()->edges) edges += e;
  // 5040 triangles, half of them visible, on a disc of radius 90: each has about 10 pixels and 17
  // of outline, of which 1/128 to either side is left out, shared with its neighbours: about 1.3 %.
  EXPECT_LT(edges, std::size_t(0.03 * 3.14159 * 90 * 90));
}

TEST(ReferenceTask, KnowsWhereAnotherRasteriserMayShowSomethingElse) {
  const Look look = scenes::plainLook(64, 48);
  ReferenceTask task;
  task.want(teapot(), look);
  waitFor([&] { return task.picture()->done(); });
  const ReferencePicture& p = *task.picture();
  std::size_t edges = 0;
  for (const std::uint8_t e : p.edges) edges += e;
  EXPECT_GT(edges, 40u);  // at the outline
  EXPECT_LT(edges, 64u * 48 / 4);
  EXPECT_FALSE(p.edges[0]);             // background far from the model
  EXPECT_FALSE(p.edges[64 * 27 + 30]);  // the middle of the body
}

Image picture(std::vector<float> red) {
  Image image{int(red.size()), 1, {}};
  for (const float r : red) image.values.insert(image.values.end(), {r, 0.25f, 0.25f, 1.0f});
  return image;
}

TEST(ErrorNumbers, AreThoseOfTheColours) {
  const Image a = picture({0.5f, 0.25f, 1.0f}), b = picture({0.5f, 0.5f, 0.875f});
  const ErrorNumbers n = errorNumbers(a, b, {}, 1, 0);
  EXPECT_EQ(n.largest, 0.25);
  EXPECT_EQ(n.where, glm::ivec2(1, 0));
  EXPECT_DOUBLE_EQ(n.rmse, std::sqrt((0.0625 + 0.015625) / 9));
  EXPECT_EQ(n.levels, 188 - 137);  // sRGB codes of 1/2 and 1/4
  EXPECT_EQ(errorNumbers(a, b, {}, 0, 0).largest, 0);
}

TEST(ErrorNumbers, LeaveOutEdgesAndWhatIsNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Image a = picture({0.5f, 0.25f, nan}), b = picture({0.5f, 0.5f, 0.875f});
  const ErrorNumbers n = errorNumbers(a, b, {0, 1, 0}, 1, 0);
  EXPECT_EQ(n.largest, 0);
  EXPECT_EQ(n.edges, 1u);
  EXPECT_EQ(n.notFinite, 1u);
  const auto map = errorMap(a, b, 1);
  EXPECT_EQ(map[9], 255);  // green: not finite
  EXPECT_GT(map[4], map[0]);
}

TEST(ErrorMap, IsLogarithmic) {
  EXPECT_EQ(errorShade(0), 0);
  EXPECT_EQ(errorShade(1e-9), 0);
  EXPECT_NEAR(errorShade(1e-4), 0.5, 1e-12);
  EXPECT_EQ(errorShade(1), 1);
  EXPECT_EQ(errorShade(40), 1);
}

TEST(Pace, FindsTheSizeThatIsFastEnough) {
  Pace pace;
  const Look look = scenes::plainLook(1000, 800);
  EXPECT_FALSE(pace.tooSlow());
  pace.drewWhole(400, true);
  EXPECT_TRUE(pace.tooSlow());
  // Pictures that take 160 ms per million pixels, plus 2 ms.
  double last = 0;
  for (int i = 0; i < 20; ++i) {
    const glm::dvec2 size(pace.faster(look).resolution);
    pace.drewFaster(last = 2 + 160e-6 * size.x * size.y);
  }
  EXPECT_LT(last, slowFrame);
  EXPECT_EQ(pace.division(), 3);
  pace.drewWhole(20, false);
  EXPECT_FALSE(pace.tooSlow());
}

TEST(Pace, DoesNotMakeSmallerWhatThatDoesNotMakeFaster) {
  Pace pace;
  pace.drewWhole(400, false);
  for (int i = 0; i < 20; ++i) pace.drewFaster(300);  // limited by vertices
  EXPECT_EQ(pace.division(), 1);
}

TEST(Pace, IsNotMisledByOnePictureThatWasHeldUp) {
  Pace pace;
  pace.drewWhole(400, false);
  pace.drewFaster(200);
  EXPECT_EQ(pace.division(), 2);
  pace.drewFaster(220);  // 50 without another process
  pace.drewFaster(50);
  EXPECT_EQ(pace.division(), 3);
  pace.drewFaster(24);
  EXPECT_EQ(pace.division(), 3);
}

TEST(Pace, GrowsAgainWhereMostOfTheTimeIsNotThePixels) {
  Pace pace;
  const Look look = scenes::plainLook(1000, 800);
  pace.drewWhole(2000, false);
  EXPECT_NEAR(pace.rest(), 0.6, 1e-12);
  const auto drag = [&](double each, double pixel) {
    for (int i = 0; i < 20; ++i) {
      const glm::dvec2 size(pace.faster(look).resolution);
      pace.drewFaster(each + pixel * size.x * size.y);
    }
  };
  drag(20, 400e-6);
  EXPECT_GT(pace.division(), 3);
  pace.learnAnew();  // the coarse scene is ready
  drag(16, 12e-6);
  EXPECT_EQ(pace.division(), 1);
  drag(16, 40e-6);  // one division less is too slow: tried once, not repeatedly
  const int found = pace.division();
  EXPECT_GT(found, 1);
  for (int i = 0; i < 10; ++i) {
    pace.drewFaster(0.69 * slowFrame);
    EXPECT_EQ(pace.division(), found);
  }
  pace.drewWhole(20, false);
  EXPECT_EQ(pace.rest(), restAfter);
}

}  // namespace viewer_background_test
}  // namespace glint::viewer
