#include "core/geometry/spines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "core/geometry/budget.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::geometry_spines_test {
namespace {

SpineLayer layer_of(int count, double length, double droop) {
    SpineStyle style;
    style.count = count;
    style.length = length;
    style.width = 0.1 * length + 1e-6;
    style.droop = droop;
    style.unevenness = 0.0;
    return {style, 1.0};
}

Mesh spines(const SpineLayer& layer, const glm::dvec3& outwards, int lod = 0) {
    Mesh mesh;
    add_spines(mesh, layer, detail_of(lod), 7, false, false, [&](int k) {
        return SpineRoot{glm::dvec3(0.1 * k, 0.0, 0.0), outwards};
    });
    return mesh;
}

TEST(Spines, PlacesAreEvenHoweverManyAreUsed) {
    int left = 0, low = 0, both = 0;
    for (int k = 0; k < 3000; ++k) {
        const SpinePlace at = spine_place(k);
        ASSERT_GE(at.along, 0.0);
        ASSERT_LT(at.along, 1.0);
        ASSERT_GE(at.round, 0.0);
        ASSERT_LT(at.round, 1.0);
        left += at.along < 0.5 ? 1 : 0;
        low += at.round < 0.5 ? 1 : 0;
        both += at.along < 0.5 && at.round < 0.5 ? 1 : 0;
        EXPECT_NEAR(left, 0.5 * (k + 1), 3.0);
        EXPECT_NEAR(low, 0.5 * (k + 1), 3.0);
        EXPECT_NEAR(both, 0.25 * (k + 1), 8.0);
    }
}

TEST(Spines, AreClosedAndCountedInAdvance) {
    for (int lod = 0; lod < 4; ++lod) {
        const std::vector<SpineLayer> layers = {layer_of(50, 0.02, 0.8)};
        const Mesh mesh = spines(layers[0], {0.0, 0.0, 1.0}, lod);
        const MeshCount count = spine_count(layers, detail_of(lod));
        EXPECT_EQ(mesh.positions.size(), count.vertices);
        EXPECT_EQ(mesh.triangles(), count.triangles);
        const std::vector<Mesh> found = pieces(mesh);
        EXPECT_EQ(found.size(), lod < 3 ? 50u : 25u);
        for (const Mesh& piece : found) EXPECT_GT(volume(piece), 0.0);
    }
}

TEST(Spines, HangWhenTheyDroopAndStandWhenTheyDoNot) {
    const auto tips = [](const Mesh& mesh) {
        std::vector<glm::dvec3> farthest;
        for (const Mesh& piece : pieces(mesh)) {
            // The base is at the root, whose place is a multiple of 0.1 on the x-axis.
            glm::dvec3 tip(0.0);
            for (const glm::vec3& p : piece.positions) {
                glm::dvec3 from(p);
                from.x -= 0.1 * std::floor(from.x / 0.1 + 0.5);
                if (glm::length(from) > glm::length(tip)) tip = from;
            }
            farthest.push_back(tip);
        }
        return farthest;
    };
    for (const glm::dvec3& tip : tips(spines(layer_of(20, 0.02, 1.0), {0.0, 0.0, 1.0}))) {
        EXPECT_LT(tip.y, -0.017);
        EXPECT_LT(tip.z, 0.006);
    }
    for (const glm::dvec3& tip : tips(spines(layer_of(20, 0.02, 0.0), {0.0, 0.0, 1.0}))) {
        EXPECT_GT(tip.z, 0.02);
        EXPECT_LT(std::abs(tip.y), 0.005);
    }
}

TEST(Spines, ShaggyOnesLeanToTheMiddleOfTheirTuftAndEachItsOwnWay) {
    SpineLayer layer = layer_of(60, 0.02, 0.0);
    const auto tips = [&](double shag) {
        layer.style.shag = shag;
        Mesh mesh;
        add_spines(mesh, layer, detail_of(0), 7, false, false, [&](int k) {
            return SpineRoot{
                glm::dvec3(0.1 * k, 0.0, 0.0), {0.0, 0.0, 1.0}, 0.0, 1.0, {1.0, 0.0, 0.0}};
        });
        std::vector<glm::dvec3> found;
        for (const Mesh& piece : pieces(mesh)) {
            glm::dvec3 tip(0.0);
            for (const glm::vec3& p : piece.positions)
                if (p.z > tip.z) tip = glm::dvec3(p);
            tip.x -= 0.1 * std::floor(tip.x / 0.1 + 0.5);
            found.push_back(tip);
        }
        return found;
    };
    const auto spread = [](const std::vector<glm::dvec3>& all) {
        double lean = 0.0, square = 0.0;
        for (const glm::dvec3& tip : all) {
            lean += tip.x / static_cast<double>(all.size());
            square += tip.y * tip.y / static_cast<double>(all.size());
        }
        return glm::dvec2(lean, std::sqrt(square));
    };
    const std::vector<glm::dvec3> plain = tips(0.0), shaggy = tips(1.0);
    ASSERT_EQ(plain.size(), shaggy.size());
    EXPECT_NEAR(spread(plain).x, 0.0, 0.001);
    EXPECT_GT(spread(shaggy).x, 0.005) << "they lean the way of their tuft";
    EXPECT_GT(spread(shaggy).y, 2.0 * spread(plain).y) << "and stray more";
}

TEST(Spines, UprightFoldsAreClosedAndBothTheirEndsLieInTheBody) {
    SpineLayer layer = layer_of(20, 0.01, 0.0);
    layer.style.width = 0.002;
    layer.style.breadth = 6.0;
    layer.style.meander = 1.0;
    for (int lod = 0; lod < 4; ++lod) {
        const Mesh mesh = spines(layer, {0.0, 0.0, 1.0}, lod);
        const MeshCount count = spine_count({layer}, detail_of(lod));
        EXPECT_EQ(mesh.positions.size(), count.vertices);
        EXPECT_EQ(mesh.triangles(), count.triangles);
        for (const Mesh& piece : pieces(mesh)) {
            EXPECT_GT(volume(piece), 0.0);
            float low = 1.0F, high = -1.0F, left = 1e9F, right = -1e9F;
            for (const glm::vec3& p : piece.positions) {
                low = std::min(low, p.z);
                high = std::max(high, p.z);
                left = std::min(left, p.x);
                right = std::max(right, p.x);
            }
            EXPECT_LT(low, -0.003F) << "its bottom is in the body";
            EXPECT_GT(high, 0.004F);
            EXPECT_LE(high, 0.0101F) << "no fold is higher than the longest";
            EXPECT_LT(right - left, 0.03F);
        }
    }
}

TEST(Spines, StandOutAsFarAsTheySayBeforeTheyHang) {
    SpineLayer layer = layer_of(20, 0.02, 1.0);
    const auto reach = [&](double stand) {
        layer.style.stand = stand;
        float most = 0.0F;
        for (const glm::vec3& p : spines(layer, {0.0, 0.0, 1.0}).positions)
            most = std::max(most, p.z);
        return most;
    };
    EXPECT_GT(reach(0.4), reach(0.05) + 0.004F);
}

TEST(Spines, OfLengthZeroHaveNoTriangles) {
    const SpineLayer none = layer_of(10, 0.0, 1.0);
    EXPECT_TRUE(spines(none, {0.0, 1.0, 0.0}).indices.empty());
    EXPECT_EQ(spines(none, {0.0, 1.0, 0.0}).positions.size(),
              spine_count({none}, detail_of(0)).vertices);
}

TEST(Spines, OfACoralUseAtMostHalfOfItsTriangles) {
    for (int lod = 0; lod < 4; ++lod) {
        const std::vector<SpineLayer> many = {layer_of(4000, 0.02, 1.0)};
        EXPECT_LE(spine_count(many, spine_detail(many, lod)).triangles, triangle_limit(lod) / 2);
    }
}

TEST(Spines, OfSpeciesAreValidAtEveryAge) {
    for (const char* id : {"cyathus_striatus", "hericium_erinaceus", "tremella_mesenterica"})
        for (const double age : {0.0, 0.3, 0.6, 1.0})
            for (int lod = 0; lod < 4; ++lod) expect_valid(mesh_of(order_of(id, age, 3, lod)));
}

TEST(Spines, OfAFormWithoutALowerFaceStandOnItsCap) {
    for (const auto& [from, to] : {std::pair{0.0, 1.0}, std::pair{0.0, 2.0}, std::pair{0.0, 0.0}}) {
        MushroomSpec order = order_of("clavariadelphus_pistillaris", 0.6, 3, 1);
        Model model = atlas().find("clavariadelphus_pistillaris")->species.stages[2].model;
        model.spines.count = 40;
        model.spines.from = from;
        model.spines.to = to;
        order.mix.clear();
        order.model = model;
        const Mesh mesh = mesh_of(order);
        expect_valid(mesh);
        EXPECT_EQ(pieces(mesh).size(), 41u) << from << ' ' << to;
    }
}

}  // namespace
}  // namespace sporeprint::geometry_spines_test
