#include "core/plant/far_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/mesh/measure.h"
#include "core/mesh/tangents.h"
#include "core/plant/leaf_colour.h"
#include "core/plant/leaf_shell.h"
#include "core/plant/leaf_spray.h"

namespace sporeprint {

namespace {

// By level: triangles of the whole tree, its spikes, and sides of the double pyramids of foliage, 0 for
// flat leaves of two triangles.
constexpr std::array<std::size_t, far_lods> budgets = {400, 96, 24}, spikes_of_level = {13, 4, 1},
                                            sides_of_level = {0, 5, 5};

// Radius of the corners of a triangle by that of a disc: as wide on average over all sides would be
// 1.21; the rest is what a trunk thins less than a spike.
constexpr double corner_radius = 1.4;

// Height up to which the spike of the trunk reaches at least, in that of the tree.
constexpr double trunk_reach = 0.6;

// Part of the image of a leaf that a clump shows, in lengths of the lamina: no vein is as small.
constexpr double plain_reach = 0.006;

// Thickness of a clump at least, in its length: it is not to vanish from its side.
constexpr double least_thickness = 0.3;

// Pixels of a side of the silhouettes that are compared, their azimuths in degrees, and how often the
// size of the foliage is corrected.
constexpr int silhouette_side = 96;
constexpr std::array<double, 3> azimuths_deg = {0.0, 60.0, 120.0};
constexpr int corrections = 5;

/// A maximal run of edges of one order: its first and its last node of the ramification.
struct Axis {
    std::uint32_t first = 0, last = 0;
    double radius = 0.0;  ///< at its beginning
};

/// Returns the thickest axes, the trunk first.
std::vector<Axis> thickest_axes(const Tree& tree, std::size_t most) {
    const Ramification& grown = tree.ramification;
    std::vector<Axis> axes;
    std::vector<std::size_t> axis_of(grown.nodes.size());
    for (std::uint32_t i = 0; i < grown.nodes.size(); ++i) {
        const std::uint32_t parent = grown.nodes[i].parent;
        const bool goes_on =
            parent != Ramification::none && grown.nodes[parent].order == grown.nodes[i].order;
        axis_of[i] = goes_on ? axis_of[parent] : axes.size();
        if (!goes_on) axes.push_back({i, i, tree.skeleton.nodes[i + 1].radius});
        axes[axis_of[i]].last = i;
    }
    // Where a trunk forks low, its spike goes on along the thicker branches into the crown.
    double top = 0.0;
    for (const Skeleton::Node& node : tree.skeleton.nodes) top = std::max(top, node.place.y);
    std::uint32_t& end = axes.front().last;
    while (!grown.leaf(end) && tree.skeleton.nodes[end + 1].place.y < trunk_reach * top)
        end = grown.nodes[end].children[0];
    std::stable_sort(axes.begin() + 1, axes.end(),
                     [](const Axis& a, const Axis& b) { return a.radius > b.radius; });
    if (axes.size() > most) axes.resize(most);
    return axes;
}

/// Appends a spike of three sides with a base, whose tip is at the end of an axis.
void add_spike(const Tree& tree, const Axis& axis, Bark& bark) {
    const glm::dvec3 from = tree.skeleton.nodes[tree.skeleton.segments[axis.first].from].place,
                     to = tree.skeleton.nodes[axis.last + 1].place;
    const double length = glm::distance(from, to), radius = corner_radius * axis.radius;
    if (!(length > 0.0) || !(radius > 0.0)) return;
    const glm::dvec3 along = (to - from) / length,
                     side = square_to(along, glm::dvec3(0.0, 0.0, 1.0)),
                     third = glm::cross(along, side);
    Mesh& mesh = bark.mesh;
    const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
    const auto add = [&](const glm::dvec3& place, const glm::dvec3& normal, const glm::vec2& uv,
                         std::uint32_t edge) {
        mesh.positions.emplace_back(place);
        mesh.normals.emplace_back(glm::normalize(normal));
        mesh.texture_coordinates.push_back(uv);
        bark.edges.push_back(edge);
    };
    const auto out = [&](double turns) {
        const SineCosine at = sine_cosine(2.0 * pi * turns);
        return at.cosine * side + at.sine * third;
    };
    const double slope = radius / length;
    // The last corner is the first one again, at the other end of the image.
    for (int k = 0; k <= 3; ++k)
        add(from + radius * out((k % 3) / 3.0), out((k % 3) / 3.0) + slope * along,
            {static_cast<float>(k) / 3.0F, 0.0F}, axis.first);
    for (int k = 0; k < 3; ++k)
        add(to, out((k + 0.5) / 3.0) + slope * along, {(static_cast<float>(k) + 0.5F) / 3.0F, 1.0F},
            axis.last);
    constexpr std::array<glm::vec2, 3> end = {{{0.0F, 0.0F}, {0.1F, 0.0F}, {0.0F, 0.1F}}};
    for (int k = 0; k < 3; ++k)
        add(from + radius * out(k / 3.0), -along, end[static_cast<std::size_t>(k)], axis.first);
    for (std::uint32_t k = 0; k < 3; ++k)
        for (const std::uint32_t corner : {k, k + 1, k + 4}) mesh.indices.push_back(shift + corner);
    for (const std::uint32_t corner : {7U, 9U, 8U}) mesh.indices.push_back(shift + corner);
}

/// A place of a lamina at which its colour is looked at.
struct PlainPlace {
    glm::dvec2 place{0.0, 0.45};
    double clear = 0.0;  ///< distance from veins, border and what is eaten
    double turn = 0.0;   ///< how early it turns in autumn, see autumn_depth()
};

/// Returns the place of a lamina whose colour is that of the lamina through all seasons: as far from veins, border and
/// what is eaten as a clump needs, or else as far as there is, and of these one that turns when half of the lamina has.
glm::dvec2 plain_place_of(const LeafShape& shape, const Lamina& lamina) {
    const LaminaSampler sampler(lamina);
    const std::vector<EatenSpot> spots = spots_of(shape, 1);
    std::vector<PlainPlace> places;
    std::vector<double> turns;  // of all of the lamina
    constexpr int steps = 40;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            PlainPlace one{{0.6 * (i + 0.5) / steps, (k + 0.5) / steps}};
            const LaminaPlace at = sampler.at(one.place);
            if (!at.inside) continue;
            one.turn = autumn_depth(at);
            turns.push_back(one.turn);
            one.clear = std::min({at.from_main, at.from_side, 0.1});
            for (const EatenSpot& spot : spots)
                one.clear = std::min(one.clear, spot.outside(one.place));
            if (at.affinity <= 0.85) places.push_back(one);
        }
    if (places.empty()) return PlainPlace().place;
    std::ranges::nth_element(turns, turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2));
    const double half = turns[turns.size() / 2];
    double most = 0.0;
    for (const PlainPlace& one : places) most = std::max(most, one.clear);
    const double enough = std::min(most, 2.0 * plain_reach);
    const PlainPlace* found = nullptr;
    for (const PlainPlace& one : places)
        if (one.clear >= enough &&
            (found == nullptr || std::abs(one.turn - half) < std::abs(found->turn - half)))
            found = &one;
    return found->place;
}

