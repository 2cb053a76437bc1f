#include "core/geometry/sweep.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/hymenium.h"
#include "core/geometry/waves.h"
#include "core/individual/proportion.h"
#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/mesh/detail.h"
#include "core/surface/charts.h"
#include "tests/support/effort.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::geometry_sweep_test {
namespace {

/// A model that is its outline and nothing else.
Model bare(Silhouette silhouette) {
    Model model;
    model.shape = Swept{std::move(silhouette), {}};
    model.surface.hymenium.pattern = HymeniumPattern::smooth;
    return model;
}

Mesh swept(const Individual& individual, int lod, bool with_texture = false) {
    Mesh mesh = swept_mesh(individual, lod, {.textured = with_texture});
    expect_valid(mesh);
    return mesh;
}

Mesh swept(const Model& model, int lod, std::uint32_t seed = 1, bool with_texture = false) {
    return swept(individual_of(model, seed, lod), lod, with_texture);
}

std::size_t row_of(int lod) { return static_cast<std::size_t>(detail_of(lod).columns) + 1; }

/// Returns the ratio of the columns of a level to those of the next.
double columns_over_next(int lod) {
    return static_cast<double>(detail_of(lod).columns) / detail_of(lod + 1).columns;
}

/// Returns the area of the polygon of an LOD's columns over that of the unit circle.
double polygon_area(int lod) {
    const int n = detail_of(lod).columns;
    return 0.5 * n * std::sin(2.0 * pi / n);
}

Silhouette frustum(double low, double high, double height) {
    Silhouette s;
    s.stem = {{0.0, 0.0}, {low, 0.0}};
    s.hymenium = {{low, 0.0}, {high, height}};
    s.cap = {{high, height}, {0.0, height}};
    s.junction = s.margin = Join::corner;
    return s;
}

TEST(Sweep, ACylinderIsAPrismAndConvergesToPiTimesSquareTimesHeight) {
    const Model model = bare(frustum(0.05, 0.05, 0.12));
    double errors[4];
    for (int lod = 0; lod < 4; ++lod) {
        const double found = volume(swept(model, lod));
        EXPECT_NEAR(found / (polygon_area(lod) * 0.05 * 0.05 * 0.12), 1.0, 1e-6);
        errors[lod] = pi * 0.05 * 0.05 * 0.12 - found;
        EXPECT_GT(errors[lod], 0.0) << "inscribed";
    }
    // Twice the columns give a quarter of the error.
    for (int lod = 0; lod < 2; ++lod) {
        const double columns = columns_over_next(lod);
        EXPECT_NEAR(errors[lod + 1] / errors[lod] / (columns * columns), 1.0, 0.03);
    }
}

TEST(Sweep, AConeHasTheVolumeOfACone) {
    for (const double tip : {0.02, 1e-3, 1e-6}) {
        const Model model = bare(frustum(0.04, tip, 0.1));
        const double squares = 0.04 * 0.04 + 0.04 * tip + tip * tip;
        for (int lod = 0; lod < 4; ++lod)
            EXPECT_NEAR(volume(swept(model, lod)) / (polygon_area(lod) * squares * 0.1 / 3.0), 1.0,
                        1e-5);
    }
}

/// Returns a sphere: half a circle of control points, in three sub-curves.
Silhouette sphere(double radius) {
    Silhouette s;
    s.junction = s.margin = Join::smooth;
    const auto at = [&](int i) {
        const double angle = pi * i / 48.0;
        return OutlinePoint{i % 48 == 0 ? 0.0 : radius * std::sin(angle),
                            0.5 - radius * std::cos(angle)};
    };
    for (int i = 0; i <= 16; ++i) s.stem.push_back(at(i));
    for (int i = 16; i <= 32; ++i) s.hymenium.push_back(at(i));
    for (int i = 32; i <= 48; ++i) s.cap.push_back(at(i));
    return s;
}

TEST(Sweep, ASphereConvergesToSecondOrder) {
    const double exact = 4.0 / 3.0 * pi * 0.001;
    double errors[4];
    for (int lod = 0; lod < 4; ++lod)
        errors[lod] = (exact - volume(swept(bare(sphere(0.1)), lod))) / exact;
    EXPECT_LT(errors[0], 2.5e-3);
    EXPECT_GT(errors[0], 0.0);
    // The error is quadratic in the coarser of rings (halved twice) and columns.
    for (int lod = 0; lod < 2; ++lod) {
        const double columns = columns_over_next(lod);
        EXPECT_GT(errors[lod + 1] / errors[lod], 3.0);
        EXPECT_LT(errors[lod + 1] / errors[lod], columns * columns);
    }
}

TEST(Sweep, NormalsOfASpherePointAwayFromItsCentre) {
    const Mesh mesh = swept(bare(sphere(0.1)), 0);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 out = glm::normalize(mesh.positions[i] - glm::vec3(0.0f, 0.5f, 0.0f));
        EXPECT_LT(glm::distance(mesh.normals[i], out), 1e-3f);
    }
}

