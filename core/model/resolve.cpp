#include "core/model/resolve.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/params/blend.h"

namespace sporeprint {

namespace {

constexpr std::uint32_t variation_purpose = 0;

/// The individual's own draws, -1..1 or 0..1. Drawn in a fixed order; a new one goes last.
struct Draws {
    double size, stem_length, stem_width, cap_height, bend, lean, imperfection, lightness;
};

Draws draws_of(std::uint32_t seed) {
    Random random(seed, variation_purpose);
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

Model model_at(const Species& species, double age) {
    const auto& stages = species.stages;
    if (age <= stages.front().age) return stages.front().model;
    for (std::size_t i = 1; i < stages.size(); ++i)
        if (age <= stages[i].age)
            return blend(stages[i - 1].model, stages[i].model,
                         (age - stages[i - 1].age) / (stages[i].age - stages[i - 1].age));
    return stages.back().model;
}

double factor(double draw, double spread, double variation) {
    return exponential(draw * spread * variation);
}

/// Stem longer and wider, cap higher over its margin; the junction and the margin stay joined.
void proportion(Silhouette& s, double longer, double wider, double higher) {
    const OutlinePoint junction = s.stem.back();
    const double lift = (longer - 1.0) * std::max(junction.y, 0.0);
    const OutlinePoint margin = s.hymenium.empty() ? junction : s.hymenium.back();
    // What hugs the stem widens with it; further out the change dies away, so that an open cap keeps its diameter.
    double stem = 0.0;
    for (const OutlinePoint& p : s.stem)
        if (p.y >= margin.y || p.r == junction.r) stem = std::max(stem, p.r);
    const auto width_at = [&](double r) {
        const double share =
            s.hymenium.empty() ? 0.0 : std::clamp((r - stem) / (2.0 * stem), 0.0, 1.0);
        return 1.0 + (wider - 1.0) * (1.0 - share);
    };
    for (OutlinePoint& p : s.stem) p = {p.r * wider, p.y > 0.0 ? p.y * longer : p.y};
    for (OutlinePoint& p : s.hymenium) p = {p.r * width_at(p.r), p.y + lift};
    for (OutlinePoint& p : s.cap)
        p = {p.r * width_at(p.r), margin.y + lift + (p.y - margin.y) * higher};
    if (!s.hymenium.empty()) {
        s.hymenium.front() = s.stem.back();
        s.cap.front() = s.hymenium.back();
    } else {
        s.cap.front() = s.stem.back();
    }
}

void scale(Model& model, Swept& shape, double by) {
    for (auto* part : {&shape.silhouette.stem, &shape.silhouette.hymenium, &shape.silhouette.cap})
        for (OutlinePoint& p : *part) p = {p.r * by, p.y * by};
    model.ring.width *= by;
    model.ring.thickness *= by;
}

/// Largest bend that this stem can take without folding, degrees.
double bend_limit(const Swept& shape, const DeformationOf<Plain>& deformation) {
    double radius = 1e-6;
    for (const OutlinePoint& p : shape.silhouette.stem) radius = std::max(radius, p.r);
    const double length = shape.silhouette.stem.back().y - shape.silhouette.stem.front().y;
    return 0.6 * (deformation.zone_to - deformation.zone_from) * length / radius * (180.0 / pi);
}

/// What a species cannot have, in words.
void check_anatomy(const MushroomParams& asked, const Model& model, const std::string& who) {
    std::vector<Problem> problems;
    const auto refuse = [&](const char* path, const std::string& why) {
        report(problems, path, why);
    };
    const HymeniumPattern pattern = model.surface.hymenium.pattern;
    const bool blades = pattern == HymeniumPattern::gills || pattern == HymeniumPattern::ridges;
    const std::string carries =
        pattern == HymeniumPattern::pores    ? who + " carries pores, not gills"
        : pattern == HymeniumPattern::gills  ? who + " carries gills, not pores"
        : pattern == HymeniumPattern::ridges ? who + " carries ridges, not pores"
                                             : who + " has a smooth lower face";
    if (asked.hymenium.blades && !blades) refuse("/hymenium/blades", carries);
    if (asked.hymenium.tiers && !blades) refuse("/hymenium/tiers", carries);
    if (asked.hymenium.forking && *asked.hymenium.forking > 0.0 &&
        pattern != HymeniumPattern::ridges)
        refuse("/hymenium/forking", pattern == HymeniumPattern::gills
                                        ? who + " carries gills, which do not fork; ridges do"
                                        : carries);
    if (asked.hymenium.pores_per_mm && pattern != HymeniumPattern::pores)
        refuse("/hymenium/pores_per_mm", carries);
    if (asked.ornaments.warts && *asked.ornaments.warts > 0.0 && model.warts.count == 0)
        refuse("/ornaments/warts", who + " has no universal veil that could leave warts");
    if (asked.ornaments.scales && *asked.ornaments.scales > 0.0 && model.scales.count == 0)
        refuse("/ornaments/scales", who + " has a skin that does not tear into scales");
    if (asked.ornaments.ring && *asked.ornaments.ring > 0.0 && model.ring.width == 0.0)
        refuse("/ornaments/ring", who + " has no partial veil that could leave a ring");
    if (!problems.empty()) throw Impossible(std::move(problems));
}

/// The same amounts as overrides: what the individual really has.
void report_effective(MushroomParams& effective, const Model& model) {
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
    const HymeniumPattern pattern = model.surface.hymenium.pattern;
    if (pattern != HymeniumPattern::pores) effective.hymenium.pores_per_mm.reset();
    if (pattern == HymeniumPattern::pores || pattern == HymeniumPattern::smooth) {
        effective.hymenium.blades.reset();
        effective.hymenium.tiers.reset();
    }
    if (pattern != HymeniumPattern::ridges) effective.hymenium.forking.reset();
    if (model.warts.count == 0) effective.ornaments.warts.reset();
    if (model.scales.count == 0) effective.ornaments.scales.reset();
    if (model.ring.width == 0.0) effective.ornaments.ring.reset();
}

}  // namespace

Individual resolve(const MushroomOrder& order, const Atlas& atlas) {
    const MushroomParams& asked = order.params;
    std::vector<Problem> problems;
    check(asked, Info{.name = ""}, "", problems);
    if (order.model) check(*order.model, Info{.name = ""}, "/model", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));

