#include "core/geometry/free_form.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <stdexcept>
#include <vector>

#include "core/math/random.h"

namespace sporeprint::geometry_free_form_test {
namespace {

glm::dvec3 random_vector(Random& random, double reach) {
    const double x = reach * random.symmetric();
    const double y = reach * random.symmetric();
    const double z = reach * random.symmetric();
    return {x, y, z};
}

glm::dvec3 moved(const FreeForm& form, glm::dvec3 p) {
    glm::dvec3 a(0.0), b(0.0);
    form.apply(p, a, b);
    return p;
}

/// The Jacobian at p, column by column, as apply() reports it.
glm::dmat3 jacobian(const FreeForm& form, const glm::dvec3& p) {
    glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0), none(0.0), q = p;
    form.apply(q, x, y);
    q = p;
    form.apply(q, z, none);
    return {x, y, z};
}

/// A random lattice over a box a little off the origin.
FreeForm random_form(std::uint32_t seed, double reach) {
    Random random(seed, 0);
    std::array<int, 3> degree{};
    for (int& d : degree) d = 1 + static_cast<int>(random.bits() % 7);
    std::vector<FreeForm::Displaced> displaced;
    for (int i = 0; i < 6; ++i) {
        std::array<int, 3> index{};
        for (std::size_t k = 0; k < 3; ++k)
            index[k] = static_cast<int>(random.bits() % static_cast<std::uint32_t>(degree[k] + 1));
        displaced.push_back({index, random_vector(random, reach)});
    }
    return FreeForm({-1.0, -0.5, 0.2}, {2.0, 1.5, 1.0}, degree, displaced);
}

glm::dvec3 inside(Random& random) {
    const double x = random.uniform(0.001, 0.999);
    const double y = random.uniform(0.001, 0.999);
    const double z = random.uniform(0.001, 0.999);
    return glm::dvec3(-1.0, -0.5, 0.2) + glm::dvec3(2.0 * x, 1.5 * y, z);
}

TEST(FreeForm, NoDisplacementIsTheExactIdentity) {
    const FreeForm nothing({0.1, 0.2, 0.3}, {1.0, 1.0, 1.0}, {3, 4, 5}, {});
    const FreeForm zero({0.1, 0.2, 0.3}, {1.0, 1.0, 1.0}, {3, 4, 5},
                        {{{1, 2, 3}, glm::dvec3(0.0)}, {{0, 0, 0}, glm::dvec3(-0.0)}});
    Random random(1, 0);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 p = random_vector(random, 1.5);
        for (const FreeForm* form : {&nothing, &zero}) {
            EXPECT_EQ(moved(*form, p), p);
            EXPECT_EQ(jacobian(*form, p), glm::dmat3(1.0));
        }
    }
    EXPECT_EQ(zero.stretch_bound(), 0.0);
}

TEST(FreeForm, ManyPointsAtOnceMoveBitIdentically) {
    const FreeForm a_dent = dent({0.1, 0.2, 0.3}, {1.1, 0.9, 1.3}, {0.02, -0.05, 0.03});
    const FreeForm others = random_form(5, 0.2);
    for (const FreeForm* form : {&a_dent, &others}) {
        Random random(4, 0);
        std::vector<SurfacePoint> row;
        std::vector<glm::dvec3> places;
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec3 place = random_vector(random, 1.0);
            const glm::dvec3 meridian = random_vector(random, 1.0);
            row.push_back({place, meridian, {-meridian.z, 0.0, meridian.x}});
            places.push_back(place);
        }
        const std::vector<SurfacePoint> before = row;
        form->apply(row);
        form->apply(places);
        int moved = 0;
        for (std::size_t i = 0; i < row.size(); ++i) {
            SurfacePoint alone = before[i];
            form->apply(alone.position, alone.meridian, alone.azimuth);
            EXPECT_EQ(row[i].position, alone.position);
            EXPECT_EQ(row[i].meridian, alone.meridian);
            EXPECT_EQ(row[i].azimuth, alone.azimuth);
            EXPECT_EQ(places[i], alone.position);
            moved += alone.position != before[i].position ? 1 : 0;
        }
        EXPECT_GT(moved, 200);
    }
}

TEST(FreeForm, OutsideItsBoxNothingMoves) {
    const FreeForm form = random_form(3, 0.4);
    for (const glm::dvec3& p : {glm::dvec3(-1.001, 0.0, 0.5), glm::dvec3(0.0, 1.001, 0.5),
                                glm::dvec3(0.0, 0.0, 1.201), glm::dvec3(50.0)}) {
        EXPECT_EQ(moved(form, p), p);
        EXPECT_EQ(jacobian(form, p), glm::dmat3(1.0));
    }
}

TEST(FreeForm, DisplacingEveryControlPointAlikeTranslates) {
    std::vector<FreeForm::Displaced> displaced;
    const glm::dvec3 by(0.1, -0.2, 0.05);
    for (int i = 0; i <= 2; ++i)
        for (int j = 0; j <= 3; ++j)
            for (int k = 0; k <= 4; ++k) displaced.push_back({{i, j, k}, by});
    const FreeForm form({-1.0, -0.5, 0.2}, {2.0, 1.5, 1.0}, {2, 3, 4}, displaced);
    Random random(5, 0);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 p = inside(random);
        EXPECT_LT(glm::distance(moved(form, p), p + by), 1e-14) << "the weights sum to one";
    }
}

