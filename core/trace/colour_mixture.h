// The colours of a part of a photograph as a mixture of Gaussians.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sporeprint::trace {

/// Gaussians of a mixture.
inline constexpr std::size_t mixture_parts = 5;

/// A colour, sRGB 0..255 in each channel, and how often it counts.
struct WeightedColour {
    glm::dvec3 colour{0.0};
    double weight = 1.0;
};

/// A mixture of Gaussians with full covariances.
class ColourMixture {
  public:
    /// Parts the colours at the means of their widest groups, then moves them once between the Gaussians by
    /// likelihood.
    ///
    /// colours  at least one
    /// source   [OrchardBouman1991] for the parts; [Rother2004] sec. 2.2
    explicit ColourMixture(std::span<const WeightedColour> colours);

    /// Returns the negative logarithm of the density of a colour.
    [[nodiscard]] double cost(const glm::dvec3& colour) const;

  private:
    struct Part {
        glm::dvec3 mean{0.0};
        glm::dmat3 precision{1.0};  ///< the inverse of the covariance
        double constant = 0.0;      ///< negative logarithm of the weight and of the normalisation
    };
    std::vector<Part> parts_;

    [[nodiscard]] static Part fitted(std::span<const WeightedColour> colours, double all);
};

}  // namespace sporeprint::trace
