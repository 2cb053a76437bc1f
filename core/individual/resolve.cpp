#include "core/individual/resolve.h"

#include <algorithm>
#include <cmath>

#include "core/individual/anatomy.h"
#include "core/individual/damage.h"
#include "core/individual/ornaments.h"
#include "core/individual/proportion.h"
#include "core/individual/sources.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/detail.h"
#include "core/params/blend.h"
#include "core/params/canonical.h"
#include "core/version.h"

namespace sporeprint {

namespace {

constexpr int most_pores = 3000;  // as solids; denser ones exist in the images alone
constexpr double most_natural_fold =
    0.6;  // curvature of the axis times the radius of the stem; it folds at 1
/// The radius of the wood behind a bracket: in radii of the bracket, so that the bracket stays the
/// larger part of a picture, and at least, metres.
constexpr double trunk_by_bracket = 1.25, least_trunk = 0.006;
/// How much farther from its axis the surface of a stem is at irregularity 1, in radii, about.
constexpr double widening_by_irregularity = 1.3;

/// The random draws of an individual, -1..1 or 0..1.
struct Draws {
    double size, stem_length, stem_width, cap_height, bend, lean, imperfection, lightness,
        irregularity;
};

/// Returns the means of the draws of all species by their weights, so that one seed gives another
/// individual in each species, and mixes change gradually from one to the other.
Draws draws_of(std::uint32_t seed, const std::vector<Source>& sources) {
    Draws mean{};
    for (const Source& source : sources) {
        Random random(seed, purposes::variation, stream_of(source.id));
        // In a fixed order; new ones are appended.
        mean.size += source.weight * random.symmetric();
        mean.stem_length += source.weight * random.symmetric();
        mean.stem_width += source.weight * random.symmetric();
        mean.cap_height += source.weight * random.symmetric();
        mean.bend += source.weight * random.uniform();
        mean.lean += source.weight * random.uniform();
        mean.imperfection += source.weight * random.uniform();
        mean.lightness += source.weight * random.symmetric();
        mean.irregularity += source.weight * random.uniform(0.6, 1.0);
    }
    return mean;
}

double factor(double draw, double spread, double variation) {
    return exponential(draw * spread * variation);
}

/// Returns the correspondence of all control shapes of the sources, cached by their content.
std::shared_ptr<const MorphSet> morph_set(const std::vector<Source>& sources,
                                          const std::vector<Arc>& arcs, double age,
                                          const GetOrCompute<MorphSet>& morphs) {
    std::string key = "morph " + std::to_string(generator_version);
    for (const Source& source : sources)
        if (source.id.empty()) {
            key += ' ';
            canonical(silhouette_of(source.first()), key);
        } else {
            key += ' ' + source.id + ' ' + std::to_string(source.hash);
        }
    if (!arcs.empty()) key += " at " + number_text(age);
    for (const Arc& arc : arcs) {
        key += ' ';
        canonical(arc, key);
    }
    return morphs(key, [&] {
        std::vector<ControlShape> shapes;
        for (std::size_t species_index = 0; species_index < sources.size(); ++species_index)
            for (std::size_t i = 0; i < sources[species_index].stages.size(); ++i)
                shapes.push_back({silhouette_of(*sources[species_index].stages[i]),
                                  sources[species_index].size, species_index,
                                  sources[species_index].ages[i]});
        return std::make_shared<const MorphSet>(std::move(shapes), arcs, age);
    });
}

/// Returns the weights of all control shapes, in the order of morph_set().
std::vector<double> shape_weights(const std::vector<Source>& sources) {
    std::vector<double> weights;
    for (const Source& source : sources)
        for (const double growth : source.growth) weights.push_back(source.weight * growth);
    return weights;
}

/// Returns the same weights at the youngest stage.
std::vector<double> young_weights(const std::vector<Source>& sources) {
    std::vector<double> weights;
    for (const Source& source : sources)
        for (std::size_t i = 0; i < source.stages.size(); ++i)
            weights.push_back(i == 0 ? source.weight : 0.0);
    return weights;
}

/// Returns the strain of the cap's skin since its youngest stage.
double strain_of(const MorphSet& set, const std::vector<Source>& sources) {
    const auto cap = [&](const std::vector<double>& weights) {
        return SubCurve(set.nodes(weights).cap, {-1.0, 0.0});
    };
    return radial_strain(cap(young_weights(sources)), cap(shape_weights(sources)));
}

/// Returns the damage by weathering for geometry.
DamageAmounts damage_amounts_of(const std::vector<Source>& sources,
                                const WeatheringOf<Maybe>& requested) {
    using Amount = double WeatheringOf<Plain>::*;
    DamageAmounts damage;
    const auto lay = [&](Amount amount, const std::optional<double>& wanted, auto able) {
        bool can = false;
        double& sum = damage.amounts.*amount;
        for (const Source& source : sources) {
            if (!able(source)) continue;
            sum += source.weight * (source.now.weathering.*amount);
            can = can || (wanted && *wanted > 0.0) ||
                  std::any_of(source.stages.begin(), source.stages.end(),
                              [&](const Model* stage) { return stage->weathering.*amount > 0.0; });
        }
        return can;
    };
    using W = WeatheringOf<Plain>;
    const auto all = [](const Source&) { return true; };
    const auto margin = [](const Source& s) { return s.has_margin(); };
    for (const Source& source : sources)
        if (!source.has_margin()) damage.clubs += source.weight;
    lay(&W::creases, requested.creases, all);
    lay(&W::bumps, requested.bumps, all);
    damage.bites = lay(&W::bites, requested.bites, all);
    damage.splits = lay(&W::splits, requested.splits, margin);
    damage.melts =
        lay(&W::deliquescence, requested.deliquescence, [](const Source& s) { return s.melts(); });
    const auto peels = [](const Source& s) { return s.peels(); };
    damage.peels = lay(&W::peel, requested.peel, peels);
    damage.dew = lay(&W::dew, requested.dew, all);
    // Each species has its weight's part of the sum, so that the effective amounts of a mix, requested
    // of all of its species, have the same mesh.
    const auto part = [&](Amount amount, auto able) {
        double able_weight = 0.0;
        for (const Source& source : sources)
            if (able(source)) able_weight += source.weight;
        return able_weight > 0.0 ? damage.amounts.*amount / able_weight : 0.0;
    };
    const double bites = part(&W::bites, all), splits = part(&W::splits, margin),
                 peel = part(&W::peel, peels);
    for (const Source& source : sources) {
        MarginDamage& own = damage.margins.emplace_back();
        own.stream = stream_of(source.id);
        own.can_bite = damage.bites;
        own.can_split = damage.splits && margin(source);
        own.can_peel = damage.peels && peels(source);
        own.bites = source.weight * bites;
        if (own.can_split) own.splits = source.weight * splits;
        if (own.can_peel) own.peel = source.weight * peel;
    }
    return damage;
}

AxisCurve axis_of(const std::vector<Source>& sources) {
    AxisCurve axis;
    for (const Source& source : sources)
        for (std::size_t i = 0; i < source.stages.size(); ++i) {
            const auto& controls = std::get<Swept>(source.stages[i]->shape).axis;
            if (source.growth[i] > 0.0 && !controls.empty())
                axis.add(AxisCurve(controls), source.weight * source.growth[i]);
        }
    return axis;
}

const Azimuth& azimuth_of(const Source& source) {
    return std::get<Swept>(source.now.shape).azimuth;
}

/// Returns the fan: its amount is the weighted mean, its form the mean by the share of each species
/// in that amount.
Azimuth fan_of(const std::vector<Source>& sources) {
    double lateral = 0.0;
    for (const Source& source : sources) lateral += source.weight * azimuth_of(source).lateral;
    Shares<Azimuth> shares;
    for (const Source& source : sources) {
        const Azimuth& one = azimuth_of(source);
        shares.add(one, lateral > 0.0 ? source.weight * one.lateral / lateral : source.weight);
    }
    Azimuth fan = blend(shares);
    fan.lateral = lateral;
    return fan;
}

/// Returns the lobes of each species that has any, depth times weight: each species keeps its own
/// number.
std::vector<Azimuth> lobes_of(const std::vector<Source>& sources) {
    std::vector<Azimuth> lobes;
    for (const Source& source : sources) {
        Azimuth one = azimuth_of(source);
        one.lobe_depth *= source.weight;
        if (one.lobes > 0 && one.lobe_depth > 0.0) lobes.push_back(one);
    }
    return lobes;
}

/// Returns the relief of each species that has any, depth times weight; equal forms are merged to
/// keep the list short.
std::vector<ReliefStyle> reliefs_of(const std::vector<Source>& sources) {
    std::vector<ReliefStyle> reliefs;
    for (const Source& source : sources) {
        ReliefStyle relief = std::get<Swept>(source.now.shape).relief;
        if (!relief.any()) continue;
        relief.folds *= source.weight;
        relief.pits *= source.weight;
        relief.tiers *= source.weight;
        const auto match =
            std::find_if(reliefs.begin(), reliefs.end(), [&](const ReliefStyle& other) {
                return other.fold_count == relief.fold_count && other.crests == relief.crests &&
                       other.pit_columns == relief.pit_columns &&
                       other.pit_rows == relief.pit_rows && other.rib == relief.rib &&
                       other.tier_count == relief.tier_count;
            });
        if (match == reliefs.end()) {
            reliefs.push_back(relief);
            continue;
        }
        match->folds += relief.folds;
        match->pits += relief.pits;
        match->tiers += relief.tiers;
    }
    return reliefs;
}

/// Returns the outline in an individual's own proportions or, where some level of detail would
/// touch itself, in the nearest proportions on the path from the template that do not: up to the
/// first touch, which is continuous in age and weights.
Outline varied_outline(const OutlineNodes& nodes, const std::function<Proportions(double)>& own,
                       double open, double size) {
    constexpr int samples = 8, halvings = 20;
    const auto at = [&](double share) {
        return Outline(scaled(proportioned(nodes, own(share), open), size));
    };
    const auto is_simple = [](const Outline& outline) {
        for (int lod = 0; lod < static_cast<int>(details.size()); ++lod)
            if (self_intersecting_curve(outline, lod)) return false;
        return true;
    };
    Outline whole = at(1.0);
    if (is_simple(whole)) return whole;
    double simple = 0.0, touching = 1.0;
    for (int sample = 1; sample < samples; ++sample) {
        const double share = static_cast<double>(sample) / samples;
        if (!is_simple(at(share))) {
            touching = share;
            break;
        }
        simple = share;
    }
    for (int halving = 0; halving < halvings; ++halving) {
        const double middle = 0.5 * (simple + touching);
        (is_simple(at(middle)) ? simple : touching) = middle;
    }
    return at(simple);
}

/// Returns the rows of a species' spines, or of pores coarse enough to be solids. They are those of
/// its mature template at every age and grow with the mushroom.
CellRows cells_of(const Source& source) {
    if (!source.has_cells() || !source.has_margin()) return {};
    std::size_t mature = 0;
    for (std::size_t i = 1; i < source.ages.size(); ++i)
        if (std::abs(source.ages[i] - mature_age) < std::abs(source.ages[mature] - mature_age))
            mature = i;
    const Outline outline = Outline::unproven(silhouette_of(*source.stages[mature]));
    const double inner = outline.hymenium.at(0.0).r, outer = outline.hymenium.at(1.0).r;
    const double arc = std::max(outline.hymenium.length(), 1e-5), far = std::max(inner, outer);
    const double per_metre = 1000.0 * source.now.hymenium.pores_per_mm;
    if (source.pattern() == HymeniumPattern::teeth)
        return cell_rows(arc, inner, far, per_metre, most_spines);
    // Elongated pores are fewer along the meridian, as on a shorter one.
    const double area = pi * (inner + far) * arc;
    if (area * per_metre * per_metre / source.now.hymenium.elongation > 1.1 * most_pores) return {};
    return cell_rows(arc / source.now.hymenium.elongation, inner, far, per_metre, most_pores);
}

/// Sets the layout of the solids on the lower face, which no weight and no age may change.
void resolve_hymenium(Individual& individual, const MushroomParams& requested,
                      const std::vector<Source>& sources) {
    individual.blade_tiers = individual.gill_layout.tiers;
    for (const Source& source : sources) {
        if (!source.has_blades()) continue;
        individual.runs_down =
            individual.runs_down || is_requested(requested.hymenium.decurrent) ||
            std::any_of(source.stages.begin(), source.stages.end(),
                        [](const Model* stage) { return stage->hymenium.decurrent > 0.0; });
        // Each ridge may fork, and each of its forks.
        if (source.pattern() == HymeniumPattern::ridges)
            while (individual.gill_layout.blades << individual.blade_tiers <
                   4 * source.now.hymenium.blades)
                ++individual.blade_tiers;
    }
}

void overlay_all(const MushroomParams& requested, Model& model) {
    overlay(requested.deformation, model.deformation);
    overlay(requested.ornaments, model.ornaments);
    overlay(requested.hymenium, model.hymenium);
    overlay(requested.weathering, model.weathering);
}

/// Resolves the outline and the axis of a swept individual.
void resolve_swept(Individual& individual, const MushroomSpec& spec,
                   const std::vector<Source>& sources, const std::vector<Arc>& arcs,
                   const Draws& draws, const Spread& spread, const GetOrCompute<MorphSet>& morphs) {
    const MushroomParams& requested = spec.params;
    // Shapes are blended in unit size, sizes by their ratio.
    const double variation = requested.variation;
    double size = 0.0, open = 0.0;
    for (const Source& source : sources) {
        size += source.weight * logarithm(source.size);
        if (source.has_margin()) open += source.weight;
    }
    size = (sources.size() == 1 ? sources.front().size : exponential(size)) * requested.size *
           factor(draws.size, spread.size, variation);
    individual.size = size;
    individual.set = morph_set(sources, arcs, requested.age, morphs);
    const auto own = [&](double share) {
        return Proportions{factor(draws.stem_length, spread.stem_length, share * variation),
                           factor(draws.stem_width, spread.stem_width, share * variation),
                           factor(draws.cap_height, spread.cap_height, share * variation)};
    };
    individual.outline =
        varied_outline(individual.set->nodes(shape_weights(sources)), own, open, size);
    std::vector<int> built = levels_in_file(requested.lod, requested.file);
    if (has_impostor(requested.lod, requested.file)) built.push_back(impostor_source_lod);
    for (const int lod : built)
        if (const auto curve = self_intersecting_curve(individual.outline, lod))
            throw Impossible(spec.model ? std::string("/model/silhouette/") + name(*curve) : "mix",
                             "the outline crosses itself at level of detail " +
                                 std::to_string(lod) + ", near the " + name(*curve));
    const auto stem = individual.outline.rings(CurveName::stem, 0);
    individual.stem_base = stem.front().y;
    individual.stem_top = stem.back().y;

    // Variation bends an individual only as far as its own stem permits; a requested bend, or that
    // of a custom model, is checked by core/geometry instead.
    DeformationOf<Plain>& deformation = individual.model.deformation;
    deformation.irregularity =
        std::min(1.0, deformation.irregularity + draws.irregularity * spread.irregularity *
                                                     std::min(1.0, 2.0 * variation) *
                                                     (0.5 + 0.5 * requested.age));
    const double irregular = requested.deformation.irregularity.value_or(deformation.irregularity);
    const double slender =
        std::max(individual.stem_top - individual.stem_base, 1e-4) /
        (greatest_radius(individual.outline.stem) * (1.0 + widening_by_irregularity * irregular));
    individual.axis = axis_of(sources);
    individual.azimuth = fan_of(sources);
    individual.lobes = lobes_of(sources);
    individual.reliefs = reliefs_of(sources);
    if (!spec.model) {
        const double fold = individual.axis.greatest_turn() / slender;
        if (fold > most_natural_fold)
            individual.axis = individual.axis.scaled(most_natural_fold / fold);
        const double zone = (deformation.zone_to - deformation.zone_from) * slender * (180.0 / pi);
        const double available = std::min(0.6, (0.95 - std::min(fold, most_natural_fold)) / 1.5);
        const double of_template = std::min(deformation.bend_deg, 1.5 * available * zone);
        const double drawn = deformation.bend_deg + draws.bend * spread.bend_deg * variation;
        deformation.bend_deg = std::min({90.0, drawn, std::max(of_template, available * zone)});
    }
}

/// Resolves the branch graph of a branched individual.
void resolve_branched(Individual& individual, const MushroomSpec& spec,
                      const std::vector<Source>& sources, const Draws& draws,
                      const Spread& spread) {
    const MushroomParams& requested = spec.params;
    const double variation = requested.variation;
    std::vector<BranchGraphShare> shares;
    shares.reserve(sources.size());
    for (const Source& source : sources)
        shares.push_back(
            {&std::get<Branched>(source.now.shape), source.weight, stream_of(source.id)});
    const BranchGraphProportions own{requested.size * factor(draws.size, spread.size, variation),
                                     factor(draws.stem_length, spread.stem_length, variation),
                                     factor(draws.stem_width, spread.stem_width, variation),
                                     factor(draws.cap_height, spread.cap_height, variation)};
    const double bites = requested.weathering.bites.value_or(individual.model.weathering.bites);
    individual.branch_graph = branch_graph_of(
        shares, own, bites, requested.shape_seed(),
        requested.seeds ? requested.seeds->damage.value_or(requested.seed) : requested.seed);
    individual.stem_top = individual.branch_graph.trunk;
    individual.spines = spines_of(sources, own.size);
    if (requested.base == Base::natural) individual.grounds = grounds_of(sources, own.size);
    if (spec.model) return;
    // Variation bends an individual only as far as its own segments permit.
    DeformationOf<Plain>& deformation = individual.model.deformation;
    const double slender =
        individual.branch_graph.height / std::max(individual.branch_graph.reach, 1e-4);
    const double zone = (deformation.zone_to - deformation.zone_from) * slender * (180.0 / pi);
    deformation.bend_deg = std::min(
        {90.0, deformation.bend_deg + draws.bend * spread.bend_deg * variation, 0.5 * zone});
}

/// Resolves the ornaments and the damage of a swept individual.
void resolve_ornaments(Individual& individual, const MushroomParams& requested,
                       const std::vector<Source>& sources) {
    if (individual.model.weathering.cracks > 0.0)
        individual.radial_strain = strain_of(*individual.set, sources);
    individual.damage = damage_amounts_of(sources, requested.weathering);
    individual.layers = layers_of(sources, *individual.set);
    individual.ring = ring_of(sources, individual.size);
    individual.sac = sac_of(sources, individual.size);
    individual.spines = spines_of(sources, individual.size);
    individual.peridioles = peridioles_of(sources, individual.size);
    individual.receptacles = receptacles_of(sources, individual.size);
    if (requested.base == Base::natural) individual.grounds = grounds_of(sources, individual.size);
    for (const Source& source : sources) {
        individual.has_ring = individual.has_ring || source.has_ring();
        individual.has_sac = individual.has_sac || source.has_sac();
        if (source.has_margin()) individual.waves += source.weight * source.now.weathering.waves;
        const GillLayout gill_layout{source.now.hymenium.blades, source.now.hymenium.tiers};
        if (source.has_blades() && gill_layout.at_margin() > individual.gill_layout.at_margin())
            individual.gill_layout = gill_layout;
    }
    resolve_hymenium(individual, requested, sources);
    if (individual.gill_layout.blades > 0) {
        individual.model.hymenium.blades = individual.gill_layout.blades;
        individual.model.hymenium.tiers = individual.gill_layout.tiers;
    }
}

/// Returns how many times as wide as now the widest stage of any species is, at least 1.
double size_left(const std::vector<Source>& sources) {
    const auto width_of = [](const Model& model) {
        const Outline outline = Outline::unproven(silhouette_of(model));
        Extent extent{0.0, 0.0};
        extent.include(outline.cap);
        return extent.radius;
    };
    double most = 1.0;
    for (const Source& source : sources) {
        double now = 0.0, widest = 0.0;
        for (std::size_t i = 0; i < source.stages.size(); ++i) {
            const double width = width_of(*source.stages[i]);
            now += source.growth[i] * width;
            widest = std::max(widest, width);
        }
        if (now > 0.0) most = std::max(most, widest / now);
    }
    return most;
}

/// Decides what an individual stands on: wood behind a bracket alone, by default that of the species
/// that does most to make it one. The wood of a clip is as wide as its widest frame needs.
///
/// throws  Impossible for wood behind what stands on the ground
void resolve_substrate(Individual& individual, const std::vector<Source>& sources) {
    std::optional<Substrate>& substrate = individual.effective.substrate;
    if (individual.grows_from_wall()) {
        // Of a mix, what makes it a bracket counts, not what stands on the ground.
        const auto most = std::max_element(sources.begin(), sources.end(),
                                           [](const Source& one, const Source& other) {
                                               return one.weight * azimuth_of(one).lateral <
                                                      other.weight * azimuth_of(other).lateral;
                                           });
        substrate = substrate.value_or(most->wood);
        if (*substrate == Substrate::none) return;
        Extent extent{individual.stem_base, individual.stem_base};
        for (const SubCurve* curve : {&individual.outline.hymenium, &individual.outline.cap})
            extent.include(*curve);
        const double grown =
            individual.effective.animation == Animation::growth ? size_left(sources) : 1.0;
        individual.trunk_radius = std::max(
            trunk_by_bracket * std::max(individual.azimuth.width, 1.0) * grown * extent.radius,
            least_trunk);
        return;
    }
    if (substrate.value_or(Substrate::none) != Substrate::none)
        throw Impossible("/substrate",
                         std::string("'") + name(*substrate) +
                             "' is wood for what grows from a wall; " +
                             (sources.size() > 1 ? "this mix" : sources.front().label) +
                             " stands on the ground");
    substrate.reset();
}

// Returns the sources of a specification, all of whose parameters they can have.
//
// throws  InvalidInput, Impossible
std::vector<Source> checked_sources(const MushroomSpec& spec, const Atlas& atlas) {
    std::vector<Problem> problems;
    check(spec.params, Info{.name = ""}, "", problems);
    if (spec.model) check(*spec.model, Info{.name = ""}, "/model", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    if (spec.model && spec.params.animation == Animation::growth)
        throw Impossible("/animation", "a model of your own has no stages to grow through");
    std::vector<Source> sources = sources_of(spec, atlas);
    if (!spec.arcs.empty() && sources.size() != 2)
        throw InvalidInput("/arcs",
                           "arcs link two species; this mix has " + std::to_string(sources.size()));
    if (!spec.arcs.empty() && sources.front().is_branched())
        throw Impossible("/arcs", "limbs that branch have no outlines that arcs could link");
    check_anatomy(spec.params, sources);
    return sources;
}

}  // namespace

Individual resolve(const MushroomSpec& spec, const Atlas& atlas,
                   const GetOrCompute<MorphSet>& morphs) {
    const MushroomParams& requested = spec.params;
    std::vector<Source> sources = checked_sources(spec, atlas);
    // Arcs name the species in the order of the mix; from here on species are sorted by id.
    std::vector<Arc> arcs = spec.arcs;
    if (!arcs.empty() && spec.mix[0].id != sources[0].id)
        for (Arc& arc : arcs) std::swap(arc.a, arc.b);

    Individual individual;
    individual.effective = requested;
    individual.painted_seed = requested.painted_shape_seed();
    individual.shape_seed = requested.shape_seed();
    individual.weather_seed = requested.weather_seed();
    const auto everyone = [](const Source&) { return true; };
    const Spread spread =
        blend_among(sources, everyone, [](const Source& s) -> const Spread& { return s.spread; });
    Model& model = individual.model;
    model = blend_among(sources, everyone, [](const Source& s) -> const Model& { return s.now; });
    if (sources.front().is_branched())
        model.shape = Branched{};
    else
        model.shape = Swept{};

    const Draws draws = draws_of(requested.shape_seed(), sources);
    const double variation = requested.variation;
    if (sources.front().is_branched())
        resolve_branched(individual, spec, sources, draws, spread);
    else
        resolve_swept(individual, spec, sources, arcs, draws, spread, morphs);
    const std::uint32_t colour_seed =
        requested.seeds ? requested.seeds->surface.value_or(requested.seed) : requested.seed;
    individual.lightness =
        factor(draws_of(colour_seed, sources).lightness, spread.lightness, variation);
    DeformationOf<Plain>& deformation = model.deformation;
    deformation.lean_deg =
        std::min(45.0, deformation.lean_deg + draws.lean * spread.lean_deg * variation);
    deformation.imperfection = std::min(
        1.0, deformation.imperfection + draws.imperfection * spread.imperfection * variation);

    // Overrides apply to every species that can have them.
    for (Source& source : sources) overlay_all(requested, source.now);
    blend_amounts(model, sources);
    overlay_all(requested, model);
    std::vector<Problem> problems;
    model.deformation.check("/deformation", problems);
    if (!problems.empty()) throw Impossible(std::move(problems));

    if (!sources.front().is_branched()) resolve_ornaments(individual, requested, sources);
    report_effective(individual.effective, model, sources);
    resolve_substrate(individual, sources);
    for (Source& source : sources) {
        const CellRows cells = cells_of(source);
        individual.parts.push_back(
            {source.id, source.weight, std::move(source.now), source.ground, cells});
    }
    return individual;
}

std::vector<BranchGraph> species_branch_graphs(const MushroomSpec& spec, const Atlas& atlas) {
    std::vector<Problem> problems;
    check(spec.params, Info{.name = ""}, "", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    const std::vector<Source> sources = sources_of(spec, atlas);
    std::vector<BranchGraph> branch_graphs;
    branch_graphs.reserve(sources.size());
    for (const Source& alone : sources) {
        std::vector<BranchGraphShare> shares;
        shares.reserve(sources.size());
        for (const Source& source : sources)
            shares.push_back({&std::get<Branched>(source.now.shape), &source == &alone ? 1.0 : 0.0,
                              stream_of(source.id)});
        branch_graphs.push_back(branch_graph_of(shares, {}, 0.0, spec.params.shape_seed()));
    }
    return branch_graphs;
}

SpeciesShapes species_shapes(const MushroomSpec& spec, const Atlas& atlas,
                             const GetOrCompute<MorphSet>& morphs) {
    std::vector<Problem> problems;
    check(spec.params, Info{.name = ""}, "", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    const std::vector<Source> sources = sources_of(spec, atlas);
    SpeciesShapes shapes;
    shapes.set = morph_set(sources, {}, spec.params.age, morphs);
    std::size_t first = 0;
    for (const Source& source : sources) {
        std::vector<double> weights(shapes.set->size(), 0.0);
        std::copy(source.growth.begin(), source.growth.end(),
                  weights.begin() + static_cast<std::ptrdiff_t>(first));
        first += source.growth.size();
        shapes.weights.push_back(std::move(weights));
        shapes.sizes.push_back(source.size);
    }
    return shapes;
}

}  // namespace sporeprint
