#include "core/plant/venation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/math/elementary.h"
#include "core/plant/leaf.h"
#include "tests/support/atlas.h"
#include "tests/support/draws.h"
#include "tests/support/effort.h"
#include "tests/support/refusals.h"

namespace sporeprint::plant_venation_test {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

bool meet(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
    const double first = cross(b - a, c - a) * cross(b - a, d - a);
    const double second = cross(d - c, a - c) * cross(d - c, b - c);
    return first <= 0.0 && second <= 0.0;
}

// Returns the pairs of edges of a closed polygon that share a point other than their common corner.
std::size_t meetings(const std::vector<glm::dvec2>& polygon) {
    struct Edge {
        double low, high;
        std::size_t index;
    };
    const std::size_t count = polygon.size();
    const auto corner = [&](std::size_t i) { return polygon[i % count]; };
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < count; ++i)
        edges.push_back(
            {std::min(corner(i).x, corner(i + 1).x), std::max(corner(i).x, corner(i + 1).x), i});
    std::sort(edges.begin(), edges.end(),
              [](const Edge& a, const Edge& b) { return a.low < b.low; });
    std::size_t found = 0;
    for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = a + 1; b < count && edges[b].low <= edges[a].high; ++b) {
            const std::size_t i = edges[a].index, j = edges[b].index;
            if ((i + 1) % count == j || (j + 1) % count == i) continue;
            found += meet(corner(i), corner(i + 1), corner(j), corner(j + 1));
        }
    return found;
}

double area(const std::vector<glm::dvec2>& polygon) {
    double twice = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return 0.5 * twice;
}

TEST(Venation, LobesAndNodesHaveTheRequestedNumber) {
    for (const int lobes : {1, 3, 5, 7}) {
        Venation venation;
        venation.lobes.value = lobes;
        venation.nodes = 9;
        venation.node_loss = 2.0;
        venation.vein_deg = 40;
        const Lamina lamina = lamina_of(venation, 2);
        ASSERT_EQ(lamina.lobes.size(), static_cast<std::size_t>(lobes));
        for (int i = 0; i < lobes; ++i) {
            const Lobe& lobe = lamina.lobes[static_cast<std::size_t>(i)];
            const int out = i - lobes / 2;
            EXPECT_EQ(lobe.nodes.size(), static_cast<std::size_t>(9 - 2 * std::abs(out)));
            EXPECT_NEAR(lobe.turn, out * radians(40), 1e-12);
        }
        EXPECT_NEAR(lamina.lobes[static_cast<std::size_t>(lobes / 2)].reach, 1.0, 1e-12);
    }
}

// The three laws of the source: L(d) constant, A d + B, A log(1 + d) + B, d edges before the tip.
TEST(Venation, EdgesFollowTheirLaw) {
    const auto length = [](LengthLaw law, double d) {
        return law == LengthLaw::constant ? 1.0
               : law == LengthLaw::linear ? 1.0 + 0.7 * d
                                          : 1.0 + 0.7 * std::log(1.0 + d);
    };
    for (const LengthLaw law : {LengthLaw::constant, LengthLaw::linear, LengthLaw::logarithmic}) {
        Venation venation;
        venation.nodes = 8;
        venation.law = law;
        venation.rise = 0.7;
        venation.side_length = 1.3;
        const Lamina lamina = lamina_of(venation, 1);
        const Lobe& lobe = lamina.lobes[0];
        ASSERT_EQ(lobe.halves[0].side_veins.size(), 7U);
        double before = 0.0;
        const double unit = lobe.nodes[0] / length(law, 8);
        for (std::size_t q = 0; q < 8; ++q) {
            EXPECT_NEAR(lobe.nodes[q] - before, unit * length(law, 8.0 - static_cast<double>(q)),
                        1e-12);
            before = lobe.nodes[q];
            if (q == 0) continue;
            const HalfLobe::SideVein& vein = lobe.halves[0].side_veins[q - 1];
            EXPECT_NEAR(vein.abscissa, lobe.nodes[q - 1], 1e-12);
            EXPECT_NEAR(vein.length, 1.3 * unit * length(law, 8.0 - static_cast<double>(q)), 1e-12);
        }
    }
}

