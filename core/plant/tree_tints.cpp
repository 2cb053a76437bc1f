#include "core/plant/tree_tints.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

// No measurement is recorded for the values down to `bark_share`. They were chosen on pictures: at
// the default spread boughs differ visibly and no leaf looks ill.

// Share of its parent's departure that a branch has, its own largest one on the trunk, and by how
// much that of each further order of branches is smaller.
constexpr double inherited = 0.8, first_departure = 0.9, lesser = 0.6;

// Largest departure of a leaf from its twig.
constexpr double of_leaf_alone = 0.18;

// For `spread` 1: what the yellowest leaf lacks of each colour, the bluest one, and how much darker the
// darkest one is. Between both the colour is that of the image; few are
// dark, so that the crown is about as bright as without.
constexpr glm::dvec3 lost_by_yellow(0.0, 0.45, 0.75), lost_by_blue(0.78, 0.24, 0.0);
constexpr double darker = 0.9;

// Of bark, by that of leaves.
constexpr double bark_share = 0.5;

glm::vec3 tint_of(const glm::dvec2& departure, double spread) {
    const double yellow = std::clamp(departure.x, -1.0, 1.0),
                 dark = 0.5 - 0.5 * std::clamp(departure.y, -1.0, 1.0);
    const glm::dvec3 lost =
        std::max(yellow, 0.0) * lost_by_yellow + std::max(-yellow, 0.0) * lost_by_blue;
    return glm::vec3((1.0 - spread * darker * dark * dark) * (1.0 - spread * lost));
}

}  // namespace

TreeTints::TreeTints(const Tree& tree, double spread, std::uint32_t seed)
    : spread_(spread), seed_(seed) {
    const Ramification& grown = tree.ramification;
    std::vector<double> own(grown.nodes.size(), first_departure);
    edges_.resize(grown.nodes.size());
    // Parents precede their children.
    for (std::uint32_t i = 0; i < grown.nodes.size(); ++i) {
        const std::uint32_t parent = grown.nodes[i].parent;
        Edge& edge = edges_[i];
        edge.from = tree.skeleton.nodes[tree.skeleton.segments[i].from].place;
        edge.way = tree.skeleton.nodes[i + 1].place - edge.from;
        if (parent == Ramification::none) continue;
        edge.begin = edge.end = edges_[parent].end;
        own[i] = own[parent];
        if (grown.nodes[i].order == grown.nodes[parent].order) continue;
        Random random(seed, purposes::tree_tints, i);
        const double yellow = random.symmetric(), bright = random.symmetric();
        edge.end = inherited * edge.begin + own[i] * Departure(yellow, bright);
        own[i] *= lesser;
    }
}

glm::vec3 TreeTints::of_bark(const glm::dvec3& place, std::uint32_t edge) const {
    const Edge& own = edges_[edge];
    const double whole = glm::dot(own.way, own.way);
    const double along =
        whole > 0.0 ? std::clamp(glm::dot(place - own.from, own.way) / whole, 0.0, 1.0) : 1.0;
    return tint_of(own.begin + along * (own.end - own.begin), bark_share * spread_);
}

glm::vec3 TreeTints::of_leaf(const PlacedLeaf& leaf, double share) const {
    // Streams of leaves follow those of edges.
    constexpr std::uint32_t first_leaf_stream = 0x80000000U;
    Random random(seed_, purposes::tree_tints, first_leaf_stream + leaf.id);
    const double yellow = random.symmetric(), bright = random.symmetric();
    return tint_of(share * (edges_[leaf.twig].end + of_leaf_alone * Departure(yellow, bright)),
                   spread_);
}

std::vector<glm::vec3> tints_of(const Bark& bark, const TreeTints& tree) {
    std::vector<glm::vec3> tints;
    tints.reserve(bark.edges.size());
    for (std::size_t i = 0; i < bark.edges.size(); ++i)
        tints.push_back(tree.of_bark(glm::dvec3(bark.mesh.positions[i]), bark.edges[i]));
    return tints;
}

std::vector<glm::vec3> tints_of(std::span<const PlacedLeaf> leaves, std::size_t vertices,
                                const TreeTints& tree, double share) {
    std::vector<glm::vec3> tints;
    tints.reserve(leaves.size() * vertices);
    for (const PlacedLeaf& one : leaves)
        tints.insert(tints.end(), vertices, tree.of_leaf(one, share));
    return tints;
}

}  // namespace sporeprint
