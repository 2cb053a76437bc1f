// What geometry and painting must agree on about the relief of the upper face: seeds, rows of pits, windows.
#pragma once

#include <array>
#include <cstdint>

#include "core/model/swept.h"

namespace sporeprint {

/// Seeds of the lattices that relief is drawn from: creases, finer creases, pits.
[[nodiscard]] std::array<std::uint32_t, 3> relief_seeds(std::uint32_t seed);

/// Relief has faded to nothing at the apex and at the margin, where the face meets others: shares of the meridian.
inline constexpr double relief_apex = 0.02, relief_apex_end = 0.14;
inline constexpr double relief_margin = 0.93;

/// Pits of a row are as many as `pit_columns` times min(1, first + rise * share of its middle), at least 3.
inline constexpr double pit_first = 0.25, pit_rise = 1.5;

/// Points of pits stray this far from the middle of their cells; beyond this distance from a border the floor of a pit is reached,
/// in cells, with sharp ribs.
inline constexpr double pit_jitter = 0.38, pit_slope = 0.36, pit_rib = 0.2;

/// Half width of a crease, as a value of the noise whose zeros the creases follow; weight of the finer creases.
inline constexpr double crease = 0.2, fine_creases = 0.3;

/// Of the relief, what a mesh carries, 0..1: painting shows the rest.
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

/// By how many columns and rings of the cap a fold, a pit or a tier has.
[[nodiscard]] CarriedRelief carried_relief(const ReliefStyle& style, int columns, int rings);

}  // namespace sporeprint
