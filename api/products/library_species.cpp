// Drafts and published versions of users' species.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "api/http/conditions.h"
#include "api/http/encoding.h"
#include "api/http/text.h"
#include "api/library/species_text.h"
#include "api/library/tokens.h"
#include "api/products/library_handlers.h"
#include "core/grow/mushroom.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

/// How many parts of a draft a stale write names at most.
constexpr std::size_t most_differences = 100;

Value or_null(const std::string& text) { return text.empty() ? Value() : Value(text); }

/// Returns how lists and writes describe a species.
Value described(const StoredDocument& document) {
    const std::string id = text_of({document.owner, document.name});
    Value links = Value::object();
    links.set("self", "/v1/library/" + id);
    if (document.newest > 0) {
        const std::string published = id + '@' + std::to_string(document.newest);
        links.set("published", "/v1/library/" + published);
        links.set("model", "/v1/mushrooms/" + published + ".glb");
        links.set("image", "/v1/mushrooms/" + published + ".png");
    }
    return Value::object()
        .set("id", id)
        .set("owner", document.owner)
        .set("name", document.name)
        .set("title", document.title)
        .set("form", document.kind)
        .set("newest", document.newest)
        .set("state", name(document.state))
        .set("parent", or_null(document.parent))
        .set("parent2", or_null(document.parent2))
        .set("created_s", document.created)
        .set("updated_s", document.updated)
        .set("links", std::move(links));
}

/// Returns the response to a write: the species as it is now, and the entity tag of its draft.
Response written_response(const LibraryCall& call, const LibraryName& name, const Written& written,
                          int status) {
    std::optional<StoredDocument> document = call.records.document(name.owner, name.name);
    if (!document) throw GenerationError("a species is gone that was written a moment ago");
    if (document->title.empty())  // lists have the published title; of a draft alone it is here
        if (const std::optional<Version> draft = call.records.version(name.owner, name.name, 0)) {
            document->title = draft->content.title;
            document->kind = draft->content.kind;
        }
    Value body = described(*document);
    body.set("revision", written.revision).set("draft", etag_of_text(written.current));
    Response response = private_json(body, status);
    set_header(response, "ETag", etag_of_text(written.current));
    if (status == 201)
        set_header(response, "Location",
                   call.responses().link("/v1/library/" + text_of({name.owner, name.name})));
    return response;
}

/// Reads the species in a body. Adds its problems, as 400.
std::optional<Species> read_species_body(const LibraryCall& call, ValidationErrors& errors) {
    std::optional<Value> body = read_body(call.request.body, errors);
    if (!body) return std::nullopt;
    compose_texts(*body);
    std::vector<Problem> problems;
    Species species = read_all<Species>(*body, problems);
    refuse_deceptive_texts(*body, "", problems);
    errors.add(400, problems);
    if (!problems.empty()) return std::nullopt;
    if (!is_species_name(species.id.view()))
        errors.add(400, "/id",
                   in_quotes(species.id.view()) +
                       " cannot be the name of a species in the library; "
                       "allowed are " +
                       name_grammar);
    return species;
}

/// What If-Match says about a draft.
struct Expected {
    bool is_given = false, is_stale = false;
    std::optional<Digest> draft;  ///< nothing for any
};

/// Reads If-Match. The entity tag of the gzip variant names the same draft.
Expected expected_draft(const LibraryCall& call, const LibraryName& name) {
    Expected expected;
    const std::optional<std::string> given = header_list(call.request, "If-Match");
    if (!given) return expected;
    expected.is_given = true;
    if (names_any(*given)) return expected;
    if (const std::optional<Version> draft = call.records.version(name.owner, name.name, 0)) {
        const std::string etag = etag_of_text(draft->content.hash);
        if (names_etag(*given, etag, Comparison::strong) ||
            names_etag(*given, gzip_etag(etag), Comparison::strong)) {
            expected.draft = draft->content.hash;
            return expected;
        }
    }
    expected.is_stale = true;
    return expected;
}

/// Returns the response about a species of the caller that has no draft: it was purged, or there is none.
Response without_draft(const LibraryCall& call, const LibraryName& name) {
    const std::optional<StoredDocument> document = call.records.document(name.owner, name.name);
    return refused_write(call, document ? WriteResult::purged : WriteResult::missing, name);
}

