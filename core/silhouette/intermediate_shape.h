// The bud: what shapes go by whose straight way folds even by their mature stages.
#pragma once

#include <vector>

#include "core/silhouette/outline.h"

namespace sporeprint {

/// A smooth bud, as high as the shapes are on average, that their sub-curves run along from pole to pole, the lower face as a narrow band.
/// Nothing of it hides anything else, so nearly every shape opens out of it straight.
///
/// shapes  at least one, all with equally many nodes
[[nodiscard]] OutlineNodes bud_of(const std::vector<OutlineNodes>& shapes);

}  // namespace sporeprint
