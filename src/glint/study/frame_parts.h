#pragma once

#include <string>
#include <vector>

#include "glint/study/frame_times.h"
#include "glint/study/scene.h"
#include "glint/study/statistics.h"

namespace glint {

/// What a frame of a model in the exact form takes its time for.
struct FramePart {
  std::string name;
  TimeRatio share;  ///< of the frame's time, with its 95 % interval
};

/// Measures by pictures that leave something out: a target that is cleared only ("the target");
/// the scene in a picture of a few pixels ("vertices"); in one colour ("filling", what that takes
/// above both); without textures ("textures"); without highlights ("highlights"). What is left of
/// the exact frame is "other light". Parts that the scene lacks are not there; none of them is
/// below 0. Empty if it was stopped. On a GPU parts run at the same time, and their shares are what
/// a frame would gain without them.
std::vector<FramePart> frameParts(const StudyScene& scene, GpuScene& gpu, const Look& look,
                                  Shading model, FrameClock clock, const Timing& timing);

}  // namespace glint
