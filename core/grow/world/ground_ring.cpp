#include "core/grow/world/ground_ring.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "core/problems.h"

namespace sporeprint {

namespace {

/// Returns places from one to another, at distances that grow from `finest`; the first one is left out.
std::vector<double> lines_outwards(double from, double to, double finest, double growth) {
    const double length = std::abs(to - from), sign = to < from ? -1.0 : 1.0;
    std::vector<double> distances;
    for (double at = finest; at < length; at += finest + growth * at) distances.push_back(at);
    // The last step ends at the border.
    if (!distances.empty() && length - distances.back() < 0.5 * finest) distances.pop_back();
    std::vector<double> lines;
    lines.reserve(distances.size() + 1);
    for (const double distance : distances) lines.push_back(from + sign * distance);
    if (length > 0.0) lines.push_back(to);
    return lines;
}

/// Returns the columns or rows of a ring, ascending.
std::vector<double> lines_of(double low, double high, std::pair<double, double> hole, double finest,
                             double growth) {
    std::vector<double> lines = lines_outwards(hole.first, low, finest, growth);
    std::reverse(lines.begin(), lines.end());
    lines.push_back(hole.first);
    const double inner = hole.second - hole.first;
    const auto parts = static_cast<int>(std::ceil(inner / finest - 1e-9));
    for (int i = 1; i < parts; ++i) lines.push_back(hole.first + inner * i / parts);
    if (inner > 0.0) lines.push_back(hole.second);
    for (const double line : lines_outwards(hole.second, high, finest, growth))
        lines.push_back(line);
    return lines;
}

void check(const GroundRingParams& params) {
    if (!params.hole) return;
    const WorldBox &box = params.box, &hole = *params.hole;
    if (hole.west < box.west || hole.south < box.south || hole.east > box.east ||
        hole.north > box.north)
        throw InvalidInput("/hole", "reaches beyond its box");
}

/// Returns places with one more at each end, for the slopes at the borders.
std::vector<double> with_ends(const std::vector<double>& lines) {
    std::vector<double> out;
    out.reserve(lines.size() + 2);
    out.push_back(2.0 * lines.front() - lines[1]);
    out.insert(out.end(), lines.begin(), lines.end());
    out.push_back(2.0 * lines.back() - lines[lines.size() - 2]);
    return out;
}

/// Adds the wall below a border, which is given counter-clockwise as seen from above; clockwise round a hole.
void add_wall(Mesh& mesh, const std::vector<std::uint32_t>& border, float depth) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const std::uint32_t top : border) {
        mesh.positions.push_back(mesh.positions[top] - glm::vec3(0.0F, depth, 0.0F));
        mesh.normals.push_back(mesh.normals[top]);
        mesh.tangents.push_back(mesh.tangents[top]);
        mesh.texture_coordinates.push_back(mesh.texture_coordinates[top]);
    }
    for (std::uint32_t i = 0; i + 1 < border.size(); ++i)
        mesh.indices.insert(mesh.indices.end(), {border[i], first + i, first + i + 1, border[i],
                                                 first + i + 1, border[i + 1]});
}

}  // namespace

Mesh ground_ring(const GroundRingParams& params, const GridHeights& heights_at) {
    check(params);
    const WorldBox& box = params.box;
    const double middle_x = 0.5 * (box.west + box.east), middle_y = 0.5 * (box.south + box.north);
    const WorldBox hole = params.hole.value_or(WorldBox{middle_x, middle_y, middle_x, middle_y});
    const std::vector<double> x = lines_of(box.west, box.east, {hole.west, hole.east},
                                           params.finest, params.growth),
                              y = lines_of(box.south, box.north, {hole.south, hole.north},
                                           params.finest, params.growth);
    const std::vector<double> wide_x = with_ends(x), wide_y = with_ends(y);
    const std::vector<double> heights = heights_at(wide_x, wide_y);
    const auto height = [&](std::size_t column, std::size_t row) {
        return heights[row * wide_x.size() + column];
    };
    const double texels = params.texture_side;
    const auto texture_at = [&](double t) {
        return static_cast<float>((0.5 + t * (texels - 1.0)) / texels);
    };
    Mesh mesh;
    const std::size_t all = x.size() * y.size();
    mesh.positions.reserve(all);
    mesh.normals.reserve(all);
    mesh.tangents.reserve(all);
    mesh.texture_coordinates.reserve(all);
    for (std::size_t row = 0; row < y.size(); ++row)
        for (std::size_t column = 0; column < x.size(); ++column) {
            const double up = height(column + 1, row + 1) - params.height;
            const double east = (height(column + 2, row + 1) - height(column, row + 1)) /
                                (wide_x[column + 2] - wide_x[column]);
            const double north = (height(column + 1, row + 2) - height(column + 1, row)) /
                                 (wide_y[row + 2] - wide_y[row]);
            mesh.positions.emplace_back(x[column] - middle_x, up, middle_y - y[row]);
            mesh.normals.emplace_back(glm::normalize(glm::dvec3(-east, 1.0, north)));
            mesh.tangents.emplace_back(glm::vec3(glm::normalize(glm::dvec3(1.0, east, 0.0))), 1.0F);
            mesh.texture_coordinates.emplace_back(
                texture_at((x[column] - box.west) / (box.east - box.west)),
                texture_at((box.north - y[row]) / (box.north - box.south)));
        }
    const auto index = [&](std::size_t column, std::size_t row) {
        return static_cast<std::uint32_t>(row * x.size() + column);
    };
    const auto is_in_hole = [&](std::size_t column, std::size_t row) {
        return params.hole && x[column] >= hole.west && x[column + 1] <= hole.east &&
               y[row] >= hole.south && y[row + 1] <= hole.north;
    };
    for (std::size_t row = 0; row + 1 < y.size(); ++row)
        for (std::size_t column = 0; column + 1 < x.size(); ++column) {
            if (is_in_hole(column, row)) continue;
            const std::uint32_t a = index(column, row), b = index(column + 1, row),
                                c = index(column, row + 1), d = index(column + 1, row + 1);
            // Diagonals alternate, as in a slab. Rows go to the north, which is -z.
            if ((row + column) % 2 == 0)
                mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
            else
                mesh.indices.insert(mesh.indices.end(), {a, b, c, b, d, c});
        }
    std::vector<std::uint32_t> border;
    for (std::size_t i = 0; i < x.size(); ++i) border.push_back(index(i, 0));
    for (std::size_t i = 1; i < y.size(); ++i) border.push_back(index(x.size() - 1, i));
    for (std::size_t i = x.size() - 1; i-- > 0;) border.push_back(index(i, y.size() - 1));
    for (std::size_t i = y.size() - 1; i-- > 0;) border.push_back(index(0, i));
    add_wall(mesh, border, static_cast<float>(params.skirt));
    if (!params.hole) return mesh;
    const auto line = [](const std::vector<double>& lines, double at) {
        return static_cast<std::size_t>(std::ranges::find(lines, at) - lines.begin());
    };
    const std::size_t west = line(x, hole.west), east = line(x, hole.east),
                      south = line(y, hole.south), north = line(y, hole.north);
    border.clear();
    for (std::size_t i = south; i < north; ++i) border.push_back(index(west, i));
    for (std::size_t i = west; i < east; ++i) border.push_back(index(i, north));
    for (std::size_t i = north; i > south; --i) border.push_back(index(east, i));
    for (std::size_t i = east + 1; i-- > west;) border.push_back(index(i, south));
    add_wall(mesh, border, static_cast<float>(params.skirt));
    return mesh;
}

}  // namespace sporeprint
