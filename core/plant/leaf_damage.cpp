#include "core/plant/leaf_damage.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <utility>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

// No measurement is recorded for the values down to `least_spot`: they follow photographs of leaves
// that beetles and caterpillars have fed on.

// Share of spots at the border; radii of spots by the root of the area of the lamina; the share of a
// bite that lies within the border.
constexpr double bites_share = 0.4, smallest = 0.03, largest = 0.1, bite_within = 0.55;

// Distance of a spot from the main vein and from the root, beyond its own radius.
constexpr double from_vein = 0.02, from_root = 0.12;

// Spots of a smaller share of the lamina are not made.
constexpr double least_spot = 0.0008;

// Largest waves of the border of a spot, in its radius.
constexpr std::array<double, 3> wave_sizes = {0.2, 0.14, 0.09};

// The border of a spot is nowhere nearer to its middle, in its radius.
constexpr double nearest = 0.55;

// Edges are divided up to this distance from the middle of a spot, in its radius.
constexpr double band = 1.2;

// Places that are tried for a spot.
constexpr int tries = 24;

double area_of(const std::vector<glm::dvec2>& border) {
    double twice = 0.0;
    for (std::size_t i = 0; i < border.size(); ++i) {
        const glm::dvec2 a = border[i], b = border[(i + 1) % border.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * std::abs(twice);
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Cuts spots out of a mesh.
class Cutter {
  public:
    Cutter(LaminaMesh& lamina, double fineness) : lamina_(lamina), fineness_(fineness) {}

    void cut(const EatenSpot& spot) {
        refine(spot);
        remove(spot);
    }

    /// Lets fall what is cut off, marks the rim, and divides edges inside that join two vertices on
    /// it, where both faces would touch.
    void finish() {
        drop_islands();
        const std::map<Edge, int> edges = uses();
        for (const auto& [edge, count] : edges)
            if (count == 1)
                for (const std::uint32_t i : {edge.first, edge.second})
                    lamina_.vertices[i].rim = true;
        std::map<Edge, std::uint32_t> middles;
        for (const auto& [edge, count] : edges)
            if (count == 2 && lamina_.vertices[edge.first].rim && lamina_.vertices[edge.second].rim)
                middles[edge] = add_between(edge, 0.5);
        divide(middles);
        compact();
    }

  private:
    std::map<Edge, int> uses() const {
        std::map<Edge, int> count;
        for (const auto& t : lamina_.triangles)
            for (std::size_t k = 0; k < 3; ++k) ++count[edge_of(t[k], t[(k + 1) % 3])];
        return count;
    }

    std::uint32_t add_between(const Edge& edge, double t) {
        const LaminaVertex a = lamina_.vertices[edge.first], b = lamina_.vertices[edge.second];
        const auto mix = [t](const auto& from, const auto& to) { return from + t * (to - from); };
        lamina_.vertices.push_back({mix(a.place, b.place), mix(a.affinity, b.affinity), false,
                                    mix(a.groove, b.groove), mix(a.rib, b.rib),
                                    mix(a.swell, b.swell), mix(a.breadth, b.breadth)});
        return static_cast<std::uint32_t>(lamina_.vertices.size() - 1);
    }

    /// Divides triangles at the middles of their edges.
    void divide(const std::map<Edge, std::uint32_t>& middles) {
        if (middles.empty()) return;
        std::vector<std::array<std::uint32_t, 3>> divided;
        divided.reserve(lamina_.triangles.size());
        constexpr std::uint32_t none = ~0U;
        for (const auto& t : lamina_.triangles) {
            std::array<std::uint32_t, 3> middle{};
            std::size_t cut = 0, whole = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto found = middles.find(edge_of(t[k], t[(k + 1) % 3]));
                middle[k] = found == middles.end() ? none : found->second;
                if (middle[k] == none)
                    whole = k;
                else
                    ++cut;
            }
            if (cut == 0) {
                divided.push_back(t);
            } else if (cut == 3) {
                divided.push_back({t[0], middle[0], middle[2]});
                divided.push_back({t[1], middle[1], middle[0]});
                divided.push_back({t[2], middle[2], middle[1]});
                divided.push_back(middle);
            } else if (cut == 2) {
                const std::uint32_t a = t[whole], b = t[(whole + 1) % 3], c = t[(whole + 2) % 3],
                                    bc = middle[(whole + 1) % 3], ca = middle[(whole + 2) % 3];
                divided.push_back({c, ca, bc});
                divided.push_back({a, b, bc});
                divided.push_back({a, bc, ca});
            } else {
                const std::size_t k = middle[0] != none ? 0 : middle[1] != none ? 1 : 2;
                const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
                divided.push_back({a, middle[k], c});
                divided.push_back({middle[k], b, c});
            }
        }
        lamina_.triangles = std::move(divided);
    }

    /// Divides edges near a spot until they are short.
    void refine(const EatenSpot& spot) {
        const double limit = fineness_ * spot.radius, reach = band * spot.radius;
        const auto is_divided = [&](const Edge& edge) {
            const glm::dvec2 a = lamina_.vertices[edge.first].place,
                             b = lamina_.vertices[edge.second].place, way = b - a;
            const double length = glm::length(way);
            if (!(length > limit)) return false;
            const double t =
                std::clamp(glm::dot(spot.middle - a, way) / (length * length), 0.0, 1.0);
            // What is all inside goes.
            return glm::distance(a + t * way, spot.middle) <= reach &&
                   std::max(glm::distance(a, spot.middle), glm::distance(b, spot.middle)) >=
                       nearest * spot.radius;
        };
        for (int pass = 0; pass < 10; ++pass) {
            std::map<Edge, int> count;
            for (const auto& t : lamina_.triangles)
                for (std::size_t k = 0; k < 3; ++k)
                    if (const Edge edge = edge_of(t[k], t[(k + 1) % 3]); is_divided(edge))
                        ++count[edge];
            std::map<Edge, std::uint32_t> middles;
            for (const auto& [edge, triangles] : count) {
                middles[edge] = add_between(edge, 0.5);
                lamina_.vertices[middles[edge]].rim = triangles == 1;
            }
            if (middles.empty()) return;
            divide(middles);
        }
    }

    /// Removes what is inside of a spot.
    void remove(const EatenSpot& spot) {
        const double near = 0.15 * fineness_ * spot.radius;
        std::vector<double> out;
        out.reserve(lamina_.vertices.size());
        for (const LaminaVertex& vertex : lamina_.vertices) {
            const double by = spot.outside(vertex.place);
            // Vertices next to the border are on it, so that no sliver is cut off.
            out.push_back(std::abs(by) < near ? 0.0 : by);
        }
        // The root carries the leaf.
        if (out[0] <= 0.0) return;
        std::map<Edge, std::uint32_t> crossings;
        const auto crossing = [&](std::uint32_t a, std::uint32_t b) {
            const Edge edge = edge_of(a, b);
            const auto [found, is_new] = crossings.try_emplace(edge, 0U);
            if (is_new)
                found->second =
                    add_between(edge, out[edge.first] / (out[edge.first] - out[edge.second]));
            return found->second;
        };
        std::vector<std::array<std::uint32_t, 3>> left;
        left.reserve(lamina_.triangles.size());
        for (const auto& t : lamina_.triangles) {
            const std::array<double, 3> of = {out[t[0]], out[t[1]], out[t[2]]};
            const double low = std::min({of[0], of[1], of[2]}),
                         high = std::max({of[0], of[1], of[2]});
            if (low >= 0.0 && high > 0.0) {
                left.push_back(t);
                continue;
            }
            if (high <= 0.0) continue;
            // The corners of what is left, in order.
            std::vector<std::uint32_t> corners;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t next = (k + 1) % 3;
                if (of[k] >= 0.0) corners.push_back(t[k]);
                if ((of[k] < 0.0 && of[next] > 0.0) || (of[k] > 0.0 && of[next] < 0.0))
                    corners.push_back(crossing(t[k], t[next]));
            }
            for (std::size_t k = 2; k < corners.size(); ++k)
                left.push_back({corners[0], corners[k - 1], corners[k]});
        }
        lamina_.triangles = std::move(left);
    }

    void drop_islands() {
        std::vector<std::uint32_t> piece(lamina_.triangles.size());
        std::iota(piece.begin(), piece.end(), 0U);
        const auto first_of = [&](std::uint32_t i) {
            while (piece[i] != i) i = piece[i] = piece[piece[i]];
            return i;
        };
        std::map<Edge, std::uint32_t> seen;
        std::uint32_t root = 0;
        for (std::uint32_t i = 0; i < piece.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto& t = lamina_.triangles[i];
                if (t[k] == 0) root = i;
                const auto [found, is_new] = seen.try_emplace(edge_of(t[k], t[(k + 1) % 3]), i);
                if (is_new) continue;
                const std::uint32_t a = first_of(i), b = first_of(found->second);
                piece[std::max(a, b)] = std::min(a, b);
            }
        std::vector<std::array<std::uint32_t, 3>> left;
        for (std::uint32_t i = 0; i < piece.size(); ++i)
            if (first_of(i) == first_of(root)) left.push_back(lamina_.triangles[i]);
        lamina_.triangles = std::move(left);
    }

    /// Removes vertices that no triangle uses.
    void compact() {
        constexpr std::uint32_t none = ~0U;
        std::vector<std::uint32_t> place(lamina_.vertices.size(), none);
        place[0] = 0;
        for (const auto& t : lamina_.triangles)
            for (const std::uint32_t corner : t) place[corner] = 0;
        std::vector<LaminaVertex> used;
        for (std::size_t i = 0; i < place.size(); ++i) {
            if (place[i] == none) continue;
            place[i] = static_cast<std::uint32_t>(used.size());
            used.push_back(lamina_.vertices[i]);
        }
        lamina_.vertices = std::move(used);
        for (auto& t : lamina_.triangles)
            for (std::uint32_t& corner : t) corner = place[corner];
    }

    LaminaMesh& lamina_;
    double fineness_;
};

}  // namespace

