#include "core/geometry/azimuth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/geometry/rest_surface.h"
#include "core/geometry/sweep.h"
#include "core/math/random.h"
#include "core/mesh/detail.h"
#include "core/params/reader.h"
#include "core/silhouette/weights.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::geometry_azimuth_test {
namespace {

/// Returns a random azimuth inside its ranges.
Azimuth arbitrary_azimuth(Random& random) {
    Azimuth azimuth;
    Azimuth::fields([&](auto member, const Info& info) {
        auto& value = azimuth.*member;
        const double drawn = random.uniform(info.min, info.max);
        value = static_cast<std::remove_reference_t<decltype(value)>>(drawn);
    });
    return azimuth;
}

/// Returns an individual of a species with the given azimuth.
Individual with(Individual individual, const Azimuth& azimuth) {
    individual.azimuth = azimuth;
    individual.lobes = {azimuth};
    individual.damage = {};
    return individual;
}

/// Returns the image of a half-plane place (r, y) of a column.
glm::dvec2 mapped(const AzimuthMap& map, const AzimuthMap::Column& column, double r, double y) {
    SurfacePoint point{
        {r * column.from.cosine, y, r * column.from.sine}, glm::dvec3(0.0), glm::dvec3(0.0)};
    map.apply(point, column);
    const glm::dvec3& p = point.position;
    return {p.x * column.to.cosine + p.z * column.to.sine, p.y};
}

TEST(Azimuth, AmountsOfZeroChangeNoByte) {
    for (const std::string& id : swept_ids())
        for (int lod = 0; lod < 4; ++lod) {
            const Individual plain = with(resolve(order_of(id, 0.6, 3, lod), atlas()), {});
            Azimuth azimuth;
            azimuth.fan_deg = 50.0;
            azimuth.width = 2.0;
            azimuth.lobes = 7;
            azimuth.lobe_sharpness = 1.0;
            EXPECT_TRUE(AzimuthMap(with(plain, azimuth), 64).identity());
            EXPECT_TRUE(
                same_bits(swept_mesh(with(plain, azimuth), lod), swept_mesh(with(plain, {}), lod)));
        }
}

TEST(Azimuth, EveryHalfPlaneIsMappedOntoOneInOrder) {
    const Individual plain = resolve(order_of("boletus_edulis"), atlas());
    Random random(5, 1);
    for (int i = 0; i < 300; ++i) {
        const AzimuthMap map(with(plain, arbitrary_azimuth(random)), 64);
        const auto column = map.column(random.uniform(0.0, 2.0 * pi));
        EXPECT_GT(column.turning, 0.1) << "half-planes keep their order";
        const double height = random.uniform(-0.1, 0.3);
        double before = -1.0;
        for (int k = 0; k <= 60; ++k) {
            const double r = 0.0025 * k;
            const glm::dvec2 low = mapped(map, column, r, height),
                             high = mapped(map, column, r, height + 0.001);
            EXPECT_GT(low.x, before);
            EXPECT_EQ(low.x, high.x) << "vertical lines stay vertical";
            EXPECT_GT(high.y, low.y);
            before = low.x;
        }
        EXPECT_EQ(mapped(map, column, 0.0, 0.1).x, 0.0);
        EXPECT_EQ(mapped(map, column, 0.0, 0.1).y, 0.1);
    }
}

TEST(Azimuth, DirectionsMoveByItsJacobian) {
    const Individual plain = resolve(order_of("amanita_muscaria"), atlas());
    Random random(6, 1);
    for (int i = 0; i < 400; ++i) {
        const AzimuthMap map(with(plain, arbitrary_azimuth(random)), 64);
        const double angle = random.uniform(0.0, 2.0 * pi);
        const double r = random.uniform(0.002, 0.08), y = random.uniform(0.0, 0.15);
        const auto at = [&](double radius, double height, double turn) {
            const auto [s, c] = sine_cosine(turn);
            return map.moved({radius * c, height, radius * s});
        };
        const auto [s, c] = sine_cosine(angle);
        // Any meridian direction, and the one round the axis.
        const glm::dvec2 along(random.symmetric(), random.symmetric());
        SurfacePoint point{{r * c, y, r * s}, {along.x * c, along.y, along.x * s}, {-s, 0.0, c}};
        map.apply(point, map.column(angle));
        EXPECT_LT(glm::distance(point.position, at(r, y, angle)), 1e-12);
        constexpr double h = 1e-7;
        const glm::dvec3 meridian = (at(r + h * along.x, y + h * along.y, angle) -
                                     at(r - h * along.x, y - h * along.y, angle)) /
                                    (2.0 * h);
        const glm::dvec3 azimuth = (at(r, y, angle + h) - at(r, y, angle - h)) / (2.0 * h * r);
        EXPECT_LT(glm::distance(meridian, point.meridian), 1e-5 * (1.0 + glm::length(meridian)));
        EXPECT_LT(glm::distance(azimuth, point.azimuth), 1e-5 * (1.0 + glm::length(azimuth)));
    }
}

TEST(Azimuth, AnyFanAndAnyLobesAreValidMeshesAtEveryDetail) {
    Random random(7, 1);
    for (const std::string& id : swept_ids())
        for (int lod = 0; lod < 4; ++lod) {
            const MushroomSpec order = order_of(id, random.uniform(), 2, lod);
            const Azimuth azimuth = arbitrary_azimuth(random);
            const Individual individual = with(resolve(order, atlas()), azimuth);
            const Mesh mesh = swept_mesh(individual, lod, {.textured = true, .keep_absent = false});
            for (const std::string& defect : defects(mesh)) ADD_FAILURE() << id << ": " << defect;
            EXPECT_GT(volume(mesh), 0.0);
            // The seam repeats the first column.
            const auto row = static_cast<std::size_t>(detail_of(lod).columns + 1);
            for (std::size_t ring = 0; ring < 7; ++ring)
                EXPECT_TRUE(
                    same_bits(mesh.positions[ring * row], mesh.positions[ring * row + row - 1]));
        }
}

TEST(Azimuth, AFanLiesInFrontOfItsSubstrateAndReachesItsWidth) {
    Individual fan = resolve(order_of("disciotis_venosa"), atlas());
    fan.layers.clear();
    fan.waves = 0.0;
    fan.model.deformation = {};
    fan.axis = {};
    const Bounds round = bounds(swept_mesh(fan, 0));
    fan.azimuth.lateral = 1.0;
    fan.azimuth.core = 0.05;
    for (const double width : {0.5, 1.0, 2.0}) {
        fan.azimuth.width = width;
        const Bounds box = bounds(swept_mesh(fan, 0));
        EXPECT_NEAR(box.max.z, round.max.z, 0.01 * round.max.z) << "the front stays";
        EXPECT_NEAR(box.max.x, width * round.max.x, 0.13 * width * round.max.x);
        EXPECT_GT(box.min.z, -0.12 * round.max.z) << "the back is cut off at the wall";
        EXPECT_NEAR(box.max.y, round.max.y, 1e-6);
    }
    fan.azimuth.width = 1.0;
    fan.azimuth.fan_deg = 35.0;
    EXPECT_LT(bounds(swept_mesh(fan, 0)).max.x, 0.72 * round.max.x) << "a wedge";
}

TEST(Azimuth, LobesTooFineForTheColumnsBecomeACircleOfTheirArea) {
    Individual star = resolve(order_of("disciotis_venosa"), atlas());
    Azimuth form;
    form.lobes = 6;
    form.lobe_depth = 0.6;
    form.lobe_sharpness = 1.0;
    star.lobes = {form};
    const AzimuthMap fine(star, 64), coarse(star, 8);
    double sum = 0.0, least = 1.0, most = 0.0;
    for (int i = 0; i < 360; ++i) {
        const AzimuthMap::Column column = fine.column(radians(i));
        const double reach = column.lobes[0].value;
        sum += reach * reach * column.turning / 360.0;
        least = std::min(least, reach);
        most = std::max(most, reach);
        EXPECT_EQ(coarse.column(radians(i)).lobes[0].value, coarse.column(0.0).lobes[0].value);
    }
    EXPECT_NEAR(least, 0.4, 0.02);
    EXPECT_GT(most, 0.85);
    EXPECT_NEAR(coarse.column(0.0).lobes[0].value, std::sqrt(sum), 0.03);
}

TEST(Azimuth, IndividualsDifferInTheNumberOfTheirLobesWithinTheSpread) {
    Azimuth form;
    form.lobes = 5;
    form.lobe_depth = 0.6;
    form.lobe_uneven = 0.0;
    form.lobe_spread = 1;
    std::array<int, 16> seen{};
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        Individual star = resolve(order_of("disciotis_venosa", 0.6, seed), atlas());
        star.lobes = {form};
        const AzimuthMap map(star, 96);
        std::size_t crests = 0;
        const auto reach = [&](int i) { return map.column(radians(i)).lobes[0].value; };
        for (int i = 0; i < 360; ++i)
            if (reach(i) > reach(i - 1) && reach(i) >= reach(i + 1)) ++crests;
        ASSERT_LT(crests, seen.size());
        ++seen[crests];
    }
    EXPECT_EQ(seen[4] + seen[5] + seen[6], 60);
    for (const std::size_t lobes : {4U, 5U, 6U}) EXPECT_GT(seen[lobes], 8) << lobes << " lobes";
}