/// Returns 412 with what the draft is now, and where it differs from what was sent.
Response stale(const LibraryCall& call, const LibraryName& name, const Species* sent) {
    const std::optional<Version> draft = call.records.version(name.owner, name.name, 0);
    if (!draft) return without_draft(call, name);
    Value changed = Value::array();
    if (sent)
        for (std::string& pointer :
             differences(json_of(draft->content), write(*sent), most_differences))
            changed.push(std::move(pointer));
    const std::string etag = etag_of_text(draft->content.hash);
    return call.problem(412, "the draft has changed since it was read; its entity tag is " + etag,
                        {{"current", Value(etag)}, {"changed", std::move(changed)}});
}

/// Returns the response that refuses a write before it is tried; nothing if it may be tried.
std::optional<Response> refused_condition(const LibraryCall& call, const LibraryName& name,
                                          const Expected& expected, const Species* sent) {
    if (!expected.is_given)
        return call.problem(428,
                            "If-Match is missing; send the ETag of the draft that you have "
                            "read, or '*' for any");
    if (expected.is_stale) return stale(call, name, sent);
    return std::nullopt;
}

/// Returns the reasons why a stored species cannot be grown at one of its ages.
std::vector<Problem> obstacles(const LibraryCall& call, const Content& content,
                               const std::string& id) {
    const Species species = species_of(content);
    std::vector<double> ages;
    for (std::size_t i = 0; i < species.stages.size(); ++i) {
        ages.push_back(species.stages[i].age);
        if (i + 1 < species.stages.size())
            ages.push_back((species.stages[i].age + species.stages[i + 1].age) / 2);
    }
    const Atlas atlas(call.context.atlas, {{id, entry_of(species, id)}});
    MushroomSpec spec;
    spec.mix = {{id, 1000}};
    spec.params.lod = 3;
    // Images are decoded where they are painted.
    if (content.blobs.empty()) spec.params.textures = Textures::none;
    spec.params.texture_size = {128};
    for (const double age : ages) {
        spec.params.age = std::clamp(age, 0.0, 1.0);
        try {
            static_cast<void>(grow_mushroom(spec, atlas));
        } catch (const InvalidInput& impossible) {
            std::vector<Problem> problems = impossible.problems();
            for (Problem& problem : problems)
                problem.message += ", at age " + number_text(spec.params.age);
            return problems;
        }
    }
    return {};
}

}  // namespace

Response unseen(const LibraryCall& call, const LibraryName& name) {
    return call.problem(404, unseen_message(call.library, name));
}

Response refused_write(const LibraryCall& call, WriteResult result, const LibraryName& name) {
    const std::string id = text_of({name.owner, name.name});
    switch (result) {
        case WriteResult::taken:
            return call.problem(409, "you have a species " + in_quotes(id) +
                                         ", or had one; names are never given again");
        case WriteResult::purged:
            return withdrawn(call.responses(), call.request,
                             withdrawn_message({name.owner, name.name}));
        case WriteResult::too_many:
        case WriteResult::too_large: {
            const std::optional<Owner> owner = call.records.owner(name.owner);
            if (!owner) return unseen(call, name);
            const auto megabytes = [](std::int64_t bytes) {
                return number_text(std::floor(static_cast<double>(bytes) / 1e5) / 10.0);
            };
            return call.problem(507, std::to_string(owner->documents) + " of " +
                                         std::to_string(owner->max_documents) + " species; " +
                                         megabytes(owner->used_bytes) + " MB of " +
                                         megabytes(owner->max_bytes) + " MB; at most " +
                                         std::to_string(most_versions) + " versions of a species");
        }
        case WriteResult::stale:
            return stale(call, name, nullptr);
        case WriteResult::missing:
        case WriteResult::done:
            break;
    }
    return unseen(call, name);
}

Response list_library(LibraryCall& call) {
    ValidationErrors errors;
    const auto filter = read_options<LibraryFilter>(call, errors);
    Listing listing;
    const auto text = [](const auto& given) { return given ? given->string() : std::string(); };
    listing.owner = text(filter.owner);
    listing.kind = text(filter.form);
    listing.parent = text(filter.parent);
    listing.part = composed(text(filter.q));
    listing.limit = filter.limit + 1;
    if (filter.mine && call.caller.owner.empty())
        return unauthorized(call.responses(), call.request, "mine=true needs a token of the owner");
    if (filter.mine) listing.owner = call.caller.owner;
    // Without mine=true a token changes nothing, so that a page shows what all others see.
    if (filter.mine) listing.reader = call.caller.owner;
    if (filter.after) {
        const std::optional<LibraryName> after = read_library_name(filter.after->view());
        if (!after || after->number > 0)
            errors.add(400, "after",
                       in_quotes(filter.after->view()) +
                           " is not a name in the list; take `next` of the page before");
        else
            std::tie(listing.after_owner, listing.after_name) = std::tie(after->owner, after->name);
    }
    if (!errors.empty()) return call.problem(errors);
    std::vector<StoredDocument> found = call.records.list(listing);
    const bool is_more = found.size() > static_cast<std::size_t>(filter.limit);
    if (is_more) found.pop_back();
    Value list = Value::array();
    for (const StoredDocument& document : found) list.push(described(document));
    return private_json(
        Value::object()
            .set("species", std::move(list))
            .set("next",
                 is_more ? Value(text_of({found.back().owner, found.back().name})) : Value()));
}