/// Returns a torus round the axis, its hole closed by a thin disc, twice as thick as `skin`.
Silhouette torus(double middle, double tube, double rest) {
    Silhouette s;
    s.junction = s.margin = Join::corner;
    const double start = std::asin(rest / tube);
    const auto at = [&](int i) {
        const double angle = -start + (-2.0 * pi + 2.0 * start) * (1.0 - i / 30.0);
        return OutlinePoint{middle - tube * std::cos(angle), 0.1 + tube * std::sin(angle)};
    };
    // From below the disc, round the tube (out, up, back in), to above the disc.
    std::vector<OutlinePoint> round;
    for (int i = 30; i >= 0; --i) round.push_back(at(i));
    s.stem = {{0.0, round.front().y}, round.front()};
    s.hymenium = round;
    s.cap = {round.back(), {0.0, round.back().y}};
    return s;
}

TEST(Sweep, ATorusHasTheVolumeThatPappusGivesIt) {
    constexpr double middle = 0.1, tube = 0.03, rest = 0.003;
    const double start = std::asin(rest / tube);
    // The tube minus the sliver of it that the disc fills, plus the disc.
    const double inner = middle - tube * std::cos(start);
    const double sliver_area = tube * tube * (start - std::sin(start) * std::cos(start));
    const double sliver_radius = middle - 2.0 / 3.0 * tube * std::pow(std::sin(start), 3.0) /
                                              (start - std::sin(start) * std::cos(start));
    const double exact = 2.0 * pi * (pi * middle * tube * tube - sliver_area * sliver_radius) +
                         pi * inner * inner * 2.0 * rest;
    double errors[3];
    for (int lod = 0; lod < 3; ++lod) {
        const double found = volume(swept(bare(torus(middle, tube, rest)), lod));
        errors[lod] = std::abs(found - exact) / exact;
    }
    EXPECT_LT(errors[0], 0.025) << "18 rings round a tube: 2 pi^2 / (3 * 17^2) and the columns";
    EXPECT_GT(errors[1] / errors[0], 3.0);
    EXPECT_GT(errors[2] / errors[1], 2.0);
}

TEST(Sweep, AStraightMushroomIsTheSumOfItsFrusta) {
    for (const AtlasEntry& entry : swept_atlas().entries())
        for (const Stage& stage : entry.species.stages)
            for (const int lod : {0, 2}) {
                const Individual individual = individual_of(bare(silhouette_of(stage.model)));
                double sum = 0.0;
                for (const CurveName curve : curve_names) {
                    const auto rings = individual.outline.rings(curve, lod);
                    for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
                        const double a = rings[i].r, b = rings[i + 1].r;
                        sum += (a * a + a * b + b * b) / 3.0 * (rings[i + 1].y - rings[i].y);
                    }
                }
                EXPECT_NEAR(volume(swept(individual, lod)) / (polygon_area(lod) * sum), 1.0, 1e-5);
            }
}

/// Returns the order's individual as a figure of revolution, without ornaments; fans, rays and
/// relief have their own tests.
Individual body_of(const MushroomSpec& order) {
    Individual individual = resolve(order, atlas());
    individual.layers.clear();
    individual.spines.clear();
    individual.peridioles.clear();
    individual.receptacles.clear();
    individual.has_ring = false;
    individual.azimuth = {};
    individual.lobes.clear();
    individual.reliefs.clear();
    individual.has_sac = false;
    individual.damage = {};
    individual.gill_layout = {};
    for (SpeciesShare& part : individual.parts) {
        part.cells = {};
        part.model.hymenium.depth = 0.0;
        part.model.surface.hymenium.pattern = HymeniumPattern::gills;  // no cross veins
    }
    return individual;
}

