#include "core/breed/outlines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "core/breed/inheritance.h"
#include "core/silhouette/outline.h"
#include "tests/support/atlas.h"

namespace sporeprint::breed_outlines_test {
namespace {

const Species& species_of(const char* id) { return atlas().find(id)->species; }

const Swept& shape_of(const Stage& stage) { return std::get<Swept>(stage.model.shape); }

std::vector<double> ages_of(const Species& species) {
    std::vector<double> ages;
    for (const Stage& stage : species.stages) ages.push_back(stage.age);
    return ages;
}

double height_of(const Silhouette& silhouette) {
    double height = 0.0;
    for (const OutlinePoint& point : silhouette.cap) height = std::max(height, point.y);
    return height;
}

double width_of(const Silhouette& silhouette) {
    double width = 0.0;
    for (const OutlinePoint& point : silhouette.cap) width = std::max(width, point.r);
    return width;
}

/// Returns the greatest distance of the points of one cap from another cap.
double distance(const Silhouette& from, const Silhouette& to) {
    const SubCurve curve = Outline(to).cap;
    double most = 0.0;
    for (int i = 0; i <= 100; ++i) {
        const OutlineSample at = Outline(from).cap.at(i / 100.0);
        double least = 1e9;
        for (int k = 0; k <= 800; ++k) {
            const OutlineSample other = curve.at(k / 800.0);
            least = std::min(least, std::hypot(at.r - other.r, at.y - other.y));
        }
        most = std::max(most, least);
    }
    return most;
}

TEST(OutlinesBetween, BeginAndEndAtThoseOfTheParents) {
    const Species &a = species_of("amanita_muscaria"), &b = species_of("boletus_edulis");
    for (const double share : {0.0, 1.0}) {
        const Species& parent = share == 0.0 ? a : b;
        const auto outlines =
            outlines_between(a, b, share, ages_of(parent), size_of(parent), uncached<MorphSet>);
        ASSERT_EQ(outlines.size(), parent.stages.size());
        for (std::size_t i = 0; i < outlines.size(); ++i) {
            const Silhouette& own = shape_of(parent.stages[i]).silhouette;
            EXPECT_LT(distance(outlines[i], own), 0.012 * height_of(own)) << share << ' ' << i;
            EXPECT_EQ(outlines[i].cap.size(), outlines[0].cap.size());
            EXPECT_GE(outlines[i].cap.size(), own.cap.size());
        }
    }
}

TEST(OutlinesBetween, LieBetweenThoseOfTheParents) {
    const Species &a = species_of("macrolepiota_procera"), &b = species_of("lactarius_deliciosus");
    const auto slenderness = [](const Silhouette& silhouette) {
        return height_of(silhouette) / width_of(silhouette);
    };
    double last = 1e9;
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const Silhouette outline =
            outlines_between(a, b, share, {0.6}, 0.1, uncached<MorphSet>).front();
        EXPECT_LT(slenderness(outline), last) << share;
        last = slenderness(outline);
    }
}

TEST(OutlinesBetween, HaveALowerFaceIfOneParentHas) {
    const Species &a = species_of("clavariadelphus_pistillaris"),
                  &b = species_of("amanita_muscaria");
    const auto outlines = outlines_between(a, b, 0.5, ages_of(a), size_of(a), uncached<MorphSet>);
    for (const Silhouette& outline : outlines) {
        EXPECT_FALSE(outline.hymenium.empty());
        EXPECT_TRUE(problems_in(outline).empty());
    }
}

TEST(AxesBetween, AreStraightForStraightParents) {
    const Species& a = species_of("amanita_muscaria");
    for (const Stage& stage : a.stages) ASSERT_TRUE(shape_of(stage).axis.empty());
    for (const auto& axis : axes_between(a, a, 0.5, {0.2, 0.6})) EXPECT_TRUE(axis.empty());
}

TEST(AxesBetween, BendHalfAsFarHalfWay) {
    const Species& straight = species_of("amanita_muscaria");
    Species bent = straight;
    for (Stage& stage : bent.stages)
        std::get<Swept>(stage.model.shape).axis = {
            {0.0, 0.0, 0.0}, {0.02, 0.35, 0.0}, {0.12, 0.7, 0.0}, {0.3, 1.0, 0.0}};
    const auto whole = axes_between(straight, bent, 1.0, {0.6}).front(),
               half = axes_between(straight, bent, 0.5, {0.6}).front();
    EXPECT_NEAR(whole.back().x, 0.3 / 1.06, 0.03);
    EXPECT_NEAR(half.back().x, 0.5 * whole.back().x, 0.01);
    EXPECT_GT(half.back().y, whole.back().y);
}

TEST(CurveMutation, LeavesTheEndsWhereTheyAre) {
    const BreedingParams params{.seed = 9, .mutation = 0.5};
    const CurveMutation mutation(Genes(params), "silhouette");
    EXPECT_NEAR(mutation.at(0.0), 0.0, 1e-15);
    EXPECT_NEAR(mutation.at(1.0), 0.0, 1e-15);
    EXPECT_NE(mutation.at(0.3), 0.0);
}

TEST(MutateOutlines, MovesAllStagesAlike) {
    const Species& own = species_of("boletus_edulis");
    const BreedingParams params{.seed = 3, .mutation = 0.3};
    const CurveMutation mutation(Genes(params), "silhouette");
    Species moved = own;
    mutate_outlines(moved, mutation, 1.0);
    for (std::size_t i = 0; i < own.stages.size(); ++i) {
        const Silhouette &before = shape_of(own.stages[i]).silhouette,
                         &after = shape_of(moved.stages[i]).silhouette;
        EXPECT_EQ(after.cap.back().r, 0.0);
        EXPECT_NEAR(after.cap.back().y, before.cap.back().y, 1e-12);
        EXPECT_EQ(after.stem.front(), before.stem.front());
        const auto move = [&](std::size_t k) {
            return std::hypot(after.cap[k].r - before.cap[k].r, after.cap[k].y - before.cap[k].y) /
                   (before.cap.back().y - before.stem.front().y);
        };
        const auto same = [&](std::size_t k) {
            const Silhouette &b = shape_of(own.stages.back()).silhouette,
                             &a = shape_of(moved.stages.back()).silhouette;
            return std::hypot(a.cap[k].r - b.cap[k].r, a.cap[k].y - b.cap[k].y) /
                   (b.cap.back().y - b.stem.front().y);
        };
        EXPECT_GT(move(1), 0.0);
        EXPECT_NEAR(move(1), same(1), 0.15 * same(1)) << i;
    }
    Species less = own;
    mutate_outlines(less, mutation, 0.0);
    EXPECT_EQ(less, own);
}

TEST(MutateAxes, LeavesStraightStemsStraightAndEndsInPlace) {
    const BreedingParams params{.seed = 3, .mutation = 0.5};
    Species species = species_of("amanita_muscaria");
    mutate_axes(species, Genes(params));
    EXPECT_EQ(species, species_of("amanita_muscaria"));
    const std::vector<AxisPoint> axis = {
        {0.0, 0.0, 0.0}, {0.02, 0.35, 0.0}, {0.12, 0.7, 0.0}, {0.3, 1.0, 0.0}};
    for (Stage& stage : species.stages) std::get<Swept>(stage.model.shape).axis = axis;
    mutate_axes(species, Genes(params));
    for (const Stage& stage : species.stages) {
        EXPECT_EQ(shape_of(stage).axis.front(), axis.front());
        EXPECT_EQ(shape_of(stage).axis.back(), axis.back());
        EXPECT_NE(shape_of(stage).axis[1], axis[1]);
        EXPECT_EQ(shape_of(stage).axis, shape_of(species.stages.front()).axis);
    }
}

TEST(SizeOf, IsInProportionToAllLengths) {
    for (const char* id : {"amanita_muscaria", "ramaria_formosa"}) {
        const Species& own = species_of(id);
        EXPECT_GT(size_of(own), 0.02);
        EXPECT_NEAR(size_of(scaled(own, 1.5)), 1.5 * size_of(own), 1e-12) << id;
    }
}

}  // namespace
}  // namespace sporeprint::breed_outlines_test
