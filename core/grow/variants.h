// Variants of the material of a mushroom or a colony in one file: the same mesh in other weather.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/gltf/glb.h"
#include "core/grow/painting.h"
#include "core/grow/product.h"
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
void refuse_impossible_variants(Variants variants, Textures textures, const FileOptions& file);

/// Returns the variants that a spec requests: dry, wet, aged and frosted, or none. They change only
/// what is painted, and how it shines: a wet one is darker and coated, an aged one faded, stained
/// and dusty, a frosted one has a white sheen.
[[nodiscard]] std::vector<Variant> variants_of(const MushroomSpec& spec,
                                               const Individual& individual);

/// Returns the number of image sets of a file: 1, or with variants 4.
[[nodiscard]] int image_sets(Variants variants);

/// Adds the variants of the only material of a scene: a material for each, which follow it.
///
/// extras         with variant_urls if has_addresses(textures)
/// paint_spec_of  what painting the spec of a variant depends on
/// returns        their images, which must outlive the scene
/// throws         as attach_images()
[[nodiscard]] std::vector<EmbeddedImages> add_variants(
    GlbScene& scene, const std::vector<Variant>& variants, Textures textures,
    const FileOptions& file, const Extras& extras, const ExecutionContext& execution,
    const std::function<PaintSpec(const MushroomSpec&)>& paint_spec_of);

/// Returns the materials of add_variants(), for each primitive.
[[nodiscard]] std::vector<std::size_t> variant_materials(const GlbScene& scene);

}  // namespace sporeprint