TEST(Sweep, WithoutDeformationEveryRingLiesWhereItsOutlineIs) {
    const Individual individual = individual_of(bare(mature_silhouette("boletus_edulis")));
    const Mesh mesh = swept(individual, 1);
    const Detail& detail = details[1];
    std::size_t at = 0;
    for (const CurveName curve : curve_names)
        for (const OutlineSample& sample : individual.outline.rings(curve, 1))
            for (int j = 0; j <= detail.columns; ++j, ++at) {
                const auto [s, c] = sine_cosine(2.0 * pi * (j % detail.columns) / detail.columns);
                EXPECT_EQ(mesh.positions[at].x, static_cast<float>(sample.r * c));
                EXPECT_EQ(mesh.positions[at].z, static_cast<float>(sample.r * s));
                EXPECT_NEAR(mesh.positions[at].y, sample.y, 1e-8);
            }
    EXPECT_EQ(at, mesh.positions.size());
}

TEST(Sweep, DeformationOfAmountZeroChangesNoByte) {
    const Model model = bare(mature_silhouette("russula_vinosa"));
    Model zero = model;
    zero.deformation.zone_from = 0.3;  // an empty zone, and directions that depend on the seed
    zero.deformation.zone_to = 0.6;
    for (int lod = 0; lod < 4; ++lod)
        EXPECT_TRUE(same_bits(swept(model, lod, 1, true), swept(zero, lod, 2, true)));
}

/// Evaluates the surface at a share of a sub-curve and an angle.
struct Surface3 {
    const RestSurface& rest;
    const Deformer& deformer;
    Part part;

    [[nodiscard]] SurfacePoint at(double share, double angle) const {
        SurfacePoint point = rest.at(part, share, angle);
        deformer.apply({&point, 1}, deformer.station(part, rest.curve(part).at(share)));
        return point;
    }

    /// Returns the angle between the analytic normal and that of finite differences, radians.
    [[nodiscard]] double normal_error(double share, double angle) const {
        constexpr double h = 1e-5;  // far below the radius of curvature of the thinnest margin
        const glm::dvec3 along = at(share + h, angle).position - at(share - h, angle).position;
        const glm::dvec3 round = at(share, angle + h).position - at(share, angle - h).position;
        const SurfacePoint point = at(share, angle);
        const glm::dvec3 found = glm::normalize(glm::cross(point.meridian, point.azimuth));
        const glm::dvec3 truth = glm::normalize(glm::cross(along, round));
        return glm::length(glm::cross(found, truth)) + (glm::dot(found, truth) < 0.0 ? 2.0 : 0.0);
    }
};

/// Returns the largest and the mean normal error over the three faces of an individual.
std::pair<double, double> normal_errors(const Individual& individual, std::uint32_t seed) {
    const Deformer deformer(individual);
    const RestSurface rest(individual, details[0]);
    double worst = 0.0, sum = 0.0;
    int count = 0;
    Random random(seed, 99);
    for (const Part part : {Part::stem, Part::hymenium, Part::cap}) {
        if (rest.curve(part).empty()) continue;
        const Surface3 surface{rest, deformer, part};
        for (int i = 0; i < 40; ++i) {
            const double share = random.uniform(0.02, 0.98);
            const double angle = random.uniform(0.0, 2.0 * pi);
            const double error = surface.normal_error(share, angle);
            worst = std::max(worst, error);
            sum += error;
            ++count;
        }
    }
    return {worst, sum / count};
}

