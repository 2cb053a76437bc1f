// Patches of a wood: pieces of about 22 m whose trees are of one age, because the same storms felled them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/world/records.h"
#include "core/world/stand.h"

namespace sporeprint {

/// The side of the squares that have the seed of one patch each.
inline constexpr std::int32_t patch_units = 22 * units_of_metre;

/// Seedlings per square metre at density 1.
inline constexpr double seedling_density = 0.2;

/// Returns a draw of a Weibull distribution.
///
/// mean_of_one  mean for scale 1: gamma(1 + 1 / shape)
[[nodiscard]] double weibull(double uniform, double mean, double shape, double mean_of_one);

/// Returns a moment so many years after another.
[[nodiscard]] WorldTime time_after(WorldTime begin, double years);

/// Returns a quotient rounded down.
[[nodiscard]] std::int32_t floor_div(std::int32_t number, std::int32_t by);

/// Returns a place in a square: a draw of 24 bits as a fraction of its side.
[[nodiscard]] std::int32_t place_in(std::int32_t cell, std::int32_t side, std::uint32_t bits);

/// Returns the square of the distance of two places, in units.
[[nodiscard]] std::int64_t square_distance(WorldPoint a, WorldPoint b);

/// A patch: its seed, and the storms between which its cohorts live.
struct StandPatch {
    CellIndex cell;
    WorldPoint seed;
    std::vector<WorldTime> storms;
};

/// Returns the patch whose seed lies in a square.
[[nodiscard]] StandPatch patch_of(const Stand& stand, CellIndex cell);

/// The crowns of a wood at a moment as they look from afar, without its trees: a place has the height that trees of the
/// age of its patch have.
class PatchCanopy {
  public:
    /// stand  must outlive the canopy
    PatchCanopy(const Stand& stand, WorldTime time) : stand_(&stand), time_(time) {}

    /// Returns the height of the crowns above the ground at a place, metres; 0 where no trees stand, and less than
    /// that of the trees where their crowns do not close.
    ///
    /// cost  20 us for the first place of a patch, 0.2 us for others
    [[nodiscard]] double at(WorldPoint place);

  private:
    struct Known {
        WorldPoint seed;
        double height = 0.0;
    };
    /// The patches whose seeds may be the nearest to a place of a cell.
    using Near = std::array<const Known*, 25>;
    const Near& round(CellIndex cell);
    const Known& patch(CellIndex cell);

    const Stand* stand_;
    WorldTime time_;
    std::map<std::pair<std::int32_t, std::int32_t>, Known> known_;
    std::map<std::pair<std::int32_t, std::int32_t>, Near> near_;  ///< of requested cells
};

}  // namespace sporeprint
