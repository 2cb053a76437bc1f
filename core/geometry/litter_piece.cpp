#include "core/geometry/litter_piece.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/even_table.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

/// How often windows begin anew along the strip, of which pieces show a part of the width.
constexpr double window_turns = 7.3;

}  // namespace

void Rod::take_form(const LitterForm& form, double curled) {
    width = form.width * length;
    thickness = form.thickness * length;
    widths = form.widths;
    curl = form.curl * curled;
    ragged = form.ragged;
    whorl = form.whorl;
}

glm::dvec3 Rod::up() const { return glm::cross(along, side); }

double spread_angle(int number, Random& random) {
    return golden_angle * number + 0.9 * random.symmetric();
}

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
