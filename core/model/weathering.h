// Weathering amounts from 0 to 1.
#pragma once

#include "core/params/describe.h"
#include "core/params/types.h"

namespace sporeprint {

/// Amounts of damage by age, weather, animals and handling, 0..1. The positions of damage depend on
/// the seed, not on the amounts; a greater amount opens, deepens and spreads the damage there.
///
/// M  Plain in a resolved model, Maybe (std::optional) for the overrides of a request
template <template <class> class M>
struct WeatheringOf {
    M<double> cracks{};
    M<double> creases{};
    M<double> peel{};
    M<double> splits{};
    M<double> bites{};
    M<double> bumps{};
    M<double> waves{};
    M<double> deliquescence{};
    M<double> fade{};
    M<double> bruise{};
    M<double> dust{};
    M<double> dew{};
    M<double> wetness{};

    static constexpr void fields(auto visit) {
        using W = WeatheringOf;
        visit(&W::cracks, Info{.name = "cracks",
                               .min = 0,
                               .max = 1,
                               .doc = "Dry skin torn open down to the flesh: a net of islands, or "
                                      "splits from the margin inwards where the cap has spread."});
        visit(&W::creases, Info{.name = "creases",
                                .min = 0,
                                .max = 1,
                                .doc = "Lengthwise furrows of a drying stem; the deepest split."});
        visit(&W::peel, Info{.name = "peel",
                             .min = 0,
                             .max = 1,
                             .doc = "Skin come off from the margin inwards, its border rolled up "
                                    "over the flesh."});
        visit(&W::splits,
              Info{.name = "splits",
                   .min = 0,
                   .max = 1,
                   .doc = "Tears of the margin through cap and lower face, towards the stem."});
        visit(&W::bites, Info{.name = "bites",
                              .min = 0,
                              .max = 1,
                              .doc = "What slugs have eaten: arcs out of the margin, shallow pits "
                                     "in cap and stem."});
        visit(&W::bumps,
              Info{.name = "bumps", .min = 0, .max = 1, .doc = "Lumps and hollows of the skin."});
        visit(&W::waves,
              Info{.name = "waves",
                   .min = 0,
                   .max = 1,
                   .doc = "Waves of the margin, which has grown longer than its circle."});
        visit(&W::deliquescence,
              Info{.name = "deliquescence",
                   .min = 0,
                   .max = 1,
                   .doc = "How far the cap of an inkcap has melted from the margin into black "
                          "ink, on top of its age."});
        visit(&W::fade,
              Info{.name = "fade", .min = 0, .max = 1, .doc = "Bleaching by sun and rain."});
        visit(&W::bruise, Info{.name = "bruise",
                               .min = 0,
                               .max = 1,
                               .doc = "Stains where it was handled, in the species' own colour."});
        visit(&W::dust, Info{.name = "dust",
                             .min = 0,
                             .max = 1,
                             .doc = "Spores that have settled on stem, ring and cap, in the colour "
                                    "of the spore print."});
        visit(&W::dew, Info{.name = "dew", .min = 0, .max = 1, .doc = "Drops of water."});
        visit(&W::wetness, Info{.name = "wetness",
                                .min = 0,
                                .max = 1,
                                .doc = "A film of water: darker and glossier."});
    }
    bool operator==(const WeatheringOf&) const = default;
};

/// The painted part of the weathering: all but the waves of the margin.
template <template <class> class M>
struct PaintedWeathering {
    M<double> cracks{}, creases{}, peel{}, splits{}, bites{}, bumps{}, deliquescence{}, fade{},
        bruise{}, dust{}, dew{}, wetness{};

    static constexpr void fields(auto visit) {
        using P = PaintedWeathering;
        using W = WeatheringOf<M>;
        visit(&P::cracks, info_of<W>("cracks"));
        visit(&P::creases, info_of<W>("creases"));
        visit(&P::peel, info_of<W>("peel"));
        visit(&P::splits, info_of<W>("splits"));
        visit(&P::bites, info_of<W>("bites"));
        visit(&P::bumps, info_of<W>("bumps"));
        visit(&P::deliquescence, info_of<W>("deliquescence"));
        visit(&P::fade, info_of<W>("fade"));
        visit(&P::bruise, info_of<W>("bruise"));
        visit(&P::dust, info_of<W>("dust"));
        visit(&P::dew, info_of<W>("dew"));
        visit(&P::wetness, info_of<W>("wetness"));
    }
    bool operator==(const PaintedWeathering&) const = default;
};

/// Returns the amounts that painting uses.
template <template <class> class M>
[[nodiscard]] PaintedWeathering<M> painted_of(const WeatheringOf<M>& w) {
    return {w.cracks,        w.creases, w.peel,   w.splits, w.bites, w.bumps,
            w.deliquescence, w.fade,    w.bruise, w.dust,   w.dew,   w.wetness};
}

/// Returns the same amounts as WeatheringOf; the waves have their default.
template <template <class> class M>
[[nodiscard]] WeatheringOf<M> as_weathering(const PaintedWeathering<M>& p) {
    WeatheringOf<M> w;
    w.cracks = p.cracks;
    w.creases = p.creases;
    w.peel = p.peel;
    w.splits = p.splits;
    w.bites = p.bites;
    w.bumps = p.bumps;
    w.deliquescence = p.deliquescence;
    w.fade = p.fade;
    w.bruise = p.bruise;
    w.dust = p.dust;
    w.dew = p.dew;
    w.wetness = p.wetness;
    return w;
}

}  // namespace sporeprint
