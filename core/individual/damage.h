// The places of damage by weather, slugs and handling: drawn once per species of an individual, on
// the young surface; used by geometry and painting. Amounts only open, deepen and lengthen what is
// drawn here, so that no slider and no age moves it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/individual/mixed_random.h"
#include "core/math/elementary.h"
#include "core/silhouette/outline.h"

namespace sporeprint {

struct Individual;

/// Returns the seed of the damage of a species: what befalls it lies elsewhere on another species of
/// the same individual seed. Drops of water alone take the seed of the individual: a mesh has
/// vertices for one set of them.
///
/// stream  of the species: stream_of() its id
[[nodiscard]] std::uint32_t damage_seed(std::uint32_t individual, std::uint32_t stream);

/// Returns the seeds and weights of the species of an individual. Dents of all of them are in its
/// mesh, each as deep as its species' weight, as its images show all of them.
[[nodiscard]] SeedShares damage_shares(const Individual& individual);

/// A kind of damage with round or oval spots; each has random streams of its own.
enum class DamageSpotKind : std::uint32_t { pit, bruise, dew, lump };

/// A round or oval spot of damage on one part.
struct DamageSpot {
    /// along the meridian: 0 at the apex (cap), stem (hymenium) or ground (stem)
    double sigma = 0.0;
    double theta = 0.0;   ///< round the axis, 0..2 pi
    double radius = 0.0;  ///< cap, hymenium: in lengths of the meridian; stem: in circumferences
    double elongation = 1.0;  ///< length along the meridian over width across it
    double onset = 0.0;       ///< 0..1: the amount at which it begins; see grown()
    std::uint32_t id = 0;     ///< key of its own random stream
};

/// Returns the spots of a kind on a part in the order of their onset; none where the kind does not
/// occur.
[[nodiscard]] std::vector<DamageSpot> damage_spots(DamageSpotKind kind, CurveName part,
                                                   std::uint32_t seed);

/// Returns the size factor of a spot, 0..1, for an amount of its kind; continuous, 0 for amount 0,
/// 1 for amount 1.
[[nodiscard]] double grown(double onset, double amount);

/// Returns the same factor for damage that cuts the mesh or adds solids: 0 until a hundredth of it
/// is reached, so that a species of negligible weight splits no quad of the others and leaves no
/// sliver on them.
[[nodiscard]] double begun(double onset, double amount);

/// Returns the size of a bruise, a pit or a lump relative to its full size: they fade in, and do not
/// grow from a point as drops do.
[[nodiscard]] constexpr double faded_in_size(double scale) { return 0.5 + 0.5 * scale; }

/// Returns the depth and visibility of a pit: a slug rasps first a patch of the skin, then deeper,
/// so that no pit is a dot.
[[nodiscard]] constexpr double pit_depth(double scale) { return smooth_step(0.0, 0.35, scale); }

/// Returns the height of a lump at full size, in the unit of its radius; every third is a hollow.
[[nodiscard]] constexpr double lump_height(const DamageSpot& lump) {
    return (lump.id % 3 == 2 ? -0.8 : 1.0) * 0.16 * lump.radius;
}

/// A lip of a split: from the tip, which is as deep as the split, to the margin.
struct Lip {
    struct Corner {
        double across = 0.0;  ///< angle from the tip, radians
        double deep = 0.0;    ///< relative to the depth of the tip
    };
    std::array<Corner, 4> corners{};  ///< from the tip outwards; the last is on the margin
    double lift = 0.0;                ///< how far it is raised, relative to the others: 0..1
};

/// One of the overlapping half ellipses that a bite consists of: a slug rasps in strokes. Places are
/// relative to the bite's half width, depths to its own.
struct Scallop {
    double middle = 0.0, half_width = 1.0, depth = 1.0;
};

/// A piece missing from the margin, through cap and lower face alike: a slug's bite or a split.
struct Notch {
    double theta = 0.0;       ///< of the middle of a bite, of the tip of a split
    double half_width = 0.0;  ///< radians at the margin, at most most_notch_width; the wider lip's
    double depth = 0.0;       ///< at full size, in radii of the cap
    double onset = 0.0;
    bool bitten = true;  ///< a round bite; otherwise a pointed split
    std::uint32_t id = 0;
    std::array<Lip, 2> lips{};  ///< of a split: on the side of smaller and of greater angles
    std::array<Scallop, 3> scallops{};  ///< of a bite, in the order of their angles
    /// Where the outline of a bite has its cusps, relative to its half width.
    std::array<double, 2> cusps{};
    /// Depth in the lower face over that in the cap, minus 1: 0 of a split.
    double undercut = 0.0;
};

/// Returns the bites of slugs and the splits of the margin. Splits are narrow tears, most of them
/// short; each of their lips waves in its own way.
[[nodiscard]] std::vector<Notch> bites(std::uint32_t seed);
[[nodiscard]] std::vector<Notch> splits(std::uint32_t seed);

inline constexpr double most_notch_width = 0.45;

/// The greatest distance of a lip from the tip of its split grows with this power of the depth left:
/// splits end in a narrow tip. The paint kernels know it as the fourth root of a cube.
inline constexpr double lip_power = 4.0 / 3.0;

/// Returns the depth of a full-size notch at an angle relative to its greatest: that of the deepest
/// scallop of a bite, the tear between the lips of a split; 0 outside.
[[nodiscard]] double notch_profile(const Notch& notch, double theta);

/// Returns the same for a notch of a size from 0 to 1. A bite deepens; the tip of a split advances
/// while its lips move apart.
[[nodiscard]] double notch_depth(const Notch& notch, double size, double theta);

/// Returns how far the lip of a split is raised at an angle relative to the most possible: not at
/// the tip, most at the margin beside the split, less and less farther away; 0 for a bite.
///
/// size  of the split, 0..1
[[nodiscard]] double lip_lift(const Notch& notch, double size, double theta);

/// Returns the share of the cap's meridian that has melted away from the margin for an amount of
/// deliquescence; its edge varies by a fifth of it.
[[nodiscard]] constexpr double melted(double deliquescence) { return 0.36 * deliquescence; }

/// A strip of skin that has peeled from the margin inwards.
struct Tongue {
    double theta = 0.0;
    double half_width = 0.0;  ///< radians at the margin
    double reach = 0.0;       ///< at full size, as a share of how far the species' skin peels
    double onset = 0.0;
    std::array<double, 3> phases{};  ///< of its ragged edge, in turns
    std::uint32_t id = 0;
};

/// Returns the inward deviation of its edge relative to its size at a turn around the centre of its
/// end: 0 along the margin, 1/4 straight inwards.
[[nodiscard]] double tongue_ragged(const Tongue& tongue, double turn);

/// Returns the peeled strips of a species of an individual.
[[nodiscard]] std::vector<Tongue> tongues(std::uint32_t seed);

/// A point of a crack on the young face in polar projection: the distance from the pole in lengths
/// of the meridian, and the angle.
struct CrackPoint {
    double x = 0.0, y = 0.0;
    double along = 0.0;  ///< share of the crack's length, from where it begins to open
};

/// A crack as a polyline.
struct Crack {
    std::vector<CrackPoint> points;  ///< two or more
    double onset = 0.0;
    double width = 1.0;  ///< relative to the others of its kind
};

/// Returns a net of cracks that meet at right angles, as in dry mud or thick dry skin: the first
/// are long, later ones end at them.
///
/// cost    about half a millisecond
/// source  sequential growth: cracks by strength, each until it meets another (T-junction)
[[nodiscard]] std::vector<Crack> crack_net(std::uint32_t seed);

/// Returns cracks from the margin inwards, few of them long, at stratified angles.
[[nodiscard]] std::vector<Crack> radial_cracks(std::uint32_t seed);

/// A furrow along the stem, with the part of it where the skin splits.
struct Furrow {
    double theta = 0.0;
    double wander = 0.0;  ///< amplitude of its deviation to each side, radians
    double phase = 0.0;
    double from = 0.0, to = 1.0;  ///< shares of the stem
    double depth = 1.0;           ///< relative to the others
    double onset = 0.0;
    double split_from = 0.0, split_to = 0.0;  ///< where it opens when fully dry
};
[[nodiscard]] std::vector<Furrow> furrows(std::uint32_t seed);

/// Returns the angle of a furrow at a share of the stem.
[[nodiscard]] double furrow_angle(const Furrow& furrow, double sigma);

/// Returns the depth factor of furrows on the upper part of a club: 0 where its sub-curve begins
/// and at its tip.
[[nodiscard]] constexpr double club_fade(double share) {
    return smooth_step(0.0, 0.1, share) * (1.0 - smooth_step(0.35, 0.8, share));
}

/// Returns the depth of a furrow at a share of the stem, 0..1 times its own depth; it fades at both
/// ends.
[[nodiscard]] double furrow_depth(const Furrow& furrow, double sigma);

/// Returns how radial the cracks of a grown face are: 0 where it has stretched equally in all
/// directions (a net of islands), 1 where it has stretched much more in circumference than along
/// the meridian (splits from the margin inwards).
///
/// young, now  the outlines of the face when young and at present
/// source      hoop strain r1/r0 against meridional strain s1/s0, near the margin
[[nodiscard]] double radial_strain(const SubCurve& young, const SubCurve& now);

/// Returns the difference of two angles, -pi..pi.
[[nodiscard]] double turn_between(double from, double to);

}  // namespace sporeprint
