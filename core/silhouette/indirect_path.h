// Indirect morph paths for mixes whose linear interpolation self-intersects: part of the weight of
// their shapes is transferred to mature stages or to an intermediate shape.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/silhouette/aligned.h"

namespace sporeprint {

/// The shape through which the mix of two stages passes; `none` means linear interpolation.
enum class Via : std::uint8_t { none, mature, intermediate };

/// The choice of path for every pair of shapes of a set, and the effective weights along it.
class IndirectPaths {
  public:
    /// The degree in t of the weights of a mix along an indirect path.
    static constexpr std::size_t path_degree = 9;
    /// A weight along such a path by its Bernstein coefficients.
    using Weight = std::array<double, path_degree + 1>;

    explicit IndirectPaths(std::span<const SpeciesRange> species);

    /// Makes mixes of two shapes pass through another shape.
    void route(std::size_t i, std::size_t j, Via via);

    [[nodiscard]] Via via(std::size_t i, std::size_t j) const {
        return none() ? Via::none : vias_[i * mature_.size() + j];
    }

    /// Returns true if all paths are linear interpolations.
    [[nodiscard]] bool none() const { return vias_.empty(); }

    /// Returns the effective weights of the shapes, the intermediate shape's last: of the weight of
    /// shape s the share 1 - (1 - w)^7 (1 + 7 w) is transferred to the mature stage of its species
    /// or to the intermediate shape, where w is the weight of the shapes with which s
    /// self-intersects. This is 28 w^2 for small w, so that a shape of weight 1 is reproduced, and
    /// almost 1 from w = 0.5 on: a stage of little weight makes no mix of others self-intersect.
    /// With x = 1 - w it is w (1 + x + ... + x^6 - 7 x^7), so that each conflicting shape transfers
    /// its part along its own path.
    [[nodiscard]] std::vector<double> effective_weights(std::span<const double> weights) const;

    /// Returns the effective weights of the mixes from one to another, each as a polynomial of the
    /// path parameter.
    [[nodiscard]] std::vector<Weight> effective_weights(std::span<const double> from,
                                                        std::span<const double> to) const;

    [[nodiscard]] std::size_t bytes() const {
        return mature_.size() * sizeof(std::size_t) + vias_.size() * sizeof(Via);
    }

  private:
    std::vector<std::size_t> mature_;  // index of the mature stage of each shape's species
    std::vector<Via> vias_;  // of shapes i and j at [i * shapes + j]; empty if all are linear
};

}  // namespace sporeprint
