// Where gills, ridges and spines stand: one source of places for the solids that are built and for the images that are painted.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/model/hymenium.h"

namespace sporeprint {

/// The gills or ridges of a whole set, so that no weight and no age changes their number: those of the species and stage with the
/// most at the margin. A species with fewer shows its own, the last tiers dropped first. 0 blades: none carries any.
struct Comb {
    int blades = 0;
    int tiers = 0;

    [[nodiscard]] long at_margin() const { return static_cast<long>(blades) << tiers; }
    bool operator==(const Comb&) const = default;
};

[[nodiscard]] constexpr bool is_bladed(HymeniumPattern pattern) {
    return pattern == HymeniumPattern::gills || pattern == HymeniumPattern::ridges;
}

/// How a species stands its blades on the comb of its set. Tiers fill up one after another; a species with so few blades that all
/// would reach the stem keeps its own tiers instead, each blade on a slot.
struct Stand {
    int blades = 0;          ///< that reach the stem
    int tiers = 0;           ///< of shorter ones; each halves the gaps
    double last_tier = 1.0;  ///< share of the last tier's blades that is there
    int slots = 0;   ///< round the comb, on which blades stand; 0: they stand evenly by themselves
    int stands = 0;  ///< blades on slots
    int stride = 1;  ///< each so-manieth of which reaches the stem
};

/// comb  blades that reach the stem in the comb of the set; 0: the species stands alone
[[nodiscard]] Stand stand_on(int comb, HymeniumPattern pattern, int blades, int tiers);

/// Where a tier of shorter gills begins on the meridian (0 stem, 1 margin). On the comb of a set a species may fill more tiers than
/// any has of its own: those begin ever nearer to the margin.
[[nodiscard]] constexpr double tier_begin(int tier) {
    constexpr std::array<double, 3> begins = {0.30, 0.58, 0.78};
    if (tier < 3) return begins[static_cast<std::size_t>(tier)];
    double left = 1.0 - begins[2];
    for (int i = 3; i <= tier; ++i) left *= 0.5;
    return 1.0 - left;
}
/// How far that strays, and how fast they rise.
inline constexpr double tier_strays = 0.11, tier_rise = 9.0;
/// The same of the two levels of forks of a ridge, when it forks as much as can be; and how fast they swing to the middle.
inline constexpr std::array<double, 2> fork_begins = {0.24, 0.66}, fork_strays = {0.17, 0.10};
inline constexpr double fork_swing = 3.2, fork_missing = 1.1;
/// How far gills and ridges wander from their meridian, in turns, for a wander of 1.
inline constexpr double gill_wander = 0.0016, ridge_wander = 0.011;
/// Steps of the golden section spread what is there of a tier as evenly as can be, whatever its share.
inline constexpr double golden_step = 0.61803399;

/// Smooth straying of blades from their meridians: a few waves round the axis that lean with the meridian.
struct Wander {
    struct Wave {
        int count = 1;
        double lean = 0.0, size = 0.0, phase = 0.0;
    };
    std::array<Wave, 4> waves;

    /// -1..1; turn round the axis 0..1, share of the meridian 0..1
    [[nodiscard]] double at(double turn, double share) const;
};
[[nodiscard]] Wander wander_of(std::uint32_t seed);

/// Like a cosine of period 1: 1 at whole numbers, -1 half-way between; a cubic.
[[nodiscard]] double cubic_wave(double t);

/// Words that the places of an individual's hymenium are drawn from; 2 and 3 belong to blades, 4 to cross veins, 5 to cells.
[[nodiscard]] std::array<std::uint32_t, 8> hymenium_words(std::uint32_t seed);

/// Number in -1..1 that belongs to a whole number; equal to what paint draws, to the bit.
[[nodiscard]] float lot_of(int whole, std::uint32_t word);

/// One blade as a species wears it.
struct Blade {
    double presence = 0.0;  ///< 0: the species has none here
    double begin = 0.0;     ///< on the meridian, 0 at the stem
    double rise = 0.0;  ///< share of the meridian over which it rises; 0: it begins at full height
    double from =
        0.0;  ///< where it stands where it begins, in gaps of the blades that reach the stem
    double to = 0.0;  ///< where it ends up at the margin
    int number = 0;   ///< round the axis, among all that the species can have: what it draws by
};

/// The blades of a species on the slots of a set: one for each slot of a grid of `slots` round the axis.
class BladeRow {
  public:
    /// slots  at least as many as the species has blades and forks; slot k stands at k / slots
    BladeRow(const Stand& stand, HymeniumPattern pattern, double forking, std::uint32_t seed,
             int slots);

    [[nodiscard]] const std::vector<Blade>& blades() const { return blades_; }
    /// Where a blade crosses a share of the meridian, in turns; its own, not folded into 0..1.
    [[nodiscard]] double turn(const Blade& blade, double share) const;

  private:
    [[nodiscard]] double turn_of(double gaps) const;
    void put(double gaps, Blade blade);

    Stand stand_;
    double wander_size_;
    Wander wander_;
    std::vector<Blade> blades_;
};

/// A low fold that joins a ridge to the next one round the axis.
struct CrossVein {
    int ridge = 0;        ///< it begins at; the next one is where it ends
    double share = 0.0;   ///< of the meridian, half-way between both
    double tilt = 0.0;    ///< share at the next ridge less that at its own
    double height = 0.0;  ///< 0..1: 0 where ridges are not joined
};
/// Rows of cross veins from the stem to the margin: one in each gap, as far as a species may have so many.
[[nodiscard]] constexpr int cross_vein_rows(int ridges) {
    const int rows = 320 / (ridges > 0 ? ridges : 1);
    return rows < 7 ? rows : 7;
}
/// How far they stray in their rows, how much they tilt, and how wide they are, in rows.
inline constexpr double vein_stray = 0.36, vein_tilt = 0.4, vein_width = 0.11;
/// Of each whole number there is one vein: that of gap k in row j has k + vein_rows_apart * j.
inline constexpr int vein_rows_apart = 512;
/// How many there are: this less what a vein draws, times the steepness, is its height.
[[nodiscard]] constexpr double veins_there(double forking) { return 1.4 * forking - 0.5; }
inline constexpr double vein_steepness = 4.0;

/// The cross veins of a species with so many ridges: those without height too, so that no age changes their number.
[[nodiscard]] std::vector<CrossVein> cross_veins(int ridges, double forking, std::uint32_t seed);

/// Rows of cells (pores, spines) from the stem to the margin; row j has max(floor(from + grow * (j + 0.5)), 3) of them.
struct CellRows {
    int rows = 0;  ///< 0: as many as the lengths of the individual ask for
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

/// Most pores or spines that are solids; of more spines there are fewer and thicker ones, more pores live in the images alone.
inline constexpr int most_spines = 1500;

/// How many cells the rows have.
[[nodiscard]] int cell_count(const CellRows& cells);

/// Rows of square cells on a face.
///
/// arc, inner, outer  length of its meridian and radii where it begins and ends, metres
/// most               cells at most: of more the spacing is widened
[[nodiscard]] CellRows cell_rows(double arc, double inner, double outer, double per_metre,
                                 int most);

/// Where a cell's point lies; equal to what paint draws but for rounding.
struct CellPlace {
    double turn = 0.0, share = 0.0;
    double lot = 0.0;  ///< -1..1, its own
};
[[nodiscard]] std::vector<CellPlace> cell_places(const CellRows& cells, std::uint32_t seed);
inline constexpr float cell_jitter = 0.30F;

}  // namespace sporeprint
