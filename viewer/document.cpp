#include "document.h"

#include <utility>

namespace glint::viewer {

bool comparesLooks(const Document& d) {
  return d.compare != CompareMode::off && !d.exact && d.b.has_value();
}

bool comparesExact(const Document& d) { return d.compare != CompareMode::off && d.exact; }

void History::settle(const Document& now, bool gesture) {
  if (gesture || now == settled_) return;
  undo_.push_back(std::exchange(settled_, now));
  redo_.clear();
}

bool History::undo(Document& now) {
  settle(now, false);
  if (undo_.empty()) return false;
  redo_.push_back(std::move(settled_));
  settled_ = std::move(undo_.back());
  undo_.pop_back();
  now = settled_;
  return true;
}

bool History::redo(Document& now) {
  settle(now, false);
  if (redo_.empty()) return false;
  undo_.push_back(std::move(settled_));
  settled_ = std::move(redo_.back());
  redo_.pop_back();
  now = settled_;
  return true;
}

Look withoutCamera(const Look& look) {
  Look rest = look;
  const Look none;
  rest.cameraPosition = none.cameraPosition;
  rest.cameraFocalPoint = none.cameraFocalPoint;
  rest.cameraDirection = none.cameraDirection;
  rest.cameraViewUp = none.cameraViewUp;
  rest.cameraViewAngle = none.cameraViewAngle;
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
