// Where weather, slugs and hands mark a mushroom: drawn once per individual on the young surface, read by build (geometry) and by
// paint. Amounts only open, deepen and lengthen what is drawn here, so that no slider and no age reshuffles it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/elementary.h"
#include "core/silhouette/outline.h"

namespace sporeprint {

/// What leaves marks; each has random streams of its own.
enum class MarkKind : std::uint32_t { pit, bruise, dew, lump };

/// A round or oval mark on one part.
struct Mark {
    double sigma = 0.0;   ///< along the meridian: 0 apex (cap), stem (hymenium) or ground (stem)
    double theta = 0.0;   ///< round the axis, 0..2 pi
    double radius = 0.0;  ///< cap, hymenium: in lengths of the meridian; stem: in circumferences
    double elongation = 1.0;  ///< along the meridian over across
    double onset = 0.0;       ///< 0..1: the amount at which it begins; see grown()
    std::uint32_t id = 0;     ///< names its own random stream
};

/// The marks of a kind on a part, in the order in which they come; none where the kind does not occur.
[[nodiscard]] std::vector<Mark> marks(MarkKind kind, CurveName part, std::uint32_t seed);

/// How much of a mark is there, 0..1, when `amount` of its kind has come; continuous, 0 for amount 0, 1 for amount 1.
[[nodiscard]] double grown(double onset, double amount);

/// The same for what cuts the mesh or stands on it: nothing until a hundredth of it has come, so that a species of next to no weight
/// divides no quad of the others and leaves no thread on them.
[[nodiscard]] double begun(double onset, double amount);

/// Height of a lump when full, in the unit of its radius; every third is a hollow.
[[nodiscard]] constexpr double lump_height(const Mark& lump) {
    return (lump.id % 3 == 2 ? -0.8 : 1.0) * 0.16 * lump.radius;
}

/// A piece out of the margin: a slug's bite or a split, through cap and lower face alike.
struct Notch {
    double theta = 0.0;
    double half_width = 0.0;  ///< radians at the margin, at most most_notch_width
    double depth = 0.0;       ///< when full, in radii of the cap
    double onset = 0.0;
    bool bitten = true;  ///< a round bite; else a pointed split
    std::uint32_t id = 0;
};

/// Bites of slugs and splits of the margin.
[[nodiscard]] std::vector<Notch> bites(std::uint32_t seed);
[[nodiscard]] std::vector<Notch> splits(std::uint32_t seed);

inline constexpr double most_notch_width = 0.45;

/// Depth of a full notch at an angle, as a share of its deepest: half an ellipse for a bite, a point for a split; 0 outside.
[[nodiscard]] double notch_profile(const Notch& notch, double theta);

/// Share of the cap's meridian that has melted away from the margin when `deliquescence` has come so far, ragged by a fifth of it.
[[nodiscard]] constexpr double melted(double deliquescence) { return 0.36 * deliquescence; }

/// A tongue of skin that has come off from the margin inwards.
struct Tongue {
    double theta = 0.0;
    double half_width = 0.0;  ///< radians at the margin
    double reach = 0.0;       ///< when full, as a share of how far the species' skin peels
    double onset = 0.0;
    std::array<double, 3> phases{};  ///< of its ragged border, in turns
    std::uint32_t id = 0;
};

/// How far its border strays inwards, in its own size, at a turn round the middle of its end: 0 along the margin, 1/4 straight in.
[[nodiscard]] double tongue_ragged(const Tongue& tongue, double turn);

[[nodiscard]] std::vector<Tongue> tongues(std::uint32_t seed);

/// A point of a crack, on the young face laid flat: distance from the pole in lengths of the meridian, direction its angle.
struct CrackPoint {
    double x = 0.0, y = 0.0;
    double along = 0.0;  ///< share of the crack's length, from where it begins to open
};

struct Crack {
    std::vector<CrackPoint> points;  ///< two or more
    double onset = 0.0;
    double width = 1.0;  ///< relative to the others of its kind
};

/// A net of cracks that meet at right angles, as dry mud and dry thick skin crack: the first run far, the later ones end at them.
///
/// cost    about half a millisecond
/// source  sequential growth after algorithms.md sec. 7.1: cracks by strength, each until it meets another (T-junction)
[[nodiscard]] std::vector<Crack> crack_net(std::uint32_t seed);

/// Cracks from the margin inwards, few of them long, at stratified angles.
[[nodiscard]] std::vector<Crack> radial_cracks(std::uint32_t seed);

/// A furrow along the stem, and where on it the skin splits.
struct Furrow {
    double theta = 0.0;
    double wander = 0.0;  ///< radians that it strays to each side
    double phase = 0.0;
    double from = 0.0, to = 1.0;  ///< shares of the stem
    double depth = 1.0;           ///< relative to the others
    double onset = 0.0;
    double split_from = 0.0, split_to = 0.0;  ///< where it opens when all is dry
};
[[nodiscard]] std::vector<Furrow> furrows(std::uint32_t seed);

/// Angle of a furrow at a share of the stem.
[[nodiscard]] double furrow_angle(const Furrow& furrow, double sigma);

/// How deep furrows are on the upper part of a club, 0 where its sub-curve begins and at its tip.
[[nodiscard]] constexpr double club_fade(double share) {
    return smooth_step(0.0, 0.1, share) * (1.0 - smooth_step(0.35, 0.8, share));
}

/// How deep a furrow is at a share of the stem, 0..1 times its own depth: it begins and ends softly.
[[nodiscard]] double furrow_depth(const Furrow& furrow, double sigma);

/// How radial the cracks of a grown face run: 0 where it has stretched alike in all directions (a net of islands), 1 where it has
/// stretched much more round the axis than along the meridian (splits from the margin inwards).
///
/// young, now  the outlines of the face at first and at present
/// source      algorithms.md sec. 7.1: hoop strain r1/r0 against meridional strain s1/s0, near the margin
[[nodiscard]] double radial_strain(const SubCurve& young, const SubCurve& now);

/// The difference of two angles, -pi..pi.
[[nodiscard]] double turn_between(double from, double to);

}  // namespace sporeprint
