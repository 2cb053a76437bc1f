#include "core/world/plot_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/tangents.h"

namespace sporeprint {

namespace {

/// A wave of the floor: its length in metres, and its share of the amplitude.
struct Wave {
    double length, share;
};
constexpr std::array<Wave, 3> waves{{{4.0, 1.0}, {1.7, 0.5}, {0.62, 0.22}}};

/// Deviation of gradient noise.
constexpr double noise_deviation = 0.35;

/// The ground that is raised round a trunk falls to a part of e within so many diameters, and is level after so many times
/// that way.
constexpr double flare_scale = 1.5, flare_end = 5.0;

/// e^-flare_end.
constexpr double flare_rest = 0.006737946999085467;

/// Returns a coordinate as a multiple of 2^-20 m.
double rounded(double metres) { return std::floor(metres * 1048576.0 + 0.5) / 1048576.0; }

/// Returns the number of the column or row of squares of a coordinate.
int square_of(double metres) {
    constexpr double side = 4.0 * most_flare_reach;
    return static_cast<int>(std::floor(metres / side));
}

constexpr glm::vec3 tint_of_wall(0.42F, 0.36F, 0.31F), tint_of_bottom(0.25F, 0.22F, 0.2F);

/// Depths of the rows of vertices of a wall, metres; the last one is the bottom.
constexpr double first_depth = 0.1;

/// Normals of the sides of a slab: north, west, south, east, counter-clockwise from above.
constexpr std::array<glm::vec3, 4> outwards{
    glm::vec3(0.0F, 0.0F, -1.0F), glm::vec3(-1.0F, 0.0F, 0.0F), glm::vec3(0.0F, 0.0F, 1.0F),
    glm::vec3(1.0F, 0.0F, 0.0F)};

/// Returns the vertex of the top of a slab that is the i-th of a side, as the sides go round.
std::size_t on_border(std::size_t side, std::size_t i, std::size_t nodes) {
    const std::size_t end = nodes - 1;
    const std::array<std::size_t, 4> of_side = {end - i, i * nodes, end * nodes + i,
                                                (end - i) * nodes + end};
    return of_side[side];
}

/// A depth of soil, metres, and its colour, linear: litter, humus, topsoil, subsoil.
struct Horizon {
    float depth;
    glm::vec3 colour;
};
constexpr std::array<Horizon, 6> horizons = {{{0.0F, {0.062F, 0.040F, 0.025F}},
                                              {0.03F, {0.040F, 0.028F, 0.020F}},
                                              {0.08F, {0.060F, 0.042F, 0.028F}},
                                              {0.16F, {0.105F, 0.072F, 0.045F}},
                                              {0.26F, {0.190F, 0.125F, 0.072F}},
                                              {1e9F, {0.225F, 0.152F, 0.090F}}}};

/// How far the soil stands before the walls of a slab, metres.
constexpr float soil_thickness = 0.003F;

/// Rows of the subsoil between the last horizon and the bottom of a wall.
constexpr std::uint32_t subsoil_rows = 4;

/// Returns how bright a place of a wall is, about 1: soil is not even.
float unevenness(std::size_t side, std::size_t i, std::size_t row) {
    const std::uint32_t bits =
        philox({static_cast<std::uint32_t>(side), 1, static_cast<std::uint32_t>(i),
                static_cast<std::uint32_t>(row)},
               {0, purposes::floor_noise})[0];
    return 0.82F + 0.36F * static_cast<float>(bits >> 8U) / 16777216.0F;
}

/// Returns the same between places that are some vertices apart, so that soil has patches and no stripes.
float patchiness(std::size_t side, std::size_t i, std::size_t row, std::size_t apart) {
    const float part = static_cast<float>(i % apart) / static_cast<float>(apart),
                from = unevenness(side, i / apart, row), to = unevenness(side, i / apart + 1, row);
    return from + part * part * (3.0F - 2.0F * part) * (to - from);
}

/// Returns how deep horizons lie at a place of a wall, about 1; at its ends, where walls meet, it is 1.
float waviness(std::size_t side, std::size_t i, std::size_t end) {
    constexpr std::size_t apart = 9, row = 1000;
    const float from_end =
        static_cast<float>(std::min({i, end - i, apart})) / static_cast<float>(apart);
    return 1.0F + 2.0F * from_end * (patchiness(side, i, row, apart) - 1.0F);
}

}  // namespace

FloorHeights::FloorHeights(const Ground& ground, std::uint32_t seed, double micro,
                           std::span<const TreeFoot> feet)
    : ground_(&ground), micro_(micro), feet_(feet.begin(), feet.end()) {
    Random random(seed, purposes::floor_noise);
    for (std::size_t k = 0; k < waves.size(); ++k) seeds_.push_back(random.bits());
    constexpr double reach = most_flare_reach;
    for (const TreeFoot& foot : feet_)
        for (int row = square_of(foot.y - reach); row <= square_of(foot.y + reach); ++row)
            for (int column = square_of(foot.x - reach); column <= square_of(foot.x + reach);
                 ++column)
                near_[{column, row}].push_back(foot);
}

void FloorHeights::heights_of(const Row& row, double north, std::span<const TreeFoot> feet,
                              std::span<double> out) const {
    const std::span<const double> x = row.x;
    const Coordinate line = coordinate_at(ground_->grid, north);
    for (std::size_t i = 0; i < x.size(); ++i)
        out[i] = place_at(*ground_, row.columns[i], line).height;
    for (std::size_t k = 0; k < waves.size() && micro_ > 0.0; ++k) {
        // Octaves whose zeros coincide would make a lattice visible.
        const double shift = 0.37 * static_cast<double>(k + 1);
        for (std::size_t i = 0; i < x.size(); ++i) {
            row.u[i] = static_cast<float>(x[i] / waves[k].length + shift);
            row.v[i] = static_cast<float>(north / waves[k].length + shift);
        }
        gradient_noise(row.u, row.v, seeds_[k], row.noise);
        const double factor = micro_ * waves[k].share / (2.0 * noise_deviation);
        for (std::size_t i = 0; i < x.size(); ++i)
            out[i] += factor * static_cast<double>(row.noise[i]);
    }
    for (const TreeFoot& foot : feet) {
        const double dy = north - foot.y, scale = flare_scale * foot.diameter,
                     reach = flare_end * scale;
        if (std::abs(dy) >= reach) continue;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double dx = x[i] - foot.x, square = dx * dx + dy * dy;
            if (square >= reach * reach) continue;
            out[i] += 0.25 * foot.diameter * (exponential(-std::sqrt(square) / scale) - flare_rest);
        }
    }
}

