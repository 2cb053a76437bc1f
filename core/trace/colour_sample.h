// The colour of a place on a photograph, from all pixels of it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/trace/hue.h"

namespace sporeprint::trace {

/// The pixels of one place.
class ColourSample {
  public:
    void add(const std::uint8_t* rgb) { pixels_.push_back({rgb[0], rgb[1], rgb[2]}); }
    void add(const Pixel& pixel) { pixels_.push_back(pixel); }
    void add(const ColourSample& other) {
        pixels_.insert(pixels_.end(), other.pixels_.begin(), other.pixels_.end());
    }

    /// Returns the hue that most pixels have or nearly have.
    [[nodiscard]] Hue commonest_hue() const { return trace::commonest_hue(pixels_); }

    /// Returns the colour that most pixels have, CIE L*a*b*: of those of the commonest hue the median of the lighter
    /// 60 %; none of fewer than 24 pixels.
    ///
    /// near  if a fifth of the pixels have about this hue, the others do not count
    [[nodiscard]] std::optional<glm::dvec3> colour(const Hue& near) const;

  private:
    std::vector<Pixel> pixels_;
};

}  // namespace sporeprint::trace
