#include "core/grow/colony_scene.h"

#include <utility>
#include <vector>

#include "core/colony/separation.h"
#include "core/grow/variants.h"
#include "core/math/direction.h"

namespace sporeprint {

namespace {

/// Adds one node for each member, or one instanced node for each model.
///
/// mesh_of  of each model
void add_member_nodes(GlbScene& scene, const Colony& colony,
                      const std::vector<std::size_t>& mesh_of) {
    const bool gpu = colony.effective.instancing == Instancing::gpu;
    std::vector<std::size_t> node_of(colony.models.size(), scene.nodes.max_size());
    std::size_t count = 0;
    for (const ColonyMember& member : colony.members) {
        const Pose& at = member.pose;
        const GlbTransform place{at.at, quaternion_of(at.turn), glm::dvec3(at.scale)};
        const std::size_t mesh = mesh_of[member.model];
        GlbNode node{.name = scene.meshes[mesh].name, .mesh = mesh};
        if (!gpu) {
            node.name += '_' + std::to_string(++count);
            node.translation = place.translation;
            node.rotation = place.rotation;
            node.scale = place.scale;
            scene.nodes.push_back(std::move(node));
            continue;
        }
        std::size_t& index = node_of[member.model];
        if (index == scene.nodes.max_size()) {
            index = scene.nodes.size();
            scene.nodes.push_back(std::move(node));
        }
        scene.nodes[index].instances.push_back(place);
    }
}

}  // namespace

void add_colony(GlbScene& scene, const Colony& colony, const Mesh& skin, const Mesh& wood,
                std::span<const Mesh> models, std::size_t wood_material, const std::string& name) {
    if (!wood.positions.empty()) {
        scene.nodes.push_back({.name = name + "_wood", .mesh = scene.meshes.size()});
        scene.meshes.push_back(
            {name + "_wood", {{&wood, wood_material, {}, {}}}, GlbRole::carrier});
    }
    if (!skin.positions.empty()) {
        const std::string own = name + (colony.has_stems ? "_stems" : "_ground");
        scene.nodes.push_back({.name = own, .mesh = scene.meshes.size()});
        scene.meshes.push_back({own, {{&skin, 0, {}, variant_materials(scene)}}, GlbRole::carrier});
    }
    std::vector<std::size_t> mesh_of(models.size(), 0);
    for (std::size_t i = 0; i < models.size(); ++i) {
        if (models[i].positions.empty()) continue;
        mesh_of[i] = scene.meshes.size();
        scene.meshes.push_back({name + "_individual" + std::to_string(i + 1),
                                {{&models[i], 0, {}, variant_materials(scene)}}});
    }
    add_member_nodes(scene, colony, mesh_of);
}

void add_cards(GlbScene& scene, const Impostor& impostor, const std::string& product,
               const std::string& name) {
    const std::size_t material = add_material(scene, impostor, product);
    scene.nodes.push_back({.name = name + "_cards", .mesh = scene.meshes.size()});
    scene.meshes.push_back({name + "_cards", {{&impostor.cards, material, {}}}});
}

}  // namespace sporeprint
