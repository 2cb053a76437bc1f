// Leaves that are being built: their bent middle surface, and the mesh under construction.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/math/elementary.h"
#include "core/mesh/mesh.h"
#include "core/plant/leaf.h"
#include "core/plant/leaf_damage.h"

namespace sporeprint {

/// The middle surface: folded about the middle vein, with waves, bent along it. Unit: length of the
/// lamina.
class Bending {
  public:
    explicit Bending(const LeafShape& shape)
        : shape_(shape),
          fold_(sine_cosine(shape.fold_deg * (pi / 180.0))),
          curl_(shape.curl_deg * (pi / 180.0)) {}

    [[nodiscard]] glm::dvec3 at(const glm::dvec2& place, double lift) const {
        constexpr double soft = 0.04;
        const double x = place.x, y = place.y;
        const double across = std::sqrt(x * x + soft * soft) - soft;
        double up = lift + across * fold_.sine;
        const SineCosine phase = sine_cosine(2.0 * pi * shape_.waves * y);
        up += shape_.wave * 0.6 * (x * x * phase.sine + x * std::abs(x) * phase.cosine);
        const double side = x * fold_.cosine + shape_.bow * y * std::abs(y);
        if (std::abs(curl_) < 1e-9) return {-side, up, y};
        // Relief on the inner side of the bend must not reach the centre of curvature.
        up /= 1.0 + std::max(0.0, -curl_ * up);
        const SineCosine turn = sine_cosine(curl_ * y);
        return {-side, (turn.cosine - 1.0) / curl_ + up * turn.cosine,
                turn.sine / curl_ + up * turn.sine};
    }

  private:
    const LeafShape& shape_;
    SineCosine fold_;
    double curl_;
};

/// A mesh under construction. Positions are in lengths of the lamina until the end, so that normals
/// are equally exact for small and large leaves.
struct Shell {
    std::vector<glm::dvec3> places;
    std::vector<glm::vec2> texture;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    std::uint32_t add(const glm::dvec3& place, const glm::dvec2& texture_point) {
        places.push_back(place);
        texture.emplace_back(glm::clamp(texture_point, 0.0, 1.0));
        return static_cast<std::uint32_t>(places.size() - 1);
    }

    /// Returns the mesh.
    ///
    /// scale   of all positions
    /// throws  GenerationError if a vertex has no normal
    [[nodiscard]] Mesh mesh(double scale) const;
};

/// Returns where a leaf is eaten; nowhere if it is compound.
///
/// seed  of the individual
[[nodiscard]] std::vector<EatenSpot> spots_of(const LeafShape& shape, std::uint32_t seed);

/// Returns both faces of a simple leaf on the grid of a level of detail.
[[nodiscard]] Shell lamina_shell(const LeafShape& shape, const Bending& bent, int lod,
                                 std::uint32_t seed);

/// Returns both faces of a simple leaf without vertices between its main veins and its border.
///
/// steps  of lamina_of()
[[nodiscard]] Shell coarse_lamina_shell(const LeafShape& shape, const Bending& bent, int steps);

/// Returns the leaflets of a compound leaf and its axis at a level of detail, the root of the axis at
/// the origin.
[[nodiscard]] Shell compound_shell(const LeafShape& shape, int lod);

/// Returns the counts of compound_shell(), with its axis, in microseconds.
[[nodiscard]] LeafCount count_of_compound(const LeafShape& shape, int lod);

/// Returns a simple leaf that covers about what a compound one covers: a star of a few corners.
[[nodiscard]] LeafShape star_of(const LeafShape& compound);

/// Returns a leaflet as a simple leaf of length 1.
[[nodiscard]] LeafShape leaflet_of(const LeafShape& compound);

/// The property of the lamina that a polygon of few corners preserves.
enum class Preserved {
    area,   ///< seen from above; bays of the border make it shorter
    extent  ///< length and width; the area as far as moving other corners allows
};

/// Returns the lamina alone, root at the origin, as fans about a centre.
///
/// triangles  8, 12 or 16
[[nodiscard]] Shell foliage_shell(const LeafShape& shape, const Bending& bent,
                                  std::size_t triangles, Preserved preserved);

/// Returns half the breadth of a lamina, in its lengths.
[[nodiscard]] double half_breadth(const Lamina& lamina);

/// Returns whether a lamina is that of a needle, beside which there is space for shoots.
[[nodiscard]] bool is_slim(const Lamina& lamina);

/// A part of the image of a leaf that shows more than it: its middle and half its breadth in texture lengths,
/// in the left half for the upper face.
struct LeafPanel {
    double middle, half;
    double half_breadth;  ///< of what it shows, in its lengths
    double root, length;  ///< of what it shows, in texture lengths
};

/// A shoot of needles, and a spray: a twig with shoots on either side.
inline constexpr LeafPanel shoot_panel{0.205, 0.085, 0.115, 0.925, 0.90},
    spray_panel{0.395, 0.095, 0.34, 0.925, 0.90};

/// Returns the leaf of a tree at its finest level: a simple leaf of four or eight triangles is folded
/// along its middle vein, with two or four corners beside it, and bent, where foliage_leaf() is flat or
/// has a corner less on either side; the card of a shoot is folded, or two cards stand square to each
/// other. All others are those of foliage_leaf().
///
/// triangles  4, 8, 12 or 16
/// group      a group is shown by a card, folded too
/// throws     as foliage_leaf()
[[nodiscard]] Mesh finest_foliage_leaf(const LeafShape& shape, std::size_t triangles,
                                       LeafGroup group = LeafGroup::leaf);

/// Returns the most vertices of finest_foliage_leaf() of so many triangles.
[[nodiscard]] std::size_t finest_leaf_vertices(std::size_t triangles);

/// Throws InvalidInput with all that check() reports of a leaf.
void throw_if_invalid(const LeafShape& shape);

}  // namespace sporeprint
