#include "core/individual/anatomy.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <type_traits>

#include "core/problems.h"

namespace sporeprint {

namespace {

/// Returns the name of what a lower face carries, for messages.
const char* carried(HymeniumPattern pattern) {
    return pattern == HymeniumPattern::smooth ? "a smooth face" : name(pattern);
}

/// One rule of anatomy: the override that it concerns, which sources can have it, and the message
/// if none can.
struct AnatomyRule {
    const char* path;
    bool requested;
    bool (*can)(const Source&);
    const char* wants;  ///< "gills or ridges": what a mix lacks
    std::string (*why)(const Source&);
};

/// Returns the message that says why a single species carries no `wanted`.
std::string carries_instead(const Source& s, const std::string& wanted) {
    if (s.pattern() != HymeniumPattern::smooth)
        return s.label + " carries " + carried(s.pattern()) + ", not " + wanted;
    return s.has_margin()
               ? s.label + " has a smooth lower face, without " + wanted
               : s.label + " is smooth all over; it has no lower face that could carry " + wanted;
}

/// Returns the rules, one for each override that some species cannot have. One function, because
/// it is a table: a row is a rule.
std::vector<AnatomyRule> anatomy_rules(const MushroomParams& requested) {
    using S = const Source&;
    using Pattern = HymeniumPattern;
    const HymeniumOf<Maybe>& h = requested.hymenium;
    const auto bladed = [](S s) { return s.has_blades(); };
    const auto no_gills = [](S s) { return carries_instead(s, "gills"); };
    const auto carrying = [](S s) { return s.pattern() != Pattern::smooth; };
    const auto nothing_deep = [](S s) { return carries_instead(s, "gills, pores or teeth"); };
    return {
        {"/deformation/irregularity", is_requested(requested.deformation.irregularity),
         [](S s) { return !s.is_branched(); }, "has a cap or a single body",
         [](S s) { return s.label + " branches; its limbs are uneven as its model says"; }},
        {"/hymenium/blades", h.blades.has_value(), bladed, "carries gills or ridges", no_gills},
        {"/hymenium/tiers", h.tiers.has_value(), bladed, "carries gills or ridges", no_gills},
        {"/hymenium/edge_waves", is_requested(h.edge_waves), bladed, "carries gills or ridges",
         no_gills},
        {"/hymenium/thickness", h.thickness.has_value(),
         [](S s) { return s.has_blades() || s.pattern() == Pattern::teeth; },
         "carries gills, ridges or teeth", no_gills},
        {"/hymenium/forking", is_requested(h.forking),
         [](S s) { return s.pattern() == Pattern::ridges; }, "carries ridges, which fork",
         [](S s) {
             return s.pattern() == Pattern::gills
                        ? s.label + " carries gills, which do not fork; ridges do"
                        : carries_instead(s, "ridges");
         }},
        {"/hymenium/pores_per_mm", h.pores_per_mm.has_value(), [](S s) { return s.has_cells(); },
         "carries pores or teeth", [](S s) { return carries_instead(s, "pores"); }},
        {"/hymenium/elongation", h.elongation.has_value(),
         [](S s) { return s.pattern() == Pattern::pores; }, "carries pores",
         [](S s) { return carries_instead(s, "pores"); }},
        {"/hymenium/depth", is_requested(h.depth), carrying, "carries gills, pores or teeth",
         nothing_deep},
        {"/hymenium/inner_gap", is_requested(h.inner_gap), carrying,
         "carries gills, pores or teeth", nothing_deep},
        {"/hymenium/inner_depth", h.inner_depth.has_value(), carrying,
         "carries gills, pores or teeth", nothing_deep},
        {"/hymenium/notch", is_requested(h.notch), carrying, "carries gills, pores or teeth",
         nothing_deep},
        {"/hymenium/decurrent", is_requested(h.decurrent), carrying,
         "carries gills, pores or teeth", nothing_deep},
        {"/ornaments/warts", is_requested(requested.ornaments.warts),
         [](S s) { return s.first().warts.count > 0; },
         "has a universal veil that could leave warts",
         [](S s) {
             return s.label + (s.has_margin() ? " has no universal veil that could leave warts"
                                              : " has no cap skin that could carry warts, and no "
                                                "universal veil that could leave them");
         }},
        {"/ornaments/scales", is_requested(requested.ornaments.scales),
         [](S s) { return s.first().scales.count > 0; }, "has a skin that tears into scales",
         [](S s) {
             return s.label + (s.has_margin() ? " has a skin that does not tear into scales"
                                              : " has no cap skin that could tear into scales");
         }},
        {"/ornaments/ring", is_requested(requested.ornaments.ring),
         [](S s) { return s.has_ring(); }, "has a partial veil that could leave a ring",
         [](S s) { return s.label + " has no partial veil that could leave a ring"; }},
        {"/ornaments/volva", is_requested(requested.ornaments.volva),
         [](S s) { return s.has_volva(); }, "has a universal veil that could leave a volva",
         [](S s) { return s.label + " has no universal veil that could leave a volva"; }},
        {"/ornaments/peridioles", is_requested(requested.ornaments.peridioles),
         [](S s) { return s.has_peridioles(); }, "is a bird's nest, in which peridioles lie",
         [](S s) { return s.label + " is no bird's nest; only in them peridioles lie"; }},
        {"/ornaments/receptacle", is_requested(requested.ornaments.receptacle),
         [](S s) { return s.has_receptacle(); }, "is a cage fungus, whose receptacle unfolds",
         [](S s) { return s.label + " is no cage fungus; only their receptacle unfolds"; }},
        {"/weathering/waves", is_requested(requested.weathering.waves),
         [](S s) { return s.has_margin(); }, "has a margin that could wave",
         [](S s) { return s.label + " has no margin that could wave"; }},
        {"/weathering/deliquescence", is_requested(requested.weathering.deliquescence),
         [](S s) { return s.melts(); }, "is an inkcap, whose cap melts into ink",
         [](S s) { return s.label + " is no inkcap; only their caps melt into ink"; }},
        {"/weathering/splits", is_requested(requested.weathering.splits),
         [](S s) { return s.has_margin(); }, "has a margin that could split",
         [](S s) { return s.label + " has no margin that could split"; }},
        {"/weathering/peel", is_requested(requested.weathering.peel), [](S s) { return s.peels(); },
         "has a skin that peels off",
         [](S s) {
             return s.label + (s.has_margin() ? " has a skin that does not peel off"
                                              : " has no margin from which a skin could peel off");
         }},
    };
}

}  // namespace

void check_anatomy(const MushroomParams& requested, const std::vector<Source>& sources) {
    std::vector<Problem> problems;
    for (const AnatomyRule& rule : anatomy_rules(requested))
        if (rule.requested && std::none_of(sources.begin(), sources.end(), rule.can))
            report(problems, rule.path,
                   sources.size() > 1 ? std::string("no species of this mix ") + rule.wants
                                      : rule.why(sources.front()));
    if (!problems.empty()) throw Impossible(std::move(problems));
}

void blend_amounts(Model& model, const std::vector<Source>& sources) {
    const auto set = [&](auto counts, auto of, double& to) {
        to = blend_among(sources, counts, of);
    };
    using S = const Source&;
    using D = const double&;
    set([](S s) { return s.first().warts.count > 0; },
        [](S s) -> D { return s.now.ornaments.warts; }, model.ornaments.warts);
    set([](S s) { return s.first().scales.count > 0; },
        [](S s) -> D { return s.now.ornaments.scales; }, model.ornaments.scales);
    set([](S s) { return s.has_ring(); }, [](S s) -> D { return s.now.ornaments.ring; },
        model.ornaments.ring);
    set([](S s) { return s.has_volva(); }, [](S s) -> D { return s.now.ornaments.volva; },
        model.ornaments.volva);
    set([](S s) { return s.has_peridioles(); }, [](S s) -> D { return s.now.ornaments.peridioles; },
        model.ornaments.peridioles);
    set([](S s) { return s.has_receptacle(); }, [](S s) -> D { return s.now.ornaments.receptacle; },
        model.ornaments.receptacle);
    set([](S s) { return s.pattern() == HymeniumPattern::ridges; },
        [](S s) -> D { return s.now.hymenium.forking; }, model.hymenium.forking);
    set([](S s) { return s.has_cells(); }, [](S s) -> D { return s.now.hymenium.pores_per_mm; },
        model.hymenium.pores_per_mm);
    set([](S s) { return s.melts(); }, [](S s) -> D { return s.now.weathering.deliquescence; },
        model.weathering.deliquescence);
    set([](S s) { return s.has_margin(); }, [](S s) -> D { return s.now.weathering.splits; },
        model.weathering.splits);
    set([](S s) { return s.peels(); }, [](S s) -> D { return s.now.weathering.peel; },
        model.weathering.peel);
    set([](S s) { return s.pattern() == HymeniumPattern::pores; },
        [](S s) -> D { return s.now.hymenium.elongation; }, model.hymenium.elongation);
    set([](S s) { return s.has_blades(); }, [](S s) -> D { return s.now.hymenium.edge_waves; },
        model.hymenium.edge_waves);
    set([](S s) { return s.has_blades() || s.pattern() == HymeniumPattern::teeth; },
        [](S s) -> D { return s.now.hymenium.thickness; }, model.hymenium.thickness);
    using H = HymeniumOf<Plain>;
    for (double H::*const part :
         {&H::depth, &H::inner_gap, &H::inner_depth, &H::notch, &H::decurrent})
        set([](S s) { return s.pattern() != HymeniumPattern::smooth; },
            [part](S s) -> D { return s.now.hymenium.*part; }, model.hymenium.*part);
}

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
    if (none([](const Source& s) { return !s.is_branched(); }))
        effective.deformation.irregularity.reset();
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
    if (none([](const Source& s) { return s.has_peridioles(); }))
        effective.ornaments.peridioles.reset();
    if (none([](const Source& s) { return s.has_receptacle(); }))
        effective.ornaments.receptacle.reset();
    if (none([](const Source& s) { return s.melts(); })) effective.weathering.deliquescence.reset();
    if (none([](const Source& s) { return s.has_margin(); })) effective.weathering.splits.reset();
    if (none([](const Source& s) { return s.peels(); })) effective.weathering.peel.reset();
}

}  // namespace sporeprint
