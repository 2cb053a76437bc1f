#include "core/geometry/unevenness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <string>
#include <vector>

#include "core/individual/proportion.h"
#include "core/math/elementary.h"
#include "core/math/random.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::geometry_unevenness_test {
namespace {

Individual uneven(const std::string& id, double irregularity, std::uint32_t seed = 1,
                  double age = 0.6) {
    MushroomSpec order = order_of(id, age, seed);
    order.params.deformation.irregularity = irregularity;
    return resolve(order, atlas());
}

/// The image of a point and the Jacobian there, column by column.
struct Image {
    glm::dvec3 point;
    glm::dmat3 jacobian;
};

Image image_of(const Unevenness& map, const glm::dvec3& p) {
    std::vector<SurfacePoint> points(2, {p, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
    points[1].meridian = {0.0, 0.0, 1.0};
    map.apply(points);
    return {points[0].position, {points[0].meridian, points[0].azimuth, points[1].meridian}};
}

/// A random point in the space that a mushroom and its ornaments fill, a tenth wider.
glm::dvec3 place_in(const Individual& individual, Random& random) {
    const Outline& outline = individual.outline;
    double radius = 0.0, low = individual.stem_base, high = individual.stem_top;
    for (const CurveName name : curve_names) {
        if (outline.of(name).empty()) continue;
        radius = std::max(radius, greatest_radius(outline.of(name)));
        low = std::min(low, outline.of(name).at(0.0).y);
        high = std::max(high, outline.of(name).at(1.0).y);
    }
    const double r = 1.1 * radius * std::sqrt(random.uniform());
    const auto [s, c] = sine_cosine(random.uniform(0.0, 2.0 * pi));
    return {r * c, random.uniform(low - 0.1 * radius, high + 0.1 * radius), r * s};
}

TEST(Unevenness, OfNoIrregularityIsTheExactIdentity) {
    for (const std::string& id : swept_ids()) {
        const Individual individual = uneven(id, 0.0);
        const Unevenness map(individual);
        EXPECT_TRUE(map.identity());
        EXPECT_EQ(map.reach_of_stem(0.01), 0.01);
        Random random(1, 0);
        for (int i = 0; i < 50; ++i) {
            const glm::dvec3 p = place_in(individual, random);
            const Image image = image_of(map, p);
            EXPECT_EQ(image.point, p);
            EXPECT_EQ(image.jacobian, glm::dmat3(1.0));
        }
    }
}

TEST(Unevenness, KeepsOrientationEverywhereAtItsGreatest) {
    Random random(2, 0);
    for (const std::string& id : swept_ids())
        for (std::uint32_t seed = 1; seed <= 8; ++seed) {
            const Individual individual = uneven(id, 1.0, seed, random.uniform());
            const Unevenness map(individual);
            for (int i = 0; i < 200; ++i)
                EXPECT_GT(glm::determinant(image_of(map, place_in(individual, random)).jacobian),
                          0.02)
                    << id << " seed " << seed;
        }
}

TEST(Unevenness, MovesDirectionsByItsJacobian) {
    Random random(3, 0);
    for (const std::string& id : swept_ids()) {
        const Individual individual = uneven(id, 0.8, 5);
        const Unevenness map(individual);
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 p = place_in(individual, random);
            const glm::dmat3 jacobian = image_of(map, p).jacobian;
            for (int axis = 0; axis < 3; ++axis) {
                constexpr double step = 1e-7;
                glm::dvec3 by(0.0);
                by[axis] = step;
                const glm::dvec3 slope =
                    (image_of(map, p + by).point - image_of(map, p - by).point) / (2.0 * step);
                EXPECT_LT(glm::distance(slope, jacobian[axis]), 1e-4) << id;
            }
        }
    }
}

TEST(Unevenness, MovesPositionsWithAndWithoutDirectionsAlike) {
    Random random(4, 0);
    const Individual individual = uneven("boletus_edulis", 0.7);
    const Unevenness map(individual);
    for (int i = 0; i < 100; ++i) {
        std::vector<glm::dvec3> place{place_in(individual, random)};
        const glm::dvec3 expected = image_of(map, place[0]).point;
        map.apply(place);
        EXPECT_EQ(place[0], expected);
    }
}

// A wide net or a tall wart reaches far beyond the outline that is made uneven.
TEST(Unevenness, FarBeyondTheOutlineItTurnsNothingInsideOut) {
    for (const char* id : {"amanita_muscaria", "psilocybe_semilanceata", "cyathus_striatus"}) {
        const Individual individual = uneven(id, 1.0, 5);
        const Unevenness map(individual);
        const double radius = greatest_radius(individual.outline.cap);
        Random random(17, 0);
        for (int i = 0; i < 2000; ++i) {
            const double r = radius * 40.0 * random.uniform();
            const auto [s, c] = sine_cosine(random.uniform(0.0, 2.0 * pi));
            const glm::dvec3 at(r * c, random.uniform(0.0, 40.0 * radius), r * s);
            const double step = 1e-5 * radius;
            std::array<glm::dvec3, 4> places = {at, at + glm::dvec3(step, 0.0, 0.0),
                                                at + glm::dvec3(0.0, step, 0.0),
                                                at + glm::dvec3(0.0, 0.0, step)};
            map.apply(places);
            const glm::dmat3 edges(places[1] - places[0], places[2] - places[0],
                                   places[3] - places[0]);
            EXPECT_GT(glm::determinant(edges), 0.0) << id << ' ' << r / radius;
        }
    }
}

TEST(Unevenness, NothingBelowTheOutlineIsLifted) {
    for (const std::string& id : swept_ids()) {
        const Individual individual = uneven(id, 1.0);
        double low = individual.stem_base;
        for (const CurveName name : curve_names)
            for (int i = 0; i <= 32 && !individual.outline.of(name).empty(); ++i)
                low = std::min(low, individual.outline.of(name).at(i / 32.0).y);
        std::vector<glm::dvec3> places{{0.01, low, -0.02}, {0.0, low - 0.01, 0.0}};
        Unevenness(individual).apply(places);
        EXPECT_EQ(places[0].y, low) << id;
        EXPECT_EQ(places[1], glm::dvec3(0.0, low - 0.01, 0.0)) << id;
    }
}

TEST(Unevenness, AStemStaysWithinItsReach) {
    Random random(5, 0);
    for (const std::string& id : swept_ids())
        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
            const Individual individual = uneven(id, 1.0, seed);
            if (individual.outline.stem.empty()) continue;
            const Unevenness map(individual);
            const double radius = greatest_radius(individual.outline.stem);
            const double reach = map.reach_of_stem(radius);
            EXPECT_LT(reach, 2.6 * radius) << id;
            for (int i = 0; i < 100; ++i) {
                const OutlineSample at = individual.outline.stem.at(random.uniform());
                const auto [s, c] = sine_cosine(random.uniform(0.0, 2.0 * pi));
                std::vector<glm::dvec3> place{{at.r * c, at.y, at.r * s}};
                map.apply(place);
                EXPECT_LE(std::hypot(place[0].x, place[0].z), reach * (1.0 + 1e-9)) << id;
            }
        }
}

/// Returns the image of the widest circle, at evenly spaced angles.
std::vector<glm::dvec3> widest_outline(const Individual& individual, std::size_t count) {
    OutlineSample widest{};
    for (const CurveName name : curve_names)
        for (int i = 0; i <= 32 && !individual.outline.of(name).empty(); ++i)
            if (const OutlineSample at = individual.outline.of(name).at(i / 32.0); at.r > widest.r)
                widest = at;
    std::vector<glm::dvec3> places;
    for (std::size_t i = 0; i < count; ++i) {
        const auto [s, c] =
            sine_cosine(2.0 * pi * static_cast<double>(i) / static_cast<double>(count));
        places.emplace_back(widest.r * c, widest.y, widest.r * s);
    }
    Unevenness(individual).apply(places);
    return places;
}

/// What is left of an outline's radius without its mean and the oval nearest to it, in mean radii.
/// To first order an oval has the circular harmonics up to 2.
std::vector<double> irregularities(const Individual& individual) {
    constexpr std::size_t count = 90;
    std::vector<double> left;
    std::array<std::vector<double>, 5> harmonics;
    for (const glm::dvec3& p : widest_outline(individual, count)) {
        const double r = std::hypot(p.x, p.z), c = p.x / r, s = p.z / r;
        left.push_back(r);
        const std::array<double, 5> values{1.0, c, s, c * c - s * s, 2.0 * c * s};
        for (std::size_t k = 0; k < 5; ++k) harmonics[k].push_back(values[k]);
    }
    // The harmonics are nearly orthogonal over the image: projections in turn converge.
    double mean = 0.0;
    for (int step = 0; step < 10; ++step)
        for (std::size_t k = 0; k < 5; ++k) {
            double sum = 0.0, norm = 0.0;
            for (std::size_t i = 0; i < count; ++i) {
                sum += left[i] * harmonics[k][i];
                norm += harmonics[k][i] * harmonics[k][i];
            }
            for (std::size_t i = 0; i < count; ++i) left[i] -= sum / norm * harmonics[k][i];
            if (k == 0) mean += sum / norm;
        }
    for (double& one : left) one /= mean;
    return left;
}

double deviation_from_oval(const Individual& individual) {
    double most = 0.0;
    for (const double one : irregularities(individual)) most = std::max(most, std::abs(one));
    return most;
}

TEST(Unevenness, OutlinesDeviateFromAnOvalByThreeToTenPercent) {
    for (const std::string& id : swept_ids()) {
        std::vector<double> found;
        for (std::uint32_t seed = 1; seed <= 8; ++seed)
            found.push_back(deviation_from_oval(uneven(id, 0.5, seed)));
        std::sort(found.begin(), found.end());
        EXPECT_GE(0.5 * (found[3] + found[4]), 0.03) << id;
        EXPECT_LE(found.back(), 0.1) << id;
    }
}

/// The least and the greatest curvature of an outline seen from above, times its mean radius.
struct Curvature {
    double least = 1e9, most = -1e9;
};

Curvature curvature_of(const std::vector<glm::dvec3>& outline) {
    const std::size_t count = outline.size();
    double length = 0.0;
    Curvature found;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 &before = outline[(i + count - 1) % count], &at = outline[i],
                         &after = outline[(i + 1) % count];
        const glm::dvec2 a(at.x - before.x, at.z - before.z), b(after.x - at.x, after.z - at.z);
        const glm::dvec2 c = a + b;
        length += glm::length(a);
        // Of the circle through three points.
        const double curvature =
            2.0 * (a.x * b.y - a.y * b.x) / (glm::length(a) * glm::length(b) * glm::length(c));
        found.least = std::min(found.least, curvature);
        found.most = std::max(found.most, curvature);
    }
    found.least *= length / (2.0 * pi);
    found.most *= length / (2.0 * pi);
    return found;
}

