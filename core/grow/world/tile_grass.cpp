#include "core/grow/world/tile_grass.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/grow/world/mesh_copies.h"
#include "core/grow/world/scattering.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

/// Side of the cells in which tufts stand, metres.
constexpr double cell = 0.5;

constexpr int blades_of_tuft = 6;
constexpr double height_of_tuft = 0.13;

/// The highest tip of a tuft, in its own height; and how far a tuft looks out of the snow at least, metres.
constexpr double highest_blade = 1.2, least_above_snow = 0.03;

constexpr glm::vec3 green_dark(0.035F, 0.075F, 0.012F), green_pale(0.15F, 0.22F, 0.04F),
    dry(0.32F, 0.26F, 0.12F);

/// Adds a blade: a bent strip with a face on each side, so that it is closed.
void add_blade(Mesh& mesh, Random& random, const GrassSeason& season) {
    const double angle = 2.0 * pi * random.uniform(), out = random.uniform(),
                 size = random.uniform(), hue = random.uniform(), bend = random.uniform();
    const SineCosine to = sine_cosine(angle);
    const glm::dvec3 outwards(to.cosine, 0.0, to.sine), across(-to.sine, 0.0, to.cosine),
        up(0.0, 1.0, 0.0);
    const double length = height_of_tuft * (0.6 + 0.6 * size), width = 0.002 + 0.002 * size;
    const glm::dvec3 root = 0.03 * out * outwards - 0.012 * up;
    const glm::dvec3 middle = root + length * ((0.12 + 0.2 * out) * outwards + 0.55 * up);
    const glm::dvec3 tip =
        middle + length * ((0.15 + 0.45 * bend) * outwards + 0.45 * (1.0 - bend) * up);
    const double green = 1.0 - season.dry;
    const glm::vec3 tint =
        hue > green ? dry
                    : static_cast<float>(season.fresh) *
                          glm::mix(green_dark, green_pale, static_cast<float>(hue / green));
    for (const double face : {1.0, -1.0}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        // Light passes through blades and comes from their neighbours: both faces are lit nearly as the ground is.
        const glm::dvec3 normal = glm::normalize(face * 0.4 * (0.8 * outwards - 0.6 * up) + up);
        const auto add = [&](const glm::dvec3& at, float light) {
            mesh.positions.emplace_back(at);
            mesh.normals.emplace_back(normal);
            mesh.tints.push_back(light * tint);
        };
        add(root - width * across, 0.55F);
        add(root + width * across, 0.55F);
        add(middle - 0.8 * width * across, 0.85F);
        add(middle + 0.8 * width * across, 0.85F);
        add(tip, 1.0F);
        for (const auto& [a, b, c] : {std::array{0U, 1U, 2U}, {1U, 3U, 2U}, {2U, 3U, 4U}}) {
            const std::uint32_t second = face > 0.0 ? b : c, third = face > 0.0 ? c : b;
            mesh.indices.insert(mesh.indices.end(), {first + a, first + second, first + third});
        }
    }
}

}  // namespace

Mesh tuft_mesh(std::size_t shape, const GrassSeason& season) {
    Random random(static_cast<std::uint32_t>(1 + shape), purposes::plot_pieces, 3);
    Mesh mesh;
    for (int blade = 0; blade < blades_of_tuft; ++blade) add_blade(mesh, random, season);
    return mesh;
}

std::vector<std::vector<GlbTransform>> tufts_on(const PlotContent& content, const PlotFrame& frame,
                                                const CoverField& cover, int per_cell, double rim) {
    std::vector<std::vector<GlbTransform>> places(tuft_shapes);
    // The surface of the snow is the floor: what grows stands as much lower.
    const double snow = content.snow * content.snow_depth;
    for_each_place(
        content.seed, {cell, per_cell, 4}, frame.box(), rim,
        [](Random& random) { return draw_copy(random, tuft_shapes); },
        [&](double x, double y, const ScatteredCopy& tuft) {
            const double grass = cover.at(x, y).grass;
            if (tuft.chance >= grass * grass) return;
            const double scale = (0.4 + 1.2 * tuft.size) * (0.4 + 0.6 * grass);
            if (snow > 0.0 && highest_blade * height_of_tuft * scale < snow + least_above_snow)
                return;
            const SineCosine half = sine_cosine(pi * tuft.turn);
            places[tuft.shape].push_back({frame.on_floor(x, y) - glm::dvec3(0.0, snow, 0.0),
                                          {0.0, half.sine, 0.0, half.cosine},
                                          glm::dvec3(scale)});
        });
    return places;
}

Mesh grass_of(const PlotContent& content, const PlotFrame& frame, const CoverField& cover,
              std::uint64_t most) {
    const double cells = (content.size / cell) * (content.size / cell);
    constexpr double triangles_of_tuft = 6.0 * blades_of_tuft;
    const double per_cell = std::floor(static_cast<double>(most) / (triangles_of_tuft * cells));
    const int number = std::min(static_cast<int>(per_cell), tufts_of_plot_cell);
    const std::vector<std::vector<GlbTransform>> places =
        tufts_on(content, frame, cover, number, rim_of_grass);
    Mesh all;
    for (std::size_t shape = 0; shape < places.size(); ++shape)
        if (!places[shape].empty())
            append(all,
                   MeshCopies{tuft_mesh(shape, grass_on(content.northern_day())), places[shape]}
                       .merged());
    return all;
}

}  // namespace sporeprint
