#include "core/build/ornaments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

constexpr std::uint32_t corner_purpose = 21, ruffle_purpose = 22;
constexpr const Chart& veil = swept_charts[static_cast<std::size_t>(Part::veil)];

glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& fallback) {
    const double square = glm::dot(v, v);
    return square > 1e-30 ? v / std::sqrt(square) : fallback;
}

/// `direction` made unit and square to a unit normal; any such direction when it has none.
glm::dvec3 square_to(const glm::dvec3& normal, const glm::dvec3& direction) {
    const glm::dvec3 other =
        std::abs(normal.x) < 0.8 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 flat = direction - glm::dot(direction, normal) * normal;
    // Much shorter than it was: almost parallel to the normal, so its direction is rounding noise.
    if (glm::dot(flat, flat) > 1e-8 * glm::dot(direction, direction)) return unit_or(flat, other);
    return unit_or(other - glm::dot(other, normal) * normal, other);
}

/// A closed solid made of a grid of corners: rows from its base to its tip, columns round it, the first column repeated.
struct Solid {
    std::vector<glm::dvec3> corners;  ///< [row][column]
    std::vector<glm::dvec3> normals;  ///< worked out by append()
    int rows = 0, columns = 0;        ///< columns without the repeated one
    bool loops =
        false;  ///< the last row meets the first (a ring); else the base is closed by a polygon
};

/// Appends a solid: normals by area over what shares a place, texture from the veil's strip. Without `drawn` its vertices alone.
void append(Mesh& mesh, Solid& solid, const glm::dvec3& fallback, bool textured, bool drawn) {
    const std::size_t indices = mesh.indices.size();
    const int row = solid.columns + 1;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto at = [&](int i, int j) { return static_cast<std::size_t>(i * row + j); };
    const auto& p = solid.corners;
    const bool pointed = !solid.loops;  // its last row is one place
    std::vector<glm::dvec3>& normals = solid.normals;
    normals.assign(p.size(), glm::dvec3(0.0));
    glm::dvec3 tip(0.0);
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        const glm::dvec3 n = glm::cross(p[b] - p[a], p[c] - p[a]);
        normals[a] += n;
        normals[b] += n;
        normals[c] += n;
        mesh.indices.insert(mesh.indices.end(), {first + static_cast<std::uint32_t>(a),
                                                 first + static_cast<std::uint32_t>(b),
                                                 first + static_cast<std::uint32_t>(c)});
    };
    const int bands = solid.loops ? solid.rows : solid.rows - 1;
    for (int i = 0; i < bands; ++i)
        for (int j = 0; j < solid.columns; ++j) {
            const int above = (i + 1) % solid.rows;
            add(at(i, j), at(i, j + 1), at(above, j));
            if (!(pointed && above == solid.rows - 1))
                add(at(i, j + 1), at(above, j + 1), at(above, j));
        }
    for (int i = 0; i < solid.rows; ++i) {
        normals[at(i, 0)] += normals[at(i, solid.columns)];
        normals[at(i, solid.columns)] = normals[at(i, 0)];
    }
    if (pointed) {
        for (int j = 0; j < solid.columns; ++j) tip += normals[at(solid.rows - 1, j)];
        for (int j = 0; j <= solid.columns; ++j) normals[at(solid.rows - 1, j)] = tip;
    }
    for (int i = 0; i < solid.rows; ++i)
        for (int j = 0; j <= solid.columns; ++j) {
            const glm::dvec3 normal = unit_or(normals[at(i, j)], fallback);
            mesh.positions.emplace_back(p[at(i, j)]);
            mesh.normals.emplace_back(normal);
            if (!textured) continue;
            const double along =
                solid.loops ? std::min(i, solid.rows - 1 - i) / (0.5 * solid.rows - 1.0 + 1e-9)
                            : static_cast<double>(i) / (solid.rows - 1);
            const TexturePoint uv =
                strip_point(veil, static_cast<double>(j) / solid.columns, std::min(along, 1.0));
            mesh.texture_coordinates.emplace_back(uv.u, uv.v);
            const int ahead = j < solid.columns ? j + 1 : 1,
                      behind = j > 0 ? j - 1 : solid.columns - 1;
            const int side = pointed && i == solid.rows - 1 ? i - 1 : i;
            const glm::dvec3 tangent = p[at(side, ahead)] - p[at(side, behind)];
            // Going round counter-clockwise with the tip above, image-up is towards the base; the ring's other side is mirrored.
            const bool mirrored = solid.loops && i >= solid.rows / 2;
            mesh.tangents.emplace_back(glm::vec3(square_to(normal, tangent)),
                                       mirrored ? 1.0F : -1.0F);
        }
    if (!drawn) mesh.indices.resize(indices);
    if (solid.loops) return;
    // The base, seen from below.
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    glm::dvec3 below(0.0);
    for (int j = 1; j + 1 < solid.columns; ++j)
        below += glm::cross(p[at(0, j + 1)] - p[at(0, 0)], p[at(0, j)] - p[at(0, 0)]);
    below = unit_or(below, -fallback);
    for (int j = 0; j < solid.columns; ++j) {
        mesh.positions.emplace_back(p[at(0, j)]);
        mesh.normals.emplace_back(below);
        if (!textured) continue;
        const TexturePoint uv = strip_point(veil, static_cast<double>(j) / solid.columns, 0.0);
        mesh.texture_coordinates.emplace_back(uv.u, uv.v);
        mesh.tangents.emplace_back(glm::vec3(square_to(below, p[at(0, 1)] - p[at(0, 0)])), 1.0F);
    }
    for (int j = 1; drawn && j + 1 < solid.columns; ++j)
        mesh.indices.insert(mesh.indices.end(), {base, base + static_cast<std::uint32_t>(j + 1),
                                                 base + static_cast<std::uint32_t>(j)});
}

