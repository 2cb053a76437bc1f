// Parameters of the relief of the upper face that geometry and painting share: seeds, rows of pits,
// fade intervals.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/model/swept.h"

namespace sporeprint {

/// Returns the seeds of the noise lattices of the creases, the finer creases and the pits, in this
/// order.
[[nodiscard]] std::array<std::uint32_t, 3> relief_seeds(std::uint32_t seed);

/// Shares of the meridian at which relief fades out towards the apex and the margin, where the face
/// meets others.
inline constexpr double relief_apex = 0.02, relief_apex_end = 0.14;
inline constexpr double relief_margin = 0.93;

/// A row of pits has max(3, pit_columns * min(1, pit_first + pit_rise * s)) pits, where s is the
/// share of the meridian at the middle of the row, 0 at the apex and 1 at the margin.
inline constexpr double pit_first = 0.25, pit_rise = 1.5;

/// Lengths in cells of the pits' lattice. pit_jitter: greatest random offset of a pit's centre from
/// the middle of its cell; pit_slope: width of the slope from the rib to the floor of a pit;
/// pit_rib: half width of the flat top of a rib at ReliefStyle::rib = 1, 0 at rib = 0.
inline constexpr double pit_jitter = 0.38, pit_slope = 0.36, pit_rib = 0.2;

/// Ribs between pits are bent: places in their lattice move along the rows and across them by waves of
/// this height, in cells. A wave runs by `round` turns for each turn and by `down` for each row; those
/// across rows also by a turn for every pit_bend_length pits. Its phase is a byte of the seed.
struct PitBend {
    double height, round, down;
};
inline constexpr double pit_bend_length = 1.7;
inline constexpr std::array<PitBend, 2> pit_bends_across = {{{0.1, 1.0, 0.31}, {0.05, 2.0, -0.77}}};
inline constexpr std::array<PitBend, 2> pit_bends_along = {{{0.1, 2.0, 0.59}, {0.05, -3.0, 1.13}}};

/// Returns how many waves across rows there are in a turn, for a factor of 1.
[[nodiscard]] constexpr int pit_bend_waves(int pit_columns) {
    return std::max(static_cast<int>(pit_columns / pit_bend_length + 0.5), 1);
}

/// Returns the phase of a wave, 0..1: those across rows are waves 0 and 1, those along them 2 and 3.
[[nodiscard]] constexpr double pit_bend_phase(std::uint32_t seed, std::uint32_t wave) {
    return (seed >> (8U * wave) & 255U) / 256.0;
}

/// Mean of the relative depths of pits, 0.7..1.
inline constexpr double mean_pit = 0.85;

/// Creases, or crests, run along the zeros of a noise. crease_half: absolute value of the noise at
/// which the next fold is highest; crease_round: that at which the bottom of a crease becomes
/// round; crease_mean: mean depth of a pattern of creases; fine_creases: share of the depth that
/// belongs to the finer creases; crease_winding: share of the finer noise in the coarser one, which
/// makes long creases wind.
inline constexpr double crease_half = 0.6, crease_round = 0.05, crease_mean = 0.45;
inline constexpr double fine_creases = 0.3, crease_winding = 0.3;

/// How much finer the second noise of the creases is.
inline constexpr double finer_creases = 2.03;

/// The share of the relief that a mesh carries, 0..1; painting shows the rest.
struct CarriedRelief {
    double folds = 0.0, pits = 0.0, tiers = 0.0;

    static constexpr void fields(auto visit) {
        using C = CarriedRelief;
        visit(&C::folds,
              Info{.name = "folds", .min = 0, .max = 1, .doc = "Share of the folds' depth."});
        visit(&C::pits,
              Info{.name = "pits", .min = 0, .max = 1, .doc = "Share of the pits' depth."});
        visit(&C::tiers,
              Info{.name = "tiers", .min = 0, .max = 1, .doc = "Share of the tiers' depth."});
    }
    bool operator==(const CarriedRelief&) const = default;
};

/// Returns the shares of the relief that a cap with these numbers of columns and rings can show: 0
/// below two samples per fold, pit or tier, 1 from four on.
[[nodiscard]] CarriedRelief carried_relief(const ReliefStyle& style, int columns, int rings);

}  // namespace sporeprint
