#include "core/scene/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace sporeprint {

namespace {

/// Triangles of a leaf at most.
constexpr std::size_t leaf_size = 4;

/// Nodes below each other at most: halves of 200,000 triangles are 17 deep.
constexpr std::size_t deepest = 64;

/// Returns the distance at which a line meets a triangle; infinite if it does not.
double distance_to(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& a,
                   const glm::dvec3& b, const glm::dvec3& c) {
    constexpr double never = std::numeric_limits<double>::infinity();
    const glm::dvec3 ab = b - a, ac = c - a, square = glm::cross(direction, ac);
    const double volume = glm::dot(ab, square);
    if (volume == 0.0) return never;
    const double inverse = 1.0 / volume;
    const glm::dvec3 from = origin - a;
    const double u = glm::dot(from, square) * inverse;
    if (!(u >= 0.0 && u <= 1.0)) return never;
    const glm::dvec3 other = glm::cross(from, ab);
    const double v = glm::dot(direction, other) * inverse;
    if (!(v >= 0.0 && u + v <= 1.0)) return never;
    return glm::dot(ac, other) * inverse;
}

}  // namespace

TriangleTree::TriangleTree(const Scene& scene) {
    std::vector<glm::vec3> centres;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const auto& corners = scene.triangles[i].corners;
        const glm::vec3 a = scene.positions[corners[0]], b = scene.positions[corners[1]],
                        c = scene.positions[corners[2]];
        triangles_.push_back({a, b, c, i});
        centres.push_back((a + b + c) / 3.0F);
    }
    nodes_.reserve(2 * triangles_.size() / leaf_size + 2);
    if (!triangles_.empty()) build(0, triangles_.size(), centres);
}

void TriangleTree::build(std::size_t first, std::size_t end, std::vector<glm::vec3>& centres) {
    const std::size_t own = nodes_.size();
    nodes_.emplace_back();
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low), least = low, most = high;
    for (std::size_t i = first; i < end; ++i) {
        const Corners& one = triangles_[i];
        low = glm::min(low, glm::min(one.a, glm::min(one.b, one.c)));
        high = glm::max(high, glm::max(one.a, glm::max(one.b, one.c)));
        least = glm::min(least, centres[one.number]);
        most = glm::max(most, centres[one.number]);
    }
    nodes_[own].low = low;
    nodes_[own].high = high;
    if (end - first <= leaf_size) {
        nodes_[own].first = static_cast<std::uint32_t>(first);
        nodes_[own].count = static_cast<std::uint32_t>(end - first);
        return;
    }
    const glm::vec3 size = most - least;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t middle = first + (end - first) / 2;
    // Numbers decide among equal centres, so that the tree is the same whatever the algorithm of the library is.
    const auto by_place = [&](const Corners& p, const Corners& q) {
        const float at = centres[p.number][axis], other = centres[q.number][axis];
        return at != other ? at < other : p.number < q.number;
    };
    const auto begin = triangles_.begin();
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first),
                     begin + static_cast<std::ptrdiff_t>(middle),
                     begin + static_cast<std::ptrdiff_t>(end), by_place);
    build(first, middle, centres);
    nodes_[own].first = static_cast<std::uint32_t>(nodes_.size());
    build(middle, end, centres);
}

template <class Visit>
void TriangleTree::each_hit(const glm::dvec3& origin, const glm::dvec3& direction, double from,
                            double& to, const Visit& visit) const {
    if (nodes_.empty()) return;
    const glm::dvec3 inverse = 1.0 / direction;
    const auto meets = [&](const Node& node) {
        double enters = from, leaves = to;
        for (int axis = 0; axis < 3; ++axis) {
            const double low = node.low[axis], high = node.high[axis];
            if (direction[axis] == 0.0) {
                if (origin[axis] < low || origin[axis] > high) return false;
                continue;
            }
            const double one = (low - origin[axis]) * inverse[axis],
                         other = (high - origin[axis]) * inverse[axis];
            enters = std::max(enters, std::min(one, other));
            leaves = std::min(leaves, std::max(one, other));
        }
        // Rounding must not lose what lies in a plane of a box.
        return enters <= leaves + 1e-9 * (1.0 + std::abs(leaves));
    };
    std::array<std::uint32_t, deepest> waiting{};
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
        const std::uint32_t index = waiting[--count];
        const Node& node = nodes_[index];
        if (!meets(node)) continue;
        if (node.count == 0) {
            waiting[count++] = node.first;
            waiting[count++] = index + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Corners& one = triangles_[i];
            const double distance = distance_to(origin, direction, glm::dvec3(one.a),
                                                glm::dvec3(one.b), glm::dvec3(one.c));
            if (distance >= from && distance <= to && !visit(one.number, distance)) return;
        }
    }
}

bool TriangleTree::is_blocked(const glm::dvec3& origin, const glm::dvec3& direction, double from,
                              double to) const {
    bool is_met = false;
    each_hit(origin, direction, from, to, [&](std::uint32_t, double) {
        is_met = true;
        return false;
    });
    return is_met;
}

std::optional<RayHit> TriangleTree::first_hit(const glm::dvec3& origin, const glm::dvec3& direction,
                                              double from, double to) const {
    std::optional<RayHit> found;
    each_hit(origin, direction, from, to, [&](std::uint32_t triangle, double distance) {
        if (!found || distance < found->distance ||
            (distance == found->distance && triangle < found->triangle))
            found = RayHit{triangle, distance};
        to = found->distance;
        return true;
    });
    return found;
}

}  // namespace sporeprint
