#include "core/grow/world/plot_view.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "core/math/elementary.h"
#include "core/world/dead_wood.h"
#include "core/world/season.h"
#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

double ground_at(const Ground& ground, double x, double y) {
    return place_at(ground, coordinate_at(ground.grid, x), coordinate_at(ground.grid, y)).height;
}

/// A trunk that stands, seen from above, metres from the middle of a plot to the east and north.
struct Trunk {
    glm::dvec2 at{0.0};
    double radius = 0.1;
};

std::vector<Trunk> trunks_of(const PlotContent& content) {
    std::vector<Trunk> trunks;
    const auto add = [&](const WorldPoint& at, double radius) {
        trunks.push_back(
            {{metres(at.x - content.centre.x), metres(at.y - content.centre.y)}, radius});
    };
    for (const StandTree& tree : content.trees)
        if (tree.lives_at(content.time))
            add(tree.at, 0.5 * trunk_diameter(height_at(tree, content.time)));
    for (const DeadWood& wood : content.dead_wood)
        if (wood.stands_at(content.time)) add(wood.at, radius_at(wood, content.time));
    return trunks;
}

/// Returns how freely one sees from a place to another, metres: the distance of the nearest trunk from the first metres
/// of the line of sight.
double freedom(const std::vector<Trunk>& trunks, const glm::dvec2& eye, const glm::dvec2& target) {
    constexpr double nearest = 3.0;
    const glm::dvec2 way = target - eye;
    const double length = glm::length(way);
    const glm::dvec2 along = length > 1e-9 ? way / length : glm::dvec2(0.0, 1.0);
    double least = 10.0;
    for (const Trunk& trunk : trunks) {
        const double ahead =
            std::clamp(glm::dot(trunk.at - eye, along), 0.0, std::min(nearest, length));
        least = std::min(least, glm::distance(trunk.at, eye + ahead * along) - trunk.radius);
    }
    return least;
}

/// Returns the fruit body of a plot with the most others beside it, of those that are grown enough to be seen and not above the
/// eyes of who kneels.
std::optional<glm::dvec3> middle_of_bodies(const PlotContent& content) {
    constexpr double least_age = 0.2, beside = 0.5, highest = 1.0;
    const double half = 0.5 * content.size;
    struct Seen {
        glm::dvec2 at;
        double height;
    };
    std::vector<Seen> seen;
    for (const FruitBody& body : content.bodies) {
        const glm::dvec2 at(metres(body.at.x - content.centre.x),
                            metres(body.at.y - content.centre.y));
        if (body.height < highest && body.stands_at(content.time) &&
            age_at(body, content.time) >= least_age &&
            std::max(std::abs(at.x), std::abs(at.y)) < half)
            seen.push_back({at, body.height});
    }
    const Seen* best = nullptr;
    std::size_t most = 0;
    for (const Seen& one : seen) {
        const auto count = static_cast<std::size_t>(std::ranges::count_if(
            seen, [&](const Seen& other) { return glm::distance(one.at, other.at) < beside; }));
        if (count > most) {
            most = count;
            best = &one;
        }
    }
    if (best == nullptr) return std::nullopt;
    return glm::dvec3(best->at, best->height);
}

}  // namespace

StandingCamera camera_of(const PlotContent& content, PlotView view, double turn_deg) {
    const double x = metres(content.centre.x), y = metres(content.centre.y);
    const double middle = ground_at(*content.ground, x, y), size = content.size;
    const SineCosine turn = sine_cosine(radians(turn_deg));
    const glm::dvec2 back(turn.sine, -turn.cosine), aside(turn.cosine, turn.sine);
    /// Returns a place so high above the ground.
    const auto above = [&](const glm::dvec2& at, double height) {
        return glm::dvec3(at.x, ground_at(*content.ground, x + at.x, y + at.y) - middle + height,
                          -at.y);
    };
    /// Returns the camera with the freest sight among those that are moved aside, the first one that has enough of it.
    const auto freest = [&](const glm::dvec2& eye, double eye_height, const glm::dvec2& target,
                            double target_height, double angle_deg, double step, double wanted) {
        const std::vector<Trunk> trunks = trunks_of(content);
        glm::dvec2 best = eye;
        double most = -1.0;
        for (const double steps : {0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0}) {
            const glm::dvec2 moved = eye + steps * step * aside;
            const double free = freedom(trunks, moved, target);
            if (free > most) {
                most = free;
                best = moved;
            }
            if (most >= wanted) break;
        }
        return StandingCamera{above(best, eye_height), above(target, target_height), angle_deg};
    };
    switch (view) {
        case PlotView::standing:
            return freest(0.48 * size * back, 1.65, -0.1 * size * back, 0.45, 75.0, 0.07 * size,
                          1.0);
        case PlotView::kneeling: {
            if (const auto bodies = middle_of_bodies(content)) {
                const glm::dvec2 at(*bodies);
                return freest(at + 0.8 * back, 0.32 + 0.6 * bodies->z, at, 0.05 + bodies->z, 60.0,
                              0.25, 0.25);
            }
            return freest(0.42 * size * back, 0.5, 0.1 * size * back, 0.1, 60.0, 0.07 * size, 0.6);
        }
        case PlotView::aslant:
            return {above(1.05 * size * back, 0.9 * size), {0.0, 0.0, 0.0}, 55.0};
        case PlotView::top:
            break;
    }
    // A little beside the middle, so that up is away from the viewer.
    return {{1e-3 * size * turn.sine, size, 1e-3 * size * turn.cosine}, {0.0, 0.0, 0.0}, 56.0};
}

}  // namespace sporeprint
