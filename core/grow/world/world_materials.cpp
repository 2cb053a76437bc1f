#include "core/grow/world/world_materials.h"

#include <memory>

#include "core/grow/leaf.h"
#include "core/grow/mushroom.h"
#include "core/grow/names.h"
#include "core/grow/painting.h"
#include "core/grow/translucency.h"
#include "core/grow/tree.h"
#include "core/grow/wood.h"

namespace sporeprint {

std::size_t WorldMaterials::named(const std::string& name,
                                  const std::function<void(GlbMaterial&)>& set) {
    const auto [found, is_new] = known_.try_emplace(name, scene_.materials.size());
    if (is_new) {
        scene_.materials.push_back({.name = name});
        set(scene_.materials.back());
    }
    return found->second;
}

void WorldMaterials::attach(GlbMaterial& material, Textures textures,
                            const std::function<ImageUrls()>& urls, const Paint& paint) {
    images_.push_back(attach_images(material, textures, file_,
                                    has_addresses(textures) ? urls() : ImageUrls(), execution_,
                                    paint));
}

std::size_t WorldMaterials::plain(const std::string& name) {
    return named(name, [](GlbMaterial&) {});
}

std::size_t WorldMaterials::ground(const std::string& name,
                                   const std::function<ImageSet(ImageFormat)>& paint) {
    const Textures own = textures_ == Textures::none ? Textures::none : Textures::embedded;
    return named(name, [&](GlbMaterial& material) {
        attach(material, own, nullptr,
               [&](ImageFormat format) { return std::make_shared<const ImageSet>(paint(format)); });
    });
}

std::size_t WorldMaterials::bark(const TreeSpec& tree) {
    const TreePaint paint = paint_of(tree.params);
    return named(bark_name(tree.preset, paint, textures_), [&](GlbMaterial& material) {
        material.repeats_u = true;
        attach(
            material, textures_, [&] { return urls_.bark(tree); },
            [&](ImageFormat format) { return painted_images(paint, execution_, format); });
    });
}

std::size_t WorldMaterials::leaves(const std::string& name, const std::string& leaf,
                                   const LeafPaint& paint) {
    return named(leaf_material_name(name, paint, textures_), [&](GlbMaterial& material) {
        material.transmission = transmission_of_leaves(file_);
        material.alpha_cutoff = alpha_cutoff_of(paint);
        attach(
            material, textures_, [&] { return urls_.leaves(leaf, paint); },
            [&](ImageFormat format) {
                return painted_images(paint, execution_, format_in_files(paint, format));
            });
    });
}

std::vector<GlbPrimitive> WorldMaterials::tree(const TreeSpec& spec, const Mesh& bark_mesh,
                                               const Mesh& leaf_mesh) {
    std::vector<GlbPrimitive> primitives{{&bark_mesh, bark(spec), {}}};
    if (leaf_mesh.positions.empty()) return primitives;
    const std::string leaf = spec.params.look.leaf.id.string();
    primitives.push_back(
        {&leaf_mesh, leaves(leaf, leaf, paint_on_tree(leaf_of(spec.params, atlas_))), {}});
    return primitives;
}

std::size_t WorldMaterials::wood(const WoodPaint& paint) {
    return named(wood_name(paint, textures_), [&](GlbMaterial& material) {
        material.repeats_u = true;
        attach(
            material, textures_, [&] { return urls_.wood(paint); },
            [&](ImageFormat format) { return painted_images(paint, execution_, format); });
    });
}

std::size_t WorldMaterials::skin(const MushroomSpec& spec, const Individual& individual) {
    return named(skin_name(spec), [&](GlbMaterial& material) {
        material.look = look_of(individual.model);
        attach(
            material, textures_, [&] { return urls_.skin(spec); },
            [&](ImageFormat format) {
                return painted_images(paint_spec_of(spec, atlas_, execution_.caches), execution_,
                                      format);
            });
    });
}

}  // namespace sporeprint
