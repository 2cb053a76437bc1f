#include "core/model/resolve.h"

#include <algorithm>
#include <cmath>

#include "core/build/detail.h"
#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/model/marks.h"
#include "core/model/proportion.h"
#include "core/model/purposes.h"
#include "core/params/blend.h"
#include "core/params/canonical.h"
#include "core/silhouette/weights.h"
#include "core/version.h"

namespace sporeprint {

namespace {

constexpr int most_pores = 3000;    // as solids; of more, all live in the images alone
constexpr double mature_age = 0.6;  // of recorded sizes, for every species
constexpr double most_natural_fold =
    0.6;  // curvature of the axis times the radius of the stem; it folds at 1

/// The individual's own draws, -1..1 or 0..1. Drawn in a fixed order; a new one goes last.
struct Draws {
    double size, stem_length, stem_width, cap_height, bend, lean, imperfection, lightness;
};

Draws draws_of(std::uint32_t seed) {
    Random random(seed, purposes::variation);
    Draws d{};
    d.size = random.symmetric();
    d.stem_length = random.symmetric();
    d.stem_width = random.symmetric();
    d.cap_height = random.symmetric();
    d.bend = random.uniform();
    d.lean = random.uniform();
    d.imperfection = random.uniform();
    d.lightness = random.symmetric();
    return d;
}

/// One species of the order, or the client's own Model as a species of a single stage.
struct Source {
    std::string id, who;
    double weight = 1.0;
    std::uint64_t hash = 0;
    Spread spread{0, 0, 0, 0, 0, 0, 0, 0};
    std::vector<const Model*> stages;
    std::vector<double> ages;    ///< of the stages
    std::vector<double> growth;  ///< of each stage at this age; at most two are not 0
    std::vector<double> mature;  ///< of each stage at maturity
    double size = 1.0;           ///< of its mature shape, metres
    Model now;                   ///< at this age

