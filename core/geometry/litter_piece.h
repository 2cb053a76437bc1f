// Pieces of litter and strands: flat sections along a curve, as solids.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/geometry/grid_solid.h"
#include "core/math/random.h"
#include "core/model/ground.h"

namespace sporeprint {

/// How a piece of one kind of litter is shaped and lies.
struct LitterForm {
    std::array<double, 9> widths;    ///< half, along it, in shares of the largest
    double width, thickness;         ///< half, in its lengths
    double least_stand, most_stand;  ///< angle above the ground, degrees
    double bend;                     ///< of its tip, in its lengths: out, or up if it lies
    double leaning;                  ///< share of pieces that lean on the stem
    double sunk;                     ///< share of its length below the ground
    double curl;                     ///< of its sides, at most, in half widths
    double ragged;                   ///< how far its rim strays, in half widths
    double whorl;                    ///< how far every second corner is drawn in, 0..1
    SolidGrid grid;                  ///< at LOD 0
};

// No source or measurement is recorded for these values.
[[nodiscard]] constexpr LitterForm form_of(LitterKind kind) {
    switch (kind) {
        case LitterKind::leaves:
            // A stalk, and a blade that dried in a bow.
            return {.widths = {0.07, 0.05, 0.62, 0.93, 1.0, 0.9, 0.66, 0.34, 0.0},
                    .width = 0.27,
                    .thickness = 0.006,
                    .least_stand = -4.0,
                    .most_stand = 16.0,
                    .bend = 0.45,
                    .leaning = 0.25,
                    .sunk = 0.0,
                    .curl = 0.75,
                    .ragged = 0.16,
                    .whorl = 0.0,
                    .grid = {9, 8, false}};
        case LitterKind::needles:
            return {.widths = {0.7, 1.0, 1.0, 1.0, 1.0, 1.0, 0.95, 0.8, 0.0},
                    .width = 0.026,
                    .thickness = 0.018,
                    .least_stand = -5.0,
                    .most_stand = 12.0,
                    .bend = 0.12,
                    .leaning = 0.3,
                    .sunk = 0.0,
                    .curl = 0.0,
                    .ragged = 0.0,
                    .whorl = 0.0,
                    .grid = {6, 4, false}};
        case LitterKind::grass:
            return {.widths = {0.75, 0.95, 1.0, 1.0, 0.95, 0.86, 0.7, 0.44, 0.0},
                    .width = 0.028,
                    .thickness = 0.004,
                    .least_stand = 42.0,
                    .most_stand = 84.0,
                    .bend = 0.75,
                    .leaning = 0.0,
                    .sunk = 0.08,
                    .curl = 0.8,
                    .ragged = 0.0,
                    .whorl = 0.0,
                    .grid = {9, 6, false}};
        case LitterKind::moss:
            // Whorls of leaves, one above the other.
            return {.widths = {0.35, 0.7, 1.0, 0.72, 0.98, 0.66, 0.82, 0.46, 0.0},
                    .width = 0.095,
                    .thickness = 0.095,
                    .least_stand = 42.0,
                    .most_stand = 88.0,
                    .bend = 0.3,
                    .leaning = 0.0,
                    .sunk = 0.15,
                    .curl = 0.0,
                    .ragged = 0.25,
                    .whorl = 0.5,
                    .grid = {9, 6, false}};
        case LitterKind::chips:
            return {.widths = {0.5, 0.85, 0.95, 1.0, 0.96, 1.0, 0.8, 0.55, 0.0},
                    .width = 0.11,
                    .thickness = 0.035,
                    .least_stand = -6.0,
                    .most_stand = 12.0,
                    .bend = 0.1,
                    .leaning = 0.12,
                    .sunk = 0.0,
                    .curl = 0.15,
                    .ragged = 0.3,
                    .whorl = 0.0,
                    .grid = {7, 6, false}};
    }
    return {};
}

/// A curve with a flat section round it.
struct Rod {
    glm::dvec3 from{0.0}, along{0.0, 1.0, 0.0};  ///< its beginning, and unit direction there
    glm::dvec3 bend{0.0}, wind{0.0};
    glm::dvec3 side{1.0, 0.0, 0.0};  ///< unit, square to `along`: across it, where it is wide
    double length = 0.0, width = 0.0, thickness = 0.0;  ///< the last two half, metres
    std::span<const double> widths = {};                ///< along it, in shares of the largest
    double curl = 0.0, ragged = 0.0, whorl = 0.0;       ///< as those of a LitterForm

    /// Takes on the form of a kind of litter, at its own length.
    ///
    /// form    lives as long as the rod
    /// curled  share of the form's curl; negative ones curl the other way
    void take_form(const LitterForm& form, double curled);

    /// Returns the unit direction that its faces look to at its beginning; sides curl to it.
    [[nodiscard]] glm::dvec3 up() const;
};

/// Returns the grid of a piece of litter: that of a level of detail, or if it is empty, that of the
/// form.
[[nodiscard]] inline SolidGrid grid_of(const LitterForm& form, const SolidGrid& of_level) {
    return of_level.rows > 0 ? of_level : form.grid;
}

/// Returns the angle at which a piece lies: evenly spread, however many are built.
[[nodiscard]] double spread_angle(int number, Random& random);

/// Returns the corners of a rod as those of a GridSolid.
///
/// random  strays its rim
[[nodiscard]] std::vector<glm::dvec3> corners_of(const Rod& rod, const SolidGrid& grid,
                                                 Random& random);

/// Bands of the ground's strip, see ground_bands.
inline constexpr std::size_t soil_band = 0, litter_band = 1, strand_band = 2;

/// Which piece of the ground's strip paints a solid.
struct StripPiece {
    std::size_t band = soil_band;
    double from = 0.0;    ///< 0..1, where it begins in what is left of the strip and of the band
    double share = 1.0;   ///< of the strip's length
    double across = 1.0;  ///< share of the band's width

    /// Returns it as the window of a GridSolid.
    [[nodiscard]] std::array<double, 4> window() const;
};

/// Returns the piece of the strip that paints a piece of litter.
///
/// from  see StripPiece
[[nodiscard]] constexpr StripPiece litter_paint(double from) { return {litter_band, from, 0.2}; }

}  // namespace sporeprint
