#pragma once

#include <string>
#include <vector>

#include "glint/study/frame_times.h"
#include "glint/study/scene.h"
#include "glint/study/statistics.h"

namespace glint {

/// A part of the time of a model's frame in the exact form.
struct FramePart {
  std::string name;
  TimeRatio share;  ///< of the frame's time, with its 95 % interval
};

/// Lists that shade nothing: without what is drawn, and with the same surface in one colour.
DrawList emptied(DrawList list);
DrawList inOneColor(DrawList list);

/// Measures with pictures that leave something out: only a cleared target ("the target"); the scene
/// in a picture of a few pixels ("vertices"); in one colour ("filling", the time above both);
/// without textures ("textures"); without highlights ("highlights"). The rest of the exact frame is
/// "other light". Parts that the scene lacks are left out; none of them is below 0. Empty if it was
/// stopped. On a GPU parts run at the same time, and a share is what a frame would gain without
/// that part.
std::vector<FramePart> frameParts(const StudyScene& scene, GpuScene& gpu, const Look& look,
                                  Shading model, FrameClock clock, const Timing& timing);

}  // namespace glint