    [[nodiscard]] const Model& first() const { return *stages.front(); }
    [[nodiscard]] HymeniumPattern pattern() const { return first().surface.hymenium.pattern; }
    [[nodiscard]] bool has_blades() const {
        return pattern() == HymeniumPattern::gills || pattern() == HymeniumPattern::ridges;
    }
    /// Pores or teeth.
    [[nodiscard]] bool has_cells() const {
        return pattern() == HymeniumPattern::pores || pattern() == HymeniumPattern::teeth;
    }
    [[nodiscard]] bool has_ring() const {
        return std::any_of(stages.begin(), stages.end(),
                           [](const Model* stage) { return stage->ring.width > 0.0; });
    }
    [[nodiscard]] bool has_sac() const {
        return std::any_of(stages.begin(), stages.end(),
                           [](const Model* stage) { return stage->sac.height > 0.0; });
    }
    [[nodiscard]] bool has_volva() const { return has_sac() || first().volva.count > 0; }
    [[nodiscard]] bool melts() const {
        return std::any_of(stages.begin(), stages.end(), [](const Model* stage) {
            return stage->weathering.deliquescence > 0.0;
        });
    }
    [[nodiscard]] bool peels() const {
        return has_margin() && std::any_of(stages.begin(), stages.end(), [](const Model* stage) {
                   return stage->surface.scars.peel_reach > 0.0;
               });
    }
    [[nodiscard]] bool has_margin() const {
        return !std::get<Swept>(first().shape).silhouette.hymenium.empty();
    }
};

std::vector<double> growth_weights(const std::vector<Stage>& stages, double age) {
    std::vector<double> weights(stages.size(), 0.0);
    if (age <= stages.front().age) {
        weights.front() = 1.0;
        return weights;
    }
    for (std::size_t i = 1; i < stages.size(); ++i)
        if (age <= stages[i].age) {
            weights[i] = (age - stages[i - 1].age) / (stages[i].age - stages[i - 1].age);
            weights[i - 1] = 1.0 - weights[i];
            return weights;
        }
    weights.back() = 1.0;
    return weights;
}

/// Overall size of a shape: the half diagonal of the box round its control points turned about the axis.
double size_of(const Silhouette& s) {
    double radius = 0.0, low = s.stem.front().y, high = low;
    for (const auto* part : {&s.stem, &s.hymenium, &s.cap})
        for (const OutlinePoint& p : *part) {
            radius = std::max(radius, p.r);
            low = std::min(low, p.y);
            high = std::max(high, p.y);
        }
    return std::sqrt(radius * radius + 0.25 * (high - low) * (high - low));
}

const Silhouette& silhouette_of(const Model& model) {
    return std::get<Swept>(model.shape).silhouette;
}

Source source_of(const AtlasEntry& entry, double weight, double age) {
    const Species& species = entry.species;
    Source source;
    source.id = species.id.string();
    source.who = species.facts.scientific_name.string();
    source.weight = weight;
    source.hash = entry.hash;
    source.spread = species.spread;
    source.growth = growth_weights(species.stages, age);
    source.mature = growth_weights(species.stages, mature_age);
    Shares<Model> stages;
    double size = 0.0;
    for (std::size_t i = 0; i < species.stages.size(); ++i) {
        const Model& model = species.stages[i].model;
        source.stages.push_back(&model);
        source.ages.push_back(species.stages[i].age);
        stages.add(model, source.growth[i]);
        size += source.mature[i] * size_of(silhouette_of(model));
    }
    source.size = size;
    source.now = blend(stages);
    // A comb is one thing: the tiers of one stage do not go with the blades of another.
    Comb most;
    for (const Model* stage : source.stages) {
        const Comb comb{stage->hymenium.blades, stage->hymenium.tiers};
        if (comb.at_margin() > most.at_margin()) most = comb;
    }
    source.now.hymenium.blades = most.blades;
    source.now.hymenium.tiers = most.tiers;
    return source;
}

std::vector<Source> sources_of(const MushroomOrder& order, const Atlas& atlas) {
    std::vector<Source> sources;
    if (order.model) {
        Source own;
        own.who = "this model";
        own.stages = {&*order.model};
        own.ages = {mature_age};
        own.growth = {1.0};
        own.mature = {1.0};
        own.size = size_of(silhouette_of(*order.model));
        own.now = *order.model;
        sources.push_back(std::move(own));
        return sources;
    }
    std::vector<Problem> problems;
    if (order.mix.empty() || order.mix.size() > most_blended)
        report(problems, "mix",
               std::to_string(order.mix.size()) + " species; a mix has 1 to " +
                   std::to_string(most_blended));
    double sum = 0.0;
    for (const MixPart& part : order.mix) {
        if (!atlas.find(part.id))
            report(problems, "mix", "'" + part.id + "' is no species of the atlas");
        if (part.weight <= 0)
            report(problems, "mix", "the weight of '" + part.id + "' is not positive");
        for (const MixPart& other : order.mix)
            if (&other < &part && other.id == part.id)
                report(problems, "mix", "'" + part.id + "' is named twice");
        sum += part.weight;
    }
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    Mix mix = order.mix;
    std::sort(mix.begin(), mix.end(),
              [](const MixPart& a, const MixPart& b) { return a.id < b.id; });
    std::vector<double> weights;
    for (const MixPart& part : mix) weights.push_back(part.weight / sum);
    weights = eased_weights(std::move(weights));
    for (std::size_t i = 0; i < mix.size(); ++i)
        sources.push_back(source_of(*atlas.find(mix[i].id), weights[i], order.params.age));
    return sources;
}

/// What the sources have together; `counts` says which of them count, the rest weigh nothing.
template <class Counts, class Of>
auto among(const std::vector<Source>& sources, Counts counts, Of of) {
    Shares<std::remove_cvref_t<decltype(of(sources[0]))>> shares;
    double sum = 0.0;
    for (const Source& source : sources)
        if (counts(source)) sum += source.weight;
    for (const Source& source : sources)
        if (counts(source) || sum == 0.0)
            shares.add(of(source), sum > 0.0 ? source.weight / sum : source.weight);
    return blend(shares);
}

double factor(double draw, double spread, double variation) {
    return exponential(draw * spread * variation);
}

/// The correspondence of all control shapes of the sources: kept under what they are.
std::shared_ptr<const MorphSet> morph_set(const std::vector<Source>& sources,
                                          const std::vector<Arc>& arcs, double age,
                                          const Remember<MorphSet>& morphs) {
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
        for (std::size_t kin = 0; kin < sources.size(); ++kin)
            for (std::size_t i = 0; i < sources[kin].stages.size(); ++i)
                shapes.push_back({silhouette_of(*sources[kin].stages[i]), sources[kin].size, kin,
                                  sources[kin].ages[i]});
        return std::make_shared<const MorphSet>(std::move(shapes), arcs, age);
    });
}

/// Weights of all control shapes, in the order of morph_set().
std::vector<double> shape_weights(const std::vector<Source>& sources) {
    std::vector<double> weights;
    for (const Source& source : sources)
        for (const double growth : source.growth) weights.push_back(source.weight * growth);
    return weights;
}

