// Anatomy rules: which ornaments and amounts the species of a request can have, and the messages
// that explain refusals.
#pragma once

#include <optional>
#include <vector>

#include "core/individual/sources.h"

namespace sporeprint {

/// Returns true if an optional amount is set to more than zero.
[[nodiscard]] inline bool is_requested(const std::optional<double>& amount) {
    return amount && *amount > 0.0;
}

/// Checks all overrides of a request against the anatomy of its species.
///
/// throws  Impossible for each override that requests what no species of the mix can have, with the
///         reason
void check_anatomy(const MushroomParams& requested, const std::vector<Source>& sources);

/// Blends the amounts that only some species of a mix can have from these species alone.
void blend_amounts(Model& model, const std::vector<Source>& sources);

/// Writes the same amounts as overrides with the individual's actual values. Amounts that no
/// species can have stay unset.
void report_effective(MushroomParams& effective, const Model& model,
                      const std::vector<Source>& sources);

}  // namespace sporeprint