TEST(Sweep, NormalsAgreeWithDifferencesOfTheSurfaceUnderAxialDeformationAndWaves) {
    for (const std::string& id : swept_ids())
        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
            MushroomSpec order = order_of(id, 0.25 * seed, seed);
            order.params.deformation.imperfection = 0.0;
            order.params.deformation.irregularity = 0.0;
            order.params.deformation.twist_deg = 45.0 * seed;
            order.params.deformation.taper = 0.2 * seed - 0.5;
            order.params.deformation.lean_deg = 5.0 * seed;
            if (!mature_silhouette(id).hymenium.empty())
                order.params.weathering.waves = 0.25 * seed;
            const auto [worst, mean] = normal_errors(body_of(order), seed);
            // Differences across the knots of the arc-length tables, where speed jumps a little.
            EXPECT_LT(worst, 0.02) << id << ' ' << seed;
            EXPECT_LT(mean, 1e-3) << id << ' ' << seed;
        }
}

TEST(Sweep, NormalsFollowDentsThroughTheirJacobian) {
    for (const std::string& id : swept_ids())
        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
            MushroomSpec order = order_of(id, 0.6, seed);
            order.params.deformation.imperfection = 1.0;
            Individual individual = body_of(order);
            const auto [worst, mean] = normal_errors(individual, seed);
            // On a bent stem a dent keeps the station of its undented height: a small second-order
            // error.
            EXPECT_LT(worst, 0.12) << id << ' ' << seed;
            EXPECT_LT(mean, 0.01) << id << ' ' << seed;
            individual.model.deformation.bend_deg = individual.model.deformation.lean_deg = 0.0;
            individual.waves = 0.0;
            individual.axis = {};
            const auto [straight_worst, straight_mean] = normal_errors(individual, seed);
            EXPECT_LT(straight_worst, 0.02) << id << ' ' << seed;
            EXPECT_LT(straight_mean, 1e-3) << id << ' ' << seed;
        }
}

TEST(Sweep, NormalsOfTheMeshComeCloserToItsFacesWithDetail) {
    for (const std::string& id : swept_ids()) {
        double means[3];
        for (int lod = 0; lod < 3; ++lod) {
            const Mesh mesh = swept(body_of(order_of(id, 0.6, 3, lod)), lod);
            std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
            for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
                const auto corner = [&](std::size_t k) {
                    return glm::dvec3(mesh.positions[mesh.indices[i + k]]);
                };
                const glm::dvec3 n = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
                for (std::size_t k = 0; k < 3; ++k) sums[mesh.indices[i + k]] += n;
            }
            double error = 0.0, weight = 0.0;
            for (std::size_t i = 0; i < sums.size(); ++i) {
                const double area = glm::length(sums[i]);
                if (area == 0.0) continue;
                error += glm::length(sums[i] - area * glm::dvec3(mesh.normals[i]));
                weight += area;
            }
            means[lod] = error / weight;
        }
        EXPECT_LT(means[0], 0.06) << id;
        EXPECT_LT(means[0], 0.75 * means[1]) << id;
        EXPECT_LT(means[1], 0.85 * means[2]) << id;
    }
}

std::vector<std::pair<std::string, bool>> with_and_without_solids() {
    std::vector<std::pair<std::string, bool>> all;
    for (const std::string& id : swept_ids())
        for (const bool solids : {false, true}) all.emplace_back(id, solids);
    return all;
}

