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
#include "core/grow/names.h"
#include "core/surface/codecs.h"
#include "core/surface/image_blend.h"
#include "tests/support/orders.h"
#include "tests/support/paintings.h"

namespace sporeprint::grow_painting_test {
namespace {

/// An execution context that caches paintings and images by their keys, and counts what was
/// computed.
struct Keeper {
    std::map<std::string, std::shared_ptr<const ImageSet>> images;
    std::map<std::string, std::shared_ptr<const RawImages>> paintings;
    int blended = 0, painted = 0;
    ExecutionContext execution;

    Keeper() {
        execution.caches.images = [this](const std::string& key, const auto& make) {
            if (!images.contains(key)) {
                ++blended;
                images[key] = make();
            }
            return images[key];
        };
        execution.caches.paintings = [this](const std::string& key, const auto& make) {
            if (!paintings.contains(key)) {
                ++painted;
                paintings[key] = make();
            }
            return paintings[key];
        };
    }
};

PaintSpec paint_spec_of(const MushroomSpec& spec) { return paint_spec_of(spec, atlas()); }

/// Returns paintings of two species at a small size.
PaintSpec pair(int first) {
    const MushroomSpec a = painted(order_of("amanita_muscaria"));
    const MushroomSpec b = painted(order_of("boletus_edulis"));
    return {{paint_spec_of(a).at(0).painting, first},
            {paint_spec_of(b).at(0).painting, 64 - first}};
}

RC_GTEST_PROP(SurfaceMix, IsTheNearestInSixtyFourthsAndStaysIt, ()) {
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
        const double exact_share = part.weight * 0.064;
        if (k < found.size() && found[k].id == part.id) {
            RC_ASSERT(found[k].weight > 0);
            const double got = found[k].weight * 0.064;
            RC_ASSERT(std::abs(got - exact_share) < 1.1);
            RC_ASSERT(std::abs(got - std::floor(got + 0.5)) < 0.065);
            sum += found[k].weight;
            ++k;
        } else {
            RC_ASSERT(exact_share < 1.0);
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
        const MushroomSpec spec = painted(order_of(id, 0.6, 3));
        const PaintSpec paint_spec = paint_spec_of(spec);
        ASSERT_EQ(paint_spec.size(), 1U);
        EXPECT_EQ(paint_spec[0].sixty_fourths, 64);
        EXPECT_EQ(paint_spec[0].painting.gill_layout, 0);
        EXPECT_EQ(side_of(paint_spec), 128);
        Keeper keeper;
        const auto images = painted_images(paint_spec, keeper.execution);
        EXPECT_EQ(keeper.painted, 0) << "a raw painting is nothing that a lone species needs";
        const ImageSet direct = paint(paint_spec[0].painting);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_TRUE(*images->files[i].owner == *direct.files[i].owner);
    }
}

TEST(Painting, AUserModelHasASinglePainting) {
    MushroomSpec spec = painted(on_ground(order_of("x", 0.31)));
    spec.mix.clear();
    spec.model = atlas().find("russula_vinosa")->species.stages[1].model;
    const PaintSpec paint_spec = paint_spec_of(spec);
    ASSERT_EQ(paint_spec.size(), 1U);
    EXPECT_EQ(paint_spec[0].painting.surface, spec.model->surface);
}

MushroomSpec mixed(Mix mix) {
    MushroomSpec spec = painted(order_of("x", 0.6, 3));
    spec.mix = std::move(mix);
    return spec;
}

TEST(Painting, EachSpeciesOfAMixIsPaintedAsItWouldBeAlone) {
    MushroomSpec spec = mixed({{"amanita_muscaria", 703}, {"boletus_edulis", 297}});
    spec.params.age = 0.71;
    spec.params.size = 1.7;
    spec.params.variation = 1.0;
    const PaintSpec paint_spec = paint_spec_of(spec);
    ASSERT_EQ(paint_spec.size(), 2U);
    for (const PaintShare& share : paint_spec) {
        const bool agaric = share.painting.surface.hymenium.pattern == HymeniumPattern::gills;
        EXPECT_EQ(share.sixty_fourths, agaric ? 45 : 19);
        MushroomSpec alone = spec;
        alone.mix = {{agaric ? "amanita_muscaria" : "boletus_edulis", 1000}};
        EXPECT_EQ(share.painting, paint_spec_of(alone).at(0).painting);
    }
}

TEST(Painting, AllWeightsOfAPairReuseItsPaintings) {
    // Whatever the weights of the pair: 64 steps blend, and paint what the first one painted.
    for (const auto& [a, b] : {std::pair{"amanita_muscaria", "boletus_edulis"},
                               {"coprinus_comatus", "disciotis_venosa"}}) {
        std::set<std::string> keys;
        Keeper keeper;
        for (int step = 1; step < 64; ++step) {
            MushroomSpec spec = mixed({{a, 1000 - step * 1000 / 64}, {b, step * 1000 / 64}});
            spec.params.variation = 1.0;
            spec.params.size = 0.6;
            spec.params.lod = 3;
            (void)painted_images(paint_spec_of(spec), keeper.execution);
        }
        EXPECT_EQ(keeper.painted, 2) << a << ' ' << b;
        EXPECT_EQ(keeper.blended, 63);
    }
}

TEST(Painting, SizesAreStepsOfTwoPerCent) {
    MushroomSpec spec = painted(order_of("amanita_muscaria", 0.6, 3));
    const PaintParams own = paint_spec_of(spec).at(0).painting;
    spec.params.size = 1.008;
    EXPECT_EQ(paint_spec_of(spec).at(0).painting, own);
    spec.params.size = 1.02;
    PaintParams larger = paint_spec_of(spec).at(0).painting;
    EXPECT_EQ(larger.metrics.cap_arc, own.metrics.cap_arc + 1);
    EXPECT_EQ(larger.metrics.stem_radius, own.metrics.stem_radius + 1);
    larger.metrics = own.metrics;
    EXPECT_EQ(larger, own);
    for (const double size : {0.25, 0.31, 1.0, 2.7, 4.0}) {
        spec.params.size = size;
        const MushroomSpec surface = surface_spec(spec, atlas());
        EXPECT_NEAR(surface.params.size / size, 1.0, 0.0101);
        EXPECT_EQ(surface_spec(surface, atlas()).params.size, surface.params.size);
        const int step = paint_spec_of(spec).at(0).painting.metrics.cap_arc;
        EXPECT_NEAR(length_of_step(step) / length_of_step(own.metrics.cap_arc) / size, 1.0, 0.0101);
    }
}

TEST(Painting, LengthsAreThoseOfTheShapeAlone) {
    // At ages that are multiples of 1/64 a single species' painting has the lengths of its outline.
    for (const std::string& id : species_ids()) {
        MushroomSpec spec = painted(order_of(id, 0.59375, 3));
        EXPECT_EQ(paint_spec_of(spec).at(0).painting.metrics,
                  surface_metrics(resolve(spec, atlas())))
            << id;
    }
}

// The bulb of a fly agaric is sunk in the ground.
TEST(Painting, TheFootIsWhatIsBelowTheGround) {
    const auto foot = [](const std::string& id) {
        const SurfaceMetrics metrics = surface_metrics(resolve(order_of(id, 0.6, 1), atlas()));
        return length_of_step(metrics.stem_foot) / length_of_step(metrics.stem_length);
    };
    const double sunk = foot("amanita_muscaria");
    EXPECT_GT(sunk, 0.02);
    EXPECT_LT(sunk, 0.4);
    const SubCurve stem = resolve(order_of("amanita_muscaria", 0.6, 1), atlas()).outline.stem;
    EXPECT_NEAR(stem.at(sunk).y, 0.0, 0.04 * stem.length());
}

TEST(Painting, ACleanBaseHasNeitherSoilNorFelt) {
    MushroomSpec spec = painted(on_ground(order_of("amanita_muscaria", 0.6, 1)));
    const PaintParams natural = paint_spec_of(spec).at(0).painting;
    EXPECT_GT(natural.surface.stem.soil, 0.0);
    spec.params.base = Base::clean;
    PaintParams clean = paint_spec_of(spec).at(0).painting;
    EXPECT_EQ(clean.surface.stem.soil, 0.0);
    EXPECT_EQ(clean.surface.stem.mycelium, 0.0);
    // Nor colours of litter, which would cause another key of its images.
    EXPECT_EQ(clean.ground, PaintedGround{});
    EXPECT_NE(natural.ground, clean.ground);
    clean.surface.stem = natural.surface.stem;
    clean.ground = natural.ground;
    EXPECT_EQ(clean, natural);
}

TEST(Painting, TheOrderOfSpeciesDoesNotMatter) {
    const PaintSpec there = paint_spec_of(
        mixed({{"amanita_muscaria", 250}, {"boletus_edulis", 250}, {"russula_vinosa", 500}}));
    const PaintSpec back = paint_spec_of(
        mixed({{"russula_vinosa", 500}, {"boletus_edulis", 250}, {"amanita_muscaria", 250}}));
    EXPECT_EQ(there, back);
    EXPECT_EQ(image_key(there, ImageFormat::jpg), image_key(back, ImageFormat::jpg));
}

TEST(Painting, EightSpeciesHaveOnePaintSpec) {
    Mix mix;
    for (const std::string& id : swept_ids())
        if (mix.size() < 8) mix.push_back({id, 125});
    const PaintSpec paint_spec = paint_spec_of(mixed(mix));
    EXPECT_EQ(paint_spec.size(), mix.size());
    int sum = 0;
    for (const PaintShare& share : paint_spec) sum += share.sixty_fourths;
    EXPECT_EQ(sum, 64);
    EXPECT_GT(painted_images(paint_spec, {})->bytes(), 3000U);
}

TEST(Painting, ATraceOfASpeciesIsNotPainted) {
    // Overrides that only this species could have are dropped too.
    MushroomSpec spec = mixed({{"amanita_muscaria", 997}, {"boletus_edulis", 3}});
    spec.params.hymenium.pores_per_mm = 2.0;
    spec.params.ornaments.warts = 0.5;
    spec.arcs = {{.curve = CurveName::cap, .a = 0.3, .b = 0.35}};
    const MushroomSpec surface = surface_spec(spec, atlas());
    EXPECT_EQ(surface.mix, (Mix{{"amanita_muscaria", 1000}}));
    EXPECT_EQ(surface.params.hymenium.pores_per_mm, std::nullopt);
    EXPECT_EQ(surface.params.ornaments.warts, 0.5);
    EXPECT_TRUE(surface.arcs.empty()) << "links of a pair";
    const PaintSpec paint_spec = paint_spec_of(spec);
    ASSERT_EQ(paint_spec.size(), 1U);
    EXPECT_EQ(paint_spec[0].painting.gill_layout, 0);
    EXPECT_EQ(paint_spec[0].painting.ornaments.warts, 0.5);
}

TEST(Painting, GillsOfAMixUseTheLargestGillLayout) {
    const PaintSpec paint_spec = paint_spec_of(mixed({{"boletus_edulis", 200},
                                                      {"cantharellus_cibarius", 200},
                                                      {"coprinus_comatus", 300},
                                                      {"mycena_sanguinolenta", 300}}));
    ASSERT_EQ(paint_spec.size(), 4U);
    const auto blades_of = [](const std::string& id) {
        return paint_spec_of(painted(order_of(id))).at(0).painting.hymenium.blades;
    };
    const int most = blades_of("coprinus_comatus");
    for (const PaintShare& share : paint_spec) {
        const PaintParams& p = share.painting;
        const bool bladed = p.surface.hymenium.pattern == HymeniumPattern::gills ||
                            p.surface.hymenium.pattern == HymeniumPattern::ridges;
        EXPECT_EQ(p.gill_layout, bladed && p.hymenium.blades != most ? most : 0);
    }
}

TEST(Painting, GillsMoveToTheirOwnLayoutTowardsWeightOne) {
    const auto own_share = [](int step) {
        int own = 0, common = 0;
        const PaintSpec paint_spec =
            paint_spec_of(mixed({{"mycena_sanguinolenta", 1000 - step * 1000 / 64},
                                 {"coprinus_comatus", step * 1000 / 64}}));
        EXPECT_EQ(atlases_held(paint_spec), static_cast<int>(paint_spec.size()) + 1);
        for (const PaintShare& share : paint_spec)
            if (share.painting.hymenium.blades < 50)
                (share.painting.gill_layout == 0 ? own : common) += share.sixty_fourths;
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
    EXPECT_GE(atlases_held(mixed(mix)), atlases_held(paint_spec_of(mixed(mix))));
    const MushroomSpec spec = mixed(mix);
    EXPECT_EQ(estimate(spec, atlas()).texels, 10U * 3 * 128 * 128);
    EXPECT_EQ(estimate(spec, atlas()).bytes, estimate(textured(spec), atlas()).bytes + 128U * 128)
        << "one atlas is in the file";
}

TEST(Painting, OverridesApplyToEverySpecies) {
    MushroomSpec spec = mixed({{"amanita_muscaria", 500}, {"coprinus_comatus", 500}});
    spec.params.weathering.fade = 0.7;
    spec.params.weathering.wetness = 0.2;
    spec.params.hymenium.blades = 50;
    spec.params.ornaments.scales = 0.9;
    for (const PaintShare& share : paint_spec_of(spec)) {
        EXPECT_EQ(share.painting.weathering.fade, 0.7);
        EXPECT_EQ(share.painting.weathering.wetness, 0.2);
        EXPECT_EQ(share.painting.hymenium.blades, 50);
        EXPECT_EQ(share.painting.ornaments.scales, 0.9);
    }
}

TEST(Painting, AMixedMushroomHasTheImagesOfItsPaintSpec) {
    const MushroomSpec spec = mixed({{"amanita_muscaria", 400}, {"russula_vinosa", 600}});
    Keeper keeper;
    const Mushroom mushroom = grow_mushroom(spec, atlas(), {}, keeper.execution);
    EXPECT_EQ(keeper.blended, 1);
    EXPECT_EQ(keeper.painted, 2);
    const auto images = painted_images(paint_spec_of(spec), keeper.execution);
    EXPECT_EQ(keeper.blended, 1);
    for (const Slice& file : images->files)
        EXPECT_TRUE(std::any_of(mushroom.glb.begin(), mushroom.glb.end(),
                                [&](const Slice& s) { return s.owner == file.owner; }));
    // A thousandth is below the resolution of images.
    MushroomSpec near = spec;
    near.mix[0].weight = 401;
    near.mix[1].weight = 599;
    EXPECT_EQ(paint_spec_of(near), paint_spec_of(spec));
}

TEST(Painting, AMixIsBlendedFromCachedPaintings) {
    Keeper keeper;
    const auto half = painted_images(pair(32), keeper.execution);
    EXPECT_EQ(keeper.painted, 2);
    EXPECT_EQ(keeper.blended, 1);
    EXPECT_EQ(painted_images(pair(32), keeper.execution), half);
    EXPECT_EQ(keeper.painted, 2);
    EXPECT_EQ(keeper.blended, 1);
    const auto other = painted_images(pair(31), keeper.execution);
    EXPECT_EQ(keeper.painted, 2) << "another weight paints nothing";
    EXPECT_EQ(keeper.blended, 2);
    EXPECT_FALSE(*other->files[0].owner == *half->files[0].owner);
    // Cached or painted now, with one thread or many: the same bytes.
    ExecutionContext threads;
    threads.parallel = all_at_once;
    const auto anew = painted_images(pair(32), threads);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(*anew->files[i].owner == *half->files[i].owner);
}

TEST(Painting, KeysDistinguishPaintSpecs) {
    std::set<std::string> keys;
    for (const int first : {1, 31, 32, 63}) keys.insert(image_key(pair(first), ImageFormat::jpg));
    PaintSpec seeded = pair(32);
    seeded[1].painting.seed = 9;
    keys.insert(image_key(seeded, ImageFormat::jpg));
    for (const ImageFormat format : {ImageFormat::jpg, ImageFormat::webp})
        keys.insert(image_key({{pair(32)[0].painting, 64}}, format));
    EXPECT_EQ(keys.size(), 7U);
}

TEST(Painting, WebpImagesShowWhatJpegImagesShow) {
    Keeper keeper;
    for (const PaintSpec& spec : {pair(32), PaintSpec{{pair(32)[0].painting, 64}}}) {
        const auto webp = painted_images(spec, keeper.execution, ImageFormat::webp),
                   jpg = painted_images(spec, keeper.execution);
        EXPECT_EQ(webp->format, ImageFormat::webp);
        EXPECT_EQ(jpg->format, ImageFormat::jpg);
        EXPECT_LT(webp->bytes(), jpg->bytes() * 3 / 4);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto pixels = [&](const ImageSet& set) {
                const Slice& file = set.files[i];
                return decoded_picture({file.data(), file.size}, "/").rgb;
            };
            const Bytes one = pixels(*webp), other = pixels(*jpg);
            ASSERT_EQ(one.size(), other.size());
            double sum = 0.0;
            for (std::size_t k = 0; k < one.size(); ++k)
                sum += std::abs(int{one[k]} - int{other[k]});
            EXPECT_LT(sum / static_cast<double>(one.size()), 6.0) << i;
        }
    }
}

TEST(Painting, StopsWhenCancelled) {
    std::stop_source source;
    source.request_stop();
    ExecutionContext execution;
    execution.stop = source.get_token();
    EXPECT_THROW((void)painted_images(pair(32), execution), Cancelled);
}

TEST(PaintSpec, IsTheSameForAllSeedsOfASpeciesThatShareImages) {
    for (const char* id : {"amanita_muscaria", "boletus_edulis", "ramaria_formosa"}) {
        MushroomSpec first = order_of(id), fifth = order_of(id, 0.6, 5);
        EXPECT_NE(paint_spec_of(first, atlas()), paint_spec_of(fifth, atlas()));
        const PaintSpec own = paint_spec_of(first, atlas());
        first.params.share = fifth.params.share = ImageShare::species;
        EXPECT_EQ(paint_spec_of(first, atlas()), own);
        EXPECT_EQ(paint_spec_of(fifth, atlas()), own);
        EXPECT_EQ(skin_name(first), skin_name(fifth));
        // What is both built and painted is where it is painted; all else differs.
        EXPECT_EQ(resolve(fifth, atlas()).painted_seed, 1U);
        EXPECT_NE(resolve(fifth, atlas()).model.deformation.lean_deg,
                  resolve(first, atlas()).model.deformation.lean_deg);
        EXPECT_EQ(resolve(fifth, atlas()).effective.seed, 5U);
    }
}

}  // namespace
}  // namespace sporeprint::grow_painting_test