std::vector<double> FloorHeights::at(std::span<const double> x, std::span<const double> y) const {
    std::vector<Coordinate> columns;
    columns.reserve(x.size());
    for (const double metres : x) columns.push_back(coordinate_at(ground_->grid, metres));
    std::vector<float> u(x.size()), v(x.size()), noise(x.size());
    const Row row{x, columns, u, v, noise};
    std::vector<double> heights(x.size() * y.size());
    for (std::size_t i = 0; i < y.size(); ++i)
        heights_of(row, y[i], feet_, std::span(heights).subspan(i * x.size(), x.size()));
    return heights;
}

double FloorHeights::at(double x, double y) const {
    const Coordinate column = coordinate_at(ground_->grid, x);
    float u = 0.0F, v = 0.0F, noise = 0.0F;
    const auto near = near_.find({square_of(x), square_of(y)});
    std::span<const TreeFoot> feet;
    if (near != near_.end()) feet = near->second;
    double height = 0.0;
    heights_of({{&x, 1}, {&column, 1}, {&u, 1}, {&v, 1}, {&noise, 1}}, y, feet, {&height, 1});
    return height;
}

double slab_height(double height, double step) { return std::floor(height / step + 0.5) * step; }

Mesh slab_mesh(const SlabParams& params, const FloorHeights& floor) {
    return slab_mesh(params, [&floor](std::span<const double> x, std::span<const double> y) {
        return floor.at(x, y);
    });
}