TEST(Sweep, TangentsPointAlongTheTextureAndHandednessUpTheImage) {
    for (const auto& [id, solids] : with_and_without_solids()) {
        MushroomSpec order = textured(order_of(id, 0.6, 5));
        if (!solids) order.params.hymenium.depth = 0.0;
        const Mesh mesh = mesh_of(order);
        expect_valid(mesh);
        ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
        // At the edges of a spine of three sides the direction turns by a third of a circle.
        const bool spiny = atlas().find(id)->species.stages.front().model.spines.count > 0;
        const Chart& spines = swept_charts[static_cast<std::size_t>(Part::blade)];
        int agree = 0, handed = 0, count = 0;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
            if (spiny && mesh.texture_coordinates[a].x >= spines.u &&
                mesh.texture_coordinates[a].x <= spines.u + spines.width &&
                mesh.texture_coordinates[a].y >= spines.v &&
                mesh.texture_coordinates[a].y <= spines.v + spines.height)
                continue;
            const glm::vec3 p = mesh.positions[b] - mesh.positions[a];
            const glm::vec3 q = mesh.positions[c] - mesh.positions[a];
            const glm::vec2 s = mesh.texture_coordinates[b] - mesh.texture_coordinates[a];
            const glm::vec2 t = mesh.texture_coordinates[c] - mesh.texture_coordinates[a];
            const float det = s.x * t.y - t.x * s.y;
            if (std::abs(det) < 1e-12f || glm::length(glm::cross(p, q)) < 1e-12f) continue;
            const glm::vec3 by_u = (p * t.y - q * s.y) / det;
            const glm::vec3 by_v = (q * s.x - p * t.x) / det;
            for (const auto k : {a, b, c}) {
                const glm::vec3 tangent(mesh.tangents[k]);
                const glm::vec3 up = glm::cross(mesh.normals[k], tangent) * mesh.tangents[k].w;
                agree += glm::dot(tangent, glm::normalize(by_u)) > 0.7f ? 1 : 0;
                handed += glm::dot(up, by_v) < 0.0f ? 1 : 0;  // v grows downwards in glTF
                ++count;
            }
        }
        // The remaining ones are at corners of coarse triangles round poles, tips and torn edges,
        // where the arms of a net meet, at the ends of a small cushion on a wall, on the bent ribs
        // between deep pits, and on gills, whose rows of long thin triangles turn where they rise at
        // the stem and end at the margin; most of these are on the oyster's, near its foot.
        const Model& young = atlas().find(id)->species.stages.front().model;
        const bool netted = young.receptacle.meshes > 0 || young.spines.is_folded();
        EXPECT_GT(agree, (solids ? 0.88 : netted ? 0.94 : 0.965) * count) << id;
        EXPECT_GT(handed, 0.97 * count) << id;
    }
}

TEST(Sweep, PolesPointAlongTheAxis) {
    for (const std::string& id : swept_ids())
        for (int lod = 0; lod < 4; ++lod) {
            const Detail& detail = detail_of(lod);
            const Model model = bare(mature_silhouette(id));
            const Mesh mesh = swept(model, lod, 1, true);
            for (std::size_t j = 0; j < row_of(lod); ++j) {
                EXPECT_LT(glm::distance(mesh.normals[j], glm::vec3(0.0f, -1.0f, 0.0f)), 1e-6f);
                const glm::vec3& apex = mesh.normals[mesh.normals.size() - 1 - j];
                EXPECT_LT(glm::distance(apex, glm::vec3(0.0f, 1.0f, 0.0f)), 1e-6f);
            }
            EXPECT_EQ(mesh.positions.size() % static_cast<std::size_t>(detail.columns + 1), 0u);
        }
}

TEST(Sweep, TheSeamColumnRepeatsColumnZeroBitForBit) {
    for (const std::string& id : swept_ids())
        for (int lod = 0; lod < 4; ++lod) {
            MushroomSpec order = order_of(id, 0.9, 4, lod);
            order.params.variation = 1.0;
            const Individual individual = body_of(order);
            const Mesh mesh = swept(individual, lod, true);
            SCOPED_TRACE(id + " lod " + std::to_string(lod));
            const Detail& detail = detail_of(lod);
            const auto row = static_cast<std::size_t>(detail.columns) + 1;
            for (std::size_t i = 0; i + row <= mesh.positions.size(); i += row) {
                const std::size_t last = i + row - 1;
                EXPECT_TRUE(same_bits(mesh.positions[i], mesh.positions[last]));
                EXPECT_TRUE(same_bits(mesh.normals[i], mesh.normals[last]));
                EXPECT_TRUE(same_bits(mesh.tangents[i], mesh.tangents[last]));
                const glm::vec2 a = mesh.texture_coordinates[i];
                const glm::vec2 b = mesh.texture_coordinates[last];
                EXPECT_EQ(a.x, b.x);
                const bool stem = i / row < static_cast<std::size_t>(detail.stem_rings);
                const Chart& chart = swept_charts[static_cast<std::size_t>(Part::stem)];
                EXPECT_NEAR(b.y - a.y, stem ? chart.height * (1.0 - 2.0 * chart.inset) : 0.0, 1e-6);
            }
        }
}

