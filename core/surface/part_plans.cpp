#include "core/surface/part_plans.h"

#include <algorithm>
#include <cmath>

#include "core/individual/gill_layout.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/surface/canvas.h"
#include "core/surface/charts.h"
#include "core/surface/skin_plan.h"

namespace sporeprint {

namespace {

constexpr float single(double value) { return static_cast<float>(value); }

// Returns the visibility of a noise octave whose features are `texels` large: 0 below two, 1 from
// four on.
float resolvable(double texels) { return single(std::clamp((texels - 2.0) / 2.0, 0.0, 1.0)); }

double disc_texel(const Frame& frame) {
    return 1.0 / ((0.5 - static_cast<double>(frame.inset)) * frame.width);
}

ReliefPlan relief_plan(const PaintParams& params) {
    const ReliefStyle& style = params.relief;
    ReliefPlan plan;
    plan.seed = relief_seeds(params.seed);
    // Geometry in the mesh needs no painted slopes; a quarter remains, because its triangles smooth
    // sharp features.
    const auto left = [](double carried) { return 1.0 - 0.75 * carried; };
    plan.folds = single(style.folds);
    // Creases and crests are sharper than any triangle, so that painting shows more of them.
    plan.fold_slope = single(style.folds * (1.0 - 0.35 * params.carried.folds));
    plan.crests = single(style.crests);
    plan.fold_size = 0.5F * static_cast<float>(style.fold_count);
    plan.pits = single(style.pits);
    plan.pit_slope = single(style.pits * left(params.carried.pits));
    plan.pit_columns = static_cast<float>(style.pit_columns);
    plan.pit_rows = static_cast<float>(style.pit_rows);
    plan.rib = single(pit_rib * style.rib);
    plan.tiers = single(style.tiers);
    plan.tier_slope = single(style.tiers * left(params.carried.tiers));
    plan.tier_count = static_cast<float>(style.tier_count);
    plan.hollow = light_of(params.surface.cap.hollow);
    plan.tint = single(params.surface.cap.hollow_tint);
    return plan;
}

SlotAssignment slot_assignment_of(const PaintParams& params) {
    return slot_assignment(params.gill_layout, params.surface.hymenium.pattern,
                           params.hymenium.blades, params.hymenium.tiers);
}

GillLayoutPlan gill_layout_plan(const PaintParams& params, const SlotAssignment& assignment) {
    GillLayoutPlan plan;
    plan.blades = assignment.blades;
    plan.slots = static_cast<float>(assignment.slots);
    plan.occupied = static_cast<float>(assignment.occupied);
    plan.stride = static_cast<float>(assignment.stride);
    const bool ridges = params.surface.hymenium.pattern == HymeniumPattern::ridges;
    plan.bend = single(ridges ? ridge_wander : gill_wander);
    const Wander wander = wander_of(params.seed);
    for (std::size_t i = 0; i < wander.waves.size(); ++i) {
        const Wander::Wave& wave = wander.waves[i];
        plan.wander[i] = {single(wave.count), single(wave.lean), single(wave.size),
                          single(wave.phase)};
    }
    return plan;
}

// Returns the share of incident light that pale walls reflect to each other.
double interreflection(Colour colour) {
    const Light light = light_of(colour);
    return std::min(0.8, 0.8 * static_cast<double>(light.r + light.g + light.b) / 3.0);
}

// Returns the light at the bottom of a slot between blades: a slot with depth `steep` times its
// width sees this little of the sky, and walls otherwise. Ridges are shallow folds, and spines
// stand apart.
double slot_occlusion(const PaintParams& params) {
    const HymeniumSurface& face = params.surface.hymenium;
    const bool open =
        face.pattern == HymeniumPattern::ridges || face.pattern == HymeniumPattern::teeth;
    const double steep = (open ? 0.6 : 1.6) * params.hymenium.relief;
    const double sky = std::sqrt(1.0 + steep * steep) - steep;
    return sky / (1.0 - interreflection(face.colour) * (1.0 - sky));
}

// Returns the radius from the axis over the disc radius, at share rho of the meridian.
double roundness(const DiscPlan& disc, double rho) {
    if (rho < 1e-4) return 1.0;
    const double angle = std::min(rho * static_cast<double>(disc.bend), 0.5 * pi);
    return static_cast<double>(disc.sphere) * sine(angle) / rho;
}

}  // namespace

Light light_of(Colour colour) {
    const std::array<float, 256>& table = linear_table();
    return {table[colour.r], table[colour.g], table[colour.b]};
}

DiscPlan cap_disc(double arc, double radius, const Frame& frame) {
    DiscPlan disc;
    disc.per_texel = single(disc_texel(frame));
    const double ratio = std::max(arc / radius, 1.0);
    double bend = 0.5 * pi;
    if (ratio < 0.5 * pi) {
        // Solves bend / sin(bend) = ratio by bisection.
        double low = 0.01, high = 0.5 * pi;
        for (int i = 0; i < 40; ++i) {
            bend = 0.5 * (low + high);
            (bend / sine(bend) < ratio ? low : high) = bend;
        }
    } else {
        bend = ratio;
    }
    disc.bend = single(bend);
    disc.sphere = single(1.0 / bend);
    return disc;
}

/// Returns the individual's own hue as the stem has it.
Light stem_tint(const PaintParams& params) {
    return tint_of(hue_of(params.paint_seed()), 0.6 * params.surface.cap.colour_drift);
}

CapPlan cap_plan(const PaintParams& params, const Frame& frame) {
    const CapSurface& cap = params.surface.cap;
    CapPlan plan;
    const double arc = length_of_step(params.metrics.cap_arc);
    plan.disc = cap_disc(arc, length_of_step(params.metrics.cap_radius), frame);
    plan.relief = relief_plan(params);
    plan.seed = seeds<12>(params.paint_seed(), purposes::cap_paint);
    plan.lightness = single(params.lightness);
    // Slime is smooth and fills bumps.
    plan.roughness = single(cap.roughness + params.slime * (0.12 - cap.roughness));
    for (std::size_t i = 0; i < 3; ++i)
        plan.bumps[i] = single(cap.bumps * (1.0 - 0.7 * params.slime)) *
                        resolvable(1.0 / (static_cast<double>(cap_bump_frequency[i]) *
                                          static_cast<double>(plan.disc.per_texel)));
    plan.fields = 7U;
    if (plan.bumps[0] > 0.0F) plan.fields |= 1U << cap_bump;
    std::vector<Colour> ramp = cap.ramp;
    if (ramp.empty()) ramp.push_back(Colour{128, 128, 128});
    if (ramp.size() > most_ramp_steps + 1) ramp.resize(most_ramp_steps + 1);
    plan.first = light_of(ramp[0]);
    plan.steps = static_cast<int>(ramp.size()) - 1;
    for (std::size_t i = 0; i + 1 < ramp.size(); ++i) {
        const Light from = light_of(ramp[i]);
        const Light to = light_of(ramp[i + 1]);
        plan.step[i] = {to.r - from.r, to.g - from.g, to.b - from.b};
    }
    if (!cap.image.empty()) {
        plan.lightness = 1.0F;
        return plan;
    }
    plan.ramp_noise = single(cap.ramp_noise);
    plan.fibrils = single(cap.fibrils);
    plan.fibril_count = cap.fibril_count;
    plan.zones = single(cap.zones);
    plan.zone_count = single(cap.zone_count);
    plan.zone_seed = seeds<3>(params.paint_seed(), purposes::zone_widths);
    const Hue hue = hue_of(params.paint_seed());
    plan.tint = tint_of(hue, cap.colour_drift);
    const SineCosine side = sine_cosine(2.0 * pi * hue.turn);
    plan.joined = params.metrics.hymenium_arc > quantised_length(0.0) ? 0.0F : 1.0F;
    plan.joined_tint = stem_tint(params);
    plan.joined_colour = light_of(params.surface.stem.top);
    plan.joined_roughness = single(params.surface.stem.roughness);
    plan.drift_x = single(side.cosine);
    plan.drift_y = single(side.sine);
    plan.drift = {single(0.14 * cap.colour_drift), 0.0F, single(-0.22 * cap.colour_drift)};
    plan.ramp_drift = single(0.22 * cap.colour_drift);
    const double texel = arc * static_cast<double>(plan.disc.per_texel);
    plan.skin = skin_plan(cap.skin, {arc, texel, texel}, 1.0 - 0.7 * params.slime,
                          seeds<1>(params.paint_seed(), purposes::skin_grain)[0]);
    plan.patches = single(cap.patches);
    plan.patch_frequency = single(
        std::min(0.55 * arc / cap.patch_size, 0.4 / static_cast<double>(plan.disc.per_texel)));
    // Threshold of the noise for this share of the face; a logistic function approximates its
    // distribution.
    const double share = std::clamp(cap.patches, 0.01, 0.99);
    plan.patch_threshold = single(-0.20 * logarithm(share / (1.0 - share)));
    plan.patch_slope = single(1.0 / (0.15 + 0.5 * cap.patch_softness));
    plan.patch_grain = single(0.08 + 0.24 * cap.patch_softness);
    plan.patch_weight = single(std::min(1.0, cap.patches * 8.0));
    plan.patch_colour = light_of(cap.patch_colour);
    plan.streaks = single(cap.streaks);
    plan.veins = single(cap.veins);
    plan.vein_rows = 7.0F;
    plan.striae = single(cap.striae);
    if (is_bladed(params.surface.hymenium.pattern)) {
        plan.layout = gill_layout_plan(params, slot_assignment_of(params));
        // Widely spaced gills show with the shorter ones between them.
        const bool is_sparse = plan.layout.blades <= 40 && params.hymenium.tiers > 0;
        plan.striae_scale = is_sparse ? 2.0F : 1.0F;
    } else {
        plan.layout.blades = params.hymenium.blades;
    }
    // Water in the flesh makes it translucent, and fills the furrows.
    const double wet = params.weathering.wetness;
    // Long lines are real furrows; short ones at a glossy margin are hardly more than colour, and
    // would break its highlight up into stitches.
    const double furrowed =
        std::min(1.0, 2.0 * cap.striae) * std::clamp(2.5 * (cap.roughness - 0.2), 0.0, 1.0);
    plan.striae_relief =
        single((0.05 + 0.14 * furrowed) * (1.0 - 0.6 * wet) * (1.0 - 0.7 * params.slime));
    plan.striae_shade = single(0.26 + 0.25 * wet);
    if (plan.streaks > 0.0F) plan.fields |= 1U << cap_streak;
    if (plan.fibrils > 0.0F) plan.fields |= 1U << cap_fibre;
    if (plan.patches > 0.0F) plan.fields |= 1U << cap_patch;
    if (plan.veins > 0.0F) plan.fields |= 1U << cap_vein;
    if (plan.zones > 0.0F) plan.fields |= 1U << cap_zone;
    return plan;
}

HymeniumPlan hymenium_plan(const PaintParams& params, const Frame& frame) {
    const HymeniumSurface& face = params.surface.hymenium;
    HymeniumPlan plan;
    const double arc = length_of_step(params.metrics.hymenium_arc);
    const double inner = length_of_step(params.metrics.hymenium_inner);
    const double outer = std::max(length_of_step(params.metrics.cap_radius), inner);
    const double unit = arc / (1.0 - hymenium_inner_share);
    plan.disc.per_texel = single(disc_texel(frame));
    plan.disc.inner = single(hymenium_inner_share);
    plan.disc.cone_from = single(inner / unit);
    plan.disc.cone_grow = single((outer - inner) / unit);
    plan.seed = hymenium_words(params.seed);
    plan.colour = light_of(face.colour);
    plan.edge = light_of(face.edge);
    plan.depth = light_of(face.depth);
    plan.roughness = single(face.roughness);
    plan.relief = single(params.hymenium.relief);
    for (std::size_t i = 0; i < 2; ++i)
        plan.bumps[i] = 0.6F * resolvable(1.0 / (static_cast<double>(hymenium_bump_frequency[i]) *
                                                 static_cast<double>(plan.disc.per_texel)));
    plan.fields = 3U;
    if (plan.bumps[0] > 0.0F) plan.fields |= 1U << hymenium_bump;
    if (!face.image.empty()) return plan;
    plan.pattern = static_cast<int>(face.pattern);
    const Light stem = light_of(params.surface.stem.top), tint = stem_tint(params);
    plan.stem = {stem.r * tint.r, stem.g * tint.g, stem.b * tint.b};
    plan.joined = face.pattern == HymeniumPattern::smooth ? 0.0F : 1.0F;
    plan.mottle = single(face.mottle);
    plan.felt = single(face.felt);
    plan.cracks = single(face.cracks);
    plan.crack_rows = single(crack_plates);
    plan.crack_from =
        single(2.0 * pi * inner / arc * crack_plates * static_cast<double>(crack_tall));
    plan.crack_grow = single(2.0 * pi * (outer - inner) / arc * static_cast<double>(crack_tall));
    const SlotAssignment assignment = slot_assignment_of(params);
    plan.layout = gill_layout_plan(params, assignment);
    plan.tiers = assignment.tiers;
    plan.last_tier = single(assignment.last_tier);
    plan.inner_gap = single(params.hymenium.inner_gap);
    plan.bare_slope = single(1.0 / std::max(0.9 * params.hymenium.inner_gap, 1e-3));
    plan.forking = single(params.hymenium.forking);
    plan.vein_rows = cross_vein_rows(assignment.blades);
    plan.veins_there = single(veins_there(params.hymenium.forking));
    plan.slot_occlusion = single(slot_occlusion(params));
    plan.blade = single(0.5 * params.hymenium.thickness * 2.0 * pi * outer / unit /
                        (params.hymenium.blades * (1 << params.hymenium.tiers)));
    // Elongated pores need fewer rows.
    const double tall = face.pattern == HymeniumPattern::pores ? params.hymenium.elongation : 1.0;
    CellRows cells = params.cells;
    double rows = cells.rows;
    if (cells.rows == 0) {
        rows = std::max(3.0, arc * params.hymenium.pores_per_mm * 1000.0 / tall);
        cells.from = 2.0 * pi * inner / arc * rows * tall;
        cells.grow = 2.0 * pi * (outer - inner) / arc * tall;
    }
    plan.pore_rows = single(rows);
    plan.pore_from = single(cells.from);
    plan.pore_grow = single(cells.grow);
    plan.pore_tall = single(tall);
    plan.spine = single(0.5 * params.hymenium.thickness);
    plan.pore_shown = single(std::clamp(
        ((1.0 - hymenium_inner_share) / (rows * static_cast<double>(plan.disc.per_texel)) - 1.6) /
            2.0,
        0.0, 1.0));
    return plan;
}

/// Returns the factor on the colour of a skin under a thin film of soil: the hue of the soil, half as
/// strong, at the lightness that the film leaves.
Light film_of(const Light& soil) {
    constexpr float left = 0.62F;
    const float most = std::max({soil.r, soil.g, soil.b, 1e-3F});
    const auto of = [&](float channel) { return left * 0.5F * (1.0F + channel / most); };
    return {of(soil.r), of(soil.g), of(soil.b)};
}

StemPlan stem_plan(const PaintParams& params, const Frame& frame) {
    const StemSurface& stem = params.surface.stem;
    StemPlan plan;
    const double length = length_of_step(params.metrics.stem_length);
    const double circumference = 2.0 * pi * length_of_step(params.metrics.stem_radius);
    const double share = 1.0 - 2.0 * static_cast<double>(frame.inset);
    const double aspect = std::clamp(length / circumference, 0.02, 40.0);
    const double along = aspect / (share * frame.width);
    const double round = 1.0 / (share * frame.height);
    plan.seed = seeds<12>(params.paint_seed(), purposes::stem_paint);
    plan.aspect = single(aspect);
    plan.ragged = single(0.10 * std::min(1.0, 1.5 / aspect));
    plan.texel_along = single(along);
    plan.texel_round = single(round);
    plan.top = light_of(stem.top);
    plan.base = light_of(stem.base);
    plan.stain = light_of(stem.stain);
    plan.band_colour = light_of(stem.band_colour);
    plan.net_colour = light_of(stem.net_colour);
    plan.roughness = single(stem.roughness);
    plan.joined = params.metrics.hymenium_arc > quantised_length(0.0) ? 0.0F : 1.0F;
    const double stretch = std::clamp(1.6 * round / along, 0.05, 1.0);
    plan.stretch = single(stretch);
    for (std::size_t i = 0; i < 3; ++i)
        plan.bumps[i] = single(stem.bumps) *
                        resolvable(1.0 / (stem_bump_cells[i] * std::max(round, along * stretch)));
    plan.fields = 3U;
    if (plan.bumps[0] > 0.0F) plan.fields |= 1U << stem_bump;
    if (!stem.image.empty()) return plan;
    plan.tint = stem_tint(params);
    plan.skin =
        skin_plan(stem.skin, {circumference, circumference * round, circumference * along, true},
                  1.0, seeds<1>(params.paint_seed(), purposes::skin_grain)[0] + 0x51ED270BU);
    plan.base_stain = single(stem.base_stain);
    plan.soil = single(stem.soil);
    plan.soil_colour = light_of(stem.soil_colour);
    plan.film = film_of(plan.soil_colour);
    plan.mycelium = single(stem.mycelium);
    const double foot = std::min(length_of_step(params.metrics.stem_foot) / length, 1.0);
    plan.foot = single(foot);
    // Half a diameter high, but no more than a ninth of what is above the ground.
    plan.soil_reach = single(std::max(std::min(0.5 / (pi * aspect), (1.0 - foot) / 9.0), 1e-4));
    for (std::size_t i = 0; i < 2; ++i) {
        const double cells =
            std::clamp(std::round(circumference / grain_distance[i]), 16.0, most_grains);
        plan.grains[i] = single(cells);
        plan.grains_shown[i] = resolvable(1.0 / (cells * std::max(round, along)));
    }
    plan.fibrils = single(stem.fibrils);
    const double weights[3] = {0.25 + 0.75 * stem.fibrils, 0.7, 0.6};
    for (std::size_t i = 0; i < 3; ++i)
        plan.fibres[i] =
            single(weights[i]) *
            resolvable(1.0 / (stem_fibre_cells[i] *
                              std::max(round, along * static_cast<double>(stem_fibre_slender[i]))));
    if (plan.fibrils > 0.0F) plan.fields |= (1U << stem_fibre) | (1U << stem_furrow);
    plan.bands = single(stem.bands);
    plan.net = single(stem.net);
    const HymeniumSurface& face = params.surface.hymenium;
    if (is_bladed(face.pattern) && params.hymenium.decurrent > 0.0) {
        const SlotAssignment assignment = slot_assignment_of(params);
        plan.layout = gill_layout_plan(params, assignment);
        plan.gills = single(params.hymenium.decurrent);
        plan.gill_half = single(std::min(
            0.36, 0.5 * params.hymenium.thickness * length_of_step(params.metrics.cap_radius) *
                      2.0 * pi / circumference / (1 << params.hymenium.tiers)));
        plan.gill_relief = single(0.22 * params.hymenium.relief / assignment.blades);
        plan.gill_occlusion = single(slot_occlusion(params));
        plan.gill_shown =
            single(std::clamp((1.0 / (assignment.blades * round) - 2.0) / 2.0, 0.0, 1.0));
        plan.gill_colour = light_of(face.colour);
        plan.gill_edge = light_of(face.edge);
        plan.gill_depth = light_of(face.depth);
    }
    plan.net_shown = resolvable(1.0 / (static_cast<double>(net_columns) *
                                       std::max(round, along / static_cast<double>(net_stretch))) -
                                1.0);
    return plan;
}

VeilPlan veil_plan(const PaintParams& params, const Frame& frame) {
    VeilPlan plan;
    const double share = 1.0 - 2.0 * static_cast<double>(frame.inset);
    plan.seed = seeds<4>(params.paint_seed(), purposes::veil_paint);
    plan.texel = single(1.0 / (share * frame.width));
    plan.across = single(static_cast<double>(frame.height) / frame.width);
    plan.colour = light_of(params.surface.veil.colour);
    plan.tip = light_of(params.surface.veil.tip);
    // The side that was torn off the flesh is nearly of its colour.
    constexpr float of_veil = 0.22F;
    const Light flesh = light_of(params.surface.flesh.colour);
    plan.inner = {flesh.r + of_veil * (plan.colour.r - flesh.r),
                  flesh.g + of_veil * (plan.colour.g - flesh.g),
                  flesh.b + of_veil * (plan.colour.b - flesh.b)};
    plan.roughness = single(params.surface.veil.roughness);
    plan.pits = single(params.surface.veil.pits);
    return plan;
}

// Occlusion of the wall between two neighbouring blades: at depth d in a slot of width w it sees 1
// - d / sqrt(d^2 + w^2) of the sky; light reflected between the walls brightens pale ones.
BladePlan blade_plan(const PaintParams& params, const Frame& frame) {
    const HymeniumSurface& face = params.surface.hymenium;
    BladePlan plan;
    const double share = 1.0 - 2.0 * static_cast<double>(frame.inset);
    plan.seed = seeds<4>(params.paint_seed(), purposes::blade_paint);
    plan.texel_along = single(1.0 / (share * frame.width));
    const double depth = std::max(params.hymenium.depth, 0.01);
    plan.texel_across = single(depth / (share * frame.height));
    plan.colour = light_of(face.colour);
    plan.edge = light_of(face.edge);
    plan.depth = light_of(face.depth);
    plan.mottle = single(face.mottle);
    plan.roughness = single(face.roughness);
    // The gap between two blades half-way to the margin.
    const double arc = length_of_step(params.metrics.hymenium_arc);
    const double radius = 0.5 * (length_of_step(params.metrics.hymenium_inner) +
                                 length_of_step(params.metrics.cap_radius));
    const double gap =
        2.0 * pi * radius /
        static_cast<double>(params.hymenium.blades << std::min(params.hymenium.tiers, 1));
    // Hairs of a felt stand alone, and light reaches their bases.
    plan.steep = single(std::clamp(params.hymenium.relief * depth * arc / gap, 0.2, 6.0) *
                        (1.0 - 0.85 * face.felt));
    plan.pale = single(interreflection(face.colour));
    plan.grain = resolvable(share * frame.width / static_cast<double>(blade_grain));
    return plan;
}

FleshPlan flesh_plan(const PaintParams& params, const Frame& frame) {
    FleshPlan plan;
    const double share = 1.0 - 2.0 * static_cast<double>(frame.inset);
    plan.seed = seeds<4>(params.paint_seed(), purposes::flesh_paint);
    plan.texel_along = single(1.0 / (share * frame.width));
    plan.texel_across = single(flesh_width / (share * frame.height));
    plan.colour = light_of(params.surface.flesh.colour);
    plan.roughness = single(params.surface.flesh.roughness);
    for (std::size_t i = 0; i < 3; ++i)
        plan.bumps[i] =
            resolvable(share * frame.width / static_cast<double>(flesh_bump_frequency[i]));
    return plan;
}

GroundPlan ground_plan(const PaintParams& params, const Frame& frame) {
    GroundPlan plan;
    const double share = 1.0 - 2.0 * static_cast<double>(frame.inset);
    plan.seed = seeds<4>(params.paint_seed(), purposes::ground_paint);
    plan.texel_along = single(1.0 / (share * frame.width));
    plan.texel_across = single(1.0 / (share * frame.height));
    for (std::size_t i = 0; i < plan.shown.size(); ++i)
        plan.shown[i] = resolvable(share * frame.width / ground_cells[i]);
    plan.soil = light_of(params.surface.stem.soil_colour);
    plan.litter = light_of(params.ground.litter);
    plan.aged = light_of(params.ground.aged);
    plan.strands = light_of(params.ground.strands);
    return plan;
}

namespace {

/// Heights of a style, in radii, from which its pieces leave footprints, and fully do: those of the
/// spines of core/geometry/ornaments.cpp.
constexpr double least_spine = 0.9, full_spine = 1.5;

/// Size of a footprint, in that of the piece before any of it has fallen.
constexpr double footprint_size = 1.15;

/// Opacity of footprints per amount of veil, so that they appear with the first of it.
constexpr double footprint_onset = 12.0;

/// How far tufts of hairs turn to either side, radians.
constexpr double tuft_turn = 0.7;

/// Returns a piece at its place, as long and as wide as `radius` says.
PatchPlan placed_patch(const Patch& patch, const PatchStyle& style, double radius,
                       const PaintPlan& plan) {
    const double length = std::max(radius * style.elongation, 1e-4);
    const double width =
        std::max(radius / std::max(roundness(plan.cap.disc, patch.sigma), 0.1), 1e-4);
    const SineCosine turn = sine_cosine(patch.theta);
    PatchPlan one;
    one.x = single(patch.sigma * turn.cosine);
    one.y = single(patch.sigma * turn.sine);
    one.along_x = single(turn.cosine);
    one.along_y = single(turn.sine);
    one.per_length = single(1.0 / length);
    one.per_width = single(1.0 / width);
    one.reach = patch_window * single(std::max(length, width));
    one.hairs = resolvable(width * 0.5 * plan.frames[0].width / tuft_hairs);
    return one;
}

/// Adds the ring of grains round a spine, and the mark that is left where the spine has fallen.
///
/// shown  opacity, 0..1
/// left   0..1: how much of the spine is left
void add_footprint(const Patch& patch, const PatchStyle& style, double radius, double shown,
                   double left, std::uint32_t seed, PaintPlan& plan) {
    PatchPlan one = placed_patch(patch, style, footprint_size * radius, plan);
    one.kind = 2;
    one.relief = single(0.22 * radius);
    one.fallen = single(1.0 - left);
    one.shown = single(shown) * resolvable(0.5 * plan.frames[0].width * 2.0 * pi /
                                           (footprint_grains * static_cast<double>(one.per_width)));
    one.seed = Random(seed, purposes::wart_outlines, patch.id).bits();
    if (one.shown > 0.0F) plan.patches.push_back(one);
}

}  // namespace

void add_patches(const PatchStyle& style, int kind, double amount, std::uint32_t seed,
                 double weight, PaintPlan& plan) {
    const bool warts = kind == 0;
    if (amount <= 0.0) return;
    const double footprints = warts ? smooth_step(least_spine, full_spine, style.height) *
                                          std::min(1.0, footprint_onset * amount)
                                    : 0.0;
    for (const Patch& patch : patches(style, seed, warts ? purposes::warts : purposes::scales)) {
        if (patch.radius <= 0.0) continue;
        const double scale = patch_scale(patch, amount);
        if (footprints > 0.0)
            add_footprint(patch, style, patch.radius * weight, footprints, scale, seed, plan);
        if (scale <= 0.0) continue;
        // A wart shrinks with weathering; a scale is flattened, but stays.
        const double radius = patch.radius * weight * (kind == 0 ? scale : 0.7 + 0.3 * scale);
        PatchPlan one = placed_patch(patch, style, radius, plan);
        one.kind = kind;
        one.lift = single(std::clamp(3.0 * style.lift, -1.0, 1.0));
        one.relief =
            single((kind == 0 ? 0.22 * patch.height : 0.12 * patch.height + 0.04) * radius);
        one.fray = single(style.fray);
        one.shown = single(kind == 0 ? std::min(1.0, 4.0 * scale) : scale);
        Random stream(seed, warts ? purposes::wart_outlines : purposes::scale_outlines, patch.id);
        one.seed = stream.bits();
        for (std::size_t side = 0; side < 6; ++side) {
            const double angle = stream.uniform(-0.32, 0.32);
            const double off = stream.uniform(0.78, 1.12);
            const SineCosine normal =
                sine_cosine(patch.spin + (static_cast<double>(side) / 6.0) * 2.0 * pi + angle);
            one.side_x[side] = single(normal.cosine / off);
            one.side_y[side] = single(normal.sine / off);
        }
        if (kind == 1 && style.fray > 0.0) {
            // Tufts lie this way and that, so that their hairs do not all point at the apex.
            const SineCosine turn = sine_cosine(stream.uniform(-1.0, 1.0) * tuft_turn * style.fray);
            const auto along_x = static_cast<double>(one.along_x),
                       along_y = static_cast<double>(one.along_y);
            one.along_x = single(turn.cosine * along_x - turn.sine * along_y);
            one.along_y = single(turn.sine * along_x + turn.cosine * along_y);
        }
        plan.patches.push_back(one);
    }
}

void sort_patches_into_rows(PaintPlan& plan) {
    const Frame& frame = plan.frames[0];
    plan.patches_by_row.resize(static_cast<std::size_t>(frame.height));
    const double reach = 0.5 - static_cast<double>(frame.inset);
    for (std::size_t i = 0; i < plan.patches.size(); ++i) {
        const PatchPlan& patch = plan.patches[i];
        const double middle = (static_cast<double>(patch.y) * reach + 0.5) * frame.height;
        const double half = static_cast<double>(patch.reach) * reach * frame.height + 1.0;
        const int from = static_cast<int>(std::max(middle - half, 0.0));
        const int to =
            static_cast<int>(std::clamp(middle + half, 0.0, static_cast<double>(frame.height)));
        for (int y = from; y < to; ++y)
            plan.patches_by_row[static_cast<std::size_t>(y)].push_back(static_cast<int>(i));
    }
}

}  // namespace sporeprint