TEST(Venation, SideVeinsStandAtTheirAngleOnBothSides) {
    Venation venation;
    venation.lobes.value = 3;
    venation.side_deg = 50;
    const Lamina lamina = lamina_of(venation, 1);
    std::size_t sides = 0;
    for (const Vein& vein : veins_of(lamina)) {
        if (vein.main) continue;
        ++sides;
        const Lobe& lobe = lamina.lobes[vein.lobe];
        const glm::dvec2 main(-std::sin(lobe.turn), std::cos(lobe.turn));
        const glm::dvec2 along = glm::normalize(vein.to - vein.from);
        EXPECT_NEAR(glm::dot(along, main), std::cos(radians(50)), 1e-9);
        EXPECT_GT((vein.side == 0 ? 1.0 : -1.0) * cross(main, along), 0.0);
    }
    EXPECT_GT(sides, 20U);
}

// The border of a simple leaf without curves goes through the ends of veins, lifted by the factor;
// its tip by its last edge.
TEST(Venation, ThePolygonOfTheSourceGoesThroughTheLiftedEnds) {
    Venation venation;
    venation.nodes = 6;
    venation.border = 1.25;
    const Lamina lamina = lamina_of(venation, 1);
    const Lobe& lobe = lamina.lobes[0];
    const HalfLobe& half = lobe.halves[1];
    ASSERT_EQ(half.abscissas.size(), 7U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(half.abscissas[i + 1], half.side_veins[i].abscissa, 1e-12);
        EXPECT_NEAR(half.heights[i + 1], 1.25 * half.side_veins[i].length, 1e-12);
    }
    EXPECT_NEAR(lobe.reach, lobe.nodes[5] + 0.25 * (lobe.nodes[5] - lobe.nodes[4]), 1e-12);
    EXPECT_EQ(border_of(lamina).size(), 12U);
}

TEST(Venation, VeinsThatWouldCrossAreDeleted) {
    Venation venation;
    venation.lobes.value = 5;
    venation.nodes = 8;
    venation.vein_deg = 30;
    venation.side_length = 2.0;
    const Lamina crowded = lamina_of(venation, 1);
    std::size_t sides = 0, whole = 0;
    for (const Lobe& lobe : crowded.lobes) {
        whole += 2 * (lobe.nodes.size() - 1);
        sides += lobe.halves[0].side_veins.size() + lobe.halves[1].side_veins.size();
    }
    EXPECT_LT(sides, whole);
    venation.side_length = 0.2;
    for (const Lobe& lobe : lamina_of(venation, 1).lobes)
        for (const HalfLobe& half : lobe.halves)
            EXPECT_EQ(half.side_veins.size(), lobe.nodes.size() - 1);
}

