// A generated file as an HTTP resource: version, ETag, conditions, caches, HEAD and the job that
// generates it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "api/products/context.h"
#include "core/grow/product.h"

namespace sporeprint::api {

/// Depth of the URLs of most files, /v1/mushrooms/x.glb, against which links are resolved.
inline constexpr int usual_depth = 1;

/// Returns the depth, as in reference_from(), of the file that a request names.
[[nodiscard]] int link_depth(const Context& context, const Request& request);

/// A file that is generated once and cached. The meaning of URL and body is resolved; nothing is
/// generated yet.
struct Resource {
    Key key;              ///< full canonical text
    std::string type;     ///< media type
    std::string version;  ///< current version token
    std::string address;  ///< canonical URL with the current version; empty if it has none
    std::string file_name;
    std::optional<std::string> requested_version;
    bool is_linked = false;  ///< contains URLs of its images

    /// Returns the cost of generating it. Throws InvalidInput or Impossible, with paths of core, as
    /// far as that is known without generating it; uses only `morphs` of the Caches.
    std::function<Cost(const Caches&)> estimate_cost;

    /// Cost of computing its correspondence; zero if it needs none.
    Cost search;

    /// Approximate cost of generating it, without the correspondence, for use while that is not
    /// cached: the exact check is then left to the job. If there is none, a warm-up job computes
    /// the correspondence first.
    std::optional<Cost> guess;

    /// Returns the job that computes what generating it needs first, or nothing if that is cached: for what takes so
    /// long that requests wait for it without a thread, such as the ground of a world. May be empty.
    std::function<std::optional<Job>(Store&)> prerequisite{};

    /// Generates the body. Called on any thread, at most once at a time.
    std::function<Body(JobContext&)> make;
};

/// Plans the response to a request for a generated file: version, conditions, caches, HEAD, or the
/// job that generates it.
///
/// errors  found so far; if there are any, they are the response
[[nodiscard]] Plan plan_resource(Context& context, const Request& request, Resource resource,
                                 ValidationErrors& errors);

/// Throws Impossible (422) for an estimate over the budget of one request, with the parameters that
/// would lower it: /lod, /lods of several levels, /frames of a clip, /texture_size.
void refuse_over_budget(const ServiceOptions& options, const Estimate& cost, bool of_every_species,
                        bool is_clip, const FileOptions& file);

/// Adds 422 for the parameter `side` to `errors` if images have more texels than the budget of one
/// request.
void refuse_texels(const ServiceOptions& options, std::uint64_t texels, bool of_every_species,
                   ValidationErrors& errors);

/// Returns the problems of an exception of core with the names that the client uses.
[[nodiscard]] std::vector<Problem> named(const InvalidInput& input, bool posted);

}  // namespace sporeprint::api
