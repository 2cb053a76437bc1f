// Sets of mushrooms: many individuals of several species at several levels of detail, chosen to fit
// into a budget of bytes and draw calls.
#pragma once

#include <cstdint>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/product.h"
#include "core/individual/mushroom_spec.h"
#include "core/surface/image_tiles.h"

namespace sporeprint {

/// Largest number of species or mixes of a set, and of its files.
inline constexpr std::size_t most_set_species = 64, most_set_files = 1024;

/// Which individuals of a file share one atlas of tiles, and with it a material.
enum class AtlasShare { none, species, set };

constexpr const char* name(AtlasShare share) {
    switch (share) {
        case AtlasShare::none:
            return "none";
        case AtlasShare::species:
            return "species";
        case AtlasShare::set:
            return "set";
    }
    return nullptr;
}

/// The parameters of a set beside its species and those of the mushrooms themselves.
struct SetParams {
    std::vector<double> ages = {0.6};
    int seeds = 1;
    std::uint32_t first_seed = 1;
    std::vector<int> levels = {0, 1, 2, 3};
    int individuals = 0;
    int draw_calls = 0;
    double megabytes = 0.0;
    AtlasShare atlas = AtlasShare::none;

    static constexpr void fields(auto visit) {
        using P = SetParams;
        visit(&P::ages, Info{.name = "ages",
                             .min = 0,
                             .max = 1,
                             .most = 16,
                             .doc = "The ages at which each species grows."});
        visit(
            &P::seeds,
            Info{.name = "seeds",
                 .min = 1,
                 .max = 64,
                 .doc = "Different individuals of each species and age; with a budget, at most."});
        visit(&P::first_seed, Info{.name = "first_seed",
                                   .min = 0,
                                   .max = 4294967231.0,
                                   .doc = "The seed of the first of them; the others follow."});
        visit(&P::levels, Info{.name = "levels",
                               .min = 0,
                               .max = 3,
                               .most = 4,
                               .doc = "The levels of detail of each individual, one file each."});
        visit(&P::individuals,
              Info{.name = "individuals",
                   .min = 0,
                   .max = 100000,
                   .doc = "Mushrooms that the scene shows, distributed over the different ones as "
                          "instances; 0: each once."});
        visit(&P::draw_calls,
              Info{.name = "draw_calls",
                   .min = 0,
                   .max = 100000,
                   .doc = "Most draw calls in view: one for each different individual and level, "
                          "drawn as instances; 0 for any number. Lowers seeds. With an atlas one "
                          "for each material, drawn as a batch, whatever the seeds."});
        visit(&P::megabytes,
              Info{.name = "megabytes",
                   .unit = "MB",
                   .min = 0,
                   .max = 4000,
                   .doc = "Most bytes of all files, estimated; 0 for any number. Lowers "
                          "texture_size, then seeds."});
        visit(&P::atlas,
              Info{.name = "atlas",
                   .doc = "Images as tiles of one atlas, in a file of all individuals: one "
                          "material for each species or for the whole set, which a client draws in "
                          "one call. At most 16 different images each, those of species times ages "
                          "times seeds, or with share=species of species times ages; texture_size "
                          "is the side of a tile, and a side of the atlas is at most 4096 "
                          "texels."});
    }
    void check(const std::string& path, std::vector<Problem>& problems) const;
    bool operator==(const SetParams&) const = default;
};

/// Whether each level of each individual is a file of its own.
enum class SetPacking { files, one_file };

/// The request for a set.
struct SetSpec {
    std::vector<Mix> species;  ///< different, at least one
    SetParams params;
    MushroomParams mushroom;  ///< what all have in common; its seed, age and lod are not used
    SetPacking packing = SetPacking::files;
};

/// One different individual of a set.
struct SetIndividual {
    std::size_t species = 0;      ///< index into SetSpec::species
    MushroomParams params;        ///< of its first level
    std::uint64_t shown = 1;      ///< instances that the scene shows
    std::vector<Estimate> files;  ///< of each level, in the order of SetParams::levels
};

/// The individuals of a set that fit into its budget.
struct SetPlan {
    int seeds = 1;         ///< individuals of each species and age
    int texture_size = 0;  ///< of every file
    std::vector<SetIndividual> individuals;

    /// Returns the sum of the estimates of all files.
    [[nodiscard]] Estimate total() const;
};

/// Returns the number of files of a set before any budget lowers it.
[[nodiscard]] std::uint64_t most_files(const SetSpec& spec);

/// Returns the spec of one file of a set.
///
/// level  index into SetParams::levels
[[nodiscard]] MushroomSpec file_spec(const SetSpec& spec, const SetIndividual& individual,
                                     std::size_t level);

/// Returns the textures with which a level of an individual counts in estimates: those of the
/// request in files of their own; in one file images count once, for the first level of the first
/// individual that has them, and all others are as large as with linked ones.
///
/// seed   index of its seed, from 0
/// level  index into SetParams::levels
[[nodiscard]] Textures counted_textures(const SetSpec& spec, int seed, std::size_t level);

/// Returns the number of atlases of one file of a set, and of tiles of each, for as many seeds as
/// requested.
[[nodiscard]] std::size_t atlases_of(const SetSpec& spec);
[[nodiscard]] std::size_t tiles_of_atlas(const SetSpec& spec);

/// Throws Impossible for an atlas that a set cannot have: (path "/atlas") of more tiles than
/// most_tiles, or without embedded images, or in files of their own; (path "/texture_size") larger
/// than largest_tiled_side.
void refuse_impossible_atlas(const SetSpec& spec);

/// Returns the individuals of a set: all combinations of species, ages and seeds, in this order,
/// with as many seeds and as large images as the budget allows.
///
/// throws  InvalidInput and Impossible as resolve(); Impossible as refuse_impossible_atlas(), and
///         (paths "/draw_calls" and "/megabytes", with the least that is needed) for a budget that
///         not even one individual of each species and age with the smallest images fits into;
///         Cancelled
/// cost    one resolve() for each individual
[[nodiscard]] SetPlan planned_set(const SetSpec& spec, const Atlas& atlas,
                                  const ExecutionContext& execution);

}  // namespace sporeprint
