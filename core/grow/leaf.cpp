#include "core/grow/leaf.h"

#include <array>

#include "core/gltf/glb.h"
#include "core/grow/names.h"
#include "core/grow/translucency.h"
#include "core/mesh/index_order.h"
#include "core/params/canonical.h"
#include "core/params/reader.h"
#include "core/plant/leaf_image.h"
#include "core/plant/tree_sway.h"

namespace sporeprint {

namespace {

// Leaves are smooth between their veins: about 1/6 byte per texel as JPEG, plus the headers of
// three files.
std::uint64_t image_bytes(std::uint64_t texels) { return texels / 6 + 1500; }

void add_images(Estimate& e, const LeafParams& params) {
    const auto side = static_cast<std::uint64_t>(params.texture_size) >> params.lod;
    e.texels = params.textures == Textures::none ? 0 : 3 * side * side;
    // A PNG file with alpha has about 0.9 byte per texel of its own.
    const bool is_png = e.texels > 0 && has_alpha(paint_of(params));
    const std::uint64_t alpha = is_png ? 3 * e.texels / 10 : 0;
    add_image_bytes(e, image_bytes(e.texels) + alpha, params.textures, params.file);
}

/// Estimated distance of the border of a level of detail from that of LOD 0, in lengths of the
/// lamina: about that of the presets at LOD 1 and 2; at LOD 3 that of teeth and lobes.
constexpr std::array<double, 4> border_errors = {0.0, 0.01, 0.03, 0.1};

void refuse_impostor(const FileOptions& file) {
    if (file.impostor)
        throw Impossible("/impostor",
                         "'true' is impossible: a leaf has no impostor; ask for false");
}

void refuse_collision(const FileOptions& file) {
    if (file.collision != CollisionFormat::none)
        throw Impossible("/collision", std::string("'") + name(file.collision) +
                                           "' is impossible: a leaf has no solid; ask for none");
}

/// Returns the mesh of each level of detail of a file, finest first.
std::vector<Mesh> level_meshes(LeafSpec spec) {
    require_valid(spec.params);
    std::vector<Mesh> meshes;
    for (const int lod : levels_in_file(spec.params.lod, spec.params.file)) {
        spec.params.lod = lod;
        meshes.push_back(leaf_mesh(spec));
    }
    return meshes;
}

/// Returns the levels of detail that have these meshes.
std::vector<Level> sized_levels(const LeafParams& params, std::span<const Mesh> meshes) {
    std::vector<Level> levels;
    std::vector<double> errors;
    for (const Mesh& mesh : meshes) {
        const int lod = params.lod + static_cast<int>(levels.size());
        levels.push_back({lod, mesh.positions.size(), mesh.triangles(), 0.0});
        errors.push_back(border_errors[static_cast<std::size_t>(lod)] * params.shape.length *
                         params.size);
    }
    set_coverages(levels, bounds(meshes.front()), errors);
    return levels;
}

}  // namespace

LeafSpec at_level(LeafSpec spec) {
    LeafParams& params = spec.params;
    if (!params.triangles) return spec;
    params.lod = nearest_level(*params.triangles, [&](int lod) {
        return static_cast<double>(most_of_leaf(params.shape, lod).triangles);
    });
    params.triangles.reset();
    return spec;
}

Estimate measured(const LeafSpec& spec, std::span<const Level> levels) {
    if (spec.params.triangles) return measured(at_level(spec), levels);
    const LeafParams& params = spec.params;
    Estimate e;
    for (const Level& level : levels.first(levels_in_file(params.lod, params.file).size()))
        add_level(e, level.vertices, level.triangles, params.textures, params.file);
    add_images(e, params);
    return e;
}

Estimate estimate(const LeafSpec& spec) {
    if (spec.params.triangles) return estimate(at_level(spec));
    const LeafParams& params = spec.params;
    refuse_collision(params.file);
    refuse_impostor(params.file);
    refuse_impossible(params.file, params.textures);
    Estimate e;
    for (const int lod : levels_in_file(params.lod, params.file)) {
        const LeafCount most = most_of_leaf(params.shape, lod);
        add_level(e, most.vertices, most.triangles, params.textures, params.file);
    }
    add_images(e, params);
    return e;
}

std::vector<Level> levels_of(const LeafSpec& spec) {
    if (spec.params.triangles) return levels_of(at_level(spec));
    LeafSpec all = spec;
    all.params.file.lods = Lods::nodes;
    return sized_levels(spec.params, level_meshes(all));
}

Mesh leaf_mesh(const LeafSpec& spec) {
    const LeafParams& params = spec.params;
    require_valid(params);
    if (params.triangles) return leaf_mesh(at_level(spec));
    Mesh mesh = leaf_mesh(shape_of(params), params.lod, params.size, params.seed);
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

bool has_alpha(const LeafPaint& paint) { return paint.sprays || has_shoot(paint.venation); }

ImageFormat format_in_files(const LeafPaint& paint, ImageFormat format) {
    return format == ImageFormat::jpg && has_alpha(paint) ? ImageFormat::png : format;
}

double alpha_cutoff_of(const LeafPaint& paint) {
    return has_alpha(paint) ? leaf_alpha_cutoff : 0.0;
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
        params.shape.eaten = paint.eaten;
        params.shape.venation = paint.venation;
        LeafPalette palette = paint.palette;
        palette.summer = unfolding(palette.summer, paint.spring);
        const RawImages images =
            leaf_images(shape_of(params), palette, paint.autumn, paint.seed, paint.texture_size,
                        paint.sprays ? LeafLayout::with_sprays : LeafLayout::alone, paint.snow,
                        execution.parallel);
        throw_if_cancelled(execution);
        return std::make_shared<const ImageSet>(encoded(images, format, execution.parallel));
    });
}

