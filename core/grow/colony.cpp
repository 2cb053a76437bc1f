#include "core/grow/colony.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "core/colony/colony_skin.h"
#include "core/grow/colony_scene.h"
#include "core/grow/colony_wind.h"
#include "core/grow/impostor.h"
#include "core/grow/mushroom.h"
#include "core/grow/names.h"
#include "core/grow/translucency.h"
#include "core/grow/variants.h"
#include "core/grow/wood.h"
#include "core/individual/proportion.h"
#include "core/math/direction.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/detail.h"
#include "core/mesh/index_order.h"
#include "core/params/messages.h"
#include "core/params/reader.h"

namespace sporeprint {

namespace {

/// Largest number of root nodes of a request; with more, single ones are not discernible.
constexpr double most_colony_nodes = 6000.0;
/// Largest number of nodes of a stem by level of detail.
constexpr std::array<int, 4> stem_nodes = {16, 8, 3, 2};
/// Approximate number of quads per node of the skeleton before subdivision.
constexpr double quads_per_node = 9.0;

/// Level of detail of the meshes that placement tests use, so that all levels show the same
/// members.
constexpr int placement_lod = 1;

/// Level of detail of what is painted on the individuals of a colony.
int cap_lod(int lod) { return std::min(lod + 1, 3); }

/// Level of detail of their meshes, at most.
int mesh_lod(int lod) { return std::min(lod + 1, farthest_lod); }

/// Returns the same for one individual: if its outline intersects itself with so few rings, the
/// previous level.
int mesh_lod(const Individual& individual, int lod) {
    const int level = mesh_lod(lod);
    return level == farthest_lod && !individual.is_branched() &&
                   self_intersecting_curve(individual.outline, level)
               ? level - 1
               : level;
}

bool textured(const ColonySpec& spec) { return spec.params.textures != Textures::none; }

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
    // The clod of a mushroom fits its own foot; stems of a colony lean and end in others or in roots.
    own.params.base = Base::clean;
    own.params.textures = params.textures;
    own.params.file = params.file;
    return own;
}

StemFit fit_of(const Individual& individual, const ColonyTraits& traits) {
    StemFit fit = stem_fit(individual);
    // Mushrooms without a stem stand on thin threads.
    if (!traits.capped) fit.radius = std::max(0.12 * fit.cap_radius, 0.0002);
    return fit;
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

/// Returns the piece of wood that a tier stands on, metres at size 1.
///
/// lowest, highest  middles of its members
WoodPiece wood_of(const ColonyParams& params, const ColonyTraits& traits, const StemFit& fit,
                  double lowest, double highest) {
    const double radius = trunk_radius(params, fit);
    const double beyond = std::max(1.2 * std::max(fit.height, fit.cap_radius), 0.5 * radius);
    return {radius, lowest - beyond, highest + beyond, traits.seed, 0.0, traits.substrate};
}

/// Returns about how many vertices and triangles the wood of a colony has.
MeshCount expected_wood(const ColonySpec& spec, const ColonyTraits& traits, const StemFit& fit,
                        int lod) {
    if (traits.substrate == Substrate::none) return {};
    const TierRows rows = tier_rows(traits, fit.cap_radius * spec.params.cap_scale, fit.height,
                                    trunk_radius(spec.params, fit));
    const double height =
        rows.height * std::ceil(static_cast<double>(spec.params.count) / rows.in_row);
    const MeshCount count = wood_count(wood_of(spec.params, traits, fit, 0.0, height), lod);
    // Rows of brackets are uneven, and the wood reaches beyond the outermost.
    return {count.vertices + count.vertices / 3, count.triangles + count.triangles / 3};
}

/// Returns about how many vertices and triangles the meshes of a level of detail have.
MeshCount expected_count(const ColonySpec& spec, const Individual& typical,
                         const ColonyTraits& traits, const ColonyRoots& growth, int lod) {
    const ColonyParams& params = spec.params;
    const auto distinct = static_cast<std::uint64_t>(std::min(params.distinct, params.count));
    const MeshCount one = body_count(typical, mesh_lod(typical, lod));
    double nodes = 0.0;
    if (traits.roots == RootsShown::shown)
        nodes += root_share(lod) * (1.2 * expected_root_nodes(growth) + 20.0);
    if (traits.capped) nodes += params.count * (segments_of(growth, lod) + 1.0) + 2.0;
    // Where the number of nodes is random, the level of the finer skin is assumed.
    const auto least =
        static_cast<std::size_t>(traits.roots == RootsShown::shown ? 0.6 * nodes : nodes);
    const double quads =
        nodes * quads_per_node * static_cast<double>(1 << (2 * skin_levels(least, lod)));
    const MeshCount wood = expected_wood(spec, traits, fit_of(typical, traits), lod);
    return {distinct * one.vertices + static_cast<std::uint64_t>(1.2 * quads) + wood.vertices,
            distinct * one.triangles + static_cast<std::uint64_t>(2.0 * quads) + wood.triangles};
}

MeshCount count_of(const Mesh& skin, const Mesh& wood, std::span<const Mesh> models) {
    MeshCount count{skin.positions.size() + wood.positions.size(),
                    skin.triangles() + wood.triangles()};
    for (const Mesh& model : models) {
        count.vertices += model.positions.size();
        count.triangles += model.triangles();
    }
    return count;
}

/// Returns the parameters with every default resolved.
ColonyParams effective_params(ColonyParams params, const ColonyTraits& traits,
                              const ColonyRoots& growth, const StemFit& fit) {
    params.habit = traits.habit;
    params.roots = traits.roots;
    if (traits.habit == Habit::tier) {
        params.trunk_radius = trunk_radius(params, fit);
        params.substrate = traits.substrate;
    }
    // Only those that the habit has.
    const bool rooted = traits.habit == Habit::rooted, stems = traits.capped;
    if (rooted) {
        params.growth.field = growth.field;
        params.growth.field_scale = growth.field_scale;
        params.growth.heading_deg = growth.heading_deg;
        params.growth.arms = growth.arms;
        params.growth.segment_length = growth.segment_length;
        params.growth.decay = growth.decay;
        params.growth.depth = growth.depth;
        params.growth.branch_distance = growth.branch_distance;
        params.growth.branch_jitter_deg = growth.branch_jitter_deg;
        params.growth.area_decay = growth.area_decay;
        params.growth.stem_probability = growth.stem_probability;
        if (stems) params.growth.stem_decay = growth.stem_decay;
    }
    params.growth.root_radius = growth.root_radius;
    if (stems) {
        params.growth.stem_height = growth.stem_height;
        params.growth.stem_displacement = growth.stem_displacement;
        params.growth.stem_segments = growth.stem_segments;
    }
    return params;
}

/// Returns the product of two unit quaternions x, y, z, w: first `b`, then `a`.
glm::dvec4 product_of(const glm::dvec4& a, const glm::dvec4& b) {
    const glm::dvec3 u(a), v(b);
    return {a.w * v + b.w * u + glm::cross(u, v), a.w * b.w - glm::dot(u, v)};
}

/// Returns the solids of all members: those of their models at their places, and capsules along
/// their stems.
///
/// members  with the poses of the file
/// shapes   of each model
Collision colony_collision(const ColonySite& site, const std::vector<ColonyMember>& members,
                           const std::vector<std::vector<CollisionShape>>& shapes,
                           const ColonyParams& params, const ColonyTraits& traits) {
    std::vector<Collision> models;
    models.reserve(shapes.size());
    for (const std::vector<CollisionShape>& of_model : shapes) models.push_back(body_of(of_model));
    Collision collision;
    std::vector<std::size_t> first_of(models.size());
    for (std::size_t i = 0; i < models.size(); ++i) {
        first_of[i] = collision.shapes.size();
        collision.shapes.insert(collision.shapes.end(), models[i].shapes.begin(),
                                models[i].shapes.end());
    }
    for (const ColonyMember& member : members) {
        const Pose& pose = member.pose;
        for (const Collider& own : models[member.model].colliders) {
            const glm::dvec4 turn = product_of(quaternion_of(pose.turn), own.place.rotation);
            collision.colliders.push_back(
                {first_of[member.model] + own.shape,
                 {pose.world(own.place.translation), turn, glm::dvec3(pose.scale)}});
        }
        if (!traits.capped) continue;
        const ColonyPlace& place = site.places[member.place];
        // The chords of n equal pieces are at most a quarter of the swing / n^2 off the stem.
        const double off = 0.25 * glm::length(member.swing) / (0.5 * place.radius);
        const int pieces = std::clamp(static_cast<int>(std::ceil(std::sqrt(off))), 1, 6);
        std::vector<glm::dvec3> points;
        for (int i = 0; i <= pieces; ++i) {
            const double t = static_cast<double>(i) / pieces;
            points.push_back(params.size * (place.foot + t * member.rise + t * t * member.swing));
        }
        const std::vector<double> radii(points.size(), params.size * place.radius);
        for (CollisionShape& stem : capsules_along("stem", points, radii, pieces))
            collision.add(std::move(stem));
    }
    return collision;
}

/// What placement, collision and wind need of the distinct individuals of a colony.
struct ModelSet {
    std::vector<ColonyModel> models;
    std::vector<SwayingStem> stems;  ///< of the whole individuals; empty unless the file has wind
    std::vector<std::vector<CollisionShape>> shapes;  ///< empty unless the file has collision
};

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
        one.painted_seed = painted_seed(params.seed, params.share);
        if (traits.lateral)
            fit = wide_enough(fit, body_mesh(one, placement_lod, {.textured = false}), which == 0);
    }
    if (traits.lateral)
        for (Individual& one : individuals) one.trunk_radius = trunk_radius(params, fit);
    return individuals;
}

