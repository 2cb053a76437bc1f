#include "core/geometry/hymenium.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/surface/charts.h"
#include "core/surface/paint.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"
#include "tests/support/paintings.h"

namespace sporeprint::geometry_hymenium_test {
namespace {

constexpr const char* bladed[] = {"amanita_muscaria", "cantharellus_cibarius", "coprinus_comatus",
                                  "mycena_sanguinolenta", "russula_vinosa"};

/// Returns the pieces of a mesh that use the chart of blades.
std::vector<Mesh> solids(const Mesh& mesh) {
    const Chart& chart = swept_charts[static_cast<std::size_t>(Part::blade)];
    std::vector<Mesh> found;
    for (Mesh& piece : pieces(mesh)) {
        const glm::vec2 at = piece.texture_coordinates[piece.indices[0]];
        if (at.x >= chart.u && at.x < chart.u + chart.width && at.y >= chart.v)
            found.push_back(std::move(piece));
    }
    return found;
}

/// Returns the same request for an individual that is its outline revolved about an upright axis.
MushroomSpec upright(MushroomSpec order) {
    order.params.variation = 0.0;
    order.params.deformation.bend_deg = 0.0;
    order.params.deformation.lean_deg = 0.0;
    order.params.deformation.imperfection = 0.0;
    order.params.deformation.irregularity = 0.0;
    order.params.weathering.waves = 0.0;
    return order;
}

/// A toothed fungus: the cep's shape with spines.
Model toothed(double per_mm = 0.5) {
    Model model;
    model.shape = Swept{mature_silhouette("boletus_edulis"), {}};
    model.surface.hymenium.pattern = HymeniumPattern::teeth;
    model.hymenium.pores_per_mm = per_mm;
    model.hymenium.thickness = 0.6;
    model.hymenium.depth = 0.15;
    return model;
}

TEST(Hymenium, EveryBladeIsAClosedSolidThatFacesOutwards) {
    for (const char* id : bladed)
        for (const double age : {0.0, 0.15, 0.6, 1.0}) {
            const Mesh mesh = mesh_of(textured(order_of(id, age, 3)));
            expect_valid(mesh);
            const std::vector<Mesh> blades = solids(mesh);
            EXPECT_GT(blades.size(), 20u) << id << age;
            double whole = 0.0;
            for (const Mesh& blade : blades) {
                EXPECT_TRUE(defects(blade).empty()) << id << age;
                EXPECT_GT(volume(blade), -1e-13) << id << age;
                whole += volume(blade);
            }
            EXPECT_GT(whole, 0.0) << id << age;
        }
}

TEST(Hymenium, GillsAreAsManyAsRequested) {
    MushroomSpec order = textured(order_of("russula_vinosa"));
    order.params.hymenium.blades = 48;
    order.params.hymenium.tiers = 2;
    EXPECT_EQ(solids(mesh_of(order)).size(), 48u * 4u);
    order.params.hymenium.tiers = 0;
    EXPECT_EQ(solids(mesh_of(order)).size(), 48u);
}

TEST(Hymenium, CountsAreThoseOfTheSetWhateverAgeAndWeight) {
    MushroomSpec order = order_of("amanita_muscaria");
    const std::size_t own = mesh_of(order).positions.size();
    for (const double age : {0.0, 0.2, 0.4, 0.8, 1.0}) {
        order.params.age = age;
        EXPECT_EQ(mesh_of(order).positions.size(), own) << age;
    }
    for (const char* other : {"cantharellus_cibarius", "boletus_edulis", "mycena_sanguinolenta"}) {
        std::size_t vertices = 0;
        for (const int weight : {1, 250, 500, 999}) {
            order.mix = {{"amanita_muscaria", 1000 - weight}, {other, weight}};
            const Mesh mesh = mesh_of(order);
            expect_valid(mesh);
            if (vertices > 0) {
                EXPECT_EQ(mesh.positions.size(), vertices) << other << weight;
            }
            vertices = mesh.positions.size();
        }
    }
}

TEST(Hymenium, EstimatesAreExactForVerticesAndUpperForTriangles) {
    for (const std::string& id : swept_ids())
        for (int lod = 0; lod < 4; ++lod) {
            const MushroomSpec order = order_of(id, 0.6, 2, lod);
            const Mesh mesh = mesh_of(order);
            const Estimate found = estimate(order, atlas());
            EXPECT_EQ(found.vertices, mesh.positions.size()) << id << lod;
            EXPECT_GE(found.triangles, mesh.triangles()) << id << lod;
            constexpr std::size_t most[] = {60000, 6000, 1200, 200};
            if (lod == 0) {
                EXPECT_LE(mesh.triangles(), most[0]) << id;
            }
        }
}

TEST(Hymenium, TheLargestGillLayoutKeepsTheBudget) {
    for (const int blades : {8, 100, 400})
        for (const int tiers : {0, 3}) {
            MushroomSpec order = order_of("russula_vinosa");
            order.params.hymenium.blades = blades;
            order.params.hymenium.tiers = tiers;
            const Mesh mesh = mesh_of(order);
            expect_valid(mesh);
            EXPECT_LE(mesh.triangles(), 60000u);
        }
}

TEST(Hymenium, SmallStepsOfAgeMoveBladesALittle) {
    for (const char* id : bladed) {
        const Bounds box = bounds(mesh_of(order_of(id)));
        std::shared_ptr<const MorphSet> set;
        const auto at = [&](double age) {
            const MushroomSpec order = order_of(id, age, 5);
            return mushroom_mesh(order,
                                 resolve(order, atlas(), [&](const std::string&, const auto& make) {
                                     return set ? set : set = make();
                                 }));
        };
        for (int step = 0; step < 16; ++step) {
            const double age = step / 16.0 + 0.013;
            const Mesh before = at(age), now = at(age + 1.0 / 256.0);
            ASSERT_EQ(now.positions.size(), before.positions.size());
            float most = 0.0F;
            for (std::size_t i = 0; i < now.positions.size(); ++i)
                most = std::max(most, glm::distance(now.positions[i], before.positions[i]));
            EXPECT_LT(most, 0.02F * glm::distance(box.min, box.max)) << id << ' ' << age;
        }
    }
}

TEST(Hymenium, EdgesStayInsideTheOutlineAndBasesUnderTheCap) {
    for (const char* id : {"amanita_muscaria", "russula_vinosa", "coprinus_comatus"})
        for (const double age : {0.0, 0.1, 0.6}) {
            const MushroomSpec order = upright(textured(order_of(id, age)));
            const Individual individual = resolve(order, atlas());
            const Outline& outline = individual.outline;
            double rim = 0.0, top = 0.0;
            for (int i = 0; i <= 200; ++i) {
                rim = std::max(rim, outline.cap.at(i / 200.0).r);
                top = std::max(top, outline.cap.at(i / 200.0).y);
            }
            for (const Mesh& blade : solids(mushroom_mesh(order, individual)))
                for (const std::uint32_t i : blade.indices) {
                    const glm::dvec3 p(blade.positions[i]);
                    EXPECT_LT(std::sqrt(p.x * p.x + p.z * p.z), rim) << id << age;
                    EXPECT_LT(p.y, top) << id << age;
                }
        }
}

TEST(Hymenium, BladesEndAtUnlikeDistancesBeforeTheMargin) {
    const MushroomSpec order = upright(textured(order_of("russula_vinosa")));
    const Individual individual = resolve(order, atlas());
    const double rim = individual.outline.hymenium.at(1.0).r;
    double nearest = 0.0, farthest = rim;
    for (const Mesh& blade : solids(mushroom_mesh(order, individual))) {
        double outer = 0.0;
        for (const std::uint32_t i : blade.indices) {
            const glm::dvec3 p(blade.positions[i]);
            outer = std::max(outer, std::sqrt(p.x * p.x + p.z * p.z));
        }
        nearest = std::max(nearest, outer);
        farthest = std::min(farthest, outer);
    }
    EXPECT_LT(nearest, 0.998 * rim);
    EXPECT_LT(farthest, nearest - 0.005 * rim);
}

TEST(Hymenium, PaintedGillsLieUnderTheSolids) {
    // Under every blade the image of the lower face shows the edge of a gill.
    MushroomSpec order = order_of("russula_vinosa", 0.6, 4);
    order.params.hymenium.blades = 30;
    order.params.hymenium.tiers = 1;
    const Individual individual = resolve(order, atlas());
    PaintParams params = motley(HymeniumPattern::gills, 512);
    params.seed = 4;
    params.hymenium = individual.parts[0].model.hymenium;
    params.hymenium.inner_gap = 0.0;
    params.surface.hymenium.edge = {255, 0, 0};
    params.surface.hymenium.colour = {0, 255, 0};
    params.surface.hymenium.depth = {0, 0, 255};
    params.surface.hymenium.mottle = 0.0;
    params.weathering = {};
    const RawImages images = paint_raw(params);
    const BladeRow row(slot_assignment(0, HymeniumPattern::gills, 30, 1), HymeniumPattern::gills,
                       0.0, 4, 60);
    for (const double share : {0.6, 0.75, 0.9})
        for (const Blade& blade : row.blades()) {
            const auto turn = sine_cosine(2.0 * pi * row.turn(blade, share));
            const double radius = hymenium_inner_share + (1.0 - hymenium_inner_share) * share;
            const TexturePoint at = disc_point(swept_charts[1], radius, turn.cosine, turn.sine);
            const Texel t = texel(images, ImageKind::base_color, static_cast<int>(at.u * 512.0),
                                  static_cast<int>(at.v * 512.0));
            EXPECT_GT(t.r, 110) << share;
            EXPECT_LT(t.b, 90) << share;
        }
}

TEST(Hymenium, CrossVeinsAreSolidsBetweenRidgesAndPaintedUnderThem) {
    // Few ridges, and forks that begin far out, so that nothing else lies between two of them near
    // the stem.
    MushroomSpec order = textured(order_of("cantharellus_cibarius", 0.6, 5));
    order.params.hymenium.blades = 12;
    order.params.hymenium.forking = 0.55;
    const Individual individual = resolve(order, atlas());
    const std::vector<CrossVein> veins = cross_veins(12, 0.55, 5);
    const auto there = static_cast<std::size_t>(std::count_if(
        veins.begin(), veins.end(), [](const CrossVein& vein) { return vein.height > 0.0; }));
    EXPECT_GT(there, 20u);
    const std::size_t joined = solids(mushroom_mesh(order, individual)).size();
    order.params.hymenium.forking = 0.0;
    // Towards the margin, where the face ends, a vein has no depth left.
    const std::size_t ridges = solids(mesh_of(order)).size();
    EXPECT_EQ(ridges, 12u);
    EXPECT_LE(joined, ridges + there + 12u) << "each ridge forks once";
    EXPECT_GE(joined, ridges + there * 3 / 4);

    PaintParams params = motley(HymeniumPattern::ridges, 1024);
    params.seed = 5;
    params.hymenium = individual.parts[0].model.hymenium;
    params.surface.hymenium.colour = {0, 255, 0};
    params.surface.hymenium.edge = {0, 255, 0};
    params.surface.hymenium.depth = {0, 0, 255};
    params.surface.hymenium.mottle = 0.0;
    params.weathering = {};
    const RawImages images = paint_raw(params);
    const BladeRow row(slot_assignment(0, HymeniumPattern::ridges, 12, 1), HymeniumPattern::ridges,
                       0.55, 5, 24);
    const auto blue = [&](const CrossVein& vein, double share) {
        const double gaps = vein.ridge + 0.5;
        const auto turn = sine_cosine(2.0 * pi * row.turn({.from = gaps, .to = gaps}, share));
        const double radius = hymenium_inner_share + (1.0 - hymenium_inner_share) * share;
        const TexturePoint at = disc_point(swept_charts[1], radius, turn.cosine, turn.sine);
        return texel(images, ImageKind::base_color, static_cast<int>(at.u * 1024.0),
                     static_cast<int>(at.v * 1024.0))
            .b;
    };
    int seen = 0;
    for (const CrossVein& vein : veins) {
        if (vein.height < 0.9 || vein.share < 0.35 || vein.share > 0.6) continue;
        ++seen;
        const double beside = 0.35 / cross_vein_rows(12);
        EXPECT_LT(blue(vein, vein.share),
                  std::max(blue(vein, vein.share + beside), blue(vein, vein.share - beside)))
            << vein.ridge << ' ' << vein.share;
    }
    EXPECT_GT(seen, 5);
}

TEST(Hymenium, DecurrentGillsLeaveNoStepAtTheStem) {
    // From the top of the stem the flesh between decurrent gills rises gradually; otherwise at
    // once.
    for (const char* id :
         {"infundibulicybe_geotropa", "infundibulicybe_gibba", "cantharellus_cibarius"}) {
        MushroomSpec order = order_of(id);
        const LowerFace face(resolve(order, atlas()), 0);
        order.params.hymenium.decurrent = 0.0;
        const LowerFace ending(resolve(order, atlas()), 0);
        EXPECT_LT(face.at(0.06).recess, 0.4 * ending.at(0.06).recess) << id;
        EXPECT_NEAR(face.at(0.5).recess, ending.at(0.5).recess, 1e-9) << id;
    }
}

TEST(Hymenium, SpinesAreClosedConesAsManyAsTheirRowsHold) {
    for (const double per_mm : {0.2, 0.5, 2.0}) {
        const Individual individual = individual_of(toothed(per_mm));
        const Mesh mesh = swept_mesh(individual, 0);
        expect_valid(mesh);
        const std::vector<Mesh> spines = solids(mesh);
        EXPECT_LE(spines.size(), static_cast<std::size_t>(most_spines));
        EXPECT_GT(spines.size(),
                  static_cast<std::size_t>(0.7 * cell_count(individual.parts[0].cells)));
        for (const Mesh& spine : spines) EXPECT_GT(volume(spine), 0.0);
        EXPECT_LE(mesh.triangles(), 60000u);
    }
}

TEST(Hymenium, SpinesHangAndDifferInLength) {
    const Individual individual = individual_of(toothed(0.5));
    std::vector<double> heights;
    for (const Mesh& spine : solids(swept_mesh(individual, 0))) {
        const Bounds box = bounds(spine);
        glm::dvec3 lowest(spine.positions[0]), middle(0.0);
        for (const glm::vec3& p : spine.positions) {
            if (static_cast<double>(p.y) < lowest.y) lowest = glm::dvec3(p);
            middle += glm::dvec3(p) / static_cast<double>(spine.positions.size());
        }
        heights.push_back(static_cast<double>(box.max.y - box.min.y));
        EXPECT_LT(lowest.y, middle.y);
    }
    std::sort(heights.begin(), heights.end());
    EXPECT_GT(heights[heights.size() * 9 / 10], 1.5 * heights[heights.size() / 10]);
}

TEST(Hymenium, CoarsePoresAreSolidsAndFineOnesArePainted) {
    for (const double per_mm : {0.2, 0.35, 0.5}) {
        Model model = toothed(per_mm);
        model.surface.hymenium.pattern = HymeniumPattern::pores;
        const Individual individual = individual_of(model);
        const int count = cell_count(individual.parts[0].cells);
        EXPECT_GT(count, 0) << per_mm;
        const Mesh mesh = swept_mesh(individual, 0);
        expect_valid(mesh);
        EXPECT_GT(solids(mesh).size(), static_cast<std::size_t>(0.7 * count)) << per_mm;
        EXPECT_LE(mesh.triangles(), 60000u) << per_mm;
    }
    Model fine = toothed(2.2);
    fine.surface.hymenium.pattern = HymeniumPattern::pores;
    const Individual individual = individual_of(fine);
    EXPECT_EQ(individual.parts[0].cells.rows, 0);
    EXPECT_TRUE(solids(swept_mesh(individual, 0)).empty());
}

TEST(Hymenium, DepthZeroLeavesTheOutlineAsItIs) {
    MushroomSpec order = order_of("amanita_muscaria");
    order.params.hymenium.depth = 0.0;
    const Individual individual = resolve(order, atlas());
    const LowerFace face(individual, 0);
    for (int i = 0; i <= 10; ++i) EXPECT_EQ(face.at(i / 10.0).recess, 0.0);
    EXPECT_TRUE(solids(mushroom_mesh(textured(order), individual)).empty());
}

TEST(Hymenium, CoarseLevelsOfDetailHaveNoSolids) {
    for (int lod = 1; lod < 4; ++lod)
        EXPECT_TRUE(solids(mesh_of(textured(order_of("amanita_muscaria", 0.6, 1, lod)))).empty());
}

}  // namespace
}  // namespace sporeprint::geometry_hymenium_test
