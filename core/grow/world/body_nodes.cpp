#include "core/grow/world/body_nodes.h"

#include <string>
#include <utility>

#include "core/grow/world/mesh_copies.h"
#include "core/math/direction.h"

namespace sporeprint {

namespace {

/// Adds one node for all bodies of a shape.
void add_group(GlbScene& scene, BodyNodes& added, const PlotBodies::Shape& shape,
               std::size_t material, std::vector<GlbTransform> places, bool is_instanced,
               std::deque<Mesh>& merged) {
    GlbNode node{.name = shape.name, .mesh = scene.meshes.size()};
    const Mesh* mesh = &shape.mesh;
    added.triangles += shape.mesh.triangles() * places.size();
    if (is_instanced) {
        node.instances = std::move(places);
    } else {
        merged.push_back(MeshCopies{shape.mesh, std::move(places)}.merged());
        merged.back().tints.clear();
        mesh = &merged.back();
    }
    added.vertices += mesh->positions.size();
    scene.nodes.push_back(std::move(node));
    scene.meshes.push_back({shape.name, {{mesh, material, {}}}});
}

}  // namespace

BodyGrouping grouping_of(LeafInstancing instancing, bool is_crowded) {
    if (instancing == LeafInstancing::gpu) return BodyGrouping::instanced;
    return is_crowded ? BodyGrouping::merged : BodyGrouping::none;
}

void include(Bounds& box, const Mesh& mesh, const GlbTransform& place) {
    for (const glm::vec3& at : mesh.positions) {
        const glm::vec3 in_scene(place.translation +
                                 rotated(place.rotation, place.scale * glm::dvec3(at)));
        box = united(box, {in_scene, in_scene});
    }
}

BodyNodes add_bodies(GlbScene& scene, WorldMaterials& materials, const PlotBodies& bodies,
                     BodyGrouping grouping, std::deque<Mesh>& merged) {
    BodyNodes added;
    std::vector<std::size_t> skins;
    for (const PlotBodies::Shape& shape : bodies.shapes)
        skins.push_back(materials.skin(shape.spec, shape.individual));
    for (const PlotBodies::Placed& body : bodies.bodies)
        include(added.box, bodies.shapes[body.shape].mesh, body.place);
    if (grouping != BodyGrouping::none) {
        std::vector<std::vector<GlbTransform>> places(bodies.shapes.size());
        for (const PlotBodies::Placed& body : bodies.bodies) {
            places[body.shape].push_back(body.place);
            added.nodes.push_back(scene.nodes.size() + body.shape);
        }
        for (std::size_t i = 0; i < places.size(); ++i)
            add_group(scene, added, bodies.shapes[i], skins[i], std::move(places[i]),
                      grouping == BodyGrouping::instanced, merged);
        return added;
    }
    const std::size_t first_mesh = scene.meshes.size();
    for (std::size_t i = 0; i < bodies.shapes.size(); ++i) {
        const PlotBodies::Shape& shape = bodies.shapes[i];
        scene.meshes.push_back({shape.name, {{&shape.mesh, skins[i], {}}}});
        added.vertices += shape.mesh.positions.size();
    }
    std::size_t number = 0;
    for (const PlotBodies::Placed& body : bodies.bodies) {
        const PlotBodies::Shape& shape = bodies.shapes[body.shape];
        added.nodes.push_back(scene.nodes.size());
        scene.nodes.push_back({.name = shape.name + '_' + std::to_string(++number),
                               .mesh = first_mesh + body.shape,
                               .translation = body.place.translation,
                               .rotation = body.place.rotation});
        added.triangles += shape.mesh.triangles();
    }
    return added;
}

}  // namespace sporeprint
