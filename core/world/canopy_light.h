// The light that crowns leave to the ground: how much of the sky passes through the leaves above a place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sporeprint {

/// A crown: an ellipsoid about a vertical axis. Heights are those of places, as metres above the zero of the ground.
struct Crown {
    double x = 0.0, y = 0.0;       ///< of its axis, metres
    double base = 0.0, top = 0.0;  ///< heights of its lowest and its highest point
    double radius = 0.0;           ///< metres, greater than 0
    double density = 1.0;          ///< of its leaves, as a share of leaf_area_density
    bool operator==(const Crown&) const = default;
};

/// Leaf area in a crown, m^2 of leaves per m^3, and the share of it that stands in the way of light.
inline constexpr double leaf_area_density = 0.5, extinction = 0.5;

/// Crowns shade places within this distance of their axes, metres.
inline constexpr double shade_reach = 20.0;

/// Number of directions of the sky that light comes from: the zenith, and eight at a height of 55 degrees.
inline constexpr std::size_t sky_directions = 9;

/// The crowns above a piece of ground, ready for the light of many places.
class CanopyLight {
  public:
    /// crowns  in an order that does not depend on the piece of ground, as by the ids of their trees: the bits of a
    ///         result depend on it
    /// cost    1 us per crown
    explicit CanopyLight(std::span<const Crown> crowns);

    /// Returns the share of the light of the sky that reaches a place, the mean of nine directions of e^(-0.5 l d). The
    /// path l through crowns is the sum of chords through ellipsoids, so that crowns in each other count twice.
    ///
    /// x, y, height  of the place, metres; it may lie within a crown
    /// leaves        share of the leaves that are out on the day, 0..1
    /// source        [Monsi1953]
    /// cost          0.4 us in a wood
    [[nodiscard]] double at(double x, double y, double height, double leaves) const;

  private:
    /// The crowns that may shade the places of each cell from one direction, by cells.
    struct Index {
        std::vector<std::uint32_t> first, crowns;
    };
    [[nodiscard]] Index index_of(std::size_t direction) const;

    std::vector<Crown> crowns_;
    double west_ = 0.0, south_ = 0.0;  ///< of the cells
    int columns_ = 0, rows_ = 0;
    std::array<Index, sky_directions> index_;
};

/// Places on a lattice, by rows from south to north, each from west to east.
struct PlaceLattice {
    double west = 0.0, south = 0.0;  ///< of the first place, metres
    double step = 1.0;               ///< distance of neighbours, metres
    int columns = 0, rows = 0;
};

/// Returns the light of all places of a lattice, with the bits of CanopyLight::at(). Each crown is drawn on the places
/// that it shades, which for many places is faster than to look for the crowns of each.
///
/// crowns   as for CanopyLight
/// heights  of the places, metres
/// leaves   share of the leaves that are out on the day, 0..1
/// throws   InvalidInput if there is not one height for each place
/// cost     2 ms for 64^2 places and 200 crowns
[[nodiscard]] std::vector<double> canopy_light_on(const PlaceLattice& places,
                                                  std::span<const double> heights,
                                                  std::span<const Crown> crowns, double leaves);

}  // namespace sporeprint
