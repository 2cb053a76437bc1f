#include "core/geometry/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/geometry/budget.h"
#include "core/math/elementary.h"
#include "core/mesh/measure.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::geometry_ground_test {
namespace {

constexpr double radius = 0.01;

/// A stem that ends in a half ball at the ground.
FootPoint ball_foot(double depth, double angle) {
    const auto turn = sine_cosine(angle), down = sine_cosine(0.5 * pi * depth);
    const glm::dvec3 outwards(down.cosine * turn.cosine, -down.sine, down.cosine * turn.sine);
    return {radius * outwards, outwards};
}

GroundLayer layer_of(LitterKind kind = LitterKind::leaves, double weight = 1.0) {
    GroundLayer layer;
    layer.style.soil = {0.006, 0.001, 60, 0.0015};
    layer.style.litter.kind = kind;
    layer.style.litter.pieces = 20;
    layer.style.strands.count = 6;
    layer.stream = 7;
    layer.weight = weight;
    return layer;
}

Mesh ground(const std::vector<GroundLayer>& layers, DetailLevel level, bool keep_absent = false,
            std::uint32_t seed = 1) {
    Mesh mesh;
    add_ground(mesh, layers, ball_foot, detail_of(level), seed, true, keep_absent);
    return mesh;
}

constexpr LitterKind all_kinds[] = {LitterKind::leaves, LitterKind::needles, LitterKind::grass,
                                    LitterKind::moss, LitterKind::chips};

double off_axis(const glm::vec3& at) {
    return std::hypot(static_cast<double>(at.x), static_cast<double>(at.z));
}

TEST(Ground, ItHasTheCountsThatArePredicted) {
    const std::vector<GroundLayer> layers = {layer_of(LitterKind::moss, 0.4),
                                             layer_of(LitterKind::chips, 0.0)};
    for (const DetailLevel level : {DetailLevel(0), DetailLevel(0, 3), DetailLevel(1),
                                    DetailLevel(2), DetailLevel(3), DetailLevel(farthest_lod)})
        for (const bool keep : {false, true}) {
            const Mesh mesh = ground(layers, level, keep);
            const MeshCount count = ground_count(layers, detail_of(level), keep);
            EXPECT_EQ(mesh.positions.size(), count.vertices) << level.number();
            EXPECT_EQ(mesh.indices.size(), 3 * count.triangles) << level.number();
        }
}

TEST(Ground, EveryPieceIsClosedAndTurnedOutwards) {
    for (const LitterKind kind : all_kinds)
        for (int lod = 0; lod < 4; ++lod) {
            const Mesh mesh = ground({layer_of(kind)}, lod);
            expect_valid(mesh);
            for (const Mesh& piece : pieces(mesh)) EXPECT_GT(volume(piece), 0.0) << name(kind);
        }
}

TEST(Ground, TheClodSurroundsTheFoot) {
    const double foot = 2.0 / 3.0 * pi * radius * radius * radius;
    for (int lod = 0; lod < 3; ++lod)
        for (const std::uint32_t seed : {1U, 2U, 3U}) {
            const std::vector<Mesh> all = pieces(ground({layer_of()}, lod, false, seed));
            const Mesh& clod = *std::max_element(
                all.begin(), all.end(),
                [](const Mesh& a, const Mesh& b) { return volume(a) < volume(b); });
            EXPECT_GT(volume(clod), 1.1 * foot) << lod << ' ' << seed;
            double nearest = std::numeric_limits<double>::max();
            for (const glm::vec3& at : clod.positions) {
                EXPECT_LT(at.y, 0.003);
                EXPECT_LT(off_axis(at), radius + 2.0 * 0.006);
                // Below the ground nothing of the foot shows through it.
                if (at.y < -0.002F) nearest = std::min(nearest, glm::length(glm::dvec3(at)));
            }
            EXPECT_GT(nearest, radius) << lod << ' ' << seed;
        }
}

TEST(Ground, ASpeciesOfNoWeightIsAPointOnTheFoot) {
    const Mesh mesh = ground({layer_of(LitterKind::grass, 0.0)}, 0, true);
    for (const glm::vec3& at : mesh.positions)
        EXPECT_LT(glm::length(glm::dvec3(at) - ball_foot(1.0, 0.0).place), 1e-8);
    EXPECT_TRUE(ground({layer_of(LitterKind::grass, 0.0)}, 0).indices.empty());
}

TEST(Ground, ItGrowsSteadilyWithTheWeight) {
    constexpr double step = 1e-4;
    for (const LitterKind kind : all_kinds)
        for (const double weight : {0.0, 0.07, 0.15, 0.5, 1.0 - step}) {
            const Mesh a = ground({layer_of(kind, weight)}, 0, true),
                       b = ground({layer_of(kind, weight + step)}, 0, true);
            for (std::size_t i = 0; i < a.positions.size(); ++i)
                EXPECT_LT(glm::length(a.positions[i] - b.positions[i]), 30.0 * step * 0.02)
                    << name(kind) << ' ' << weight;
        }
}

TEST(Ground, SeedsAndSpeciesHaveTheirOwn) {
    GroundLayer other = layer_of();
    other.stream = 8'000'007;
    const Mesh mesh = ground({layer_of()}, 1);
    EXPECT_EQ(mesh.positions, ground({layer_of()}, 1).positions);
    EXPECT_NE(mesh.positions, ground({layer_of()}, 1, false, 2).positions);
    EXPECT_NE(mesh.positions, ground({other}, 1).positions);
}

// Grass and moss stand, everything else lies or leans, and nothing stands in the stem.
TEST(Ground, LitterStandsOrLiesBesideTheStem) {
    for (const LitterKind kind : all_kinds) {
        GroundLayer layer = layer_of(kind);
        layer.style.soil.lumps = layer.style.strands.count = 0;
        layer.style.litter.length = 0.01;
        const bool stands = kind == LitterKind::grass || kind == LitterKind::moss;
        int upright = 0, all = 0;
        for (const Mesh& piece : pieces(ground({layer}, 0))) {
            const Bounds box = bounds(piece);
            upright += box.max.y - box.min.y > 0.003F ? 1 : 0;
            ++all;
            double nearest = radius;
            for (const glm::vec3& at : piece.positions)
                if (at.y > 0.0F) nearest = std::min(nearest, off_axis(at));
            EXPECT_GT(nearest, 0.9 * radius) << name(kind);
        }
        EXPECT_EQ(all, 20);
        if (stands)
            EXPECT_GE(upright, 16) << name(kind);
        else
            EXPECT_LE(upright, 10) << name(kind);
    }
}

Mesh part_of(const Mesh& mesh, Part part) {
    Mesh found;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (part_at(mesh.texture_coordinates[i].x, mesh.texture_coordinates[i].y) == part)
            found.positions.push_back(mesh.positions[i]);
    return found;
}

TEST(Ground, ACleanBaseHasNone) {
    for (const char* id : {"boletus_edulis", "ramaria_formosa"})
        for (const Base base : {Base::natural, Base::clean}) {
            MushroomSpec order = textured(order_of(id, 0.6, 2, 0));
            order.params.base = base;
            const Mesh mesh = mesh_of(order);
            EXPECT_EQ(part_of(mesh, Part::ground).positions.empty(), base == Base::clean) << id;
        }
}

/// Returns the positions of a mesh without those of the ground.
std::vector<glm::vec3> without_ground(const Mesh& mesh) {
    std::vector<glm::vec3> found;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (part_at(mesh.texture_coordinates[i].x, mesh.texture_coordinates[i].y) != Part::ground)
            found.push_back(mesh.positions[i]);
    return found;
}

// It is the first that is left out where triangles are scarce, so it costs nothing else any detail.
TEST(Ground, ItIsAddedToAllSpeciesAndChangesNothingElse) {
    for (const std::string& id : species_ids())
        for (const double age : std::vector{0.6, 0.05, 1.0, 0.3})
            for (int lod = 0; lod < 4; ++lod) {
                if (age != 0.6 && lod != 1) continue;
                const MushroomSpec order = textured(order_of(id, age, 5, lod));
                const Mesh clean = mesh_of(order), natural = mesh_of(on_ground(order));
                expect_valid(natural);
                EXPECT_LE(natural.indices.size() / 3, triangle_limit(DetailLevel(lod)))
                    << id << ' ' << lod;
                if (is_branched(atlas().find(id)->species)) continue;
                EXPECT_EQ(without_ground(natural), clean.positions) << id << ' ' << lod;
            }
}

TEST(Ground, OfAMixItChangesWithTheWeights) {
    for (const int weight : {1, 500, 999}) {
        MushroomSpec order = textured(on_ground(order_of("boletus_edulis", 0.6, 3, 0)));
        order.mix = {{"boletus_edulis", 1000 - weight}, {"marasmius_oreades", weight}};
        const Mesh mesh = mesh_of(order);
        expect_valid(mesh);
        EXPECT_FALSE(part_of(mesh, Part::ground).positions.empty());
    }
}

// The soil lies round a sac, not inside it.
TEST(Ground, SoilSurroundsASac) {
    const Mesh mesh = mesh_of(textured(on_ground(order_of("amanita_phalloides", 0.6, 2, 0))));
    const auto widest = [&](Part part, float from, float to) {
        double most = 0.0;
        for (const glm::vec3& at : part_of(mesh, part).positions)
            if (at.y > from && at.y < to) most = std::max(most, off_axis(at));
        return most;
    };
    EXPECT_GT(widest(Part::ground, -0.003F, 0.001F), widest(Part::veil, -0.003F, 0.003F) + 0.002);
}

}  // namespace
}  // namespace sporeprint::geometry_ground_test