TEST(Azimuth, SomeLobesStandAboveOthersAndTheCoreStays) {
    Individual star = resolve(order_of("disciotis_venosa"), atlas());
    Azimuth form;
    form.lobes = 5;
    form.lobe_depth = 0.6;
    form.lobe_lift = 0.4;
    star.lobes = {form};
    const AzimuthMap map(star, 96);
    double least = 1.0, most = 0.0;
    for (int i = 0; i < 360; ++i) {
        const AzimuthMap::Column column = map.column(radians(i));
        least = std::min(least, column.lobes[0].lift);
        most = std::max(most, column.lobes[0].lift);
        EXPECT_EQ(mapped(map, column, 0.001, 0.01).y, 0.01) << "inside of the core";
    }
    EXPECT_GE(least, 0.0);
    EXPECT_GT(most, 3.0 * least);
    form.lobe_depth = 0.0;
    star.lobes = {form};
    EXPECT_TRUE(AzimuthMap(star, 96).identity()) << "without lobes nothing is lifted";
}

TEST(Azimuth, ColumnsGatherAtTheCrestsOfPointedLobes) {
    Individual star = resolve(order_of("disciotis_venosa"), atlas());
    Azimuth form;
    form.lobes = 5;
    form.lobe_depth = 0.7;
    form.lobe_sharpness = 1.0;
    star.lobes = {form};
    const AzimuthMap map(star, 96);
    double on_crest = 0.0, in_notch = 0.0, longest = 0.0, shortest = 1.0;
    for (int i = 0; i < 720; ++i) {
        const AzimuthMap::Column column = map.column(radians(0.5 * i));
        const double reach = column.lobes[0].value;
        if (reach > longest) longest = reach, on_crest = column.turning;
        if (reach < shortest) shortest = reach, in_notch = column.turning;
    }
    EXPECT_LT(on_crest, 0.8);
    EXPECT_GT(in_notch, 1.2);
}

