#pragma once

#include <glm/glm.hpp>

#include "actions.h"
#include "session.h"

namespace glint::viewer {

/// Performs an action that needs nothing but the session and reports it in the status line; false
/// for all others. `axes` are the camera's in world space.
bool edit(Session&, Action, const glm::dmat3& axes = glm::dmat3(1.0));

/// Steps to the next value of a choice in the parameter table; of the gammas of a form only 8 is
/// used.
void nextChoice(Look&, std::string_view parameter);

/// The preset that matches a material's parameters, or -1.
int presetOf(const ShadingParameters&);

/// The duration of the animation that the look chooses, in seconds; 0 if the scene has none.
double animationDuration(const Scene&, const Look&);

}  // namespace glint::viewer
