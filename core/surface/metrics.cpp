#include "core/surface/metrics.h"

#include <algorithm>

#include "core/math/elementary.h"

namespace sporeprint {
namespace {

constexpr double step_ratio = 1.02;
constexpr double shortest = 1e-5;

}  // namespace

double length_of_step(int step) {
    // Exponentiation by squaring uses exactly rounded operations only, and is symmetric in the sign
    // of the step.
    double length = 1.0;
    double power = step_ratio;
    for (int left = step < 0 ? -step : step; left > 0; left /= 2) {
        if (left % 2 == 1) length *= power;
        power *= power;
    }
    return step < 0 ? 1.0 / length : length;
}

int quantised_length(double metres) {
    const double length = metres > shortest ? metres : shortest;
    const double steps = logarithm(length) / logarithm(step_ratio);
    return static_cast<int>(std::clamp(steps, -600.0, 100.0) + 600.5) - 600;
}

}  // namespace sporeprint
