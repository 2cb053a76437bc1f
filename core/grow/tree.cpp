#include "core/grow/tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/gltf/glb.h"
#include "core/grow/collision.h"
#include "core/grow/impostor.h"
#include "core/grow/leaf.h"
#include "core/grow/names.h"
#include "core/grow/translucency.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/mesh/detail.h"
#include "core/mesh/index_order.h"
#include "core/params/canonical.h"
#include "core/params/messages.h"
#include "core/params/reader.h"
#include "core/plant/crown_shade.h"
#include "core/plant/foliage.h"
#include "core/plant/foot_soil.h"
#include "core/plant/leaf_shell.h"
#include "core/plant/root_flare.h"
#include "core/plant/tree_sway.h"
#include "core/plant/tree_tints.h"

namespace sporeprint {

namespace {

// Bytes of the tint of a vertex, and of that of an instance.
constexpr std::uint64_t bytes_of_tint = 4, bytes_of_instance_tint = 12;

// How far the foliage of each far level differs in hue from clump to clump: two clumps that differ
// would be a tree of two species.
constexpr std::array<double, far_lods> far_tints = {1.0, 0.5, 0.0};

// Factor of the base colour of the foliage of each far level: clumps have no leaves that shade each
// other. Measured on pictures of the presets; dense crowns would need less, open ones more.
constexpr std::array<float, far_lods> far_shades = {1.0F, 0.77F, 0.74F};

// One seed for the images of bark, so that all trees of a style share them.
constexpr std::uint32_t bark_seed = 1;

// Bark is rough: 1/4 byte per texel as JPEG; leaves are smoother. 1/5 is between both.
std::uint64_t image_bytes(std::uint64_t texels) { return texels / 5 + 3000; }

std::uint64_t texels_of(const TreeParams& params) {
    const auto side =
        static_cast<std::uint64_t>(params.texture_size) >> std::min(params.lod, last_lod);
    const std::uint64_t kinds = params.look.leaves.per_tip > 0 ? 2 : 1;
    const bool has_images = params.textures != Textures::none && params.lod != impostor_lod;
    return has_images ? kinds * 3 * side * side : 0;
}

/// Returns whether vertices have tints: where images are coloured, and colours are not the weights of
/// wind.
bool has_tints(const TreeParams& params) {
    const bool has_hues = params.look.leaves.hue_spread > 0.0 || params.lod >= first_far_lod;
    return has_hues && params.textures != Textures::none && params.file.wind != WindFormat::color;
}

void finish(Mesh& mesh, const TreeParams& params) {
    for (glm::vec3& place : mesh.positions) place *= static_cast<float>(params.size);
    if (params.textures == Textures::none) {
        mesh.texture_coordinates.clear();
        mesh.tangents.clear();
    }
    order_for_vertex_cache(mesh);
}

/// Returns the levels of detail of a file that are meshes: those that end with the last common one,
/// or the far ones.
std::vector<int> mesh_levels_of(const TreeParams& params) {
    if (params.lod < first_far_lod) return levels_in_file(params.lod, params.file);
    std::vector<int> levels{params.lod};
    while (params.file.lods != Lods::single && levels.back() < last_far_lod)
        levels.push_back(levels.back() + 1);
    return levels;
}

// Throws Impossible if parameters, each of them in range, together exceed the bounds of a skeleton.
void refuse_beyond_bounds(const Tree& tree) {
    const std::vector<Problem> problems = validation_errors(tree.skeleton);
    if (problems.empty()) return;
    const bool of_radius = problems.front().path.ends_with("/radius");
    throw Impossible(
        of_radius ? "/twig_radius" : "/twig_length",
        std::string(of_radius ? "the radius" : "the place") +
            " of a branch would be out of bounds, for its order makes so much of it: " +
            problems.front().message);
}

/// The colours of a crown: hues of leaves and bark, and the shade between leaves.
struct CrownColour {
    TreeTints tints;
    CrownShade shade;

