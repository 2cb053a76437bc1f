// The sRGB encoding of light as a table.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/math/elementary.h"

namespace sporeprint {

/// sRGB bytes of linear light in steps of 1/4095.
class SrgbTable {
  public:
    SrgbTable() {
        for (std::size_t i = 0; i < bytes_.size(); ++i)
            bytes_[i] = static_cast<std::uint8_t>(
                linear_to_srgb(static_cast<double>(i) / 4095.0) * 255.0 + 0.5);
    }

    /// Returns the byte of a value; those beyond 0..1 are that of the nearer end.
    [[nodiscard]] std::uint8_t of(float light) const {
        return bytes_[static_cast<std::size_t>(std::clamp(light, 0.0F, 1.0F) * 4095.0F + 0.5F)];
    }

  private:
    std::array<std::uint8_t, 4096> bytes_{};
};

/// Returns a table that is made once.
inline const SrgbTable& srgb_table() {
    static const SrgbTable table;
    return table;
}

}  // namespace sporeprint
