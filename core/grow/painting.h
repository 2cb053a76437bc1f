// Painting of a mushroom: the data that the images of a spec depend on, and the images, blended
// from those of its species.
#pragma once

#include <string>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/execution_context.h"
#include "core/individual/mushroom_spec.h"
#include "core/individual/resolve.h"

namespace sporeprint {

/// Returns the quantised lengths of an individual that its painting depends on. For a branched
/// individual the lengths of the cap are those of its branches, which use the chart of the cap.
[[nodiscard]] SurfaceMetrics surface_metrics(const Individual& individual);

/// The painting of one species and its weight in sixty-fourths.
struct PaintShare {
    PaintParams painting;
    int sixty_fourths = 64;
    bool operator==(const PaintShare&) const = default;
};

/// Everything that the images of a mushroom depend on: weights sum to 64, none is 0, no two
/// paintings are equal, at most most_paintings. Paintings are sorted, so that the order of the
/// species does not matter.
using PaintSpec = std::vector<PaintShare>;

/// Returns the mix at the resolution of images: weights in sixty-fourths by largest remainder (ties
/// by position), written as the nearest thousandths that sum to 1000; a species that rounds to 0 is
/// dropped. surface_mix(surface_mix(x)) = surface_mix(x).
///
/// mix  positive weights that sum to 1000, or nothing
[[nodiscard]] Mix surface_mix(const Mix& mix);

/// Returns the spec at the resolution of images: age in steps of 1/64, size in steps of 2 %,
/// surface_mix(), without parameters that affect the shape only. If species are dropped from the
/// mix, overrides that none of the others can have are dropped too. For a user-defined model only
/// age and size are rounded. The images of the result equal those of the original spec.
[[nodiscard]] MushroomSpec surface_spec(const MushroomSpec& spec, const Atlas& atlas,
                                        const Caches& caches = {});

/// Returns everything that painting a spec depends on. Each species is painted as it would be
/// alone: at this age and size, with the requested overrides and its own lengths and lightness, so
/// that the cache finds its painting at every weight. Its gills, however, are painted in the common
/// gill layout, that of the species with the most gills at the margin. From weight 3/4 to 1 a
/// second painting of the species, in its own layout, replaces the first with increasing weight.
///
/// throws  InvalidInput, Impossible as resolve()
[[nodiscard]] PaintSpec paint_spec_of(const MushroomSpec& spec, const Atlas& atlas,
                                      const Caches& caches = {});

/// Returns the peak number of atlases in memory while the images are painted: the result and, for
/// a mix, the paintings that are blended.
[[nodiscard]] int atlases_held(const MushroomSpec& spec);
[[nodiscard]] int atlases_held(const PaintSpec& paint_spec);

/// Returns the side of the atlas in texels.
[[nodiscard]] int side_of(const PaintSpec& paint_spec);

/// Returns the cache key of the images: equal keys, equal images. For a single species it is the
/// key of its painting.
[[nodiscard]] std::string image_key(const PaintSpec& paint_spec, ImageFormat format);

/// Returns the images before encoding; those of a mix are blended from paintings that may be in the
/// cache.
///
/// throws  as painted_images()
[[nodiscard]] RawImages raw_images(const PaintSpec& paint_spec, const ExecutionContext& execution);

/// Returns the images, cached in execution.caches or painted now. A mix is blended from paintings
/// that may be cached too; uploaded images of several species are rotated to match first.
///
/// throws  InvalidInput if an uploaded image cannot be read; Cancelled
[[nodiscard]] std::shared_ptr<const ImageSet> painted_images(const PaintSpec& paint_spec,
                                                             const ExecutionContext& execution,
                                                             ImageFormat format = ImageFormat::jpg);

}  // namespace sporeprint