    CrownColour(const Tree& tree, double hue_spread, std::uint32_t seed)
        : tints(tree, hue_spread, seed), shade(tree) {}
};

/// Adds leaves as the request repeats them.
///
/// sway   of the tree; null for leaves without it
/// colour  of the tree; null for leaves of one hue, which have no shade
void add_leaves(TreeMeshes& meshes, Foliage foliage, const TreeParams& params, const TreeSway* sway,
                const CrownColour* colour) {
    if (foliage.leaves.empty()) return;
    double share = 1.0;
    float shade = 1.0F;
    if (params.lod >= first_far_lod) {
        share = far_tints[static_cast<std::size_t>(params.lod - first_far_lod)];
        shade = far_shades[static_cast<std::size_t>(params.lod - first_far_lod)];
    }
    if (params.instancing == LeafInstancing::gpu) {
        for (const PlacedLeaf& one : foliage.leaves)
            meshes.places.push_back(
                {params.size * one.place,
                 quaternion_of({glm::cross(one.up, one.along), one.up, one.along}),
                 one.size * glm::dvec3(one.breadth, one.thickness, 1.0),
                 colour ? shade * static_cast<float>(colour->shade.at(one.place)) *
                              colour->tints.of_leaf(one, share)
                        : glm::vec3(1.0F)});
        meshes.leaves = std::move(foliage.leaf);
    } else {
        meshes.leaves = merged_leaves(foliage.leaves, foliage.leaf);
        if (sway) meshes.leaves.sway = sway_of(foliage.leaves, foliage.leaf, *sway);
        if (colour) {
            const std::size_t corners = foliage.leaf.positions.size();
            meshes.leaves.tints = tints_of(foliage.leaves, corners, colour->tints, share);
            auto tint = meshes.leaves.tints.begin();
            for (const PlacedLeaf& one : foliage.leaves) {
                const float light = shade * static_cast<float>(colour->shade.at(one.place));
                for (std::size_t i = 0; i < corners; ++i) *tint++ *= light;
            }
        }
    }
    finish(meshes.leaves, params);
}

/// Returns how black the fissures at the foot of a trunk are: most under pale bark that peels.
double blackness_of_foot(const BarkStyle& bark) {
    return std::min(0.95, 0.3 + 1.3 * bark.lenticels);
}

/// Returns the light that bark reflects on average, linear.
glm::vec3 mean_light_of(const BarkStyle& bark) {
    const auto mean = [&](std::uint8_t ridge, std::uint8_t furrow) {
        const double high = srgb_to_linear(ridge / 255.0), low = srgb_to_linear(furrow / 255.0);
        return static_cast<float>(high + 0.4 * bark.furrows * (low - high));
    };
    return {mean(bark.ridge.r, bark.furrow.r), mean(bark.ridge.g, bark.furrow.g),
            mean(bark.ridge.b, bark.furrow.b)};
}

// Throws Impossible for options that exclude each other, also those of trees alone.
void refuse_impossible(const TreeParams& params) {
    refuse_impossible(params.file, params.textures);
    refuse_impossible_impostor(params.lod, params.file, params.textures);
    if (params.lod >= first_far_lod && params.file.impostor)
        throw Impossible("/impostor", "an impostor comes before lod=" + std::to_string(params.lod) +
                                          "; ask for impostor=false, or for lod=" +
                                          std::to_string(last_lod) + " or less");
    if (params.instancing == LeafInstancing::gpu && params.file.wind != WindFormat::none)
        throw Impossible("/instancing",
                         "'gpu' repeats one leaf without the weights of wind, which differ from "
                         "leaf to leaf; ask for instancing=none, or for wind=none");
}

void add_images(Estimate& e, const TreeParams& params) {
    e.texels = texels_of(params);
    if (e.texels > 0) add_image_bytes(e, image_bytes(e.texels), params.textures, params.file);
    if (has_impostor(params.lod, params.file)) add_impostor(e, params.texture_size, params.file);
}

/// The counts of a tree at a level of detail.
struct LevelCount {
    MeshCount bark;
    std::uint64_t leaves = 0;
    MeshCount leaf;  ///< of each

