#include "core/mesh/refinement.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>

namespace sporeprint {

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

constexpr std::uint32_t none = 0xFFFFFFFFU;

/// Returns the middle of the curved edge between two vertices.
glm::vec3 curved_middle(const Mesh& mesh, const Edge& edge) {
    const glm::dvec3 a(mesh.positions[edge.first]), b(mesh.positions[edge.second]);
    const glm::dvec3 from(mesh.normals[edge.first]), to(mesh.normals[edge.second]);
    const glm::dvec3 way = b - a;
    return glm::vec3(0.5 * (a + b) - 0.125 * (glm::dot(way, from) * from - glm::dot(way, to) * to));
}

}  // namespace

std::vector<Edge> refine(Mesh& mesh, const std::function<bool(std::uint32_t)>& splits) {
    std::vector<Edge> parents;
    std::map<Edge, std::uint32_t> middles;
    const std::vector<std::uint32_t> indices = std::move(mesh.indices);
    mesh.indices.clear();
    // Returns the vertex in the middle of an edge; `none` where it is not split.
    const auto middle_of = [&](std::uint32_t a, std::uint32_t b) {
        if (!splits(a) || !splits(b)) return none;
        const Edge edge = std::minmax(a, b);
        const auto known = middles.find(edge);
        if (known != middles.end()) return known->second;
        const auto made = static_cast<std::uint32_t>(mesh.positions.size());
        const glm::vec3 normal = mesh.normals[edge.first] + mesh.normals[edge.second];
        const float length = glm::length(normal);
        mesh.positions.push_back(curved_middle(mesh, edge));
        mesh.normals.push_back(length > 0.0F ? normal / length : mesh.normals[edge.first]);
        mesh.texture_coordinates.push_back(
            0.5F * (mesh.texture_coordinates[edge.first] + mesh.texture_coordinates[edge.second]));
        middles.emplace(edge, made);
        parents.push_back(edge);
        return made;
    };
    const auto add = [&mesh](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    };
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::array<std::uint32_t, 3> corner = {indices[i], indices[i + 1], indices[i + 2]};
        std::array<std::uint32_t, 3> middle{};
        std::size_t split = 0, last = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            middle[k] = middle_of(corner[k], corner[(k + 1) % 3]);
            if (middle[k] == none) continue;
            ++split;
            last = k;
        }
        // An edge is split where both of its ends ask for it, so that two imply the third.
        if (split == 0) {
            add(corner[0], corner[1], corner[2]);
        } else if (split == 1) {
            add(corner[last], middle[last], corner[(last + 2) % 3]);
            add(middle[last], corner[(last + 1) % 3], corner[(last + 2) % 3]);
        } else {
            add(corner[0], middle[0], middle[2]);
            add(middle[0], corner[1], middle[1]);
            add(middle[2], middle[1], corner[2]);
            add(middle[0], middle[1], middle[2]);
        }
    }
    return parents;
}

}  // namespace sporeprint
