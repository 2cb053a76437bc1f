#include "core/grow/impostor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "core/grow/colony.h"
#include "core/grow/colony_estimate.h"
#include "core/grow/colony_individuals.h"
#include "core/grow/leaf.h"
#include "core/grow/mushroom.h"
#include "core/grow/tree.h"
#include "core/impostor/cards.h"
#include "core/impostor/frames.h"
#include "core/params/value.h"
#include "tests/support/glb_reader.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::grow_impostor_test {
namespace {

/// One product of each kind that has an impostor, with small images.
struct Products {
    MushroomSpec mushroom;
    ColonySpec colony;
    TreeSpec tree{"shrub", params_of(*atlas().find_tree("shrub"))};

    Products(int lod, FileOptions file) {
        if (!atlas().find_tree("shrub")) ADD_FAILURE() << "no such tree";
        mushroom.mix = {{"amanita_muscaria", 1000}};
        colony.mix = {{"hypholoma_fasciculare", 1000}};
        colony.params.count = 4;
        colony.params.distinct = 2;
        const auto set = [&](auto& params) {
            params.lod = lod;
            params.file = file;
            params.texture_size.value = 128;
        };
        set(mushroom.params);
        set(colony.params);
        set(tree.params);
    }

    [[nodiscard]] std::vector<Grown> grown() const {
        std::vector<Grown> all;
        all.push_back(grow_mushroom(mushroom, atlas()));
        all.push_back(grow_colony(colony, atlas()));
        all.push_back(grow_tree(tree, atlas()));
        return all;
    }

    [[nodiscard]] std::vector<Estimate> estimates() const {
        return {estimate(mushroom, atlas()),
                estimate(colony, typical_individual(colony, atlas()), atlas()), estimate(tree)};
    }
};

FileOptions file_of(ImageFormats format, Lods lods = Lods::single) {
    FileOptions file;
    file.image_format = format;
    file.lods = lods;
    file.impostor = lods != Lods::single;
    return file;
}

const Value& at(const Value& json, const std::string& pointer) {
    static const Value nothing;
    const Value* found = json.at_pointer(pointer);
    EXPECT_NE(found, nullptr) << pointer;
    return found ? *found : nothing;
}

TEST(Impostor, IsOneMeshWithOneMaskedMaterialAndThreeImages) {
    for (const ImageFormats format : {ImageFormats::jpg, ImageFormats::webp})
        for (const Grown& file : Products(impostor_lod, file_of(format)).grown()) {
            const Value json = json_chunk(joined(file.glb));
            EXPECT_EQ(file.triangles, card_triangles);
            EXPECT_EQ(file.vertices, card_vertices);
            EXPECT_EQ(at(json, "/meshes").items().size(), 1u);
            EXPECT_EQ(at(json, "/materials").items().size(), 1u);
            EXPECT_EQ(at(json, "/materials/0/alphaMode").as_string(), "MASK");
            const double cutoff = at(json, "/materials/0/alphaCutoff").as_number();
            EXPECT_GE(cutoff, 0.25);
            EXPECT_LE(cutoff, 0.5);
            EXPECT_TRUE(at(json, "/materials/0/name").as_string().ends_with("_impostor"));
            EXPECT_EQ(at(json, "/images").items().size(), 3u);
            EXPECT_EQ(at(json, "/images/0/mimeType").as_string(),
                      format == ImageFormats::jpg ? "image/png" : "image/webp");
            EXPECT_EQ(at(json, "/images/1/mimeType").as_string(),
                      format == ImageFormats::jpg ? "image/jpeg" : "image/webp");
            EXPECT_NE(at(json, "/meshes/0/name").as_string().find("_LOD4"), std::string::npos);
            EXPECT_EQ(at(json, "/asset/extras/triangles").as_number(), 12.0);
            EXPECT_EQ(at(json, "/asset/extras/effective/lod").as_number(), 4.0);
        }
}

TEST(Impostor, StatesWhereItsFramesAre) {
    for (const Grown& file : Products(impostor_lod, file_of(ImageFormats::webp)).grown()) {
        const Value json = json_chunk(joined(file.glb));
        const Value& impostor = at(json, "/materials/0/extras/impostor");
        EXPECT_EQ(at(impostor, "/mapping").as_string(), "hemi_octahedral");
        EXPECT_EQ(at(impostor, "/grid").as_number(), frame_grid);
        EXPECT_EQ(at(impostor, "/frame_texels").as_number(), 32.0);
        EXPECT_EQ(at(impostor, "/side_texels").as_number(), 256.0);
        double reach = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::string of = std::to_string(axis);
            const double low = at(json, "/asset/extras/bounds_m/min/" + of).as_number(),
                         high = at(json, "/asset/extras/bounds_m/max/" + of).as_number();
            EXPECT_NEAR(at(impostor, "/centre_m/" + of).as_number(), 0.5 * (low + high), 1e-3);
            reach += 0.25 * (high - low) * (high - low);
        }
        const double radius = at(impostor, "/radius_m").as_number();
        EXPECT_LE(radius, 1.1 * std::sqrt(reach));
        EXPECT_GE(radius, 0.5 * std::sqrt(reach));
        EXPECT_NEAR(at(impostor, "/texel_m").as_number(), 2.0 * radius / 32.0, 1e-6);
        EXPECT_GT(at(impostor, "/normal_length").as_number(), 0.5);
        EXPECT_LE(at(impostor, "/normal_length").as_number(), 1.0);
    }
}

