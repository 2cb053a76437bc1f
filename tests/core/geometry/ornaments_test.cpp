#include "core/geometry/ornaments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/geometry/damage_cuts.h"
#include "core/geometry/grid_solid.h"
#include "core/geometry/hymenium.h"
#include "core/grow/mushroom.h"
#include "core/math/elementary.h"
#include "core/surface/charts.h"
#include "core/surface/veil_bands.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::geometry_ornaments_test {
namespace {

Mesh amanita(double warts, double ring, int lod = 0, std::uint32_t seed = 4) {
    MushroomSpec order = textured(order_of("amanita_muscaria", 0.5, seed, lod));
    order.params.ornaments.warts = warts;
    order.params.ornaments.ring = ring;
    order.params.hymenium.depth = 0.0;  // no gills among the pieces
    Mesh mesh = mesh_of(order);
    expect_valid(mesh);
    return mesh;
}

/// Returns the volumes of all pieces but the body, in cubic millimetres.
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
        << "108 pieces are asked for, those that overlap are left out";
    EXPECT_LE(all.size(), none.size() + 108);
    for (const double volume : all) EXPECT_GT(volume, 0.0);
}

TEST(Ornaments, TheSkinPassesIntoTheSkirtOfASpineWithoutAnEdgeInTheShading) {
    const glm::dvec3 up(0.0, 1.0, 0.0);
    // Returns how steep the normals of the base of a cone are: 1 upright, 0 level.
    const auto upright = [&](double share) {
        GridSolid cone{{3, 8, false}, Part::veil, {}, {}};
        for (int i = 0; i < cone.rows; ++i)
            for (int j = 0; j <= cone.columns; ++j) {
                const SineCosine turn = sine_cosine(-2.0 * pi * (j % cone.columns) / cone.columns);
                const double r = 1.0 - 0.5 * i;
                cone.corners.emplace_back(r * turn.cosine, 2.0 - 2.0 * r, r * turn.sine);
            }
        cone.skirt = share * up;
        Mesh mesh;
        append(mesh, cone, up, false, true);
        double least = 1.0;
        for (int j = 0; j <= cone.columns; ++j)
            least =
                std::min(least, static_cast<double>(mesh.normals[static_cast<std::size_t>(j)].y));
        return least;
    };
    EXPECT_NEAR(upright(1.0), 1.0, 1e-6);
    EXPECT_GT(upright(0.5), upright(0.0));
    EXPECT_LT(upright(0.0), 0.5);
    for (const double age : {0.0, 0.6, 0.82, 1.0})
        for (int lod = 0; lod < 4; ++lod)
            expect_valid(mesh_of(textured(order_of("lycoperdon_perlatum", age, 3, lod))));
}

