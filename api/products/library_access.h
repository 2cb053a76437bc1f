// What all routes of the library share: who sends a request, and how a job uses the database.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "api/library/names.h"
#include "api/library/records.h"
#include "api/products/context.h"

namespace sporeprint::api {

/// What is said by a service without --library.
inline constexpr const char* no_library =
    "this service has no library of species; its operator starts it with --library FILE";

/// Returns 401, with the scheme of tokens.
[[nodiscard]] Response unauthorized(const ResponseBuilder& responses, const Request& request,
                                    std::string_view detail);

/// Returns 410 for a species that its owner has withdrawn.
[[nodiscard]] Response withdrawn(const ResponseBuilder& responses, const Request& request,
                                 std::string_view detail);

/// Returns the response about a species that is not published: 404, or 410 if it was purged.
[[nodiscard]] Response not_found(const ResponseBuilder& responses, const Request& request,
                                 const Library::Found& found);

/// Who sends a request.
struct Caller {
    std::string owner;  ///< empty for nobody
    Scope scope = Scope::read;
    std::string token;  ///< id

    [[nodiscard]] bool is(std::string_view name) const { return !owner.empty() && owner == name; }
};

/// A request to the library, in a job: it may block.
struct LibraryCall {
    Library& library;
    Records& records;
    const Request& request;
    const Target& target;
    const std::vector<std::string>& captured;
    const Context& context;
    Caller caller;

    [[nodiscard]] const ResponseBuilder& responses() const { return context.responses; }
    [[nodiscard]] Response problem(int status, std::string_view detail,
                                   const Value::Object& more = {}) const {
        return context.responses.problem(request, status, detail, {}, more);
    }
    [[nodiscard]] Response problem(const ValidationErrors& errors) const {
        return context.responses.problem(request, errors);
    }
};

/// Finds out who sends a request, with the token of its Authorization header. An unknown id takes as long as a wrong
/// secret.
///
/// access   of the route; without a token, Access::required is refused, others are nobody
/// returns  the caller, or the response that refuses the token
[[nodiscard]] std::variant<Caller, Response> authenticated(Library& library,
                                                           const ResponseBuilder& responses,
                                                           const Request& request, Access access,
                                                           Scope scope);

/// Returns the owner of the token of a request, if authenticated() has let one with it in during the last minute; empty
/// otherwise. Does not block, and lets nobody in.
[[nodiscard]] std::string known_owner(Library& library, const Request& request);

/// Returns what stands after "Bearer" in the Authorization header; nothing if the header is another, or there are
/// several.
[[nodiscard]] std::optional<std::string_view> bearer_of(const Request& request);

/// Returns true if a key is that of a share of this species that is still good.
[[nodiscard]] bool is_shared(Library& library, const LibraryName& name, std::string_view key);

/// Returns what is said of a species that the caller may not see, whether it exists or not.
[[nodiscard]] std::string unseen_message(Library& library, const LibraryName& name);

using LibraryHandler = Response (*)(LibraryCall&);

/// Plans a request to the library: the job checks the token and calls the handler. Once it has begun it is not
/// cancelled, so that a client which has gone away knows no less than the database.
///
/// scope  that the token needs, if Route::access requires one
/// more   of what the handler does besides reading and writing a species
[[nodiscard]] Plan plan_library(RouteCall& call, Scope scope, LibraryHandler handler,
                                const Cost& more = {});

/// A handler of Route::plan.
template <Scope Needed, LibraryHandler Handler>
Plan library_route(RouteCall& call) {
    return plan_library(call, Needed, Handler);
}

/// Returns the strong entity tag of a text: "<sha256>" with its quotes.
[[nodiscard]] std::string etag_of_text(const Digest& hash);

/// Reads the {species} of a path. Adds 404 if it is no name.
///
/// may_have_number  "@3" is allowed
[[nodiscard]] LibraryName read_species(const std::string& captured, bool may_have_number,
                                       ValidationErrors& errors);

}  // namespace sporeprint::api
