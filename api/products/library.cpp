#include "api/products/library.h"

#include <utility>

#include "api/http/compression.h"
#include "api/http/schemas.h"
#include "api/products/library_handlers.h"
#include "core/params/schema.h"

namespace sporeprint::api {

static_assert(well_described<LibraryFilter>());
static_assert(well_described<Parents>());
static_assert(well_described<ShareKey>());
static_assert(well_described<Removal>());
static_assert(well_described<ImportOptions>());
static_assert(well_described<PublishOrder>());
static_assert(well_described<ForkOrder>());
static_assert(well_described<ShareOrder>());
static_assert(well_described<TokenOrder>());

namespace {

constexpr const char* json = "application/json";

/// Greatest bodies: a species with three images of 1024 x 1024, and an export.
constexpr std::size_t most_species_bytes = std::size_t{4} << 20U,
                      most_export_bytes = std::size_t{16} << 20U;

template <class T>
Value query_of(const Atlas&) {
    return without_default_source(schema<T>());
}

constexpr Route library[] = {
    {.kind = RouteKind::record,
     .method = "GET",
     .pattern = "/v1/library",
     .id = "list_library",
     .summary =
         "The published species of users, by owner and name; with mine=true all those of the "
         "token's owner.",
     .media_type = json,
     .response_schema = "library_list",
     .query_schema = query_of<LibraryFilter>,
     .plan = library_route<Scope::read, list_library>,
     .access = Access::chosen},
    {.kind = RouteKind::record,
     .method = "POST",
     .pattern = "/v1/library",
     .id = "create_library_species",
     .summary = "Stores a species as a draft, under its `id`.",
     .media_type = json,
     .body_type = json,
     .success = 201,
     .most_body = most_species_bytes,
     .response_schema = "library_species",
     .request_body = "library_species",
     .query_schema = query_of<Parents>,
     .plan = library_route<Scope::write, create_species>,
     .access = Access::required,
     .has_etag = true},
    {.kind = RouteKind::record,
     .method = "GET",
     .pattern = "/v1/library/quota",
     .id = "get_quota",
     .summary = "What the token's owner has, and how much is allowed.",
     .media_type = json,
     .response_schema = "library_quota",
     .plan = library_route<Scope::read, get_quota>,
     .access = Access::required},
    {.kind = RouteKind::record,
     .method = "POST",
     .pattern = "/v1/library/import",
     .id = "import_library_species",
     .summary =
         "Stores an export with all its versions, which have the bytes and entity tags that they "
         "had.",
     .media_type = json,
     .body_type = json,
     .success = 201,
     .most_body = most_export_bytes,
     .response_schema = "library_import",
     .request_body = "library_export",
     .query_schema = query_of<ImportOptions>,
     .plan = library_route<Scope::write, import_species>,
     .access = Access::required},
    {.kind = RouteKind::record,
     .method = "GET",
     .pattern = "/v1/library/{species}",
     .id = "get_library_species",
     .summary =
         "A published version of a species, ~owner.name@3, or its draft, ~owner.name, which its "
         "owner sees and whoever has a key.",
     .media_type = json,
     .response_schema = "species",
     .query_schema = query_of<ShareKey>,
     .plan = library_route<Scope::read, get_library_species>,
     .access = Access::chosen,
     .has_etag = true},
    {.kind = RouteKind::record,
     .method = "PUT",
     .pattern = "/v1/library/{species}",
     .id = "put_library_species",
     .summary = "Replaces the draft of a species, if it is still the one that If-Match names.",
     .media_type = json,
     .body_type = json,
     .most_body = most_species_bytes,
     .response_schema = "library_species",
     .request_body = "library_species",
     .plan = library_route<Scope::write, put_species>,
     .access = Access::required,
     .has_condition = true,
     .has_etag = true},
    {.kind = RouteKind::record,
     .method = "DELETE",
     .pattern = "/v1/library/{species}",
     .id = "delete_library_species",
     .summary = "Takes a species out of lists; its published addresses go on, unless it is purged.",
     .media_type = "",
     .success = 204,
     .query_schema = query_of<Removal>,
     .plan = library_route<Scope::write, delete_species>,
     .access = Access::required,
     .has_condition = true},
    {.kind = RouteKind::record,
     .method = "POST",
     .pattern = "/v1/library/{species}/publish",
     .id = "publish_library_species",
     .summary =
         "Publishes the draft as the next version, which never changes: ~owner.name@3 can be named "
         "wherever a species can.",
     .media_type = json,
     .body_type = json,
     .success = 201,
     .response_schema = "library_species",
     .request_body = "library_publication",
     .plan = plan_publication,
     .access = Access::required,
     .has_condition = true,
     .has_etag = true},
    {.kind = RouteKind::record,
     .method = "GET",
     .pattern = "/v1/library/{species}/baked.json",
     .id = "list_baked",
     .summary = "The finished files that are stored with a published version.",
     .media_type = json,
     .response_schema = "library_baked",
     .plan = library_route<Scope::read, list_baked>,
     .access = Access::chosen},
    {.kind = RouteKind::record,
     .method = "GET",
     .pattern = "/v1/library/{species}/baked/{lod}.glb",
     .id = "get_baked",
     .summary =
         "A finished file of a published version, the same bytes for ever, until its owner purges "
         "the species.",
     .media_type = glb_type,
     .plan = library_route<Scope::read, get_baked>,
     .access = Access::chosen,
     .has_etag = true},
    {.kind = RouteKind::record,
     .method = "POST",
     .pattern = "/v1/library/{species}/fork",
     .id = "fork_library_species",
     .summary = "Copies a published species, or an own draft, into a draft of the token's owner.",
     .media_type = json,
     .body_type = json,
     .success = 201,
     .response_schema = "library_species",
     .request_body = "library_fork",
     .plan = library_route<Scope::write, fork_species>,
     .access = Access::required,
     .has_etag = true},
    {.kind = RouteKind::record,
     .method = "GET",
     .pattern = "/v1/library/{species}/shares",
     .id = "list_shares",
     .summary = "The keys with which the draft of a species can be read.",
     .media_type = json,
     .response_schema = "library_shares",
     .plan = library_route<Scope::read, list_shares>,
     .access = Access::required},
    {.kind = RouteKind::record,
     .method = "POST",
     .pattern = "/v1/library/{species}/shares",
     .id = "create_share",
     .summary =
         "Makes a key with which the draft of a species can be read, for a year at most. It is "
         "shown once.",
     .media_type = json,
     .body_type = json,
     .success = 201,
     .response_schema = "library_share",
     .request_body = "library_share",
     .plan = library_route<Scope::write, create_share>,
     .access = Access::required},
    {.kind = RouteKind::record,
     .method = "DELETE",
     .pattern = "/v1/library/{species}/shares/{share}",
     .id = "delete_share",
     .summary = "Revokes a key.",
     .media_type = "",
     .success = 204,
     .plan = library_route<Scope::write, delete_share>,
     .access = Access::required},
    {.kind = RouteKind::record,
     .method = "GET",
     .pattern = "/v1/library/{species}/export.json",
     .id = "export_library_species",
     .summary = "A species with its draft, all its versions and their images, for POST "
                "/v1/library/import.",
     .media_type = json,
     .response_schema = "library_export",
     .plan = library_route<Scope::read, export_species>,
     .access = Access::required},
};

constexpr Route tokens[] = {
    {.kind = RouteKind::record,
     .method = "GET",
     .pattern = "/v1/tokens",
     .id = "list_tokens",
     .summary = "The tokens of the token's owner, without their secrets.",
     .media_type = json,
     .response_schema = "token_list",
     .plan = library_route<Scope::admin, list_tokens>,
     .access = Access::required},
    {.kind = RouteKind::record,
     .method = "POST",
     .pattern = "/v1/tokens",
     .id = "create_token",
     .summary = "Makes a token of the same owner. Its secret is shown once.",
     .media_type = json,
     .body_type = json,
     .success = 201,
     .response_schema = "token",
     .request_body = "token",
     .plan = library_route<Scope::admin, create_token>,
     .access = Access::required},
    {.kind = RouteKind::record,
     .method = "DELETE",
     .pattern = "/v1/tokens/{token}",
     .id = "delete_token",
     .summary = "Revokes a token.",
     .media_type = "",
     .success = 204,
     .plan = library_route<Scope::admin, delete_token>,
     .access = Access::required},
};

Value nullable(const char* type) { return object({{"type", Value(Value::Array{type, "null"})}}); }

Value time_of(const char* description) {
    return object(
        {{"type", "integer"}, {"description", std::string(description) + ", seconds since 1970."}});
}

Value time_or_null(const char* description) {
    Value schema = nullable("integer");
    schema.set("description", std::string(description) + ", seconds since 1970.");
    return schema;
}

/// Members of a species in lists and after writes.
Value::Object species_members() {
    const Value text = typed("string"), whole = typed("integer");
    const Value links =
        object({{"type", "object"},
                {"properties",
                 object({{"self", text}, {"published", text}, {"model", text}, {"image", text}})},
                {"required", Value(Value::Array{"self"})},
                {"description", "Of the newest published version, if there is one."}});
    return {{"id", text},
            {"owner", text},
            {"name", text},
            {"title", text},
            {"form", text},
            {"newest",
             object({{"type", "integer"},
                     {"description", "Number of the newest published version; 0 for none."}})},
            {"state",
             object({{"type", "string"}, {"enum", Value(Value::Array{"active", "unlisted"})}})},
            {"parent", nullable("string")},
            {"parent2", nullable("string")},
            {"created_s", time_of("When it was created")},
            {"updated_s", time_of("When it last changed")},
            {"links", links}};
}

void add_library_schemas(Value& schemas, const Atlas&) {
    const Value text = typed("string"), whole = typed("integer");
    Value::Object written = species_members();
    written.emplace_back("revision", object({{"type", "integer"},
                                             {"description", "How often the draft was written."}}));
    written.emplace_back(
        "draft",
        object({{"type", "string"}, {"description", "Entity tag of the draft, for If-Match."}}));
    const Value image = objects({{"media", text}, {"sha256", text}, {"base64", text}});
    const Value place = objects({{"place", text}, {"sha256", text}});
    const Value version = objects({{"number", whole},
                                   {"made_s", time_of("When it was made")},
                                   {"note", text},
                                   {"format", whole},
                                   {"sha256", text},
                                   {"text", text},
                                   {"images", list_of(place)}});
    const Value::Object share = {{"id", text},
                                 {"created_s", time_of("When it was made")},
                                 {"expires_s", time_of("When it ends")},
                                 {"revoked", typed("boolean")}};
    Value::Object new_share = share;
    new_share.emplace_back("share", text);
    new_share.emplace_back("address", text);
    schemas.set("library_species", objects(written))
        .set("library_list", objects({{"species", list_of(objects(species_members()))},
                                      {"next", nullable("string")}}))
        .set("library_quota", objects({{"owner", text},
                                       {"scope", text},
                                       {"species", whole},
                                       {"max_species", whole},
                                       {"bytes", whole},
                                       {"max_bytes", whole},
                                       {"max_versions", whole},
                                       {"max_tokens", whole},
                                       {"max_shares", whole}}))
        .set("library_baked",
             objects(
                 {{"files", list_of(objects({{"lod", whole}, {"sha256", text}, {"url", text}}))}}))
        .set("library_import",
             objects({{"id", text}, {"newest", whole}, {"written", typed("boolean")}}))
        .set("library_export", objects({{"format", whole},
                                        {"owner", text},
                                        {"name", text},
                                        {"state", text},
                                        {"parent", text},
                                        {"parent2", text},
                                        {"created_s", time_of("When it was created")},
                                        {"updated_s", time_of("When it last changed")},
                                        {"versions", list_of(version)},
                                        {"images", list_of(image)}}))
        .set("library_shares", objects({{"shares", list_of(objects(share))}}))
        .set("library_share", objects(new_share));
}

void add_library_bodies(Value& bodies, const Atlas&) {
    bodies
        .set("library_species",
             json_body("A whole species, as in the files of an atlas; its `id` is its name.",
                       reference("schemas/species"), object({{"id", "my_bolete"}})))
        .set("library_publication",
             json_body("What is new.", schema<PublishOrder>(),
                       object({{"note", "A paler cap."}, {"bake", Value(Value::Array{0, 1})}})))
        .set("library_fork", json_body("The name of the copy.", schema<ForkOrder>(),
                                       object({{"name", "my_bolete"}})))
        .set("library_share", json_body("How long the key is good.", schema<ShareOrder>(),
                                        object({{"expires_s", 86400}})))
        .set("library_export", json_body("An export.", reference("schemas/library_export"),
                                         object({{"format", 1},
                                                 {"owner", "kaja"},
                                                 {"name", "red_bolete"},
                                                 {"state", "active"},
                                                 {"parent", ""},
                                                 {"parent2", ""},
                                                 {"created_s", 1'800'000'000},
                                                 {"updated_s", 1'800'000'000},
                                                 {"versions", Value::array()},
                                                 {"images", Value::array()}})));
}

void add_token_schemas(Value& schemas, const Atlas&) {
    const Value text = typed("string");
    const Value::Object members = {
        {"id", text},
        {"label", text},
        {"scope", text},
        {"created_s", time_of("When it was made")},
        {"expires_s", time_or_null("When it ends")},
        {"last_used_s", time_or_null("When it was used last, to a minute")},
        {"revoked_s", time_or_null("When it was revoked")}};
    Value::Object made = members;
    made.emplace_back("token",
                      object({{"type", "string"}, {"description", "The secret; shown once."}}));
    schemas.set("token_list", objects({{"tokens", list_of(objects(members))}}))
        .set("token", objects(made));
}

void add_token_bodies(Value& bodies, const Atlas&) {
    bodies.set("token", json_body("What the token is for and allows.", schema<TokenOrder>(),
                                  object({{"label", "build machine"}, {"scope", "read"}})));
}

}  // namespace

const RouteGroup library_routes = {
    .tag = "library",
    .description =
        "Species of users: drafts, and published versions that never change. Where the "
        "service has no library, these routes are 404.",
    .routes = library,
    .add_links = nullptr,
    .add_schemas = add_library_schemas,
    .add_bodies = add_library_bodies};

const RouteGroup token_routes = {.tag = "tokens",
                                 .description = "Tokens of the owners of species.",
                                 .routes = tokens,
                                 .add_links = nullptr,
                                 .add_schemas = add_token_schemas,
                                 .add_bodies = add_token_bodies};

}  // namespace sporeprint::api
