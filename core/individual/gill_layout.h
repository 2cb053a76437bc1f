// The layout of gills, ridges and spines: one source of positions for the solids of the mesh and
// for the painted images.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/model/hymenium.h"

namespace sporeprint {

/// The gill layout of a whole set: the gills or ridges of the species and stage with the most at
/// the margin, so that no weight and no age changes their number. A species with fewer uses a part
/// of the slots, the last tiers dropped first. 0 blades: no species carries any.
struct GillLayout {
    int blades = 0;
    int tiers = 0;

    [[nodiscard]] long at_margin() const { return static_cast<long>(blades) << tiers; }
    bool operator==(const GillLayout&) const = default;
};

/// Returns true for gills and ridges, which are blades.
[[nodiscard]] constexpr bool is_bladed(HymeniumPattern pattern) {
    return pattern == HymeniumPattern::gills || pattern == HymeniumPattern::ridges;
}

/// The assignment of a species' blades to the slots of its set's layout. Tiers are filled one after
/// another; a species with so few blades that all would reach the stem keeps its own tiers instead,
/// each blade on a slot.
struct SlotAssignment {
    int blades = 0;          ///< that reach the stem
    int tiers = 0;           ///< of shorter blades; each halves the gaps
    double last_tier = 1.0;  ///< share of the last tier's blades that is present
    int slots = 0;  ///< number of slots round the axis; 0: blades are evenly spaced without slots
    int occupied = 0;  ///< number of blades on slots
    int stride = 1;    ///< every `stride`-th blade reaches the stem
};

/// Returns the slot assignment of a species.
///
/// gill_layout  number of blades that reach the stem in the layout of the set; 0 for a species
///              without a set
[[nodiscard]] SlotAssignment slot_assignment(int gill_layout, HymeniumPattern pattern, int blades,
                                             int tiers);

/// Returns the share of the meridian (0 stem, 1 margin) at which a tier of shorter gills begins. In
/// the layout of a set a species may fill more tiers than any species has alone: those begin ever
/// closer to the margin.
[[nodiscard]] constexpr double tier_begin(int tier) {
    constexpr std::array<double, 3> begins = {0.30, 0.58, 0.78};
    if (tier < 3) return begins[static_cast<std::size_t>(tier)];
    double left = 1.0 - begins[2];
    for (int i = 3; i <= tier; ++i) left *= 0.5;
    return 1.0 - left;
}
/// Random variation of that share, and the steepness with which shorter gills rise.
inline constexpr double tier_strays = 0.14, tier_rise = 6.0;
/// The same two values for the two levels of forks of a ridge at maximal forking, and the speed at
/// which forks move to the middle of the gap.
inline constexpr std::array<double, 2> fork_begins = {0.24, 0.66}, fork_strays = {0.17, 0.10};
inline constexpr double fork_swing = 3.2, fork_missing = 1.1;
/// Amplitude of the deviation of gills and ridges from their meridian, in turns, per unit of
/// Wander.
inline constexpr double gill_wander = 0.0055, ridge_wander = 0.011;
/// Steps of the golden section distribute any share of a tier's blades as evenly as possible.
inline constexpr double golden_step = 0.61803399;

/// A smooth deviation of blades from their meridians: a few waves round the axis with a phase that
/// depends on the meridian.
struct Wander {
    struct Wave {
        int count = 1;
        double lean = 0.0, size = 0.0, phase = 0.0;
    };
    std::array<Wave, 6> waves;

    /// Returns the deviation, -1..1, at a turn round the axis, 0..1, and a share of the meridian,
    /// 0..1.
    [[nodiscard]] double at(double turn, double share) const;
};
[[nodiscard]] Wander wander_of(std::uint32_t seed);

/// Returns a cubic approximation of a cosine of period 1: 1 at integers, -1 half-way between.
[[nodiscard]] double cubic_wave(double t);

/// Returns the hash keys of an individual's hymenium: 2 and 3 are for blades, 4 for cross veins, 5
/// for cells.
[[nodiscard]] std::array<std::uint32_t, 8> hymenium_words(std::uint32_t seed);

/// Returns the hash of an integer as a number in -1..1, equal bit for bit to the hash in the paint
/// kernels.
[[nodiscard]] float hashed_symmetric(int integer, std::uint32_t word);

/// One blade of a species.
struct Blade {
    double presence = 0.0;  ///< 0: the species has no blade on this slot
    double begin = 0.0;     ///< on the meridian, 0 at the stem
    /// share of the meridian over which its height rises; 0: full height at its beginning
    double rise = 0.0;
    double from =
        0.0;  ///< angular position at its beginning, in gaps between blades that reach the stem
    double to = 0.0;  ///< the same at the margin
    /// index round the axis among all that the species can have: the key of its random draws
    int number = 0;
};

/// The blades of a species on the slots of a set: one entry for each of `slots` positions round the
/// axis.
class BladeRow {
  public:
    /// Places the blades of a species.
    ///
    /// slots  at least as many as the species has blades and forks; slot k is at k / slots turns
    BladeRow(const SlotAssignment& assignment, HymeniumPattern pattern, double forking,
             std::uint32_t seed, int slots);

