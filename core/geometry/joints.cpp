#include "core/geometry/joints.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "core/math/direction.h"
#include "core/math/elementary.h"

namespace sporeprint {

namespace {

/// Distance from another tube at which normals begin to turn to it, and colours to take on its own,
/// in radii of the thinner one.
constexpr double normal_reach = 1.4, colour_reach = 2.2;

/// How far a fillet raises both surfaces where they cross, in `normal_reach`: a quarter, as of the
/// smooth minimum of both distances. It begins with the angle between them and is whole at one whose
/// cosines these are, so that no collar swells round a tube where another begins inside it.
constexpr double fillet = 0.25, fillet_begins = 0.97, fillet_whole = 0.3;

/// How far from its first section a tube begins to count as a neighbour, in its radius there: that
/// end is round, hidden, and no part of what is seen.
constexpr double begins_after = 0.9;

/// How far a tube may stand out of its parent behind its first section, in its radius there: at that
/// section, where it lies inside, and what is added per such radius and per its square. So a tube comes
/// out of its parent as a ridge, and its first section is never seen as a step or an open end.
constexpr double sunk_at_first = -0.12, rises = 0.12, rises_faster = 0.3;

/// Up to which share of its reach a tube sinks fully into an older one, and the difference of the
/// distances of two older ones, in reaches, over which it passes from one to the other.
constexpr double sinks_within = 0.6, shared_sinking = 0.1;

/// How far a tube may stand out of its parent where its fillet is whole, in its radius there.
constexpr double fillet_free = 0.35;

/// Distance behind the nearest section of a tube within which others count too, in the radius of its
/// thickest.
constexpr double section_reach = 0.3;

/// A place of a surface, seen from another tube.
struct Nearness {
    double distance = std::numeric_limits<double>::infinity();  ///< metres, negative inside
    glm::dvec3 gradient{0.0};                                   ///< unit, away from the other tube
    double radius = 0.0;                                        ///< of the other tube there, metres
    double colour = 0.0;                                        ///< Station::colour there
};

/// The solid that a tube bounds, as elliptical cones from station to station.
class TubeSolid {
  public:
    explicit TubeSolid(const Tube& tube) {
        if (tube.parent != Tube::none && tube.shown < tube.stations.size())
            begin_ = tube.stations[tube.shown];
        for (std::size_t i = tube.shown; i < tube.stations.size(); ++i) {
            const Station& station = tube.stations[i];
            sections_.push_back({station.at, glm::inverse(station.shape()), station.radius,
                                 i < tube.trunk ? 1.0 : station.colour});
            const glm::dvec3 reach(widest(station));
            low_ = glm::min(low_, station.at - reach);
            high_ = glm::max(high_, station.at + reach);
            thickest_ = std::max(thickest_, station.radius);
            widest_ = std::max(widest_, std::max(station.wide, station.thin));
            thinnest_ = std::min(thinnest_, std::min(station.wide, station.thin));
        }
    }

    [[nodiscard]] double thickest() const { return thickest_; }

    /// Returns true if a place can be within a distance of the solid.
    [[nodiscard]] bool may_reach(const glm::dvec3& place, double distance) const {
        return glm::all(glm::greaterThanEqual(place, low_ - distance)) &&
               glm::all(glm::lessThanEqual(place, high_ + distance));
    }

    /// Returns how far a place is beyond the beginning of the tube inside its parent: 0..1.
    [[nodiscard]] double begun_at(const glm::dvec3& place) const {
        if (!(begin_.radius > 0.0)) return 1.0;
        return smooth_step(0.0, begins_after * begin_.radius,
                           glm::dot(place - begin_.at, begin_.along));
    }

    /// Returns how far a place of the tube may stand out of its parent, metres.
    [[nodiscard]] double free_at(const glm::dvec3& place) const {
        if (!(begin_.radius > 0.0)) return std::numeric_limits<double>::infinity();
        const double way = std::max(glm::dot(place - begin_.at, begin_.along) / begin_.radius, 0.0);
        return begin_.radius * (sunk_at_first + way * (rises + rises_faster * way));
    }

    /// Returns the share of its fillet that a tube has at a place.
    [[nodiscard]] double filleted_at(const glm::dvec3& place) const {
        if (!(begin_.radius > 0.0)) return 1.0;
        return smooth_step(0.0, fillet_free * begin_.radius, free_at(place));
    }

