#include "core/geometry/waves.h"

#include <algorithm>

#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

Waves::Waves(double amount, double cap_radius, int columns, std::uint32_t seed)
    : amplitude_(amount * 0.16 * cap_radius) {
    Random random(seed, purposes::margin_waves);
    const int coarse = 3 + static_cast<int>(random.bits() % 3);
    const double phase = random.uniform(0.0, 2.0 * pi);
    const double other = random.uniform(0.0, 2.0 * pi);
    const double fine = random.uniform(0.0, 2.0 * pi);
    // Finer waves begin nearer to the edge, as in any sheet whose edge has grown longer than its
    // circle.
    modes_ = {{coarse, 0.6, phase, 0.35},
              {coarse + 2, 0.3, other, 0.5},
              {2 * coarse + 3, 0.14, fine, 0.68}};
    std::erase_if(modes_, [&](const Mode& m) { return m.count * 3 > columns; });
}

Waves::Phases Waves::phases(double angle) const {
    Phases out{};
    for (std::size_t i = 0; i < modes_.size(); ++i)
        out[i] = sine_cosine(modes_[i].count * angle + modes_[i].phase);
    return out;
}

Waves::Value Waves::at(double share, const Phases& phases) const {
    Value value;
    for (std::size_t i = 0; i < modes_.size(); ++i) {
        const Mode& mode = modes_[i];
        const double t = std::clamp((share - mode.from) / (1.0 - mode.from), 0.0, 1.0);
        const double size = amplitude_ * mode.size, weight = t * t * (3.0 - 2.0 * t);
        value.height += size * weight * phases[i].sine;
        value.by_share += size * (6.0 * t * (1.0 - t) / (1.0 - mode.from)) * phases[i].sine;
        value.by_angle += size * weight * mode.count * phases[i].cosine;
    }
    return value;
}

}  // namespace sporeprint