TEST(Impostor, EndsAChainAndIsThatOfItsOwnFile) {
    for (const Lods lods : {Lods::nodes, Lods::msft}) {
        const std::vector<Grown> chains = Products(2, file_of(ImageFormats::webp, lods)).grown(),
                                 alone =
                                     Products(impostor_lod, file_of(ImageFormats::webp)).grown();
        for (std::size_t i = 0; i < chains.size(); ++i) {
            const Value json = json_chunk(joined(chains[i].glb));
            const auto& levels = at(json, "/asset/extras/levels").items();
            ASSERT_EQ(levels.size(), 3u);
            EXPECT_EQ(at(levels[2], "/lod").as_number(), 4.0);
            EXPECT_EQ(at(levels[2], "/triangles").as_number(), 12.0);
            for (std::size_t k = 1; k < levels.size(); ++k)
                EXPECT_LE(at(levels[k], "/screen_coverage").as_number(),
                          at(levels[k - 1], "/screen_coverage").as_number());
            // The images of an impostor are the last three slices that are no padding.
            const auto images = [](const Grown& file) {
                std::vector<Slice> found;
                for (const Slice& slice : file.glb)
                    if (slice.size > 12 && std::memcmp(slice.data() + 8, "WEBP", 4) == 0)
                        found.push_back(slice);
                return std::vector<Slice>(found.end() - 3, found.end());
            };
            const std::vector<Slice> one = images(chains[i]), other = images(alone[i]);
            for (std::size_t k = 0; k < 3; ++k) {
                ASSERT_EQ(one[k].size, other[k].size);
                EXPECT_EQ(std::memcmp(one[k].data(), other[k].data(), one[k].size), 0);
            }
            const auto& materials = at(json, "/materials").items();
            EXPECT_TRUE(at(materials.back(), "/name").as_string().ends_with("_impostor"));
            if (lods != Lods::msft) continue;
            const auto root = static_cast<std::size_t>(at(json, "/scenes/0/nodes/0").as_number());
            const Value& first = at(json, "/nodes/" + std::to_string(root));
            EXPECT_EQ(at(first, "/extensions/MSFT_lod/ids").items().size(), 2u);
            EXPECT_EQ(at(first, "/extras/MSFT_screencoverage").items().size(), 3u);
        }
    }
}

TEST(Impostor, EndsAChainOfInstancedLeavesAndOfTheLastLevel) {
    Products products(last_lod, file_of(ImageFormats::webp, Lods::msft));
    products.tree.params.instancing = LeafInstancing::gpu;
    for (const Grown& file : products.grown()) {
        const Value json = json_chunk(joined(file.glb));
        EXPECT_EQ(at(json, "/asset/extras/levels").items().size(), 2u);
    }
}

TEST(Impostor, IsEstimated) {
    for (const ImageFormats format :
         {ImageFormats::jpg, ImageFormats::webp, ImageFormats::webp_jpg}) {
        const Products products(impostor_lod, file_of(format));
        const std::vector<Grown> files = products.grown();
        const std::vector<Estimate> estimates = products.estimates();
        for (std::size_t i = 0; i < files.size(); ++i) {
            EXPECT_EQ(estimates[i].vertices, card_vertices);
            EXPECT_EQ(estimates[i].triangles, card_triangles);
            EXPECT_EQ(estimates[i].impostor_texels, 3u * 256u * 256u);
            const auto bytes = static_cast<double>(size_of(files[i].glb));
            EXPECT_GT(1.3 * static_cast<double>(estimates[i].bytes), bytes);
            EXPECT_LT(static_cast<double>(estimates[i].bytes), 3.0 * bytes);
        }
    }
}

