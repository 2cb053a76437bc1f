// Pictures of twigs and branches with leaves, which stand for groups of leaves in the foliage of trees.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/images.h"
#include "core/plant/leaf_shell.h"

namespace sporeprint {

/// Returns whether trees show groups of such leaves by sprays: they are simple, and no needles, whose shoots have
/// pictures of their own.
[[nodiscard]] bool shows_sprays(const LeafShape& shape);

/// Returns the layout of the image of a tree's leaves.
[[nodiscard]] LeafLayout layout_on_trees(const LeafShape& shape);

/// The groups of leaves that are sprays.
inline constexpr std::array<LeafGroup, 2> all_sprays = {LeafGroup::twig, LeafGroup::branch};

/// Returns what stands for so many leaves, about.
[[nodiscard]] LeafGroup group_of(double leaves);

/// Returns the part of the image of foliage that shows a spray.
[[nodiscard]] const LeafPanel& panel_of(LeafGroup spray);

/// A leaf of a spray; lengths in those of the spray, which reaches from (0, 0) to (0, 1).
struct SprayLeaf {
    glm::dvec2 root{0.0};    ///< of its petiole, across and along
    double angle_deg = 0.0;  ///< from the direction of the spray to its right
    double size = 0.0;       ///< length of its lamina
    double light = 1.0;      ///< of its colours
    glm::dvec2 slope{0.0};   ///< of its normal, across and along the leaf
};

/// A piece of wood between two places.
struct SprayWood {
    glm::dvec2 from{0.0}, to{0.0};
    double half_breadth = 0.0;
};

/// The leaves of a spray, later ones above earlier ones, and their wood.
struct SprayParts {
    std::vector<SprayLeaf> leaves;
    std::vector<SprayWood> wood;
};

/// Returns the parts of a spray. All are about within the triangle of its card: the panel's breadth at the
/// root, and a point at the tip.
///
/// seed  of the image
[[nodiscard]] SprayParts parts_of(LeafGroup spray, std::uint32_t seed);

/// Returns about the share of a card's triangle that its leaves cover: their areas, as if none were before another.
[[nodiscard]] double covered_share(const LeafShape& shape, LeafGroup spray);

/// A point of what a panel shows.
struct PanelPoint {
    glm::dvec3 upper{0.0}, lower{0.0};  ///< linear colours of both faces
    glm::dvec2 slope{0.0};              ///< of the normal, across and along the panel
    double open = 0.0;                  ///< how far light comes to it
    bool is_drawn = true;
};

/// Draws sprays with copies of a leaf that has been painted.
class SprayPainter {
  public:
    /// colours  of the image, sRGB, with the leaf at its place
    /// covered  how far each texel of its left half is on the lamina, 0..1
    /// twig     linear colour of twigs
    SprayPainter(const LeafChart& chart, std::span<const std::uint8_t> colours,
                 std::span<const float> covered, std::size_t side, const glm::dvec3& twig,
                 std::uint32_t seed);

    /// Returns a point of a spray.
    ///
    /// along   from its root, 0, to its tip, 1
    /// across  -1..1
    [[nodiscard]] PanelPoint at(LeafGroup spray, double along, double across) const;

  private:
    // A texel of the leaf at half the resolution.
    struct Texel {
        glm::vec3 upper{0.0F}, lower{0.0F};
        float covered = 0.0F;
    };

    // A leaf of a spray, and its directions.
    struct Placed {
        SprayLeaf leaf;
        glm::dvec2 along{0.0}, right{0.0};
    };

    struct Drawn {
        std::vector<Placed> leaves;
        std::vector<SprayWood> wood;
    };

    [[nodiscard]] const Texel* texel_at(const glm::dvec2& place) const;

    LeafChart chart_;
    std::size_t columns_ = 0, rows_ = 0;
    std::vector<Texel> texels_;
    glm::dvec3 mean_upper_{0.0}, mean_lower_{0.0}, twig_;
    std::array<Drawn, 2> drawn_;
};

}  // namespace sporeprint
