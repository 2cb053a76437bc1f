#include "core/grow/mushroom.h"

#include "core/geometry/branches.h"
#include "core/geometry/budget.h"
#include "core/gltf/glb.h"
#include "core/grow/growth.h"
#include "core/grow/painting.h"
#include "core/mesh/index_order.h"
#include "core/params/reader.h"

namespace sporeprint {

namespace {

bool textured(const MushroomSpec& spec) { return spec.params.textures != Textures::none; }

}  // namespace

std::string name_of(const Individual& individual) {
    const auto most = std::max_element(
        individual.parts.begin(), individual.parts.end(),
        [](const SpeciesShare& a, const SpeciesShare& b) { return a.weight < b.weight; });
    return most == individual.parts.end() || most->id.empty() ? "mushroom" : most->id;
}

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
    const bool grows = spec.params.animation != Animation::none;
    const MeshCount mesh = body_count(individual, spec.params.lod, grows);
    Estimate e;
    e.vertices = mesh.vertices;
    e.triangles = mesh.triangles;
    const auto side = static_cast<std::uint64_t>(spec.params.texture_size) >> spec.params.lod;
    const std::uint64_t images = textured(spec) ? 3 * side * side : 0;
    e.texels = images * static_cast<std::uint64_t>(atlases_held(spec));
    // Noisy paint takes about 1/3 byte per texel as JPEG.
    e.bytes = estimated_bytes(e.vertices, e.triangles, spec.params.textures, spec.params.file,
                              images / 3);
    if (grows) {
        const auto frames = static_cast<std::uint64_t>(spec.params.frames);
        e.bytes += e.vertices * 24 * frames + 600 * frames;
        e.vertices += e.vertices * frames;
    }
    return e;
}

Mesh body_mesh(const Individual& individual, int lod, const SweepOptions& options) {
    return individual.is_branched() ? branched_mesh(individual, lod, options)
                                    : swept_mesh(individual, lod, options);
}

MeshCount body_count(const Individual& individual, int lod, bool keep_absent) {
    return individual.is_branched() ? branched_mesh_count(individual.branch_graph, lod, keep_absent)
                                    : budget_of(individual, lod).count;
}

Mesh mushroom_mesh(const MushroomSpec& spec, const Individual& individual) {
    Mesh mesh = body_mesh(
        individual, spec.params.lod,
        {.textured = textured(spec), .keep_absent = spec.params.animation != Animation::none});
    order_for_vertex_cache(mesh);
    return mesh;
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
    const Mesh mesh = mushroom_mesh(spec, individual);
    throw_if_cancelled(execution);
    const std::string name = name_of(individual);
    GlbScene scene;
    set_options(scene, spec.params.file);
    scene.extras_json = extras_json(extras, write(individual.effective), mesh);
    scene.materials.push_back({.name = name, .look = look_of(individual.model)});
    scene.meshes.push_back({name, {{&mesh, 0, {}}}});
    scene.nodes.push_back({.name = name, .mesh = 0});
    GrowthClip growth;
    if (spec.params.animation == Animation::growth) {
        growth = growth_clip(spec, atlas, mesh, execution);
        scene.meshes[0].primitives[0].targets = growth.targets;
        scene.clip = &growth.clip;
    }
    const EmbeddedImages images = attach_images(
        scene.materials[0], spec.params.textures, spec.params.file, extras.image_urls, execution,
        [&](ImageFormat format) {
            return painted_images(paint_spec_of(spec, atlas, execution.caches), execution, format);
        });
    execution.observer(Step::pack);
    return {glb(scene), mesh.positions.size(), mesh.triangles()};
}

}  // namespace sporeprint
