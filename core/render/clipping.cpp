#include "core/render/clipping.h"

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

namespace sporeprint::render {

namespace {

/// A plane through a point of the axis of the camera; points with positive distances are seen.
struct Border {
    glm::vec3 normal{0.0F};
    float offset = 0.0F;

    [[nodiscard]] float distance(const glm::vec3& p) const {
        return normal.x * p.x + normal.y * p.y + normal.z * p.z - offset;
    }
};

using Borders = std::array<Border, 5>;

Borders borders_of(const Camera& camera) {
    return {{{{0.0F, 0.0F, 1.0F}, camera.nearest},
             {{1.0F, 0.0F, camera.tangent_x}, 0.0F},
             {{-1.0F, 0.0F, camera.tangent_x}, 0.0F},
             {{0.0F, 1.0F, camera.tangent_y}, 0.0F},
             {{0.0F, -1.0F, camera.tangent_y}, 0.0F}}};
}

/// Returns the point of an edge on a border, whichever way the edge is traversed.
glm::vec3 cut(glm::vec3 a, glm::vec3 b, const Border& border) {
    if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
    const float from = border.distance(a), to = border.distance(b);
    return a + (b - a) * (from / (from - to));
}

/// A convex polygon; each border adds one corner at most.
struct Polygon {
    std::array<glm::vec3, 3 + std::tuple_size_v<Borders>> corners;
    std::size_t count = 0;

    void add(const glm::vec3& corner) { corners[count++] = corner; }
};

Polygon inside(const Polygon& polygon, const Border& border) {
    Polygon rest;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::vec3 &here = polygon.corners[i],
                        &next = polygon.corners[(i + 1) % polygon.count];
        const bool is_inside = border.distance(here) >= 0.0F;
        if (is_inside) rest.add(here);
        if (is_inside != (border.distance(next) >= 0.0F)) rest.add(cut(here, next, border));
    }
    return rest;
}

/// Returns a bit for each border that a point is beyond.
unsigned beyond(const glm::vec3& point, const Borders& borders) {
    unsigned bits = 0;
    for (std::size_t i = 0; i < borders.size(); ++i)
        if (borders[i].distance(point) < 0.0F) bits |= 1U << i;
    return bits;
}

}  // namespace

ClippedTriangles clipped(std::vector<glm::vec3> vertices, std::span<const std::uint32_t> indices,
                         const Camera& camera) {
    const Borders borders = borders_of(camera);
    std::vector<unsigned> outside(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) outside[i] = beyond(vertices[i], borders);
    ClippedTriangles found{std::move(vertices), {}, {}};
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t of) {
        found.indices.insert(found.indices.end(), {a, b, c});
        found.of.push_back(static_cast<std::uint32_t>(of));
    };
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
        if ((outside[a] & outside[b] & outside[c]) != 0) continue;
        const unsigned crossed = outside[a] | outside[b] | outside[c];
        if (crossed == 0) {
            add(a, b, c, i);
            continue;
        }
        Polygon part;
        for (const std::uint32_t corner : {a, b, c}) part.add(found.corners[corner]);
        for (std::size_t border = 0; border < borders.size(); ++border)
            if ((crossed >> border & 1U) != 0) part = inside(part, borders[border]);
        if (part.count < 3) continue;
        const auto first = static_cast<std::uint32_t>(found.corners.size());
        found.corners.insert(found.corners.end(), part.corners.begin(),
                             part.corners.begin() + static_cast<std::ptrdiff_t>(part.count));
        for (std::uint32_t k = 2; k < part.count; ++k) add(first, first + k - 1, first + k, i);
    }
    return found;
}

}  // namespace sporeprint::render