// Random parameters over the whole range: the border is a simple polygon, counter-clockwise, no
// vein crosses another, all veins lie inside.
TEST(Venation, BordersAreSimpleAndVeinsApartForAnyParameters) {
    Random random(7, 1);
    const std::size_t draws = effort(10'000, 200);
    for (std::size_t i = 0; i < draws; ++i) {
        const auto venation = drawn<Venation>(random);
        const auto steps = 1 + static_cast<int>(4.0 * random.uniform());
        const Lamina lamina = lamina_of(venation, steps);
        const std::vector<glm::dvec2> border = border_of(lamina);
        ASSERT_EQ(meetings(border), 0U) << i;
        ASSERT_GT(area(border), 0.0) << i;
        for (const Lobe& lobe : lamina.lobes)
            for (const HalfLobe& half : lobe.halves) {
                ASSERT_EQ(half.abscissas.size(), half.heights.size());
                for (std::size_t k = 1; k < half.abscissas.size(); ++k) {
                    ASSERT_GT(half.abscissas[k], half.abscissas[k - 1]) << i;
                    if (k + 1 < half.abscissas.size()) {
                        ASSERT_GT(half.heights[k], 0.0) << i;
                    }
                }
                for (const HalfLobe::SideVein& vein : half.side_veins)
                    ASSERT_LE(vein.length, half.height(vein.abscissa) + 1e-12) << i;
            }
        if (i % 20 != 0) continue;
        const std::vector<Vein> veins = veins_of(lamina);
        for (std::size_t a = 0; a < veins.size(); ++a)
            for (std::size_t b = a + 1; b < veins.size(); ++b)
                if (veins[a].lobe != veins[b].lobe) {
                    const bool share_root = veins[a].main && veins[b].main;
                    ASSERT_FALSE(!share_root &&
                                 meet(veins[a].from, veins[a].to, veins[b].from, veins[b].to))
                        << i;
                }
    }
}

TEST(Venation, BordersOfPresetsAreSimpleAtEveryLevelOfDetail) {
    for (const LeafPreset& preset : leaf_presets())
        for (int lod = 0; lod < leaf_lods; ++lod) {
            const std::vector<glm::dvec2> border =
                border_of(lamina_of(preset.shape.venation, leaf_steps(preset.shape.venation, lod)));
            EXPECT_EQ(meetings(border), 0U) << preset.id.string() << ", " << lod;
            EXPECT_GT(area(border), 0.0) << preset.id.string() << ", " << lod;
        }
}

TEST(Venation, PlacesOfTheLaminaAreReadBack) {
    Random random(8, 1);
    const std::size_t draws = effort(300, 30);
    for (std::size_t i = 0; i < draws; ++i) {
        const LaminaSampler reader(lamina_of(drawn<Venation>(random), 2));
        for (std::size_t k = 0; k < 20; ++k) {
            const double pick = random.uniform(), side_pick = random.uniform();
            const double along = random.uniform(0.02, 0.98), up = random.uniform(0.05, 0.95);
            const auto l =
                static_cast<std::size_t>(pick * static_cast<double>(reader.lamina().lobes.size()));
            const std::size_t side = side_pick < 0.5 ? 0 : 1;
            const Lobe& lobe = reader.lamina().lobes[l];
            const double abscissa = along * lobe.reach;
            const double height = up * lobe.halves[side].height(abscissa);
            const LaminaPlace place = reader.at(lobe.place(side, abscissa, height));
            EXPECT_TRUE(place.inside);
            EXPECT_EQ(place.lobe, l);
            EXPECT_EQ(place.side, side);
            EXPECT_NEAR(place.abscissa, abscissa, 1e-6);
            EXPECT_NEAR(place.affinity, up, 1e-4);
            EXPECT_GE(place.homothety, 0.0);
            EXPECT_LE(place.homothety, 1.0);
        }
        EXPECT_FALSE(reader.at({3.0, 0.1}).inside);
        EXPECT_FALSE(reader.at({0.0, -0.5}).inside);
    }
}

TEST(Venation, PlacesDoNotDependOnTheHint) {
    Random random(9, 1);
    const std::size_t draws = effort(1000, 40);
    for (std::size_t i = 0; i < draws; ++i) {
        const LaminaSampler reader(lamina_of(drawn<Venation>(random), 2));
        const double y = random.uniform(-0.3, 1.1), step = random.uniform(0.0005, 0.05);
        LaminaSampler::Hint hint;
        for (double x = -1.2; x < 1.2; x += step) {
            const LaminaPlace on = reader.at({x, y}, hint), alone = reader.at({x, y});
            SCOPED_TRACE(std::to_string(x) + ", " + std::to_string(y));
            ASSERT_EQ(on.lobe, alone.lobe);
            ASSERT_EQ(on.side, alone.side);
            ASSERT_EQ(on.inside, alone.inside);
            ASSERT_NEAR(on.homothety, alone.homothety, 1e-11);
            ASSERT_NEAR(on.abscissa, alone.abscissa, 1e-11);
            if (on.inside) {
                ASSERT_NEAR(on.affinity, alone.affinity, 1e-8);
            }
            ASSERT_NEAR(on.from_side, alone.from_side, 1e-10);
        }
    }
}

TEST(Venation, HomothetyIsOneOnTheBorder) {
    Venation venation;
    venation.lobes.value = 3;
    const Lamina lamina = lamina_of(venation, 3);
    const LaminaSampler reader(lamina);
    const std::vector<glm::dvec2> border = border_of(lamina);
    for (std::size_t i = 1; i < border.size(); ++i) {
        EXPECT_NEAR(reader.at(0.999 * border[i]).homothety, 1.0, 0.03);
        EXPECT_NEAR(reader.at(0.5 * border[i]).homothety, 0.5, 0.03);
    }
}

TEST(Venation, UnevenTeethAndVeinsDifferAndHalvesStandInTurn) {
    Venation venation = leaf_preset("birch")->shape.venation;
    venation.unevenness = venation.asymmetry = venation.arch = 0.0;
    const auto halves = [&] { return lamina_of(venation, 4).lobes.front().halves; };
    EXPECT_EQ(halves()[0].heights, halves()[1].heights);
    venation.asymmetry = 1.0;
    const auto shifted = halves();
    for (std::size_t i = 1; i < shifted[0].side_veins.size(); ++i) {
        // Half-way between the veins of the other side.
        const double middle =
            0.5 * (shifted[0].side_veins[i - 1].abscissa + shifted[0].side_veins[i].abscissa);
        EXPECT_NEAR(shifted[1].side_veins[i].abscissa, middle, 1e-9);
    }
    venation.asymmetry = 0.0;
    venation.unevenness = 1.0;
    EXPECT_NE(halves()[0].heights, halves()[1].heights);
    EXPECT_NE(halves()[0].side_veins[2].length, halves()[1].side_veins[2].length);
}

// A tooth of a finely drawn border rises with a convex back: the point between its foot and its tip is
// above the chord of both.
TEST(Venation, FineTeethHaveConvexBacks) {
    Venation venation;
    venation.teeth = 1.0;
    venation.teeth_per_vein = 1;
    venation.smooth = 0.0;
    const HalfLobe half = lamina_of(venation, 6).lobes.front().halves[0];
    ASSERT_EQ(tooth_edges(6), 4);
    ASSERT_EQ(tooth_edges(4), 2);
    for (std::size_t i = 4; i + 8 < half.abscissas.size(); i += 4) {
        const double share = (half.abscissas[i + 1] - half.abscissas[i]) /
                             (half.abscissas[i + 2] - half.abscissas[i]);
        EXPECT_GT(half.heights[i + 1],
                  half.heights[i] + share * (half.heights[i + 2] - half.heights[i]));
    }
}

TEST(Venation, SideVeinsArchBetweenTheirEnds) {
    Venation venation;
    venation.arch = 0.4;
    const Lamina lamina = lamina_of(venation, 3);
    for (const HalfLobe& half : lamina.lobes.front().halves)
        for (const HalfLobe::SideVein& vein : half.side_veins) {
            EXPECT_DOUBLE_EQ(vein.line(0.0), vein.abscissa);
            EXPECT_NEAR(vein.line(vein.length), vein.abscissa, 1e-12);
            EXPECT_LT(vein.line(0.5 * vein.length), vein.abscissa);
        }
    // The sampler measures from the arched line.
    const HalfLobe::SideVein& vein = lamina.lobes.front().halves[0].side_veins[2];
    const double height = 0.5 * vein.length;
    const LaminaPlace place =
        LaminaSampler(lamina).at(lamina.lobes.front().place(0, vein.line(height), height));
    EXPECT_LT(place.from_side, 1e-6);
}

// Lobes of both sides differ in length and angle, and stand no farther apart than requested.
TEST(Venation, AsymmetricLobesDifferFromSideToSide) {
    Venation venation = leaf_preset("maple")->shape.venation;
    venation.asymmetry = 1.0;
    const std::vector<Lobe> lobes = lamina_of(venation, 4).lobes;
    const std::size_t last = lobes.size() - 1;
    for (std::size_t i = 0; i < lobes.size() / 2; ++i) {
        EXPECT_GT(std::abs(lobes[i].turn + lobes[last - i].turn), 1e-3);
        EXPECT_GT(std::abs(lobes[i].reach - lobes[last - i].reach), 1e-3);
    }
    for (std::size_t i = 0; i < last; ++i)
        EXPECT_LE(lobes[i + 1].turn - lobes[i].turn, radians(venation.vein_deg) + 1e-12);
}

TEST(Venation, ImpossibleLeavesAreRefusedByName) {
    Venation venation;
    venation.lobes.value = 13;
    venation.vein_deg = 40;
    EXPECT_TRUE(names(refusal([&] { (void)lamina_of(venation, 1); }), "/vein_deg", "at most 27"));
    venation.lobes.value = 3;
    venation.vein_deg = 80;
    venation.side_deg = 30;
    EXPECT_TRUE(names(refusal([&] { (void)lamina_of(venation, 1); }), "/side_deg", "too flat"));
    venation.nodes = 100;
    EXPECT_TRUE(names(refusal([&] { (void)lamina_of(venation, 1); }), "/nodes", "outside 2..24"));
}

}  // namespace
}  // namespace sporeprint::plant_venation_test