/// Adds the meshes of the distinct individuals of a colony.
///
/// fit      of the typical individual; enlarged to the widest mesh if mushrooms stand as a whole
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

/// Returns the piece of wood behind the members of a tier, metres at size 1.
WoodPiece wood_below(const std::vector<ColonyMember>& members, const ColonyParams& params,
                     const ColonyTraits& traits, const StemFit& fit) {
    double lowest = 0.0, highest = 0.0;
    for (const ColonyMember& member : members) {
        lowest = std::min(lowest, member.pose.at.y);
        highest = std::max(highest, member.pose.at.y);
    }
    return wood_of(params, traits, fit, lowest, highest);
}

/// Returns an individual of the age of one of the models, without its variation.
Individual average_individual(const ColonySpec& spec, int which, const Atlas& atlas,
                              const Caches& caches) {
    MushroomSpec own = individual_spec(spec, which);
    own.params.variation = 0.0;
    return resolve(own, atlas, caches.morphs);
}

}  // namespace

Individual typical_individual(const ColonySpec& spec, const Atlas& atlas, const Caches& caches) {
    return average_individual(spec, 0, atlas, caches);
}

ColonySpec at_level(ColonySpec spec, const Individual& typical, const Atlas& atlas) {
    ColonyParams& params = spec.params;
    if (!params.triangles) return spec;
    const ColonyTraits traits = colony_traits(spec, atlas);
    const ColonyRoots growth = growth_of(params, traits, fit_of(typical, traits));
    const double repeated = std::max(params.count - params.distinct, 0);
    params.lod = nearest_level(*params.triangles, [&](int lod) {
        const MeshCount stored = expected_count(spec, typical, traits, growth, lod);
        const MeshCount one = body_count(typical, mesh_lod(typical, lod));
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

Colony colony_parts(const ColonySpec& spec, const Individual& typical, const Atlas& atlas,
                    const ExecutionContext& execution) {
    const ColonyParams& params = spec.params;
    if (params.lod == impostor_lod) {
        ColonySpec shown = spec;
        shown.params.lod = impostor_source_lod;
        shown.params.file.lods = Lods::single;
        shown.params.file.impostor = false;
        Colony colony = colony_parts(shown, typical, atlas, execution);
        colony.effective.lod = params.lod;
        colony.effective.file = params.file;
        return colony;
    }
    const ColonyTraits traits = colony_traits(spec, atlas);
    StemFit fit = fit_of(typical, traits);
    const double painted_length = fit.length;
    const double painted_from = typical.is_branched() ? 0.0 : buried_share(typical.outline.stem);

    execution.observer(Step::build);
    Colony colony;
    colony.farther.resize(levels_in_file(params.lod, params.file).size() - 1);
    const ModelSet models = add_models(spec, traits, atlas, execution, colony, fit);
    throw_if_cancelled(execution);

    const ColonyRoots growth = growth_of(params, traits, fit);
    ColonyFits fits{fit, fit};
    // Whole individuals have the size of their age by themselves, and roots decide on the others.
    if (traits.capped && traits.habit != Habit::rooted)
        fits.youngest =
            fit_of(average_individual(spec, params.distinct - 1, atlas, execution.caches), traits);
    const ColonySite site = colony_site(params, traits, growth, fits);
    colony.members = placed_members(site, models.models, params, traits);
    std::vector<Sway> sway;  // of each model at its top
    if (params.file.wind != WindFormat::none) {
        sway = sway_of_models(colony.members, traits, models.stems);
        add_sway(colony, traits, models.stems, sway);
        colony.wind = wind_of(site, colony.members, traits, swaying_stem(typical), params);
    }
    const auto skin = [&](int lod) {
        throw_if_cancelled(execution);
        ColonyParams at = params;
        at.lod = lod;
        const Skeleton skeleton =
            colony_skeleton(site, colony.members, at, traits, segments_of(growth, lod));
        ColonySkin made =
            colony_skin(skeleton, {lod, painted_length, textured(spec), painted_from});
        if (!sway.empty()) made.mesh.sway = sway_of(made, site, colony.members, sway);
        for (glm::vec3& place : made.mesh.positions) place *= static_cast<float>(params.size);
        return std::move(made.mesh);
    };
    colony.skin = skin(params.lod);
    for (std::size_t i = 0; i < colony.farther.size(); ++i)
        colony.farther[i].skin = skin(params.lod + 1 + static_cast<int>(i));
    std::optional<WoodPiece> piece;
    if (traits.substrate != Substrate::none)
        piece = wood_below(colony.members, params, traits, fit);
    const auto wood = [&](int lod, bool with_texture) {
        Mesh made = wood_mesh(*piece, lod, with_texture);
        if (params.file.wind != WindFormat::none) made.sway.resize(made.positions.size());
        for (glm::vec3& place : made.positions) place *= static_cast<float>(params.size);
        return made;
    };
    if (piece) {
        colony.wood = wood(params.lod, textured(spec));
        for (std::size_t i = 0; i < colony.farther.size(); ++i)
            colony.farther[i].wood = wood(params.lod + 1 + static_cast<int>(i), textured(spec));
    }
    colony.effective = effective_params(params, traits, growth, fit);
    colony.junction = fit.radius;

    std::vector<bool> shown(colony.models.size(), false);
    for (ColonyMember& member : colony.members) {
        member.pose.at *= params.size;
        member.pose.scale *= params.size;
        shown[member.model] = true;
    }
    if (params.file.collision != CollisionFormat::none)
        colony.collision = colony_collision(site, colony.members, models.shapes, params, traits);
    if (piece && params.file.collision != CollisionFormat::none) {
        const Mesh solid = wood(last_lod, false);
        for (CollisionShape& shape : fitted_shapes("wood", solid.positions, solid.indices))
            colony.collision.add(std::move(shape));
    }
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (shown[i]) continue;
        colony.models[i] = {};
        for (ColonyLevel& level : colony.farther) level.models[i] = {};
    }
    if (colony.members.empty() && colony.skin.positions.empty())
        throw Impossible("/stem_probability", "no root node of this seed bears anything");
    return colony;
}

Bounds bounds(const Colony& colony) {
    constexpr float far = 1e9F;
    Bounds box{glm::vec3(far), glm::vec3(-far)};
    const auto add = [&](const glm::vec3& at) {
        box.min = glm::min(box.min, at);
        box.max = glm::max(box.max, at);
    };
    for (const Mesh* mesh : {&colony.skin, &colony.wood})
        for (const glm::vec3& at : mesh->positions) add(at);
    for (const ColonyMember& member : colony.members)
        for (const glm::vec3& at : colony.models[member.model].positions)
            add(glm::vec3(member.pose.world(glm::dvec3(at))));
    return box;
}

std::uint64_t instanced_triangles(const Colony& colony) {
    std::uint64_t triangles = colony.skin.triangles() + colony.wood.triangles();
    for (const ColonyMember& member : colony.members)
        triangles += colony.models[member.model].triangles();
    return triangles;
}

MushroomSpec paint_mushroom_spec(const ColonySpec& spec) {
    MushroomSpec own;
    own.mix = spec.mix;
    own.params.seed = spec.params.seed;
    own.params.share = spec.params.share;
    own.params.age = spec.params.age;
    own.params.lod = cap_lod(spec.params.lod);
    own.params.texture_size = spec.params.texture_size;
    own.params.textures = spec.params.textures;
    own.params.variants = spec.params.variants;
    own.params.base = spec.params.base;
    return own;
}

PaintSpec paint_spec_of(const ColonySpec& spec, const MushroomSpec& painted, const Atlas& atlas,
                        const Caches& caches) {
    PaintSpec paint_spec = paint_spec_of(painted, atlas, caches);
    // The resolution is that of the colony's level of detail, the painted detail that of its caps'.
    for (PaintShare& share : paint_spec)
        share.painting.side = spec.params.texture_size >> spec.params.lod;
    return paint_spec;
}

Grown grow_colony(const ColonySpec& spec, const Atlas& atlas, const Extras& extras,
                  const ExecutionContext& execution) {
    execution.observer(Step::resolve);
    return grow_colony(spec, typical_individual(spec, atlas, execution.caches), atlas, extras,
                       execution);
}

Grown grow_colony(const ColonySpec& spec, const Individual& typical, const Atlas& atlas,
                  const Extras& extras, const ExecutionContext& execution) {
    if (spec.params.triangles)
        return grow_colony(at_level(spec, typical, atlas), typical, atlas, extras, execution);
    const ColonyParams& params = spec.params;
    refuse_impossible(params.file, params.textures);
    refuse_impossible_variants(params.variants, params.textures, params.file);
    refuse_impossible_impostor(params.lod, params.file, params.textures, params.variants);
    Colony colony = colony_parts(spec, typical, atlas, execution);
    std::optional<Impostor> impostor;
    if (has_impostor(params.lod, params.file)) {
        impostor = impostor_of(
            [&](const Extras& drawing) {
                (void)grow_colony(impostor_source(spec), typical, atlas, drawing, execution);
            },
            frame_side_of(params.texture_size), params.file, execution);
        if (colony.wind.format != WindFormat::none) add_sway(*impostor, colony.wind);
    }
    const bool has_meshes = params.lod != impostor_lod;
    const Bounds box = bounds(colony);
    GlbScene scene;
    set_options(scene, params.file);
    scene.stands_on_ground = colony_traits(spec, atlas).habit != Habit::tier;
    const MushroomSpec painted = paint_mushroom_spec(spec);
    const auto painting_of = [&](const MushroomSpec& one) {
        return paint_spec_of(spec, one, atlas, execution.caches);
    };
    EmbeddedImages images;
    std::vector<EmbeddedImages> variant_images;
    if (has_meshes) {
        scene.materials.push_back(
            {.name = skin_name(spec),
             .look = look_of(typical.model),
             .transmission = transmission_of(typical, params.file, execution)});
        images = attach_images(scene.materials.front(), params.textures, params.file,
                               extras.image_urls, execution, [&](ImageFormat format) {
                                   return painted_images(painting_of(painted), execution, format);
                               });
        variant_images = add_variants(scene, variants_of(painted, typical), params.textures,
                                      params.file, extras, execution, painting_of);
    }
    const std::size_t wood_material = scene.materials.size();
    EmbeddedImages images_of_wood;
    if (has_meshes && !colony.wood.positions.empty()) {
        const WoodPaint paint{*colony.effective.substrate,
                              wood_side(params.texture_size, params.lod)};
        images_of_wood =
            add_wood_material(scene, paint, params.textures, params.file, extras, execution);
    }
    execution.observer(Step::pack);
    std::vector<Level> levels{{params.lod}};
    if (params.file.lods != Lods::single) {
        levels = levels_of(spec, typical, atlas, box);
        const std::size_t meshes = levels.size() - (impostor ? 1 : 0);
        for (std::size_t i = 0; i < meshes; ++i) {
            const MeshCount count =
                i == 0 ? count_of(colony.skin, colony.wood, colony.models)
                       : count_of(colony.farther[i - 1].skin, colony.farther[i - 1].wood,
                                  colony.farther[i - 1].models);
            levels[i].vertices = count.vertices;
            levels[i].triangles = count.triangles;
        }
    }
    scene.extras_json =
        dump(extras_value(extras, write(colony.effective), box,
                          has_meshes ? instanced_triangles(colony) : impostor->cards.triangles(),
                          {levels, params.file.lods}, colony.wind));
    add_grouped_levels(scene, product_name(spec), levels, params.file.lods,
                       [&](std::size_t i, const std::string& name) {
                           if (impostor && i + 1 == levels.size())
                               add_cards(scene, *impostor, product_name(spec), name);
                           else if (i == 0)
                               add_colony(scene, colony, colony.skin, colony.wood, colony.models,
                                          wood_material, name);
                           else
                               add_colony(scene, colony, colony.farther[i - 1].skin,
                                          colony.farther[i - 1].wood, colony.farther[i - 1].models,
                                          wood_material, name);
                       });
    add_collision(scene, colony.collision, level_name(product_name(spec), params.lod),
                  params.file.collision);
    const Estimate e = measured(spec, colony);
    return {extras.write(scene, execution.parallel), e.vertices, e.triangles};
}

}  // namespace sporeprint