TEST(Unevenness, OutlinesHaveNoCorners) {
    for (const std::string& id : swept_ids())
        for (std::uint32_t seed = 1; seed <= 8; ++seed) {
            // A circle has 1; an oval with axes as 3 to 2 has 1.9 at its ends.
            const Curvature usual = curvature_of(widest_outline(uneven(id, 0.5, seed), 180));
            EXPECT_LT(usual.most, 1.8) << id << " seed " << seed;
            EXPECT_GT(usual.least, 0.3) << id << " seed " << seed;
            const Curvature old = curvature_of(widest_outline(uneven(id, 1.0, seed), 180));
            EXPECT_LT(old.most, 2.7) << id << " seed " << seed;
            EXPECT_GT(old.least, 0.0) << id << " seed " << seed;
        }
}

TEST(Unevenness, OutlinesOfAMixHaveNoCornersEither) {
    for (std::uint32_t seed = 1; seed <= 8; ++seed)
        for (const int weight : {100, 300, 500, 700, 900}) {
            MushroomSpec order =
                mix_of({{"amanita_muscaria", weight}, {"boletus_edulis", 1000 - weight}});
            order.params.seed = seed;
            order.params.deformation.irregularity = 1.0;
            EXPECT_LT(curvature_of(widest_outline(resolve(order, atlas()), 180)).most, 2.7) << seed;
        }
}