TEST(FreeForm, DisplacingControlPointsLinearlyStretches) {
    // Bernstein polynomials reproduce linear functions: control point i/n moved by 0.1 i/n.
    std::vector<FreeForm::Displaced> displaced;
    for (int i = 0; i <= 5; ++i)
        for (int j = 0; j <= 1; ++j)
            for (int k = 0; k <= 1; ++k)
                displaced.push_back({{i, j, k}, {0.1 * i / 5.0, 0.0, 0.0}});
    const FreeForm form({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {5, 1, 1}, displaced);
    EXPECT_LT(glm::distance(moved(form, {0.3, 0.5, 0.5}), glm::dvec3(0.33, 0.5, 0.5)), 1e-14);
    EXPECT_NEAR(jacobian(form, {0.3, 0.5, 0.5})[0].x, 1.1, 1e-13);
}

TEST(FreeForm, TheJacobianAgreesWithDifferences) {
    Random random(7, 0);
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        const FreeForm form = random_form(seed, 0.5);
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 p = inside(random);
            const glm::dmat3 j = jacobian(form, p);
            constexpr double h = 1e-6;
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 step(0.0);
                step[axis] = h;
                if (!form.contains(p + step) || !form.contains(p - step)) continue;
                const glm::dvec3 slope =
                    (moved(form, p + step) - moved(form, p - step)) / (2.0 * h);
                EXPECT_LT(glm::distance(slope, j[axis]), 1e-7);
            }
        }
    }
}

/// Returns the largest stretch of a displacement's derivative in a few directions at p.
double stretch(const FreeForm& form, const glm::dvec3& p, Random& random) {
    const glm::dmat3 j = jacobian(form, p) - glm::dmat3(1.0);
    double most = 0.0;
    for (int i = 0; i < 16; ++i) {
        const glm::dvec3 v = random_vector(random, 1.0);
        if (glm::length(v) > 1e-3) most = std::max(most, glm::length(j * v) / glm::length(v));
    }
    return most;
}

TEST(FreeForm, TheStretchBoundIsAnUpperBound) {
    Random random(11, 0);
    for (std::uint32_t seed = 0; seed < 80; ++seed) {
        const FreeForm form = random_form(seed, 0.3);
        const double bound = form.stretch_bound();
        for (int i = 0; i < 300; ++i) EXPECT_LE(stretch(form, inside(random), random), bound);
    }
}

TEST(FreeForm, BelowAStretchOfOneTheMapIsInjectiveAndKeepsOrientation) {
    Random random(13, 0);
    int tried = 0;
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        const FreeForm form = random_form(seed, 0.05);
        if (form.stretch_bound() >= 1.0) continue;
        ++tried;
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 p = inside(random), q = inside(random);
            EXPECT_GT(glm::determinant(jacobian(form, p)), 0.0);
            EXPECT_GT(glm::dot(moved(form, p) - moved(form, q), p - q), 0.0);
        }
    }
    EXPECT_GT(tried, 50);
}

TEST(FreeForm, ADentMovesItsCentreByThePush) {
    const FreeForm form = dent({0.3, 0.2, 0.1}, glm::dvec3(1.0), {0.0, 0.05, 0.0});
    EXPECT_LT(glm::distance(moved(form, {0.3, 0.2, 0.1}), glm::dvec3(0.3, 0.25, 0.1)), 1e-15);
}

TEST(FreeForm, ADentBlendsIntoItsSurroundingsOnceDifferentiably) {
    const FreeForm form = dent(glm::dvec3(0.0), glm::dvec3(2.0), {0.1, 0.2, -0.1});
    for (const double inset : {1e-3, 1e-4}) {
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 p(0.1, -0.2, 0.05);
            p[axis] = 1.0 - inset;
            EXPECT_LT(glm::distance(moved(form, p), p), 2.0 * inset * inset);
            const glm::dmat3 j = jacobian(form, p) - glm::dmat3(1.0);
            for (int column = 0; column < 3; ++column)
                EXPECT_LT(glm::length(j[column]), 4.0 * inset);
        }
    }
}

TEST(FreeForm, ADentIsInjectiveHoweverHardItIsPushed) {
    Random random(17, 0);
    for (int trial = 0; trial < 100; ++trial) {
        const double x = random.uniform(0.5, 2.0);
        const double y = random.uniform(0.5, 2.0);
        const double z = random.uniform(0.5, 2.0);
        const glm::dvec3 size(x, y, z);
        const FreeForm form =
            dent(glm::dvec3(0.0), size, random_vector(random, trial % 2 ? 0.2 : 9.0));
        EXPECT_LT(form.stretch_bound(), 1.0);
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 p = 0.499 * size * random_vector(random, 1.0);
            EXPECT_GT(glm::determinant(jacobian(form, p)), 0.0);
        }
    }
}

TEST(FreeForm, InvalidLatticesAreRefused) {
    const glm::dvec3 corner(0.0), size(1.0);
    EXPECT_THROW(FreeForm(corner, size, {0, 1, 1}, {}), std::invalid_argument);
    EXPECT_THROW(FreeForm(corner, size, {1, 8, 1}, {}), std::invalid_argument);
    EXPECT_THROW(FreeForm(corner, {1.0, 0.0, 1.0}, {1, 1, 1}, {}), std::invalid_argument);
    EXPECT_THROW(FreeForm(corner, {1.0, 1.0, std::nan("")}, {1, 1, 1}, {}), std::invalid_argument);
    EXPECT_THROW(FreeForm(corner, size, {1, 1, 1}, {{{0, 0, 2}, size}}), std::invalid_argument);
    EXPECT_THROW(FreeForm(corner, size, {1, 1, 1}, {{{-1, 0, 0}, size}}), std::invalid_argument);
}

}  // namespace
}  // namespace sporeprint::geometry_free_form_test
