// Separation of the individuals of a colony, so that they do not intersect.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/colony/habit.h"
#include "core/mesh/mesh.h"

namespace sporeprint {

/// The space that a mesh occupies, as the interval between its lowest and highest point over each
/// cell of a grid perpendicular to its axis (+y). It contains the whole mesh; the space under a cap
/// is outside.
class OccupancyGrid {
  public:
    /// cost  O(triangles); some ten microseconds for a cap
    explicit OccupancyGrid(const Mesh& mesh);

    /// Returns true if a point in the mesh's own frame lies inside, or no farther than `margin`
    /// from the inside along any of three axes, metres.
    [[nodiscard]] bool contains(const glm::dvec3& point) const;
    [[nodiscard]] bool contains(const glm::dvec3& point, double margin) const;

    /// Returns points on the whole boundary, no farther apart than a cell.
    [[nodiscard]] const std::vector<glm::dvec3>& border() const { return border_; }

    [[nodiscard]] const glm::dvec3& middle() const { return middle_; }
    [[nodiscard]] double reach() const { return reach_; }  ///< radius about the middle
    [[nodiscard]] double cell() const { return cell_; }    ///< side of a cell

  private:
    static constexpr int cells = 20;
    struct Span {
        float low = 1.0F, high = -1.0F;  // empty
    };
    [[nodiscard]] const Span& at(int x, int z) const {
        return spans_[static_cast<std::size_t>(z * cells + x)];
    }
    std::array<Span, cells * cells> spans_{};
    glm::dvec2 corner_{0.0};
    double cell_ = 0.0, reach_ = 0.0;
    glm::dvec3 middle_{0.0};
    std::vector<glm::dvec3> border_;
};

/// The pose of a mesh in the world: world = at + scale * turn * own.
struct Pose {
    glm::dvec3 at{0.0};
    glm::dmat3 turn{1.0};  ///< a rotation
    double scale = 1.0;

    [[nodiscard]] glm::dvec3 world(const glm::dvec3& own) const {
        return at + scale * (turn * own);
    }
    [[nodiscard]] glm::dvec3 own(const glm::dvec3& world) const {
        return (world - at) * turn / scale;
    }
};

/// Returns the smallest rotation that takes +y to `up`, after a rotation about +y by `turn`.
///
/// up  unit, not -y
[[nodiscard]] glm::dmat3 upright(const glm::dvec3& up, double turn);

/// Returns true if the occupied spaces of two meshes overlap.
[[nodiscard]] bool overlap(const OccupancyGrid& a, const Pose& pose_a, const OccupancyGrid& b,
                           const Pose& pose_b);

/// One of the distinct individuals, oldest first; all members of a colony are instances of them.
struct ColonyModel {
    OccupancyGrid occupancy;
    double radius =
        1.0;  ///< metres of its own frame that are as wide as its place's stem at cap_scale 1
};

/// A placed individual.
struct ColonyMember {
    std::size_t place = 0;  ///< of the site
    std::size_t model = 0;
    Pose pose;
    glm::dvec3 rise{0.0}, swing{0.0};  ///< of its stem, after adjustment
    int steps = 0;                     ///< number of adjustments tried; 0: unchanged
};

/// Places individuals one after the other (greedy placement, oldest first). One that would
/// intersect another is adjusted: it leans outwards, then sideways; if no lean helps, a younger
/// model is used; then a lower or higher one; finally it is left out.
///
/// models   oldest first
/// returns  in the order of places; no two occupied spaces overlap, and no stem crosses an occupied
///          space
/// cost     O(n) occupied spaces of neighbours for each try
[[nodiscard]] std::vector<ColonyMember> placed_members(const ColonySite& site,
                                                       const std::vector<ColonyModel>& models,
                                                       const ColonyParams& params,
                                                       const ColonyTraits& traits);

}  // namespace sporeprint
