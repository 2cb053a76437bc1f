#include "api/products/library_access.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include "api/http/text.h"
#include "api/library/tokens.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

/// Returns the secret of the token that the Authorization header of a request has, or nothing if the header is missing
/// or of another form.
std::optional<Secret> secret_of(const Request& request) {
    const std::optional<std::string_view> bearer = bearer_of(request);
    return bearer ? read_secret(token_prefix, *bearer) : std::nullopt;
}

}  // namespace

std::variant<Caller, Response> authenticated(Library& library, const ResponseBuilder& responses,
                                             const Request& request, Access access, Scope scope) {
    if (request.header("Authorization").empty()) {
        if (access != Access::required) return Caller{};
        return unauthorized(responses, request,
                            "a token is needed: send 'Authorization: Bearer spk_...'");
    }
    const std::optional<Secret> secret = secret_of(request);
    if (!secret)
        return unauthorized(responses, request,
                            "the Authorization header is not a single 'Bearer' and a token, spk_ "
                            "with 8 and 43 characters");
    const std::optional<Token> token = library.records().token(secret->id);
    const Seconds now = library.now();
    if (!has_secret(token, *secret))
        return unauthorized(responses, request, "there is no such token");
    if (token->revoked) return unauthorized(responses, request, "the token was revoked");
    if (token->expires && *token->expires <= now)
        return unauthorized(responses, request, "the token has expired");
    if (token->is_owner_disabled)
        return unauthorized(responses, request, "the owner of the token is disabled");
    if (access == Access::required && token->scope < scope) {
        Response response =
            responses.problem(request, 403,
                              std::string("the token has the scope ") + name(token->scope) +
                                  "; needed is " + name(scope));
        set_header(response, "WWW-Authenticate",
                   "Bearer realm=\"sporeprint\", error=\"insufficient_scope\", scope=\"" +
                       std::string(name(scope)) + '"');
        return response;
    }
    library.note_owner(secret->digest, token->owner);
    try {
        library.records().note_use(token->id, now);
    } catch (const Unavailable&) {
        // Who only reads need not wait for those who write.
    }
    return Caller{token->owner, token->scope, token->id};
}

std::string known_owner(Library& library, const Request& request) {
    const std::optional<Secret> secret = secret_of(request);
    return secret ? library.noted_owner(secret->digest) : std::string();
}

std::optional<std::string_view> bearer_of(const Request& request) {
    const std::string_view given = request.header("Authorization");
    // A proxy and this service must not each believe another one of several.
    const auto count =
        std::count_if(request.headers.begin(), request.headers.end(),
                      [](const Header& one) { return same_word(one.first, "Authorization"); });
    if (count > 1) return std::nullopt;
    constexpr std::string_view scheme = "Bearer ";
    if (given.size() <= scheme.size() || !same_word(given.substr(0, scheme.size()), scheme))
        return std::nullopt;
    return trimmed(given.substr(scheme.size()));
}

bool is_shared(Library& library, const LibraryName& name, std::string_view key) {
    const std::optional<Secret> secret = read_secret(share_prefix, key);
    if (!secret) return false;
    const std::optional<Share> share = library.records().share(name.owner, name.name, secret->id);
    return has_secret(share, *secret) && !share->is_revoked && share->expires > library.now();
}

std::string unseen_message(Library& library, const LibraryName& name) {
    const std::string id = text_of({name.owner, name.name});
    const Library::Found published = library.find(id);
    return published.status == 200
               ? "of " + in_quotes(id) +
                     " only what is published can be seen: " + in_quotes(text_of(published.name))
               : "there is no species " + in_quotes(id) + ", or it is a draft that you may not see";
}

Response unauthorized(const ResponseBuilder& responses, const Request& request,
                      std::string_view detail) {
    Response response = responses.problem(request, 401, detail);
    set_header(response, "WWW-Authenticate", "Bearer realm=\"sporeprint\"");
    return response;
}

Response withdrawn(const ResponseBuilder& responses, const Request& request,
                   std::string_view detail) {
    return responses.problem(
        request, 410, detail, {},
        {{"type", Value(responses.link("/problems/withdrawn"))}, {"title", Value("Withdrawn")}});
}

Response not_found(const ResponseBuilder& responses, const Request& request,
                   const Library::Found& found) {
    return found.status == 410 ? withdrawn(responses, request, found.message)
                               : responses.problem(request, found.status, found.message);
}

Plan plan_library(RouteCall& call, Scope scope, LibraryHandler handler, const Cost& more) {
    const Context& context = call.context;
    if (!context.library) return context.responses.problem(call.request, 404, no_library);
    if (!call.errors.empty()) return context.responses.problem(call.request, call.errors);
    const std::string key = context.library->next_key();
    // What is written is a few milliseconds of the disk, and of a processor for a species of 100 kB.
    const Cost cost = Cost{.base = 3000 + call.request.body.size() / 20} + more;
    auto run = [&context, library = context.library, request = call.request, target = call.target,
                captured = call.captured, access = call.route.access, scope,
                handler](const std::stop_token&, const Observer& observer, const Parallel&) {
        observer(Step::resolve);
        auto who = authenticated(*library, context.responses, request, access, scope);
        if (Response* const refusal = std::get_if<Response>(&who)) return std::move(*refusal);
        LibraryCall library_call{*library,
                                 library->records(),
                                 request,
                                 target,
                                 captured,
                                 context,
                                 std::get<Caller>(std::move(who))};
        return handler(library_call);
    };
    return Job{key, cost, std::move(run)};
}

std::string etag_of_text(const Digest& hash) { return '"' + hex_of(hash) + '"'; }

LibraryName read_species(const std::string& captured, bool may_have_number,
                         ValidationErrors& errors) {
    const std::optional<LibraryName> name = read_library_name(captured);
    if (name && !name->is_draft && (may_have_number || name->number == 0)) return *name;
    errors.add(404, "species",
               in_quotes(captured) + " is not the name of a species in the library; allowed is " +
                   (may_have_number ? "~owner.name or ~owner.name@3" : "~owner.name"));
    return {};
}

}  // namespace sporeprint::api
