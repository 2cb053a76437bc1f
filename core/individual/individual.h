// A resolved individual: a request with everything decided. Geometry and painting read from it.
#pragma once

#include <algorithm>
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
    Model model;          ///< of the species at this age, overrides applied: the model to paint
    GroundStyle ground;   ///< of the species
    CellRows cells;       ///< layout of its spines in rows, the same at all ages
};

/// The veil and skin patches of one species. Species whose patches have equal places share a layer.
struct PatchLayer {
    std::uint32_t purpose = 0;  ///< purposes::warts or another kind of patch
    PatchStyle style;           ///< determines the places, independent of the weight
    double amount = 0.0;        ///< of the veil or skin: 0..1
    double weight = 1.0;        ///< of the species in the mix: factor on the size of every patch
    /// For patches on the stem: shares of arc length at which the spline segments of the mature
    /// stem's outline begin, followed by 1. At all ages a patch stays on its segment, at a constant
    /// share of the segment's length.
    std::vector<double> segments{};
    bool operator==(const PatchLayer&) const = default;
};

/// The hanging spines of one species.
struct SpineLayer {
    SpineStyle style;     ///< metres
    double weight = 1.0;  ///< of the species in the mix: factor on their size
    bool operator==(const SpineLayer&) const = default;
};

/// The peridioles of one species, and its receptacle; both include those that are absent.
struct PeridioleLayer {
    PeridioleStyle style;  ///< metres
    double amount = 0.0;   ///< how many are left: 0..1
    double weight = 1.0;   ///< of the species in the mix: factor on their size
    bool operator==(const PeridioleLayer&) const = default;
};
struct ReceptacleLayer {
    ReceptacleStyle style;  ///< metres
    double amount = 0.0;    ///< how far it has unfolded: 0..1
    double weight = 1.0;    ///< of the species in the mix: factor on its size
    bool operator==(const ReceptacleLayer&) const = default;
};

/// What one species brings along of its ground.
struct GroundLayer {
    GroundStyle style;         ///< metres
    std::uint32_t stream = 0;  ///< of its species in random streams
    double weight = 1.0;       ///< of the species in the mix: factor on all sizes
    bool operator==(const GroundLayer&) const = default;
};

/// What cuts and peels the margin of one species: its weight's part of the amounts of the individual,
/// and which kinds can occur at any age.
struct MarginDamage {
    std::uint32_t stream = 0;  ///< of the species in random streams
    double bites = 0.0, splits = 0.0, peel = 0.0;
    bool can_bite = false, can_split = false, can_peel = false;
};

/// Damage by weathering for geometry: amounts times the weight of the species that can have them,
/// and which kinds can occur at any age, so that no age changes the number of vertices.
struct DamageAmounts {
    WeatheringOf<Plain> amounts;
    std::vector<MarginDamage> margins;  ///< one per species, in the order of `parts`
    double clubs = 0.0;                 ///< weight of the species without a margin
    bool bites = false, splits = false, melts = false, peels = false, dew = false;

    /// Returns true if any amount is not zero.
    [[nodiscard]] bool any() const { return !(amounts == WeatheringOf<Plain>{}); }
};

/// The result of `resolve`: a request with everything decided.
struct Individual {
    Model model;  ///< all amounts and sizes, blended; its shape is empty: see `outline` and `axis`
    /// The parameters in effect: every optional that a species of the mix can have is set to the
    /// individual's value, all others are empty.
    MushroomParams effective;
    /// The seed of all features that are both in the mesh and in the images, such as warts.
    std::uint32_t painted_seed = 1;
    std::uint32_t shape_seed = 1;    ///< of all features that are in the mesh alone
    std::uint32_t weather_seed = 1;  ///< of damage, which is both in the mesh and in the images
    /// The scale factor of a swept individual: shapes at size 1 are multiplied by it.
    double size = 0.0;
    double lightness = 1.0;           ///< factor on the linear colour of the cap
    std::vector<SpeciesShare> parts;  ///< sorted by id
    /// The control shapes of all swept species of the mix, their correspondence, and the proofs
    /// that their blends do not self-intersect.
    std::shared_ptr<const MorphSet> set;
    BranchGraph branch_graph;  ///< for the branched family; the members after it are then empty
    Outline outline;           ///< metres; with the proportions and size of the individual
    double stem_base = 0.0;    ///< height of the first point of the stem, metres
    double stem_top = 0.0;     ///< height of the last point of the stem, metres
    /// 0..1: how much more the cap has grown in circumference than along its meridian.
    double radial_strain = 0.0;
    AxisCurve axis;
    double trunk_radius = 0.0;         ///< of the wood that a bracket grows round, metres; 0: none
    Azimuth azimuth;                   ///< the fan; its members of lobes are unused, see `lobes`
    std::vector<Azimuth> lobes;        ///< one per species with lobes, depth times weight
    std::vector<ReliefStyle> reliefs;  ///< of the upper face, one per form, depth times weight
    std::vector<PatchLayer>
        layers;            ///< warts, scales and volvas of all species, including those of amount 0
    SacStyle sac;          ///< its height includes amounts and weights; metres
    bool has_sac = false;  ///< some species of the mix can have one at some age
    RingStyle ring;        ///< its width includes amounts and weights; metres
    bool has_ring = false;  ///< some species of the mix can have one at some age
    std::vector<SpineLayer> spines;
    std::vector<PeridioleLayer> peridioles;
    std::vector<ReceptacleLayer> receptacles;
    std::vector<GroundLayer> grounds;  ///< none for base=clean
    double waves = 0.0;                ///< of the margin, from the species with a margin only
    DamageAmounts damage;
    GillLayout gill_layout;
    /// The gills and ridges of the mesh lie on gill_layout.blades * 2^blade_tiers evenly spaced
    /// slots round the axis.
    int blade_tiers = 0;
    bool runs_down = false;  ///< gills of some species of the mix run down the stem at some age

    /// Returns true for the branched family, false for the swept one.
    [[nodiscard]] bool is_branched() const { return !branch_graph.empty(); }
    /// Returns true for what grows forwards from a wall: brackets.
    [[nodiscard]] bool grows_from_wall() const { return azimuth.lateral > Azimuth::wall_from; }
    /// Returns the radius of the trunk round which it is bent, metres; 0 for a flat wall. Of a mix
    /// that is a bracket only in part it is larger than that of the wood.
    [[nodiscard]] double bending_radius() const {
        return trunk_radius / std::clamp((azimuth.lateral - Azimuth::wall_from) / 0.5, 1e-9, 1.0);
    }
};

}  // namespace sporeprint
