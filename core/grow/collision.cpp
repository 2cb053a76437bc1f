#include "core/grow/collision.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "core/grow/mushroom.h"
#include "core/grow/wood.h"
#include "core/plant/tree.h"
#include "core/surface/charts.h"

namespace sporeprint {

namespace {

constexpr const char *physics_shape = "OMI_physics_shape", *physics_body = "OMI_physics_body";

/// The level of detail of the meshes that solids are fitted to.
constexpr int fitted_lod = 1;
/// The radius at which a trunk ends, in that of its foot.
constexpr double trunk_end = 0.4;

/// Returns a length, or a coordinate of a rotation, as JSON: in steps of a millionth.
Value rounded(double value) { return Value(std::floor(value * 1e6 + 0.5) / 1e6 + 0.0); }

template <class Vector>
Value list_of(const Vector& values, int count) {
    Value list = Value::array();
    for (int k = 0; k < count; ++k) list.push(rounded(static_cast<double>(values[k])));
    return list;
}

/// Returns the triangles of a mesh on some parts of its image atlas.
template <class Includes>
std::vector<std::uint32_t> triangles_of(const Mesh& mesh, Includes includes) {
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::vec2& place = mesh.texture_coordinates[mesh.indices[i]];
        if (includes(part_at(place.x, place.y)))
            for (std::size_t k = 0; k < 3; ++k) indices.push_back(mesh.indices[i + k]);
    }
    return indices;
}

/// Returns where a solid is in its own product.
GlbTransform place_of(const CollisionShape& shape) {
    if (!std::holds_alternative<Capsule>(shape.solid)) return {};
    const Capsule& capsule = std::get<Capsule>(shape.solid);
    return {.translation = 0.5 * (capsule.from + capsule.to), .rotation = rotation_of(capsule)};
}

Value shape_value(const CollisionShape& shape) {
    Value item = Value::object().set("part", shape.part);
    if (const auto* const capsule = std::get_if<Capsule>(&shape.solid))
        return item.set("capsule", Value::object()
                                       .set("radius_m", rounded(capsule->radius))
                                       .set("height_m", rounded(capsule->height())));
    Value points = Value::array();
    for (const glm::vec3& at : std::get<Mesh>(shape.solid).positions) points.push(list_of(at, 3));
    return item.set("convex", Value::object().set("points_m", std::move(points)));
}

GlbNode node_at(const GlbTransform& place, std::string name) {
    return {.name = std::move(name),
            .translation = place.translation,
            .rotation = place.rotation,
            .scale = place.scale};
}

/// Adds the mesh of a convex solid.
///
/// returns  its index
std::size_t add_mesh(GlbScene& scene, const Mesh& mesh, const std::string& name) {
    scene.meshes.push_back({name, {{&mesh, GlbPrimitive::no_material, {}}}});
    return scene.meshes.size() - 1;
}

/// Returns a number with at least two digits, as Unreal Engine expects.
std::string two_digits(std::size_t number) {
    return (number < 10 ? "0" : "") + std::to_string(number);
}

void add_nodes(GlbScene& scene, Collision& collision, const std::string& name) {
    std::vector<std::size_t> mesh_of;
    for (CollisionShape& shape : collision.shapes) {
        // What reads these nodes knows convex meshes only.
        if (const auto* const capsule = std::get_if<Capsule>(&shape.solid))
            shape.solid = hull_of(*capsule);
        mesh_of.push_back(add_mesh(scene, std::get<Mesh>(shape.solid),
                                   name + "_collision" + two_digits(mesh_of.size())));
    }
    for (std::size_t i = 0; i < collision.colliders.size(); ++i) {
        const Collider& collider = collision.colliders[i];
        const CollisionShape& shape = collision.shapes[collider.shape];
        GlbNode node = node_at(collider.place, "UCX_" + name + '_' + two_digits(i));
        node.mesh = mesh_of[collider.shape];
        node.extras_json = dump(Value::object().set("collision", shape.part));
        scene.nodes.push_back(std::move(node));
    }
}

void add_body(GlbScene& scene, const Collision& collision, const std::string& name) {
    Value shapes = Value::array();
    for (const CollisionShape& shape : collision.shapes) {
        if (const auto* const capsule = std::get_if<Capsule>(&shape.solid)) {
            shapes.push(Value::object()
                            .set("type", "capsule")
                            .set("capsule", Value::object()
                                                .set("radius", rounded(capsule->radius))
                                                .set("height", rounded(capsule->height()))));
            continue;
        }
        const std::size_t mesh = add_mesh(scene, std::get<Mesh>(shape.solid),
                                          name + "_collision" + two_digits(shapes.items().size()));
        shapes.push(Value::object()
                        .set("type", "convex")
                        .set("convex", Value::object().set("mesh", Value(mesh))));
    }
    GlbNode body{.name = name + "_body"};
    std::vector<bool> is_child(scene.nodes.size(), false);
    for (const GlbNode& node : scene.nodes)
        for (const std::size_t child : node.children) is_child[child] = true;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].in_scene && !is_child[i]) body.children.push_back(i);
    for (std::size_t i = 0; i < collision.colliders.size(); ++i) {
        const Collider& collider = collision.colliders[i];
        GlbNode node = node_at(collider.place, name + '_' + collision.shapes[collider.shape].part +
                                                   "_collider" + two_digits(i));
        const Value shape = Value::object().set("shape", Value(collider.shape));
        node.extensions.push_back({physics_body, dump(Value::object().set("collider", shape))});
        body.children.push_back(scene.nodes.size());
        scene.nodes.push_back(std::move(node));
    }
    body.extensions.push_back(
        {physics_body, dump(Value::object().set("motion", Value::object().set("type", "static")))});
    scene.nodes.push_back(std::move(body));
    scene.extensions.push_back(
        {physics_shape, dump(Value::object().set("shapes", std::move(shapes)))});
}

}  // namespace