/// Returns a double pyramid about the origin: its base in the plane square to y has corners at a
/// distance of 1, its tips are 1 above and below it. It shows the colour of either face of a leaf,
/// whose veins would be seen to be too large.
Mesh clump_mesh(const LeafShape& shape, std::size_t sides) {
    const Lamina lamina = lamina_of(shape.venation, leaf_steps(shape.venation, 0));
    const LeafChart chart = chart_of(lamina, layout_on_trees(shape));
    const glm::dvec2 middle = plain_place_of(shape, lamina);
    Mesh mesh;
    for (const bool upper : {true, false}) {
        const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
        const double sign = upper ? 1.0 : -1.0;
        const auto add = [&](const glm::dvec3& place) {
            mesh.positions.emplace_back(place);
            mesh.normals.emplace_back(place);
            mesh.texture_coordinates.emplace_back(
                chart.texture_point(middle + plain_reach * glm::dvec2(-place.x, place.z), upper));
        };
        add({0.0, sign, 0.0});
        for (std::size_t k = 0; k < sides; ++k) {
            const SineCosine at =
                sine_cosine(2.0 * pi * static_cast<double>(k) / static_cast<double>(sides));
            add({at.sine, 0.0, at.cosine});
        }
        for (std::uint32_t k = 0; k < sides; ++k) {
            const auto next = static_cast<std::uint32_t>((k + 1) % sides);
            const std::array<std::uint32_t, 3> corners = {0, 1 + (upper ? k : next),
                                                          1 + (upper ? next : k)};
            for (const std::uint32_t corner : corners) mesh.indices.push_back(shift + corner);
        }
    }
    add_tangents(mesh);
    return mesh;
}

/// Counts the pixels that triangles cover from one side.
class Silhouette {
  public:
    /// box  of what is seen, with a margin about it
    Silhouette(const Bounds& box, double azimuth_deg)
        : covered_(static_cast<std::size_t>(silhouette_side) * silhouette_side, false) {
        const SineCosine at = sine_cosine(radians(azimuth_deg));
        right_ = {at.cosine, 0.0, -at.sine};
        const glm::dvec3 size(box.max - box.min);
        middle_ = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
        const double width = std::max(std::sqrt(size.x * size.x + size.z * size.z), size.y);
        scale_ = silhouette_side / (1.3 * width);
    }

    void add(const Mesh& mesh) {
        std::vector<glm::dvec2> seen;
        seen.reserve(mesh.positions.size());
        for (const glm::vec3& place : mesh.positions) {
            const glm::dvec3 way = glm::dvec3(place) - middle_;
            seen.emplace_back(0.5 * silhouette_side + scale_ * glm::dot(right_, way),
                              0.5 * silhouette_side + scale_ * way.y);
        }
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
            fill(seen[mesh.indices[i]], seen[mesh.indices[i + 1]], seen[mesh.indices[i + 2]]);
    }

