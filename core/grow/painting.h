// The paint of a mushroom: what an order's images depend on, and the images, dissolved from those of its species.
#pragma once

#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/execution_context.h"
#include "core/individual/mushroom_spec.h"
#include "core/individual/resolve.h"

namespace sporeprint {

/// The quantised lengths of an individual that its painting depends on.
[[nodiscard]] SurfaceMetrics surface_metrics(const Individual& individual);

/// One species' painting in a recipe, and its weight in sixty-fourths.
struct PaintShare {
    PaintParams painting;
    int sixty_fourths = 64;
    bool operator==(const PaintShare&) const = default;
};

/// Everything that the images of a mushroom depend on: weights sum to 64, none is 0, no two paintings are equal, at most
/// most_paintings. They stand in an order of their own, so that of the species does not matter.
using PaintRecipe = std::vector<PaintShare>;

/// The mix as images know it: weights in sixty-fourths by largest remainder (ties by place), written as the nearest thousandths
/// that sum to 1000; a species that rounds to 0 is dropped. surface_mix(surface_mix(x)) = surface_mix(x).
///
/// mix  positive weights that sum to 1000, or nothing
[[nodiscard]] Mix surface_mix(const Mix& mix);

/// The order as images know it: age in steps of 1/64, size in steps of 2 %, surface_mix, nothing that shapes; overrides that no
/// species of that mix can have are dropped. Its images are those of the order. A model of one's own stays as it is.
[[nodiscard]] MushroomOrder surface_order(const MushroomOrder& order, const Atlas& atlas,
                                          const Memo& memo = {});

/// What painting an order depends on. Each species is painted as it would be alone: at this age and size, with the person's
/// overrides, its own lengths and lightness, so that its painting is found again at every weight. Only its blades stand on one
/// comb with those of the others, that of the species with the most at the margin; towards its corner they go over to where they
/// stand when it is alone, as a second painting.
///
/// throws  InvalidInput, Impossible as resolve()
[[nodiscard]] PaintRecipe paint_recipe(const MushroomOrder& order, const Atlas& atlas,
                                       const Memo& memo = {});

/// Atlases that are in memory at once while the images of an order are made, at most: the result, and what a mix is dissolved from.
[[nodiscard]] int atlases_held(const MushroomOrder& order);
[[nodiscard]] int atlases_held(const PaintRecipe& recipe);

/// Side of the atlas that a recipe paints.
[[nodiscard]] int side_of(const PaintRecipe& recipe);

/// Key of a recipe's images: equal keys, equal images. A lone species' is that of its painting.
[[nodiscard]] std::string image_key(const PaintRecipe& recipe);

/// The images of a recipe, as the workshop's Memo remembers them or painted now. A mix is dissolved from paintings that the Memo
/// may remember too; given images of several species are turned onto each other first.
///
/// throws  InvalidInput if a given image cannot be read; Cancelled
[[nodiscard]] std::shared_ptr<const ImageSet> painted_images(const PaintRecipe& recipe,
                                                             const Workshop& workshop);

}  // namespace sporeprint
