// The relief of the bark of a piece of wood, which its mesh and its images have in common.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/model/substrate.h"

namespace sporeprint {

/// Noise at many places of the bark of a kind of wood. Places are in widths of its image, half the
/// girth of the least circle; the noise wraps across.
class BarkNoise {
  public:
    /// across, along  places, N of each; 0 <= across <= 1
    BarkNoise(Substrate kind, std::span<const float> across, std::span<const float> along);

    /// Returns noise of mean 0 and deviation about 0.35.
    ///
    /// round   number of features across
    /// longer  how many times as long as wide they are
    /// warp    how far they are displaced, in features, so that nothing is in line
    [[nodiscard]] std::vector<float> at(int round, double longer, std::uint32_t purpose,
                                        double warp = 0.6) const;

  private:
    std::uint32_t seed_;
    std::span<const float> across_, along_;
    std::vector<float> warp_across_, warp_along_;
};

/// Returns how high bark is that meshes can show, from 0 in the deepest furrow to 1.
[[nodiscard]] std::vector<float> bark_rise(Substrate kind, const BarkNoise& noise);

/// Returns the height of a rise of 1, in widths of the image; at most deepest_bark.
///
/// throws  InvalidInput for Substrate::none (path "/substrate")
[[nodiscard]] double bark_depth(Substrate kind);

inline constexpr double deepest_bark = 0.018;

}  // namespace sporeprint