TEST(Sweep, StemHymeniumAndCapAreWeldedBitForBit) {
    for (const std::string& id : swept_ids())
        for (std::uint32_t seed = 1; seed <= effort(5); ++seed)
            for (int lod = 0; lod < 4; ++lod) {
                MushroomSpec order = order_of(id, 0.2 * seed, seed, lod);
                order.params.variation = 1.0;
                if (!mature_silhouette(id).hymenium.empty()) order.params.weathering.waves = 1.0;
                const Individual individual = body_of(order);
                const Mesh mesh = swept(individual, lod);
                const Detail& detail = detail_of(lod);
                const auto row = static_cast<std::size_t>(detail.columns) + 1;
                const bool has_hymenium = !individual.outline.hymenium.empty();
                std::vector<int> joints = {detail.stem_rings};
                if (has_hymenium)
                    joints.push_back(detail.stem_rings + detail.hymenium_rings +
                                     flesh_rings(individual, lod));
                for (const int joint : joints)
                    for (std::size_t j = 0; j < row; ++j) {
                        const std::size_t above = static_cast<std::size_t>(joint) * row + j;
                        EXPECT_TRUE(same_bits(mesh.positions[above], mesh.positions[above - row]))
                            << id << ", seed " << seed << ", lod " << lod << ", ring " << joint;
                    }
            }
}

TEST(Sweep, AStemWithoutHeightIsWeldedUnderAnyDeformation) {
    Model model = bare(frustum(0.03, 0.05, 0.04));
    for (const double depth : {0.0, 0.01}) {  // flat, and hanging below its own beginning
        std::get<Swept>(model.shape).silhouette.stem[0].y = depth;
        for (const double bend : {0.0, 1.0}) {
            model.deformation = {};
            model.deformation.lean_deg = 20.0 * bend;
            model.deformation.imperfection = bend;
            model.deformation.taper = 0.5 * bend;
            for (int lod = 0; lod < 4; ++lod) swept(model, lod, 5, true);
        }
    }
}

TEST(Sweep, AClubHasNoMarginToWave) {
    MushroomSpec order = order_of("clavariadelphus_pistillaris");
    order.params.weathering.waves = 0.0;
    const Mesh still = mesh_of(order);
    EXPECT_FALSE(still.positions.empty());
    order.params.weathering.waves = 1.0;
    EXPECT_THROW((void)mesh_of(order), Impossible);
}

TEST(Sweep, EveryLevelOfDetailShowsTheSameIndividual) {
    const double usual[] = {0.0, 0.03, 0.07, 0.14};
    for (const std::string& id : swept_ids()) {
        // Upright folds stand out by a third of the body, and coarse levels have few rows of each.
        const bool folded = atlas().find(id)->species.stages.front().model.spines.is_folded();
        const auto allowed = [&](int lod) { return (folded ? 1.6 : 1.0) * usual[lod]; };
        for (std::uint32_t seed = 1; seed <= 6; ++seed) {
            MushroomSpec order = order_of(id, seed / 6.0, seed);
            order.params.variation = 1.0;
            const Mesh finest = mesh_of(order);
            std::size_t triangles = finest.triangles();
            for (int lod = 1; lod < 4; ++lod) {
                order.params.lod = lod;
                const Mesh mesh = mesh_of(order);
                EXPECT_LT(distance(bounds(mesh), bounds(finest)),
                          allowed(lod) * diagonal(bounds(finest)))
                    << id << ", seed " << seed << ", lod " << lod;
                EXPECT_LT(2 * mesh.triangles(), triangles);
                triangles = mesh.triangles();
            }
        }
    }
}

