// Impostors of products: the last level of detail, cards with pictures of what a product looks like
// from all sides.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/colony/colony_spec.h"
#include "core/grow/execution_context.h"
#include "core/grow/product.h"
#include "core/individual/mushroom_spec.h"
#include "core/mesh/mesh.h"
#include "core/params/shared_params.h"
#include "core/plant/tree_spec.h"

namespace sporeprint {

/// Returns the side of a frame of an impostor, texels: all of them together are about a third as
/// wide as the images of LOD 0.
[[nodiscard]] int frame_side_of(TextureSize texture_size);

/// Returns the spec of the product that the frames show: that of impostor_source_lod, in a plain file
/// of its own, with images that have about two texels for each of a frame.
[[nodiscard]] MushroomSpec impostor_source(const MushroomSpec& spec);
[[nodiscard]] ColonySpec impostor_source(const ColonySpec& spec);
[[nodiscard]] TreeSpec impostor_source(const TreeSpec& spec);

/// Throws Impossible for an impostor without embedded images (path "/textures") or with variants (path
/// "/variants").
void refuse_impossible_impostor(int lod, const FileOptions& file, Textures textures,
                                Variants variants = Variants::none);

/// An impostor, ready to be added to a scene that it must outlive.
struct Impostor {
    Mesh cards;
    EmbeddedImages images;
    Bounds box;                 ///< of what the frames show
    GlbMaterial material = {};  ///< without a name
};

/// Returns the impostor of a product.
///
/// grow        calls the pipeline of impostor_source() with these extras, whose writer draws
/// frame_side  frame_side_of()
/// throws      what `grow` throws; GenerationError, Cancelled
[[nodiscard]] Impostor impostor_of(const std::function<void(const Extras&)>& grow, int frame_side,
                                   const FileOptions& file, const ExecutionContext& execution);

/// Sets the sway of the cards: as that of a beam from the ground to the top.
///
/// wind  of the product; without sway nothing moves
void add_sway(Impostor& impostor, const Wind& wind);

/// Adds the material to a scene; returns its index.
///
/// name  product_name()
std::size_t add_material(GlbScene& scene, const Impostor& impostor, const std::string& name);

/// Adds the level of an impostor, the last one, with its error.
///
/// box     of the product
/// errors  of the levels so far, as set_coverages() takes them
void add_impostor_level(std::vector<Level>& levels, std::vector<double>& errors, const Bounds& box,
                        TextureSize texture_size);

/// Adds an impostor to the size of a file.
void add_impostor(Estimate& sum, TextureSize texture_size, const FileOptions& file);

}  // namespace sporeprint
