#pragma once

#include <glm/glm.hpp>

#include "actions.h"
#include "session.h"

namespace glint::viewer {

/// Does what the action edits or selects, where it is one that needs nothing but the session, and
/// says so in its status line; false for all others. `axes` are the camera's in world space.
bool edit(Session&, Action, const glm::dmat3& axes = glm::dmat3(1.0));

/// The next text of a choice of the table of parameters; gammas of a form are left out but 8.
void nextChoice(Look&, std::string_view parameter);

/// The preset whose numbers a material has, or -1.
int presetOf(const ShadingParameters&);

/// Seconds of the animation that the look chooses; 0 if the scene has none.
double animationDuration(const Scene&, const Look&);

}  // namespace glint::viewer