TEST(Unevenness, OutlinesOfTwoSpeciesAtOneSeedAreUnrelated) {
    const std::vector<std::string> ids = swept_ids();
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        std::vector<std::vector<double>> all;
        for (const std::string& id : ids) all.push_back(irregularities(uneven(id, 0.5, seed)));
        double sum = 0.0;
        int pairs = 0;
        for (std::size_t a = 0; a < all.size(); ++a)
            for (std::size_t b = 0; b < a; ++b, ++pairs) {
                double product = 0.0, square_a = 0.0, square_b = 0.0;
                for (std::size_t i = 0; i < all[a].size(); ++i) {
                    product += all[a][i] * all[b][i];
                    square_a += all[a][i] * all[a][i];
                    square_b += all[b][i] * all[b][i];
                }
                sum += product / std::sqrt(square_a * square_b);
            }
        EXPECT_LT(std::abs(sum / pairs), 0.1) << "seed " << seed;
    }
}

TEST(Unevenness, EachSeedAndEachSpeciesHasItsOwn) {
    const glm::dvec3 p(0.02, 0.05, 0.01);
    const auto moved = [&](const std::string& id, std::uint32_t seed) {
        Individual individual = uneven("amanita_muscaria", 0.5);
        individual.parts.front().id = id;
        individual.shape_seed = seed;
        return image_of(Unevenness(individual), p).point;
    };
    const glm::dvec3 first = moved("amanita_muscaria", 1);
    EXPECT_EQ(moved("amanita_muscaria", 1), first);
    EXPECT_GT(glm::distance(moved("amanita_muscaria", 2), first), 1e-4);
    EXPECT_GT(glm::distance(moved("russula_emetica", 1), first), 1e-4);
}

