// Easing of the weights of a mix for its shape.
#pragma once

#include <vector>

namespace sporeprint {

/// Returns the weights that a shape uses for a mix: with zero slope at weight 0, nearly the
/// identity beyond a few per cent. Otherwise a thousandth of a form five times as high would lift a
/// flat cup by half a hundredth of its height.
///
/// weights  >= 0, not all 0
/// returns  v_i / (v_1 + v_2 + ...) with v = w^2 / (w + 0.003), w the weights divided by their sum:
///          1 for a single weight, 0 for 0, equal ones stay equal, and the order does not matter.
///          Of a pair 0.001 becomes 0.00025, 0.1 becomes 0.0977 and 0.5 stays; no slope is above
///          1.01. A linear path between two mixes keeps its image and only changes its
///          parametrisation, so proofs hold.
[[nodiscard]] std::vector<double> eased_weights(std::vector<double> weights);

}  // namespace sporeprint