/// Returns the triangles of a mesh by their indices.
std::set<std::array<std::uint32_t, 3>> triangles_of(const Mesh& mesh) {
    std::set<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        triangles.insert({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
    return triangles;
}

TEST(Sweep, EmittedAbsentTrianglesAreTheSameAtEveryAgeAndHaveNoArea) {
    for (const std::string& id : swept_ids())
        for (int lod = 0; lod < 4; ++lod) {
            const auto complete_at = [&](double age) {
                return swept_mesh(resolved(order_of(id, age, 4)), lod,
                                  {.textured = true, .keep_absent = true});
            };
            const Mesh mature = complete_at(0.6);
            constexpr std::array<double, 6> ages = {0.0, 0.25, 0.8, 1.0, 0.1, 0.45};
            for (const double age : std::span(ages).first(effort(6, 1, 6))) {
                const Mesh complete = complete_at(age);
                EXPECT_EQ(complete.indices, mature.indices) << id << " at " << age;
                expect_valid(complete);
                const Mesh drawn = swept_mesh(resolved(order_of(id, age, 4)), lod);
                EXPECT_TRUE(same_bits(drawn.positions, complete.positions));
                EXPECT_TRUE(same_bits(drawn.normals, complete.normals));
                const auto all = triangles_of(complete), shown = triangles_of(drawn);
                EXPECT_TRUE(std::includes(all.begin(), all.end(), shown.begin(), shown.end()));
                for (const auto& triangle : all) {
                    if (shown.contains(triangle)) continue;
                    const auto place = [&](std::size_t k) {
                        return glm::dvec3(complete.positions[triangle[k]]);
                    };
                    EXPECT_LT(glm::length(glm::cross(place(1) - place(0), place(2) - place(0))),
                              1e-9);
                }
            }
        }
}

TEST(Sweep, AmountsMoveVerticesAndNeverTheirNumber) {
    MushroomSpec order = textured(order_of("amanita_muscaria", 0.6, 4));
    const std::size_t count = mesh_of(order).positions.size();
    for (const double amount : {0.0, 0.02, 0.4, 1.0}) {
        order.params.ornaments.warts = order.params.ornaments.ring = amount;
        const Mesh mesh = mesh_of(order);
        EXPECT_EQ(mesh.positions.size(), count);
        expect_valid(mesh);
    }
}

TEST(Sweep, AnotherSeedIsAnotherIndividual) {
    MushroomSpec order = order_of("amanita_muscaria");
    const Mesh one = mesh_of(order);
    order.params.seed = 2;
    EXPECT_FALSE(same_bits(one, mesh_of(order)));
}

constexpr std::array<Waves::Species, 1> one_species = {{{3, 1.0}}};

TEST(Sweep, WavesHaveTheReportedDerivatives) {
    constexpr std::array<Waves::Species, 2> two_species = {{{3, 0.4}, {8, 0.6}}};
    const Waves waves(0.8, 0.06, 72, 9, two_species);
    Random random(1, 1);
    for (int i = 0; i < 500; ++i) {
        const double share = random.uniform(0.01, 0.99);
        const double angle = random.uniform(0.0, 2.0 * pi);
        constexpr double h = 1e-6;
        const auto value = waves.at(share, angle);
        EXPECT_NEAR(
            (waves.at(share + h, angle).height - waves.at(share - h, angle).height) / (2 * h),
            value.by_share, 1e-6);
        EXPECT_NEAR(
            (waves.at(share, angle + h).height - waves.at(share, angle - h).height) / (2 * h),
            value.by_angle, 1e-6);
    }
    for (const double share : {0.0, 0.2, 0.35}) EXPECT_EQ(waves.at(share, 1.0).height, 0.0);
    EXPECT_TRUE(Waves(0.0, 0.06, 72, 9, one_species).flat());
    EXPECT_FALSE(waves.flat());
}

TEST(Sweep, WavesOfAMixAreTheWeightedSumOfThoseOfItsSpecies) {
    const auto height = [](std::span<const Waves::Species> mix, double angle) {
        return Waves(1.0, 0.06, 72, 9, mix).at(1.0, angle).height;
    };
    const std::array<Waves::Species, 1> first = {{{3, 1.0}}}, second = {{{8, 1.0}}};
    double difference = 0.0;
    for (int i = 0; i < 60; ++i) {
        const double angle = 2.0 * pi * i / 60, a = height(first, angle), b = height(second, angle);
        for (const double weight : {0.0, 0.001, 0.3, 1.0}) {
            const std::array<Waves::Species, 2> mix = {{{3, weight}, {8, 1.0 - weight}}};
            EXPECT_NEAR(height(mix, angle), weight * a + (1.0 - weight) * b, 1e-12);
        }
        difference = std::max(difference, std::abs(a - b));
    }
    EXPECT_GT(difference, 0.002) << "each species has waves of its own";
}

TEST(Sweep, WavesTooFineForTheColumnsAreLeftOut) {
    // With 8 columns a wave of three crests is not sampled finely enough to be a wave.
    double most = 0.0;
    const Waves coarse(1.0, 0.06, 8, 9, one_species);
    for (int i = 0; i < 100; ++i)
        most = std::max(most, std::abs(coarse.at(1.0, 0.0628 * i).height));
    EXPECT_EQ(most, 0.0);
}

TEST(Sweep, AStemThatFoldsIsRefusedWithTheLargestPossibleBend) {
    MushroomSpec order = order_of("boletus_edulis", 0.6, 3);
    order.params.deformation.bend_deg = 90.0;
    order.params.deformation.zone_from = 0.5;
    order.params.deformation.zone_to = 0.6;
    const auto problems = refusal([&] { (void)mesh_of(order); });
    ASSERT_TRUE(names(problems, "/deformation/bend_deg", "folds this stem"));
    const std::string& message = problems[0].message;
    EXPECT_TRUE(message.starts_with("90.0 ")) << message;
    const std::size_t about = message.find("about ");
    ASSERT_NE(about, std::string::npos) << message;
    order.params.deformation.bend_deg = std::stod(message.substr(about + 6));
    EXPECT_GT(*order.params.deformation.bend_deg, 1.0);
    expect_valid(mesh_of(order));
}

TEST(Sweep, AnAxisThatFoldsTheStemIsRefusedWithOrWithoutABend) {
    Model model = bare(frustum(0.03, 0.04, 0.01));
    std::get<Swept>(model.shape).silhouette.stem = {{0.0, 0.0}, {0.03, 0.001}, {0.03, 0.05}};
    std::get<Swept>(model.shape).silhouette.hymenium = {{0.03, 0.05}, {0.04, 0.06}};
    std::get<Swept>(model.shape).silhouette.cap = {{0.04, 0.06}, {0.0, 0.07}};
    std::get<Swept>(model.shape).axis = {{0.0, 0.0, 0.0}, {0.0, 0.5, 0.0}, {0.5, 0.5, 0.0}};
    for (const double bend : {0.0, 20.0}) {
        model.deformation.bend_deg = bend;
        const auto problems = refusal([&] { (void)swept_mesh(individual_of(model), 2); });
        EXPECT_TRUE(names(problems, "/model/axis", "mm wide, folds"));
    }
    model.deformation.bend_deg = 0.0;
    std::get<Swept>(model.shape).axis = {{0.0, 0.0, 0.0}, {0.05, 0.5, 0.0}, {0.0, 1.0, 0.0}};
    swept(model, 2);
}

TEST(Sweep, RandomOutlinesSweepToValidMeshes) {
    int drawn = 0, grown = 0;
    EXPECT_TRUE(rc::check("random outlines of four to eight points", [&] {
        ++drawn;
        Silhouette s;
        const auto point = [](double low, double high) {
            const double r = 0.002 + 0.05 * arbitrary_fraction();
            return OutlinePoint{r, low + (high - low) * arbitrary_fraction()};
        };
        s.stem = {{0.0, 0.0}, point(0.0, 0.03), point(0.03, 0.06), {0.01, 0.06}};
        s.hymenium = {{0.01, 0.06}, point(0.055, 0.07), {0.05, 0.065}};
        s.cap = {{0.05, 0.065}, point(0.07, 0.09), {0.0, 0.1}};
        s.margin = *rc::gen::inRange(0, 2) ? Join::smooth : Join::corner;
        s.junction = *rc::gen::inRange(0, 2) ? Join::smooth : Join::corner;
        Model model = bare(s);
        model.deformation.bend_deg = 40.0 * arbitrary_fraction();
        model.deformation.imperfection = arbitrary_fraction();
        model.weathering.waves = arbitrary_fraction();
        try {
            const Mesh mesh = swept_mesh(individual_of(model, 7, 2), 2);
            RC_ASSERT(defects(mesh).empty());
            RC_ASSERT(volume(mesh) > 0.0);
            ++grown;
        } catch (const Impossible&) {
        }
    }));
    // Of few draws chance may refuse nearly all.
    EXPECT_GT(drawn < 100 ? 100 * grown : 6 * grown, drawn);
}

}  // namespace
}  // namespace sporeprint::geometry_sweep_test