TEST(Ornaments, WartsShrinkAndDisappearWithTheVeil) {
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

TEST(Ornaments, CoarseLevelsOfDetailDropThem) {
    EXPECT_GT(pieces(amanita(1.0, 1.0, 1)).size(), 40u);
    for (const int lod : {2, 3})
        EXPECT_EQ(pieces(amanita(1.0, 1.0, lod)).size(), 2u) << "body and ring; warts are painted";
}

TEST(Ornaments, ScalesOfAnInkCapAreClosed) {
    for (const double age : {0.0, 0.3, 0.6, 0.8})
        for (std::uint32_t seed = 1; seed <= 3; ++seed) {
            MushroomSpec order = textured(order_of("coprinus_comatus", age, seed));
            order.params.ornaments.scales = 1.0;
            order.params.hymenium.depth = 0.0;  // no gills among the pieces
            const Mesh mesh = mesh_of(order);
            expect_valid(mesh);
            EXPECT_GT(pieces(mesh).size(), 20u);
        }
}

TEST(Ornaments, TheirTextureComesFromTheVeilsStrip) {
    MushroomSpec order = textured(order_of("amanita_muscaria"));
    const Mesh mesh = mesh_of(order);
    const Chart& strip = swept_charts[static_cast<std::size_t>(Part::veil)];
    const std::size_t columns = MarginCuts(resolve(order, atlas()), 0).turns().size() + 1;
    const auto rings = static_cast<std::size_t>(details[0].stem_rings + details[0].hymenium_rings +
                                                details[0].cap_rings) +
                       static_cast<std::size_t>(flesh_rings(resolve(order, atlas()), 0));
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
    for (const double hang : {0.0, 1.0})
        for (const double edge : {0.0, 1.0})
            for (const double gap : {0.0, 1.0})
                for (const double tear : {0.0, 1.0})
                    for (const int lod : {0, 2}) {
                        individual.ring = {.height = 0.6,
                                           .width = 0.015,
                                           .hang = hang,
                                           .edge = edge,
                                           .gap = gap,
                                           .grooves = 1.0,
                                           .tear = tear};
                        expect_valid(swept_mesh(individual, lod));
                    }
}

/// Returns the last closed piece of a mesh: the ring, or a sac.
Mesh last_piece(const Individual& individual, int lod = 0) {
    return pieces(swept_mesh(individual, lod)).back();
}

/// Bounds of the vertices that a piece's triangles use.
template <class Of>
double greatest(const Mesh& piece, Of of) {
    double most = -1e9;
    for (const std::uint32_t i : piece.indices) most = std::max(most, of(piece.positions[i]));
    return most;
}

double radius_of(const glm::vec3& p) { return std::sqrt(double{p.x} * p.x + double{p.z} * p.z); }

Individual straight_amanita() {
    MushroomSpec order = order_of("amanita_muscaria", 0.6, 4);
    order.params.variation = 0.0;
    order.params.hymenium.depth = 0.0;  // no gills among the pieces
    Individual individual = resolve(order, atlas());
    individual.layers.clear();
    individual.model.deformation = {};
    individual.axis = {};
    individual.ring = {.height = 0.6, .width = 0.02, .flare_deg = 80.0, .ruffle = 0.0};
    return individual;
}

TEST(Ornaments, RingStylesMakeItHangStandOffThickenAndTear) {
    Individual individual = straight_amanita();
    const auto with = [&](double RingStyle::*member, double value) {
        Individual changed = individual;
        changed.ring.*member = value;
        return last_piece(changed);
    };
    const auto lowest = [](const Mesh& piece) {
        return -greatest(piece, [](const glm::vec3& p) { return -double{p.y}; });
    };
    EXPECT_LT(lowest(with(&RingStyle::hang, 1.0)), lowest(with(&RingStyle::hang, 0.0)) - 0.005);
    const auto nearest = [](const Mesh& piece) {
        return -greatest(piece, [](const glm::vec3& p) { return -radius_of(p); });
    };
    EXPECT_GT(nearest(with(&RingStyle::gap, 0.5)), nearest(with(&RingStyle::gap, 0.0)) + 0.004);
    EXPECT_GT(volume(with(&RingStyle::edge, 1.0)), 1.5 * volume(with(&RingStyle::edge, 0.0)));
    EXPECT_LT(area(with(&RingStyle::tear, 1.0)), 0.85 * area(with(&RingStyle::tear, 0.0)));
    EXPECT_GT(area(with(&RingStyle::grooves, 1.0)), 1.002 * area(with(&RingStyle::grooves, 0.0)));
}

TEST(Ornaments, ARingIsGrownToItsStemAndTapersToItsEdge) {
    Individual individual = straight_amanita();
    individual.ring.ruffle = 0.6;
    individual.ring.tear = 0.5;
    individual.ring.hang = 0.8;
    const Mesh ring = last_piece(individual);
    // In every direction it begins inside of the stem's surface and reaches out of it.
    constexpr std::size_t sectors = 48;
    std::vector<double> nearest(sectors, 1.0), farthest(sectors, 0.0);
    for (const std::uint32_t i : ring.indices) {
        const glm::vec3& p = ring.positions[i];
        double share = 0.0, step = 0.5;
        for (int k = 0; k < 30; ++k, step *= 0.5)
            if (individual.outline.stem.at(share + step).y < double{p.y}) share += step;
        const double off = radius_of(p) - individual.outline.stem.at(share).r;
        const double turns = std::atan2(double{p.z}, double{p.x}) / (2.0 * pi) + 1.0;
        const std::size_t here = static_cast<std::size_t>(turns * sectors + 0.5) % sectors;
        nearest[here] = std::min(nearest[here], off);
        farthest[here] = std::max(farthest[here], off);
    }
    for (std::size_t i = 0; i < sectors; ++i) {
        EXPECT_LT(nearest[i], 0.0) << i;
        EXPECT_GT(farthest[i], 0.002) << i;
    }
    // Its rows go from the stem to the edge and back: it is thick at the stem alone.
    const auto columns = static_cast<std::size_t>(1.5 * details[0].columns) + 1;
    const auto [low, high] = std::minmax_element(ring.indices.begin(), ring.indices.end());
    const std::size_t first = *low, rows = (*high - first + 1) / columns;
    ASSERT_EQ((*high - first + 1) % columns, 0U);
    const auto thickness = [&](std::size_t row) {
        double sum = 0.0;
        for (std::size_t j = 0; j < columns; ++j)
            sum += static_cast<double>(
                glm::distance(ring.positions[first + row * columns + j],
                              ring.positions[first + (rows - 1 - row) * columns + j]));
        return sum / static_cast<double>(columns);
    };
    EXPECT_LT(thickness(rows / 2 - 1), 0.3 * thickness(0));
}

TEST(Ornaments, ARingShowsTheInnerSideOfTheVeilAbove) {
    Individual individual = straight_amanita();
    individual.ring.hang = 0.0;
    const Mesh ring = last_piece(individual);
    const Chart& strip = swept_charts[index_of(Part::veil)];
    const double middle = strip_point(strip, 0.0, 0.5 * (veil_outer_to + veil_inner_from)).v;
    for (const std::uint32_t i : ring.indices) {
        const double v = static_cast<double>(ring.texture_coordinates[i].y);
        EXPECT_FALSE(ring.normals[i].y > 0.7F && v < middle) << i;
        EXPECT_FALSE(ring.normals[i].y < -0.7F && v > middle) << i;
    }
}

TEST(Ornaments, TornEdgesAreNotPeriodic) {
    // The height of the highest point of a sac's edge by angle, less its mean.
    const auto edge = [](std::uint32_t seed) {
        constexpr std::size_t sectors = 96;
        Individual individual = straight_amanita();
        individual.painted_seed = seed;
        individual.has_ring = false;
        individual.has_sac = true;
        individual.sac = {.height = 0.04, .gap = 0.1, .hold = 0.7, .tear = 1.0};
        std::vector<double> high(sectors, 0.0);
        for (const glm::vec3& p : last_piece(individual).positions) {
            const double turns = std::atan2(double{p.z}, double{p.x}) / (2.0 * pi) + 1.0;
            double& here = high[static_cast<std::size_t>(turns * sectors + 0.5) % sectors];
            here = std::max(here, double{p.y});
        }
        double mean = 0.0;
        for (const double h : high) mean += h / sectors;
        for (double& h : high) h -= mean;
        return high;
    };
    const auto product = [](const std::vector<double>& a, const std::vector<double>& b,
                            std::size_t by) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[(i + by) % b.size()];
        return sum;
    };
    for (const std::uint32_t seed : {1U, 2U, 3U, 4U, 5U}) {
        const std::vector<double> one = edge(seed), other = edge(seed + 5);
        const double whole = product(one, one, 0);
        for (std::size_t by = 12; by <= 84; ++by)
            EXPECT_LT(product(one, one, by), 0.8 * whole) << seed << " turned by " << by;
        EXPECT_LT(product(one, other, 0), 0.8 * whole) << "another seed is torn elsewhere";
    }
}

