#include "core/plant/tree_sway.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sporeprint {

namespace {

/// The part of the trunk within so many radii of its foot is rigid; that of a main branch within so
/// many of its base moves with the trunk.
constexpr double clear_radii = 2.0;

double square(double x) { return x * x; }

/// Returns 0 below 0, 1 above 1, with no step of the slope at either.
double smoothstep(double x) {
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace

TreeSway::TreeSway(const Tree& tree) {
    const Ramification& grown = tree.ramification;
    const std::vector<Skeleton::Node>& nodes = tree.skeleton.nodes;
    branch_of_.assign(grown.nodes.size(), 0);
    const int trunk_order = grown.nodes[0].order;
    // Parents precede their children.
    for (std::uint32_t i = 0; i < grown.nodes.size(); ++i) {
        const Skeleton::Node& end = nodes[i + 1];
        reach_ = std::max(reach_, glm::length(end.place));
        const std::uint32_t parent = grown.nodes[i].parent;
        if (parent == Ramification::none) continue;
        std::uint32_t& branch = branch_of_[i];
        branch = branch_of_[parent];
        if (branch == 0) {
            if (grown.nodes[i].order == trunk_order) continue;
            const Skeleton::Node& base = nodes[tree.skeleton.segments[i].from];
            branches_.push_back({base.place, clear_radii * base.radius, 0.0,
                                 static_cast<double>(phase_of(branches_.size() + 1))});
            branch = static_cast<std::uint32_t>(branches_.size());
        }
        Branch& own = branches_[branch - 1];
        own.length = std::max(own.length, glm::distance(end.place, own.base) - own.clear);
    }
    clear_ = std::min(clear_radii * nodes[0].radius, 0.5 * reach_);
}

Sway TreeSway::at(const glm::dvec3& place, std::uint32_t edge) const {
    const double along_tree =
        std::clamp((glm::length(place) - clear_) / (reach_ - clear_), 0.0, 1.0);
    Sway sway;
    double bend = 0.5 * square(along_tree);
    if (const std::uint32_t number = branch_of_[edge]; number > 0) {
        const Branch& branch = branches_[number - 1];
        const double along =
            branch.length > 0.0
                ? std::clamp((glm::distance(place, branch.base) - branch.clear) / branch.length,
                             0.0, 1.0)
                : 0.0;
        bend += 0.5 * square(along);
        sway.phase = static_cast<float>(branch.phase * smoothstep(along));
        sway.branch = static_cast<float>((number - 1) % 255 + 1) / 255.0F;
    }
    sway.bend = static_cast<float>(bend);
    return sway;
}

std::vector<float> flutter_of(const Mesh& leaf) {
    float farthest = 0.0F;
    for (const glm::vec3& place : leaf.positions)
        farthest = std::max(farthest, glm::dot(place, place));
    std::vector<float> flutter;
    flutter.reserve(leaf.positions.size());
    for (const glm::vec3& place : leaf.positions)
        flutter.push_back(farthest > 0.0F ? glm::dot(place, place) / farthest : 0.0F);
    return flutter;
}

std::vector<Sway> sway_of(const Bark& bark, const TreeSway& tree) {
    std::vector<Sway> sway;
    sway.reserve(bark.edges.size());
    for (std::size_t i = 0; i < bark.edges.size(); ++i)
        sway.push_back(tree.at(glm::dvec3(bark.mesh.positions[i]), bark.edges[i]));
    return sway;
}

std::vector<Sway> sway_of(std::span<const PlacedLeaf> leaves, const Mesh& leaf,
                          const TreeSway& tree) {
    const std::vector<float> flutter = flutter_of(leaf);
    std::vector<Sway> sway;
    sway.reserve(leaves.size() * flutter.size());
    for (const PlacedLeaf& one : leaves) {
        Sway own = tree.at(one.place, one.twig);
        for (const float share : flutter) {
            own.flutter = share;
            sway.push_back(own);
        }
    }
    return sway;
}

}  // namespace sporeprint