Response create_species(LibraryCall& call) {
    ValidationErrors errors;
    const auto parents = read_options<Parents>(call, errors);
    const auto parent = [&](const std::optional<Text<48>>& given, const char* parameter) {
        if (!given) return std::string();
        const std::string_view id = given->view();
        if (is_of_library(id)) {
            const Library::Found found = call.library.find(id);
            if (found.status == 200) return text_of(found.name);
            errors.add(404, parameter, found.message);
        } else if (!call.context.atlas->find(id)) {
            errors.add(404, parameter, "there is no species " + in_quotes(id));
        }
        return std::string(id);
    };
    const std::string first = parent(parents.parent, "parent"),
                      second = parent(parents.parent2, "parent2");
    const std::optional<Species> species = read_species_body(call, errors);
    if (!errors.empty()) return call.problem(errors);
    const LibraryName name{call.caller.owner, species->id.string()};
    const Written written = call.records.create(name.owner, name.name, content_of(*species), first,
                                                second, call.library.now());
    return written.result == WriteResult::done ? written_response(call, name, written, 201)
                                               : refused_write(call, written.result, name);
}

Response get_library_species(LibraryCall& call) {
    ValidationErrors errors;
    const LibraryName name = read_species(call.captured[0], true, errors);
    const auto key = read_options<ShareKey>(call, errors);
    if (!errors.empty()) return call.problem(errors);
    const std::optional<StoredDocument> document = call.records.document(name.owner, name.name);
    if (document && document->state == DocumentState::purged &&
        (document->newest > 0 || call.caller.is(name.owner)))
        return withdrawn(call.responses(), call.request,
                         withdrawn_message({name.owner, name.name}));
    const bool may_see = name.number > 0 || call.caller.is(name.owner) ||
                         (key.share && is_shared(call.library, name, key.share->view()));
    const std::optional<Version> version =
        document && may_see ? call.records.version(name.owner, name.name, name.number)
                            : std::nullopt;
    if (!version) {
        if (!document || name.number == 0) return unseen(call, name);
        return call.problem(404, in_quotes(text_of({name.owner, name.name})) + " has no version " +
                                     std::to_string(name.number) + "; the newest is " +
                                     std::to_string(document->newest));
    }
    const std::string etag = etag_of_text(version->content.hash);
    Response response = private_json(json_of(version->content));
    // A published version never changes, but may be withdrawn.
    if (name.number > 0) set_header(response, "Cache-Control", cache_control(false));
    set_header(response, "ETag", etag);
    const Conditions conditions(call.request);
    const std::vector<std::string> etags = current_etags(call.request, etag, "application/json");
    if (conditions.match_fails(etags))
        return call.responses().precondition_failed(call.request, "If-Match", etags);
    if (const std::string* const known = conditions.unchanged(etags))
        return call.responses().not_modified(call.request, std::move(response), *known);
    if (conditions.none_match_any())
        return call.responses().not_modified(call.request, std::move(response), etags.front());
    return response;
}

Response put_species(LibraryCall& call) {
    ValidationErrors errors;
    const LibraryName name = read_species(call.captured[0], false, errors);
    if (errors.empty() && !call.caller.is(name.owner)) return unseen(call, name);
    const std::optional<Species> species = read_species_body(call, errors);
    if (species && species->id.view() != name.name)
        errors.add(400, "/id",
                   in_quotes(species->id.view()) + " is not the name in the address, " +
                       in_quotes(name.name) + "; a species is never renamed, fork it instead");
    if (!errors.empty()) return call.problem(errors);
    const Expected expected = expected_draft(call, name);
    if (auto refusal = refused_condition(call, name, expected, &*species))
        return *std::move(refusal);
    const Written written = call.records.replace(name.owner, name.name, expected.draft,
                                                 content_of(*species), call.library.now());
    if (written.result == WriteResult::stale) return stale(call, name, &*species);
    return written.result == WriteResult::done ? written_response(call, name, written, 200)
                                               : refused_write(call, written.result, name);
}

