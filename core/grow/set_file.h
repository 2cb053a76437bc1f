// A set of mushrooms in one GLB file: individuals at several levels of detail, with shared images.
#pragma once

#include "core/atlas/atlas.h"
#include "core/grow/execution_context.h"
#include "core/grow/product.h"
#include "core/grow/set.h"

namespace sporeprint {

/// Throws Impossible for options that a file of several individuals cannot have: (path
/// "/animation") a clip, (path "/variants") variants, (path "/lods") several levels that are
/// neither named nor linked, and as refuse_impossible() and refuse_impossible_atlas().
void refuse_in_one_file(const SetSpec& spec);

/// Builds one file of all individuals of a set, side by side on a grid. Each has a node for each
/// level of detail, named as the mesh is; with lods=msft only the first ones are in the scene.
/// Individuals with the same images have one material, and with an atlas all of their species or of
/// the set, see set_materials.h; all levels have the images of the first.
/// asset.extras lists the individuals: name, species, seed, age, how often the scene shows them,
/// bounding box about their own origin, and levels with nodes, counts and coverages; with an atlas
/// also their material and tile, beside a list of atlases with material and grid. Weights of wind
/// are relative to the largest displacement of all.
///
/// spec    levels are ascending
/// plan    planned_set() of the spec
/// links   if has_addresses(textures)
/// throws  as refuse_in_one_file() and grow_mushroom()
[[nodiscard]] Grown grow_set(const SetSpec& spec, const SetPlan& plan, const Atlas& atlas,
                             const ImageLinks& links = {}, const ExecutionContext& execution = {});

}  // namespace sporeprint
