#include "core/grow/offspring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/breed/outlines.h"
#include "core/breed/traits.h"
#include "core/grow/mushroom.h"
#include "core/mesh/measure.h"
#include "core/params/reader.h"
#include "tests/support/atlas.h"
#include "tests/support/effort.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"
#include "tests/support/refusals.h"

namespace sporeprint::grow_offspring_test {
namespace {

const Species& species_of(const char* id) { return atlas().find(id)->species; }

/// Returns a species without what every offspring has of its own.
Species without_names(Species species) {
    species.id = {};
    species.facts.common_name = {};
    species.facts.scientific_name = {};
    species.facts.sources = {};
    return species;
}

/// Returns a function that computes each correspondence once.
GetOrCompute<MorphSet> cached_in(std::map<std::string, std::shared_ptr<const MorphSet>>& sets) {
    return [&sets](const std::string& key,
                   const std::function<std::shared_ptr<const MorphSet>()>& make) {
        auto& set = sets[key];
        if (!set) set = make();
        return set;
    };
}

TEST(Offspring, OfOneParentAloneIsThatParent) {
    const auto& entries = atlas().entries();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Species &a = entries[i].species, &b = entries[(i + 1) % entries.size()].species;
        if (is_branched(a) != is_branched(b)) continue;
        for (const std::uint32_t seed : {1U, 7U}) {
            const BreedingParams first{.seed = seed, .share = 0.0, .mutation = 0.0},
                second{.seed = seed, .share = 1.0, .mutation = 0.0};
            EXPECT_EQ(without_names(offspring(a, b, first).species), without_names(a));
            EXPECT_EQ(without_names(offspring(a, b, second).species), without_names(b));
        }
    }
}

TEST(Offspring, OfASpeciesWithItselfIsThatSpecies) {
    for (const AtlasEntry& entry : atlas().entries()) {
        const Species child =
            offspring(entry.species, entry.species, {.share = 0.5, .mutation = 0.0}).species;
        EXPECT_EQ(without_names(child), without_names(entry.species)) << entry.species.id.string();
        EXPECT_EQ(child.facts.common_name, entry.species.facts.common_name);
    }
}

TEST(Offspring, IsTheSameForEqualParametersOnly) {
    const Species &a = species_of("amanita_muscaria"), &b = species_of("boletus_edulis");
    const BreedingParams params{.seed = 7};
    const Species child = offspring(a, b, params).species;
    EXPECT_EQ(offspring(a, b, params).species, child);
    EXPECT_NE(offspring(a, b, {.seed = 8}).species.id, child.id);
    EXPECT_NE(offspring(a, b, {.seed = 7, .mutation = 0.21}).species.id, child.id);
    EXPECT_EQ(child.facts.common_name.view(), "Fly agaric × Cep");
    Species nameless = a;
    nameless.facts.scientific_name = Text<64>();
    EXPECT_EQ(offspring(nameless, b, {}).species.facts.scientific_name.view(), "");
    EXPECT_EQ(child.facts.sources.front().view(),
              "Bred of amanita_muscaria and boletus_edulis: seed 7, share 0.5, mutation 0.2");
}

TEST(Offspring, HasAnIdThatNoEcologyChanges) {
    const Species &a = species_of("amanita_muscaria"), &b = species_of("boletus_edulis");
    Species elsewhere = a;
    elsewhere.ecology.genet.life = 7.0;
    const BreedingParams params{.seed = 7, .lock = {Text<64>("ecology")}};
    const Species child = offspring(a, b, params).species,
                  other = offspring(elsewhere, b, params).species;
    EXPECT_EQ(other.id, child.id) << "individuals draw by it";
    EXPECT_EQ(child.ecology, a.ecology);
    EXPECT_EQ(other.ecology, elsewhere.ecology);
}

TEST(Offspring, OfHybridsNamesOneOfEach) {
    const Species child =
        offspring(species_of("amanita_muscaria"), species_of("boletus_edulis"), {.seed = 7})
            .species;
    const Species grandchild = offspring(child, species_of("russula_emetica"), {.seed = 2}).species;
    EXPECT_EQ(grandchild.facts.scientific_name.view(), "Amanita muscaria × Russula emetica");
}

TEST(Offspring, HasSizesBetweenThoseOfItsParents) {
    const Species &small = species_of("mycena_sanguinolenta"),
                  &large = species_of("macrolepiota_procera");
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        const Species child = offspring(small, large, {.seed = seed, .mutation = 0.0}).species;
        EXPECT_GT(size_of(child), 1.5 * size_of(small));
        EXPECT_LT(size_of(child), size_of(large) / 1.5);
        // What comes from either is as large as the whole.
        for (const Stage& stage : child.stages) EXPECT_LT(stage.model.ring.width, size_of(child));
    }
}

