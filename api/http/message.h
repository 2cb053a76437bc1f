// A request and an answer as plain data: all that api and server share. No sockets.
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
    std::string id;  ///< request id, made or accepted by server

    /// Value of the first header of that name, any case; empty if there is none.
    [[nodiscard]] std::string_view header(std::string_view name) const;
};

struct Response {
    int status = 200;
    std::vector<Header> headers;
    Body body;
    Body gzipped;  ///< of a job's shared answer: the gzip variant, beside the body or alone
    bool has_body =
        true;  ///< false: no body and no Content-Length (304, HEAD of something not generated)
    /// Whether every GET of the same target, whatever else its head says, gets this again: same body, same headers but for
    /// the request id; but Accept-Encoding counts where the answer names it in Vary, and conditions do.
    bool cacheable = false;
};

/// What a piece of work will cost, counted before any of it is done; admission charges work(). What
/// is counted apart takes another time each.
struct Cost {
    std::uint64_t base = 0;         ///< microseconds that any request of its kind takes
    std::uint64_t outlines = 0;     ///< species of a correspondence that is to be found
    std::uint64_t pairs = 0;        ///< pairs of these species
    std::uint64_t individuals = 0;  ///< swept individuals that are decided, those of each frame too
    std::uint64_t branch_graphs = 0;    ///< branched individuals that are decided
    std::uint64_t vertices = 0;         ///< of mushrooms
    std::uint64_t placed_vertices = 0;  ///< of leaves, trees and the skins of colonies
    std::uint64_t twigs = 0;            ///< of a tree, whatever of it is shown
    std::uint64_t members = 0;          ///< individuals of a colony that room is found for
    std::uint64_t atlases = 0;          ///< of mushrooms: painted, or dissolved from others
    std::uint64_t texels = 0;           ///< of these atlases, in all of their images
    std::uint64_t leaf_atlases = 0, leaf_rows = 0, leaf_texels = 0;  ///< of leaves
    std::uint64_t leaf_row_vertices = 0;  ///< rows of these times vertices of their outline
    std::uint64_t bark_atlases = 0, bark_texels = 0;  ///< of bark
    std::uint64_t pixels = 0;                         ///< of uploaded images that are decoded
    std::uint64_t json_bytes = 0;                     ///< JSON of the client's that is read
    std::uint64_t json_values = 0;                    ///< about how many values are in it
    std::uint64_t bytes = 0;                          ///< of the file that is put together
    std::uint64_t gzip_bytes = 0;                     ///< of that, compressed by gzip

    /// All of it as one number: about microseconds of one processor of 2020. http.cpp has what each
    /// count takes.
    [[nodiscard]] std::uint64_t work() const;

    Cost& operator+=(const Cost& other);
    friend Cost operator+(Cost a, const Cost& b) { return a += b; }
};

/// What reading JSON takes, by its length, its commas and its colons.
[[nodiscard]] Cost cost_of_json(std::string_view text);

/// Full canonical text of what is to be made: equal keys, equal bytes.
using Key = std::string;

/// Work that plan() does not do itself. `run` may be called on any thread; its answer is shared by all who wait for the same key.
struct Job {
    Key key;
    Cost cost;
    std::function<Response(std::stop_token, const Observer&, const Parallel&)> run;
    bool is_warm_up = false;  ///< its answer is nobody's: plan() is asked again then, `prepared`
};

}  // namespace sporeprint::api
