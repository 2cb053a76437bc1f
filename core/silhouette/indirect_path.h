// Detours of mixes whose straight way would fold: what of their weights goes over to mature stages, or to a bud.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/silhouette/aligned.h"

namespace sporeprint {

/// What a mix of two stages goes by on its way.
enum class Via : std::uint8_t { none, mature, bud };

class Detours {
  public:
    /// Degree in t of the weights of a mix along a way with detours.
    static constexpr std::size_t way_degree = 9;
    /// A weight along such a way by its Bernstein coefficients.
    using Weight = std::array<double, way_degree + 1>;

    explicit Detours(std::span<const Kin> kins);

    /// Leads mixes of two shapes by something.
    void lead(std::size_t i, std::size_t j, Via by);

    [[nodiscard]] Via via(std::size_t i, std::size_t j) const {
        return none() ? Via::none : vias_[i * mature_.size() + j];
    }

    /// Whether every way is straight.
    [[nodiscard]] bool none() const { return vias_.empty(); }

    /// The weights of the shapes after the detours, the bud's last: of what shape s gives, 1 - (1 - w)^7 (1 + 7 w) goes over to the
    /// mature stage of its kin or to the bud, where w is the weight of what it folds with. That is 28 w^2 at first, so that nothing
    /// happens near its own corner, and nearly all from a half on: a stage of little weight folds no mix of others, whoever they are.
    /// With x = 1 - w it is w (1 + x + ... + x^6 - 7 x^7), so that each of those it folds with moves its part by the way of their own.
    [[nodiscard]] std::vector<double> moved(std::span<const double> weights) const;

    /// The same for the mixes from one to another, each weight as a polynomial of the way.
    [[nodiscard]] std::vector<Weight> moved(std::span<const double> from,
                                            std::span<const double> to) const;

    [[nodiscard]] std::size_t bytes() const {
        return mature_.size() * sizeof(std::size_t) + vias_.size() * sizeof(Via);
    }

  private:
    std::vector<std::size_t> mature_;  // of each shape's kin
    std::vector<Via> vias_;  // of shape i where it meets j at [i * shapes + j]; empty: all straight
};

}  // namespace sporeprint
