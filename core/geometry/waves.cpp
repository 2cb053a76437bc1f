#include "core/geometry/waves.h"

#include <algorithm>

#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

/// Sizes of the coarse, middle and fine wave of a species; each has one of three numbers of crests.
constexpr std::array<double, 3> sizes = {0.6, 0.3, 0.14};
constexpr std::uint32_t choices = 3;
static_assert(sizes.size() * choices == Waves::forms.size());

/// Returns the sizes of all forms of waves in one species, of their cosines and sines.
std::array<glm::dvec2, Waves::forms.size()> waves_of(std::uint32_t seed, std::uint32_t stream) {
    Random random(seed, purposes::margin_waves, stream);
    const std::size_t choice = random.bits() % choices;
    std::array<glm::dvec2, Waves::forms.size()> waves{};
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const auto [s, c] = sine_cosine(random.uniform(0.0, 2.0 * pi));
        waves[i * choices + choice] = {sizes[i] * s, sizes[i] * c};
    }
    return waves;
}

}  // namespace

Waves::Waves(double amount, double cap_radius, int columns, std::uint32_t seed,
             std::span<const Species> mix)
    : amplitude_(amount * 0.16 * cap_radius) {
    std::array<glm::dvec2, forms.size()> sum{};
    for (const Species& species : mix) {
        const auto own = waves_of(seed, species.stream);
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += species.weight * own[i];
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
        if (sum[i] != glm::dvec2(0.0) && forms[i].count * 3 <= columns)
            modes_.push_back({forms[i], sum[i]});
}

Waves::Phases Waves::phases(double angle) const {
    Phases out{};
    for (std::size_t i = 0; i < modes_.size(); ++i)
        out[i] = sine_cosine(modes_[i].form.count * angle);
    return out;
}

Waves::Value Waves::at(double share, const Phases& phases) const {
    Value value;
    for (std::size_t i = 0; i < modes_.size(); ++i) {
        const auto& [form, size] = modes_[i];
        const double t = std::clamp((share - form.from) / (1.0 - form.from), 0.0, 1.0);
        const double weight = t * t * (3.0 - 2.0 * t);
        const double wave = size.x * phases[i].cosine + size.y * phases[i].sine;
        const double slope = size.y * phases[i].cosine - size.x * phases[i].sine;
        value.height += amplitude_ * weight * wave;
        value.by_share += amplitude_ * (6.0 * t * (1.0 - t) / (1.0 - form.from)) * wave;
        value.by_angle += amplitude_ * weight * form.count * slope;
    }
    return value;
}

}  // namespace sporeprint
