// Anatomy: what the species of an order can and cannot have, and the sentences that say why not.
#pragma once

#include <optional>
#include <vector>

#include "core/individual/sources.h"

namespace sporeprint {

/// Whether an optional amount asks for more than nothing.
[[nodiscard]] inline bool wished(const std::optional<double>& amount) {
    return amount && *amount > 0.0;
}

/// throws  Impossible for each override that asks for what no species of the order can have, with the reason
void check_anatomy(const MushroomParams& asked, const std::vector<Source>& sources);

/// Amounts that only some species of a mix can have: those of these species alone.
void blend_amounts(Model& model, const std::vector<Source>& sources);

/// The same amounts as overrides: what the individual really has. What no species can have stays unset.
void report_effective(MushroomParams& effective, const Model& model,
                      const std::vector<Source>& sources);

}  // namespace sporeprint
