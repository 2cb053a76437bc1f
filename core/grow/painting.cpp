#include "core/grow/painting.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/geometry/branches.h"
#include "core/grow/level_choice.h"
#include "core/grow/mushroom.h"
#include "core/individual/damage.h"
#include "core/math/random.h"
#include "core/mesh/detail.h"
#include "core/params/canonical.h"
#include "core/surface/image_blend.h"
#include "core/surface/uploaded_image.h"

namespace sporeprint {

namespace {

constexpr int whole = 64;

// Returns integer parts of `total` in proportion to the weights, by largest remainder; of equal
// remainders the first wins.
std::vector<int> apportioned(const std::vector<int>& weights, int total) {
    const int sum = std::accumulate(weights.begin(), weights.end(), 0);
    std::vector<int> parts;
    parts.reserve(weights.size());
    std::vector<std::size_t> spec(weights.size());
    std::iota(spec.begin(), spec.end(), std::size_t{0});
    for (const int weight : weights) parts.push_back(weight * total / sum);
    std::stable_sort(spec.begin(), spec.end(), [&](std::size_t a, std::size_t b) {
        return weights[a] * total % sum > weights[b] * total % sum;
    });
    int missing = total - std::accumulate(parts.begin(), parts.end(), 0);
    for (std::size_t i = 0; missing > 0; ++i, --missing) ++parts[spec[i]];
    return parts;
}

std::vector<int> weights_of(const Mix& mix) {
    std::vector<int> weights;
    for (const MixPart& part : mix) weights.push_back(part.weight);
    return weights;
}

bool has_blades(const Model& model) { return is_bladed(model.surface.hymenium.pattern); }

// Returns how many of a species' sixty-fourths in a mix are painted with its own gill layout: none
// up to three quarters, all at weight 1, continuously between.
int own_layout_share(int sixty_fourths) {
    constexpr int from = 48, span = whole - from;
    const int over = std::max(0, sixty_fourths - from);
    // sixty_fourths * smooth_step in integers, rounded.
    const int share = over * over * (3 * span - 2 * over);
    return (sixty_fourths * share + span * span * span / 2) / (span * span * span);
}

// Lengths and lightness of one species alone, at the age and variation of a spec.
struct SpeciesPaint {
    SurfaceMetrics metrics;
    double lightness = 1.0;
};

/// stepped     surface_spec() of a request
/// individual  resolve() of it
SpeciesPaint species_paint(const MushroomSpec& stepped, const Individual& individual,
                           const std::string& id, const Atlas& atlas, const Caches& caches) {
    MushroomSpec spec;
    spec.model = stepped.model;
    if (!spec.model) spec.mix = {{id, 1000}};
    spec.params.seed = stepped.params.seed;
    spec.params.seeds = stepped.params.seeds;
    spec.params.age = stepped.params.age;
    spec.params.variation = stepped.params.variation;
    spec.params.weathering.cracks = stepped.params.weathering.cracks;  // only cracks use strain
    // One species without overrides, as in most requests, is the individual that is resolved
    // already.
    spec.params.base = stepped.params.base;
    spec.params.lod = stepped.params.lod;
    spec.params.texture_size = stepped.params.texture_size;
    spec.params.textures = stepped.params.textures;
    spec.params.file = stepped.params.file;
    spec.params.animation = stepped.params.animation;
    spec.params.frames = stepped.params.frames;
    spec.params.targets = stepped.params.targets;
    const bool is_known = spec.mix == stepped.mix && spec.params == stepped.params;
    std::optional<Individual> resolved;
    if (!is_known) resolved = resolve(spec, atlas, caches.morphs);
    const Individual& alone = is_known ? individual : *resolved;
    SpeciesPaint found{surface_metrics(alone), alone.lightness};
    const int strain = found.metrics.radial_strain;
    // Lengths are quantised in the same steps as size, so scaling is an addition of steps.
    const int larger = quantised_length(stepped.params.size);
    SurfaceMetrics::fields([&](auto length, const Info& info) {
        found.metrics.*length = std::clamp(found.metrics.*length + larger,
                                           static_cast<int>(info.min), static_cast<int>(info.max));
    });
    found.metrics.radial_strain = strain;  // not a length
    return found;
}

// Branches use the chart of the cap from their tips down: its meridian is the path from the lowest
// fork to the highest tip, its rim as long as what the mean girth of segments takes a piece of.
SurfaceMetrics surface_metrics(const BranchGraph& branch_graph) {
    double radius = 0.0, weight = 0.0;
    for (const BranchGraph::Node& node : branch_graph.nodes) {
        if (node.parent == BranchGraph::none) continue;
        radius += node.presence * node.radius;
        weight += node.presence;
    }
    SurfaceMetrics metrics;
    metrics.cap_arc = quantised_length(branch_graph.height - branch_graph.trunk);
    metrics.cap_radius = quantised_length(
        pi / branch_piece * (weight > 0.0 ? radius / weight : branch_graph.trunk_radius));
    metrics.stem_length = quantised_length(branch_graph.trunk);
    metrics.stem_radius = quantised_length(branch_graph.trunk_radius);
    metrics.hymenium_arc = quantised_length(0.0);
    return metrics;
}

// Clears each override that is not set in `effective`, because no species can have it.
template <class T>
void keep_possible(T& overrides, const T& effective) {
    T::fields([&](auto member, const Info&) {
        if (!(effective.*member)) (overrides.*member).reset();
    });
}

std::string painting_key(const PaintParams& painting) {
    std::string key = "paint " + std::to_string(generator_version) + " ";
    canonical(painting, key);
    return key;
}

}  // namespace

SurfaceMetrics surface_metrics(const Individual& individual) {
    if (individual.is_branched()) return surface_metrics(individual.branch_graph);
    const Outline& outline = individual.outline;
    double radius = 0.0, stem_radius = 0.0;
    for (int i = 0; i <= 16; ++i) {
        radius = std::max(radius, outline.cap.at(i / 16.0).r);
        stem_radius += outline.stem.at(i / 16.0).r / 17.0;
    }
    SurfaceMetrics metrics;
    metrics.cap_arc = quantised_length(outline.cap.length());
    metrics.cap_radius = quantised_length(radius);
    metrics.stem_length = quantised_length(outline.stem.length());
    metrics.stem_radius = quantised_length(stem_radius);
    metrics.stem_foot = quantised_length(buried_share(outline.stem) * outline.stem.length());
    metrics.hymenium_arc = quantised_length(0.0);
    if (!outline.hymenium.empty()) {
        metrics.hymenium_arc = quantised_length(outline.hymenium.length());
        metrics.hymenium_inner = quantised_length(outline.hymenium.at(0.0).r);
    }
    metrics.radial_strain = static_cast<int>(individual.radial_strain * 16.0 + 0.5);
    return metrics;
}

Mix surface_mix(const Mix& mix) {
    if (mix.empty()) return {};
    const std::vector<int> parts = apportioned(weights_of(mix), whole);
    Mix rounded;
    for (std::size_t i = 0; i < mix.size(); ++i)
        if (parts[i] > 0) rounded.push_back({mix[i].id, parts[i]});
    const std::vector<int> thousandths = apportioned(weights_of(rounded), 1000);
    for (std::size_t i = 0; i < rounded.size(); ++i) rounded[i].weight = thousandths[i];
    return rounded;
}

MushroomSpec surface_spec(const MushroomSpec& spec, const Atlas& atlas, const Caches& caches) {
    if (spec.params.triangles)
        return surface_spec(image_spec(spec, resolve(spec, atlas, caches.morphs)), atlas, caches);
    MushroomSpec stepped = spec;
    MushroomParams& params = stepped.params;
    params.age = std::floor(params.age * whole + 0.5) / whole;
    params.size = length_of_step(quantised_length(params.size));
    if (params.share == ImageShare::species && params.seeds) params.seeds->shape.reset();
    params.seed = painted_seed(params.seed, params.share);
    params.drop_equal_seeds();
    params.share = ImageShare::individual;
    params.variants = Variants::none;
    params.substrate.reset();
    stepped.arcs.clear();
    if (spec.model) return stepped;
    params.deformation = {};
    params.weathering.waves.reset();
    params.ornaments.ring.reset();
    params.ornaments.volva.reset();
    params.ornaments.glow.reset();
    stepped.mix = surface_mix(spec.mix);
    if (stepped.mix.size() == spec.mix.size()) return stepped;
    MushroomSpec bare = stepped;
    bare.params.hymenium = {};
    bare.params.ornaments = {};
    bare.params.weathering = {};
    const MushroomParams effective = resolve(bare, atlas, caches.morphs).effective;
    keep_possible(params.hymenium, effective.hymenium);
    keep_possible(params.ornaments, effective.ornaments);
    keep_possible(params.weathering, effective.weathering);
    return stepped;
}

namespace {

// Sets what is painted of one species of an individual, with its own gill layout. `painting` has
// the defaults before.
void set_painting(const MushroomParams& params, const SpeciesShare& part, const SpeciesPaint& alone,
                  PaintParams& painting) {
    const Model& model = part.model;
    painting.seed = params.painted_shape_seed();
    if (params.surface_seed() != painting.seed) painting.surface_seed = params.surface_seed();
    painting.lightness = alone.lightness;
    painting.side = params.texture_size >> params.lod;
    painting.metrics = alone.metrics;
    painting.surface = model.surface;
    if (params.base == Base::clean) {
        painting.surface.stem.soil = painting.surface.stem.mycelium = 0.0;
        // What shows in no image is reset, so that it causes no other key.
        painting.surface.stem.soil_colour = StemSurface{}.soil_colour;
    } else if (!part.ground.empty()) {
        painting.ground = {part.ground.litter.colour, part.ground.litter.aged,
                           part.ground.strands.colour};
    }
    painting.hymenium = model.hymenium;
    // Parameters that shape blades but show in no image are reset, so that they cause no other key.
    const HymeniumOf<Plain> unshaped;
    painting.hymenium.inner_depth = unshaped.inner_depth;
    painting.hymenium.notch = unshaped.notch;
    painting.hymenium.edge_waves = unshaped.edge_waves;
    painting.cells = part.cells;
    painting.warts = model.warts;
    painting.scales = model.scales;
    if (const auto* swept = std::get_if<Swept>(&model.shape)) painting.relief = swept->relief;
    const Detail& detail = detail_of(params.lod);
    painting.carried = carried_relief(painting.relief, detail.columns, detail.cap_rings);
    painting.ornaments = {model.ornaments.warts, model.ornaments.scales};
    painting.slime = model.material.slime;
    // Velvet is rough: its shine is in the material.
    double& roughness = painting.surface.cap.roughness;
    roughness += model.material.velvet * (0.95 - roughness);
    painting.weathering = painted_of(model.weathering);
    // All segments share one image, in which a pit would be on each of them; slugs eat their tips.
    if (std::holds_alternative<Branched>(model.shape)) painting.weathering.bites = 0.0;
    if (painting.weathering == PaintedWeathering<Plain>{}) return;
    painting.damage_seed = damage_seed(params.weather_seed(), stream_of(part.id));
    if (params.weather_seed() != painting.seed) painting.dew_seed = params.weather_seed();
}

// Returns the sum of equal paintings, in the order of their keys.
PaintSpec merged(std::vector<std::pair<std::string, PaintShare>> shares) {
    std::sort(shares.begin(), shares.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    PaintSpec paint_spec;
    for (std::size_t i = 0; i < shares.size(); ++i)
        if (i > 0 && shares[i].first == shares[i - 1].first)
            paint_spec.back().sixty_fourths += shares[i].second.sixty_fourths;
        else
            paint_spec.push_back(std::move(shares[i].second));
    return paint_spec;
}

}  // namespace

PaintSpec paint_spec_of(const MushroomSpec& spec, const Atlas& atlas, const Caches& caches) {
    const MushroomSpec stepped = surface_spec(spec, atlas, caches);
    const Individual individual = resolve(stepped, atlas, caches.morphs);
    std::vector<int> parts = {whole};
    if (!spec.model) parts = apportioned(weights_of(stepped.mix), whole);
    const int gill_layout = individual.gill_layout.blades;
    std::vector<std::pair<std::string, PaintShare>> shares;
    for (const SpeciesShare& part : individual.parts) {
        PaintShare share;
        // Parts are sorted by id, whatever the order of the mix.
        for (std::size_t k = 0; k < stepped.mix.size(); ++k)
            if (stepped.mix[k].id == part.id) share.sixty_fourths = parts[k];
        set_painting(stepped.params, part,
                     species_paint(stepped, individual, part.id, atlas, caches), share.painting);
        // A species with the common gill layout is painted as if it were alone.
        const bool on_common_layout =
            has_blades(part.model) && part.model.hymenium.blades != gill_layout;
        const int own =
            on_common_layout ? own_layout_share(share.sixty_fourths) : share.sixty_fourths;
        const int common = share.sixty_fourths - own;
        if (own > 0) {
            share.sixty_fourths = own;
            shares.emplace_back(canonical_text(share.painting), share);
        }
        if (common > 0) {
            share.sixty_fourths = common;
            share.painting.gill_layout = gill_layout;
            shares.emplace_back(canonical_text(share.painting), std::move(share));
        }
    }
    return merged(std::move(shares));
}

int atlases_held(const MushroomSpec& spec) {
    const Mix mix = surface_mix(spec.mix);
    if (mix.size() < 2) return 1;
    const std::vector<int> parts = apportioned(weights_of(mix), whole);
    const bool has_own_layout = own_layout_share(*std::max_element(parts.begin(), parts.end())) > 0;
    return static_cast<int>(mix.size()) + (has_own_layout ? 2 : 1);
}

int atlases_held(const PaintSpec& paint_spec) {
    return paint_spec.size() < 2 ? 1 : static_cast<int>(paint_spec.size()) + 1;
}

int side_of(const PaintSpec& paint_spec) { return paint_spec.front().painting.side; }

std::string image_key(const PaintSpec& paint_spec, ImageFormat format) {
    const std::string start = key_of_format(format);
    if (paint_spec.size() == 1) return start + painting_key(paint_spec.front().painting);
    std::string key = start + "dissolve";
    for (const PaintShare& share : paint_spec)
        ((key += ' ') += std::to_string(share.sixty_fourths) + ' ') += painting_key(share.painting);
    return key;
}

namespace {

// Paints the species of a mix, and returns what `blend` makes of the paintings, their weights and
// their parameters.
template <class Blend>
auto blended(const PaintSpec& paint_spec, const ExecutionContext& execution, Blend blend) {
    std::vector<const PaintParams*> params;
    std::vector<double> weights;
    for (const PaintShare& share : paint_spec) {
        params.push_back(&share.painting);
        weights.push_back(share.sixty_fourths / static_cast<double>(whole));
    }
    const std::vector<ImageRotations> turns = aligned_rotations(params, weights);
    std::vector<std::shared_ptr<const RawImages>> paintings;
    std::vector<const RawImages*> raw;
    for (std::size_t i = 0; i < paint_spec.size(); ++i) {
        throw_if_cancelled(execution);
        const PaintParams bare = without_patches(*params[i]);
        std::string key = "raw " + painting_key(bare);
        for (const double turn : {turns[i].cap, turns[i].hymenium, turns[i].stem})
            (key += ' ') += number_text(turn);
        paintings.push_back(execution.caches.paintings(key, [&] {
            return std::make_shared<const RawImages>(paint_raw(bare, execution.parallel, turns[i]));
        }));
        raw.push_back(paintings.back().get());
    }
    return blend(raw, weights, params);
}

}  // namespace

RawImages raw_images(const PaintSpec& paint_spec, const ExecutionContext& execution) {
    throw_if_cancelled(execution);
    if (paint_spec.size() == 1) return paint_raw(paint_spec.front().painting, execution.parallel);
    return blended(paint_spec, execution,
                   [&](const auto& raw, const auto& weights, const auto& params) {
                       return blend_raw(raw, weights, execution.parallel, params);
                   });
}

std::shared_ptr<const ImageSet> painted_images(const PaintSpec& paint_spec,
                                               const ExecutionContext& execution,
                                               ImageFormat format) {
    return execution.caches.images(image_key(paint_spec, format), [&] {
        // Uploads of a model are decoded first, 80 ms each at most.
        throw_if_cancelled(execution);
        if (paint_spec.size() == 1)
            return std::make_shared<const ImageSet>(
                paint(paint_spec.front().painting, execution.parallel, format));
        return blended(paint_spec, execution,
                       [&](const auto& raw, const auto& weights, const auto& params) {
                           return std::make_shared<const ImageSet>(
                               blend_images(raw, weights, execution.parallel, params, format));
                       });
    });
}

}  // namespace sporeprint
