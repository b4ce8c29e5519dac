#pragma once

#include <atomic>
#include <cstddef>
#include <optional>

#include "glint/scene/camera.h"
#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint::viewer {

/// Substitutes for a heavy scene, drawn only while something moves.

/// Scenes that draw more triangles than this get a coarse version: two software threads draw them
/// at less than ten pictures a second.
inline constexpr std::size_t heavyTriangles = 500'000;
/// The approximate number of triangles in a coarse scene.
inline constexpr std::size_t coarseTriangles = 100'000;
/// The number of lights while something moves.
inline constexpr std::size_t coarseLights = 8;

/// Triangles, lines and points drawn by all instances of a scene together.
std::size_t primitivesDrawn(const Scene&);

/// The scene reduced to about `triangles` drawn, divided among the meshes in proportion and
/// simplified by meshoptimizer. Indices of materials, meshes and instances are unchanged; images
/// have no bytes. Empty if `stop` becomes true between two meshes, or this build has no
/// meshoptimizer.
std::optional<Scene> coarseScene(const Scene&, std::size_t triangles,
                                 const std::atomic<bool>& stop);

/// The look with at most `most` lights, from the look or else from the scene's file: those that
/// bring the most light to the middle of the scene from distinct directions. Each takes over the
/// light of the omitted ones nearest in direction, so that the total arriving there is unchanged.
Look withFewerLights(const Scene&, const Bounds&, const Look&, std::size_t most = coarseLights);

}  // namespace glint::viewer
