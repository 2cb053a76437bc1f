#include "core/collision/collision_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "core/collision/convex_hull.h"
#include "core/math/elementary.h"
#include "core/mesh/measure.h"

namespace sporeprint {

namespace {

constexpr int reference_slices = 16;
constexpr std::array<int, 6> slice_counts = {1, 2, 3, 4, 6, 8};

/// Returns the directions along which the corners of hulls are looked for: most_hull_corners.
const std::vector<glm::dvec3>& corner_directions() {
    static const std::vector<glm::dvec3> all = directions(16, 7);
    return all;
}

/// The triangles of a part.
struct Triangles {
    std::span<const glm::vec3> positions;
    std::span<const std::uint32_t> indices;

    /// Returns the lowest and the highest corner.
    [[nodiscard]] std::pair<float, float> heights() const {
        float low = positions[indices.front()].y, high = low;
        for (const std::uint32_t index : indices) {
            low = std::min(low, positions[index].y);
            high = std::max(high, positions[index].y);
        }
        return {low, high};
    }
};

/// Returns the hulls of slices of equal height; those of no volume are left out.
std::vector<Mesh> sliced_hulls(const Triangles& part, int count) {
    const auto [low, high] = part.heights();
    const float step = (high - low) / static_cast<float>(count);
    std::vector<std::uint32_t> corners(part.indices.begin(), part.indices.end());
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    std::vector<Mesh> hulls;
    for (int slice = 0; slice < count; ++slice) {
        const float from = low + step * static_cast<float>(slice),
                    to = slice + 1 == count ? high : low + step * static_cast<float>(slice + 1);
        std::vector<glm::vec3> points;
        for (const std::uint32_t corner : corners)
            if (part.positions[corner].y >= from && part.positions[corner].y <= to)
                points.push_back(part.positions[corner]);
        // Where edges cross either height.
        for (std::size_t i = 0; i < part.indices.size(); ++i) {
            const glm::vec3 &a = part.positions[part.indices[i]],
                            &b = part.positions[part.indices[i % 3 == 2 ? i - 2 : i + 1]];
            for (const float level : {from, to})
                if ((a.y < level) != (b.y < level))
                    points.push_back(a + (b - a) * ((level - a.y) / (b.y - a.y)));
        }
        Mesh hull = convex_hull(farthest_points(points, corner_directions()));
        if (!hull.indices.empty()) hulls.push_back(std::move(hull));
    }
    return hulls;
}

double total_volume(std::span<const Mesh> hulls) {
    double sum = 0.0;
    for (const Mesh& hull : hulls) sum += volume(hull);
    return sum;
}

/// Returns the middle of those positions whose height is in a share of the whole.
glm::dvec3 middle_between(std::span<const glm::vec3> positions, float low, float high) {
    glm::dvec3 sum(0.0);
    double count = 0.0;
    for (const glm::vec3& at : positions)
        if (at.y >= low && at.y <= high) {
            sum += glm::dvec3(at);
            count += 1.0;
        }
    return sum / count;
}

/// Returns the radius of a capsule of this height and volume; nothing for less than a sphere.
std::optional<double> capsule_radius(double height, double volume) {
    double low = 0.0, high = 0.5 * height;
    const auto volume_of = [&](double radius) {
        return pi * radius * radius * (height - 2.0 * radius) +
               4.0 / 3.0 * pi * radius * radius * radius;
    };
    if (volume_of(high) < volume) return {};
    for (int i = 0; i < 50; ++i) {
        const double radius = 0.5 * (low + high);
        (volume_of(radius) < volume ? low : high) = radius;
    }
    return high;
}

/// Returns the capsule of a hull's length and volume along the line through its ends; nothing for a
/// hull that is wider than long.
std::optional<Capsule> capsule_of(const Mesh& hull) {
    const Bounds box = bounds(hull);
    const float end = 0.2F * (box.max.y - box.min.y);
    const glm::dvec3 below = middle_between(hull.positions, box.min.y, box.min.y + end),
                     above = middle_between(hull.positions, box.max.y - end, box.max.y);
    const glm::dvec3 way = above - below;
    const double length = std::sqrt(glm::dot(way, way));
    if (!(length > 0.0)) return {};
    const glm::dvec3 along = way / length;
    double first = 1e300, last = -1e300;
    for (const glm::vec3& at : hull.positions) {
        const double here = glm::dot(glm::dvec3(at) - below, along);
        first = std::min(first, here);
        last = std::max(last, here);
    }
    const std::optional<double> radius = capsule_radius(last - first, volume(hull));
    if (!radius) return {};
    return Capsule{below + (first + *radius) * along, below + (last - *radius) * along, *radius};
}

}  // namespace

double Capsule::height() const { return glm::length(to - from) + 2.0 * radius; }

double Capsule::volume() const {
    return pi * radius * radius * (glm::length(to - from) + 4.0 / 3.0 * radius);
}

bool Capsule::contains(const glm::dvec3& point) const {
    const glm::dvec3 way = to - from, offset = point - from;
    const double square = glm::dot(way, way);
    const double share = square > 0.0 ? glm::clamp(glm::dot(offset, way) / square, 0.0, 1.0) : 0.0;
    const glm::dvec3 away = offset - share * way;
    return glm::dot(away, away) <= radius * radius;
}

glm::dvec4 rotation_of(const Capsule& capsule) {
    const glm::dvec3 way = capsule.to - capsule.from;
    const double length = std::sqrt(glm::dot(way, way));
    if (!(length > 0.0)) return {0.0, 0.0, 0.0, 1.0};
    // The half-way quaternion of +y and the direction.
    const glm::dvec3 along = way / length;
    const glm::dvec4 half(along.z, 0.0, -along.x, 1.0 + along.y);
    const double norm = std::sqrt(glm::dot(half, half));
    return norm > 1e-9 ? half / norm : glm::dvec4(1.0, 0.0, 0.0, 0.0);
}

Mesh hull_of(const Capsule& capsule) {
    static const std::vector<glm::dvec3> few = directions(12, 3);
    std::vector<glm::vec3> points;
    for (const glm::dvec3& direction : few) {
        const double along = glm::dot(direction, capsule.to - capsule.from);
        if (along >= 0.0) points.emplace_back(capsule.to + capsule.radius * direction);
        if (along <= 0.0) points.emplace_back(capsule.from + capsule.radius * direction);
    }
    return convex_hull(points);
}

double overlap(const Capsule& capsule, const Mesh& convex) {
    constexpr int steps = 20;
    const Bounds box = bounds(convex);
    const glm::dvec3 margin(capsule.radius);
    const glm::dvec3 low =
        glm::min(glm::dvec3(box.min), glm::min(capsule.from, capsule.to) - margin);
    const glm::dvec3 high =
        glm::max(glm::dvec3(box.max), glm::max(capsule.from, capsule.to) + margin);
    std::vector<std::pair<glm::dvec3, double>> planes;
    for (std::size_t i = 0; i + 2 < convex.indices.size(); i += 3) {
        const glm::dvec3 a(convex.positions[convex.indices[i]]),
            b(convex.positions[convex.indices[i + 1]]), c(convex.positions[convex.indices[i + 2]]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        planes.emplace_back(normal, glm::dot(normal, a));
    }
    int both = 0, either = 0;
    for (int x = 0; x < steps; ++x)
        for (int y = 0; y < steps; ++y)
            for (int z = 0; z < steps; ++z) {
                const glm::dvec3 at =
                    low + (glm::dvec3(x, y, z) + 0.5) / static_cast<double>(steps) * (high - low);
                const bool in_capsule = capsule.contains(at);
                const bool in_hull = std::all_of(planes.begin(), planes.end(), [&](auto& plane) {
                    return glm::dot(plane.first, at) <= plane.second;
                });
                both += in_capsule && in_hull ? 1 : 0;
                either += in_capsule || in_hull ? 1 : 0;
            }
    return either == 0 ? 0.0 : static_cast<double>(both) / either;
}

double filled_volume(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    return indices.empty() ? 0.0
                           : total_volume(sliced_hulls({positions, indices}, reference_slices));
}

std::vector<CollisionShape> fitted_shapes(const std::string& part,
                                          std::span<const glm::vec3> positions,
                                          std::span<const std::uint32_t> indices) {
    std::vector<CollisionShape> shapes;
    if (indices.empty()) return shapes;
    const Triangles triangles{positions, indices};
    const double filled = filled_volume(positions, indices);
    std::vector<Mesh> hulls;
    for (const int count : slice_counts) {
        hulls = sliced_hulls(triangles, count);
        if (least_fill * total_volume(hulls) <= filled) break;
    }
    for (std::size_t i = 0; i < hulls.size(); ++i) {
        std::optional<Capsule> capsule = capsule_of(hulls[i]);
        if (!capsule || overlap(*capsule, hulls[i]) < least_overlap) {
            shapes.push_back({part, std::move(hulls[i])});
            continue;
        }
        // The round ends between two slices reach into both, so that there is no gap.
        const glm::dvec3 end = capsule->radius * glm::normalize(capsule->to - capsule->from);
        if (i > 0) capsule->from -= end;
        if (i + 1 < hulls.size()) capsule->to += end;
        shapes.push_back({part, *capsule});
    }
    return shapes;
}

std::vector<CollisionShape> capsules_along(const std::string& part,
                                           std::span<const glm::dvec3> points,
                                           std::span<const double> radii, int most) {
    std::vector<double> way{0.0};
    for (std::size_t i = 1; i < points.size(); ++i)
        way.push_back(way.back() + glm::length(points[i] - points[i - 1]));
    std::vector<CollisionShape> shapes;
    const int pieces = std::min(most, static_cast<int>(points.size()) - 1);
    std::size_t begin = 0;
    for (int piece = 1; piece <= pieces; ++piece) {
        std::size_t end = begin + 1;
        while (end + 1 < points.size() && way[end] < way.back() * piece / pieces) ++end;
        // The mean radius of the piece, and its length with the round ends within.
        double sum = 0.0;
        for (std::size_t i = begin; i < end; ++i)
            sum += 0.5 * (radii[i] + radii[i + 1]) * (way[i + 1] - way[i]);
        const double length = way[end] - way[begin];
        if (!(length > 0.0)) continue;
        shapes.push_back({part, Capsule{points[begin], points[end], sum / length}});
        begin = end;
        if (begin + 1 >= points.size()) break;
    }
    return shapes;
}

}  // namespace sporeprint
