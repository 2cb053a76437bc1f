#include "api/surfaces.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "api/mix.h"
#include "api/query.h"
#include "tests/api/support.h"

namespace sporeprint::api {
namespace {

double share() { return *rc::gen::inRange(0, 1001) / 1000.0; }

/// A random order of one to four species, with overrides of what they have.
MushroomOrder random_order(const Atlas& atlas) {
    const std::vector<std::string> ids = test::swept_species(atlas);
    MushroomOrder order;
    Weights weights;
    const int count = *rc::gen::inRange(1, 5);
    for (int i = 0; i < count; ++i) {
        const auto number =
            static_cast<std::size_t>(*rc::gen::inRange<int>(0, static_cast<int>(ids.size())));
        const std::string& id = ids[number];
        const bool named = std::any_of(weights.begin(), weights.end(),
                                       [&](const auto& one) { return one.first == id; });
        if (!named) weights.emplace_back(id, 0.001 + share());
    }
    order.mix = canonical_mix(std::move(weights));
    order.params.seed = *rc::gen::arbitrary<std::uint32_t>();
    order.params.age = share();
    order.params.variation = share();
    order.params.size = 0.25 + 3.75 * share();
    order.params.lod = *rc::gen::inRange(0, 4);
    order.params.texture_size.value = 128 << *rc::gen::inRange(0, 5);
    order.params.deformation.bend_deg = 20.0 * share();
    if (*rc::gen::arbitrary<bool>()) order.params.weathering.fade = share();
    if (*rc::gen::arbitrary<bool>()) order.params.weathering.wetness = share();
    const Individual individual = resolve(order, atlas);
    const auto maybe = [](auto& mine, const auto& own, double value) {
        if (own && *rc::gen::arbitrary<bool>()) mine = value;
    };
    maybe(order.params.ornaments.warts, individual.effective.ornaments.warts, share());
    maybe(order.params.ornaments.ring, individual.effective.ornaments.ring, share());
    maybe(order.params.hymenium.relief, individual.effective.hymenium.relief, share());
    return order;
}

RC_GTEST_PROP(SurfaceAddressProperty, an_address_paints_what_its_order_paints, ()) {
    const auto atlas = built_in_atlas();
    const MushroomOrder order = random_order(*atlas);
    const PaintRecipe painted = paint_recipe(order, *atlas);
    const MushroomOrder surface = surface_order(order, *atlas);
    const SurfaceAddress address = surface_address(surface);

    // Through its text and back, as another server reads it.
    const std::string text = canonical_address(surface.mix, ImageKind::normal, address);
    RC_ASSERT(text.size() <= longest_target);
    std::vector<Problem> problems;
    const Target target = split_target(text, problems);
    RC_ASSERT(problems.empty());
    Faults faults;
    const std::string image = target.segments.back().substr(0, target.segments.back().rfind('.'));
    const SurfaceRequest read =
        read_surface(target.segments[3], image, target.query, *atlas, faults);
    RC_ASSERT(faults.empty());
    RC_ASSERT(read.kind == ImageKind::normal);
    RC_ASSERT(read.mix == surface.mix);
    RC_ASSERT(read.address == address);
    RC_ASSERT(canonical_address(read.mix, *read.kind, read.address) == text);

    const PaintRecipe again = painted_at(read.address, read.mix, *atlas);
    RC_ASSERT(image_key(again) == image_key(painted));
    RC_ASSERT(again == painted);
}

TEST(SurfaceAddress, shape_alone_does_not_change_it) {
    const auto atlas = built_in_atlas();
    MushroomOrder order;
    order.mix = {{test::first_species(), 1000}};
    const auto address_of = [&] { return surface_address(surface_order(order, *atlas)); };
    const SurfaceAddress before = address_of();
    order.params.deformation.bend_deg = 30;
    order.params.deformation.lean_deg = 10;
    order.params.weathering.waves = 0.5;
    order.params.age += 0.0001;
    order.params.size = 1.009;
    EXPECT_EQ(address_of(), before);
    order.params.size = 0.5;
    EXPECT_EQ(address_of().size, -35);
}

TEST(SurfaceAddress, weights_come_in_steps_of_a_sixty_fourth) {
    const auto atlas = built_in_atlas();
    const auto canonical = [&](const std::string& mix) {
        Faults faults;
        const SurfaceRequest read = read_surface(mix, "normal", {}, *atlas, faults);
        EXPECT_TRUE(faults.empty()) << mix;
        return canonical_address(read.mix, ImageKind::normal, read.address);
    };
    const std::string half = "/v1/surfaces/mushrooms/amanita_muscaria:0.5,boletus_edulis:0.5";
    EXPECT_EQ(canonical("amanita_muscaria:1,boletus_edulis:1"), half + "/normal.jpg");
    EXPECT_EQ(canonical("boletus_edulis:0.503,amanita_muscaria:0.497"), half + "/normal.jpg");
    EXPECT_EQ(canonical("amanita_muscaria:0.7,boletus_edulis:0.3"),
              "/v1/surfaces/mushrooms/amanita_muscaria:0.703,boletus_edulis:0.297/normal.jpg");
    EXPECT_EQ(canonical("amanita_muscaria:0.703,boletus_edulis:0.297"),
              "/v1/surfaces/mushrooms/amanita_muscaria:0.703,boletus_edulis:0.297/normal.jpg");
    EXPECT_EQ(canonical("amanita_muscaria:0.996,boletus_edulis:0.004"),
              "/v1/surfaces/mushrooms/amanita_muscaria/normal.jpg");
}

/// Images of a mix: those inside the file, those at the addresses that another file names, and those of another server.
TEST(SurfaceAddress, linked_images_of_a_mix_are_those_embedded) {
    for (const std::string mix :
         {"amanita_muscaria:0.7,boletus_edulis:0.3", "coprinus_comatus:0.997,russula_vinosa:0.003",
          "cantharellus_cibarius:0.2,disciotis_venosa:0.3,mycena_sanguinolenta:0.5"}) {
        Service service(built_in_atlas(), ServiceOptions{}),
            other(built_in_atlas(), ServiceOptions{});
        const std::string address =
            "/v1/mushrooms/" + mix + ".glb?age=0.71&seed=3&lod=2&texture_size=256";
        const std::string embedded = test::text_of(handle(service, test::get(address)));
        const Answer linked = handle(service, test::get(address + "&textures=linked"));
        ASSERT_EQ(linked.status, 200) << test::text_of(linked);
        int found = 0;
        for (const std::string& image : test::linked_images(linked, address)) {
            const Answer kept = handle(service, test::get(image));
            ASSERT_EQ(kept.status, 200) << image << test::text_of(kept);
            EXPECT_EQ(test::header(kept, "Cache-Status"), "sporeprint-images; hit") << image;
            EXPECT_EQ(test::header(kept, "Content-Location"), image);
            EXPECT_NE(embedded.find(test::text_of(kept)), std::string::npos) << image;
            const Answer elsewhere = handle(other, test::get(image));
            EXPECT_EQ(test::text_of(elsewhere), test::text_of(kept));
            EXPECT_EQ(test::header(elsewhere, "ETag"), test::header(kept, "ETag"));
            ++found;
        }
        EXPECT_EQ(found, 3);
    }
}

TEST(SurfaceAddress, ages_come_in_steps_of_a_sixty_fourth) {
    EXPECT_EQ(quantised_age(0.6), SurfaceAddress{}.age);
    EXPECT_EQ(quantised_age(0.0), 0.0);
    EXPECT_EQ(quantised_age(1.0), 1.0);
    for (int i = 0; i <= 64; ++i) EXPECT_EQ(quantised_age(i / 64.0), i / 64.0);
}

}  // namespace
}  // namespace sporeprint::api
