#include "core/grow/world/ferns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/grow/world/scattering.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/problems.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// The preset of their fronds.
constexpr const char* frond_preset = "fern";

/// Fronds of a rosette, and how many different ones there are: copies are turned and scaled.
constexpr int fewest_fronds = 6, most_fronds = 11, frond_shapes = 3;

/// Sides of the cells in which ferns stand, and of those over which their number varies, metres; and how many stand in a
/// cell at most.
constexpr double cell = 1.0, patch = 6.0;
constexpr int most_in_cell = 2;

/// Texels along the sides of the images of fronds in plots.
constexpr int texture_side = 256;

/// Rotates a vector by the sine and cosine of an angle about the axis to the right, then about the vertical axis.
glm::dvec3 raised_and_turned(const glm::dvec3& at, const SineCosine& raised,
                             const SineCosine& turned) {
    const glm::dvec3 up(at.x, raised.cosine * at.y + raised.sine * at.z,
                        raised.cosine * at.z - raised.sine * at.y);
    return {turned.cosine * up.x + turned.sine * up.z, up.y,
            turned.cosine * up.z - turned.sine * up.x};
}

/// Returns whether a place is free of feet of trees and of trunks that lie.
bool is_free(const PlotContent& content, double x, double y) {
    constexpr double beside = 0.12;
    for (const StandTree& tree : content.trees) {
        const double east = metres(tree.at.x) - x, north = metres(tree.at.y) - y;
        if (std::abs(east) > 2.0 || std::abs(north) > 2.0 || !tree.lives_at(content.time)) continue;
        const double foot = 0.8 * trunk_diameter(height_at(tree, content.time)) + beside;
        if (east * east + north * north < foot * foot) return false;
    }
    for (const DeadWood& wood : content.dead_wood) {
        const bool lies = wood.lies_at(content.time);
        if (!lies && !wood.stands_at(content.time)) continue;
        const SineCosine turn = sine_cosine(wood.direction);
        const glm::dvec2 way(turn.cosine, turn.sine),
            at = glm::dvec2(x, y) - glm::dvec2(metres(wood.at.x), metres(wood.at.y));
        const double along =
            lies ? std::clamp(glm::dot(at, way), 0.0, length_at(wood, content.time)) : 0.0;
        if (glm::distance(at, along * way) < radius_at(wood, content.time) + beside) return false;
    }
    return true;
}

}  // namespace

FernSeason ferns_on(int day) {
    const double d = day;
    FernSeason season;
    season.unrolled = smooth_step(112.0, 158.0, d) * (1.0 - smooth_step(300.0, 322.0, d));
    season.autumn = std::floor(8.0 * smooth_step(262.0, 312.0, d) + 0.5) / 8.0;
    return season;
}

Mesh fern_mesh(const LeafShape& frond, std::uint32_t individual, int lod) {
    std::array<Mesh, frond_shapes> shapes;
    for (std::uint32_t k = 0; k < frond_shapes; ++k)
        shapes[k] = leaf_mesh(individual_leaf(frond, 1 + frond_shapes * individual + k, 0.8), lod);
    Random random(1 + individual, purposes::plot_pieces, 44);
    // Each rosette has its own number of fronds, and is more upright or flatter than others.
    const int fronds =
        fewest_fronds + static_cast<int>(random.bits() % (most_fronds - fewest_fronds + 1));
    const double upright = 42.0 + 14.0 * random.uniform();
    Mesh rosette;
    for (int k = 0; k < fronds; ++k) {
        const double turn = random.symmetric(), rise = random.uniform(), size = random.uniform(),
                     out = random.uniform(), hue = random.uniform();
        const SineCosine raised = sine_cosine(radians(upright + 26.0 * rise)),
                         turned = sine_cosine(2.0 * pi * (k + 0.3 * turn) / fronds);
        const double scale = 0.75 + 0.35 * size;
        Mesh one = shapes[static_cast<std::size_t>(k) % frond_shapes];
        for (glm::vec3& at : one.positions)
            at = glm::vec3(raised_and_turned(scale * glm::dvec3(at), raised, turned) +
                           (0.02 + 0.02 * out) * glm::dvec3(turned.sine, 0.0, turned.cosine));
        for (glm::vec3& normal : one.normals)
            normal = glm::vec3(raised_and_turned(glm::dvec3(normal), raised, turned));
        for (glm::vec4& tangent : one.tangents)
            tangent = glm::vec4(
                glm::vec3(raised_and_turned(glm::dvec3(glm::vec3(tangent)), raised, turned)),
                tangent.w);
        // Fronds shade each other where they are close together.
        const glm::dvec3 light(0.46 + 0.2 * hue, 0.56 + 0.14 * hue, 0.5);
        one.tints.clear();
        for (const glm::vec3& at : one.positions) {
            const double x = at.x, z = at.z, away = std::sqrt(x * x + z * z);
            one.tints.emplace_back(light *
                                   smooth_step(-0.4 * frond.length, 0.6 * frond.length, away));
        }
        append(rosette, one);
    }
    return rosette;
}

std::vector<std::vector<GlbTransform>> fern_places(const PlotContent& content,
                                                   const PlotFrame& frame, const CoverField& cover,
                                                   double rim) {
    std::vector<std::vector<GlbTransform>> places(fern_shapes);
    const FernSeason season = ferns_on(content.northern_day());
    // Snow lays fronds down.
    if (season.unrolled <= 0.0 || content.snow > 0.5) return places;
    for_each_place(
        content.seed, {cell, most_in_cell, 45}, frame.box(), rim,
        [](Random& random) { return draw_copy(random, fern_shapes); },
        [&](double x, double y, const ScatteredCopy& fern) {
            Random of_patch(content.seed, purposes::plot_pieces, 46,
                            {cell_of(x, patch), cell_of(y, patch)});
            const double here = of_patch.uniform();
            const Cover ground = cover.at(x, y);
            const double damp = std::min(1.0, 0.6 * ground.moss + 1.5 * ground.herb) *
                                (1.0 - ground.grass) * (1.0 - ground.water);
            // Where they are frequent they stand close together, and elsewhere hardly at all.
            if (fern.chance >= 0.6 * damp * here * here * here || !is_free(content, x, y)) return;
            const double scale = (0.7 + 0.7 * fern.size) * (0.3 + 0.7 * season.unrolled);
            const SineCosine half = sine_cosine(pi * fern.turn);
            places[fern.shape].push_back(
                {frame.on_floor(x, y), {0.0, half.sine, 0.0, half.cosine}, glm::dvec3(scale)});
        });
    return places;
}

std::vector<PlotLeaves> ferns_of(const PlotContent& content, const PlotFrame& frame,
                                 const CoverField& cover, int lod, const Atlas& atlas, double rim) {
    std::vector<std::vector<GlbTransform>> places = fern_places(content, frame, cover, rim);
    std::vector<PlotLeaves> ferns;
    for (std::uint32_t shape = 0; shape < fern_shapes; ++shape) {
        if (places[shape].empty()) continue;
        const LeafPreset* const preset = atlas.find_leaf(frond_preset);
        if (preset == nullptr) throw InvalidInput("/ferns", "there is no leaf of a fern");
        PlotLeaves own;
        own.preset = preset->id.string();
        own.leaf = params_of(*preset);
        own.leaf.autumn = ferns_on(content.northern_day()).autumn;
        own.leaf.texture_size.value = texture_side;
        own.one = fern_mesh(shape_of(own.leaf), shape, lod);
        own.places = std::move(places[shape]);
        ferns.push_back(std::move(own));
    }
    return ferns;
}

}  // namespace sporeprint