TEST(Unevenness, OfAMixApproachesThatOfASpeciesWithItsWeight) {
    MushroomSpec order = mix_of({{"amanita_muscaria", 9999}, {"boletus_edulis", 1}});
    order.params.deformation.irregularity = 0.6;
    const double alone = deviation_from_oval(uneven("amanita_muscaria", 0.6));
    EXPECT_NEAR(deviation_from_oval(resolve(order, atlas())), alone, 1e-3);
}

TEST(Unevenness, MeshesStayClosedAndKeepTheirCounts) {
    for (const std::string& id : swept_ids())
        for (int lod = 0; lod < 4; lod += 3) {
            MushroomSpec order = order_of(id, 0.7, 3, lod);
            const Mesh even = mesh_of(order);
            order.params.deformation.irregularity = 1.0;
            const Mesh mesh = mesh_of(order);
            EXPECT_EQ(mesh.indices, even.indices) << id;
            EXPECT_TRUE(defects(mesh).empty()) << id;
            EXPECT_NEAR(volume(mesh) / volume(even), 1.0, 0.12) << id;
        }
}

TEST(Unevenness, OfACoralIsRefusedByName) {
    for (const std::string& id : branched_ids()) {
        MushroomSpec order = order_of(id);
        EXPECT_FALSE(resolve(order, atlas()).effective.deformation.irregularity.has_value());
        order.params.deformation.irregularity = 0.3;
        EXPECT_TRUE(names(refusal([&] { (void)resolve(order, atlas()); }),
                          "/deformation/irregularity", "branch"));
    }
}

}  // namespace
}  // namespace sporeprint::geometry_unevenness_test
