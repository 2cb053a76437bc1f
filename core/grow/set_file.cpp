#include "core/grow/set_file.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/grow/collision.h"
#include "core/grow/mushroom.h"
#include "core/grow/names.h"
#include "core/grow/set_materials.h"
#include "core/mesh/index_order.h"
#include "core/params/canonical.h"
#include "core/params/reader.h"

namespace sporeprint {

namespace {

/// Distance between individuals, in the width of the widest.
constexpr double grid_spacing = 1.25;

/// One individual in the file.
struct SetMember {
    std::string name;
    SetTile images;
    std::vector<Level> levels;
    std::vector<Mesh> meshes;
    Bounds box;
    SwayingStem stem;
    std::vector<CollisionShape> shapes;  ///< empty unless the file has collision
    glm::dvec3 place{0.0};
    std::vector<std::size_t> nodes;
};

SetMember member_of(const SetSpec& spec, const SetIndividual& one, const Individual& individual) {
    const FileOptions& file = spec.mushroom.file;
    SetMember member;
    member.name = product_name(file_spec(spec, one, 0));
    std::vector<double> errors;
    for (std::size_t level = 0; level < spec.params.levels.size(); ++level) {
        const MushroomSpec own = file_spec(spec, one, level);
        Mesh& mesh = member.meshes.emplace_back(mushroom_mesh(own, individual));
        if (level == 0) member.box = bounds(mesh);
        const double width = static_cast<double>(
            std::max(member.box.max.x - member.box.min.x, member.box.max.z - member.box.min.z));
        member.levels.push_back({own.params.lod, mesh.positions.size(), mesh.triangles(), 0.0});
        errors.push_back(outline_error(individual, own.params.lod, 0.5 * width));
    }
    set_coverages(member.levels, member.box, errors);
    if (file.wind != WindFormat::none) member.stem = swaying_stem(individual);
    if (file.collision != CollisionFormat::none) member.shapes = collision_shapes(individual);
    return member;
}

/// Places the individuals on a square grid, row by row, about the origin.
void place_on_grid(std::vector<SetMember>& members) {
    double widest = 0.0;
    for (const SetMember& member : members)
        widest = std::max({widest, static_cast<double>(member.box.max.x - member.box.min.x),
                           static_cast<double>(member.box.max.z - member.box.min.z)});
    const auto columns =
        static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(members.size()))));
    const std::size_t rows = (members.size() + columns - 1) / columns;
    const double step = grid_spacing * widest;
    for (std::size_t i = 0; i < members.size(); ++i) {
        const std::size_t column = i % columns, row = i / columns;
        members[i].place = {
            step * (static_cast<double>(column) - 0.5 * static_cast<double>(columns - 1)), 0.0,
            step * (static_cast<double>(row) - 0.5 * static_cast<double>(rows - 1))};
    }
}

/// Sets the sway of all meshes, relative to the largest displacement; returns that.
Wind set_wind(std::vector<SetMember>& members, WindFormat format) {
    Wind wind{format};
    if (format == WindFormat::none) return wind;
    for (const SetMember& member : members)
        wind.sway = std::max(wind.sway, displacement_of_top(member.stem));
    for (std::size_t i = 0; i < members.size(); ++i) {
        const double share =
            wind.sway > 0.0 ? displacement_of_top(members[i].stem) / wind.sway : 0.0;
        for (Mesh& mesh : members[i].meshes) {
            mesh.sway = sway_of(mesh, members[i].stem);
            for (Sway& sway : mesh.sway) {
                sway.bend *= static_cast<float>(share);
                sway.branch = static_cast<float>(i % 255 + 1) / 255.0F;
            }
        }
    }
    return wind;
}

void add_nodes(GlbScene& scene, SetMember& member, Lods lods) {
    for (std::size_t level = 0; level < member.meshes.size(); ++level) {
        const std::string own = level_name(member.name, member.levels[level].lod.lod);
        member.nodes.push_back(scene.nodes.size());
        scene.nodes.push_back(
            {.name = own, .mesh = scene.meshes.size(), .translation = member.place});
        scene.meshes.push_back({own, {{&member.meshes[level], member.images.material, {}}}});
    }
    link_levels(scene, member.nodes, member.levels, lods);
}

Collision collision_of(const SetMember& member) {
    Collision collision = body_of(member.shapes);
    for (Collider& collider : collision.colliders) collider.place.translation += member.place;
    return collision;
}

/// Adds the solids of all individuals: nodes named after each of them, or one body.
///
/// collisions  outlive the scene
void add_collisions(GlbScene& scene, const std::vector<SetMember>& members, CollisionFormat format,
                    std::vector<Collision>& collisions) {
    if (format == CollisionFormat::none) return;
    for (const SetMember& member : members) {
        Collision own = collision_of(member);
        if (format == CollisionFormat::nodes || collisions.empty()) {
            collisions.push_back(std::move(own));
            continue;
        }
        Collision& all = collisions.front();
        for (Collider& collider : own.colliders) collider.shape += all.shapes.size();
        std::move(own.shapes.begin(), own.shapes.end(), std::back_inserter(all.shapes));
        all.colliders.insert(all.colliders.end(), own.colliders.begin(), own.colliders.end());
    }
    for (std::size_t i = 0; i < collisions.size(); ++i)
        add_collision(scene, collisions[i],
                      format == CollisionFormat::nodes
                          ? level_name(members[i].name, members[i].levels.front().lod.lod)
                          : "mushrooms",
                      format);
}