TEST(Azimuth, LevelsOfDetailShowTheSameFanAndTheSameLobes) {
    Random random(8, 1);
    const double allowed[] = {0.0, 0.04, 0.11};
    for (const char* const id : {"cantharellus_cibarius", "amanita_muscaria", "disciotis_venosa"})
        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
            Azimuth azimuth = arbitrary_azimuth(random);
            azimuth.lobes = std::min(azimuth.lobes, 6);
            azimuth.lobe_spread = 0;  // more lobes are a circle at LOD 2
            azimuth.lobe_depth = std::min(azimuth.lobe_depth, 0.4);
            const Mesh finest =
                swept_mesh(with(resolve(order_of(id, 0.6, seed), atlas()), azimuth), 0);
            for (int lod = 1; lod < 3; ++lod) {
                const Mesh mesh =
                    swept_mesh(with(resolve(order_of(id, 0.6, seed, lod), atlas()), azimuth), lod);
                EXPECT_LT(distance(bounds(mesh), bounds(finest)),
                          allowed[lod] * diagonal(bounds(finest)))
                    << id << ", seed " << seed << ", lod " << lod;
            }
        }
}

/// Returns a species like another, with an azimuth in all its stages.
std::string renamed(const std::string& id, const std::string& name, const Azimuth& azimuth) {
    Species species = atlas().find(id)->species;
    species.id = Text<48>(name);
    for (Stage& stage : species.stages) std::get<Swept>(stage.model.shape).azimuth = azimuth;
    return dump(write(species));
}

