#include "core/grow/painting.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "core/grow/mushroom.h"
#include "core/surface/image_blend.h"
#include "tests/support/orders.h"
#include "tests/support/paintings.h"

namespace sporeprint {
namespace {

/// An execution context that caches paintings and images by their keys, and counts what was
/// computed.
struct Keeper {
    std::map<std::string, std::shared_ptr<const ImageSet>> images;
    std::map<std::string, std::shared_ptr<const RawImages>> paintings;
    int dissolved = 0, painted = 0;
    Workshop workshop;

    Keeper() {
        workshop.memo.images = [this](const std::string& key, const auto& make) {
            if (!images.contains(key)) {
                ++dissolved;
                images[key] = make();
            }
            return images[key];
        };
        workshop.memo.paintings = [this](const std::string& key, const auto& make) {
            if (!paintings.contains(key)) {
                ++painted;
                paintings[key] = make();
            }
            return paintings[key];
        };
    }
};

PaintRecipe recipe_of(const MushroomOrder& order) { return paint_recipe(order, atlas()); }

/// Returns paintings of two species at a small size.
PaintRecipe pair(int first) {
    const MushroomOrder a = painted(order_of("amanita_muscaria"));
    const MushroomOrder b = painted(order_of("boletus_edulis"));
    return {{recipe_of(a).at(0).painting, first}, {recipe_of(b).at(0).painting, 64 - first}};
}

RC_GTEST_PROP(SurfaceMix, is_the_nearest_in_sixty_fourths_and_stays_it, ()) {
    const int count = *rc::gen::inRange(1, 9);
    Mix mix;
    int left = 1000;
    for (int i = 0; i < count; ++i) {
        const int weight = i + 1 == count ? left : *rc::gen::inRange(1, left - (count - i - 1) + 1);
        mix.push_back({std::string(1, static_cast<char>('a' + i)), weight});
        left -= weight;
    }
    const Mix found = surface_mix(mix);
    int sum = 0;
    std::size_t k = 0;
    for (const MixPart& part : mix) {
        const double asked = part.weight * 0.064;
        if (k < found.size() && found[k].id == part.id) {
            RC_ASSERT(found[k].weight > 0);
            const double got = found[k].weight * 0.064;
            RC_ASSERT(std::abs(got - asked) < 1.1);
            RC_ASSERT(std::abs(got - std::floor(got + 0.5)) < 0.065);
            sum += found[k].weight;
            ++k;
        } else {
            RC_ASSERT(asked < 1.0);
        }
    }
    RC_ASSERT(k == found.size());
    RC_ASSERT(sum == 1000);
    RC_ASSERT(surface_mix(found) == found);
}

TEST(SurfaceMix, DropsSpeciesThatRoundToZero) {
    EXPECT_EQ(surface_mix({{"a", 999}, {"b", 1}}), (Mix{{"a", 1000}}));
    EXPECT_EQ(surface_mix({{"a", 500}, {"b", 500}}), (Mix{{"a", 500}, {"b", 500}}));
    EXPECT_EQ(surface_mix({{"a", 984}, {"b", 16}}), (Mix{{"a", 984}, {"b", 16}}));
    EXPECT_EQ(surface_mix({{"a", 1000}}), (Mix{{"a", 1000}}));
    EXPECT_EQ(surface_mix({}), Mix{});
}

TEST(Painting, ASingleSpeciesHasASinglePainting) {
    for (const std::string& id : species_ids()) {
        const MushroomOrder order = painted(order_of(id, 0.6, 3));
        const PaintRecipe recipe = recipe_of(order);
        ASSERT_EQ(recipe.size(), 1U);
        EXPECT_EQ(recipe[0].sixty_fourths, 64);
        EXPECT_EQ(recipe[0].painting.comb, 0);
        EXPECT_EQ(side_of(recipe), 128);
        Keeper keeper;
        const auto images = painted_images(recipe, keeper.workshop);
        EXPECT_EQ(keeper.painted, 0) << "a raw painting is nothing that a lone species needs";
        const ImageSet direct = paint(recipe[0].painting);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_TRUE(*images->files[i].owner == *direct.files[i].owner);
    }
}

TEST(Painting, AUserModelHasASinglePainting) {
    MushroomOrder order = painted(order_of("x", 0.31));
    order.mix.clear();
    order.model = atlas().find("russula_vinosa")->species.stages[1].model;
    const PaintRecipe recipe = recipe_of(order);
    ASSERT_EQ(recipe.size(), 1U);
    EXPECT_EQ(recipe[0].painting.surface, order.model->surface);
}

MushroomOrder mixed(Mix mix) {
    MushroomOrder order = painted(order_of("x", 0.6, 3));
    order.mix = std::move(mix);
    return order;
}

TEST(Painting, EachSpeciesOfAMixIsPaintedAsItWouldBeAlone) {
    MushroomOrder order = mixed({{"amanita_muscaria", 703}, {"boletus_edulis", 297}});
    order.params.age = 0.71;
    order.params.size = 1.7;
    order.params.variation = 1.0;
    const PaintRecipe recipe = recipe_of(order);
    ASSERT_EQ(recipe.size(), 2U);
    for (const PaintShare& share : recipe) {
        const bool agaric = share.painting.surface.hymenium.pattern == HymeniumPattern::gills;
        EXPECT_EQ(share.sixty_fourths, agaric ? 45 : 19);
        MushroomOrder alone = order;
        alone.mix = {{agaric ? "amanita_muscaria" : "boletus_edulis", 1000}};
        EXPECT_EQ(share.painting, recipe_of(alone).at(0).painting);
    }
}

TEST(Painting, AllWeightsOfAPairReuseItsPaintings) {
    // Whatever the weights of the pair: 64 steps blend, and paint what the first one painted.
    for (const auto& [a, b] : {std::pair{"amanita_muscaria", "boletus_edulis"},
                               {"coprinus_comatus", "disciotis_venosa"}}) {
        std::set<std::string> keys;
        Keeper keeper;
        for (int step = 1; step < 64; ++step) {
            MushroomOrder order = mixed({{a, 1000 - step * 1000 / 64}, {b, step * 1000 / 64}});
            order.params.variation = 1.0;
            order.params.size = 0.6;
            order.params.lod = 3;
            (void)painted_images(recipe_of(order), keeper.workshop);
        }
        EXPECT_EQ(keeper.painted, 2) << a << ' ' << b;
        EXPECT_EQ(keeper.dissolved, 63);
    }
}

TEST(Painting, SizesAreStepsOfTwoPerCent) {
    MushroomOrder order = painted(order_of("amanita_muscaria", 0.6, 3));
    const PaintParams own = recipe_of(order).at(0).painting;
    order.params.size = 1.008;
    EXPECT_EQ(recipe_of(order).at(0).painting, own);
    order.params.size = 1.02;
    PaintParams larger = recipe_of(order).at(0).painting;
    EXPECT_EQ(larger.metrics.cap_arc, own.metrics.cap_arc + 1);
    EXPECT_EQ(larger.metrics.stem_radius, own.metrics.stem_radius + 1);
    larger.metrics = own.metrics;
    EXPECT_EQ(larger, own);
    for (const double size : {0.25, 0.31, 1.0, 2.7, 4.0}) {
        order.params.size = size;
        const MushroomOrder surface = surface_order(order, atlas());
        EXPECT_NEAR(surface.params.size / size, 1.0, 0.0101);
        EXPECT_EQ(surface_order(surface, atlas()).params.size, surface.params.size);
        const int step = recipe_of(order).at(0).painting.metrics.cap_arc;
        EXPECT_NEAR(length_of_step(step) / length_of_step(own.metrics.cap_arc) / size, 1.0, 0.0101);
    }
}

TEST(Painting, LengthsAreThoseOfTheShapeAlone) {
    // At ages that are multiples of 1/64 a single species' painting has the lengths of its outline.
    for (const std::string& id : species_ids()) {
        MushroomOrder order = painted(order_of(id, 0.59375, 3));
        EXPECT_EQ(recipe_of(order).at(0).painting.metrics, surface_metrics(resolve(order, atlas())))
            << id;
    }
}

TEST(Painting, TheOrderOfSpeciesDoesNotMatter) {
    const PaintRecipe there = recipe_of(
        mixed({{"amanita_muscaria", 250}, {"boletus_edulis", 250}, {"russula_vinosa", 500}}));
    const PaintRecipe back = recipe_of(
        mixed({{"russula_vinosa", 500}, {"boletus_edulis", 250}, {"amanita_muscaria", 250}}));
    EXPECT_EQ(there, back);
    EXPECT_EQ(image_key(there), image_key(back));
}

TEST(Painting, EightSpeciesHaveOneRecipe) {
    Mix mix;
    for (const std::string& id : swept_ids())
        if (mix.size() < 8) mix.push_back({id, 125});
    const PaintRecipe recipe = recipe_of(mixed(mix));
    EXPECT_EQ(recipe.size(), mix.size());
    int sum = 0;
    for (const PaintShare& share : recipe) sum += share.sixty_fourths;
    EXPECT_EQ(sum, 64);
    EXPECT_GT(painted_images(recipe, {})->bytes(), 3000U);
}

TEST(Painting, ATraceOfASpeciesIsNotPainted) {
    // Nor are overrides kept that only it could have.
    MushroomOrder order = mixed({{"amanita_muscaria", 997}, {"boletus_edulis", 3}});
    order.params.hymenium.pores_per_mm = 2.0;
    order.params.ornaments.warts = 0.5;
    order.arcs = {{.curve = CurveName::cap, .a = 0.3, .b = 0.35}};
    const MushroomOrder surface = surface_order(order, atlas());
    EXPECT_EQ(surface.mix, (Mix{{"amanita_muscaria", 1000}}));
    EXPECT_EQ(surface.params.hymenium.pores_per_mm, std::nullopt);
    EXPECT_EQ(surface.params.ornaments.warts, 0.5);
    EXPECT_TRUE(surface.arcs.empty()) << "links of a pair";
    const PaintRecipe recipe = recipe_of(order);
    ASSERT_EQ(recipe.size(), 1U);
    EXPECT_EQ(recipe[0].painting.comb, 0);
    EXPECT_EQ(recipe[0].painting.ornaments.warts, 0.5);
}

TEST(Painting, GillsOfAMixUseTheLargestGillLayout) {
    const PaintRecipe recipe = recipe_of(mixed({{"boletus_edulis", 200},
                                                {"cantharellus_cibarius", 200},
                                                {"coprinus_comatus", 300},
                                                {"mycena_sanguinolenta", 300}}));
    ASSERT_EQ(recipe.size(), 4U);
    const auto blades_of = [](const std::string& id) {
        return recipe_of(painted(order_of(id))).at(0).painting.hymenium.blades;
    };
    const int most = blades_of("coprinus_comatus");
    for (const PaintShare& share : recipe) {
        const PaintParams& p = share.painting;
        const bool bladed = p.surface.hymenium.pattern == HymeniumPattern::gills ||
                            p.surface.hymenium.pattern == HymeniumPattern::ridges;
        EXPECT_EQ(p.comb, bladed && p.hymenium.blades != most ? most : 0);
    }
}

TEST(Painting, GillsMoveToTheirOwnLayoutTowardsWeightOne) {
    const auto own_share = [](int step) {
        int own = 0, common = 0;
        const PaintRecipe recipe =
            recipe_of(mixed({{"mycena_sanguinolenta", 1000 - step * 1000 / 64},
                             {"coprinus_comatus", step * 1000 / 64}}));
        EXPECT_EQ(atlases_held(recipe), static_cast<int>(recipe.size()) + 1);
        for (const PaintShare& share : recipe)
            if (share.painting.hymenium.blades < 50)
                (share.painting.comb == 0 ? own : common) += share.sixty_fourths;
        EXPECT_EQ(own + common, 64 - step);
        return own;
    };
    EXPECT_EQ(own_share(1), 62);
    EXPECT_EQ(own_share(16), 0);
    EXPECT_EQ(own_share(40), 0);
    int last = 64;
    for (int step = 1; step < 24; ++step) {
        const int own = own_share(step);
        EXPECT_LE(own, last);
        EXPECT_LE(last - own, 7) << step;
        last = own;
    }
}

TEST(Painting, AtlasesInMemoryAreCounted) {
    EXPECT_EQ(atlases_held(mixed({{"amanita_muscaria", 1000}})), 1);
    EXPECT_EQ(atlases_held(mixed({{"amanita_muscaria", 997}, {"boletus_edulis", 3}})), 1);
    EXPECT_EQ(atlases_held(mixed({{"amanita_muscaria", 500}, {"boletus_edulis", 500}})), 3);
    Mix mix;
    for (const std::string& id : swept_ids())
        if (mix.size() < 8) mix.push_back({id, 125});
    EXPECT_EQ(atlases_held(mixed(mix)), 9);
    for (MixPart& part : mix) part.weight = 17;
    mix.front().weight = 1000 - 7 * 17;
    EXPECT_EQ(atlases_held(mixed(mix)), 10);
    EXPECT_GE(atlases_held(mixed(mix)), atlases_held(recipe_of(mixed(mix))));
    const MushroomOrder order = mixed(mix);
    EXPECT_EQ(estimate(order, atlas()).texels, 10U * 3 * 128 * 128);
    EXPECT_EQ(estimate(order, atlas()).bytes, estimate(textured(order), atlas()).bytes + 128U * 128)
        << "one atlas is in the file";
}

TEST(Painting, OverridesApplyToEverySpecies) {
    MushroomOrder order = mixed({{"amanita_muscaria", 500}, {"coprinus_comatus", 500}});
    order.params.weathering.fade = 0.7;
    order.params.weathering.wetness = 0.2;
    order.params.hymenium.blades = 50;
    order.params.ornaments.scales = 0.9;
    for (const PaintShare& share : recipe_of(order)) {
        EXPECT_EQ(share.painting.weathering.fade, 0.7);
        EXPECT_EQ(share.painting.weathering.wetness, 0.2);
        EXPECT_EQ(share.painting.hymenium.blades, 50);
        EXPECT_EQ(share.painting.ornaments.scales, 0.9);
    }
}

TEST(Painting, AMixedMushroomHasTheImagesOfItsRecipe) {
    const MushroomOrder order = mixed({{"amanita_muscaria", 400}, {"russula_vinosa", 600}});
    Keeper keeper;
    const Mushroom mushroom = grow_mushroom(order, atlas(), {}, keeper.workshop);
    EXPECT_EQ(keeper.dissolved, 1);
    EXPECT_EQ(keeper.painted, 2);
    const auto images = painted_images(recipe_of(order), keeper.workshop);
    EXPECT_EQ(keeper.dissolved, 1);
    for (const Slice& file : images->files)
        EXPECT_TRUE(std::any_of(mushroom.glb.begin(), mushroom.glb.end(),
                                [&](const Slice& s) { return s.owner == file.owner; }));
    // A thousandth is below the resolution of images.
    MushroomOrder near = order;
    near.mix[0].weight = 401;
    near.mix[1].weight = 599;
    EXPECT_EQ(recipe_of(near), recipe_of(order));
}

TEST(Painting, AMixIsBlendedFromCachedPaintings) {
    Keeper keeper;
    const auto half = painted_images(pair(32), keeper.workshop);
    EXPECT_EQ(keeper.painted, 2);
    EXPECT_EQ(keeper.dissolved, 1);
    EXPECT_EQ(painted_images(pair(32), keeper.workshop), half);
    EXPECT_EQ(keeper.painted, 2);
    EXPECT_EQ(keeper.dissolved, 1);
    const auto other = painted_images(pair(31), keeper.workshop);
    EXPECT_EQ(keeper.painted, 2) << "another weight paints nothing";
    EXPECT_EQ(keeper.dissolved, 2);
    EXPECT_FALSE(*other->files[0].owner == *half->files[0].owner);
    // Cached or painted now, with one thread or many: the same bytes.
    Workshop threads;
    threads.parallel = all_at_once;
    const auto anew = painted_images(pair(32), threads);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(*anew->files[i].owner == *half->files[i].owner);
}

TEST(Painting, KeysDistinguishRecipes) {
    std::set<std::string> keys;
    for (const int first : {1, 31, 32, 63}) keys.insert(image_key(pair(first)));
    PaintRecipe seeded = pair(32);
    seeded[1].painting.seed = 9;
    keys.insert(image_key(seeded));
    keys.insert(image_key({{pair(32)[0].painting, 64}}));
    EXPECT_EQ(keys.size(), 6U);
}

TEST(Painting, StopsWhenCancelled) {
    std::stop_source source;
    source.request_stop();
    Workshop workshop;
    workshop.stop = source.get_token();
    EXPECT_THROW((void)painted_images(pair(32), workshop), Cancelled);
}

}  // namespace
}  // namespace sporeprint