/// The same at the beginning of life.
std::vector<double> young_weights(const std::vector<Source>& sources) {
    std::vector<double> weights;
    for (const Source& source : sources)
        for (std::size_t i = 0; i < source.stages.size(); ++i)
            weights.push_back(i == 0 ? source.weight : 0.0);
    return weights;
}

/// How the cap's skin has been strained since it was young.
double strain_of(const MorphSet& set, const std::vector<Source>& sources) {
    const auto cap = [&](const std::vector<double>& weights) {
        return SubCurve(set.nodes(weights).cap, {-1.0, 0.0});
    };
    return radial_strain(cap(young_weights(sources)), cap(shape_weights(sources)));
}

/// Weathering for geometry.
Wear wear_of(const std::vector<Source>& sources, const WeatheringOf<Maybe>& asked) {
    using Amount = double WeatheringOf<Plain>::*;
    Wear wear;
    const auto lay = [&](Amount amount, const std::optional<double>& wanted, auto able) {
        bool can = false;
        double& sum = wear.amounts.*amount;
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
        if (!source.has_margin()) wear.clubs += source.weight;
    lay(&W::creases, asked.creases, all);
    lay(&W::bumps, asked.bumps, all);
    wear.bites = lay(&W::bites, asked.bites, all);
    wear.splits = lay(&W::splits, asked.splits, margin);
    wear.melts =
        lay(&W::deliquescence, asked.deliquescence, [](const Source& s) { return s.melts(); });
    wear.peels = lay(&W::peel, asked.peel, [](const Source& s) { return s.peels(); });
    wear.dew = lay(&W::dew, asked.dew, all);
    return wear;
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

/// The fan: how lateral by weight, its form by how much of it each species brings.
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

/// The lobes of each species that has any, as deep as it weighs: each keeps its own number.
std::vector<Azimuth> lobes_of(const std::vector<Source>& sources) {
    std::vector<Azimuth> lobes;
    for (const Source& source : sources) {
        Azimuth one = azimuth_of(source);
        one.lobe_depth *= source.weight;
        if (one.lobes > 0 && one.lobe_depth > 0.0) lobes.push_back(one);
    }
    return lobes;
}

/// The relief of each species that has any, as deep as it weighs; equal forms share one, so that a set grows no slower than it must.
std::vector<ReliefStyle> reliefs_of(const std::vector<Source>& sources) {
    std::vector<ReliefStyle> reliefs;
    for (const Source& source : sources) {
        ReliefStyle relief = std::get<Swept>(source.now.shape).relief;
        if (!relief.any()) continue;
        relief.folds *= source.weight;
        relief.pits *= source.weight;
        relief.tiers *= source.weight;
        const auto alike =
            std::find_if(reliefs.begin(), reliefs.end(), [&](const ReliefStyle& other) {
                return other.fold_count == relief.fold_count &&
                       other.pit_columns == relief.pit_columns &&
                       other.pit_rows == relief.pit_rows && other.rib == relief.rib &&
                       other.tier_count == relief.tier_count;
            });
        if (alike == reliefs.end()) {
            reliefs.push_back(relief);
            continue;
        }
        alike->folds += relief.folds;
        alike->pits += relief.pits;
        alike->tiers += relief.tiers;
    }
    return reliefs;
}

bool has_relief(const Source& source) {
    return std::any_of(source.stages.begin(), source.stages.end(), [](const Model* stage) {
        const Swept& shape = std::get<Swept>(stage->shape);
        return shape.relief.any() || shape.azimuth.lateral > 0.0 || shape.azimuth.lobe_depth > 0.0;
    });
}

/// One layer for each kind of piece of each species; species whose pieces have equal places share theirs.
std::vector<PatchLayer> layers_of(const std::vector<Source>& sources, const MorphSet& set) {
    std::vector<PatchLayer> layers;
    const auto segments_of = [&](std::size_t species) {
        std::vector<double> weights;
        for (std::size_t i = 0; i < sources.size(); ++i)
            for (const double mature : sources[i].mature)
                weights.push_back(i == species ? mature : 0.0);
        return Outline(set.nodes(weights), set.places()).stem.segment_shares();
    };
    const auto lay = [&](std::uint32_t purpose, PatchStyle Model::*style, auto amount) {
        std::vector<bool> merged(sources.size(), false);
        for (std::size_t i = 0; i < sources.size(); ++i) {
            const PatchStyle& one = sources[i].now.*style;
            if (one.count == 0 || merged[i]) continue;
            const auto alike = [&](const Source& other) {
                const PatchStyle& two = other.now.*style;
                return two.count == one.count && two.from == one.from && two.to == one.to &&
                       two.elongation == one.elongation;
            };
            double weight = 0.0;
            for (std::size_t j = i; j < sources.size(); ++j)
                if (alike(sources[j])) {
                    merged[j] = true;
                    weight += sources[j].weight;
                }
            layers.push_back(
                {purpose,
                 among(sources, alike,
                       [&](const Source& s) -> const PatchStyle& { return s.now.*style; }),
                 among(sources, alike, amount), weight,
                 purpose == purposes::bulb_scales ? segments_of(i) : std::vector<double>{}});
        }
    };
    lay(purposes::warts, &Model::warts,
        [](const Source& s) -> const double& { return s.now.ornaments.warts; });
    lay(purposes::scales, &Model::scales,
        [](const Source& s) -> const double& { return s.now.ornaments.scales; });
    lay(purposes::bulb_scales, &Model::volva,
        [](const Source& s) -> const double& { return s.now.ornaments.volva; });
    return layers;
}

/// A ring or sac this wide, as a share of its species' size, has half a say in the shape of that of a mix.
constexpr double half_a_say = 0.01;

/// One ring or sac from those of all species: its extent is the sum of theirs, as shares of each one's size; the rest goes by weight,
/// and what is hardly there has hardly a say. By extent alone a thousandth of a wide ring would pull a narrow one up the stem.
/// In metres for an individual of this size.
template <class Style>
Style shell_of(const std::vector<Source>& sources, Style Model::*shell, double Style::*extent,
               double OrnamentsOf<Plain>::*amount, double size) {
    std::vector<Style> styles;
    std::vector<double> says;
    double whole = 0.0, said = 0.0;
    for (const Source& source : sources) {
        Style style = source.now.*shell;
        style.thickness /= source.size;
        const double wide = source.now.ornaments.*amount * style.*extent / source.size;
        whole += source.weight * wide;
        says.push_back(source.weight * wide / (wide + half_a_say));
        said += says.back();
        styles.push_back(style);
    }
    Shares<Style> shares;
    for (std::size_t i = 0; i < styles.size(); ++i)
        shares.add(styles[i], said > 0.0 ? says[i] / said : sources[i].weight);
    Style one = blend(shares);
    one.*extent = whole * size;
    one.thickness *= size;
    return one;
}

/// The outline in an individual's own proportions; in those nearest to them with which no level of detail touches itself, where they
/// would: on the way from the template to them, up to the first touch. That place moves with age and weights, without jumps.
Outline own_outline(const OutlineNodes& nodes, const std::shared_ptr<const RingPlaces>& places,
                    const std::function<Proportions(double)>& own, double open, double size,
                    bool fine) {
    constexpr int looks = 8, halvings = 20;
    const auto at = [&](double share) {
        return Outline(scaled(proportioned(nodes, own(share), open), size), places, fine);
    };
    const auto is_simple = [](const Outline& outline) {
        for (int lod = 0; lod < static_cast<int>(details.size()); ++lod)
            if (fault_of(outline, lod)) return false;
        return true;
    };
    Outline whole = at(1.0);
    if (is_simple(whole)) return whole;
    double simple = 0.0, touching = 1.0;
    for (int look = 1; look < looks; ++look) {
        const double share = static_cast<double>(look) / looks;
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

/// What a lower face carries, in words.
const char* carried(HymeniumPattern pattern) {
    return pattern == HymeniumPattern::smooth ? "a smooth face" : name(pattern);
}

/// One rule of anatomy: an override that asks for something, whether a source can have it, and why not if none can.
struct AnatomyRule {
    const char* path;
    bool asked;
    bool (*can)(const Source&);
    const char* wants;  ///< "gills or ridges": what a mix lacks
    std::string (*why)(const Source&);
};

/// Why a lone species carries no `wanted`.
std::string carries_instead(const Source& s, const std::string& wanted) {
    if (s.pattern() != HymeniumPattern::smooth)
        return s.who + " carries " + carried(s.pattern()) + ", not " + wanted;
    return s.has_margin()
               ? s.who + " has a smooth lower face, without " + wanted
               : s.who + " is smooth all over; it has no lower face that could carry " + wanted;
}

/// Whether an optional amount asks for more than nothing.
bool wished(const std::optional<double>& amount) { return amount && *amount > 0.0; }

/// What no species of the order can have, in words.
void check_anatomy(const MushroomParams& asked, const std::vector<Source>& sources) {
    using S = const Source&;
    using Pattern = HymeniumPattern;
    const HymeniumOf<Maybe>& h = asked.hymenium;
    const auto bladed = [](S s) { return s.has_blades(); };
    const auto no_gills = [](S s) { return carries_instead(s, "gills"); };
    const auto carrying = [](S s) { return s.pattern() != Pattern::smooth; };
    const auto nothing_deep = [](S s) { return carries_instead(s, "gills, pores or teeth"); };
    const AnatomyRule rules[] = {
        {"/hymenium/blades", h.blades.has_value(), bladed, "carries gills or ridges", no_gills},
        {"/hymenium/tiers", h.tiers.has_value(), bladed, "carries gills or ridges", no_gills},
        {"/hymenium/edge_waves", wished(h.edge_waves), bladed, "carries gills or ridges", no_gills},
        {"/hymenium/thickness", h.thickness.has_value(),
         [](S s) { return s.has_blades() || s.pattern() == Pattern::teeth; },
         "carries gills, ridges or teeth", no_gills},
        {"/hymenium/forking", wished(h.forking), [](S s) { return s.pattern() == Pattern::ridges; },
         "carries ridges, which fork",
         [](S s) {
             return s.pattern() == Pattern::gills
                        ? s.who + " carries gills, which do not fork; ridges do"
                        : carries_instead(s, "ridges");
         }},
        {"/hymenium/pores_per_mm", h.pores_per_mm.has_value(), [](S s) { return s.has_cells(); },
         "carries pores or teeth", [](S s) { return carries_instead(s, "pores"); }},
        {"/hymenium/elongation", h.elongation.has_value(),
         [](S s) { return s.pattern() == Pattern::pores; }, "carries pores",
         [](S s) { return carries_instead(s, "pores"); }},
        {"/hymenium/depth", wished(h.depth), carrying, "carries gills, pores or teeth",
         nothing_deep},
        {"/hymenium/inner_gap", wished(h.inner_gap), carrying, "carries gills, pores or teeth",
         nothing_deep},
        {"/hymenium/inner_depth", h.inner_depth.has_value(), carrying,
         "carries gills, pores or teeth", nothing_deep},
        {"/hymenium/notch", wished(h.notch), carrying, "carries gills, pores or teeth",
         nothing_deep},
        {"/hymenium/decurrent", wished(h.decurrent), carrying, "carries gills, pores or teeth",
         nothing_deep},
        {"/ornaments/warts", wished(asked.ornaments.warts),
         [](S s) { return s.first().warts.count > 0; },
         "has a universal veil that could leave warts",
         [](S s) {
             return s.who + (s.has_margin() ? " has no universal veil that could leave warts"
                                            : " has no cap skin that could carry warts, and no "
                                              "universal veil that could leave them");
         }},
        {"/ornaments/scales", wished(asked.ornaments.scales),
         [](S s) { return s.first().scales.count > 0; }, "has a skin that tears into scales",
         [](S s) {
             return s.who + (s.has_margin() ? " has a skin that does not tear into scales"
                                            : " has no cap skin that could tear into scales");
         }},
        {"/ornaments/ring", wished(asked.ornaments.ring), [](S s) { return s.has_ring(); },
         "has a partial veil that could leave a ring",
         [](S s) { return s.who + " has no partial veil that could leave a ring"; }},
        {"/ornaments/volva", wished(asked.ornaments.volva), [](S s) { return s.has_volva(); },
         "has a universal veil that could leave a volva",
         [](S s) { return s.who + " has no universal veil that could leave a volva"; }},
        {"/weathering/waves", wished(asked.weathering.waves), [](S s) { return s.has_margin(); },
         "has a margin that could wave",
         [](S s) { return s.who + " has no margin that could wave"; }},
        {"/weathering/deliquescence", wished(asked.weathering.deliquescence),
         [](S s) { return s.melts(); }, "is an inkcap, whose cap melts into ink",
         [](S s) { return s.who + " is no inkcap; only their caps melt into ink"; }},
        {"/weathering/splits", wished(asked.weathering.splits), [](S s) { return s.has_margin(); },
         "has a margin that could split",
         [](S s) { return s.who + " has no margin that could split"; }},
        {"/weathering/peel", wished(asked.weathering.peel), [](S s) { return s.peels(); },
         "has a skin that peels off",
         [](S s) {
             return s.who + (s.has_margin() ? " has a skin that does not peel off"
                                            : " has no margin from which a skin could peel off");
         }},
    };
    std::vector<Problem> problems;
    for (const AnatomyRule& rule : rules)
        if (rule.asked && std::none_of(sources.begin(), sources.end(), rule.can))
            report(problems, rule.path,
                   sources.size() > 1 ? std::string("no species of this mix ") + rule.wants
                                      : rule.why(sources.front()));
    if (!problems.empty()) throw Impossible(std::move(problems));
}

/// Amounts that only some species of a mix can have: those of these species alone.
void blend_amounts(Model& model, const std::vector<Source>& sources) {
    const auto blend_among = [&](auto counts, auto of, double& to) {
        to = among(sources, counts, of);
    };
    using S = const Source&;
    using D = const double&;
    blend_among([](S s) { return s.first().warts.count > 0; },
                [](S s) -> D { return s.now.ornaments.warts; }, model.ornaments.warts);
    blend_among([](S s) { return s.first().scales.count > 0; },
                [](S s) -> D { return s.now.ornaments.scales; }, model.ornaments.scales);
    blend_among([](S s) { return s.has_ring(); }, [](S s) -> D { return s.now.ornaments.ring; },
                model.ornaments.ring);
    blend_among([](S s) { return s.has_volva(); }, [](S s) -> D { return s.now.ornaments.volva; },
                model.ornaments.volva);
    blend_among([](S s) { return s.pattern() == HymeniumPattern::ridges; },
                [](S s) -> D { return s.now.hymenium.forking; }, model.hymenium.forking);
    blend_among([](S s) { return s.has_cells(); },
                [](S s) -> D { return s.now.hymenium.pores_per_mm; }, model.hymenium.pores_per_mm);
    blend_among([](S s) { return s.melts(); },
                [](S s) -> D { return s.now.weathering.deliquescence; },
                model.weathering.deliquescence);
    blend_among([](S s) { return s.has_margin(); },
                [](S s) -> D { return s.now.weathering.splits; }, model.weathering.splits);
    blend_among([](S s) { return s.peels(); }, [](S s) -> D { return s.now.weathering.peel; },
                model.weathering.peel);
    blend_among([](S s) { return s.pattern() == HymeniumPattern::pores; },
                [](S s) -> D { return s.now.hymenium.elongation; }, model.hymenium.elongation);
    blend_among([](S s) { return s.has_blades(); },
                [](S s) -> D { return s.now.hymenium.edge_waves; }, model.hymenium.edge_waves);
    blend_among([](S s) { return s.has_blades() || s.pattern() == HymeniumPattern::teeth; },
                [](S s) -> D { return s.now.hymenium.thickness; }, model.hymenium.thickness);
    using H = HymeniumOf<Plain>;
    for (double H::*const part :
         {&H::depth, &H::inner_gap, &H::inner_depth, &H::notch, &H::decurrent})
        blend_among([](S s) { return s.pattern() != HymeniumPattern::smooth; },
                    [part](S s) -> D { return s.now.hymenium.*part; }, model.hymenium.*part);
}

/// The same amounts as overrides: what the individual really has.
void report_effective(MushroomParams& effective, const Model& model,
                      const std::vector<Source>& sources) {
    const auto set = [](auto& to, const auto& from) {
        using To = std::remove_cvref_t<decltype(to)>;
        using From = std::remove_cvref_t<decltype(from)>;
        std::size_t i = 0;
        To::fields([&](auto to_member, const Info&) {
            std::size_t j = 0;
            From::fields([&](auto from_member, const Info&) {
                if constexpr (requires { to.*to_member = from.*from_member; })
                    if (i == j) to.*to_member = from.*from_member;
                ++j;
            });
            ++i;
        });
    };
    set(effective.deformation, model.deformation);
    set(effective.ornaments, model.ornaments);
    set(effective.hymenium, model.hymenium);
    set(effective.weathering, model.weathering);
    const auto none = [&](auto has) { return std::none_of(sources.begin(), sources.end(), has); };
    HymeniumOf<Maybe>& hymenium = effective.hymenium;
    if (none([](const Source& s) { return s.has_cells(); })) hymenium.pores_per_mm.reset();
    if (none([](const Source& s) { return s.pattern() == HymeniumPattern::pores; }))
        hymenium.elongation.reset();
    if (none([](const Source& s) { return s.has_blades(); })) {
        hymenium.blades.reset();
        hymenium.tiers.reset();
        hymenium.edge_waves.reset();
    }
    if (none([](const Source& s) {
            return s.has_blades() || s.pattern() == HymeniumPattern::teeth;
        }))
        hymenium.thickness.reset();
    if (none([](const Source& s) { return s.pattern() != HymeniumPattern::smooth; })) {
        hymenium.depth.reset();
        hymenium.inner_gap.reset();
        hymenium.inner_depth.reset();
        hymenium.notch.reset();
        hymenium.decurrent.reset();
    }
    if (none([](const Source& s) { return s.has_margin(); })) effective.weathering.waves.reset();
    if (none([](const Source& s) { return s.pattern() == HymeniumPattern::ridges; }))
        effective.hymenium.forking.reset();
    if (none([](const Source& s) { return s.first().warts.count > 0; }))
        effective.ornaments.warts.reset();
    if (none([](const Source& s) { return s.first().scales.count > 0; }))
        effective.ornaments.scales.reset();
    if (none([](const Source& s) { return s.has_ring(); })) effective.ornaments.ring.reset();
    if (none([](const Source& s) { return s.has_volva(); })) effective.ornaments.volva.reset();
    if (none([](const Source& s) { return s.melts(); })) effective.weathering.deliquescence.reset();
    if (none([](const Source& s) { return s.has_margin(); })) effective.weathering.splits.reset();
    if (none([](const Source& s) { return s.peels(); })) effective.weathering.peel.reset();
}

/// Rows of a species' spines, or of pores so coarse that they are solids: by its template when it is mature, so that no age has
/// others. They grow with the mushroom.
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
    // Long pores are fewer along the meridian: as on a shorter one.
    const double area = pi * (inner + far) * arc;
    if (area * per_metre * per_metre / source.now.hymenium.elongation > 1.1 * most_pores) return {};
    return cell_rows(arc / source.now.hymenium.elongation, inner, far, per_metre, most_pores);
}

/// What no weight and no age may change of the solids on the lower face.
void stand_hymenium(Individual& individual, const MushroomParams& asked,
                    const std::vector<Source>& sources) {
    individual.blade_tiers = individual.comb.tiers;
    for (const Source& source : sources) {
        if (!source.has_blades()) continue;
        individual.runs_down =
            individual.runs_down || wished(asked.hymenium.decurrent) ||
            std::any_of(source.stages.begin(), source.stages.end(),
                        [](const Model* stage) { return stage->hymenium.decurrent > 0.0; });
        // Each ridge may fork, and each of its forks.
        if (source.pattern() == HymeniumPattern::ridges)
            while (individual.comb.blades << individual.blade_tiers <
                   4 * source.now.hymenium.blades)
                ++individual.blade_tiers;
    }
}

void overlay_all(const MushroomParams& asked, Model& model) {
    overlay(asked.deformation, model.deformation);
    overlay(asked.ornaments, model.ornaments);
    overlay(asked.hymenium, model.hymenium);
    overlay(asked.weathering, model.weathering);
}

}  // namespace

Individual resolve(const MushroomOrder& order, const Atlas& atlas,
                   const Remember<MorphSet>& morphs) {
    const MushroomParams& asked = order.params;
    std::vector<Problem> problems;
    check(asked, Info{.name = ""}, "", problems);
    if (order.model) check(*order.model, Info{.name = ""}, "/model", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    if (order.model && asked.animation == Animation::growth)
        throw Impossible("/animation", "a model of your own has no stages to grow through");

    std::vector<Source> sources = sources_of(order, atlas);
    if (!order.arcs.empty() && sources.size() != 2)
        throw InvalidInput("/arcs",
                           "arcs link two species; this mix has " + std::to_string(sources.size()));
    check_anatomy(asked, sources);
    // Arcs name the species in the order of the mix; from here on species stand by id.
    std::vector<Arc> arcs = order.arcs;
    if (!arcs.empty() && order.mix[0].id != sources[0].id)
        for (Arc& arc : arcs) std::swap(arc.a, arc.b);

    Individual individual;
    individual.effective = asked;
    const auto everyone = [](const Source&) { return true; };
    const Spread spread =
        among(sources, everyone, [](const Source& s) -> const Spread& { return s.spread; });
    Model& model = individual.model;
    model = among(sources, everyone, [](const Source& s) -> const Model& { return s.now; });
    model.shape = Swept{};

    // The outline: shapes are blended in unit size, sizes by their ratio.
    const Draws draws = draws_of(asked.seed);
    const double variation = asked.variation;
    double size = 0.0, open = 0.0;
    for (const Source& source : sources) {
        size += source.weight * logarithm(source.size);
        if (source.has_margin()) open += source.weight;
    }
    size = (sources.size() == 1 ? sources.front().size : exponential(size)) * asked.size *
           factor(draws.size, spread.size, variation);
    individual.set = morph_set(sources, arcs, asked.age, morphs);
    individual.has_relief = std::any_of(sources.begin(), sources.end(), has_relief);
    const auto own = [&](double share) {
        return Proportions{factor(draws.stem_length, spread.stem_length, share * variation),
                           factor(draws.stem_width, spread.stem_width, share * variation),
                           factor(draws.cap_height, spread.cap_height, share * variation)};
    };
    individual.outline =
        own_outline(individual.set->nodes(shape_weights(sources)), individual.set->places(), own,
                    open, size, individual.has_relief);
    if (const auto fault = fault_of(individual.outline, asked.lod))
        throw Impossible(order.model ? std::string("/model/silhouette/") + name(*fault) : "mix",
                         "the outline crosses itself at this level of detail, near the " +
                             std::string(name(*fault)));
    const auto stem = individual.outline.rings(CurveName::stem, 0);
    individual.stem_base = stem.front().y;
    individual.stem_top = stem.back().y;
    individual.lightness = factor(draws.lightness, spread.lightness, variation);

    // The axis and its deformation. An individual bends as far as its own stem allows; what a person asks for, or draws, is
    // checked by build instead.
    const double slender = std::max(individual.stem_top - individual.stem_base, 1e-4) /
                           greatest_radius(individual.outline.stem);
    individual.axis = axis_of(sources);
    individual.azimuth = fan_of(sources);
    individual.lobes = lobes_of(sources);
    individual.reliefs = reliefs_of(sources);
    DeformationOf<Plain>& deformation = model.deformation;
    if (!order.model) {
        const double fold = individual.axis.greatest_turn() / slender;
        if (fold > most_natural_fold)
            individual.axis = individual.axis.scaled(most_natural_fold / fold);
        const double zone = (deformation.zone_to - deformation.zone_from) * slender * (180.0 / pi);
        const double room = std::min(0.6, (0.95 - std::min(fold, most_natural_fold)) / 1.5);
        const double of_template = std::min(deformation.bend_deg, 1.5 * room * zone);
        const double drawn = deformation.bend_deg + draws.bend * spread.bend_deg * variation;
        deformation.bend_deg = std::min({90.0, drawn, std::max(of_template, room * zone)});
    }
    deformation.lean_deg =
        std::min(45.0, deformation.lean_deg + draws.lean * spread.lean_deg * variation);
    deformation.imperfection = std::min(
        1.0, deformation.imperfection + draws.imperfection * spread.imperfection * variation);

    // What was asked holds for every species that can have it.
    for (Source& source : sources) overlay_all(asked, source.now);
    blend_amounts(model, sources);
    overlay_all(asked, model);
    model.deformation.check("/deformation", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));

    if (model.weathering.cracks > 0.0)
        individual.radial_strain = strain_of(*individual.set, sources);
    individual.wear = wear_of(sources, asked.weathering);
    individual.layers = layers_of(sources, *individual.set);
    using Amounts = OrnamentsOf<Plain>;
    individual.ring = shell_of(sources, &Model::ring, &RingStyle::width, &Amounts::ring, size);
    individual.sac = shell_of(sources, &Model::sac, &SacStyle::height, &Amounts::volva, size);
    for (const Source& source : sources) {
        individual.has_ring = individual.has_ring || source.has_ring();
        individual.has_sac = individual.has_sac || source.has_sac();
        if (source.has_margin()) individual.waves += source.weight * source.now.weathering.waves;
        const Comb comb{source.now.hymenium.blades, source.now.hymenium.tiers};
        if (source.has_blades() && comb.at_margin() > individual.comb.at_margin())
            individual.comb = comb;
    }
    stand_hymenium(individual, asked, sources);
    if (individual.comb.blades > 0) {
        model.hymenium.blades = individual.comb.blades;
        model.hymenium.tiers = individual.comb.tiers;
    }
    report_effective(individual.effective, model, sources);
    for (Source& source : sources) {
        const CellRows cells = cells_of(source);
        individual.parts.push_back({source.id, source.weight, std::move(source.now), cells});
    }
    return individual;
}

SpeciesShapes species_shapes(const MushroomOrder& order, const Atlas& atlas,
                             const Remember<MorphSet>& morphs) {
    std::vector<Problem> problems;
    check(order.params, Info{.name = ""}, "", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    const std::vector<Source> sources = sources_of(order, atlas);
    SpeciesShapes shapes;
    shapes.set = morph_set(sources, {}, order.params.age, morphs);
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
