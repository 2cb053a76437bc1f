// Parameters of the relief of the upper face that geometry and painting share: seeds, rows of pits,
// fade intervals.
#pragma once

#include <array>
#include <cstdint>

#include "core/model/swept.h"

namespace sporeprint {

/// Returns the seeds of the lattices that relief is drawn from: creases, finer creases, pits.
[[nodiscard]] std::array<std::uint32_t, 3> relief_seeds(std::uint32_t seed);

/// Shares of the meridian at which relief fades out towards the apex and the margin, where the face
/// meets others.
inline constexpr double relief_apex = 0.02, relief_apex_end = 0.14;
inline constexpr double relief_margin = 0.93;

/// A row has max(3, `pit_columns` * min(1, first + rise * share of its middle)) pits.
inline constexpr double pit_first = 0.25, pit_rise = 1.5;

/// Random offset of pit points from the middle of their cells; the distance from a border at which
/// the floor of a pit is reached, in cells, for sharp ribs.
inline constexpr double pit_jitter = 0.38, pit_slope = 0.36, pit_rib = 0.2;

/// Half width of a crease as a value of the noise whose zeros are the creases; weight of the finer
/// creases.
inline constexpr double crease = 0.2, fine_creases = 0.3;

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

/// Returns what the mesh carries, from the number of columns and rings of the cap per fold, pit or
/// tier.
[[nodiscard]] CarriedRelief carried_relief(const ReliefStyle& style, int columns, int rings);

}  // namespace sporeprint