    /// Returns how a place lies to the solid; the distance is of first order in the flattening.
    /// Gradient, radius and colour are means of those of near sections, so that they change without
    /// a jump where another section is the nearest.
    ///
    /// reach     beyond this distance nothing is known of a place but that it is far, metres
    /// sections  scratch
    [[nodiscard]] Nearness near(const glm::dvec3& place, double reach,
                                std::vector<Nearness>& sections) const {
        sections.clear();
        const double counts = reach + section_reach * thickest_;
        double distance = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i + 1 < sections_.size(); ++i) {
            if (least_distance(place, sections_[i], sections_[i + 1]) > counts) continue;
            sections.push_back(section_near(place, sections_[i], sections_[i + 1]));
            distance = std::min(distance, sections.back().distance);
        }
        Nearness sum{distance};
        double weights = 0.0;
        for (const Nearness& one : sections) {
            const double farther = (one.distance - distance) / (section_reach * thickest_ + 1e-12);
            if (farther >= 1.0) continue;
            const double weight = (1.0 - farther) * (1.0 - farther);
            sum.gradient += weight * one.gradient;
            sum.radius += weight * one.radius;
            sum.colour += weight * one.colour;
            weights += weight;
        }
        if (weights <= 0.0) return {};
        return {distance, unit_or(sum.gradient, glm::dvec3(0.0)), sum.radius / weights,
                sum.colour / weights};
    }

  private:
    struct Section {
        glm::dvec3 at;
        glm::dmat3 unshaped;
        double radius, colour;
    };

    static Nearness section_near(const glm::dvec3& place, const Section& a, const Section& b) {
        const glm::dvec3 axis = b.at - a.at;
        const double square = glm::dot(axis, axis);
        const double t =
            square > 0.0 ? std::clamp(glm::dot(place - a.at, axis) / square, 0.0, 1.0) : 0.0;
        const glm::dvec3 out = place - (a.at + t * axis);
        const glm::dmat3 unshaped = a.unshaped + t * (b.unshaped - a.unshaped);
        const double radius = a.radius + t * (b.radius - a.radius);
        const glm::dvec3 round = unshaped * out;
        const double length = glm::length(round);
        // The gradient of |unshaped * out| - radius; the matrix is symmetric.
        const glm::dvec3 gradient = unshaped * round / std::max(length, 1e-12);
        const double slope = std::max(glm::length(gradient), 1e-12);
        return {(length - radius) / slope, gradient / slope, radius,
                a.colour + t * (b.colour - a.colour)};
    }

    /// Returns a lower bound of the distance of a section, for places outside of it.
    [[nodiscard]] double least_distance(const glm::dvec3& place, const Section& a,
                                        const Section& b) const {
        const double out =
            glm::distance(place, 0.5 * (a.at + b.at)) - 0.5 * glm::distance(a.at, b.at);
        return (out / widest_ - std::max(a.radius, b.radius)) * thinnest_;
    }

    static double widest(const Station& station) {
        return station.radius * std::max(station.wide, station.thin);
    }

    std::vector<Section> sections_;
    Station begin_;  ///< where it leaves its parent; of radius 0 if it has none
    glm::dvec3 low_{std::numeric_limits<double>::infinity()};
    glm::dvec3 high_{-std::numeric_limits<double>::infinity()};
    double thickest_ = 0.0;  ///< greatest radius of its stations, metres
    double widest_ = 0.0;    ///< greatest factor on a radius
    double thinnest_ = std::numeric_limits<double>::infinity();  ///< least one
};

/// How a vertex looks: its unit normal and its Station::colour; and how far a fillet raises it,
/// metres.
struct Look {
    glm::dvec3 normal;
    double colour;
    double raised = 0.0;
};

/// How the look of a vertex depends on another tube where the surfaces cross.
struct Dependence {
    double share = 0.0;  ///< of the other's look
    double begun = 0.0;  ///< how far the two part there, 0..1: share of the fillet
};

/// Returns by how much another tube changes the look of a vertex.
///
/// radius  of the tube of the vertex there, metres
Look change(const Look& look, double radius, const Nearness& other, const Dependence& by) {
    const double thin = std::min(radius, other.radius);
    const auto share = [&](double reach) {
        const double most = reach * thin;
        return most > 0.0 ? std::max(1.0 - std::abs(other.distance) / most, 0.0) : 0.0;
    };
    // Surfaces that run side by side need no fillet.
    const double angle =
        1.0 - smooth_step(fillet_whole, fillet_begins, glm::dot(other.gradient, look.normal));
    const double near = share(normal_reach);
    return {by.share * near * (other.gradient - look.normal),
            by.share * share(colour_reach) * (other.colour - look.colour),
            fillet * normal_reach * thin * angle * by.begun * near * near};
}

/// Returns the parent of the parent of a tube; Tube::none if it has none.
std::size_t grandparent(const std::vector<Tube>& tubes, std::size_t tube) {
    const std::size_t parent = tubes[tube].parent;
    return parent == Tube::none ? Tube::none : tubes[parent].parent;
}

/// Returns for each tube the others that it is united with: its parent and that one's, the other
/// children of both, and all that count it among theirs. Where forks follow each other at once a tube
/// leaves its parent where that one leaves its own.
std::vector<std::vector<std::size_t>> neighbours_of(const std::vector<Tube>& tubes) {
    std::vector<std::vector<std::size_t>> neighbours(tubes.size());
    const auto join = [&](std::size_t a, std::size_t b) {
        neighbours[a].push_back(b);
        neighbours[b].push_back(a);
    };
    for (std::size_t i = 0; i < tubes.size(); ++i) {
        const std::size_t parent = tubes[i].parent;
        if (parent == Tube::none) {
            // Trunks rise from one foot.
            for (std::size_t other = 0; other < i; ++other)
                if (tubes[other].parent == Tube::none) join(i, other);
            continue;
        }
        const std::size_t before = tubes[parent].parent;
        if (before != Tube::none) join(i, before);
        for (std::size_t other = 0; other < i; ++other)
            if (other == parent || tubes[other].parent == parent ||
                (before != Tube::none && tubes[other].parent == before))
                join(i, other);
    }
    return neighbours;
}

}  // namespace

