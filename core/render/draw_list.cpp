#include "core/render/draw_list.h"

#include <functional>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <map>

#include "core/problems.h"

namespace sporeprint::render {

namespace {

/// Returns the matrix of a rotation by a unit quaternion x, y, z, w.
glm::dmat3 rotation_of(const glm::dvec4& q) {
    const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z,
                 yz = q.y * q.z, xw = q.x * q.w, yw = q.y * q.w, zw = q.z * q.w;
    return {{1.0 - 2.0 * (yy + zz), 2.0 * (xy + zw), 2.0 * (xz - yw)},
            {2.0 * (xy - zw), 1.0 - 2.0 * (xx + zz), 2.0 * (yz + xw)},
            {2.0 * (xz + yw), 2.0 * (yz - xw), 1.0 - 2.0 * (xx + yy)}};
}

/// An affine map in double precision, for products along the nodes of a scene.
struct Affine {
    glm::dmat3 linear{1.0};
    glm::dvec3 translation{0.0};

    [[nodiscard]] Affine operator*(const Affine& inner) const {
        return {linear * inner.linear, linear * inner.translation + translation};
    }
};

/// Returns the map of anything with a translation, a rotation and a scale.
template <class Transform>
Affine affine_of(const Transform& t) {
    glm::dmat3 linear = rotation_of(t.rotation);
    linear[0] *= t.scale.x;
    linear[1] *= t.scale.y;
    linear[2] *= t.scale.z;
    return {linear, t.translation};
}

Placement placement_of(const Affine& map) {
    return {glm::mat3(map.linear), glm::vec3(map.translation),
            glm::mat3(glm::transpose(glm::inverse(map.linear)))};
}

void add_mesh(DrawList& list, const GlbMesh& mesh, const Affine& map,
              const glm::vec3& tint = glm::vec3(1.0F)) {
    const Placement placement = placement_of(map);
    for (const GlbPrimitive& primitive : mesh.primitives)
        list.draws.push_back(
            {primitive.mesh, primitive.mesh, {}, primitive.material, placement, tint, mesh.role});
}

void add_node(DrawList& list, const GlbScene& scene, const GlbNode& node, const Affine& parent) {
    const Affine map = parent * affine_of(node);
    if (node.mesh && node.instances.empty()) add_mesh(list, scene.meshes[*node.mesh], map);
    for (const GlbTransform& instance : node.instances)
        add_mesh(list, scene.meshes[*node.mesh], map * affine_of(instance), instance.tint);
    for (const std::size_t child : node.children) add_node(list, scene, scene.nodes[child], map);
}

Bounds box_of(const std::vector<Draw>& draws) {
    constexpr float far = 1e9F;
    Bounds box{glm::vec3(far), glm::vec3(-far)};
    for (const Draw& draw : draws)
        for (const glm::vec3& at : draw.mesh->positions) {
            const glm::vec3 point = draw.placement.point(at);
            box.min = glm::min(box.min, point);
            box.max = glm::max(box.max, point);
        }
    return box;
}

}  // namespace

std::uint64_t DrawList::triangles() const {
    std::uint64_t sum = 0;
    for (const Draw& draw : draws) sum += draw.mesh->triangles();
    return sum;
}

DrawList draw_list(const GlbScene& scene, const Parallel& parallel, int side) {
    DrawList list;
    std::vector<bool> is_child(scene.nodes.size(), false);
    for (const GlbNode& node : scene.nodes)
        for (const std::size_t child : node.children) is_child[child] = true;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (!is_child[i] && scene.nodes[i].in_scene)
            add_node(list, scene, scene.nodes[i], Affine());
    if (list.triangles() == 0) throw GenerationError("a scene to draw has triangles");
    std::map<const Mesh*, Bounds> boxes;
    for (Draw& draw : list.draws) {
        const auto [found, is_new] = boxes.try_emplace(draw.mesh);
        if (is_new) found->second = bounds(*draw.mesh);
        draw.box = found->second;
    }
    list.box = box_of(list.draws);
    list.stands_on_ground = scene.stands_on_ground;

    list.materials.resize(scene.materials.size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const GlbMaterial& from = scene.materials[i];
        DrawMaterial& to = list.materials[i];
        to.look = from.look;
        const GlbTransmission& through = from.transmission;
        to.transmission = static_cast<float>(through.factor * (from.images ? 1.0 : through.mean));
        to.tint = glm::vec3(through.tint);
        if (!from.images) continue;
        const auto decode = [&](Texture& texture, ImageKind kind, Encoding encoding, int least) {
            const Slice& file = from.images->files[static_cast<std::size_t>(kind)];
            tasks.emplace_back([&texture, &file, &from, encoding, least] {
                texture = Texture({file.data(), file.size}, encoding, from.repeats_u, least);
            });
        };
        // Edges of colours are seen where two texels are nearer than two pixels; those of relief
        // and roughness are not.
        decode(to.base_color, ImageKind::base_color, Encoding::srgb, 2 * side);
        decode(to.normal, ImageKind::normal, Encoding::linear, side);
        decode(to.orm, ImageKind::orm, Encoding::linear, side);
        if (from.alpha_cutoff > 0.0 &&
            from.images->format_of(ImageKind::base_color) == ImageFormat::png) {
            to.alpha_cutoff = static_cast<float>(from.alpha_cutoff);
            decode(to.alpha, ImageKind::base_color, Encoding::alpha, 2 * side);
        }
        if (through.thinness.size > 0)
            tasks.emplace_back([&to, &file = through.thinness] {
                to.thinness = Texture({file.data(), file.size}, Encoding::alpha, false);
            });
    }
    parallel(tasks);
    return list;
}

}  // namespace sporeprint::render
