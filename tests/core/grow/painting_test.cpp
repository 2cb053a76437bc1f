#include "core/grow/painting.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "core/grow/mushroom.h"
#include "core/surface/dissolve.h"
#include "tests/support/orders.h"
#include "tests/support/paintings.h"

namespace sporeprint {
namespace {

/// A workshop that keeps paintings and images by their keys, and counts what was made.
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

PaintRecipe recipe_of(const MushroomOrder& order) {
    return paint_recipe(order, atlas(), surface_metrics(resolve(order, atlas())));
}

/// Two species' own paintings, painted small with the lengths of the first.
PaintRecipe pair(int first) {
    const MushroomOrder a = painted(order_of("amanita_muscaria"));
    const MushroomOrder b = painted(order_of("boletus_edulis"));
    const SurfaceMetrics metrics = surface_metrics(resolve(a, atlas()));
    return {{paint_recipe(a, atlas(), metrics).at(0).painting, first},
            {paint_recipe(b, atlas(), metrics).at(0).painting, 64 - first}};
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

TEST(SurfaceMix, DropsWhatRoundsToNothing) {
    EXPECT_EQ(surface_mix({{"a", 999}, {"b", 1}}), (Mix{{"a", 1000}}));
    EXPECT_EQ(surface_mix({{"a", 500}, {"b", 500}}), (Mix{{"a", 500}, {"b", 500}}));
    EXPECT_EQ(surface_mix({{"a", 984}, {"b", 16}}), (Mix{{"a", 984}, {"b", 16}}));
    EXPECT_EQ(surface_mix({{"a", 1000}}), (Mix{{"a", 1000}}));
    EXPECT_EQ(surface_mix({}), Mix{});
}

TEST(Painting, ALoneSpeciesIsPaintedByItsOwnRecipe) {
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

TEST(Painting, AModelOfOnesOwnHasARecipe) {
    MushroomOrder order = painted(order_of("x", 0.31));
    order.mix.clear();
    order.model = atlas().find("russula_vinosa")->species.stages[1].model;
    const PaintRecipe recipe = recipe_of(order);
    ASSERT_EQ(recipe.size(), 1U);
    EXPECT_EQ(recipe[0].painting.surface, order.model->surface);
}

TEST(Painting, AMixIsDissolvedFromPaintingsThatAreKept) {
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
    // Kept or painted now, with one thread or many: the same bytes.
    Workshop threads;
    threads.parallel = all_at_once;
    const auto anew = painted_images(pair(32), threads);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(*anew->files[i].owner == *half->files[i].owner);
}

TEST(Painting, KeysTellRecipesApart) {
    std::set<std::string> keys;
    for (const int first : {1, 31, 32, 63}) keys.insert(image_key(pair(first)));
    PaintRecipe seeded = pair(32);
    seeded[1].painting.seed = 9;
    keys.insert(image_key(seeded));
    keys.insert(image_key({{pair(32)[0].painting, 64}}));
    EXPECT_EQ(keys.size(), 6U);
}

TEST(Painting, IsAbandonedWhenAskedToStop) {
    std::stop_source source;
    source.request_stop();
    Workshop workshop;
    workshop.stop = source.get_token();
    EXPECT_THROW((void)painted_images(pair(32), workshop), Cancelled);
}

}  // namespace
}  // namespace sporeprint
