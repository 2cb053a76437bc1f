// What requests for parts of a world have in common: the time and the rectangle that they name, and the ground and
// the blocks that they need.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "api/cache/store.h"
#include "api/http/errors.h"
#include "api/products/context.h"
#include "api/products/resource.h"
#include "core/world/ground.h"
#include "core/world/world.h"

namespace sporeprint::api {

/// The {time} of a URL.
struct WorldTimeRead {
    int year = 0;
    int day = 0;  ///< 0 if it names none
    bool is_valid = false;

    /// Returns it as a URL has it: y80 or y80d270.
    [[nodiscard]] std::string text() const;
    /// Returns noon of its day.
    [[nodiscard]] WorldTime noon() const { return time_of(year, day) + ticks_of_day / 2; }
};

/// Reads the {time} of a URL: y80 or y80d270. Anything else is an error of "time".
[[nodiscard]] WorldTimeRead read_world_time(std::string_view text, ValidationErrors& errors);

/// Reads a {time} that has to name a day.
///
/// why  before ", as in y80d270" where it does not
[[nodiscard]] WorldTimeRead read_world_day(std::string_view text, const char* why,
                                           ValidationErrors& errors);

/// Reads a rectangle: west, south, east and north in metres. Errors name "bbox".
///
/// extent   of the world, which the rectangle must lie in
/// returns  `otherwise` if the text is empty or there is an error
[[nodiscard]] WorldBox read_box(std::string_view text, const WorldBox& extent,
                                const WorldBox& otherwise, ValidationErrors& errors);

/// Returns a rectangle as read_box() reads it.
[[nodiscard]] std::string text_of(const WorldBox& box);

/// Returns the ground of a world, from its cache or computed.
[[nodiscard]] SharedGround ground_of_world(const WorldParams& params, const Caches& caches);

/// Returns the job that computes the ground of a world, if it is not cached.
[[nodiscard]] std::optional<Job> ground_job(Store& store, const WorldParams& params);

/// Returns a world, from its cache or computed.
[[nodiscard]] SharedWorld world_of_request(const WorldParams& params, const Atlas& atlas,
                                           const ExecutionContext& execution,
                                           const SharedEdits& edits = nullptr);

/// Returns the job that computes a world with its ground, if it is not cached.
[[nodiscard]] std::optional<Job> world_job(Store& store, const WorldParams& params,
                                           std::shared_ptr<const Atlas> atlas,
                                           const SharedEdits& edits = nullptr);

/// Lets a resource be made of a world, which a job of its own computes before if it is not cached.
///
/// make  called when the world is there, in Step::resolve
void make_of_world(Resource& resource, const WorldParams& params,
                   const std::shared_ptr<const Atlas>& atlas,
                   std::function<Body(const SharedWorld&, const ExecutionContext&)> make,
                   const SharedEdits& edits = nullptr);

}  // namespace sporeprint::api
