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

/// A conservative bound of the space that a mesh occupies: a grid of square cells perpendicular to
/// its axis (+y), each with the interval from the lowest to the highest point of the mesh above it.
/// It contains the whole mesh and fills the gaps between gills, but not the hollow below a cap that
/// has no stem. Very thin intervals are thickened.
class OccupancyGrid {
  public:
    /// cost  O(triangles); some ten microseconds for a cap
    explicit OccupancyGrid(const Mesh& mesh);

    /// Returns true if a point in the mesh's own frame lies inside.
    [[nodiscard]] bool contains(const glm::dvec3& point) const;
    /// Returns true if the axis-aligned cube with half side `margin` (metres) around a point
    /// intersects the inside.
    [[nodiscard]] bool contains(const glm::dvec3& point, double margin) const;

    /// Returns sample points of the boundary: both ends of the interval of every second cell, and
    /// of each cell at the edge of the occupied area, with the middle of that interval.
    [[nodiscard]] const std::vector<glm::dvec3>& border() const { return border_; }

    /// Returns the centre of the mesh's bounding box.
    [[nodiscard]] const glm::dvec3& middle() const { return middle_; }
    /// Returns the radius of a sphere about middle() that contains the occupied space.
    [[nodiscard]] double reach() const { return reach_; }
    /// Returns the side of a cell, metres.
    [[nodiscard]] double cell() const { return cell_; }

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

    /// Transforms a point from the mesh's own frame to the world.
    [[nodiscard]] glm::dvec3 world(const glm::dvec3& own) const {
        return at + scale * (turn * own);
    }
    /// Transforms a point from the world to the mesh's own frame.
    [[nodiscard]] glm::dvec3 own(const glm::dvec3& world) const {
        return (world - at) * turn / scale;
    }
};

/// Returns a rotation about +y by `turn`, followed by the smallest rotation that takes +y to `up`.
///
/// up    unit, not -y
/// turn  radians
[[nodiscard]] glm::dmat3 upright(const glm::dvec3& up, double turn);

/// Returns true if the occupied spaces of two meshes overlap, that is, if a border() point of
/// either lies inside the other.
[[nodiscard]] bool overlap(const OccupancyGrid& a, const Pose& pose_a, const OccupancyGrid& b,
                           const Pose& pose_b);

/// One of the distinct individuals, oldest first; all members of a colony are instances of them.
struct ColonyModel {
    OccupancyGrid occupancy;
    /// The radius of its stem in its own frame, metres: an instance is scaled so that this becomes
    /// the radius of its place's stem, times cap_scale if the colony has stems.
    double radius = 1.0;
};

/// A placed individual.
struct ColonyMember {
    std::size_t place = 0;  ///< index into ColonySite::places
    std::size_t model = 0;  ///< index into the models
    Pose pose;
    glm::dvec3 rise{0.0}, swing{0.0};  ///< of its stem, after adjustment
    int steps = 0;                     ///< number of adjustments tried; 0: unchanged
};

/// Places individuals one after the other (greedy placement, in the order of site.places). If an
/// individual would intersect one that is already placed, adjustments are tried until one is free
/// of intersections: leaning outwards, leaning away from the other, the same with younger models,
/// and all of these with a lower or higher stem (for brackets: position). If none is, the
/// individual is omitted.
///
/// models   oldest first, at least one
/// returns  the individuals that were placed, in the order of places; no two occupied spaces
///          overlap, and no stem crosses an occupied space
/// cost     O(n) occupied spaces of neighbours for each try
[[nodiscard]] std::vector<ColonyMember> placed_members(const ColonySite& site,
                                                       const std::vector<ColonyModel>& models,
                                                       const ColonyParams& params,
                                                       const ColonyTraits& traits);

}  // namespace sporeprint
