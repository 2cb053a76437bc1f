#include "core/grow/set.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/grow/mushroom.h"
#include "core/params/messages.h"

namespace sporeprint {

static_assert(well_described<SetParams>());

namespace {

constexpr double bytes_of_megabyte = 1e6;

template <class T>
void refuse_repetitions(const std::vector<T>& values, const std::string& path,
                        std::vector<Problem>& problems) {
    if (values.empty()) report(problems, path, "is empty; give at least one");
    std::set<T> seen;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!seen.insert(values[i]).second)
            report(problems, path + '/' + std::to_string(i),
                   number_text(static_cast<double>(values[i])) + " is given more than once");
}

/// Returns the number of seeds that the limits of draw calls and of individuals allow.
int most_seeds(const SetSpec& spec) {
    const SetParams& params = spec.params;
    const std::size_t combinations = spec.species.size() * params.ages.size();
    auto seeds = static_cast<std::size_t>(params.seeds);
    if (params.individuals > 0)
        seeds = std::min(
            seeds,
            std::max<std::size_t>(1, static_cast<std::size_t>(params.individuals) / combinations));
    const auto draw_calls = static_cast<std::size_t>(params.draw_calls);
    if (draw_calls > 0 && params.atlas != AtlasShare::none) {
        if (const std::size_t needed = atlases_of(spec); draw_calls < needed)
            throw Impossible("/draw_calls", "the atlases of all species need " +
                                                std::to_string(needed) +
                                                " draw calls; ask for atlas=set");
    } else if (draw_calls > 0) {
        const std::size_t of_one_seed = combinations * params.levels.size();
        seeds = std::min(seeds, draw_calls / of_one_seed);
        if (seeds == 0)
            throw Impossible("/draw_calls", "one individual of each species and age needs " +
                                                std::to_string(of_one_seed) +
                                                " draw calls, one for each level");
    }
    return static_cast<int>(seeds);
}

/// Returns the sides of atlases that a set may use, from the requested one down.
std::vector<int> texture_sizes(const MushroomParams& mushroom) {
    std::vector<int> sizes;
    for (const int side : TextureSize::values)
        if (side <= mushroom.texture_size.value) sizes.push_back(side);
    std::reverse(sizes.begin(), sizes.end());
    if (mushroom.textures != Textures::embedded) sizes.resize(1);
    return sizes;
}

/// Distributes the individuals that a scene shows over the different ones, as evenly as possible.
void distribute(int shown, std::vector<SetIndividual>& individuals) {
    const auto count = static_cast<std::uint64_t>(shown), all = individuals.size();
    if (count == 0) return;
    for (std::uint64_t i = 0; i < all; ++i)
        individuals[i].shown = count / all + (i < count % all ? 1 : 0);
}

/// Returns the number of different images of a set.
std::size_t images_of(const SetSpec& spec) {
    const bool by_seed = spec.mushroom.share == ImageShare::individual;
    return spec.species.size() * spec.params.ages.size() *
           (by_seed ? static_cast<std::size_t>(spec.params.seeds) : 1);
}

std::uint64_t bytes_of(const std::vector<SetIndividual>& individuals) {
    std::uint64_t bytes = 0;
    for (const SetIndividual& one : individuals)
        for (const Estimate& file : one.files) bytes += file.bytes;
    return bytes;
}

/// Returns the texels of the images of an atlas.
///
/// side  of the images at LOD 0
std::uint64_t atlas_texels(const SetSpec& spec, int side) {
    const std::size_t tiles = tiles_of_atlas(spec);
    if (tiles == 0) return 0;
    const auto side_of_tile = static_cast<std::uint64_t>(side >> spec.params.levels.front());
    return 3 * grid_of(tiles).size() * side_of_tile * side_of_tile;
}

}  // namespace

void SetParams::check(const std::string& path, std::vector<Problem>& problems) const {
    refuse_repetitions(ages, path + "/ages", problems);
    refuse_repetitions(levels, path + "/levels", problems);
}

Estimate SetPlan::total() const {
    Estimate sum;
    for (const SetIndividual& one : individuals)
        for (const Estimate& file : one.files) {
            sum.vertices += file.vertices;
            sum.triangles += file.triangles;
            sum.texels += file.texels;
            sum.bytes += file.bytes;
        }
    return sum;
}

std::uint64_t most_files(const SetSpec& spec) {
    return spec.species.size() * spec.params.ages.size() * spec.params.levels.size() *
           static_cast<std::uint64_t>(spec.params.seeds);
}

MushroomSpec file_spec(const SetSpec& spec, const SetIndividual& individual, std::size_t level) {
    MushroomSpec one;
    one.mix = spec.species[individual.species];
    one.params = individual.params;
    one.params.lod = spec.params.levels[level];
    one.params.triangles.reset();
    // The levels of one file are those of the set.
    if (spec.packing == SetPacking::one_file) {
        one.params.file.lods = Lods::single;
        one.params.substrate = Substrate::none;
    }
    return one;
}

Textures counted_textures(const SetSpec& spec, int seed, std::size_t level) {
    const Textures textures = spec.mushroom.textures;
    if (spec.packing == SetPacking::files || textures != Textures::embedded) return textures;
    const bool is_first =
        level == 0 && (seed == 0 || spec.mushroom.share == ImageShare::individual);
    return is_first ? textures : Textures::linked;
}

