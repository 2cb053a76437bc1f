#include "core/grow/wood.h"

#include <algorithm>

#include "core/geometry/collar.h"
#include "core/geometry/wrap.h"
#include "core/grow/names.h"
#include "core/individual/proportion.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

/// How far the wood goes on above and below a bracket, and how far behind its bark it is split, in
/// radii of the wood. A bracket reaches no farther round it.
constexpr double beyond_bracket = 0.4, beyond_growing = 1.0, split_behind = 0.75;

}  // namespace

std::optional<WoodPiece> wood_behind(const Individual& individual) {
    if (individual.effective.substrate.value_or(Substrate::none) == Substrate::none)
        return std::nullopt;
    const Outline& outline = individual.outline;
    Extent extent{individual.stem_base, individual.stem_base};
    for (const SubCurve* curve : {&outline.stem, &outline.hymenium, &outline.cap})
        extent.include(*curve);
    auto [low, high] = BracketBase(individual).range(extent.low, extent.high);
    low -= collar_size(individual);
    high += collar_size(individual);
    std::uint32_t names = 0;
    for (const SpeciesShare& part : individual.parts) names ^= stream_of(part.id);
    // The bracket of a clip grows taller than it is at the requested age.
    const bool grows = individual.effective.animation == Animation::growth;
    const double beyond = (grows ? beyond_growing : beyond_bracket) * individual.trunk_radius;
    return WoodPiece{.radius = individual.trunk_radius,
                     .bottom = low - beyond,
                     .top = high + beyond,
                     .seed = Random(individual.shape_seed, purposes::wood, names).bits(),
                     .split = split_behind * individual.trunk_radius,
                     .kind = *individual.effective.substrate,
                     .contact_bottom = low,
                     .contact_top = high,
                     .contact_half = extent.radius * individual.azimuth.width};
}

int wood_lod(DetailLevel level) { return std::min(level.nearest(), last_lod); }

MeshCount wood_count(const Individual& individual, DetailLevel level) {
    const std::optional<WoodPiece> piece = wood_behind(individual);
    return piece ? wood_count(*piece, wood_lod(level)) : MeshCount{};
}

std::optional<WoodPaint> wood_paint(const MushroomSpec& spec, const Individual& individual,
                                    DetailLevel first) {
    const Substrate substrate = individual.effective.substrate.value_or(Substrate::none);
    if (substrate == Substrate::none) return std::nullopt;
    return WoodPaint{substrate, wood_side(spec.params.texture_size, first.nearest())};
}

ImageSide wood_side(TextureSize texture_size, int lod) {
    return {std::max(texture_size.value >> (lod + 1), 16)};
}

std::uint64_t texels_of(const WoodPaint& paint) {
    const auto side = static_cast<std::uint64_t>(paint.texture_size.value);
    return 3 * side * side;
}

std::string image_key(const WoodPaint& paint, ImageFormat format) {
    return key_of_format(format) + "wood " + name(paint.substrate) + ' ' +
           std::to_string(paint.texture_size.value);
}

std::shared_ptr<const ImageSet> painted_images(const WoodPaint& paint,
                                               const ExecutionContext& execution,
                                               ImageFormat format) {
    return execution.caches.images(image_key(paint, format), [&] {
        const RawImages images = wood_images(paint, execution.parallel);
        throw_if_cancelled(execution);
        return std::make_shared<const ImageSet>(encoded(images, format, execution.parallel));
    });
}

EmbeddedImages add_wood_material(GlbScene& scene, const WoodPaint& paint, Textures textures,
                                 const FileOptions& file, const Extras& extras,
                                 const ExecutionContext& execution) {
    scene.materials.push_back({.name = wood_name(paint, textures), .repeats_u = true});
    return attach_images(
        scene.materials.back(), textures, file, extras.wood_urls, execution,
        [&](ImageFormat format) { return painted_images(paint, execution, format); });
}

}  // namespace sporeprint
