#include "core/geometry/relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/geometry/rest_surface.h"
#include "core/geometry/sweep.h"
#include "core/math/noise.h"
#include "core/math/random.h"
#include "core/params/reader.h"
#include "core/silhouette/weights.h"
#include "core/surface/paint.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"

namespace sporeprint::geometry_relief_test {
namespace {

/// Returns one kind of relief after another, and all at once.
std::vector<ReliefStyle> kinds() {
    ReliefStyle folds, crests, pits, tiers;
    folds.folds = 0.12;
    crests.folds = 0.12;
    crests.crests = 0.9;
    pits.pits = 0.08;
    tiers.tiers = 0.04;
    ReliefStyle all = folds;
    all.pits = pits.pits;
    all.tiers = tiers.tiers;
    return {folds, pits, tiers, all, crests};
}

Individual with(Individual individual, const ReliefStyle& relief) {
    individual.reliefs = {relief};
    return individual;
}

Individual cep() {
    Individual individual = resolve(order_of("boletus_edulis", 0.6, 3), atlas());
    individual.layers.clear();
    return individual;
}

TEST(Relief, NoiseEqualsThatOfPaintingAndHasTheReportedDerivatives) {
    Random random(1, 1);
    std::vector<float> x, y, z;
    for (int i = 0; i < 500; ++i) {
        x.push_back(static_cast<float>(random.uniform(-20.0, 20.0)));
        y.push_back(static_cast<float>(random.uniform(-20.0, 20.0)));
        z.push_back(static_cast<float>(random.uniform(-20.0, 20.0)));
    }
    std::vector<float> painted(x.size());
    gradient_noise(x, y, z, 77U, painted);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const std::array<double, 3> at = {x[i], y[i], z[i]};
        const NoiseSample noise = noise_sample(at, 77U);
        EXPECT_NEAR(noise.value, painted[i], 1e-5);
        for (std::size_t k = 0; k < 3; ++k) {
            constexpr double h = 1e-6;
            std::array<double, 3> low = at, high = at;
            low[k] -= h;
            high[k] += h;
            EXPECT_NEAR((noise_sample(high, 77U).value - noise_sample(low, 77U).value) / (2.0 * h),
                        noise.by[k], 1e-6);
        }
    }
}

TEST(Relief, HeightsHaveTheReportedDerivativesAndFadeAtApexAndMargin) {
    for (const ReliefStyle& style : kinds()) {
        const Individual individual = with(cep(), style);
        const Relief relief(individual, details[0]);
        const auto height = [&](double share, double angle) {
            return relief.at(Part::cap, share, angle, sine_cosine(angle));
        };
        Random random(2, 1);
        int kinks = 0;
        double deepest = 0.0;
        for (int i = 0; i < 1000; ++i) {
            const double share = random.uniform(0.01, 0.99), angle = random.uniform(0.01, 6.27);
            constexpr double h = 1e-7;
            const Relief::Height here = height(share, angle);
            deepest = std::min(deepest, here.value);
            const double by_share =
                (height(share + h, angle).value - height(share - h, angle).value) / (2.0 * h);
            const double by_angle =
                (height(share, angle + h).value - height(share, angle - h).value) / (2.0 * h);
            // Floors of pits have a ridge line where two borders are equally near.
            kinks += std::abs(by_share - here.by_share) > 1e-4 ||
                     std::abs(by_angle - here.by_angle) > 1e-4;
        }
        EXPECT_LT(kinks, style.pits > 0.0 ? 8 : 1);
        EXPECT_LT(deepest, -0.02 * individual.outline.cap.length());
        for (const double angle : {0.0, 1.0, 4.0}) {
            EXPECT_EQ(height(1.0, angle).value, 0.0);
            EXPECT_EQ(height(0.0, angle).value, 0.0);
        }
        for (int i = 0; i < 100; ++i) {
            const double share = random.uniform();
            EXPECT_NEAR(height(share, 0.0).value, height(share, 2.0 * pi - 1e-9).value, 1e-7)
                << "no seam";
            EXPECT_EQ(relief.at(Part::stem, share, 1.0, sine_cosine(1.0)).value, 0.0);
        }
    }
}

TEST(Relief, WhatIsTooFineLowersTheFaceByMostOfItsMeanDepth) {
    for (const std::size_t kind : {0U, 1U, 4U}) {
        const Individual individual = with(cep(), kinds()[kind]);
        const auto mean = [&](const Detail& detail) {
            const Relief relief(individual, detail);
            double sum = 0.0;
            constexpr int count = 20000;
            for (int i = 0; i < count; ++i) {
                const double share = 0.15 + 0.65 * std::fmod(0.7548776662466927 * i, 1.0);
                const double angle = 2.0 * pi * std::fmod(0.5698402909980532 * i, 1.0);
                sum += relief.at(Part::cap, share, angle, sine_cosine(angle)).value;
            }
            return sum / count;
        };
        Detail coarse = details[0];
        coarse.columns = coarse.cap_rings = 4;
        Detail fine = details[0];
        fine.columns = fine.cap_rings = 1000;
        EXPECT_NEAR(mean(coarse) / mean(fine), 0.6, 0.15) << kind;
    }
}

TEST(Relief, DepthsOfZeroChangeNoByte) {
    const Individual plain = cep();
    Individual flat = plain;
    ReliefStyle none;
    none.fold_count = 9;
    none.pit_columns = 30;
    flat.reliefs = {none};
    for (int lod = 0; lod < 4; ++lod)
        EXPECT_TRUE(same_bits(swept_mesh(flat, lod), swept_mesh(plain, lod)));
}

TEST(Relief, NormalsAgreeWithFiniteDifferencesOfTheSurface) {
    for (const ReliefStyle& style : kinds())
        for (const double lateral : {0.0, 1.0}) {
            Individual individual = with(cep(), style);
            individual.azimuth.lateral = lateral;
            individual.lobes.emplace_back();
            individual.lobes[0].lobes = 5;
            individual.lobes[0].lobe_depth = 0.2;
            const RestSurface rest(individual, details[0]);
            Random random(3, 1);
            double sum = 0.0;
            constexpr int count = 400;
            for (int i = 0; i < count; ++i) {
                const double share = random.uniform(0.02, 0.98),
                             angle = random.uniform(0.0, 2.0 * pi);
                constexpr double h = 1e-6;
                const SurfacePoint at = rest.at(Part::cap, share, angle);
                const glm::dvec3 along = rest.at(Part::cap, share + h, angle).position -
                                         rest.at(Part::cap, share - h, angle).position;
                const glm::dvec3 round = rest.at(Part::cap, share, angle + h).position -
                                         rest.at(Part::cap, share, angle - h).position;
                const glm::dvec3 found = glm::normalize(glm::cross(at.meridian, at.azimuth));
                sum += glm::length(glm::cross(found, glm::normalize(glm::cross(along, round))));
            }
            EXPECT_LT(sum / count, 2e-3);
        }
}

TEST(Relief, MeshesAreValidAtEveryDetailAndTheFinestIsFiner) {
    for (const std::string& id : swept_ids())
        for (const ReliefStyle& style : kinds())
            for (int lod = 0; lod < 4; ++lod) {
                const Individual individual =
                    with(resolve(order_of(id, 0.6, 4, lod), atlas()), style);
                const Mesh mesh = swept_mesh(individual, lod, {.textured = true});
                for (const std::string& defect : defects(mesh))
                    ADD_FAILURE() << id << ", lod " << lod << ": " << defect;
                EXPECT_GT(volume(mesh), 0.0);
                const Mesh none = swept_mesh(with(individual, ReliefStyle{}), lod);
                EXPECT_EQ(mesh.indices, none.indices)
                    << id << ", lod " << lod << ": depths move vertices only";
                EXPECT_LT(distance(bounds(mesh), bounds(none)), 0.05 * diagonal(bounds(none)));
            }
    EXPECT_GT(carried_relief(kinds()[1], 96, 60).pits, 0.99);
    EXPECT_EQ(carried_relief(kinds()[1], 16, 7).pits, 0.0);
}

TEST(Relief, EachSpeciesKeepsItsOwnReliefScaledByItsWeight) {
    const auto carved = [](const char* name, double pits, int columns) {
        Species species = atlas().find("clavariadelphus_pistillaris")->species;
        species.id = Text<48>(name);
        for (Stage& stage : species.stages) {
            ReliefStyle& relief = std::get<Swept>(stage.model.shape).relief;
            relief.pits = stage.age < 0.1 ? 0.0 : pits;
            relief.pit_columns = columns;
        }
        return dump(write(species));
    };
    const Atlas forms({.species = {atlas().find("amanita_muscaria")->json, carved("fine", 0.04, 20),
                                   carved("same", 0.08, 20), carved("wide", 0.06, 10)}});
    const Individual individual = resolve(
        mix_of({{"amanita_muscaria", 400}, {"fine", 100}, {"same", 200}, {"wide", 300}}), forms);
    ASSERT_EQ(individual.reliefs.size(), 2U) << "equal forms share one";
    const auto weights = eased_weights({0.4, 0.1, 0.2, 0.3});
    EXPECT_NEAR(individual.reliefs[0].pits, weights[1] * 0.04 + weights[2] * 0.08, 1e-12);
    EXPECT_NEAR(individual.reliefs[1].pits, weights[3] * 0.06, 1e-12);
    expect_valid(swept_mesh(individual, 0));
    // The number of vertices is that of the set at every age, also before the first pit.
    const Mesh young = swept_mesh(resolve(order_of("fine", 0.0), forms), 0);
    EXPECT_TRUE(resolve(order_of("fine", 0.0), forms).reliefs.empty());
    EXPECT_EQ(young.indices, swept_mesh(resolve(order_of("fine", 0.6), forms), 0).indices);
}

TEST(Relief, NoSectionIntersectsItselfAtAnyDepth) {
    ReliefStyle deep;
    deep.folds = 0.3;
    deep.pits = 0.2;
    deep.tiers = 0.1;
    for (const std::string& id : swept_ids())
        for (std::uint32_t seed = 1; seed <= 3; ++seed) {
            const Individual individual =
                with(resolve(order_of(id, 0.4 * seed - 0.3, seed), atlas()), deep);
            const RestSurface rest(individual, details[0]);
            for (int j = 0; j < 12; ++j) {
                const RestSurface::Column column = rest.column(2.0 * pi * j / 12.0);
                std::vector<glm::dvec2> section;
                for (const Part part : {Part::stem, Part::hymenium, Part::cap}) {
                    if (rest.curve(part).empty()) continue;
                    for (int i = section.empty() ? 0 : 1; i <= 60; ++i) {
                        const glm::dvec3 p =
                            rest.at(part, rest.curve(part).at(i / 60.0), column).position;
                        section.emplace_back(std::sqrt(p.x * p.x + p.z * p.z), p.y);
                    }
                }
                EXPECT_FALSE(first_crossing(section)) << id << ", seed " << seed;
            }
        }
}

TEST(Relief, PaintingIsDarkWhereTheMeshIsDeep) {
    for (const ReliefStyle& style : kinds()) {
        const Individual individual = with(cep(), style);
        const Relief relief(individual, details[0]);
        PaintParams params;
        params.seed = individual.effective.seed;
        params.side = 512;
        params.relief = style;
        params.surface.cap.bumps = 0.0;
        params.surface.cap.ramp_noise = 0.0;
        params.surface.cap.hollow = {0, 0, 0};
        params.surface.cap.hollow_tint = 1.0;
        const RawImages images = paint_raw(params);
        const Chart& chart = swept_charts[static_cast<std::size_t>(Part::cap)];
        double light = 0.0, depth = 0.0, lights = 0.0, depths = 0.0, both = 0.0;
        int count = 0;
        Random random(4, 1);
        for (int i = 0; i < 3000; ++i) {
            const double sigma = random.uniform(0.2, 0.9), angle = random.uniform(0.0, 2.0 * pi);
            const auto turn = sine_cosine(angle);
            const TexturePoint uv = disc_point(chart, sigma, turn.cosine, turn.sine);
            const auto x = static_cast<std::size_t>(uv.u * 512.0),
                       y = static_cast<std::size_t>(uv.v * 512.0);
            const double shown = images.rgb[0][3 * (y * 512 + x)];
            const double deep = -relief.at(Part::cap, 1.0 - sigma, angle, turn).value;
            light += shown;
            depth += deep;
            lights += shown * shown;
            depths += deep * deep;
            both += shown * deep;
            ++count;
        }
        const double agreement =
            (both - light * depth / count) /
            std::sqrt((lights - light * light / count) * (depths - depth * depth / count));
        EXPECT_LT(agreement, style.folds > 0.0 && style.pits > 0.0 ? -0.5 : -0.9);
    }
}

}  // namespace
}  // namespace sporeprint::geometry_relief_test
