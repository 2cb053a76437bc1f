#include "core/scene/surfels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/math/direction.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

/// Candidates in the square of the spacing, and how many surfels become of them there, about.
constexpr double candidates_per_square = 4.0, surfels_per_square = 0.6;

/// How much more than needed the spacing grows if there are too many surfels.
constexpr double growth = 1.05;

/// Surfels are sought in cells of this many spacings.
constexpr double cell_spacings = 2.0;

struct Candidate {
    Surfel surfel;
    std::uint32_t priority = 0;
};

glm::dvec3 corner_of(const Scene& scene, const SceneTriangle& triangle, std::size_t corner) {
    return glm::dvec3(scene.positions[triangle.corners[corner]]);
}

double area_of(const Scene& scene, const SceneTriangle& triangle) {
    const glm::dvec3 a = corner_of(scene, triangle, 0), b = corner_of(scene, triangle, 1),
                     c = corner_of(scene, triangle, 2);
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

/// Returns candidates, of which each stands for the same area.
std::vector<Candidate> candidates_of(const Scene& scene, std::uint32_t seed, double whole,
                                     double per_area) {
    std::vector<Candidate> out;
    out.reserve(static_cast<std::size_t>(whole * per_area) + 2);
    double sum = 0.5;
    for (std::uint32_t number = 0; number < scene.triangles.size(); ++number) {
        const SceneTriangle& triangle = scene.triangles[number];
        const double before = std::floor(sum);
        sum += area_of(scene, triangle) * per_area;
        const auto count = static_cast<std::size_t>(std::floor(sum) - before);
        if (count == 0) continue;
        const glm::dvec3 a = corner_of(scene, triangle, 0), b = corner_of(scene, triangle, 1),
                         c = corner_of(scene, triangle, 2);
        Random random(seed, purposes::surfels, number);
        for (std::size_t i = 0; i < count; ++i) {
            const double first = random.uniform(), second = random.uniform();
            const double root = std::sqrt(first);
            Candidate candidate;
            candidate.priority = random.bits();
            Surfel& surfel = candidate.surfel;
            surfel.at = glm::vec3((1.0 - root) * a + root * (1.0 - second) * b + root * second * c);
            surfel.normal = glm::vec3(normal_of(scene, number));
            surfel.triangle = number;
            surfel.material = triangle.material;
            out.push_back(candidate);
        }
    }
    return out;
}

bool faces_alike(const Surfel& a, const Surfel& b) {
    return glm::dot(glm::dvec3(a.normal), glm::dvec3(b.normal)) > alike_facing;
}

double square_between(const Surfel& a, const Surfel& b) {
    const glm::dvec3 way = glm::dvec3(a.at) - glm::dvec3(b.at);
    return glm::dot(way, way);
}

/// Returns the candidates that no other one dominates. Their areas are those of the candidates nearest to them.
std::vector<Surfel> dominant(std::vector<Candidate> candidates, double spacing, double area) {
    std::vector<std::uint32_t> order;
    order.reserve(candidates.size());
    for (std::uint32_t i = 0; i < candidates.size(); ++i) order.push_back(i);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        const std::uint32_t p = candidates[a].priority, q = candidates[b].priority;
        return p != q ? p > q : a < b;
    });
    std::vector<Surfel> out;
    std::vector<bool> stays(candidates.size(), false);
    PointGrid grid(spacing, candidates.size() / 4);
    for (const std::uint32_t i : order) {
        const Surfel& one = candidates[i].surfel;
        bool is_dominated = false;
        grid.each_near(glm::dvec3(one.at), spacing, [&](std::uint32_t other) {
            const Surfel& stronger = candidates[other].surfel;
            is_dominated = is_dominated || (faces_alike(one, stronger) &&
                                            square_between(one, stronger) < spacing * spacing);
        });
        if (is_dominated) continue;
        stays[i] = true;
        grid.insert(glm::dvec3(one.at), i);
    }
    // In the order of triangles, so that neighbours in memory are neighbours in space.
    std::vector<std::uint32_t> number_of(candidates.size(), 0);
    for (std::uint32_t i = 0; i < candidates.size(); ++i)
        if (stays[i]) {
            number_of[i] = static_cast<std::uint32_t>(out.size());
            out.push_back(candidates[i].surfel);
        }
    std::vector<double> areas(out.size(), 0.0);
    for (std::uint32_t i = 0; i < candidates.size(); ++i) {
        std::uint32_t best = i;
        if (!stays[i]) {
            const Surfel& one = candidates[i].surfel;
            double least = 4.0 * spacing * spacing;
            grid.each_near(glm::dvec3(one.at), spacing, [&](std::uint32_t other) {
                const Surfel& stronger = candidates[other].surfel;
                if (!faces_alike(one, stronger)) return;
                const double square = square_between(one, stronger);
                if (square < least || (square == least && other < best)) {
                    best = other;
                    least = square;
                }
            });
        }
        areas[number_of[best]] += area;
    }
    for (std::size_t i = 0; i < out.size(); ++i) out[i].area = static_cast<float>(areas[i]);
    return out;
}

}  // namespace

Surfels::Surfels(double spacing, std::vector<Surfel> list)
    : spacing_(spacing), list_(std::move(list)), grid_(cell_spacings * spacing, list_.size()) {
    for (std::uint32_t i = 0; i < list_.size(); ++i) grid_.insert(glm::dvec3(list_[i].at), i);
}

std::optional<std::uint32_t> Surfels::nearest(const glm::dvec3& at, const glm::dvec3& normal,
                                              double radius) const {
    std::optional<std::uint32_t> best;
    double least = radius * radius;
    grid_.each_near(at, radius, [&](std::uint32_t i) {
        const glm::dvec3 way = glm::dvec3(list_[i].at) - at;
        const double square = glm::dot(way, way);
        if (square > least || (square == least && best && *best < i)) return;
        if (glm::dot(glm::dvec3(list_[i].normal), normal) <= alike_facing) return;
        best = i;
        least = square;
    });
    return best;
}

glm::dvec3 normal_of(const Scene& scene, std::uint32_t triangle) {
    const SceneTriangle& corners = scene.triangles[triangle];
    const glm::dvec3 a = corner_of(scene, corners, 0), b = corner_of(scene, corners, 1),
                     c = corner_of(scene, corners, 2);
    const glm::dvec3 across = glm::cross(b - a, c - a);
    const double length = glm::length(across);
    return length > 0.0 ? across / length : glm::dvec3(0.0, 1.0, 0.0);
}

Surfels surfels_of(const Scene& scene, std::uint32_t seed, std::size_t most) {
    double whole = 0.0;
    for (const SceneTriangle& triangle : scene.triangles) whole += area_of(scene, triangle);
    if (!(whole > 0.0)) return {};
    double spacing =
        std::max(finest_spacing, std::sqrt(surfels_per_square * whole / static_cast<double>(most)));
    while (true) {
        // At least one candidate, also of a scene that is smaller than a surfel.
        const double per_area = std::max(candidates_per_square / (spacing * spacing), 1.0 / whole);
        std::vector<Candidate> candidates = candidates_of(scene, seed, whole, per_area);
        if (candidates.empty()) return {};
        const double area = whole / static_cast<double>(candidates.size());
        std::vector<Surfel> list = dominant(std::move(candidates), spacing, area);
        if (list.size() <= most) return {spacing, std::move(list)};
        // Surfaces that face many ways, as leaves, have more of them.
        spacing *= growth * std::sqrt(static_cast<double>(list.size()) / static_cast<double>(most));
    }
}

}  // namespace sporeprint
