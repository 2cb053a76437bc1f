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

struct Answer {
    int status = 200;
    std::vector<Header> headers;
    Body body;
    Body gzipped;  ///< of a job's shared answer: the gzip variant, beside the body or alone
    bool has_body =
        true;  ///< false: no body and no Content-Length (304, HEAD of something not generated)
    /// Whether every GET of the same target, whatever else its head says, gets this again: same body, same headers but for
    /// the request id; but Accept-Encoding counts where the answer names it in Vary, and conditions do.
    bool repeatable = false;
};

/// What a piece of work will cost; admission charges it.
struct Cost {
    std::uint64_t vertices = 0;
    std::uint64_t texels = 0;
    std::uint64_t bytes = 0;

    /// All of it as one number: about microseconds of one processor of 2020. A vertex took a quarter of one, a texel 1/32,
    /// a byte 1/1024; nothing is free.
    [[nodiscard]] std::uint64_t work() const {
        return 100 + vertices / 4 + texels / 32 + bytes / 1024;
    }
};

/// Full canonical text of what is to be made: equal keys, equal bytes.
using Key = std::string;

/// Work that plan() does not do itself. `run` may be called on any thread; its answer is shared by all who wait for the same key.
struct Job {
    Key key;
    Cost cost;
    std::function<Answer(std::stop_token, const Observer&, const Parallel&)> run;
    bool prepares = false;  ///< its answer is nobody's: plan() is asked again then, `prepared`
};

}  // namespace sporeprint::api
