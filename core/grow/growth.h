// Growth as an animation clip: the same mushroom at several ages, as morph targets of the requested
// age.
#pragma once

#include <vector>

#include "core/atlas/atlas.h"
#include "core/gltf/glb.h"
#include "core/grow/execution_context.h"
#include "core/individual/individual.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// Duration of a clip, seconds.
inline constexpr double growth_seconds = 8.0;

struct GrowthClip {
    std::vector<MorphTarget> targets;  ///< one per frame, youngest first
    WeightClip clip;                   ///< one key per frame: weight 1 for that frame alone
};

/// Returns the ages of a clip's frames: evenly spaced, 0 and 1 included.
///
/// frames   at least 2
[[nodiscard]] std::vector<double> frame_ages(int frames);

/// Returns the frames of a clip as differences from the mesh of its spec. Between two frames a
/// viewer shows their weighted mean; without playback it shows the mesh itself. Key k is at k /
/// (frames - 1) * growth_seconds.
///
/// spec        with animation growth
/// individual  resolve() of the spec; a bracket grows on its wood at all ages
/// mesh        mushroom_mesh() of the spec
/// throws      Impossible if the spec cannot be grown at one of the ages, which the message names;
///             Cancelled
/// cost        that of one mesh per frame
[[nodiscard]] GrowthClip growth_clip(const MushroomSpec& spec, const Individual& individual,
                                     const Atlas& atlas, const Mesh& mesh,
                                     const ExecutionContext& execution);

}  // namespace sporeprint