    Individual individual;
    individual.effective = asked;
    Spread spread{};
    std::string who = "this model";
    if (order.model) {
        individual.model = *order.model;
        individual.parts.push_back({"", 1.0, *order.model});
        spread = {0, 0, 0, 0, 0, 0, 0, 0};
    } else {
        if (order.mix.size() != 1)
            throw Impossible("mix", std::to_string(order.mix.size()) +
                                        " species; this version grows one species at a time");
        const AtlasEntry* entry = atlas.find(order.mix.front().id);
        if (!entry)
            throw InvalidInput("mix", "'" + order.mix.front().id + "' is no species of the atlas");
        individual.model = model_at(entry->species, asked.age);
        individual.parts.push_back({order.mix.front().id, 1.0, individual.model});
        spread = entry->species.spread;
        who = entry->species.facts.scientific_name.string();
    }
    Model& model = individual.model;
    check_anatomy(asked, model, who);

    const Draws draws = draws_of(asked.seed);
    const double variation = asked.variation;
    Swept& shape = std::get<Swept>(model.shape);
    proportion(shape.silhouette, factor(draws.stem_length, spread.stem_length, variation),
               factor(draws.stem_width, spread.stem_width, variation),
               factor(draws.cap_height, spread.cap_height, variation));
    scale(model, shape, asked.size * factor(draws.size, spread.size, variation));
    individual.lightness = factor(draws.lightness, spread.lightness, variation);

    DeformationOf<Plain>& deformation = model.deformation;
    // An individual bends as far as its own stem allows; what a person asks for is checked by build instead.
    const double own_bend = deformation.bend_deg + draws.bend * spread.bend_deg * variation;
    deformation.bend_deg =
        std::clamp(own_bend, 0.0,
                   std::min(90.0, std::max(deformation.bend_deg, bend_limit(shape, deformation))));
    deformation.lean_deg =
        std::min(45.0, deformation.lean_deg + draws.lean * spread.lean_deg * variation);
    deformation.imperfection = std::min(
        1.0, deformation.imperfection + draws.imperfection * spread.imperfection * variation);
    overlay(asked.deformation, model.deformation);
    overlay(asked.ornaments, model.ornaments);
    overlay(asked.hymenium, model.hymenium);
    overlay(asked.weathering, model.weathering);
    for (SpeciesShare& part : individual.parts) {
        overlay(asked.deformation, part.model.deformation);
        overlay(asked.ornaments, part.model.ornaments);
        overlay(asked.hymenium, part.model.hymenium);
        overlay(asked.weathering, part.model.weathering);
    }
    model.deformation.check("/deformation", problems);
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    report_effective(individual.effective, model);
    return individual;
}

}  // namespace sporeprint
