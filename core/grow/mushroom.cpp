#include "core/grow/mushroom.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/geometry/branch_plan.h"
#include "core/geometry/branches.h"
#include "core/geometry/budget.h"
#include "core/gltf/glb.h"
#include "core/grow/collision.h"
#include "core/grow/growth.h"
#include "core/grow/impostor.h"
#include "core/grow/level_choice.h"
#include "core/grow/names.h"
#include "core/grow/painting.h"
#include "core/grow/translucency.h"
#include "core/grow/variants.h"
#include "core/grow/wood.h"
#include "core/mesh/detail.h"
#include "core/mesh/index_order.h"
#include "core/params/messages.h"
#include "core/params/reader.h"

namespace sporeprint {

namespace {

bool textured(const MushroomSpec& spec) { return spec.params.textures != Textures::none; }

Mesh ordered_mesh(const MushroomSpec& spec, const Individual& individual, DetailLevel level) {
    Mesh mesh = body_mesh(
        individual, level,
        {.textured = textured(spec), .keep_absent = spec.params.animation != Animation::none});
    order_for_vertex_cache(mesh);
    return mesh;
}

// Throws Impossible for options that exclude each other, also those of mushrooms alone.
void refuse_impossible(const MushroomParams& params) {
    refuse_impossible(params.file, params.textures);
    refuse_impossible_variants(params.variants, params.textures, params.file);
    refuse_impossible_impostor(params.lod, params.file, params.textures, params.variants);
    if (has_impostor(params.lod, params.file) && params.animation != Animation::none)
        throw Impossible("/animation",
                         in_quotes(name(params.animation)) +
                             " is impossible for an impostor, which shows one age; ask for none");
}

/// Returns the first level of detail of a file; of an impostor alone that which it shows.
DetailLevel shown_level(const MushroomSpec& spec, const Individual& individual) {
    return spec.params.lod == impostor_lod ? DetailLevel(impostor_source_lod)
                                           : first_level(spec, individual);
}

/// Returns the mesh of each level of detail of a file; none for an impostor alone.
std::vector<Mesh> level_meshes(const MushroomSpec& spec, const Individual& individual,
                               const ExecutionContext& execution) {
    std::vector<Mesh> meshes;
    for (const DetailLevel level : levels_in_file(spec, individual)) {
        meshes.push_back(ordered_mesh(spec, individual, level));
        throw_if_cancelled(execution);
    }
    return meshes;
}

/// Returns the mesh of the wood behind a bracket at each level of detail of a file; none for what
/// stands on none.
std::vector<Mesh> wood_meshes(const MushroomSpec& spec, const Individual& individual) {
    std::vector<Mesh> meshes;
    if (const std::optional<WoodPiece> piece = wood_behind(individual))
        for (const DetailLevel level : levels_in_file(spec, individual)) {
            Mesh& mesh = meshes.emplace_back(wood_mesh(*piece, wood_lod(level), textured(spec)));
            if (spec.params.file.wind != WindFormat::none) mesh.sway.resize(mesh.positions.size());
        }
    return meshes;
}

/// Adds the levels of a mushroom: each a node with a mesh, or with its wood two of them.
///
/// primitives     of the mushroom and of its impostor, by level
/// wood           by level; none for what stands on none
/// wood_material  index of that of the wood
void add_levels(GlbScene& scene, const MushroomSpec& spec,
                const std::vector<std::vector<GlbPrimitive>>& primitives,
                const std::vector<Mesh>& wood, std::size_t wood_material,
                std::span<const Level> levels) {
    const Lods lods = spec.params.file.lods;
    if (wood.empty()) return add_levels(scene, product_name(spec), primitives, levels, lods);
    const auto add = [&](const std::string& name, const std::vector<GlbPrimitive>& of_mesh,
                         GlbRole role) {
        scene.nodes.push_back({.name = name, .mesh = scene.meshes.size()});
        scene.meshes.push_back({name, of_mesh, role});
    };
    add_grouped_levels(
        scene, product_name(spec), levels, lods, [&](std::size_t i, const std::string& name) {
            add(name + "_fruitbody", primitives[i], GlbRole::body);
            if (i < wood.size())
                add(name + "_wood", {{&wood[i], wood_material, {}, {}}}, GlbRole::carrier);
        });
}

}  // namespace

MaterialLook look_of(const Model& model) {
    const Material& material = model.material;
    const auto light = [](Colour colour) {
        return glm::dvec3(srgb_to_linear(colour.r / 255.0), srgb_to_linear(colour.g / 255.0),
                          srgb_to_linear(colour.b / 255.0));
    };
    glm::dvec3 skin(0.0);
    for (const Colour& colour : model.surface.cap.ramp)
        skin += light(colour) / static_cast<double>(model.surface.cap.ramp.size());
    MaterialLook look;
    // The coat is at most 0.7, because viewers lose light at the rim of a rough coat, as on a matt
    // stem.
    look.coat = 0.7 * (1.0 - (1.0 - material.slime) * (1.0 - 0.8 * model.weathering.wetness));
    look.sheen = material.velvet * (0.25 + 0.75 * skin);
    look.glow = model.ornaments.glow * light(material.glow_colour);
    return look;
}

Estimate estimate(const MushroomSpec& spec, const Atlas& atlas, const Caches& caches) {
    return estimate(spec, resolve(spec, atlas, caches.morphs));
}

Estimate estimate(const MushroomSpec& spec, const Individual& individual) {
    const MushroomParams& params = spec.params;
    const bool grows = params.animation != Animation::none;
    refuse_impossible(params);
    Estimate e;
    const std::vector<DetailLevel> levels = levels_in_file(spec, individual);
    for (const DetailLevel level : levels) {
        const MeshCount mesh = body_count(individual, level, grows);
        add_level(e, mesh.vertices, mesh.triangles, params.textures, params.file);
    }
    const std::uint64_t moved_vertices = e.vertices;
    for (const DetailLevel level : levels) {
        const MeshCount wood = wood_count(individual, level);
        if (wood.vertices > 0)
            add_level(e, wood.vertices, wood.triangles, params.textures, params.file);
    }
    const bool has_skin = textured(spec) && !levels.empty();
    const auto side = static_cast<std::uint64_t>(params.texture_size) >>
                      (levels.empty() ? 0 : levels.front().nearest());
    const std::uint64_t images = has_skin ? 3 * side * side : 0;
    std::uint64_t of_wood = 0;
    if (has_skin)
        if (const std::optional<WoodPaint> paint = wood_paint(spec, individual, levels.front()))
            of_wood = texels_of(*paint);
    e.texels = of_wood + images * static_cast<std::uint64_t>(atlases_held(spec));
    // Noisy paint takes about 1/3 byte per texel as JPEG.
    add_image_bytes(
        e, (of_wood + static_cast<std::uint64_t>(image_sets(params.variants)) * images) / 3,
        params.textures, params.file);
    if (has_skin) e.bytes += bytes_of_thinness(params.textures, params.file);
    add_solid_bytes(e, wood_behind(individual) ? 2 : 1, 0, params.file);
    if (has_impostor(params.lod, params.file)) add_impostor(e, params.texture_size, params.file);
    if (grows) {
        const auto frames = static_cast<std::uint64_t>(params.frames);
        const std::uint64_t moved = params.targets == Targets::position ? 12 : 24;
        e.bytes += moved_vertices * moved * frames + 600 * frames;
        e.vertices += moved_vertices * frames;
    }
    return e;
}

Mesh body_mesh(const Individual& individual, DetailLevel level, const SweepOptions& options) {
    return individual.is_branched() ? branched_mesh(individual, level, options)
                                    : swept_mesh(individual, level, options);
}

MeshCount body_count(const Individual& individual, DetailLevel level, bool keep_absent) {
    return individual.is_branched() ? branched_mesh_count(individual, level, keep_absent)
                                    : budget_of(individual, level).count;
}

Mesh mushroom_mesh(const MushroomSpec& spec, const Individual& individual) {
    return ordered_mesh(spec, individual, shown_level(spec, individual));
}

Bounds mushroom_bounds(const MushroomSpec& spec, const Individual& individual) {
    const Bounds box = bounds(mushroom_mesh(spec, individual));
    const std::optional<WoodPiece> piece = wood_behind(individual);
    if (!piece) return box;
    return united(box, bounds(wood_mesh(*piece, wood_lod(shown_level(spec, individual)), false)));
}

double outline_error(const Individual& individual, DetailLevel level, double radius) {
    if (!individual.is_branched()) {
        const Detail detail = detail_of(level);
        // The rings of a cap divide a quarter of a circle.
        return radius * (inscribed_error(detail.columns) + inscribed_error(4 * detail.cap_rings));
    }
    const BranchGraph& graph = individual.branch_graph;
    const BranchPlan plan = branch_plan(individual, graph, level);
    double tips = 0.0;
    for (const std::uint32_t root : graph.roots) tips += graph.nodes[root].tips;
    // Tubes that are left out leave gaps: n tips in a disc are about radius / sqrt(n) apart.
    const double gaps =
        radius * (1.0 / std::sqrt(static_cast<double>(plan.chains.size())) - 1.0 / std::sqrt(tips));
    return std::max(gaps, graph.trunk_radius * inscribed_error(plan.detail.trunk_sides));
}

std::vector<Level> levels_of(const MushroomSpec& spec, const Individual& individual,
                             const Bounds& box) {
    const bool grows = spec.params.animation != Animation::none;
    const double radius =
        0.5 * static_cast<double>(std::max(box.max.x - box.min.x, box.max.z - box.min.z));
    std::vector<Level> levels;
    std::vector<double> errors;
    const bool is_chain = spec.params.file.lods != Lods::single;
    for (const DetailLevel level :
         is_chain ? levels_in_file(spec, individual)
                  : levels_from(first_level(spec, individual), individual, grows)) {
        const MeshCount count = body_count(individual, level, grows),
                        wood = wood_count(individual, level);
        levels.push_back(
            {level, count.vertices + wood.vertices, count.triangles + wood.triangles, 0.0});
        errors.push_back(outline_error(individual, level, radius));
    }
    if (has_impostor(spec.params.lod, spec.params.file))
        add_impostor_level(levels, errors, box, spec.params.texture_size);
    set_coverages(levels, box, errors);
    return levels;
}

Mushroom grow_mushroom(const MushroomSpec& spec, const Atlas& atlas, const Extras& extras,
                       const ExecutionContext& execution) {
    execution.observer(Step::resolve);
    return grow_mushroom(spec, resolve(spec, atlas, execution.caches.morphs), atlas, extras,
                         execution);
}

Mushroom grow_mushroom(const MushroomSpec& spec, const Individual& individual, const Atlas& atlas,
                       const Extras& extras, const ExecutionContext& execution) {
    execution.observer(Step::build);
    const MushroomParams& params = spec.params;
    refuse_impossible(params);
    std::vector<Mesh> meshes = level_meshes(spec, individual, execution);
    const std::vector<Mesh> wood = wood_meshes(spec, individual);
    std::optional<Impostor> impostor;
    if (has_impostor(params.lod, params.file))
        impostor = impostor_of(
            [&](const Extras& drawing) {
                (void)grow_mushroom(impostor_source(spec), individual, atlas, drawing, execution);
            },
            frame_side_of(params.texture_size), params.file, execution);
    Wind wind{params.file.wind};
    if (wind.format != WindFormat::none) {
        const SwayingStem stem = swaying_stem(individual);
        wind.sway = displacement_of_top(stem);
        for (Mesh& mesh : meshes) mesh.sway = sway_of(mesh, stem);
        if (impostor) add_sway(*impostor, wind);
    }
    Collision collision;
    if (params.file.collision != CollisionFormat::none)
        collision = body_of(collision_shapes(individual));
    throw_if_cancelled(execution);
    const bool has_skin = !meshes.empty();
    const Mesh& first = has_skin ? meshes.front() : impostor->cards;
    Bounds box = has_skin ? bounds(first) : impostor->box;
    if (!wood.empty()) box = united(box, bounds(wood.front()));
    const MushroomSpec images_of = image_spec(spec, individual);
    std::vector<Level> levels = params.file.lods != Lods::single
                                    ? levels_of(spec, individual, box)
                                    : std::vector<Level>{{first_level(spec, individual)}};
    for (std::size_t i = 0; i < levels.size(); ++i) levels[i].name = level_name(spec, i);
    GlbScene scene;
    set_options(scene, params.file);
    if (has_skin)
        scene.materials.push_back(
            {.name = skin_name(images_of),
             .look = look_of(individual.model),
             .transmission = transmission_of(individual, params.file, execution)});
    scene.stands_on_ground = !individual.grows_from_wall();
    GrowthClip growth;
    if (params.animation == Animation::growth) {
        growth = growth_clip(spec, individual, atlas, first, execution);
        scene.clip = &growth.clip;
    }
    EmbeddedImages images;
    if (has_skin)
        images = attach_images(scene.materials.front(), params.textures, params.file,
                               extras.image_urls, execution, [&](ImageFormat format) {
                                   return painted_images(
                                       paint_spec_of(images_of, atlas, execution.caches), execution,
                                       format);
                               });
    const std::vector<EmbeddedImages> variant_images =
        add_variants(scene, variants_of(images_of, individual), params.textures, params.file,
                     extras, execution, [&](const MushroomSpec& painted) {
                         return paint_spec_of(painted, atlas, execution.caches);
                     });
    const std::size_t wood_material = scene.materials.size();
    EmbeddedImages images_of_wood;
    if (!wood.empty())
        images_of_wood = add_wood_material(scene, *wood_paint(spec, individual, levels.front().lod),
                                           params.textures, params.file, extras, execution);
    execution.observer(Step::pack);
    Mushroom grown;
    std::vector<std::vector<GlbPrimitive>> primitives;
    primitives.reserve(meshes.size() + 1);
    for (const Mesh& mesh : meshes)
        primitives.push_back({{&mesh, 0, growth.targets, variant_materials(scene)}});
    if (impostor)
        primitives.push_back(
            {{&impostor->cards, add_material(scene, *impostor, product_name(spec))}});
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const Mesh& mesh = *primitives[i].front().mesh;
        levels[i].vertices = mesh.positions.size();
        levels[i].triangles = mesh.triangles();
        if (i < wood.size()) {
            levels[i].vertices += wood[i].positions.size();
            levels[i].triangles += wood[i].triangles();
        }
        grown.vertices += levels[i].vertices;
        grown.triangles += levels[i].triangles;
    }
    add_levels(scene, spec, primitives, wood, wood_material, levels);
    scene.extras_json =
        dump(extras_value(extras, write(individual.effective), box, levels.front().triangles,
                          {levels, params.file.lods}, wind));
    add_collision(scene, collision, levels.front().name, params.file.collision);
    grown.glb = extras.write(scene, execution.parallel);
    return grown;
}

}  // namespace sporeprint