    /// Returns the vertices in the file and the triangles that are drawn.
    [[nodiscard]] MeshCount total(LeafInstancing instancing) const {
        const std::uint64_t stored = instancing == LeafInstancing::gpu ? leaves > 0 : leaves;
        return {bark.vertices + stored * leaf.vertices, bark.triangles + leaves * leaf.triangles};
    }
};

/// Returns the expected counts at a level of detail.
///
/// all  number of leaves at LOD 0
LevelCount expected_count(const TreeParams& params, int lod, double all) {
    const auto placed = static_cast<std::size_t>(std::ceil(all));
    if (lod >= first_far_lod) {
        const FarCount far = far_count(lod - first_far_lod, placed);
        return {{far.spikes * FarCount::spike_vertices, far.spikes * FarCount::spike_triangles},
                far.leaves,
                {far.leaf_vertices, far.leaf_triangles}};
    }
    TreeCount bark = count_of_bark(params.look.shape, lod);
    const TreeCount soil =
        params.foot_soil ? count_of_foot_soil(params.look.shape, lod) : TreeCount{};
    for (const TreeCount& foot : {count_of_flare(params.look.shape, lod), soil}) {
        bark.vertices += foot.vertices;
        bark.triangles += foot.triangles;
    }
    const std::uint64_t triangles = leaf_triangles(lod, placed);
    return {{static_cast<std::uint64_t>(bark.vertices), static_cast<std::uint64_t>(bark.triangles)},
            foliage_count(lod, placed),
            {lod == 0 ? finest_leaf_vertices(triangles) : leaf_vertices(triangles), triangles}};
}

/// Adds a level of detail to the size of a file.
void add_level(Estimate& e, const TreeParams& params, const LevelCount& count) {
    const MeshCount total = count.total(params.instancing);
    const bool is_instanced = params.instancing == LeafInstancing::gpu;
    const std::uint64_t stored =
        is_instanced ? count.bark.triangles + count.leaf.triangles : total.triangles;
    add_level(e, total.vertices, stored, params.textures, params.file);
    if (has_tints(params))
        e.bytes += is_instanced
                       ? bytes_of_tint * count.bark.vertices + bytes_of_instance_tint * count.leaves
                       : bytes_of_tint * total.vertices;
    e.triangles += total.triangles - stored;
    if (is_instanced) e.bytes += 1000 + count.leaves * bytes_of_instance(params.file);
}

/// Returns the counts of meshes that are built.
LevelCount count_of(const TreeMeshes& meshes) {
    const bool is_instanced = !meshes.places.empty();
    return {{meshes.bark.positions.size(), meshes.bark.triangles()},
            is_instanced ? meshes.places.size() : 1,
            {meshes.leaves.positions.size(), meshes.leaves.triangles()}};
}

/// Adds the meshes and nodes of a level of detail whose leaves are instanced.
///
/// name  level_name()
void add_instanced(GlbScene& scene, const TreeMeshes& meshes, const std::string& name) {
    scene.nodes.push_back({.name = name + "_bark", .mesh = scene.meshes.size()});
    scene.meshes.push_back({name + "_bark", {{&meshes.bark, 0, {}}}});
    if (meshes.places.empty()) return;
    scene.nodes.push_back(
        {.name = name + "_leaves", .mesh = scene.meshes.size(), .instances = meshes.places});
    scene.meshes.push_back({name + "_leaf", {{&meshes.leaves, 1, {}}}, GlbRole::foliage});
}

/// Adds the mesh and the node of an impostor.
void add_cards(GlbScene& scene, const std::vector<GlbPrimitive>& cards, const std::string& name) {
    scene.nodes.push_back({.name = name + "_cards", .mesh = scene.meshes.size()});
    scene.meshes.push_back({name + "_cards", cards, GlbRole::foliage});
}

/// Returns the wind of a tree of which no mesh is built.
Wind wind_of(const TreeSpec& spec, const Atlas& atlas) {
    TreeSpec bare = spec;
    bare.params.lod = last_lod;
    return spec.params.file.wind == WindFormat::none ? Wind{} : tree_meshes(bare, atlas).wind;
}

// Distance of the outlines of far levels from the true one, in the longest side of a tree: a pixel of
// pictures of so many pixels in which they differ by a tenth, a sixth and a fifth.
constexpr std::array<double, far_lods> far_errors = {1.0 / 40.0, 1.0 / 20.0, 1.0 / 10.0};

/// Returns about how far the outline of a crown is from the true one: by how much a leaf in place of
/// others reaches farther than they, and one of few triangles differs from its own outline, or, on a
/// bare tree, the length of the longest edges that are left out; metres. Where that is a pixel, the
/// silhouettes of the presets differ by a tenth, those of conifers at the coarsest level by an eighth.
///
/// box  of the tree, metres
double crown_error(const TreeParams& params, const Atlas& atlas, int lod, double leaves,
                   const Bounds& box) {
    if (lod >= first_far_lod) {
        const glm::vec3 size = box.max - box.min;
        return far_errors[static_cast<std::size_t>(lod - first_far_lod)] *
               static_cast<double>(std::max({size.x, size.y, size.z}));
    }
    if (leaves > 0.0) {
        const double length =
            params.size * params.look.leaves.leaf_size * leaf_of(params, atlas).shape.length;
        const auto placed = static_cast<std::size_t>(std::ceil(leaves));
        const double remaining = static_cast<double>(foliage_count(lod, placed)) / leaves;
        const auto triangles = static_cast<double>(leaf_triangles(lod, placed));
        return 0.5 * length * (1.0 / std::sqrt(remaining) - 1.0 + 1.0 / triangles);
    }
    const std::vector<ExpectedOrder> orders = expected_orders(params.look.shape);
    double longest = 0.0;
    for (std::size_t i = 0; i < std::min(orders.size(), static_cast<std::size_t>(lod)); ++i)
        longest = std::max(longest, orders[i].length);
    return params.size * longest;
}

}  // namespace

TreeSpec at_level(TreeSpec spec) {
    TreeParams& params = spec.params;
    if (!params.triangles) return spec;
    const int wanted = *params.triangles;
    params.triangles.reset();
    static_cast<void>(estimate(spec));  // throws if the tree is too large
    const double leaves = expected_tips(params.look.shape.topology) * params.look.leaves.per_tip;
    const auto count_at = [&](int lod) {
        return static_cast<double>(
            expected_count(params, lod, leaves).total(params.instancing).triangles);
    };
    const auto off = [&](int lod) {
        const double count = count_at(lod), target = wanted;
        return std::max(count, target) / std::min(count, target);
    };
    params.lod = nearest_level(wanted, count_at);
    for (int lod = first_far_lod; lod <= last_far_lod; ++lod)
        if (!params.file.impostor && off(lod) < off(params.lod)) params.lod = lod;
    return spec;
}

Estimate measured(const TreeSpec& spec, std::span<const TreeMeshes> levels) {
    if (spec.params.triangles) return measured(at_level(spec), levels);
    const TreeParams& params = spec.params;
    Estimate e;
    for (const TreeMeshes& meshes : levels) add_level(e, params, count_of(meshes));
    add_images(e, params);
    add_solid_bytes(e, 0, most_trunk_capsules, params.file);
    return e;
}

Estimate estimate(const TreeSpec& spec) {
    if (spec.params.triangles) return estimate(at_level(spec));
    const TreeParams& params = spec.params;
    const TreeLook& look = params.look;
    refuse_impossible(params);
    const double tips = expected_tips(look.shape.topology);
    if (tips > static_cast<double>(most_tips))
        throw Impossible("/order", "the tree would have about " +
                                       number_text(std::floor(tips + 0.5)) + " twigs; at most " +
                                       std::to_string(most_tips) + " are grown");
    const double all = tips * look.leaves.per_tip;
    if (all > static_cast<double>(most_leaves))
        throw Impossible("/leaves/per_tip", std::to_string(look.leaves.per_tip) + " make about " +
                                                number_text(std::floor(all + 0.5)) + " leaves on " +
                                                number_text(std::floor(tips + 0.5)) +
                                                " twigs; at most " + std::to_string(most_leaves) +
                                                " are placed");
    // The number of twigs varies with the seed: a standard deviation of a Poisson process above its
    // mean, which matters for herbs alone.
    const double most = (tips + std::sqrt(tips)) * look.leaves.per_tip;
    Estimate e;
    for (const int lod : mesh_levels_of(params))
        add_level(e, params, expected_count(params, lod, most));
    add_images(e, params);
    add_solid_bytes(e, 0, most_trunk_capsules, params.file);
    return e;
}

std::vector<Level> levels_of(const TreeSpec& spec, const Atlas& atlas, const Bounds& box) {
    if (spec.params.triangles) return levels_of(at_level(spec), atlas, box);
    static_cast<void>(estimate(spec));  // throws if the tree is too large
    const TreeParams& params = spec.params;
    const double leaves = expected_tips(params.look.shape.topology) * params.look.leaves.per_tip;
    std::vector<Level> levels;
    std::vector<double> errors;
    const int last = params.lod < first_far_lod ? last_lod : last_far_lod;
    for (int lod = params.lod; lod <= last; ++lod) {
        const MeshCount count = expected_count(params, lod, leaves).total(params.instancing);
        levels.push_back({lod, count.vertices, count.triangles, 0.0});
        errors.push_back(crown_error(params, atlas, lod, leaves, box));
    }
    if (has_impostor(params.lod, params.file))
        add_impostor_level(levels, errors, box, params.texture_size);
    set_coverages(levels, box, errors);
    return levels;
}

LeafParams leaf_of(const TreeParams& params, const Atlas& atlas) {
    if (const LeafPreset* preset = atlas.find_leaf(params.look.leaf.id))
        return leaf_of(params, *preset);
    IdChoice among_all = params.look.leaf;
    among_all.among = atlas.leaf_ids();
    throw InvalidInput("/leaf", not_allowed_message(in_quotes(params.look.leaf.id), among_all));
}

TreeMeshes tree_meshes(const TreeSpec& spec, const Atlas& atlas) {
    TreeSpec alone = spec;
    alone.params.file.lods = Lods::single;
    alone.params.file.impostor = false;
    if (alone.params.lod == impostor_lod) alone.params.lod = impostor_source_lod;
    return std::move(level_meshes(alone, atlas).front());
}

std::vector<TreeMeshes> level_meshes(const TreeSpec& spec, const Atlas& atlas) {
    TreeParams params = spec.params;
    require_valid(params);
    if (params.triangles) return level_meshes(at_level(spec), atlas);
    const LeafParams leaf = leaf_of(params, atlas);
    static_cast<void>(estimate(spec));  // throws if the tree is too large
    const Tree tree = grown_tree(params.look.shape, params.seed);
    refuse_beyond_bounds(tree);
    std::optional<TreeSway> sway;
    Wind wind{params.file.wind};
    if (wind.format != WindFormat::none) {
        sway.emplace(tree);
        wind.sway = tree_sway * params.size * sway->reach();
        wind.flutter =
            leaf_flutter * params.size * params.look.leaves.leaf_size * leaf.shape.length;
    }
    std::optional<CrownColour> colour;
    if (has_tints(params)) colour.emplace(tree, params.look.leaves.hue_spread, params.seed);
    const double flare = params.look.shape.root_flare;
    std::vector<TreeMeshes> levels;
    for (const int lod : mesh_levels_of(params)) {
        params.lod = lod;
        Bark bark;
        Foliage foliage;
        std::size_t of_soil = 0;
        if (lod >= first_far_lod) {
            FarTree far = far_tree(tree, params.look.leaves, shape_of(leaf), params.seed,
                                   lod - first_far_lod);
            bark = std::move(far.bark);
            foliage = std::move(far.foliage);
        } else {
            bark = bark_of(tree, lod);
            if (!params.foot_soil) plant_foot(bark, tree);
            flare_roots(bark, tree, flare, params.seed, lod);
            if (params.foot_soil) of_soil = add_foot_soil(bark, tree, flare, params.seed, lod);
            foliage = foliage_of(tree, params.look.leaves, shape_of(leaf), params.seed, lod);
        }
        if (sway) bark.mesh.sway = sway_of(bark, *sway);
        if (colour) bark.mesh.tints = tints_of(bark, colour->tints);
        if (colour && lod < first_far_lod)
            tint_foot(bark.mesh.tints, bark, tree, flare, params.seed, of_soil,
                      blackness_of_foot(params.look.bark), mean_light_of(params.look.bark));
        TreeMeshes meshes{std::move(bark.mesh), {}, {}, wind};
        finish(meshes.bark, params);
        add_leaves(meshes, std::move(foliage), params, sway ? &*sway : nullptr,
                   colour ? &*colour : nullptr);
        levels.push_back(std::move(meshes));
    }
    return levels;
}

Bounds bounds(const TreeMeshes& meshes) {
    Bounds box = bounds(meshes.bark);
    const auto add = [&](const glm::vec3& at) {
        box.min = glm::min(box.min, at);
        box.max = glm::max(box.max, at);
    };
    if (meshes.places.empty())
        for (const glm::vec3& at : meshes.leaves.positions) add(at);
    for (const GlbTransform& place : meshes.places)
        for (const glm::vec3& at : meshes.leaves.positions)
            add(glm::vec3(place.translation +
                          rotated(place.rotation, place.scale * glm::dvec3(at))));
    return box;
}

std::string image_key(const TreePaint& paint, ImageFormat format) {
    return key_of_format(format) + "bark " + canonical_text(paint);
}

std::shared_ptr<const ImageSet> painted_images(const TreePaint& paint,
                                               const ExecutionContext& execution,
                                               ImageFormat format) {
    require_valid(paint);
    return execution.caches.images(image_key(paint, format), [&] {
        const RawImages images =
            bark_images(paint.bark, bark_seed, paint.texture_size, execution.parallel);
        throw_if_cancelled(execution);
        return std::make_shared<const ImageSet>(encoded(images, format, execution.parallel));
    });
}

Grown grow_tree(const TreeSpec& spec, const Atlas& atlas, const Extras& extras,
                const ImageUrls& leaf_urls, const ExecutionContext& execution) {
    if (spec.params.triangles)
        return grow_tree(at_level(spec), atlas, extras, leaf_urls, execution);
    const TreeParams& params = spec.params;
    execution.observer(Step::build);
    const std::vector<TreeMeshes> meshes = level_meshes(spec, atlas);
    throw_if_cancelled(execution);
    std::optional<Impostor> impostor;
    if (has_impostor(params.lod, params.file))
        impostor = impostor_of(
            [&](const Extras& drawing) {
                (void)grow_tree(impostor_source(spec), atlas, drawing, {}, execution);
            },
            frame_side_of(params.texture_size), params.file, execution);
    const bool has_meshes = !meshes.empty();
    const bool leafy = has_meshes && !meshes.front().leaves.positions.empty();
    const Wind wind = has_meshes ? meshes.front().wind : wind_of(spec, atlas);
    if (impostor && wind.format != WindFormat::none) add_sway(*impostor, wind);
    GlbScene scene;
    set_options(scene, params.file);
    EmbeddedImages bark_images;
    if (has_meshes) {
        scene.materials.push_back(
            {.name = bark_name(spec.preset, paint_of(params), params.textures), .repeats_u = true});
        bark_images = attach_images(scene.materials[0], params.textures, params.file,
                                    extras.image_urls, execution, [&](ImageFormat format) {
                                        return painted_images(paint_of(params), execution, format);
                                    });
    }
    EmbeddedImages leaf_images;
    if (leafy) {
        const LeafPaint paint = paint_on_tree(leaf_of(params, atlas));
        scene.materials.push_back(
            {.name = leaf_material_name(params.look.leaf.id.string(), paint, params.textures),
             .transmission = transmission_of_leaves(params.file),
             .alpha_cutoff = alpha_cutoff_of(paint)});
        leaf_images = attach_images(scene.materials[1], params.textures, params.file, leaf_urls,
                                    execution, [&](ImageFormat format) {
                                        return painted_images(paint, execution,
                                                              format_in_files(paint, format));
                                    });
    }
    execution.observer(Step::pack);
    const Bounds box = has_meshes ? bounds(meshes.front()) : impostor->box;
    const bool is_chain = params.file.lods != Lods::single;
    std::vector<Level> levels =
        is_chain ? levels_of(spec, atlas, box) : std::vector<Level>{{params.lod}};
    Grown grown;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        grown.vertices += levels[i].vertices = meshes[i].vertices();
        grown.triangles += levels[i].triangles = meshes[i].triangles();
    }
    std::vector<GlbPrimitive> cards;
    if (impostor) {
        cards.push_back(
            {&impostor->cards, add_material(scene, *impostor, product_name(spec, atlas))});
        grown.vertices += impostor->cards.positions.size();
        grown.triangles += impostor->cards.triangles();
    }
    if (params.instancing == LeafInstancing::gpu && has_meshes) {
        add_grouped_levels(scene, product_name(spec, atlas), levels, params.file.lods,
                           [&](std::size_t i, const std::string& name) {
                               if (i < meshes.size())
                                   add_instanced(scene, meshes[i], name);
                               else
                                   add_cards(scene, cards, name);
                           });
    } else {
        std::vector<std::vector<GlbPrimitive>> primitives;
        primitives.reserve(meshes.size());
        for (const TreeMeshes& level : meshes) {
            primitives.push_back({{&level.bark, 0, {}}});
            if (leafy) primitives.back().push_back({&level.leaves, 1, {}});
        }
        if (impostor) primitives.push_back(cards);
        add_levels(scene, product_name(spec, atlas), primitives, levels, params.file.lods);
    }
    const std::size_t triangles =
        has_meshes ? meshes.front().triangles() : impostor->cards.triangles();
    scene.extras_json =
        dump(extras_value(extras, write(params), box, triangles, {levels, params.file.lods}, wind));
    Collision collision;
    if (params.file.collision != CollisionFormat::none) collision = trunk_collision(spec);
    add_collision(scene, collision, level_name(product_name(spec, atlas), params.lod),
                  params.file.collision);
    grown.glb = extras.write(scene, execution.parallel);
    return grown;
}

}  // namespace sporeprint
