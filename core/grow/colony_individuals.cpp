#include "core/grow/colony_individuals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <string>
#include <utility>

#include "core/colony/cap.h"
#include "core/geometry/sweep.h"
#include "core/grow/mushroom.h"
#include "core/individual/proportion.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/detail.h"
#include "core/mesh/index_order.h"
#include "core/params/messages.h"

namespace sporeprint {

namespace {

/// Largest number of root nodes of a request; with more, single ones are not discernible.
constexpr double most_colony_nodes = 6000.0;
/// Largest number of nodes of a stem by level of detail.
constexpr std::array<int, 4> stem_nodes = {16, 8, 3, 2};

/// Level of detail of the meshes that placement tests use, so that all levels show the same
/// members.
constexpr int placement_lod = 1;

/// Level of detail of their meshes, at most.
int mesh_lod(int lod) { return std::min(lod + 1, farthest_lod); }

/// Returns the spec of one individual. `which` determines its age.
MushroomSpec individual_spec(const ColonySpec& spec, int which) {
    const ColonyParams& params = spec.params;
    MushroomSpec own;
    own.mix = spec.mix;
    own.params.seed =
        Random(params.seed, purposes::colony_seeds, static_cast<std::uint32_t>(which)).bits();
    own.params.age = params.distinct > 1
                         ? params.age * (1.0 - params.age_spread * which / (params.distinct - 1))
                         : params.age;
    own.params.lod = cap_lod(params.lod);
    own.params.substrate = Substrate::none;  // the colony has one for all
    // The ground lies level below all of them, however they lean: colony_ground().
    own.params.base = Base::clean;
    own.params.textures = params.textures;
    own.params.file = params.file;
    return own;
}

/// Returns the fit enlarged to the widest mesh, however its outline is turned, because an earthstar
/// shrinks when old.
StemFit wide_enough(StemFit fit, const Mesh& mesh, bool first) {
    const Bounds box = bounds(mesh);
    const glm::dvec3 size = glm::dvec3(box.max) - glm::dvec3(box.min);
    fit.cap_radius = std::max(first ? 0.0 : fit.cap_radius, 0.5 * std::max(size.x, size.z));
    fit.height = std::max(first ? 0.0 : fit.height, size.y);
    return fit;
}

/// Returns the distinct individuals of a colony. Brackets are bent round its trunk, whose radius
/// depends on how wide they are, which bending does not change.
///
/// fit  of the typical individual; enlarged to the widest bracket
std::vector<Individual> distinct_individuals(const ColonySpec& spec, const ColonyTraits& traits,
                                             const Atlas& atlas, const ExecutionContext& execution,
                                             StemFit& fit) {
    const ColonyParams& params = spec.params;
    std::vector<Individual> individuals;
    for (int which = 0; which < params.distinct; ++which) {
        throw_if_cancelled(execution);
        Individual& one = individuals.emplace_back(
            resolve(individual_spec(spec, which), atlas, execution.caches.morphs));
        // All members use the images of one mushroom, so what they show is where it is painted.
        one.painted_seed = one.weather_seed = painted_seed(params.seed, params.share);
        if (traits.lateral)
            fit = wide_enough(fit, body_mesh(one, placement_lod, {.textured = false}), which == 0);
    }
    if (traits.lateral)
        for (Individual& one : individuals) one.trunk_radius = trunk_radius(params, fit);
    return individuals;
}

}  // namespace

int cap_lod(int lod) { return std::min(lod + 1, 3); }

int mesh_lod(const Individual& individual, int lod) {
    const int level = mesh_lod(lod);
    return level == farthest_lod && !individual.is_branched() &&
                   self_intersecting_curve(individual.outline, level)
               ? level - 1
               : level;
}

bool textured(const ColonySpec& spec) { return spec.params.textures != Textures::none; }

StemFit fit_of(const Individual& individual, const ColonyTraits& traits) {
    StemFit fit = stem_fit(individual);
    // Mushrooms without a stem stand on thin threads.
    if (!traits.capped) fit.radius = std::max(0.12 * fit.cap_radius, 0.0002);
    return fit;
}

ColonyRoots growth_of(const ColonyParams& params, const ColonyTraits& traits, const StemFit& fit) {
    const ColonyRoots growth = colony_growth(params, traits, fit);
    if (traits.habit == Habit::rooted && expected_root_nodes(growth) > most_colony_nodes)
        throw Impossible("/branch_distance",
                         "the roots would have more nodes than the " +
                             number_text(most_colony_nodes) +
                             " that are grown in a colony; branch less often, or lower depth");
    return growth;
}

int segments_of(const ColonyRoots& growth, int lod) {
    return std::min(growth.stem_segments, stem_nodes[static_cast<std::size_t>(lod)]);
}

ModelSet add_models(const ColonySpec& spec, const ColonyTraits& traits, const Atlas& atlas,
                    const ExecutionContext& execution, Colony& colony, StemFit& fit) {
    const ColonyParams& params = spec.params;
    ModelSet models;
    const std::vector<Individual> individuals =
        distinct_individuals(spec, traits, atlas, execution, fit);
    for (const Individual& one : individuals) {
        throw_if_cancelled(execution);
        // Placement uses one level of detail, so that members are moved or skipped alike at every
        // level.
        const auto grown = [&](int lod, bool with_texture) {
            if (traits.capped)
                return cap_mesh(one, {.lod = lod,
                                      .neck = std::max(params.cap_scale, 1.0),
                                      .textured = with_texture});
            Mesh mesh = body_mesh(one, lod, {.textured = with_texture});
            order_for_vertex_cache(mesh);
            return mesh;
        };
        const int own_lod = mesh_lod(one, params.lod);
        colony.models.push_back(grown(own_lod, textured(spec)));
        for (std::size_t i = 0; i < colony.farther.size(); ++i)
            colony.farther[i].models.push_back(
                grown(mesh_lod(one, params.lod + 1 + static_cast<int>(i)), textured(spec)));
        const Mesh& own_mesh = colony.models.back();
        const Mesh near = own_lod == placement_lod ? Mesh() : grown(placement_lod, false);
        const Mesh& footprint_mesh = own_lod == placement_lod ? own_mesh : near;
        if (!traits.capped) models.feet.push_back(foot_of(footprint_mesh));
        if (!traits.capped && !traits.lateral)
            fit = wide_enough(fit, footprint_mesh, models.models.empty());
        models.models.push_back(
            {OccupancyGrid(footprint_mesh), traits.capped ? stem_fit(one).radius : fit.radius});
        if (params.file.wind != WindFormat::none) models.stems.push_back(swaying_stem(one));
        if (params.file.collision != CollisionFormat::none)
            models.shapes.push_back(traits.capped ? fitted_shapes("cap", footprint_mesh.positions,
                                                                  footprint_mesh.indices)
                                                  : collision_shapes(one));
    }
    return models;
}

Individual average_individual(const ColonySpec& spec, int which, const Atlas& atlas,
                              const Caches& caches) {
    MushroomSpec own = individual_spec(spec, which);
    own.params.variation = 0.0;
    own.params.base = spec.params.base;
    return resolve(own, atlas, caches.morphs);
}

Individual typical_individual(const ColonySpec& spec, const Atlas& atlas, const Caches& caches) {
    return average_individual(spec, 0, atlas, caches);
}

}  // namespace sporeprint
