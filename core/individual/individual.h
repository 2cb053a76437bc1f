// A resolved individual: a request with everything decided. Geometry and painting read from it.
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

/// One species of an individual, or a custom Model (`id` empty).
struct SpeciesShare {
    std::string id;
    double weight = 1.0;  ///< weights of an individual sum to 1
    Model model;          ///< of the species at this age, overrides applied; it is what is painted
    CellRows cells;       ///< rows of its spines, independent of the age
};

/// The veil and skin patches of one species. Species whose patches have equal places share a layer.
struct PatchLayer {
    std::uint32_t purpose = 0;  ///< purposes::warts or another kind of patch
    PatchStyle style;           ///< determines the places, independent of the weight
    double amount = 0.0;        ///< of the veil or skin: 0..1
    double weight = 1.0;        ///< of the species in the mix: factor on the size of every patch
    /// For patches on the stem: shares of arc length at which the segments of the mature stem
    /// begin, and 1. A patch stays on its segment, at a constant share of it.
    std::vector<double> segments{};
    bool operator==(const PatchLayer&) const = default;
};

/// Damage by weathering for geometry: amounts times the weight of the species that can have them,
/// and which kinds can occur at any age, so that no age changes the number of vertices.
struct DamageAmounts {
    WeatheringOf<Plain> amounts;
    double clubs = 0.0;  ///< weight of the species without a margin
    bool bites = false, splits = false, melts = false, peels = false, dew = false;

    [[nodiscard]] bool any() const { return !(amounts == WeatheringOf<Plain>{}); }
};

/// The result of `resolve`: a request with everything decided.
struct Individual {
    Model model;  ///< all amounts and sizes, blended; its shape is empty: see `outline` and `axis`
    MushroomParams
        /// every optional that a species of the mix can have, set to the individual's value
        effective;
    /// scale of a swept individual: unit-size shapes are multiplied by it, metres
    double size = 0.0;
    double lightness = 1.0;           ///< factor on the linear colour of the cap
    std::vector<SpeciesShare> parts;  ///< sorted by id
    std::shared_ptr<const MorphSet>
        set;  ///< all control shapes of its swept species, with what is proven about them
    BranchGraph branch_graph;  ///< of the branched family; the members after it are then empty
    Outline outline;           ///< metres; with the proportions and size of the individual
    double stem_base = 0.0;    ///< height of the first point of the stem, metres
    double stem_top = 0.0;     ///< height of the last point of the stem, metres
    double radial_strain =
        0.0;  ///< 0..1: by how much the cap has grown more in circumference than along its meridian
    AxisCurve axis;
    Azimuth azimuth;                   ///< the lateral (fan) part; its lobes are not used
    std::vector<Azimuth> lobes;        ///< one per species with lobes, depth times weight
    std::vector<ReliefStyle> reliefs;  ///< of the upper face, one per form, depth times weight
    std::vector<PatchLayer>
        layers;            ///< warts, scales and volvas of all species, including those of amount 0
    SacStyle sac;          ///< its height includes amounts and weights; metres
    bool has_sac = false;  ///< some species of the mix can have one at some age
    RingStyle ring;        ///< its width includes amounts and weights; metres
    bool has_ring = false;  ///< some species of the mix can have one at some age
    double waves = 0.0;     ///< of the margin, from the species with a margin only
    DamageAmounts damage;
    GillLayout gill_layout;
    int blade_tiers = 0;     ///< solid blades are placed on gill_layout.blades << blade_tiers slots
    bool runs_down = false;  ///< gills of some species of the mix run down the stem at some age

    [[nodiscard]] bool is_branched() const { return !branch_graph.empty(); }
};

}  // namespace sporeprint
