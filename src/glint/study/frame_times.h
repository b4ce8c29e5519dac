#pragma once

#include <functional>
#include <span>
#include <vector>

#include "glint/render/renderer.h"

namespace glint {

/// Milliseconds of the frames of one picture, one a round.
struct FrameTimes {
  std::vector<double> wall;   ///< from the first GL call until glFinish returns
  std::vector<double> query;  ///< GL_TIME_ELAPSED of the same frames; empty if GL has no such clock
};

/// Asked between frames: true ends the work early.
using Stop = std::function<bool()>;

/// Draws pictures in turn, A B C A B C, each round in another (repeatable) order, so that what
/// slows the machine down for a while hits all alike. The first `warmUp` rounds are not kept: in
/// them a software driver compiles and memory is touched for the first time. Ends early, with whole
/// rounds, where `stop` says so. `done` is told after each round. All pictures are of one renderer
/// and of one size.
std::vector<FrameTimes> timeInTurn(std::span<Renderer::Picture* const> pictures, int warmUp,
                                   int rounds, const Stop& stop,
                                   const std::function<void(int round)>& done = {});

/// Draws once and tells the wall time in ms.
double timeOnce(Renderer::Picture& picture);

}  // namespace glint
