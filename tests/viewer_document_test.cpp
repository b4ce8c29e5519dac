#include <gtest/gtest.h>

#include "viewer/document.h"
#include "viewer/input.h"

namespace glint::viewer {
namespace viewer_document_test {

Document withExponent(Document d, double value) {
  d.a.material["paint"].exponent = value;
  return d;
}

TEST(History, ADragIsOneStep) {
  Document now;
  History history(now);
  for (int i = 1; i <= 20; ++i) {
    now = withExponent(now, i);
    history.settle(now, true);
  }
  history.settle(now, false);
  EXPECT_EQ(history.undoSteps(), 1u);
  ASSERT_TRUE(history.undo(now));
  EXPECT_EQ(now, Document());
  ASSERT_TRUE(history.redo(now));
  EXPECT_EQ(now, withExponent({}, 20));
}

TEST(History, UndoTakesBackAnEditThatIsNotSettled) {
  Document now;
  History history(now);
  now = withExponent(now, 7);
  ASSERT_TRUE(history.undo(now));
  EXPECT_EQ(now, Document());
  EXPECT_FALSE(history.undo(now));
}

TEST(History, AnEditAfterUndoDropsWhatWasUndone) {
  Document now;
  History history(now);
  history.settle(now = withExponent(now, 1), false);
  history.settle(now = withExponent(now, 2), false);
  history.undo(now);
  history.settle(now = withExponent(now, 3), false);
  EXPECT_FALSE(history.redo(now));
  EXPECT_EQ(now, withExponent({}, 3));
  history.undo(now);
  EXPECT_EQ(now, withExponent({}, 1));
}

TEST(History, EachEditWhileAnAnimationPlaysIsAStepAndTimeIsNone) {
  Document now;
  History history(now);
  double time = 0;
  const auto frames = [&](int count) {
    for (int i = 0; i < count; ++i) {
      now.a.animationTime = time += 0.01;
      history.settle(now, false, true);
    }
  };
  frames(10);
  EXPECT_EQ(history.undoSteps(), 0u);
  for (int edit = 1; edit <= 3; ++edit) {
    now = withExponent(now, edit);
    frames(10);
    EXPECT_EQ(history.undoSteps(), std::size_t(edit));
  }
  // Playing continues while edits are undone.
  ASSERT_TRUE(history.undo(now, true));
  EXPECT_EQ(now.a.material["paint"].exponent, 2);
  EXPECT_EQ(now.a.animationTime, time);
  frames(3);
  ASSERT_TRUE(history.redo(now, true));
  EXPECT_EQ(now.a.material["paint"].exponent, 3);
  EXPECT_EQ(now.a.animationTime, time);
  // When it stops, the playing becomes one step.
  history.settle(now, false);
  EXPECT_EQ(history.undoSteps(), 4u);
  ASSERT_TRUE(history.undo(now));
  EXPECT_EQ(now.a.animationTime, std::nullopt);
  EXPECT_EQ(now.a.material["paint"].exponent, 3);
}

TEST(History, HasNoLimit) {
  Document now;
  History history(now);
  for (int i = 1; i <= 3000; ++i) history.settle(now = withExponent(now, i), false);
  for (int i = 0; i < 3000; ++i) ASSERT_TRUE(history.undo(now)) << i;
  EXPECT_EQ(now, Document());
  EXPECT_EQ(history.undoSteps(), 0u);
}

TEST(History, KeepsAllOfTheDocument) {
  Document now;
  History history(now);
  now.b = now.a;
  now.b->shading = Shading::gouraud;
  now.compare = CompareMode::difference;
  now.amplification = 64;
  now.a.cameraPosition = {1, 2, 3};
  const Document edited = now;
  history.settle(now, false);
  history.undo(now);
  EXPECT_EQ(now, Document());
  history.redo(now);
  EXPECT_EQ(now, edited);
}

TEST(Document, CameraAndSizeAreNoEdits) {
  Look look, moved;
  moved.cameraPosition = {1, 2, 3};
  moved.cameraOrthographic = true;
  moved.resolution = {10, 10};
  EXPECT_EQ(withoutCamera(look), withoutCamera(moved));
  moved.exposure = 1;
  EXPECT_NE(withoutCamera(look), withoutCamera(moved));
}

InputEvent event(InputEvent::Kind kind, int code = 0, bool down = false) {
  InputEvent e;
  e.kind = kind;
  e.code = code;
  e.down = down;
  return e;
}

TEST(InputQueue, PressAndReleaseComeInFramesOfTheirOwn) {
  InputQueue queue;
  queue.add(event(InputEvent::Kind::motion));
  queue.add(event(InputEvent::Kind::motion));
  for (int i = 0; i < 3; ++i) {
    queue.add(event(InputEvent::Kind::button, 0, true));
    queue.add(event(InputEvent::Kind::button, 0, false));
  }
  std::vector<std::size_t> sizes;
  int presses = 0;
  while (!queue.empty()) {
    const auto frame = queue.take();
    sizes.push_back(frame.size());
    for (const InputEvent& e : frame) presses += e.kind == InputEvent::Kind::button && e.down;
    ASSERT_EQ(frame.size(), 1u);
  }
  EXPECT_EQ(sizes.size(), 7u);  // the two motions become one
  EXPECT_EQ(presses, 3);
}

TEST(InputQueue, NothingIsLostOrReordered) {
  InputQueue queue;
  const char typed[] = "abc";
  for (const char c : {typed[0], typed[1], typed[2]}) {
    queue.add(event(InputEvent::Kind::key, c, true));
    queue.add(event(InputEvent::Kind::character, c));
    queue.add(event(InputEvent::Kind::key, c, false));
  }
  std::string got;
  int keys = 0;
  while (!queue.empty())
    for (const InputEvent& e : queue.take()) {
      if (e.kind == InputEvent::Kind::character) got += char(e.code);
      keys += e.kind == InputEvent::Kind::key;
    }
  EXPECT_EQ(got, "abc");
  EXPECT_EQ(keys, 6);
}

}  // namespace viewer_document_test
}  // namespace glint::viewer
