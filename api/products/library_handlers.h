// The handlers of the routes of the library, by file; library.cpp has the table of routes.
#pragma once

#include <optional>
#include <set>
#include <variant>
#include <vector>

#include "api/products/library_access.h"
#include "api/products/product.h"
#include "core/params/describe.h"
#include "core/params/query.h"
#include "core/params/reader.h"

namespace sporeprint::api {

/// Query parameters of GET /v1/library.
struct LibraryFilter {
    std::optional<Text<16>> owner;
    std::optional<Text<32>> form;
    std::optional<Text<48>> parent;
    std::optional<Text<64>> q;
    bool mine = false;
    std::optional<Text<48>> after;
    int limit = 50;

    static constexpr void fields(auto visit) {
        using F = LibraryFilter;
        visit(&F::owner, Info{.name = "owner", .most = 16, .doc = "Only species of this owner."});
        visit(&F::form, Info{.name = "form",
                             .most = 32,
                             .doc = "Only this growth form, as in /v1/species: agaric, club, …"});
        visit(
            &F::parent,
            Info{
                .name = "parent",
                .most = 48,
                .doc =
                    "Only what was made from this species: ~owner.name, ~owner.name@3 or the id of "
                    "a built-in one."});
        visit(&F::q,
              Info{.name = "q",
                   .most = 64,
                   .doc = "Only species whose name or title contains this text, in any case."});
        visit(&F::mine,
              Info{.name = "mine",
                   .doc = "Only species of the token's owner: drafts and unlisted ones too."});
        visit(&F::after,
              Info{.name = "after",
                   .most = 48,
                   .doc = "The list goes on after this name; `next` of the page before."});
        visit(&F::limit, Info{.name = "limit", .min = 1, .max = 100, .doc = "Species on a page."});
    }
};

/// Query parameters of POST /v1/library: of what the species was made.
struct Parents {
    std::optional<Text<48>> parent, parent2;

    static constexpr void fields(auto visit) {
        visit(&Parents::parent,
              Info{.name = "parent",
                   .most = 48,
                   .doc = "Of which species it was made: a built-in id, or ~owner.name@3."});
        visit(&Parents::parent2, Info{.name = "parent2", .most = 48, .doc = "The other one."});
    }
};

/// Query parameters of GET /v1/library/{species}.
struct ShareKey {
    std::optional<Text<64>> share;

    static constexpr void fields(auto visit) {
        visit(&ShareKey::share,
              Info{.name = "share",
                   .most = 64,
                   .doc = "A key of the owner, with which a draft can be read without a token."});
    }
};

/// Query parameters of DELETE /v1/library/{species}.
struct Removal {
    bool purge = false;

    static constexpr void fields(auto visit) {
        visit(&Removal::purge,
              Info{.name = "purge",
                   .doc = "Deletes all bytes for ever: published addresses are 410 from then on. "
                          "Otherwise the species is taken out of lists, and its addresses go on."});
    }
};

/// Query parameters of POST /v1/library/import.
struct ImportOptions {
    bool dry_run = false;

    static constexpr void fields(auto visit) {
        visit(&ImportOptions::dry_run,
              Info{.name = "dry_run", .doc = "Checks everything and writes nothing."});
    }
};

struct PublishOrder {
    Text<200> note;
    std::vector<int> bake{};

    static constexpr void fields(auto visit) {
        visit(&PublishOrder::note,
              Info{.name = "note", .most = 200, .doc = "What is new in this version."});
        visit(&PublishOrder::bake,
              Info{.name = "bake",
                   .min = 0,
                   .max = last_lod,
                   .most = last_lod + 1,
                   .doc = "Levels of detail whose finished GLB files are stored too, at "
                          "/v1/library/~owner.name@3/baked/0.glb: the bytes of this day for ever, "
                          "whatever later generators make of the species. They count as bytes of "
                          "the owner."});
    }
};

struct ForkOrder {
    Text<24> name;

    static constexpr void fields(auto visit) {
        visit(&ForkOrder::name,
              Info{.name = "name",
                   .most = 24,
                   .doc = "Name of the copy: a-z, 0-9 and _, the first a letter."});
    }
};

struct ShareOrder {
    int expires_s = 30 * 86400;

    static constexpr void fields(auto visit) {
        visit(&ShareOrder::expires_s, Info{.name = "expires_s",
                                           .unit = "s",
                                           .min = 60,
                                           .max = 365 * 86400,
                                           .doc = "How long the key is good."});
    }
};

struct TokenOrder {
    Text<64> label;
    Scope scope = Scope::write;
    std::optional<int> expires_s;

    static constexpr void fields(auto visit) {
        visit(&TokenOrder::label,
              Info{.name = "label", .most = 64, .doc = "What the token is for, for lists."});
        visit(&TokenOrder::scope,
              Info{.name = "scope",
                   .doc = "read: drafts are seen; write: and changed; admin: and tokens made and "
                          "revoked."});
        visit(&TokenOrder::expires_s,
              Info{.name = "expires_s",
                   .unit = "s",
                   .min = 60,
                   .max = 10 * 365 * 86400,
                   .doc = "How long the token is good; for ever by itself."});
    }
};

// library_species.cpp
Response list_library(LibraryCall& call);
Response create_species(LibraryCall& call);
Response get_library_species(LibraryCall& call);
Response put_species(LibraryCall& call);
Response publish_species(LibraryCall& call);
Response fork_species(LibraryCall& call);
Response delete_species(LibraryCall& call);

// library_transfer.cpp
Response export_species(LibraryCall& call);
Response import_species(LibraryCall& call);

// library_baked.cpp
Plan plan_publication(RouteCall& call);
Response list_baked(LibraryCall& call);
Response get_baked(LibraryCall& call);

/// Grows the default mushroom of a version that is about to be published, as its address will show it.
///
/// lods     levels of detail
/// returns  a file of each, or the response that says why one cannot be grown
[[nodiscard]] std::variant<std::vector<Blob>, Response> bake(const LibraryCall& call,
                                                             const Content& content,
                                                             const LibraryName& version,
                                                             const std::set<int>& lods);

/// Returns the path of a baked file.
[[nodiscard]] std::string baked_path(const LibraryName& version, std::string_view file);

// library_owners.cpp
Response list_shares(LibraryCall& call);
Response create_share(LibraryCall& call);
Response delete_share(LibraryCall& call);
Response get_quota(LibraryCall& call);
Response list_tokens(LibraryCall& call);
Response create_token(LibraryCall& call);
Response delete_token(LibraryCall& call);

/// Returns the response to a write that changed nothing.
[[nodiscard]] Response refused_write(const LibraryCall& call, WriteResult result,
                                     const LibraryName& name);

/// Returns 404 for a species that the caller may not see, whether it exists or not.
[[nodiscard]] Response unseen(const LibraryCall& call, const LibraryName& name);

/// Reads the JSON body of a request as a described struct. Adds its problems, as 400.
template <class Order>
[[nodiscard]] Order read_order(const LibraryCall& call, ValidationErrors& errors) {
    std::vector<Problem> problems;
    Order order;
    if (const std::optional<Value> body = read_body(call.request.body, errors))
        order = read_all<Order>(*body, problems);
    errors.add(400, problems);
    return order;
}

/// Reads the query of a request as a described struct. Adds its problems, as 400.
template <class Options>
[[nodiscard]] Options read_options(const LibraryCall& call, ValidationErrors& errors) {
    std::vector<Problem> problems;
    Options options;
    read_query(call.target.query, options, problems);
    errors.add(400, problems);
    return options;
}

}  // namespace sporeprint::api