Response publish_species(LibraryCall& call) {
    ValidationErrors errors;
    const LibraryName name = read_species(call.captured[0], false, errors);
    if (errors.empty() && !call.caller.is(name.owner)) return unseen(call, name);
    const auto order = read_order<PublishOrder>(call, errors);
    std::vector<Problem> deceptive;
    refuse_deceptive_texts(Value(order.note.view()), "/note", deceptive);
    errors.add(400, deceptive);
    if (!errors.empty()) return call.problem(errors);
    const Expected expected = expected_draft(call, name);
    if (auto refusal = refused_condition(call, name, expected, nullptr)) return *std::move(refusal);
    const std::optional<Version> draft = call.records.version(name.owner, name.name, 0);
    if (!draft) return without_draft(call, name);
    if (expected.draft && draft->content.hash != *expected.draft) return stale(call, name, nullptr);
    // What is published can be grown at all ages; a draft need not be.
    errors.add(422, obstacles(call, draft->content, text_of({name.owner, name.name, 1})));
    if (!errors.empty()) return call.problem(errors);
    Publication publication{composed(order.note.view())};
    if (!order.bake.empty()) {
        const std::optional<StoredDocument> document = call.records.document(name.owner, name.name);
        if (!document) return without_draft(call, name);
        publication.number = document->newest + 1;
        auto baked = bake(call, draft->content, {name.owner, name.name, publication.number, false},
                          std::set<int>(order.bake.begin(), order.bake.end()));
        if (Response* const refused = std::get_if<Response>(&baked)) return std::move(*refused);
        publication.files = std::get<std::vector<Blob>>(std::move(baked));
    }
    const Written written = call.records.publish(name.owner, name.name, draft->content.hash,
                                                 publication, call.library.now());
    if (written.result == WriteResult::stale && publication.number != 0) {
        const std::optional<StoredDocument> now = call.records.document(name.owner, name.name);
        if (now && now->newest >= publication.number)
            return call.problem(409, "version " + std::to_string(publication.number) +
                                         " was published while the files of this one were made; "
                                         "publish again");
    }
    if (written.result != WriteResult::done) return refused_write(call, written.result, name);
    call.library.refresh();
    Response response = written_response(call, name, written, 201);
    set_header(
        response, "Location",
        call.responses().link("/v1/library/" + text_of({name.owner, name.name, written.number})));
    return response;
}

Response fork_species(LibraryCall& call) {
    ValidationErrors errors;
    LibraryName source = read_species(call.captured[0], true, errors);
    const auto order = read_order<ForkOrder>(call, errors);
    if (!is_species_name(order.name.view()))
        errors.add(400, "/name",
                   in_quotes(order.name.view()) + " cannot be a name; allowed are " + name_grammar);
    if (!errors.empty()) return call.problem(errors);
    if (source.number == 0 && !call.caller.is(source.owner)) {
        const Library::Found published = call.library.find(text_of(source));
        if (published.status != 200) return unseen(call, source);
        source = published.name;
    }
    const std::optional<Version> version =
        call.records.version(source.owner, source.name, source.number);
    if (!version) {
        const Library::Found published = call.library.find(text_of(source));
        return published.status == 410
                   ? withdrawn(call.responses(), call.request, published.message)
                   : unseen(call, source);
    }
    Species species = species_of(version->content);
    species.id = Text<48>(order.name.view());
    const LibraryName name{call.caller.owner, order.name.string()};
    const Written written = call.records.create(name.owner, name.name, content_of(species),
                                                text_of(source), "", call.library.now());
    return written.result == WriteResult::done ? written_response(call, name, written, 201)
                                               : refused_write(call, written.result, name);
}

Response delete_species(LibraryCall& call) {
    ValidationErrors errors;
    const LibraryName name = read_species(call.captured[0], false, errors);
    const auto removal = read_options<Removal>(call, errors);
    if (!errors.empty()) return call.problem(errors);
    if (!call.caller.is(name.owner)) return unseen(call, name);
    const Expected expected = expected_draft(call, name);
    if (auto refusal = refused_condition(call, name, expected, nullptr)) return *std::move(refusal);
    const Written written = call.records.withdraw(name.owner, name.name, expected.draft,
                                                  removal.purge, call.library.now());
    if (written.result != WriteResult::done) return refused_write(call, written.result, name);
    call.library.refresh();
    return no_content();
}

}  // namespace sporeprint::api