/// Adds the pieces of one layer.
void add_layer(Mesh& mesh, const PatchLayer& layer, const Ground& ground) {
    if (ground.detail.patch_sides == 0) return;
    const PatchStyle& style = layer.style;
    // Positions run up the stem, or from the apex down.
    const bool on_stem = layer.purpose == volva_purpose;
    const SubCurve& curve = on_stem ? ground.outline.stem : ground.outline.cap;
    const double length = ground.outline.cap.length();
    const int sides = ground.detail.patch_sides, between = ground.detail.patch_rings;
    Solid solid;
    for (const Patch& patch : patches(style, ground.seed, layer.purpose)) {
        const double scale = layer.weight * patch_scale(patch, layer.amount);
        const OutlineSample at = curve.at(on_stem ? patch.sigma : 1.0 - patch.sigma);
        const SurfacePoint place =
            ground.skin.at(on_stem ? Part::stem : Part::cap, at, ground.skin.column(patch.theta));
        glm::dvec3 normal = glm::cross(place.meridian, place.azimuth), meridian = place.meridian;
        if (!ground.skin.plain()) {
            normal = unit_or(normal, glm::dvec3(0.0, 1.0, 0.0));
            meridian = square_to(normal, meridian);
        }
        const glm::dvec3 outward = on_stem ? meridian : -meridian;
        // (round, outward, normal) is right-handed, so that corners run counter-clockwise seen from outside.
        const glm::dvec3 round = glm::cross(outward, normal);
        const double radius = patch.radius * scale * length, height = patch.height * radius;
        const glm::dvec3 centre = place.position;
        const AxisStation station = ground.deformer.frozen_station(
            on_stem ? std::min(at.y, ground.deformer.top()) : ground.deformer.top());
        solid.rows = between + 2;
        solid.columns = sides;
        solid.corners.clear();
        Random random(ground.seed, corner_purpose + layer.purpose, patch.id);
        // Seven draws whatever the detail; a coarser outline takes some of them, so that its corners lie on the finer one.
        std::array<double, 7> reach{};
        for (double& r : reach) r = random.uniform(0.78, 1.12);
        const double tip_round = 0.25 * random.symmetric();
        const double tip_outward = 0.25 * random.symmetric() + 1.1 * style.lift;
        std::array<glm::dvec3, 7> rim{};
        for (int j = 0; j < sides; ++j) {
            const auto turn = sine_cosine(patch.spin + 2.0 * pi * j / sides);
            rim[static_cast<std::size_t>(j)] =
                radius * reach[static_cast<std::size_t>(j * 7 / sides)] *
                (turn.cosine * round + turn.sine * style.elongation * outward);
        }
        const glm::dvec3 tip =
            radius * (tip_round * round + tip_outward * style.elongation * outward);
        for (int i = 0; i < solid.rows; ++i) {
            const double up = static_cast<double>(i) / (solid.rows - 1);
            const double narrowing = 1.0 - up * (0.45 + 0.55 * up);
            const glm::dvec3 middle =
                centre + up * tip + (i == 0 ? -0.25 * radius : height * up) * normal;
            for (int j = 0; j < sides; ++j)
                solid.corners.push_back(middle + narrowing * rim[static_cast<std::size_t>(j)]);
            solid.corners.push_back(
                solid.corners[solid.corners.size() - static_cast<std::size_t>(sides)]);
        }
        ground.deformer.apply(solid.corners, station);
        const glm::dvec3 fallback =
            unit_or(station.direction(centre, normal), glm::dvec3(0.0, 1.0, 0.0));
        append(mesh, solid, fallback, ground.textured, radius > 0.0 || ground.keep_absent);
    }
}