TEST(Ornaments, FrayedScalesAreHairsThatOnlyImagesShow) {
    MushroomSpec order = textured(order_of("coprinus_comatus", 0.3));
    order.params.hymenium.depth = 0.0;  // no gills among the pieces
    Individual individual = resolve(order, atlas());
    const auto scales =
        std::find_if(individual.layers.begin(), individual.layers.end(),
                     [](const PatchLayer& one) { return one.purpose == purposes::scales; });
    ASSERT_NE(scales, individual.layers.end());
    scales->style.fray = 0.0;
    const std::uint64_t whole = ornament_count(individual, details[0]).triangles;
    const std::size_t pieces_whole = ornament_volumes(swept_mesh(individual, 0)).size();
    scales->style.fray = 0.5;
    EXPECT_LT(ornament_count(individual, details[0]).triangles, whole);
    // All but pieces that are absent at this age.
    const std::size_t fewer = pieces_whole - ornament_volumes(swept_mesh(individual, 0)).size();
    EXPECT_GT(fewer, 40U);
    EXPECT_LE(fewer, static_cast<std::size_t>(scales->style.count));
}

TEST(Ornaments, ASacIsAClosedShellOutsideOfTheStem) {
    Individual individual = straight_amanita();
    individual.has_ring = false;
    individual.has_sac = true;
    individual.sac = {.height = 0.04, .gap = 0.1, .hold = 0.7, .tear = 0.6};
    for (const int lod : {0, 1, 2, 3}) {
        const Mesh mesh = swept_mesh(individual, lod);
        expect_valid(mesh);
        EXPECT_EQ(pieces(mesh).size(), 2u);
    }
    const Mesh sac = last_piece(individual);
    EXPECT_GT(volume(sac), 0.0);
    const double high = greatest(sac, [](const glm::vec3& p) { return double{p.y}; });
    EXPECT_LT(high, 0.0401);
    EXPECT_GT(high, 0.03);
    // Above its base no place of it is inside the stem, and its edge stands off.
    for (const std::uint32_t i : sac.indices) {
        const glm::vec3& p = sac.positions[i];
        if (p.y < 0.3 * 0.04) continue;
        double share = 0.0, step = 0.5;
        for (int k = 0; k < 30; ++k, step *= 0.5)
            if (individual.outline.stem.at(share + step).y < double{p.y}) share += step;
        EXPECT_GT(radius_of(p), individual.outline.stem.at(share).r - 1e-5);
    }
    // Tears are deep, and shallower where less is torn.
    const auto areas = [&](double tear) {
        individual.sac.tear = tear;
        return area(last_piece(individual));
    };
    EXPECT_LT(areas(1.0), 0.88 * areas(0.3));
    EXPECT_LT(areas(0.3), areas(0.0));
}

