#include "core/collision/collision_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <optional>
#include <utility>

#include "core/collision/convex_hull.h"
#include "core/math/direction.h"
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

/// The half-spaces whose intersection a convex mesh is.
class Planes {
  public:
    explicit Planes(const Mesh& convex) {
        for (std::size_t i = 0; i + 2 < convex.indices.size(); i += 3) {
            const glm::dvec3 a(convex.positions[convex.indices[i]]),
                b(convex.positions[convex.indices[i + 1]]),
                c(convex.positions[convex.indices[i + 2]]);
            const glm::dvec3 normal = glm::cross(b - a, c - a);
            planes_.emplace_back(normal, glm::dot(normal, a));
        }
    }
    [[nodiscard]] bool contain(const glm::dvec3& point) const {
        return std::all_of(planes_.begin(), planes_.end(), [&](const auto& plane) {
            return glm::dot(plane.first, point) <= plane.second;
        });
    }

  private:
    std::vector<std::pair<glm::dvec3, double>> planes_;
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
    // A grid along the axis, since a thin stem that leans fills little of an upright box.
    const glm::dvec3 up = unit_or(capsule.to - capsule.from, {0.0, 1.0, 0.0});
    const glm::dvec3 x_axis = square_to(up, {1.0, 0.01, 0.0}), z_axis = glm::cross(x_axis, up);
    const glm::dmat3 frame(x_axis, up, z_axis);
    const glm::dvec3 from = capsule.from * frame, to = capsule.to * frame, margin(capsule.radius);
    glm::dvec3 low = glm::min(from, to) - margin, high = glm::max(from, to) + margin;
    for (const glm::vec3& corner : convex.positions) {
        const glm::dvec3 at = glm::dvec3(corner) * frame;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const Planes planes(convex);
    int both = 0, either = 0;
    for (int x = 0; x < steps; ++x)
        for (int y = 0; y < steps; ++y)
            for (int z = 0; z < steps; ++z) {
                const glm::dvec3 at = frame * (low + (glm::dvec3(x, y, z) + 0.5) /
                                                         static_cast<double>(steps) * (high - low));
                const bool in_capsule = capsule.contains(at);
                const bool in_hull = planes.contain(at);
                both += in_capsule && in_hull ? 1 : 0;
                either += in_capsule || in_hull ? 1 : 0;
            }
    return either == 0 ? 0.0 : static_cast<double>(both) / either;
}

namespace {

/// Returns a solid for each hull: a capsule if one fits, or else the hull itself.
std::vector<CollisionShape> shapes_of(const std::string& part, std::vector<Mesh> hulls) {
    std::vector<CollisionShape> shapes;
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

/// Returns the volume that solids share with thin convex slices, of that of both together: by
/// counting points of a grid around each slice.
double shared_volume(const std::vector<CollisionShape>& shapes, std::span<const Mesh> slices) {
    constexpr int across = 16;
    std::vector<std::optional<Planes>> planes;
    for (const CollisionShape& shape : shapes) {
        const auto* const hull = std::get_if<Mesh>(&shape.solid);
        planes.push_back(hull ? std::optional<Planes>(*hull) : std::nullopt);
    }
    const auto in_shapes = [&](const glm::dvec3& at) {
        for (std::size_t i = 0; i < shapes.size(); ++i)
            if (planes[i] ? planes[i]->contain(at)
                          : std::get<Capsule>(shapes[i].solid).contains(at))
                return true;
        return false;
    };
    double both = 0.0, either = 0.0;
    for (const Mesh& slice : slices) {
        const Planes inside(slice);
        const Bounds box = bounds(slice);
        glm::dvec3 low(box.min), high(box.max);
        const glm::dvec3 margin = 0.5 * (high - low);
        low -= glm::dvec3(margin.x, 0.0, margin.z);
        high += glm::dvec3(margin.x, 0.0, margin.z);
        const glm::dvec3 step = (high - low) / glm::dvec3(across, 1.0, across);
        const double volume = step.x * step.y * step.z;
        for (int x = 0; x < across; ++x)
            for (int z = 0; z < across; ++z) {
                const glm::dvec3 at = low + (glm::dvec3(x, 0.0, z) + 0.5) * step;
                const bool in_slice = inside.contain(at), in_one = in_shapes(at);
                both += in_slice && in_one ? volume : 0.0;
                either += in_slice || in_one ? volume : 0.0;
            }
    }
    return either > 0.0 ? both / either : 0.0;
}

}  // namespace

std::vector<CollisionShape> fitted_shapes(const std::string& part,
                                          std::span<const glm::vec3> positions,
                                          std::span<const std::uint32_t> indices) {
    std::vector<CollisionShape> best;
    if (indices.empty()) return best;
    const Triangles triangles{positions, indices};
    const std::vector<Mesh> reference = sliced_hulls(triangles, reference_slices);
    double most = -1.0;
    for (const int count : slice_counts) {
        std::vector<CollisionShape> shapes = shapes_of(part, sliced_hulls(triangles, count));
        const double shared = shared_volume(shapes, reference);
        if (shared > most) {
            most = shared;
            best = std::move(shapes);
        }
        if (most >= least_shared) break;
    }
    return best;
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