TEST(Impostor, SwaysFromTheGroundUp) {
    FileOptions file = file_of(ImageFormats::webp);
    file.wind = WindFormat::attribute;
    for (const Grown& grown : Products(impostor_lod, file).grown()) {
        const Value json = json_chunk(joined(grown.glb));
        EXPECT_GT(at(json, "/asset/extras/wind/sway_m").as_number(), 0.0);
        EXPECT_NE(json.at_pointer("/meshes/0/primitives/0/attributes/_WIND"), nullptr);
    }
    Impostor impostor;
    impostor.box.max = glm::vec3(1.0F, 2.0F, 1.0F);
    impostor.cards.positions = {glm::vec3(0.0F), glm::vec3(0.0F, 1.0F, 0.0F),
                                glm::vec3(0.0F, 2.0F, 0.0F)};
    add_sway(impostor, {WindFormat::attribute, 0.5, 0.0});
    EXPECT_EQ(impostor.cards.sway[0].bend, 0.0F);
    EXPECT_NEAR(impostor.cards.sway[1].bend, 0.3125F, 1e-6F);
    EXPECT_EQ(impostor.cards.sway[2].bend, 1.0F);
    add_sway(impostor, {WindFormat::attribute, 0.0, 0.0});
    EXPECT_EQ(impostor.cards.sway[2].bend, 0.0F) << "what grows from a wall stands still";
}

TEST(Impostor, KeepsTheSolidsOfCollision) {
    FileOptions file = file_of(ImageFormats::webp);
    file.collision = CollisionFormat::omi;
    for (const Grown& grown : Products(impostor_lod, file).grown()) {
        const Value json = json_chunk(joined(grown.glb));
        EXPECT_GE(at(json, "/extensions/OMI_physics_shape/shapes").items().size(), 1u);
    }
}

TEST(Impostor, RefusesWhatItCannotHaveByName) {
    for (const Textures textures : {Textures::linked, Textures::external, Textures::none})
        for (const bool is_chain : {false, true}) {
            Products products(is_chain ? 2 : impostor_lod,
                              file_of(ImageFormats::jpg, is_chain ? Lods::msft : Lods::single));
            products.mushroom.params.textures = products.colony.params.textures =
                products.tree.params.textures = textures;
            for (const auto& grow : std::vector<std::function<void()>>{
                     [&] { (void)grow_mushroom(products.mushroom, atlas()); },
                     [&] { (void)grow_colony(products.colony, atlas()); },
                     [&] { (void)grow_tree(products.tree, atlas()); },
                     [&] { (void)estimate(products.mushroom, atlas()); },
                     [&] { (void)estimate(products.tree); }})
                EXPECT_TRUE(names(refusal(grow), "/textures", name(textures)));
        }
    MushroomSpec growing = Products(impostor_lod, {}).mushroom;
    growing.params.animation = Animation::growth;
    EXPECT_TRUE(names(refusal([&] { (void)grow_mushroom(growing, atlas()); }), "/animation"));
    MushroomSpec varied = Products(impostor_lod, {}).mushroom;
    varied.params.variants = Variants::weather;
    EXPECT_TRUE(names(refusal([&] { (void)grow_mushroom(varied, atlas()); }), "/variants"));
    LeafSpec leaf{"maple", params_of(*atlas().find_leaf("maple"))};
    leaf.params.file = file_of(ImageFormats::jpg, Lods::msft);
    EXPECT_TRUE(names(refusal([&] { (void)grow_leaf(leaf, atlas()); }), "/impostor", "leaf"));
    leaf.params.file = {};
    leaf.params.lod = impostor_lod;
    EXPECT_TRUE(names(refusal([&] { (void)grow_leaf(leaf, atlas()); }), "/lod"));
    FileOptions single;
    single.impostor = true;
    std::vector<Problem> problems;
    single.check("", problems);
    EXPECT_TRUE(names(problems, "/impostor", "lods=msft"));
}

TEST(Impostor, FramesFollowTheSizeOfImages) {
    EXPECT_EQ(frame_side_of({128}), 32);
    EXPECT_EQ(frame_side_of({512}), 32);
    EXPECT_EQ(frame_side_of({1024}), 48);
    EXPECT_EQ(frame_side_of({2048}), 96);
}

}  // namespace
}  // namespace sporeprint::grow_impostor_test
