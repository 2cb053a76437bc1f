// Keeps the individuals of a colony from cutting through each other.
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

/// Room that a mesh takes: what lies between its lowest and highest point over each cell of a grid across its axis (+y). All of the
/// mesh is in it, and what an umbrella covers is not.
class OccupancyGrid {
  public:
    /// cost  O(triangles); some ten microseconds for a cap
    explicit OccupancyGrid(const Mesh& mesh);

    /// Whether a point of the mesh's own frame lies inside; or no farther than `margin` from it in any of three directions, metres.
    [[nodiscard]] bool holds(const glm::dvec3& point) const;
    [[nodiscard]] bool holds(const glm::dvec3& point, double margin) const;

    /// Points all over the border of the room, no farther apart than a cell.
    [[nodiscard]] const std::vector<glm::dvec3>& border() const { return border_; }

    [[nodiscard]] const glm::dvec3& middle() const { return middle_; }
    [[nodiscard]] double reach() const { return reach_; }  ///< of the border, from the middle
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

/// A mesh in the world: place = at + scale * turn * own.
struct Posture {
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

/// The rotation that takes +y to `up` by the shortest way, after a turn about +y.
///
/// up  unit, not -y
[[nodiscard]] glm::dmat3 upright(const glm::dvec3& up, double turn);

/// Whether the rooms of two meshes meet.
[[nodiscard]] bool meet(const OccupancyGrid& a, const Posture& posture_a, const OccupancyGrid& b,
                        const Posture& posture_b);

/// One of the individuals that all others are likes of, oldest first.
struct ColonyModel {
    OccupancyGrid room;
    double radius =
        1.0;  ///< metres of its own frame that are as wide as its place's stem at cap_scale 1
};

/// An individual that stands.
struct ColonyMember {
    std::size_t place = 0;  ///< of the site
    std::size_t model = 0;
    Posture posture;
    glm::dvec3 rise{0.0}, swing{0.0};  ///< of its stem, after it has given way
    int steps = 0;                     ///< of giving way; 0: it stands as its place says
};

/// Stands individuals at their places, one after the other. One that would meet another gives way: it leans out, then aside; if no
/// lean helps, it is a younger one; then lower or higher; in the end it is left out.
///
/// models  oldest first
/// returns by place; no two rooms meet, and no stem runs through a room
/// cost    O(n) rooms of neighbours for each try
[[nodiscard]] std::vector<ColonyMember> settled(const ColonySite& site,
                                                const std::vector<ColonyModel>& models,
                                                const ColonyParams& params,
                                                const ColonyNature& nature);

}  // namespace sporeprint