Mesh slab_mesh(const SlabParams& params, const GridHeights& heights_at) {
    const auto nodes = static_cast<std::size_t>(params.nodes);
    const double last = params.nodes - 1;
    const double width = params.box.east - params.box.west,
                 length = params.box.north - params.box.south;
    // One more place on each side, for the normals of the border.
    std::vector<double> x, y;
    x.reserve(nodes + 2);
    y.reserve(nodes + 2);
    for (int i = -1; i <= params.nodes; ++i) {
        const double t = i / last;
        // Rounded, so that a place has the same coordinates in neighbouring slabs.
        x.push_back(rounded((1.0 - t) * params.box.west + t * params.box.east));
        y.push_back(rounded((1.0 - t) * params.box.north + t * params.box.south));
    }
    const std::vector<double> heights = heights_at(x, y);
    const auto height = [&](std::size_t column, std::size_t row) {
        return heights[row * (nodes + 2) + column];
    };
    const double step_x = width / last, step_z = length / last;
    const double texels = params.texture_side;
    const auto texture_at = [&](double t) { return (0.5 + t * (texels - 1.0)) / texels; };
    Mesh mesh;
    mesh.positions.reserve(nodes * nodes);
    mesh.normals.reserve(nodes * nodes);
    mesh.tangents.reserve(nodes * nodes);
    mesh.texture_coordinates.reserve(nodes * nodes);
    double lowest = 1e9;
    for (std::size_t row = 0; row < nodes; ++row)
        for (std::size_t column = 0; column < nodes; ++column) {
            const double s = static_cast<double>(column) / last,
                         t = static_cast<double>(row) / last;
            const double up = slab_height(height(column + 1, row + 1), params.step) - params.height;
            lowest = std::min(lowest, up);
            const double east =
                (height(column + 2, row + 1) - height(column, row + 1)) / (2.0 * step_x);
            const double south =
                (height(column + 1, row + 2) - height(column + 1, row)) / (2.0 * step_z);
            const glm::dvec3 normal = glm::normalize(glm::dvec3(-east, 1.0, -south));
            const glm::dvec3 tangent = glm::normalize(glm::dvec3(1.0, east, 0.0));
            mesh.positions.emplace_back((s - 0.5) * width, up, (t - 0.5) * length);
            mesh.normals.emplace_back(normal);
            mesh.tangents.emplace_back(glm::vec3(tangent), 1.0F);
            mesh.texture_coordinates.emplace_back(texture_at(s), texture_at(t));
        }
    const auto index = [&](std::size_t column, std::size_t row) {
        return static_cast<std::uint32_t>(row * nodes + column);
    };
    mesh.indices.reserve(6 * (nodes - 1) * (nodes - 1));
    for (std::size_t row = 0; row + 1 < nodes; ++row)
        for (std::size_t column = 0; column + 1 < nodes; ++column) {
            const std::uint32_t a = index(column, row), b = index(column + 1, row),
                                c = index(column, row + 1), d = index(column + 1, row + 1);
            // Diagonals alternate, so that ridges along either of them are as sharp.
            if ((row + column) % 2 == 0)
                mesh.indices.insert(mesh.indices.end(), {a, c, d, a, d, b});
            else
                mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
        }
    mesh.tints.assign(mesh.positions.size(), glm::vec3(1.0F));

    const auto bottom = static_cast<float>(slab_height(lowest - params.depth, params.step));
    Mesh below;
    const auto add = [&](const glm::vec3& at, const glm::vec3& normal, const glm::vec2& texture,
                         const glm::vec3& tint) {
        below.positions.push_back(at);
        below.normals.push_back(normal);
        below.texture_coordinates.push_back(texture);
        below.tints.push_back(tint);
        return static_cast<std::uint32_t>(below.positions.size() - 1);
    };
    const std::uint32_t middle =
        add({0.0F, bottom, 0.0F}, {0.0F, -1.0F, 0.0F}, {0.5F, 0.5F}, tint_of_bottom);
    std::vector<std::uint32_t> rim;
    rim.reserve(4 * (nodes - 1));
    const std::uint32_t rows = params.is_seen_from_above ? 2 : 3;
    for (std::size_t side = 0; side < 4; ++side) {
        const auto first = static_cast<std::uint32_t>(below.positions.size());
        const glm::vec2 inwards(-outwards[side].x, -outwards[side].z);
        for (std::size_t i = 0; i < nodes; ++i) {
            const std::size_t top = on_border(side, i, nodes);
            const glm::vec3 at = mesh.positions[top];
            const glm::vec2 texture = mesh.texture_coordinates[top];
            for (const float depth : {0.0F, static_cast<float>(first_depth), at.y - bottom}) {
                if (rows == 2 && depth == static_cast<float>(first_depth)) continue;
                // The image goes on as if the floor were folded down.
                const glm::vec2 shown = texture + inwards * (depth / static_cast<float>(width));
                add({at.x, at.y - depth, at.z}, outwards[side],
                    {std::clamp(shown.x, 0.0F, 1.0F), std::clamp(shown.y, 0.0F, 1.0F)},
                    depth > 0.0F ? tint_of_wall : 0.6F * glm::vec3(1.0F));
            }
            below.positions.back().y = bottom;
        }
        for (std::uint32_t i = 0; i + 1 < nodes; ++i)
            for (std::uint32_t k = 0; k + 1 < rows; ++k) {
                const std::uint32_t a = first + rows * i + k, b = a + rows, c = a + 1, d = b + 1;
                below.indices.insert(below.indices.end(), {a, c, d, a, d, b});
            }
        for (std::uint32_t i = 0; i + 1 < nodes; ++i) {
            const std::uint32_t of_wall = first + rows * i + rows - 1;
            rim.push_back(params.is_seen_from_above
                              ? of_wall
                              : add(below.positions[of_wall], {0.0F, -1.0F, 0.0F},
                                    below.texture_coordinates[of_wall], tint_of_bottom));
        }
    }
    for (std::size_t i = 0; i < rim.size(); ++i)
        below.indices.insert(below.indices.end(), {middle, rim[(i + 1) % rim.size()], rim[i]});
    add_tangents(below);
    append(mesh, below);
    return mesh;
}

