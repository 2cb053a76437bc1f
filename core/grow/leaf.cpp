#include "core/grow/leaf.h"

#include "core/gltf/glb.h"
#include "core/mesh/index_order.h"
#include "core/params/canonical.h"
#include "core/params/reader.h"
#include "core/plant/leaf_image.h"

namespace sporeprint {

namespace {

// Leaves are smooth between their veins: about 1/6 byte per texel as JPEG, plus the headers of
// three files.
std::uint64_t image_bytes(std::uint64_t texels) { return texels / 6 + 1500; }

}  // namespace

Estimate measured(const LeafSpec& spec, const Mesh& mesh) {
    Estimate e = estimate(spec);
    e.vertices = mesh.positions.size();
    e.triangles = mesh.triangles();
    e.bytes = estimated_bytes(e.vertices, e.triangles, spec.params.textures, spec.params.file,
                              image_bytes(e.texels));
    return e;
}

Estimate estimate(const LeafSpec& spec) {
    const LeafParams& params = spec.params;
    const LeafCount most = most_of_leaf(params.shape.venation, params.lod);
    const auto side = static_cast<std::uint64_t>(params.texture_size) >> params.lod;
    Estimate e;
    e.vertices = most.vertices;
    e.triangles = most.triangles;
    e.texels = params.textures == Textures::none ? 0 : 3 * side * side;
    e.bytes = estimated_bytes(e.vertices, e.triangles, params.textures, params.file,
                              image_bytes(e.texels));
    return e;
}

Mesh leaf_mesh(const LeafSpec& spec) {
    const LeafParams& params = spec.params;
    require_valid(params);
    Mesh mesh = leaf_mesh(shape_of(params), params.lod, params.size);
    if (params.textures == Textures::none) {
        mesh.texture_coordinates.clear();
        mesh.tangents.clear();
    }
    order_for_vertex_cache(mesh);
    return mesh;
}

std::string image_key(const LeafPaint& paint, ImageFormat format) {
    return key_of_format(format) + "leaf " + canonical_text(paint);
}

std::shared_ptr<const ImageSet> painted_images(const LeafPaint& paint,
                                               const ExecutionContext& execution,
                                               ImageFormat format) {
    require_valid(paint);
    return execution.caches.images(image_key(paint, format), [&] {
        LeafParams params;
        params.seed = paint.seed;
        params.variation = paint.variation;
        params.shape.relief = paint.relief;
        params.shape.venation = paint.venation;
        const RawImages images = leaf_images(shape_of(params), paint.palette, paint.autumn,
                                             paint.seed, paint.texture_size, execution.parallel);
        throw_if_cancelled(execution);
        return std::make_shared<const ImageSet>(encoded(images, format, execution.parallel));
    });
}

Grown grow_leaf(const LeafSpec& spec, const Extras& extras, const ExecutionContext& execution) {
    const LeafParams& params = spec.params;
    execution.observer(Step::build);
    const Mesh mesh = leaf_mesh(spec);
    throw_if_cancelled(execution);
    const std::string name = spec.preset.empty() ? "leaf" : spec.preset;
    GlbScene scene;
    set_options(scene, params.file);
    scene.extras_json = extras_json(extras, write(params), mesh);
    scene.materials.push_back({.name = name});
    scene.meshes.push_back({name, {{&mesh, 0, {}}}});
    scene.nodes.push_back({.name = name, .mesh = 0});
    const EmbeddedImages images = attach_images(
        scene.materials[0], params.textures, params.file, extras.image_urls, execution,
        [&](ImageFormat format) { return painted_images(paint_of(params), execution, format); });
    execution.observer(Step::pack);
    return {glb(scene), mesh.positions.size(), mesh.triangles()};
}

}  // namespace sporeprint