    [[nodiscard]] const std::vector<Blade>& blades() const { return blades_; }
    /// Returns the angular position of a blade at a share of the meridian, in turns, not wrapped to
    /// 0..1.
    [[nodiscard]] double turn(const Blade& blade, double share) const;

  private:
    [[nodiscard]] double turn_of(double gaps) const;
    void put(double gaps, Blade blade);

    SlotAssignment assignment_;
    double wander_size_;
    Wander wander_;
    std::vector<Blade> blades_;
};

/// A low fold that connects a ridge to the next one round the axis.
struct CrossVein {
    int ridge = 0;        ///< index of the ridge where it begins; it ends at the next one
    double share = 0.0;   ///< of the meridian, half-way between both
    double tilt = 0.0;    ///< share at the next ridge minus that at its own
    double height = 0.0;  ///< 0..1: 0 where ridges are not connected
};
/// Returns the number of rows of cross veins from the stem to the margin: one vein per gap and row,
/// as far as the limit on veins permits.
[[nodiscard]] constexpr int cross_vein_rows(int ridges) {
    const int rows = 320 / (ridges > 0 ? ridges : 1);
    return rows < 7 ? rows : 7;
}
/// Random offset within the row, tilt and width of cross veins, in rows.
inline constexpr double vein_stray = 0.36, vein_tilt = 1.4, vein_width = 0.09;
/// The vein of gap k in row j has the hash index k + vein_rows_apart * j.
inline constexpr int vein_rows_apart = 512;
/// Returns the threshold of presence: this minus the hash of a vein, times the steepness, is its
/// height.
[[nodiscard]] constexpr double veins_there(double forking) { return 1.4 * forking - 0.5; }
inline constexpr double vein_steepness = 4.0;

/// Returns the cross veins of a species with so many ridges, including those of height 0, so that
/// no age changes their number.
[[nodiscard]] std::vector<CrossVein> cross_veins(int ridges, double forking, std::uint32_t seed);

/// Rows of cells (pores, spines) from the stem to the margin; row j has max(floor(from + grow * (j
/// + 0.5)), 3) of them.
struct CellRows {
    int rows = 0;  ///< 0: computed from the lengths of the individual
    double from = 6.0;
    double grow = 0.0;

    static constexpr void fields(auto visit) {
        visit(&CellRows::rows,
              Info{.name = "rows", .min = 0, .max = 400, .doc = "Rows from stem to margin."});
        visit(&CellRows::from,
              Info{.name = "from", .min = 0, .max = 20000, .doc = "Cells round the inner edge."});
        visit(
            &CellRows::grow,
            Info{.name = "grow", .min = -20000, .max = 20000, .doc = "More of them in each row."});
    }
    bool operator==(const CellRows&) const = default;
};

/// The greatest number of solid spines; denser ones are made fewer and thicker, denser pores exist
/// in the images alone.
inline constexpr int most_spines = 1500;

/// Returns the total number of cells.
[[nodiscard]] int cell_count(const CellRows& cells);

/// Returns rows of square cells on a face.
///
/// arc, inner, outer  length of its meridian and radii where it begins and ends, metres
/// most               greatest number of cells; the spacing is widened to meet it
[[nodiscard]] CellRows cell_rows(double arc, double inner, double outer, double per_metre,
                                 int most);

/// The position of a cell's point; equal to that of the paint kernels up to rounding.
struct CellPlace {
    double turn = 0.0, share = 0.0;
    double lot = 0.0;  ///< -1..1, random per cell
};
[[nodiscard]] std::vector<CellPlace> cell_places(const CellRows& cells, std::uint32_t seed);
inline constexpr float cell_jitter = 0.30F;

}  // namespace sporeprint