void blend_joints(Mesh& mesh, std::vector<double>& colours, const std::vector<Tube>& tubes) {
    const std::vector<TubeSolid> solids(tubes.begin(), tubes.end());
    const auto neighbours = neighbours_of(tubes);
    std::vector<Nearness> sections;
    // Both take the mean where they cross; where a tube begins it looks like its parent.
    const auto dependence = [&](std::size_t tube, std::size_t other, const glm::dvec3& place) {
        const double own = solids[tube].begun_at(place), its = solids[other].begun_at(place);
        const double own_fillet = solids[tube].filleted_at(place),
                     its_fillet = solids[other].filleted_at(place);
        if (tubes[tube].parent == other || grandparent(tubes, tube) == other)
            return Dependence{1.0 - 0.5 * own, own_fillet};
        if (tubes[other].parent == tube || grandparent(tubes, other) == tube)
            return Dependence{0.5 * its, its_fillet};
        return Dependence{0.5 * own * its, own_fillet * its_fillet};
    };
    // Returns a place of a tube, moved into its parent, or that one's, where it begins. Between the two
    // it is moved towards either by its share, so that no place jumps while one becomes the nearer.
    const auto sunk = [&](std::size_t tube, const glm::dvec3& place) {
        const double most = solids[tube].free_at(place), reach = 3.0 * solids[tube].thickest();
        if (!(most < reach)) return place;
        std::array<Nearness, 2> found;
        const std::array<std::size_t, 2> older = {tubes[tube].parent, grandparent(tubes, tube)};
        for (std::size_t k = 0; k < 2; ++k)
            if (older[k] != Tube::none && solids[older[k]].may_reach(place, reach))
                found[k] = solids[older[k]].near(place, reach, sections);
        const auto clear = [&](std::size_t k) { return std::min(found[k].distance, reach); };
        const double softness = shared_sinking * reach;
        const double second = smooth_step(-softness, softness, clear(0) - clear(1));
        glm::dvec3 moved(0.0);
        for (std::size_t k = 0; k < 2; ++k) {
            const double distance = clear(k), share = k == 0 ? 1.0 - second : second;
            const double above = std::max(distance - most, 0.0);
            const double within = 1.0 - smooth_step(sinks_within * reach, reach, distance);
            if (share * above * within > 0.0) moved += share * above * within * found[k].gradient;
        }
        return place - moved;
    };
    const auto blend = [&](std::size_t tube, double radius, std::size_t vertex) {
        const glm::dvec3 place = sunk(tube, glm::dvec3(mesh.positions[vertex]));
        const Look own{glm::dvec3(mesh.normals[vertex]), colours[vertex]};
        Look sum = own;
        for (const std::size_t other : neighbours[tube]) {
            const TubeSolid& solid = solids[other];
            const double reach = colour_reach * std::min(radius, solid.thickest());
            if (!solid.may_reach(place, reach)) continue;
            const Dependence depends = dependence(tube, other, place);
            if (depends.share <= 0.0) continue;
            const Look by = change(own, radius, solid.near(place, reach, sections), depends);
            sum = {sum.normal + by.normal, sum.colour + by.colour, std::max(sum.raised, by.raised)};
        }
        mesh.positions[vertex] = glm::vec3(place + sum.raised * own.normal);
        mesh.normals[vertex] = glm::vec3(unit_or(sum.normal, own.normal));
        colours[vertex] = std::clamp(sum.colour, 0.0, 1.0);
    };
    for (std::size_t i = 0; i < tubes.size(); ++i)
        for (const TubeRows& rows : tubes[i].rows)
            for (std::size_t row = 0; row < rows.count; ++row) {
                const double radius = tubes[i].stations[rows.from + row].radius;
                for (std::size_t column = 0; radius > 0.0 && column < rows.width(); ++column)
                    blend(i, radius, rows.first_vertex + row * rows.width() + column);
            }
}

}  // namespace sporeprint