/// Returns the parameters that give the same set.
Value effective_of(const SetSpec& spec, const SetPlan& plan) {
    SetParams params = spec.params;
    params.seeds = plan.seeds;
    MushroomParams mushroom = spec.mushroom;
    mushroom.texture_size.value = plan.texture_size;
    Value effective = Value::object(), species = Value::array();
    for (const Mix& mix : spec.species) species.push(mix_text(mix));
    effective.set("species", std::move(species));
    const Value of_set = write(params), of_mushroom = write(mushroom);
    for (const auto& [name, value] : of_set.members()) effective.set(name, value);
    for (const auto& [name, value] : of_mushroom.members())
        if (name != "seed" && name != "age" && name != "lod") effective.set(name, value);
    return effective;
}

Value individuals_value(const SetSpec& spec, const SetPlan& plan,
                        const std::vector<SetMember>& members) {
    Value list = Value::array();
    for (std::size_t i = 0; i < members.size(); ++i) {
        const SetMember& member = members[i];
        const SetIndividual& one = plan.individuals[i];
        Value levels = level_list(member.levels);
        Value named = Value::array();
        for (std::size_t level = 0; level < member.nodes.size(); ++level) {
            Value item = levels.items()[level];
            item.set("node", Value(member.nodes[level]));
            named.push(std::move(item));
        }
        Value item = Value::object()
                         .set("name", member.name)
                         .set("species", mix_text(spec.species[one.species]))
                         .set("seed", one.params.seed)
                         .set("age", one.params.age)
                         .set("shown", one.shown)
                         .set("bounds_m", bounds_value(member.box))
                         .set("levels", std::move(named));
        if (spec.params.atlas != AtlasShare::none)
            item.set("material", member.images.material).set("tile", member.images.tile);
        list.push(std::move(item));
    }
    return list;
}

}  // namespace

void refuse_in_one_file(const SetSpec& spec) {
    const MushroomParams& mushroom = spec.mushroom;
    refuse_impossible(mushroom.file, mushroom.textures);
    refuse_impossible_atlas(spec);
    if (mushroom.animation != Animation::none)
        throw Impossible("/animation", std::string("'") + name(mushroom.animation) +
                                           "' is impossible: a clip moves one individual; ask for "
                                           "none, or for an archive");
    if (mushroom.substrate.value_or(Substrate::none) != Substrate::none)
        throw Impossible("/substrate", std::string("'") + name(*mushroom.substrate) +
                                           "' is impossible for a set in one file, whose "
                                           "individuals stand without wood; ask for none, or for "
                                           "an archive");
    if (mushroom.variants != Variants::none)
        throw Impossible("/variants", std::string("'") + name(mushroom.variants) +
                                          "' is impossible for a set in one file; ask for none, or "
                                          "for an archive");
    if (mushroom.file.impostor)
        throw Impossible("/impostor",
                         "'true' is impossible for a set in one file, whose levels are meshes; ask "
                         "for false, or for an archive");
    if (spec.params.levels.size() > 1 && mushroom.file.lods == Lods::single)
        throw Impossible("/lods",
                         "several levels in one file lie over each other; ask for lods=msft, for "
                         "lods=nodes, or for one level");
}

Grown grow_set(const SetSpec& spec, const SetPlan& plan, const Atlas& atlas,
               const ImageLinks& links, const ExecutionContext& execution) {
    refuse_in_one_file(spec);
    const MushroomParams& mushroom = spec.mushroom;
    GlbScene scene;
    set_options(scene, mushroom.file);
    std::vector<SetMember> members;
    SetMaterials materials(spec);
    for (const SetIndividual& one : plan.individuals) {
        throw_if_cancelled(execution);
        execution.observer(Step::build);
        const Individual individual =
            resolve(file_spec(spec, one, 0), atlas, execution.caches.morphs);
        SetMember& member = members.emplace_back(member_of(spec, one, individual));
        member.images = materials.add(one, look_of(individual.model),
                                      [&] { return flesh_of(individual, execution.parallel); });
    }
    materials.add_to(scene, atlas, links, execution);
    execution.observer(Step::pack);
    for (SetMember& member : members)
        for (Mesh& mesh : member.meshes) materials.move_to_tile(mesh, member.images);
    place_on_grid(members);
    const Wind wind = set_wind(members, mushroom.file.wind);
    Grown grown;
    std::uint64_t triangles = 0;
    constexpr float far = 1e9F;
    Bounds box{glm::vec3(far), glm::vec3(-far)};
    for (SetMember& member : members) {
        add_nodes(scene, member, mushroom.file.lods);
        for (const Level& level : member.levels) {
            grown.vertices += level.vertices;
            grown.triangles += level.triangles;
        }
        triangles += member.levels.front().triangles;
        box.min = glm::min(box.min, member.box.min + glm::vec3(member.place));
        box.max = glm::max(box.max, member.box.max + glm::vec3(member.place));
    }
    Value extras = extras_value({}, effective_of(spec, plan), box, triangles, {}, wind);
    extras.set("individuals", individuals_value(spec, plan, members));
    if (spec.params.atlas != AtlasShare::none) extras.set("atlases", materials.atlases_value());
    scene.extras_json = dump(extras);
    std::vector<Collision> collisions;
    collisions.reserve(members.size());
    add_collisions(scene, members, mushroom.file.collision, collisions);
    grown.glb = glb(scene, execution.parallel);
    return grown;
}

}  // namespace sporeprint
