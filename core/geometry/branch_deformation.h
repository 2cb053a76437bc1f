// How the branch graph of an individual is bent, leans and is dented.
#pragma once

#include "core/individual/individual.h"

namespace sporeprint {

/// Returns the branch graph of an individual after deformation.
///
/// throws  Impossible if the graph would be bent through itself
[[nodiscard]] BranchGraph deformed_branch_graph(const Individual& individual);

}  // namespace sporeprint