TEST(Offspring, WithALockedPartDiffersInItAlone) {
    const Species &a = species_of("amanita_muscaria"), &b = species_of("lactarius_deliciosus");
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        const BreedingParams params{.seed = seed, .mutation = 0.4};
        Species free = without_names(offspring(a, b, params).species);
        for (const char* const part : {"surface.cap", "warts", "deformation"}) {
            BreedingParams locked = params;
            locked.lock = {Text<64>(std::string_view(part))};
            const Species child = without_names(offspring(a, b, locked).species);
            EXPECT_EQ(child.spread, free.spread);
            EXPECT_EQ(child.ground, free.ground);
            ASSERT_EQ(child.stages.size(), free.stages.size());
            for (std::size_t i = 0; i < child.stages.size(); ++i) {
                Model model = child.stages[i].model;
                visit_traits(
                    model, free.stages[i].model, free.stages[i].model, "",
                    [&](const auto& own, const auto& other, const auto&, const std::string& path) {
                        const bool is_free =
                            path != part && path != "ornaments." + std::string(part);
                        EXPECT_TRUE(own == other || !is_free) << path << seed;
                    });
            }
        }
    }
}

TEST(Offspring, RefusesUnknownPartsAndTwoFamilies) {
    const Species &a = species_of("amanita_muscaria"), &b = species_of("ramaria_formosa");
    BreedingParams params;
    params.lock = {Text<64>("surface.cap"), Text<64>("surfce.cap"), Text<64>("limbs")};
    const auto problems = refusal([&] { static_cast<void>(offspring(a, a, params)); });
    EXPECT_TRUE(names(problems, "/lock/1", "did you mean 'surface.cap'?"));
    EXPECT_TRUE(names(problems, "/lock/2", "no part"));
    EXPECT_EQ(problems.size(), 2U);
    EXPECT_TRUE(names(refusal([&] { static_cast<void>(offspring(a, b, {})); }), "b", "one family"));
    EXPECT_TRUE(names(refusal([&] { static_cast<void>(offspring(a, a, {.share = 1.5})); }),
                      "/share", "0..1"));
}

TEST(Offspring, IsValidAndItsOutlinesAreProven) {
    const auto& entries = atlas().entries();
    std::map<std::string, std::shared_ptr<const MorphSet>> sets;
    const auto morphs = cached_in(sets);
    const std::size_t count = effort(10'000, 300);
    std::size_t whole = 0, swept = 0;
    for (std::uint32_t seed = 0; seed < count; ++seed) {
        Random random(seed, purposes::crossing, 1);
        const auto any = [&] { return random.bits() % entries.size(); };
        const Species& a = entries[any()].species;
        const Species& other = entries[any()].species;
        // Crossings cost most, by the correspondence of each pair.
        const Species& b = seed % 5 != 0 || is_branched(a) != is_branched(other) ? a : other;
        const double share = random.uniform(), mutation = random.uniform();
        const Offspring child =
            offspring(a, b, {.seed = seed, .share = share, .mutation = mutation}, morphs);
        if (seed % 5 == 0) {
            std::vector<Problem> problems;
            EXPECT_EQ(read_json<Species>(dump(write(child.species)), problems), child.species);
            EXPECT_TRUE(problems.empty()) << seed << problems.front().path;
        }
        if (is_branched(a)) continue;
        ++swept;
        EXPECT_TRUE(child.certificate.simple) << seed;
        whole += child.mutation == 1.0 ? 1 : 0;
        if (sets.size() > 200) sets.clear();
    }
    // The proof may not leave most of what was drawn out.
    EXPECT_GT(whole, swept / 2);
}

TEST(Offspring, GrowsAtEveryAgeWithoutDefects) {
    const auto& entries = atlas().entries();
    const std::size_t count = effort(120, 12);
    for (std::uint32_t seed = 0; seed < count; ++seed) {
        Random random(seed, purposes::crossing, 2);
        const auto any = [&] { return random.bits() % entries.size(); };
        const Species& a = entries[any()].species;
        const Species& other = entries[any()].species;
        const Species& b = is_branched(a) == is_branched(other) ? other : a;
        const Species child = offspring(a, b, {.seed = seed, .mutation = random.uniform()}).species;
        const Atlas own({.species = {dump(write(child))}});
        for (const double age : {0.0, 0.3, 0.6, 1.0}) {
            MushroomSpec spec;
            spec.mix = {{child.id.string(), 1000}};
            spec.params.seed = seed;
            spec.params.age = age;
            spec.params.lod = 2;
            spec.params.textures = Textures::none;
            const Mesh mesh = mushroom_mesh(spec, resolve(spec, own));
            EXPECT_TRUE(defects(mesh).empty())
                << a.id.string() << ' ' << b.id.string() << seed << ' ' << age;
        }
    }
}

}  // namespace
}  // namespace sporeprint::grow_offspring_test
