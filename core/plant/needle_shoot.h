// Pictures of shoots of needles and of sprays of such shoots, which cards in the foliage of conifers show.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/math/elementary.h"
#include "core/plant/leaf_colour.h"
#include "core/plant/leaf_spray.h"

namespace sporeprint {

/// Draws shoots.
class ShootPainter {
  public:
    /// Linear colours.
    struct Colours {
        LeafColourMap::Faces needle, young;  ///< of a needle, and of its tip
        glm::dvec3 twig{0.0};
    };

    /// snow  on upper faces, 0..1
    /// seed  of the image
    ShootPainter(const Colours& colours, double snow, std::uint32_t seed);

    /// Returns a point of a shoot: three layers of needles on either side of a twig, the lower ones dark, and the
    /// snow on them, which also lies between their inner parts.
    ///
    /// along   from its root, 0, to its tip, 1
    /// across  -1..1
    [[nodiscard]] PanelPoint shoot_at(double along, double across) const {
        return snowy(along, across, 1.0, 0);
    }

    /// Returns a point of a spray: shoots on either side of one in the middle, shorter towards its tip.
    ///
    /// along, across  as of a shoot
    [[nodiscard]] PanelPoint spray_at(double along, double across) const;

  private:
    /// A shoot beside that in the middle of a spray; lengths in that of the spray.
    struct Side {
        double root = 0.0, length = 0.0;
        SineCosine open{};  ///< of its angle with the spray
    };
    static constexpr std::size_t shoots_on_side = 8;

    /// How deep snow lies at a place, less than 0 where there is none, and how it slopes across and along.
    struct Snow {
        double depth = -1.0;
        glm::dvec2 slope{0.0};
    };

    [[nodiscard]] std::array<Side, 2 * shoots_on_side> sides() const;
    [[nodiscard]] PanelPoint between_needles() const;
    [[nodiscard]] PanelPoint needles_at(double along, double across, double dense) const;
    [[nodiscard]] Snow snow_at(double along, double across, std::uint32_t shoot) const;
    [[nodiscard]] PanelPoint snowy(double along, double across, double dense,
                                   std::uint32_t shoot) const;

    Colours colours_;
    double snow_;
    std::uint32_t seed_;
    std::array<Side, 2 * shoots_on_side> sides_;
    std::vector<float> lumps_;  ///< of snow, by row across and column along
};

}  // namespace sporeprint
