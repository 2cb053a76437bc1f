#include "api/products/surfaces.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "api/http/query.h"
#include "api/products/mix.h"
#include "tests/api/support.h"

namespace sporeprint::api::products_surfaces_test {
namespace {

double share() { return *rc::gen::inRange(0, 1001) / 1000.0; }

/// A random order of one to four species, with overrides of what they have.
MushroomSpec random_order(const Atlas& atlas) {
    const std::vector<std::string> ids = test::swept_species(atlas);
    MushroomSpec spec;
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
    spec.mix = canonical_mix(std::move(weights));
    spec.params.seed = *rc::gen::arbitrary<std::uint32_t>();
    spec.params.age = share();
    spec.params.variation = share();
    spec.params.size = 0.25 + 3.75 * share();
    spec.params.lod = *rc::gen::inRange(0, 4);
    spec.params.texture_size.value = 128 << *rc::gen::inRange(0, 5);
    spec.params.deformation.bend_deg = 20.0 * share();
    if (*rc::gen::arbitrary<bool>()) spec.params.weathering.fade = share();
    if (*rc::gen::arbitrary<bool>()) spec.params.weathering.wetness = share();
    const Individual individual = resolve(spec, atlas);
    const auto maybe = [](auto& mine, const auto& own, double value) {
        if (own && *rc::gen::arbitrary<bool>()) mine = value;
    };
    maybe(spec.params.ornaments.warts, individual.effective.ornaments.warts, share());
    maybe(spec.params.ornaments.ring, individual.effective.ornaments.ring, share());
    maybe(spec.params.hymenium.relief, individual.effective.hymenium.relief, share());
    return spec;
}

RC_GTEST_PROP(SurfaceAddressProperty, AnAddressPaintsWhatItsOrderPaints, ()) {
    const auto atlas = built_in_atlas();
    const MushroomSpec spec = random_order(*atlas);
    const PaintSpec painted = paint_spec_of(spec, *atlas);
    const MushroomSpec surface = surface_spec(spec, *atlas);
    const SurfaceAddress address = surface_address(surface);

    // Through its text and back, as another server reads it.
    const std::string text =
        canonical_address("colonies", surface.mix, ImageKind::normal, ImageFormat::jpg, address);
    RC_ASSERT(text.size() <= longest_target);
    std::vector<Problem> problems;
    const Target target = split_target(text, problems);
    RC_ASSERT(problems.empty());
    ValidationErrors errors;
    const std::string image = target.segments.back().substr(0, target.segments.back().rfind('.'));
    const SurfaceRequest read =
        read_surface(target.segments[2], image, target.query, *atlas, errors);
    RC_ASSERT(errors.empty());
    RC_ASSERT(read.kind == ImageKind::normal);
    RC_ASSERT(read.mix == surface.mix);
    RC_ASSERT(read.address == address);
    RC_ASSERT(canonical_address("colonies", read.mix, *read.kind, ImageFormat::jpg, read.address) ==
              text);

    const PaintSpec again = painted_at(read.address, read.mix, *atlas);
    RC_ASSERT(image_key(again, ImageFormat::jpg) == image_key(painted, ImageFormat::jpg));
    RC_ASSERT(again == painted);
}

TEST(SurfaceAddress, ShapeAloneDoesNotChangeIt) {
    const auto atlas = built_in_atlas();
    MushroomSpec spec;
    spec.mix = {{test::first_species(), 1000}};
    const auto address_of = [&] { return surface_address(surface_spec(spec, *atlas)); };
    const SurfaceAddress before = address_of();
    spec.params.deformation.bend_deg = 30;
    spec.params.deformation.lean_deg = 10;
    spec.params.weathering.waves = 0.5;
    spec.params.age += 0.0001;
    spec.params.size = 1.009;
    EXPECT_EQ(address_of(), before);
    spec.params.size = 0.5;
    EXPECT_EQ(address_of().size, -35);
}

TEST(SurfaceAddress, WeightsComeInStepsOfASixtyFourth) {
    const auto atlas = built_in_atlas();
    const auto canonical = [&](const std::string& mix) {
        ValidationErrors errors;
        const SurfaceRequest read = read_surface(mix, "normal", {}, *atlas, errors);
        EXPECT_TRUE(errors.empty()) << mix;
        return canonical_address("mushrooms", read.mix, ImageKind::normal, ImageFormat::jpg,
                                 read.address);
    };
    const std::string half = "/v1/mushrooms/amanita_muscaria:0.5,boletus_edulis:0.5";
    EXPECT_EQ(canonical("amanita_muscaria:1,boletus_edulis:1"), half + "/normal.jpg");
    EXPECT_EQ(canonical("boletus_edulis:0.503,amanita_muscaria:0.497"), half + "/normal.jpg");
    EXPECT_EQ(canonical("amanita_muscaria:0.7,boletus_edulis:0.3"),
              "/v1/mushrooms/amanita_muscaria:0.703,boletus_edulis:0.297/normal.jpg");
    EXPECT_EQ(canonical("amanita_muscaria:0.703,boletus_edulis:0.297"),
              "/v1/mushrooms/amanita_muscaria:0.703,boletus_edulis:0.297/normal.jpg");
    EXPECT_EQ(canonical("amanita_muscaria:0.996,boletus_edulis:0.004"),
              "/v1/mushrooms/amanita_muscaria/normal.jpg");
}

/// Images of a mix: those inside the file, those at the addresses that another file names, and those of another server.
TEST(SurfaceAddress, LinkedImagesOfAMixAreThoseEmbedded) {
    for (const std::string mix :
         {"amanita_muscaria:0.7,boletus_edulis:0.3", "coprinus_comatus:0.997,russula_vinosa:0.003",
          "cantharellus_cibarius:0.2,disciotis_venosa:0.3,mycena_sanguinolenta:0.5"}) {
        Service service(built_in_atlas(), ServiceOptions{}),
            other(built_in_atlas(), ServiceOptions{});
        const std::string address =
            "/v1/mushrooms/" + mix + ".glb?age=0.71&seed=3&lod=2&texture_size=256";
        for (const std::string formats : {"jpg", "webp", "webp_jpg"}) {
            const std::string embedded =
                test::text_of(handle(service, test::get(address + "&image_format=" + formats)));
            const Response linked =
                handle(service, test::get(address + "&textures=linked&image_format=" + formats));
            ASSERT_EQ(linked.status, 200) << test::text_of(linked);
            int found = 0;
            for (const std::string& image : test::linked_images(linked, address)) {
                const Response cached = handle(service, test::get(image));
                ASSERT_EQ(cached.status, 200) << image << test::text_of(cached);
                EXPECT_EQ(test::header(cached, "Cache-Status"), "sporeprint-images; hit") << image;
                EXPECT_EQ(test::header(cached, "Content-Location"), image);
                EXPECT_NE(embedded.find(test::text_of(cached)), std::string::npos) << image;
                const Response elsewhere = handle(other, test::get(image));
                EXPECT_EQ(test::text_of(elsewhere), test::text_of(cached));
                EXPECT_EQ(test::header(elsewhere, "ETag"), test::header(cached, "ETag"));
                ++found;
            }
            EXPECT_EQ(found, formats == "webp_jpg" ? 6 : 3);
        }
    }
}

TEST(SurfaceAddress, AgesComeInStepsOfASixtyFourth) {
    EXPECT_EQ(quantised_age(0.6), SurfaceAddress{}.age);
    EXPECT_EQ(quantised_age(0.0), 0.0);
    EXPECT_EQ(quantised_age(1.0), 1.0);
    for (int i = 0; i <= 64; ++i) EXPECT_EQ(quantised_age(i / 64.0), i / 64.0);
}

}  // namespace
}  // namespace sporeprint::api::products_surfaces_test
