// Local free-form deformation: a box of space displaced by a Bernstein lattice; everything outside
// is unchanged.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sporeprint {

/// A point of the surface at rest (straight axis) and two unit tangent directions; the outward
/// normal is meridian x azimuth.
struct SurfacePoint {
    glm::dvec3 position, meridian, azimuth;
};

/// A lattice of (degree + 1)^3 control points over an axis-aligned box; only displaced points are
/// stored.
class FreeForm {
  public:
    struct Displaced {
        std::array<int, 3> index;  ///< 0..degree along x, y, z
        glm::dvec3 by;             ///< metres
    };

    /// degree  1..7 along each axis. The box joins its surroundings C1 when the two outermost
    ///         layers on each side are not displaced.
    /// throws  std::invalid_argument if an index or a degree is out of range, or the box is empty
    /// source  [Sederberg1986], in displacement form: no displacement is the exact identity
    FreeForm(const glm::dvec3& corner, const glm::dvec3& size, std::array<int, 3> degree,
             std::vector<Displaced> displaced);

    [[nodiscard]] bool contains(const glm::dvec3& p) const {
        const glm::dvec3 q = p - corner_;
        return q.x > 0.0 && q.y > 0.0 && q.z > 0.0 && q.x < size_.x && q.y < size_.y &&
               q.z < size_.z;
    }

    /// Displaces `p`, and the two directions by the Jacobian at p; a point outside the box is
    /// unchanged.
    void apply(glm::dvec3& p, glm::dvec3& first, glm::dvec3& second) const {
        if (contains(p)) move(p, first, second);
    }

    /// Does the same for many points; bit-identical, and much faster for a dent.
    void apply(std::span<SurfacePoint> points) const;

    /// Does the same for positions without directions.
    void apply(std::span<glm::dvec3> places) const;

    /// Returns an upper bound of the norm of the displacement's derivative; below 1 the map is
    /// injective and keeps orientation.
    [[nodiscard]] double stretch_bound() const;

  private:
    void move(glm::dvec3& p, glm::dvec3& first, glm::dvec3& second) const;

    glm::dvec3 corner_, size_;
    std::array<int, 3> degree_;
    std::vector<Displaced> displaced_;
    bool is_dent_ = false;
};

/// Returns a dent or bulge: degree 4 with one free control point, displaced so that the centre
/// moves by `push`, or as far as the map stays injective.
[[nodiscard]] FreeForm dent(const glm::dvec3& centre, const glm::dvec3& size,
                            const glm::dvec3& push);

}  // namespace sporeprint
