#include "core/build/ornaments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/surface/charts.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint {
namespace {

Mesh amanita(double warts, double ring, int lod = 0, std::uint32_t seed = 4) {
    MushroomOrder order = textured(order_of("amanita_muscaria", 0.5, seed, lod));
    order.params.ornaments.warts = warts;
    order.params.ornaments.ring = ring;
    Mesh mesh = mesh_of(order);
    expect_valid(mesh);
    return mesh;
}

/// Volumes of all pieces but the body, in cubic millimetres.
std::vector<double> ornament_volumes(const Mesh& mesh) {
    std::vector<double> volumes;
    for (const Mesh& piece : pieces(mesh)) volumes.push_back(1e9 * volume(piece));
    volumes.erase(std::max_element(volumes.begin(), volumes.end()));
    return volumes;
}

TEST(Ornaments, WartsAreClosedSolidsThatFaceOutwards) {
    const auto none = ornament_volumes(amanita(0.0, 0.0)),
               all = ornament_volumes(amanita(1.0, 0.0));
    EXPECT_GT(all.size(), none.size() + 40)
        << "95 pieces are asked for, those that overlap are left out";
    EXPECT_LE(all.size(), none.size() + 95);
    for (const double volume : all) EXPECT_GT(volume, 0.0);
}

TEST(Ornaments, WartsShrinkAndFallAsTheVeilGoes) {
    double last = 0.0;
    std::size_t pieces_before = 0;
    for (const double amount : {0.0, 0.1, 0.3, 0.6, 0.9, 1.0}) {
        double whole = 0.0;
        const auto volumes = ornament_volumes(amanita(amount, 0.0));
        for (const double volume : volumes) whole += volume;
        EXPECT_GT(whole, last);
        EXPECT_GE(volumes.size(), pieces_before);
        last = whole;
        pieces_before = volumes.size();
    }
}

TEST(Ornaments, ASmallChangeOfAmountIsASmallChangeOfShape) {
    const auto whole = [](double amount) {
        double sum = 0.0;
        for (const double volume : ornament_volumes(amanita(amount, 0.0, 1))) sum += volume;
        return sum;
    };
    const double full = whole(1.0);
    for (double amount = 0.05; amount < 1.0; amount += 0.05)
        EXPECT_LT(std::abs(whole(amount + 1e-3) - whole(amount)), 0.02 * full) << amount;
}

TEST(Ornaments, TheRingIsOneClosedShellOnTheStem) {
    const Mesh without = amanita(0.0, 0.0), with = amanita(0.0, 1.0);
    const std::size_t body = pieces(without).size();
    const auto found = pieces(with);
    ASSERT_EQ(found.size(), body + 1);
    const Mesh& ring = found.back();
    EXPECT_GT(volume(ring), 0.0);
    float low = 1.0f, high = -1.0f;
    for (const std::uint32_t i : ring.indices) {
        low = std::min(low, ring.positions[i].y);
        high = std::max(high, ring.positions[i].y);
    }
    EXPECT_GT(low, 0.0f);
    EXPECT_LT(high, bounds(without).max.y);
    const auto size = [](double amount) { return area(pieces(amanita(0.0, amount)).back()); };
    EXPECT_LT(size(0.3), size(0.6));
    EXPECT_LT(size(0.6), size(1.0));
}

TEST(Ornaments, LevelsOfDetailDropThemFromFarAway) {
    EXPECT_GT(pieces(amanita(1.0, 1.0, 1)).size(), 40u);
    EXPECT_EQ(pieces(amanita(1.0, 1.0, 2)).size(), 2u) << "body and ring; warts are painted";
    EXPECT_EQ(pieces(amanita(1.0, 1.0, 3)).size(), 1u);
}

TEST(Ornaments, ScalesOfAnInkCapAreClosed) {
    for (const double age : {0.0, 0.3, 0.6, 0.8})
        for (std::uint32_t seed = 1; seed <= 3; ++seed) {
            MushroomOrder order = textured(order_of("coprinus_comatus", age, seed));
            order.params.ornaments.scales = 1.0;
            const Mesh mesh = mesh_of(order);
            expect_valid(mesh);
            EXPECT_GT(pieces(mesh).size(), 20u);
        }
}

TEST(Ornaments, TheirTextureComesFromTheVeilsStrip) {
    MushroomOrder order = textured(order_of("amanita_muscaria"));
    const Mesh mesh = mesh_of(order);
    const Chart& strip = swept_charts[static_cast<std::size_t>(Part::veil)];
    const auto columns = static_cast<std::size_t>(details[0].columns) + 1;
    const auto rings = static_cast<std::size_t>(details[0].stem_rings + details[0].hymenium_rings +
                                                details[0].cap_rings);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const bool body = i < rings * columns;
        EXPECT_EQ(static_cast<double>(mesh.texture_coordinates[i].y) < strip.v, body) << i;
    }
}

TEST(Ornaments, RingsOfEveryKindAreValid) {
    Individual individual = resolve(order_of("amanita_muscaria"), atlas());
    individual.layers.clear();
    for (const double flare : {0.0, 60.0, 120.0})
        for (const double width : {0.001, 0.02, 0.1})
            for (const double thickness : {0.0001, 0.01})
                for (const double height : {0.0, 0.7, 1.0})
                    for (const int lod : {0, 2}) {
                        individual.ring = {height, width, flare, thickness, 1.0};
                        expect_valid(swept_mesh(individual, lod));
                    }
}

}  // namespace
}  // namespace sporeprint
