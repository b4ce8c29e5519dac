#pragma once

#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "glint/scene/camera.h"
#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint::viewer {

/// Whether the lights of the look are those of the scene's file.
bool lightsAreTheFiles(const Scene*, const Look&);

/// The lights that a look has: its own, the file's, or the default one. The scene may be null.
std::vector<Light> shownLights(const Scene*, const Look&);

/// Puts lights in place of those shown. Where they were the file's they become the look's own, as
/// they are, fall-off and all. A light that is too bright for an option (I_m above 1e6 at one world
/// unit) gets the intensity that it has at the model's centre and falls off no more. Returns a line
/// that says what became of them; empty where nothing but the edit has changed.
std::string setLights(Look&, const Scene*, const Bounds&, std::vector<Light> lights);

/// Another type of light at about the same place, so that a change of type keeps what it can.
/// `axes` are the camera's in world space.
void changeType(Light&, Light::Type, const Bounds&, const glm::dmat3& axes);

/// Makes a point or spot fall off with distance, or not: its light at the model's centre stays.
void setFallOff(Light&, bool, const Bounds&);

/// Lights that are switched off have the intensity 0 in the look; what they had, by their places.
using SwitchedOff = std::map<std::size_t, glm::dvec3>;

/// Switches a light off, or on again: with intensity 1 where what it had is not known.
void switchLight(std::vector<Light>&, std::size_t light, SwitchedOff&);

/// Leaves a light alone on, or, if it is, switches all that were off on again.
void soloLight(std::vector<Light>&, std::size_t light, SwitchedOff&);

/// One light more, mirrored from this one.
Light anotherLight(const Light&, const Bounds&, const glm::dmat3& axes);

}  // namespace glint::viewer
