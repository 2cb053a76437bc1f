#include "core/plant/snow_cap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// How far from the top of a trunk snow lies, radians, and how far its borders are below the surface of the bark, in
/// radii: the bark is uneven.
constexpr double farthest = 1.15, sunk = 0.12;

/// The steepest trunk on which snow stays, as the height of its direction, 0..1.
constexpr double steepest = 0.8;

/// Snow on a trunk is at most so deep, in radii.
constexpr double deepest = 0.9;

/// Sizes of humps and of gaps, metres.
constexpr float hump = 0.35F, gap = 0.8F;

constexpr glm::vec3 white{0.84F, 0.87F, 0.92F};

/// How far the broken ends of a trunk may be from where it ends, in radii.
constexpr double broken = 0.95;

/// Returns how much of the depth lies at each row, by humps and gaps; below 0 there is none.
///
/// foot, top  radii of the ends, metres
std::vector<double> depths(const SnowCapParams& params, const std::vector<double>& at, double foot,
                           double top) {
    Random random(params.seed, purposes::trunk_ends, 2);
    const std::uint32_t of_humps = random.bits(), of_gaps = random.bits();
    std::vector<float> u, v(at.size(), 0.37F), humps(at.size()), gaps(at.size());
    for (const double s : at) u.push_back(static_cast<float>(s) / hump);
    gradient_noise(u, v, of_humps, humps);
    for (std::size_t i = 0; i < at.size(); ++i) u[i] = static_cast<float>(at[i]) / gap;
    gradient_noise(u, v, of_gaps, gaps);
    std::vector<double> depths(at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
        // Towards its ends there is less.
        const double end = std::min(at[i] - broken * foot, params.length - at[i] - broken * top);
        const double tapered = smooth_step(0.0, 0.2, end);
        const double lies =
            smooth_step(-0.2, 0.2, 2.0 * params.cover - 1.0 + 0.8 * static_cast<double>(gaps[i]));
        depths[i] = tapered * lies * (0.85 + 0.5 * static_cast<double>(humps[i])) *
                    std::min(1.0, 2.0 * params.cover);
    }
    return depths;
}

/// Returns the normals of a grid of vertices.
std::vector<glm::vec3> normals_of(const std::vector<glm::vec3>& places, std::size_t columns) {
    const std::size_t rows = places.size() / columns;
    std::vector<glm::vec3> normals;
    normals.reserve(places.size());
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t k = 0; k < columns; ++k) {
            const auto place = [&](std::size_t r, std::size_t c) {
                return glm::dvec3(places[r * columns + c]);
            };
            const glm::dvec3 along =
                place(std::min(row + 1, rows - 1), k) - place(row > 0 ? row - 1 : 0, k);
            const glm::dvec3 across =
                place(row, std::min(k + 1, columns - 1)) - place(row, k > 0 ? k - 1 : 0);
            normals.emplace_back(unit_or(glm::cross(across, along), {0.0, 1.0, 0.0}));
        }
    return normals;
}

/// The vertices of the snow on a whole trunk, row by row.
struct SnowGrid {
    std::size_t columns = 0;
    std::vector<glm::vec3> places, normals;
};

/// Adds the snow between two rows, closed within the trunk.
void add_piece(Mesh& mesh, const SnowGrid& grid, std::size_t first, std::size_t last) {
    const std::size_t columns = grid.columns, start = mesh.positions.size();
    const auto from = static_cast<std::ptrdiff_t>(first * columns),
               to = static_cast<std::ptrdiff_t>((last + 1) * columns);
    mesh.positions.insert(mesh.positions.end(), grid.places.begin() + from,
                          grid.places.begin() + to);
    mesh.normals.insert(mesh.normals.end(), grid.normals.begin() + from, grid.normals.begin() + to);
    mesh.tints.resize(mesh.positions.size(), white);
    const auto at = [&](std::size_t row, std::size_t k) {
        return static_cast<std::uint32_t>(start + row * columns + k);
    };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    };
    const std::size_t end = columns - 1, rows = last - first;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t k = 0; k < end; ++k) {
            add(at(row, k), at(row, k + 1), at(row + 1, k + 1));
            add(at(row, k), at(row + 1, k + 1), at(row + 1, k));
        }
        add(at(row, end), at(row, 0), at(row + 1, 0));
        add(at(row, end), at(row + 1, 0), at(row + 1, end));
    }
    for (std::size_t k = 1; k < end; ++k) {
        add(at(0, 0), at(0, k + 1), at(0, k));
        add(at(rows, 0), at(rows, k), at(rows, k + 1));
    }
}

}  // namespace

Mesh snow_cap(const SnowCapParams& params, const std::function<TrunkSection(double)>& section) {
    if (!(params.length > 0.0)) throw InvalidInput("/length", "a trunk has a positive length");
    if (!(params.step > 0.0)) throw InvalidInput("/step", "is positive");
    if (params.columns < 3) throw InvalidInput("/columns", "there are at least 3");
    Mesh mesh;
    if (!(params.depth > 0.0 && params.cover > 0.0)) return mesh;
    const auto rows = static_cast<std::size_t>(std::ceil(params.length / params.step)) + 1;
    const auto columns = static_cast<std::size_t>(params.columns);
    std::vector<double> at;
    for (std::size_t row = 0; row < rows; ++row)
        at.push_back(params.length * static_cast<double>(row) / static_cast<double>(rows - 1));
    std::vector<TrunkSection> sections;
    sections.reserve(rows);
    for (const double s : at) sections.push_back(section(s));
    const std::vector<double> share =
        depths(params, at, sections.front().radius, sections.back().radius);
    SnowGrid grid{columns, {}, {}};
    std::vector<bool> lies(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const TrunkSection& own = sections[row];
        const glm::dvec3 along = unit_or(
            sections[std::min(row + 1, rows - 1)].middle - sections[row > 0 ? row - 1 : 0].middle,
            {1.0, 0.0, 0.0});
        lies[row] = std::abs(along.y) < steepest && share[row] > 0.05;
        const glm::dvec3 up = square_to(along, {0.0, 1.0, 0.0}), side = glm::cross(along, up);
        const double depth = std::min(params.depth, deepest * own.radius) * share[row];
        for (std::size_t k = 0; k < columns; ++k) {
            const double t = 2.0 * static_cast<double>(k) / static_cast<double>(columns - 1) - 1.0;
            const SineCosine turn = sine_cosine(farthest * t);
            const double round = std::sqrt(std::max(0.0, 1.0 - t * t));
            const glm::dvec3 out = turn.cosine * up + turn.sine * side;
            grid.places.emplace_back(own.middle + own.radius * (1.0 - sunk * (1.0 - round)) * out +
                                     glm::dvec3(0.0, depth * round, 0.0));
        }
    }
    grid.normals = normals_of(grid.places, columns);
    const auto has_snow = [&](std::size_t row) {
        return row + 1 < rows && (lies[row] || lies[row + 1]);
    };
    for (std::size_t row = 0; row < rows; ++row) {
        if (!has_snow(row)) continue;
        const std::size_t first = row;
        while (has_snow(row)) ++row;
        add_piece(mesh, grid, first, row);
    }
    return mesh;
}

}  // namespace sporeprint
