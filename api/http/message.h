// A request and a response as plain data: the interface between api and server. No sockets.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/bytes.h"
#include "core/grow/execution_context.h"

namespace sporeprint::api {

using Header = std::pair<std::string, std::string>;

struct Request {
    std::string method;           ///< "GET"
    std::string target;           ///< as received: path and query, still percent-encoded
    std::vector<Header> headers;  ///< names in any case
    std::string body;
    std::string id;  ///< request id, created or accepted by server

    /// Returns the value of the first header with this name, in any case; empty if there is none.
    [[nodiscard]] std::string_view header(std::string_view name) const;
};

struct Response {
    int status = 200;
    std::vector<Header> headers;
    Body body;
    Body gzipped;  ///< of a job's shared response: the gzip variant, beside the body or alone
    bool is_stored = false;  ///< of a job's shared response: Service::finish() caches it
    /// False: no body and no Content-Length (304, HEAD of a resource that is not generated yet).
    bool has_body = true;
    /// True if every GET of the same target, whatever its other headers, has this response: the
    /// same body and headers except the request id. Accept-Encoding matters where Vary names it,
    /// and conditions always do.
    bool cacheable = false;
};

/// The cost of a piece of work, counted before it begins; admission control charges work(). Each
/// count has a processor time of its own.
struct Cost {
    std::uint64_t base = 0;             ///< microseconds that every request of its kind takes
    std::uint64_t outlines = 0;         ///< species of correspondences (MorphSet) to be computed
    std::uint64_t pairs = 0;            ///< pairs of these species
    std::uint64_t individuals = 0;      ///< swept individuals to resolve, one for every frame
    std::uint64_t branch_graphs = 0;    ///< branched individuals to resolve
    std::uint64_t vertices = 0;         ///< of mushrooms
    std::uint64_t placed_vertices = 0;  ///< of leaves, trees and colonies
    std::uint64_t twigs = 0;            ///< of a tree before level of detail
    std::uint64_t members = 0;          ///< individuals of a colony that are placed
    std::uint64_t member_pairs = 0;     ///< of a tuft, whose stems are moved apart: members squared
    std::uint64_t solids = 0;           ///< individuals that solids for collision are fitted to
    std::uint64_t atlases = 0;          ///< of mushrooms: painted, or blended from others
    std::uint64_t texels = 0;           ///< of all images of these atlases
    std::uint64_t leaf_atlases = 0, leaf_rows = 0, leaf_texels = 0;  ///< of leaves
    std::uint64_t leaf_row_vertices = 0;  ///< rows of images of leaves times vertices of a leaf
    std::uint64_t bark_atlases = 0, bark_texels = 0;  ///< of bark
    std::uint64_t webp_texels = 0;                    ///< of all images that are encoded as WebP
    std::uint64_t pixels = 0;                         ///< of images that are decoded
    std::uint64_t shadow_triangles = 0;    ///< of pictures: triangles times lights times views
    std::uint64_t samples = 0;             ///< of pictures
    std::uint64_t impostor_triangles = 0;  ///< of what impostors show, times their frames
    std::uint64_t impostor_texels = 0;     ///< of all frames
    std::uint64_t json_bytes = 0;          ///< JSON of the client that is parsed
    std::uint64_t json_values = 0;         ///< approximate number of values in it
    std::uint64_t bytes = 0;               ///< of the file that is written
    std::uint64_t gzip_bytes = 0;          ///< of these, compressed by gzip

    /// Returns the total cost: approximately the microseconds that one processor core of 2020
    /// needs, with 50 for any request. message.cpp has the time of each count.
    [[nodiscard]] std::uint64_t work() const;

    Cost& operator+=(const Cost& other);
    friend Cost operator+(Cost a, const Cost& b) { return a += b; }
};

/// Returns the estimated cost of parsing JSON: json_bytes is its length, and json_values its number
/// of commas and colons.
[[nodiscard]] Cost cost_of_json(std::string_view text);

/// Full canonical text of a resource: equal keys mean equal bytes.
using Key = std::string;

/// Completes a job's shared response for one client, by what depends on that request alone.
using Delivery = std::function<void(Response&)>;

/// Work that plan() does not do itself. `run` may be called on any thread; its response is shared
/// by all requests with the same key.
struct Job {
    Key key;
    Cost cost;
    std::function<Response(std::stop_token, const Observer&, const Parallel&)> run;
    bool is_warm_up = false;  ///< no client gets its response: afterwards plan() is called again
    Delivery delivery{};      ///< may be empty
};

/// The response to a request, or the job that computes it.
using Plan = std::variant<Response, Job>;

}  // namespace sporeprint::api