TEST(Azimuth, AmountsMixByWeightAndFormsStayThoseOfEachSpecies) {
    Azimuth fan;
    fan.lateral = 0.8;
    fan.fan_deg = 70.0;
    fan.width = 1.4;
    Azimuth star;
    star.lobes = 6;
    star.lobe_depth = 0.6;
    star.lobe_sharpness = 1.0;
    const Atlas forms(
        {.species = {atlas().find("boletus_edulis")->json, renamed("disciotis_venosa", "fan", fan),
                     renamed("disciotis_venosa", "star", star)}});
    for (const int weight : {1, 250, 500, 999}) {
        const MushroomSpec order =
            mix_of({{"boletus_edulis", 1000 - weight}, {"fan", weight / 2 + 1}, {"star", weight}});
        const auto weights = eased_weights({1000.0 - weight, weight / 2 + 1.0, 1.0 * weight});
        const Individual individual = resolve(order, forms);
        EXPECT_NEAR(individual.azimuth.lateral, 0.8 * weights[1], 1e-12);
        EXPECT_EQ(individual.azimuth.fan_deg, 70.0);
        EXPECT_EQ(individual.azimuth.width, 1.4);
        ASSERT_EQ(individual.lobes.size(), 1U);
        EXPECT_NEAR(individual.lobes[0].lobe_depth, 0.6 * weights[2], 1e-12);
        EXPECT_EQ(individual.lobes[0].lobe_sharpness, 1.0);
        EXPECT_EQ(individual.lobes[0].lobes, 6);
        expect_valid(swept_mesh(resolve(order, forms), 1));
    }
}

TEST(Azimuth, EachSpeciesKeepsItsOwnNumberOfLobes) {
    Azimuth few, many;
    few.lobes = 5;
    few.lobe_depth = 0.6;
    few.lobe_sharpness = 1.0;
    many.lobes = 9;
    many.lobe_depth = 0.4;
    const Atlas forms({.species = {renamed("disciotis_venosa", "few", few),
                                   renamed("disciotis_venosa", "many", many)}});
    const auto reach = [](const Individual& individual, double angle) {
        const AzimuthMap map(individual, details[0].columns);
        double product = 1.0;
        for (std::size_t k = 0; k < individual.lobes.size(); ++k)
            product *= map.column(angle).lobes[k].value;
        return product;
    };
    for (const auto& [id, weight] : {std::pair{"few", 999}, std::pair{"many", 1}}) {
        const Individual alone = resolve(mix_of({{id, 1000}}), forms),
                         beside =
                             resolve(mix_of({{"few", weight}, {"many", 1000 - weight}}), forms);
        ASSERT_EQ(beside.lobes.size(), 2U);
        for (int i = 0; i < 360; ++i)
            EXPECT_NEAR(reach(beside, radians(i)), reach(alone, radians(i)), 1e-3) << id << i;
    }
    // Two maps of space are applied one after the other: derivatives follow the chain rule.
    const AzimuthMap both(resolve(mix_of({{"few", 500}, {"many", 500}}), forms), 96);
    Random random(9, 1);
    for (int i = 0; i < 200; ++i) {
        const double angle = random.uniform(0.0, 2.0 * pi), r = random.uniform(0.01, 0.05),
                     y = random.uniform(0.0, 0.05);
        const auto at = [&](double radius, double turn) {
            const auto [s, c] = sine_cosine(turn);
            return both.moved({radius * c, y, radius * s});
        };
        const auto [s, c] = sine_cosine(angle);
        SurfacePoint point{{r * c, y, r * s}, {c, 0.0, s}, {-s, 0.0, c}};
        both.apply(point, both.column(angle));
        constexpr double h = 1e-7;
        EXPECT_LT(glm::distance((at(r + h, angle) - at(r - h, angle)) / (2.0 * h), point.meridian),
                  1e-5);
        EXPECT_LT(
            glm::distance((at(r, angle + h) - at(r, angle - h)) / (2.0 * h * r), point.azimuth),
            1e-4);
    }
}

TEST(Azimuth, WeightsMoveVerticesAndNeverTheirNumberAndNeverFar) {
    Azimuth fan;
    fan.lateral = 1.0;
    fan.lobes = 5;
    fan.lobe_depth = 0.3;
    const Atlas forms({.species = {atlas().find("amanita_muscaria")->json,
                                   renamed("disciotis_venosa", "fan", fan)}});
    Mesh before;
    for (int weight = 1; weight < 1000; weight += 37) {
        const Mesh mesh = swept_mesh(
            resolve(mix_of({{"amanita_muscaria", 1000 - weight}, {"fan", weight}}), forms), 1,
            {.textured = false, .keep_absent = true});
        if (!before.positions.empty()) {
            ASSERT_EQ(mesh.indices, before.indices);
            double far = 0.0;
            for (std::size_t i = 0; i < mesh.positions.size(); ++i)
                far = std::max(far, static_cast<double>(
                                        glm::distance(mesh.positions[i], before.positions[i])));
            EXPECT_LT(far, 0.12 * diagonal(bounds(mesh))) << weight;
        }
        before = mesh;
    }
}

}  // namespace
}  // namespace sporeprint::geometry_azimuth_test
