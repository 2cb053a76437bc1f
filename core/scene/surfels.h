// Surfels: places spread evenly over the surface of a scene, by which all that happens on it is computed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/scene/point_grid.h"
#include "core/scene/scene.h"

namespace sporeprint {

/// Number of surfels of a scene at most, and their least distance where the scene is small, metres.
inline constexpr std::size_t most_surfels = 100'000;
inline constexpr double finest_spacing = 0.02;

/// Two places face alike if the cosine of the angle between their normals is greater than this.
inline constexpr double alike_facing = 0.5;

/// A small piece of the surface.
struct Surfel {
    glm::vec3 at{0.0F}, normal{0.0F, 1.0F, 0.0F};
    float area = 0.0F;  ///< of the surface that it stands for, m²
    std::uint32_t triangle = 0;
    std::uint16_t material = 0;
    bool operator==(const Surfel&) const = default;
};

/// The surfels of a scene.
class Surfels {
  public:
    Surfels() = default;
    Surfels(double spacing, std::vector<Surfel> list);

    /// Returns the distance that two surfels that face alike have at least, metres.
    [[nodiscard]] double spacing() const { return spacing_; }
    [[nodiscard]] std::size_t size() const { return list_.size(); }
    [[nodiscard]] const Surfel& operator[](std::size_t i) const { return list_[i]; }
    [[nodiscard]] auto begin() const { return list_.begin(); }
    [[nodiscard]] auto end() const { return list_.end(); }

    /// Calls visit(number) for all surfels within a radius of a place, and for some that are a little farther.
    template <class Visit>
    void each_near(const glm::dvec3& at, double radius, const Visit& visit) const {
        grid_.each_near(at, radius, visit);
    }

    /// Returns the nearest surfel that faces alike; of equally near ones the first.
    ///
    /// normal  a unit vector
    /// radius  metres; nothing is farther
    [[nodiscard]] std::optional<std::uint32_t> nearest(const glm::dvec3& at,
                                                       const glm::dvec3& normal,
                                                       double radius) const;

    /// Returns the memory that they take.
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(*this) + list_.size() * sizeof(Surfel) + grid_.bytes();
    }
    bool operator==(const Surfels& other) const {
        return spacing_ == other.spacing_ && list_ == other.list_;
    }

  private:
    double spacing_ = finest_spacing;
    std::vector<Surfel> list_;
    PointGrid grid_;
};

/// Returns the normal of a triangle, a unit vector.
[[nodiscard]] glm::dvec3 normal_of(const Scene& scene, std::uint32_t triangle);

/// Returns the surfels of a scene.
///
/// Candidates lie at random places, equally many on each square metre, and have random priorities. One becomes a surfel
/// if none of higher priority that faces alike does within the spacing. The area of each candidate belongs to the
/// nearest surfel that faces alike, so that the areas add up to that of the scene.
///
/// most    number of surfels, at least 1: the spacing grows until there are no more
/// cost    0.5 s for 100,000
/// source  dominance as in [Lagae2008], dart throwing in the order of priorities
[[nodiscard]] Surfels surfels_of(const Scene& scene, std::uint32_t seed,
                                 std::size_t most = most_surfels);

}  // namespace sporeprint
