#include "api/library/species_text.h"

#include <gtest/gtest.h>

#include "api/library/tokens.h"
#include "core/atlas/atlas.h"
#include "core/params/reader.h"
#include "core/surface/codecs.h"

namespace sporeprint::api::library_species_text_test {
namespace {

Species with_images() {
    Species species = built_in_atlas()->find("boletus_edulis")->species;
    const std::vector<std::uint8_t> grey(std::size_t{8} * 8 * 3, 120),
        red(std::size_t{8} * 8 * 3, 200);
    for (Stage& stage : species.stages) {
        for (auto [upload, pixels] : {std::pair(&stage.model.surface.cap.image, &grey),
                                      std::pair(&stage.model.surface.stem.image, &red)}) {
            upload->bytes = jpeg(*pixels, 8, 8, 90, Chroma::full);
            upload->sha256 =
                Text<64>(std::string_view(sha256_hex(upload->bytes.data(), upload->bytes.size())));
        }
    }
    return species;
}

TEST(SpeciesText, EveryBuiltInSpeciesReadsBack) {
    const std::shared_ptr<const Atlas> atlas = built_in_atlas();
    for (const AtlasEntry& entry : atlas->entries()) {
        const Content content = content_of(entry.species);
        EXPECT_EQ(species_of(content), entry.species) << entry.species.id.view();
        EXPECT_EQ(content.hash, sha256_of(content.text));
        EXPECT_EQ(content.hash, content_of(species_of(content)).hash) << "the text is canonical";
        EXPECT_EQ(content.title, entry.species.facts.common_name.view());
        EXPECT_TRUE(content.blobs.empty());
    }
}

TEST(SpeciesText, ImagesAreStoredBesideTheText) {
    const Species species = with_images();
    const Content content = content_of(species);
    EXPECT_EQ(content.blobs.size(), 2 * species.stages.size());
    for (const Blob& blob : content.blobs) {
        EXPECT_EQ(blob.media, "image/jpeg");
        EXPECT_NE(content.text.find("{\"sha256\":\"" + hex_of(blob.sha256) + "\"}"),
                  std::string::npos);
        EXPECT_TRUE(blob.place.starts_with("/stages/")) << blob.place;
    }
    EXPECT_LT(content.text.size(), dump(write(species)).size());
    EXPECT_EQ(species_of(content), species);
    EXPECT_EQ(json_of(content), write(species));
}

TEST(SpeciesText, OfTheFirstFormatHasTheDefaultEcology) {
    const std::shared_ptr<const Atlas> atlas = built_in_atlas();
    const Species& species = atlas->find("boletus_edulis")->species;
    Content old = content_of(species);
    std::vector<Problem> problems;
    Value json = parse(old.text, problems);
    json.erase("ecology");
    old.text = dump(json);
    old.format = 1;
    Species expected = species;
    expected.ecology = {};
    EXPECT_EQ(species_of(old), expected);
    // Mushrooms of what was published before have the addresses that they had.
    EXPECT_EQ(atlas_entry(species_of(old)).hash, atlas_entry(species).hash);
}

TEST(SpeciesText, WhatCannotBeReadIsAnErrorOfTheDatabase) {
    Content content = content_of(built_in_atlas()->find("boletus_edulis")->species);
    content.format = species_format + 1;
    EXPECT_THROW(species_of(content), GenerationError);
    content.format = species_format;
    content.text = "{\"id\":";
    EXPECT_THROW(species_of(content), GenerationError);
    content.text = "{\"id\":7}";
    EXPECT_THROW(species_of(content), GenerationError);
    Content without_image = content_of(with_images());
    without_image.blobs.clear();
    EXPECT_THROW(species_of(without_image), GenerationError);
}

TEST(SpeciesText, DeceptiveTextsAreNamed) {
    const auto problems_of = [](const char* text) {
        std::vector<Problem> problems;
        refuse_deceptive_texts(
            Value::object().set("facts", Value::object().set("common_name", text)), "", problems);
        return problems;
    };
    EXPECT_TRUE(
        problems_of("Steinpilz, c\xC3\xA8pe \xF0\x9F\x8D\x84 \xE3\x83\x9D\xE3\x83\xAB").empty());
    ASSERT_EQ(problems_of("a\xE2\x80\xAEgpj.exe").size(), 1U) << "right-to-left override";
    EXPECT_EQ(problems_of("a\xE2\x80\xAEgpj.exe")[0].path, "/facts/common_name");
    EXPECT_NE(problems_of("a\xE2\x80\xAEgpj.exe")[0].message.find("U+202E"), std::string::npos);
    EXPECT_EQ(problems_of("two\nlines").size(), 1U);
    EXPECT_EQ(problems_of("\xC2\x85").size(), 1U);
    EXPECT_EQ(problems_of("\xE2\x81\xA6").size(), 1U);
}

TEST(SpeciesText, TextsAreComposed) {
    EXPECT_EQ(composed("C\xC3\xA8pe"), "C\xC3\xA8pe");
    EXPECT_EQ(composed("Ce\xCC\x80pe"), "C\xC3\xA8pe") << "e and a combining grave accent";
    EXPECT_EQ(composed("\xE1\x84\x80\xE1\x85\xA1"), "\xEA\xB0\x80") << "jamo of a Hangul syllable";
    EXPECT_EQ(composed("\xEF\xAC\x81"), "\xEF\xAC\x81") << "ligatures are other letters";
    EXPECT_EQ(composed(""), "");
    Value json = Value::object().set("a", Value(Value::Array{Value("e\xCC\x80"), Value(7)}));
    compose_texts(json);
    EXPECT_EQ(dump(json), "{\"a\":[\"\xC3\xA8\",7]}");
}

TEST(SpeciesText, DifferencesArePointersOfTheSmallestParts) {
    Species species = built_in_atlas()->find("boletus_edulis")->species;
    const Value before = write(species);
    EXPECT_TRUE(differences(before, before, 10).empty());
    species.facts.common_name = Text<64>("Another");
    species.stages[1].age += 0.001;
    EXPECT_EQ(differences(before, write(species), 10),
              (std::vector<std::string>{"/facts/common_name", "/stages/1/age"}));
    species.stages.pop_back();
    EXPECT_EQ(differences(before, write(species), 10),
              (std::vector<std::string>{"/facts/common_name", "/stages"}));
    EXPECT_EQ(differences(before, write(species), 1).size(), 1U);
}

}  // namespace
}  // namespace sporeprint::api::library_species_text_test