    [[nodiscard]] double area() const {
        return static_cast<double>(std::count(covered_.begin(), covered_.end(), true));
    }

  private:
    static double twice_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    }

    void fill(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
        const double turn = twice_area(a, b, c) < 0.0 ? -1.0 : 1.0;
        const glm::dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
        const auto first = [](double at) {
            return std::max(0, static_cast<int>(std::ceil(std::max(at, 0.0) - 0.5)));
        };
        for (int y = first(low.y); y < silhouette_side && y + 0.5 <= high.y; ++y)
            for (int x = first(low.x); x < silhouette_side && x + 0.5 <= high.x; ++x) {
                const glm::dvec2 p(x + 0.5, y + 0.5);
                if (turn * twice_area(a, b, p) >= 0.0 && turn * twice_area(b, c, p) >= 0.0 &&
                    turn * twice_area(c, a, p) >= 0.0)
                    covered_[static_cast<std::size_t>(y) * silhouette_side +
                             static_cast<std::size_t>(x)] = true;
            }
    }

    glm::dvec3 right_{1.0, 0.0, 0.0}, middle_{0.0};
    double scale_ = 1.0;
    std::vector<bool> covered_;
};

/// Returns the pixels that bark and leaves cover, all sides together.
double covered_area(const Bounds& box, const Mesh& bark, const Mesh& leaves) {
    double area = 0.0;
    for (const double azimuth_deg : azimuths_deg) {
        Silhouette seen(box, azimuth_deg);
        seen.add(bark);
        seen.add(leaves);
        area += seen.area();
    }
    return area;
}

/// Changes the size of leaves about their middles.
///
/// middle  of the mesh of which they are copies, along its axis
void resize(std::vector<PlacedLeaf>& leaves, double factor, double middle) {
    for (PlacedLeaf& leaf : leaves) {
        leaf.place += (1.0 - factor) * leaf.size * middle * leaf.along;
        leaf.size *= factor;
    }
}

/// Returns a mesh of what foliage covers: cards are as much smaller as their images are clear.
///
/// middle  as above
Mesh covering(const Foliage& foliage, double middle) {
    if (foliage.covered >= 1.0) return merged_leaves(foliage.leaves, foliage.leaf);
    std::vector<PlacedLeaf> leaves = foliage.leaves;
    resize(leaves, std::sqrt(foliage.covered), middle);
    return merged_leaves(leaves, foliage.leaf);
}

}  // namespace

FarCount far_count(int level, std::size_t leaves) {
    const auto at = static_cast<std::size_t>(std::clamp(level, 0, far_lods - 1));
    FarCount count;
    count.spikes = leaves > 0 ? spikes_of_level[at] : budgets[at] / FarCount::spike_triangles;
    count.leaf_triangles = sides_of_level[at] > 0 ? 2 * sides_of_level[at] : 2;
    count.leaf_vertices = sides_of_level[at] > 0 ? 2 * (sides_of_level[at] + 1) : 6;
    count.leaves = std::min(
        leaves, (budgets[at] - std::min(budgets[at], FarCount::spike_triangles * count.spikes)) /
                    count.leaf_triangles);
    return count;
}

FarTree far_tree(const Tree& tree, const LeafStyle& style, const LeafShape& shape,
                 std::uint32_t seed, int level) {
    const Foliage last = foliage_of(tree, style, shape, seed, tree_lods - 1);
    const FarCount count = far_count(level, last.leaves.size());
    FarTree made;
    for (const Axis& axis : thickest_axes(tree, count.spikes)) add_spike(tree, axis, made.bark);
    add_tangents(made.bark.mesh);
    if (last.leaves.empty()) return made;
    const std::size_t sides = sides_of_level[static_cast<std::size_t>(level)];
    const FarCount first = far_count(0, last.leaves.size());
    made.foliage.each =
        last.each * static_cast<double>(last.leaves.size()) / static_cast<double>(first.leaves);
    set_group_leaf(made.foliage, shape, last.group, 2);
    made.foliage.leaves = grouped(tree, last.leaves, last.leaf, made.foliage.leaf, first.leaves,
                                  last.covered / made.foliage.covered);
    if (sides > 0) {
        made.foliage.leaves =
            clumped(tree, made.foliage.leaves, made.foliage.leaf, count.leaves, least_thickness);
        made.foliage.leaf = clump_mesh(shape, sides);
        made.foliage.covered = 1.0;
    }
    const Mesh bark = bark_of(tree, tree_lods - 1).mesh,
               leaves = covering(last, surface_moments(last.leaf).middle.z);
    Bounds box = bounds(leaves);
    box = united(box, bounds(bark));
    const double wanted = covered_area(box, bark, leaves);
    const double middle = surface_moments(made.foliage.leaf).middle.z;
    for (int i = 0; i < corrections; ++i) {
        const double found = covered_area(box, made.bark.mesh, covering(made.foliage, middle));
        if (!(found > 0.0)) break;
        resize(made.foliage.leaves, std::clamp(std::sqrt(wanted / found), 0.7, 1.5), middle);
    }
    return made;
}

}  // namespace sporeprint
