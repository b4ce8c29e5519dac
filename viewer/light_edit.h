#pragma once

#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "glint/scene/camera.h"
#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint::viewer {

/// Whether the lights of the look come from the scene's file.
bool lightsAreTheFiles(const Scene*, const Look&);

/// The lights that a look has: its own, the file's, or the default one. The scene may be null.
std::vector<Light> shownLights(const Scene*, const Look&);

/// Replaces the lights shown. Lights from the file are first copied into the look unchanged,
/// including their fall-off. A light too bright for an option (I_m above 1e6 at one world unit)
/// gets the intensity that it has at the model's centre and no fall-off. Returns a line that
/// reports such changes; empty if only the edit was made.
std::string setLights(Look&, const Scene*, const Bounds&, std::vector<Light> lights);

/// Changes the type of a light and keeps its position and other properties as far as possible.
/// `axes` are the camera's in world space.
void changeType(Light&, Light::Type, const Bounds&, const glm::dmat3& axes);

/// Switches a point or spot light's fall-off with distance; its intensity at the model's centre
/// stays.
void setFallOff(Light&, bool, const Bounds&);

/// The former intensities of lights that are switched off (intensity 0 in the look), by their
/// indices.
using SwitchedOff = std::map<std::size_t, glm::dvec3>;

/// Switches a light off, or on again: with intensity 1 if the former one is not known.
void switchLight(std::vector<Light>&, std::size_t light, SwitchedOff&);

/// Leaves only this light on; if it already is, switches all others on again.
void soloLight(std::vector<Light>&, std::size_t light, SwitchedOff&);

/// Another light, mirrored from this one.
Light anotherLight(const Light&, const Bounds&, const glm::dmat3& axes);

}  // namespace glint::viewer