double EatenSpot::outside(const glm::dvec2& place) const {
    const glm::dvec2 way = place - middle;
    const double distance = glm::length(way);
    if (!(distance > 0.0)) return -radius;
    if (distance > farthest * radius + radius) return distance - radius;
    // Cosines and sines of multiples of the direction, by complex powers.
    const glm::dvec2 one = way / distance;
    const auto times = [](const glm::dvec2& a, const glm::dvec2& b) {
        return glm::dvec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
    };
    const glm::dvec2 two = times(one, one), three = times(two, one), five = times(three, two);
    const double border = radius * (1.0 + glm::dot(waves[0], two) + glm::dot(waves[1], three) +
                                    glm::dot(waves[2], five));
    return distance - border;
}

int most_eaten_spots(double eaten) {
    return eaten > 0.0 ? std::min(24, 3 + static_cast<int>(80.0 * eaten)) : 0;
}

std::vector<EatenSpot> eaten_spots(const Lamina& lamina, double eaten, std::uint32_t seed) {
    std::vector<EatenSpot> spots;
    if (!(eaten > 0.0)) return spots;
    const LaminaSampler sampler(lamina);
    const std::vector<glm::dvec2> border = border_of(lamina);
    const double area = area_of(border), size = std::sqrt(area);
    glm::dvec2 low(0.0), high(0.0);
    for (const glm::dvec2& place : border) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    double left = eaten * area;
    for (int i = 0; i < most_eaten_spots(eaten) && left > least_spot * area; ++i) {
        Random random(seed, purposes::leaf_damage, static_cast<std::uint32_t>(i));
        const double drawn = random.uniform(), kind = random.uniform();
        EatenSpot spot;
        for (std::size_t k = 0; k < 3; ++k) {
            const double x = random.symmetric(), y = random.symmetric();
            spot.waves[k] = wave_sizes[k] * glm::dvec2(x, y) / std::sqrt(2.0);
        }
        const bool is_bite = kind < bites_share;
        const double within = is_bite ? bite_within : 1.0;
        spot.radius = std::min(
            size * (smallest + (largest - smallest) * drawn * drawn) * (is_bite ? 1.4 : 1.0),
            std::sqrt(left / (pi * within)));
        for (int k = 0; k < tries; ++k) {
            const double x = random.uniform(), y = random.uniform();
            spot.middle =
                is_bite ? border[static_cast<std::size_t>(x * static_cast<double>(border.size()))]
                        : low + glm::dvec2(x, y) * (high - low);
            const LaminaPlace at = sampler.at(spot.middle);
            const double reach = EatenSpot::farthest * spot.radius;
            if (glm::length(spot.middle) < reach + from_root) continue;
            if (at.from_main < reach + from_vein) continue;
            // A hole stands off the border; one that opens it is a bite.
            if (!is_bite && (!at.inside || at.affinity > 0.8)) continue;
            const bool is_apart =
                std::all_of(spots.begin(), spots.end(), [&](const EatenSpot& other) {
                    return glm::distance(other.middle, spot.middle) >
                           EatenSpot::farthest * (other.radius + spot.radius);
                });
            if (!is_apart) continue;
            left -= pi * spot.radius * spot.radius * within;
            spots.push_back(spot);
            break;
        }
    }
    return spots;
}

void cut_out(LaminaMesh& lamina, const std::vector<EatenSpot>& spots, double fineness) {
    if (spots.empty()) return;
    Cutter cutter(lamina, fineness);
    for (const EatenSpot& spot : spots) cutter.cut(spot);
    cutter.finish();
}

}  // namespace sporeprint