TEST(Ornaments, ASacEnclosesTheWholeBulb) {
    MushroomSpec order = order_of("amanita_phalloides");
    order.params.variation = 0.0;
    Individual individual = resolve(order, atlas());
    individual.has_ring = false;
    const Mesh sac = last_piece(individual, 1);  // gills come after it at the finest level
    double lowest = 1.0, narrowest = 1.0, widest = 0.0, bulb = 0.0, ground = 1.0;
    for (int i = 0; i <= 100; ++i) {
        bulb = std::max(bulb, individual.outline.stem.at(i / 100.0).r);
        ground = std::min(ground, individual.outline.stem.at(i / 100.0).y);
    }
    for (const std::uint32_t i : sac.indices) {
        const glm::vec3& p = sac.positions[i];
        lowest = std::min(lowest, double{p.y});
        narrowest = std::min(narrowest, radius_of(p));
        widest = std::max(widest, radius_of(p));
    }
    EXPECT_LT(lowest, ground + 1e-3) << "from under it";
    EXPECT_LT(narrowest, 0.25 * bulb) << "all but closed there";
    EXPECT_GT(widest, bulb);
}

TEST(Ornaments, ASacGrowsAndVanishesContinuouslyAndKeepsItsVertices) {
    Individual individual = straight_amanita();
    individual.has_sac = true;
    std::size_t vertices = 0;
    for (const double height : {0.04, 0.01, 0.001, 0.0}) {
        individual.sac.height = height;
        const Mesh mesh = swept_mesh(individual, 0);
        expect_valid(mesh);
        if (vertices == 0) vertices = mesh.positions.size();
        EXPECT_EQ(mesh.positions.size(), vertices);
        EXPECT_EQ(pieces(mesh).size(), height > 0.0 ? 3u : 2u);
        MushroomSpec order = order_of("amanita_muscaria");
        EXPECT_EQ(estimate(order, individual).vertices, vertices);
        const Mesh complete = swept_mesh(individual, 0, {.keep_absent = true});
        EXPECT_EQ(complete.positions.size(), vertices);
    }
}

TEST(Ornaments, ScalesOfTheBulbStayOnItsSurfaceWhileTheStemGrows) {
    // Pieces of the veil are low on the mature stem, and all over the lower half of the egg.
    const auto highest = [](double age) {
        MushroomSpec order = textured(order_of("amanita_muscaria", age, 4));
        order.params.variation = 0.0;
        order.params.ornaments.warts = 0.0;
        order.params.ornaments.ring = 0.0;
        order.params.hymenium.depth = 0.0;
        Individual individual = resolve(order, atlas());
        individual.model.deformation = {};
        individual.axis = {};
        double high = 0.0;
        std::vector<Mesh> all = pieces(swept_mesh(individual, 0));
        all.erase(std::max_element(all.begin(), all.end(), [](const Mesh& a, const Mesh& b) {
            return volume(a) < volume(b);
        }));
        EXPECT_GT(all.size(), 20u);
        for (const Mesh& piece : all)
            high = std::max(high, greatest(piece, [](const glm::vec3& p) { return double{p.y}; }));
        return high / individual.stem_top;
    };
    EXPECT_GT(highest(0.0), 0.53);
    EXPECT_LT(highest(0.6), 0.45);
}

}  // namespace
}  // namespace sporeprint::geometry_ornaments_test
