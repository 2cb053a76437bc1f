// Variants of the material of a mushroom in one file: the same mesh after other weather.
#pragma once

#include <string>
#include <vector>

#include "core/gltf/glb.h"
#include "core/individual/individual.h"
#include "core/individual/mushroom_spec.h"

namespace sporeprint {

/// A variant of the material of a mushroom.
struct Variant {
    std::string name;      ///< of the variant in the file
    MushroomSpec painted;  ///< whose images it has; its mesh is that of the requested spec
    MaterialLook look;
    bool has_own_images = true;  ///< false for the images of the requested spec
};

/// Throws Impossible (path "/variants") for variants without images, or of materials without
/// extensions.
void refuse_impossible_variants(const MushroomParams& params);

/// Returns the variants that a spec requests: dry, wet, aged and frosted, or none. They change only
/// what is painted, and how it shines: a wet one is darker and coated, an aged one faded, stained
/// and dusty, a frosted one has a white sheen.
[[nodiscard]] std::vector<Variant> variants_of(const MushroomSpec& spec,
                                               const Individual& individual);

/// Returns the number of image sets of a file with these parameters: 1, or with variants 4.
[[nodiscard]] int image_sets(const MushroomParams& params);

}  // namespace sporeprint