std::size_t atlases_of(const SetSpec& spec) {
    switch (spec.params.atlas) {
        case AtlasShare::none:
            break;
        case AtlasShare::species:
            return spec.species.size();
        case AtlasShare::set:
            return 1;
    }
    return 0;
}

std::size_t tiles_of_atlas(const SetSpec& spec) {
    const std::size_t atlases = atlases_of(spec);
    return atlases == 0 ? 0 : images_of(spec) / atlases;
}

void refuse_impossible_atlas(const SetSpec& spec) {
    const AtlasShare atlas = spec.params.atlas;
    if (atlas == AtlasShare::none) return;
    const std::string value = std::string("'") + name(atlas) + "' ";
    if (spec.packing == SetPacking::files)
        throw Impossible("/atlas", value +
                                       "is impossible for files of their own; ask for one file "
                                       "(sets.glb), or for none");
    if (spec.mushroom.textures != Textures::embedded)
        throw Impossible("/atlas", value +
                                       "needs images in the file; ask for textures=embedded, or "
                                       "for none");
    const std::size_t tiles = tiles_of_atlas(spec);
    if (tiles > most_tiles) {
        const bool by_seed = spec.mushroom.share == ImageShare::individual && spec.params.seeds > 1;
        throw Impossible(
            "/atlas",
            value + "would have " + std::to_string(tiles) +
                " different images in one atlas; at most " + std::to_string(most_tiles) +
                " are possible. Ask for " +
                (by_seed ? "share=species, or for fewer seeds or " : "fewer ") +
                (atlas == AtlasShare::set ? "ages or species, or for atlas=species" : "ages"));
    }
    const TileGrid grid = grid_of(tiles);
    const int side = spec.mushroom.texture_size.value >> spec.params.levels.front();
    if (const int longest = std::max(grid.columns, grid.rows) * side; longest > largest_tiled_side)
        throw Impossible("/texture_size",
                         std::to_string(tiles) + " tiles of " + std::to_string(side) +
                             " texels would be an atlas of " + std::to_string(longest) +
                             " texels a side; at most " + std::to_string(largest_tiled_side) +
                             " are possible. Lower texture_size, or raise the first of levels");
}

SetPlan planned_set(const SetSpec& spec, const Atlas& atlas, const ExecutionContext& execution) {
    const SetParams& params = spec.params;
    refuse_impossible_atlas(spec);
    SetPlan plan;
    plan.seeds = most_seeds(spec);
    const std::vector<int> sizes = texture_sizes(spec.mushroom);

    // The individuals by seed, species and age, with their estimates by size of images: those of
    // fewer seeds are the first ones.
    struct Candidate {
        SetIndividual individual;
        std::vector<std::vector<Estimate>> by_size;
    };
    std::vector<std::vector<Candidate>> by_seed;
    for (int seed = 0; seed < plan.seeds; ++seed) {
        std::vector<Candidate>& row = by_seed.emplace_back();
        for (std::size_t species = 0; species < spec.species.size(); ++species)
            for (const double age : params.ages) {
                throw_if_cancelled(execution);
                Candidate one;
                one.individual.species = species;
                one.individual.params = spec.mushroom;
                one.individual.params.seed = params.first_seed + static_cast<std::uint32_t>(seed);
                one.individual.params.age = age;
                const Individual resolved =
                    resolve(file_spec(spec, one.individual, 0), atlas, execution.caches.morphs);
                for (const int side : sizes) {
                    std::vector<Estimate>& files = one.by_size.emplace_back();
                    one.individual.params.texture_size.value = side;
                    for (std::size_t level = 0; level < params.levels.size(); ++level) {
                        MushroomSpec file = file_spec(spec, one.individual, level);
                        file.params.textures = counted_textures(spec, seed, level);
                        Estimate& estimated = files.emplace_back(estimate(file, resolved));
                        // A painting is copied into its atlas while it is in memory.
                        if (file.params.textures == Textures::embedded)
                            estimated.texels += atlas_texels(spec, side);
                    }
                }
                row.push_back(std::move(one));
            }
    }

    const auto chosen = [&](int seeds, std::size_t size) {
        std::vector<SetIndividual> individuals;
        const std::size_t combinations = by_seed[0].size();
        for (std::size_t i = 0; i < combinations; ++i)
            for (int seed = 0; seed < seeds; ++seed) {
                const Candidate& one = by_seed[static_cast<std::size_t>(seed)][i];
                SetIndividual& individual = individuals.emplace_back(one.individual);
                individual.params.texture_size.value = sizes[size];
                individual.files = one.by_size[size];
            }
        return individuals;
    };
    const double most = params.megabytes * bytes_of_megabyte;
    // Smaller images first: they cost less of what is seen than fewer different individuals do.
    for (int seeds = plan.seeds; seeds > 0; --seeds)
        for (std::size_t size = 0; size < sizes.size(); ++size) {
            std::vector<SetIndividual> individuals = chosen(seeds, size);
            const std::uint64_t bytes = bytes_of(individuals);
            if (most > 0.0 && static_cast<double>(bytes) > most) {
                if (seeds > 1 || size + 1 < sizes.size()) continue;
                throw Impossible(
                    "/megabytes",
                    "one individual of each species and age with the smallest images needs " +
                        number_text(std::ceil(static_cast<double>(bytes) / 1e4) / 100.0) + " MB");
            }
            distribute(params.individuals, individuals);
            plan.seeds = seeds;
            plan.texture_size = sizes[size];
            plan.individuals = std::move(individuals);
            return plan;
        }
    return plan;
}

}  // namespace sporeprint
