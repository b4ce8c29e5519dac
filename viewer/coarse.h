#pragma once

#include <atomic>
#include <cstddef>
#include <optional>

#include "glint/scene/camera.h"
#include "glint/scene/look.h"
#include "glint/scene/scene.h"

namespace glint::viewer {

/// What is drawn in place of a heavy scene while a hand moves something; nothing else reads it.

/// Scenes that draw more triangles than this have a coarse one: two software threads draw them at
/// less than ten pictures a second.
inline constexpr std::size_t heavyTriangles = 500'000;
/// About as many triangles as a coarse scene draws.
inline constexpr std::size_t coarseTriangles = 100'000;
/// Lights that a picture has while something moves.
inline constexpr std::size_t coarseLights = 8;

/// Triangles, lines and points that all instances of a scene draw together.
std::size_t primitivesDrawn(const Scene&);

/// The scene with at most about `triangles` drawn, each mesh with its share of them, simplified by
/// meshoptimizer. Places of materials, meshes and instances are the scene's; pictures have no
/// bytes. Nothing if `stop` becomes true between two meshes, or this build has no meshoptimizer.
std::optional<Scene> coarseScene(const Scene&, std::size_t triangles,
                                 const std::atomic<bool>& stop);

/// The look with at most `most` lights, which are those of the scene's file where they count: the
/// ones that bring the most light to the middle of the scene from ways that differ, each with the
/// light added of those that shine from nearest to its way. What arrives there in all is the same.
Look withFewerLights(const Scene&, const Bounds&, const Look&, std::size_t most = coarseLights);

}  // namespace glint::viewer
