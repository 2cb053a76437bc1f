// One individual: an order with everything decided. What is swept, deformed, ornamented and painted reads from here.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/individual/axis_curve.h"
#include "core/individual/branch_graph.h"
#include "core/individual/gill_layout.h"
#include "core/individual/mushroom_spec.h"
#include "core/individual/patches.h"
#include "core/silhouette/morph_set.h"

namespace sporeprint {

/// One species of an individual, or its own Model (`id` empty).
struct SpeciesShare {
    std::string id;
    double weight = 1.0;  ///< weights of an individual sum to 1
    Model model;          ///< the species' own at this age, overrides applied: what is painted
    CellRows cells;       ///< of its spines, whatever the age
};

/// The torn pieces that one species brings to an individual. Species whose pieces have equal places share a layer.
struct PatchLayer {
    std::uint32_t purpose = 0;  ///< purposes::warts or another kind of piece
    PatchStyle style;           ///< places are drawn from it, whatever the weight
    double amount = 0.0;        ///< of the veil or skin: 0..1
    double weight = 1.0;        ///< of the species in the mix: factor on the size of every piece
    /// Of pieces on the stem: shares of arc length at which the segments of the mature stem begin, and 1. A piece stays on its
    /// segment, at its share of it.
    std::vector<double> segments{};
    bool operator==(const PatchLayer&) const = default;
};

/// Weathering as geometry knows it: amounts times the weight of the species that can have them, and what can occur at some age,
/// so that no age changes the number of vertices.
struct Wear {
    WeatheringOf<Plain> amounts;
    double clubs = 0.0;  ///< weight of the species without a margin
    bool bites = false, splits = false, melts = false, peels = false, dew = false;

    [[nodiscard]] bool any() const { return !(amounts == WeatheringOf<Plain>{}); }
};

/// An order with everything decided: what `resolve` answers.
struct Individual {
    Model
        model;  ///< all amounts and sizes, blended; its shape is empty: `outline` and `axis` are the individual's own
    MushroomParams
        effective;  ///< every optional that a species of the mix can have, set to what the individual really has
    double size = 0.0;       ///< of a swept one: what shapes of unit size are multiplied by, metres
    double lightness = 1.0;  ///< factor on the linear colour of the cap
    std::vector<SpeciesShare> parts;  ///< by id
    std::shared_ptr<const MorphSet>
        set;                 ///< of all control shapes of its swept species; knows what is proven
    Bush bush;               ///< of the branched family; what follows is then empty
    Outline outline;         ///< metres; proportions and size of the individual
    double stem_base = 0.0;  ///< height of the first point of the stem, metres
    double stem_top = 0.0;   ///< of its last
    double radial_strain =
        0.0;  ///< how much more the cap has grown round the axis than along its meridian, 0..1
    AxisCurve axis;
    Azimuth azimuth;             ///< its fan; what it says of lobes does not count
    std::vector<Azimuth> lobes;  ///< those of each species, as deep as it weighs
    std::vector<ReliefStyle>
        reliefs;  ///< of the upper face, that of each species as deep as it weighs
    std::vector<PatchLayer>
        layers;    ///< warts, scales and volvas of all species, also those of which nothing is left
    SacStyle sac;  ///< its height holds amounts and weights; metres
    bool has_sac = false;   ///< whether a species of the mix can have one at some age
    RingStyle ring;         ///< its width holds amounts and weights; metres
    bool has_ring = false;  ///< whether a species of the mix can have one at some age
    double waves = 0.0;     ///< of the margin: what no species with a margin has, none can show
    Wear wear;
    Comb comb;
    int blade_tiers = 0;  ///< solids of blades stand on comb.blades << blade_tiers places
    bool runs_down =
        false;  ///< whether blades of a species of the mix run down the stem at some age

    [[nodiscard]] bool is_branched() const { return !bush.empty(); }
};

}  // namespace sporeprint
