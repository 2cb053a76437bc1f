// What owners have: quota, tokens, and shares of drafts.
#include <utility>

#include "api/library/species_text.h"
#include "api/library/tokens.h"
#include "api/products/library_handlers.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

Value time_or_null(const std::optional<Seconds>& time) { return time ? Value(*time) : Value(); }

Value described(const Token& token) {
    return Value::object()
        .set("id", token.id)
        .set("label", token.label)
        .set("scope", name(token.scope))
        .set("created_s", token.created)
        .set("expires_s", time_or_null(token.expires))
        .set("last_used_s", time_or_null(token.last_used))
        .set("revoked_s", time_or_null(token.revoked));
}

Value described(const Share& share) {
    return Value::object()
        .set("id", share.id)
        .set("created_s", share.created)
        .set("expires_s", share.expires)
        .set("revoked", share.is_revoked);
}

/// Returns the response that refuses a species which is no name or not that of the caller; nothing if it is.
std::optional<Response> not_own(const LibraryCall& call, const LibraryName& name,
                                const ValidationErrors& errors) {
    if (!errors.empty()) return call.problem(errors);
    if (!call.caller.is(name.owner)) return unseen(call, name);
    return std::nullopt;
}

}  // namespace

Response list_shares(LibraryCall& call) {
    ValidationErrors errors;
    const LibraryName name = read_species(call.captured[0], false, errors);
    if (auto refusal = not_own(call, name, errors)) return *std::move(refusal);
    Value list = Value::array();
    for (const Share& share : call.records.shares(name.owner, name.name))
        list.push(described(share));
    return private_json(Value::object().set("shares", std::move(list)));
}

Response create_share(LibraryCall& call) {
    ValidationErrors errors;
    const LibraryName name = read_species(call.captured[0], false, errors);
    const auto order = read_order<ShareOrder>(call, errors);
    if (auto refusal = not_own(call, name, errors)) return *std::move(refusal);
    const Secret secret = new_secret(share_prefix);
    const Seconds now = call.library.now();
    const Share share{secret.id, secret.digest, now, now + order.expires_s, false};
    const WriteResult result = call.records.add_share(name.owner, name.name, share);
    if (result == WriteResult::too_many)
        return call.problem(
            507, std::to_string(most_shares) + " keys of this species are good; revoke one first");
    if (result != WriteResult::done) return refused_write(call, result, name);
    const std::string id = text_of(name);
    Response response = private_json(
        described(share)
            .set("share", secret.text)
            .set("address", call.responses().link("/v1/library/" + id + "?share=" + secret.text)),
        201);
    set_header(response, "Location",
               call.responses().link("/v1/library/" + id + "/shares/" + secret.id));
    return response;
}

Response delete_share(LibraryCall& call) {
    ValidationErrors errors;
    const LibraryName name = read_species(call.captured[0], false, errors);
    if (auto refusal = not_own(call, name, errors)) return *std::move(refusal);
    if (!call.records.revoke_share(name.owner, name.name, call.captured[1]))
        return call.problem(404,
                            "there is no key " + in_quotes(call.captured[1]) + " of this species");
    return no_content();
}

Response get_quota(LibraryCall& call) {
    const std::optional<Owner> owner = call.records.owner(call.caller.owner);
    if (!owner) return call.problem(404, "the owner of the token is gone");
    return private_json(Value::object()
                            .set("owner", owner->name)
                            .set("scope", name(call.caller.scope))
                            .set("species", owner->documents)
                            .set("max_species", owner->max_documents)
                            .set("bytes", owner->used_bytes)
                            .set("max_bytes", owner->max_bytes)
                            .set("max_versions", most_versions)
                            .set("max_tokens", most_tokens)
                            .set("max_shares", most_shares));
}

Response list_tokens(LibraryCall& call) {
    Value list = Value::array();
    for (const Token& token : call.records.tokens(call.caller.owner)) list.push(described(token));
    return private_json(Value::object().set("tokens", std::move(list)));
}

Response create_token(LibraryCall& call) {
    ValidationErrors errors;
    const auto order = read_order<TokenOrder>(call, errors);
    std::vector<Problem> deceptive;
    refuse_deceptive_texts(Value(order.label.view()), "/label", deceptive);
    errors.add(400, deceptive);
    if (!errors.empty()) return call.problem(errors);
    const Secret secret = new_secret(token_prefix);
    Token token = stored_token(secret, call.caller.owner, composed(order.label.view()), order.scope,
                               call.library.now());
    if (order.expires_s) token.expires = token.created + *order.expires_s;
    const WriteResult result = call.records.add_token(token);
    if (result == WriteResult::too_many)
        return call.problem(507,
                            std::to_string(most_tokens) + " tokens are good; revoke one first");
    if (result != WriteResult::done) return call.problem(404, "the owner of the token is gone");
    // This is the only time that the secret is shown.
    Response response = private_json(described(token).set("token", secret.text), 201);
    set_header(response, "Location", call.responses().link("/v1/tokens/" + secret.id));
    return response;
}

Response delete_token(LibraryCall& call) {
    if (!call.records.revoke_token(call.caller.owner, call.captured[0], call.library.now()))
        return call.problem(404, "you have no token " + in_quotes(call.captured[0]));
    return no_content();
}

}  // namespace sporeprint::api
