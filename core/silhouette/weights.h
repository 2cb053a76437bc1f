// Weights of a mix as its shape takes them.
#pragma once

#include <vector>

namespace sporeprint {

/// The weights of some species as their shape takes them: flat at a corner, straight beyond a few per cent. Else a thousandth of a form
/// five times as high would lift a flat cup by half a hundredth of its height.
///
/// weights  >= 0, not all 0
/// returns  v_i / (v_1 + v_2 + ...) with v = w^2 / (w + 0.003), w the weights divided by their sum: 1 for a lone weight, 0 for 0, equal
///          ones stay equal, and the order does not matter. Of a pair 0.001 becomes 0.00025, 0.1 becomes 0.0977 and 0.5 stays; no slope
///          is above 1.01. Straight ways between mixes of two stay the same ways, only walked in another time: proofs hold.
[[nodiscard]] std::vector<double> eased_weights(std::vector<double> weights);

}  // namespace sporeprint