void Collision::add(CollisionShape shape) {
    const GlbTransform place = place_of(shape);
    colliders.push_back({shapes.size(), place});
    // From now on a capsule is one along +y at the origin, and its place that of its collider.
    if (auto* const capsule = std::get_if<Capsule>(&shape.solid)) {
        const double half = 0.5 * capsule->height() - capsule->radius;
        capsule->from = {0.0, -half, 0.0};
        capsule->to = {0.0, half, 0.0};
    }
    shapes.push_back(std::move(shape));
}

std::vector<CollisionShape> collision_shapes(const Individual& individual) {
    const Mesh mesh = body_mesh(individual, fitted_lod, {.textured = true});
    const auto fitted = [&](const char* part, const std::vector<std::uint32_t>& indices) {
        return fitted_shapes(part, mesh.positions, indices);
    };
    const std::vector<std::uint32_t> body =
        triangles_of(mesh, [](Part part) { return part != Part::veil && part != Part::ground; });
    if (individual.is_branched()) return fitted("body", body);
    std::vector<CollisionShape> whole = fitted("body", body);
    if (const std::optional<WoodPiece> piece = wood_behind(individual)) {
        const Mesh wood = wood_mesh(*piece, last_lod, false);
        for (CollisionShape& shape : fitted_shapes("wood", wood.positions, wood.indices))
            whole.push_back(std::move(shape));
    }
    if (whole.size() == 1 || individual.grows_from_wall()) return whole;
    std::vector<CollisionShape> shapes =
        fitted("stem", triangles_of(mesh, [](Part part) { return part == Part::stem; }));
    std::vector<CollisionShape> cap =
        fitted("cap", triangles_of(mesh, [](Part part) {
                   return part != Part::veil && part != Part::stem && part != Part::ground;
               }));
    if (shapes.empty() || cap.empty()) return whole;
    std::move(cap.begin(), cap.end(), std::back_inserter(shapes));
    return shapes;
}

Collision trunk_collision(const TreeSpec& spec) {
    const Tree tree = grown_tree(spec.params.look.shape, spec.params.seed);
    const auto& nodes = tree.skeleton.nodes;
    std::vector<glm::dvec3> points{spec.params.size * nodes.front().place};
    std::vector<double> radii{spec.params.size * nodes.front().radius};
    // Node i + 1 of the skeleton is the end of edge i of the ramification.
    for (std::uint32_t edge = 0; edge != Ramification::none;
         edge = tree.ramification.nodes[edge].children[0]) {
        const Skeleton::Node& end = nodes[edge + 1];
        points.push_back(spec.params.size * end.place);
        radii.push_back(spec.params.size * end.radius);
        if (radii.back() < trunk_end * radii.front()) break;
    }
    return body_of(capsules_along("trunk", points, radii, most_trunk_capsules));
}

Collision body_of(std::vector<CollisionShape> shapes) {
    Collision collision;
    for (CollisionShape& shape : shapes) collision.add(std::move(shape));
    return collision;
}

void add_collision(GlbScene& scene, Collision& collision, const std::string& name,
                   CollisionFormat format) {
    switch (format) {
        case CollisionFormat::none:
            return;
        case CollisionFormat::nodes:
            return add_nodes(scene, collision, name);
        case CollisionFormat::omi:
            return add_body(scene, collision, name);
    }
}

Value collision_value(const Collision& collision) {
    Value shapes = Value::array(), colliders = Value::array();
    for (const CollisionShape& shape : collision.shapes) shapes.push(shape_value(shape));
    for (const Collider& collider : collision.colliders) {
        const GlbTransform& at = collider.place;
        colliders.push(Value::object()
                           .set("shape", Value(collider.shape))
                           .set("translation_m", list_of(at.translation, 3))
                           .set("rotation", list_of(at.rotation, 4))
                           .set("scale", rounded(at.scale.x)));
    }
    return Value::object().set("shapes", std::move(shapes)).set("colliders", std::move(colliders));
}

}  // namespace sporeprint
