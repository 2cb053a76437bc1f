#include "core/geometry/litter_piece.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

/// How often windows begin anew along the strip, of which pieces show a part of the width.
constexpr double window_turns = 7.3;

/// Returns what a table of evenly spaced entries has at a place, 0..1.
double of_table(std::span<const double> table, double place) {
    const double at = place * static_cast<double>(table.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), table.size() - 2);
    const double t = at - static_cast<double>(below);
    return (1.0 - t) * table[below] + t * table[below + 1];
}

}  // namespace

glm::dvec3 Rod::up() const { return glm::cross(along, side); }

std::vector<glm::dvec3> corners_of(const Rod& rod, const SolidGrid& grid, Random& random) {
    const glm::dvec3 up = rod.up();
    std::vector<glm::dvec3> corners;
    corners.reserve(static_cast<std::size_t>(grid.rows * (grid.columns + 1)));
    for (int i = 0; i < grid.rows; ++i) {
        const double t = static_cast<double>(i) / (grid.rows - 1);
        const glm::dvec3 middle =
            rod.from + rod.length * (t * rod.along + t * t * rod.bend +
                                     sine(2.0 * pi * t) * (1.0 - t) * rod.wind);
        const double wide = i + 1 == grid.rows ? 0.0 : of_table(rod.widths, t);
        // Both rims stray, the faces between them stay smooth.
        const double right = rod.ragged * random.symmetric();
        const double left = rod.ragged * random.symmetric();
        for (int j = 0; j < grid.columns; ++j) {
            const auto turn = sine_cosine(2.0 * pi * j / grid.columns);
            const double drawn_in = (i + j) % 2 == 1 ? 1.0 - rod.whorl : 1.0;
            const double across = turn.cosine * (1.0 + (turn.cosine > 0.0 ? right : left));
            corners.push_back(middle + wide * (drawn_in * across * rod.width * rod.side +
                                               (drawn_in * turn.sine * rod.thickness +
                                                rod.curl * across * across * rod.width) *
                                                   up));
        }
        corners.push_back(corners[corners.size() - static_cast<std::size_t>(grid.columns)]);
    }
    return corners;
}

std::array<double, 4> StripPiece::window() const {
    const auto& [low, high] = ground_bands[band];
    // Pieces that begin near each other along the strip lie apart across it.
    const double apart = window_turns * from - std::floor(window_turns * from);
    const double least = low + apart * (1.0 - across) * (high - low);
    return {from * (1.0 - share), from * (1.0 - share) + share, least,
            least + across * (high - low)};
}

}  // namespace sporeprint