Grown grow_leaf(const LeafSpec& spec, const Atlas& atlas, const Extras& extras,
                const ExecutionContext& execution) {
    if (spec.params.triangles) return grow_leaf(at_level(spec), atlas, extras, execution);
    const LeafParams& params = spec.params;
    refuse_collision(params.file);
    refuse_impostor(params.file);
    refuse_impossible(params.file, params.textures);
    execution.observer(Step::build);
    std::vector<Mesh> meshes = level_meshes(spec);
    Wind wind{params.file.wind};
    if (wind.format != WindFormat::none) {
        const double length = params.shape.length * params.size;
        wind.sway = leaf_sway * length;
        wind.flutter = leaf_flutter * length;
        for (Mesh& mesh : meshes)
            for (const float share : flutter_of(mesh))
                mesh.sway.push_back({.bend = share, .flutter = share});
    }
    throw_if_cancelled(execution);
    const std::vector<Level> levels = sized_levels(params, meshes);
    GlbScene scene;
    scene.stands_on_ground = false;
    set_options(scene, params.file);
    const LeafPaint paint = paint_of(params);
    scene.materials.push_back({.name = leaf_material_name(spec.preset, paint, params.textures),
                               .transmission = transmission_of_leaves(params.file),
                               .alpha_cutoff = alpha_cutoff_of(paint)});
    const EmbeddedImages images =
        attach_images(scene.materials.front(), params.textures, params.file, extras.image_urls,
                      execution, [&](ImageFormat format) {
                          return painted_images(paint, execution, format_in_files(paint, format));
                      });
    execution.observer(Step::pack);
    Grown grown;
    std::vector<std::vector<GlbPrimitive>> primitives;
    for (const Mesh& mesh : meshes) {
        primitives.push_back({{&mesh, 0, {}}});
        grown.vertices += mesh.positions.size();
        grown.triangles += mesh.triangles();
    }
    add_levels(scene, product_name(spec, atlas), primitives, levels, params.file.lods);
    scene.extras_json =
        dump(extras_value(extras, write(params), bounds(meshes.front()), meshes.front().triangles(),
                          {levels, params.file.lods}, wind));
    grown.glb = extras.write(scene, execution.parallel);
    return grown;
}

}  // namespace sporeprint