/// Where the stem has a height; its outline may swell, but rises as a whole.
OutlineSample stem_at(const SubCurve& stem, double height) {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (stem.at(middle).y < height ? low : high) = middle;
    }
    return stem.at(0.5 * (low + high));
}

}  // namespace

int piece_count(const PatchLayer& layer) {
    return std::abs(layer.style.to - layer.style.from) < least_window ? 0 : layer.style.count;
}

void add_patches(Mesh& mesh, const Individual& individual, const Ground& ground) {
    for (const PatchLayer& layer : individual.layers) add_layer(mesh, layer, ground);
}

void add_ring(Mesh& mesh, const Individual& individual, const Ground& ground) {
    const RingStyle& style = individual.ring;
    const int rings = ground.detail.veil_rings;
    if (rings == 0 || !individual.has_ring) return;
    const double height =
        ground.deformer.base() + style.height * (ground.deformer.top() - ground.deformer.base());
    const OutlineSample attachment = stem_at(ground.outline.stem, height);
    const double width = style.width;
    const double thickness = std::min(style.thickness, 0.3 * width);
    Random random(ground.seed, ruffle_purpose);
    const int waves = 5 + static_cast<int>(random.bits() % 4);
    const double phase = random.uniform(0.0, 2.0 * pi);
    const double other = random.uniform(0.0, 2.0 * pi);
    const AxisStation station = ground.deformer.frozen_station(height);

    // Centre line of the cross-section: leaves the stem at the flare and hangs down towards its edge.
    struct Station {
        double r, y, normal_r, normal_y, share;
    };
    std::vector<Station> line;
    // A little inside the stem; a ring that comes or goes no deeper than it is wide.
    const double sunk = std::min(0.02 * attachment.r, 0.25 * width);
    double r = std::max(attachment.r - 0.5 * thickness - sunk, thickness), y = height;
    for (int i = 0; i <= rings; ++i) {
        const double share = static_cast<double>(i) / rings;
        const auto turn = sine_cosine(radians(style.flare_deg) * (1.0 - 0.45 * share));
        line.push_back({r, y, turn.cosine, turn.sine, share});
        r += width / rings * turn.sine;
        y -= width / rings * turn.cosine;
    }
    struct Column {
        SineCosine turn;
        double ruffle;
    };
    std::vector<Column> columns;
    for (int j = 0; j <= ground.detail.columns; ++j) {
        const double angle = -2.0 * pi * (j % ground.detail.columns) /
                             ground.detail.columns;  // counter-clockwise seen from above
        columns.push_back({sine_cosine(angle), sine(waves * angle + phase) +
                                                   0.6 * sine((2 * waves + 1) * angle + other)});
    }
    // The veil tears off level with its edge, which is thicker.
    Solid solid{{}, {}, 2 * (rings + 1), ground.detail.columns, true};
    for (int i = 0; i < solid.rows; ++i) {
        const bool lower = i <= rings;
        const Station& at = line[static_cast<std::size_t>(lower ? i : solid.rows - 1 - i)];
        const double half = (lower ? -0.5 : 0.5) * thickness * (0.6 + 0.8 * at.share);
        const double ruffled = style.ruffle * 0.16 * width * at.share * at.share;
        for (const Column& column : columns) {
            const double off = half + ruffled * column.ruffle;
            const double rr = at.r + off * at.normal_r, yy = at.y + off * at.normal_y;
            solid.corners.push_back(
                ground.skin.azimuth().moved({rr * column.turn.cosine, yy, rr * column.turn.sine}));
        }
    }
    ground.deformer.apply(solid.corners, station);
    append(mesh, solid, glm::dvec3(0.0, 1.0, 0.0), ground.textured,
           width > 0.0 || ground.keep_absent);
}

}  // namespace sporeprint
