// Places of small things that are scattered over a world: the same ones on every plot that has them.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/world/ground.h"

namespace sporeprint {

/// Returns the number of the column or row of cells of a coordinate.
///
/// metres, side  the coordinate, and the side of a cell
[[nodiscard]] inline int cell_of(double metres, double side) {
    return static_cast<int>(std::floor(metres / side));
}

/// How places are drawn: so many in each cell, from a stream of purposes::plot_pieces of its own.
struct Scattering {
    double cell = 1.0;  ///< side of a cell, metres
    int per_cell = 1;
    std::uint32_t stream = 0;
};

/// A copy of one of a few shapes that stands at a place, and what decides whether it does; uniform in 0..1.
struct ScatteredCopy {
    double chance = 0.0, size = 0.0, turn = 0.0;
    std::uint32_t shape = 0;
};

/// Draws a copy of one of so many shapes.
[[nodiscard]] inline ScatteredCopy draw_copy(Random& random, std::uint32_t shapes) {
    ScatteredCopy one;
    one.chance = random.uniform();
    one.size = random.uniform();
    one.turn = random.uniform();
    one.shape = random.bits() % shapes;
    return one;
}

/// Calls a function for each place on a rectangle, in the order of the cells of the world.
///
/// rim   distance from the border within which no place counts, metres
/// draw  returns what belongs to a place besides, drawn from the stream of its cell
/// use   takes the place, metres to the east and to the north, and what was drawn
template <class Draw, class Use>
void for_each_place(std::uint32_t seed, const Scattering& scattering, const WorldBox& box,
                    double rim, const Draw& draw, const Use& use) {
    const double cell = scattering.cell;
    for (int row = cell_of(box.south, cell); row <= cell_of(box.north, cell); ++row)
        for (int column = cell_of(box.west, cell); column <= cell_of(box.east, cell); ++column) {
            Random random(seed, purposes::plot_pieces, scattering.stream, {column, row});
            for (int k = 0; k < scattering.per_cell; ++k) {
                const double along = random.uniform(), up = random.uniform();
                // Places beside the rectangle take their draws too: those of the next ones follow.
                const auto drawn = draw(random);
                const double x = (column + along) * cell, y = (row + up) * cell;
                if (x < box.west + rim || x >= box.east - rim || y < box.south + rim ||
                    y >= box.north - rim)
                    continue;
                use(x, y, drawn);
            }
        }
}

}  // namespace sporeprint
