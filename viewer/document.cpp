#include "document.h"

#include <utility>

namespace glint::viewer {

bool comparesLooks(const Document& d) {
  return d.compare != CompareMode::off && !d.exact && d.b.has_value();
}

bool comparesExact(const Document& d) { return d.compare != CompareMode::off && d.exact; }

void History::settle(const Document& now, bool gesture, bool playing) {
  if (gesture) return;
  Document next = now;
  if (playing) next.a.animationTime = settled_.a.animationTime;
  if (next == settled_) return;
  undo_.push_back(std::exchange(settled_, std::move(next)));
  redo_.clear();
}

bool History::step(Document& now, bool playing, std::vector<Document>& from,
                   std::vector<Document>& to) {
  if (from.empty()) return false;
  to.push_back(std::move(settled_));
  settled_ = std::move(from.back());
  from.pop_back();
  const auto time = now.a.animationTime;
  now = settled_;
  if (playing) now.a.animationTime = time;
  return true;
}

bool History::undo(Document& now, bool playing) {
  settle(now, false, playing);
  return step(now, playing, undo_, redo_);
}

bool History::redo(Document& now, bool playing) {
  settle(now, false, playing);
  return step(now, playing, redo_, undo_);
}

Look withoutCamera(const Look& look) {
  Look rest = look;
  const Look none;
  rest.cameraPosition = none.cameraPosition;
  rest.cameraFocalPoint = none.cameraFocalPoint;
  rest.cameraDirection = none.cameraDirection;
  rest.cameraViewUp = none.cameraViewUp;
  rest.cameraViewAngle = none.cameraViewAngle;
  rest.cameraIntrinsics = none.cameraIntrinsics;
  rest.cameraAzimuthAngle = none.cameraAzimuthAngle;
  rest.cameraElevationAngle = none.cameraElevationAngle;
  rest.cameraZoomFactor = none.cameraZoomFactor;
  rest.cameraOrthographic = none.cameraOrthographic;
  rest.cameraIndex = none.cameraIndex;
  rest.clippingRange = none.clippingRange;
  rest.resolution = none.resolution;
  return rest;
}

}  // namespace glint::viewer