Mesh soil_round(const Mesh& slab, const SlabParams& params) {
    const auto nodes = static_cast<std::uint32_t>(params.nodes), end = nodes - 1;
    float bottom = slab.positions.front().y;
    for (const glm::vec3& at : slab.positions) bottom = std::min(bottom, at.y);
    const glm::vec3 corner = slab.positions[on_border(2, end, nodes)];
    const glm::vec3 wider(1.0F + soil_thickness / corner.x, 1.0F, 1.0F + soil_thickness / corner.z);
    const auto of_horizons = static_cast<std::uint32_t>(horizons.size()) - 1,
               rows = of_horizons + subsoil_rows + 1;
    Mesh soil;
    for (std::size_t side = 0; side < 4; ++side) {
        const auto first = static_cast<std::uint32_t>(soil.positions.size());
        const auto add = [&](const glm::vec3& at, const glm::vec3& normal, const glm::vec3& tint) {
            soil.positions.push_back(at);
            soil.normals.push_back(normal);
            soil.tints.push_back(tint);
        };
        // Of each place the horizons before the wall, and the upper and the lower end behind them.
        for (std::uint32_t i = 0; i < nodes; ++i) {
            const glm::vec3 top = slab.positions[on_border(side, i, nodes)];
            const float whole = top.y - bottom, wavy = waviness(side, i, end),
                        subsoil = std::min(wavy * horizons[of_horizons - 1].depth, whole);
            for (std::uint32_t row = 0; row < rows; ++row) {
                const bool is_horizon = row < of_horizons;
                const float part = is_horizon ? 0.0F
                                              : static_cast<float>(row + 1 - of_horizons) /
                                                    static_cast<float>(subsoil_rows + 1);
                const float depth = is_horizon ? std::min(wavy * horizons[row].depth, whole)
                                               : subsoil + part * (whole - subsoil);
                add(wider * glm::vec3(top.x, row + 1 == rows ? bottom : top.y - depth, top.z),
                    outwards[side],
                    patchiness(side, i, row, 2 + row) *
                        horizons[std::min(row, of_horizons)].colour);
            }
            add({top.x, bottom, top.z}, -outwards[side], horizons.back().colour);
            add(top, -outwards[side], horizons.front().colour);
        }
        const std::uint32_t round = rows + 2;
        for (std::uint32_t i = 0; i < end; ++i)
            for (std::uint32_t k = 0; k < round; ++k) {
                const std::uint32_t a = first + round * i + k, b = a + round,
                                    c = first + round * i + (k + 1) % round, d = c + round;
                soil.indices.insert(soil.indices.end(), {a, c, d, a, d, b});
            }
    }
    return soil;
}

}  // namespace sporeprint
