#include "core/grow/colony_estimate.h"

#include <algorithm>
#include <cmath>

#include "core/colony/colony_skin.h"
#include "core/grow/colony_individuals.h"
#include "core/grow/colony_wood.h"
#include "core/grow/impostor.h"
#include "core/grow/mushroom.h"
#include "core/grow/translucency.h"
#include "core/grow/variants.h"
#include "core/grow/wood.h"

namespace sporeprint {

namespace {

/// Approximate number of quads per node of the skeleton before subdivision.
constexpr double quads_per_node = 9.0;
/// The same for a node of thin roots, of which cleaning drops fewer.
constexpr double quads_per_root_node = 10.5;

std::uint64_t image_texels(const ColonySpec& spec) {
    const auto side = static_cast<std::uint64_t>(spec.params.texture_size) >> spec.params.lod;
    return textured(spec) && spec.params.lod != impostor_lod ? 3 * side * side : 0;
}

/// Adds one level of detail of a file.
void add_level(Estimate& e, const ColonySpec& spec, std::uint64_t vertices, std::uint64_t triangles,
               std::uint64_t members) {
    const std::uint64_t place =
        spec.params.instancing == Instancing::gpu ? bytes_of_instance(spec.params.file) : 220;
    add_level(e, vertices, triangles, spec.params.textures, spec.params.file);
    e.bytes += place * members + 900 * static_cast<std::uint64_t>(spec.params.distinct);
}

void add_images(Estimate& e, const ColonySpec& spec, Substrate substrate) {
    const std::uint64_t texels = image_texels(spec);
    std::uint64_t of_wood = 0;
    if (substrate != Substrate::none && texels > 0)
        of_wood = texels_of({substrate, wood_side(spec.params.texture_size, spec.params.lod)});
    e.texels =
        of_wood + texels * static_cast<std::uint64_t>(atlases_held(paint_mushroom_spec(spec)));
    add_image_bytes(
        e, (of_wood + static_cast<std::uint64_t>(image_sets(spec.params.variants)) * texels) / 3,
        spec.params.textures, spec.params.file);
    if (texels > 0) e.bytes += bytes_of_thinness(spec.params.textures, spec.params.file);
    if (has_impostor(spec.params.lod, spec.params.file))
        add_impostor(e, spec.params.texture_size, spec.params.file);
}

void add_solids(Estimate& e, const ColonySpec& spec) {
    // A stem has one to six capsules, those of the young ones fewer.
    const auto members = static_cast<std::uint64_t>(spec.params.count);
    add_solid_bytes(e, 1 + static_cast<std::uint64_t>(spec.params.distinct), 2 * members,
                    spec.params.file);
}

/// Returns the number of vertices and triangles of one individual, without ground.
MeshCount count_of_one(const Individual& typical, int lod) {
    Individual bare = typical;
    bare.grounds.clear();
    return body_count(bare, mesh_lod(typical, lod));
}

/// Returns about how many vertices and triangles the meshes of a level of detail have.
MeshCount expected_count(const ColonySpec& spec, const Individual& typical,
                         const ColonyTraits& traits, const ColonyRoots& growth, int lod) {
    const ColonyParams& params = spec.params;
    const auto distinct = static_cast<std::uint64_t>(std::min(params.distinct, params.count));
    const MeshCount one = count_of_one(typical, lod);
    double nodes = 0.0;
    if (traits.roots == RootsShown::shown)
        nodes += root_share(lod) * (1.2 * expected_root_nodes(growth) + 20.0);
    if (traits.capped) nodes += params.count * (segments_of(growth, lod) + 1.0) + 2.0;
    // Where the number of nodes is random, the level of the finer skin is assumed.
    const auto least =
        static_cast<std::size_t>(traits.roots == RootsShown::shown ? 0.6 * nodes : nodes);
    const double quads =
        nodes * (traits.roots == RootsShown::shown ? quads_per_root_node : quads_per_node) *
        static_cast<double>(1 << (2 * skin_levels(least, lod)));
    const MeshCount wood = expected_wood(spec, traits, fit_of(typical, traits), lod);
    MeshCount sum = colony_ground_count(typical.grounds, traits, params.count, lod);
    sum += wood;
    sum.vertices += distinct * one.vertices + static_cast<std::uint64_t>(1.2 * quads);
    sum.triangles += distinct * one.triangles + static_cast<std::uint64_t>(2.0 * quads);
    return sum;
}

}  // namespace

MeshCount count_of(const Mesh& skin, const Mesh& wood, std::span<const Mesh> models) {
    MeshCount count{skin.positions.size() + wood.positions.size(),
                    skin.triangles() + wood.triangles()};
    for (const Mesh& model : models) {
        count.vertices += model.positions.size();
        count.triangles += model.triangles();
    }
    return count;
}

ColonySpec at_level(ColonySpec spec, const Individual& typical, const Atlas& atlas) {
    ColonyParams& params = spec.params;
    if (!params.triangles) return spec;
    const ColonyTraits traits = colony_traits(spec, atlas);
    const ColonyRoots growth = growth_of(params, traits, fit_of(typical, traits));
    const double repeated = std::max(params.count - params.distinct, 0);
    params.lod = nearest_level(*params.triangles, [&](int lod) {
        const MeshCount stored = expected_count(spec, typical, traits, growth, lod);
        const MeshCount one = count_of_one(typical, lod);
        return static_cast<double>(stored.triangles) +
               repeated * static_cast<double>(one.triangles);
    });
    params.triangles.reset();
    return spec;
}

Estimate estimate(const ColonySpec& spec, const Individual& typical, const Atlas& atlas) {
    if (spec.params.triangles) return estimate(at_level(spec, typical, atlas), typical, atlas);
    const ColonyParams& params = spec.params;
    const ColonyTraits traits = colony_traits(spec, atlas);
    refuse_impossible(params.file, params.textures);
    refuse_impossible_variants(params.variants, params.textures, params.file);
    refuse_impossible_impostor(params.lod, params.file, params.textures, params.variants);
    const ColonyRoots growth = growth_of(params, traits, fit_of(typical, traits));
    Estimate e;
    for (const int lod : levels_in_file(params.lod, params.file)) {
        const MeshCount count = expected_count(spec, typical, traits, growth, lod);
        add_level(e, spec, count.vertices, count.triangles,
                  static_cast<std::uint64_t>(params.count));
    }
    add_images(e, spec, traits.substrate);
    add_solids(e, spec);
    return e;
}

std::vector<Level> levels_of(const ColonySpec& spec, const Individual& typical, const Atlas& atlas,
                             const Bounds& box) {
    if (spec.params.triangles)
        return levels_of(at_level(spec, typical, atlas), typical, atlas, box);
    const ColonyParams& params = spec.params;
    const ColonyTraits traits = colony_traits(spec, atlas);
    const StemFit fit = fit_of(typical, traits);
    const ColonyRoots growth = growth_of(params, traits, fit);
    std::vector<Level> levels;
    std::vector<double> errors;
    for (int lod = params.lod; lod <= last_lod; ++lod) {
        const MeshCount count = expected_count(spec, typical, traits, growth, lod);
        levels.push_back({lod, count.vertices, count.triangles, 0.0});
        errors.push_back(
            outline_error(typical, mesh_lod(typical, lod), params.size * fit.cap_radius));
    }
    if (has_impostor(params.lod, params.file))
        add_impostor_level(levels, errors, box, params.texture_size);
    set_coverages(levels, box, errors);
    return levels;
}

Estimate measured(const ColonySpec& spec, const Colony& colony) {
    Estimate e;
    const auto add = [&](const MeshCount& count) {
        add_level(e, spec, count.vertices, count.triangles, colony.members.size());
    };
    if (spec.params.lod != impostor_lod) add(count_of(colony.skin, colony.wood, colony.models));
    for (const ColonyLevel& level : colony.farther)
        add(count_of(level.skin, level.wood, level.models));
    add_images(e, spec, colony.effective.substrate.value_or(Substrate::none));
    add_solids(e, spec);
    return e;
}

}  // namespace sporeprint
