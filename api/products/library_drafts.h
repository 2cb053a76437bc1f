// Products of drafts: "~owner.name@draft" where the id of a species may stand.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "api/products/context.h"

namespace sporeprint::api {

/// Plans a request with a context of its own, whose atlas has guests.
using PlanAgain = std::function<Plan(Context&)>;

/// Returns true if one of these names of species is that of a draft.
[[nodiscard]] bool has_draft(const std::vector<std::string>& ids);

/// Plans a request that names drafts: one job that checks who sends it, reads the drafts and grows them. Its response
/// is for this caller alone: no cache has it, and it states no address.
///
/// ids    of the species that the atlas does not have, drafts among them
/// again  plans the request itself; the context and what the function refers to live as long as the job
[[nodiscard]] Plan plan_with_drafts(const Context& context, const Request& request,
                                    const std::vector<std::string>& ids, const PlanAgain& again);

}  // namespace sporeprint::api
