// Finished files that are stored with a published version.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "api/http/compression.h"
#include "api/http/conditions.h"
#include "api/http/encoding.h"
#include "api/http/query.h"
#include "api/library/species_text.h"
#include "api/library/tokens.h"
#include "api/products/library_handlers.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

/// What baking one level of detail costs, microseconds; that of LOD 0 with its images.
constexpr std::uint64_t cost_of_baking = 150'000;

/// Returns the response to a GET that this service itself sends, with species as guests of the atlas.
Response grown(const LibraryCall& call, std::vector<AtlasGuest> guests, const std::string& target) {
    const std::shared_ptr<Context> context = with_guests(call.context, std::move(guests));
    context->caches = computed_inline(context->store);
    const Request request{"GET", target, {}, {}, call.request.id};
    std::vector<Problem> malformed;
    const Target parsed = split_target(target, malformed);
    const Match match = context->routes.match("GET", parsed.segments);
    ValidationErrors errors;
    RouteCall route_call{*context, request, *match.route, parsed, match.captured, errors};
    Plan plan = match.route->plan(route_call);
    if (Job* const job = std::get_if<Job>(&plan))
        return job->run(
            {}, [](Step) {}, in_turn);
    return std::get<Response>(std::move(plan));
}

/// A version that an address names.
struct NamedVersion {
    LibraryName name;
    bool is_newest = false;  ///< by no number: tomorrow it may be another one
};

/// Returns the version that an address names, or the response that says why there is none.
std::variant<NamedVersion, Response> published(const LibraryCall& call) {
    ValidationErrors errors;
    const LibraryName name = read_species(call.captured[0], true, errors);
    if (!errors.empty()) return call.problem(errors);
    const Library::Found found = call.library.find(text_of(name));
    if (found.status != 200) return not_found(call.responses(), call.request, found);
    return NamedVersion{found.name, name.number == 0};
}

/// Lets caches have what never changes, and of the newest version says which it is.
///
/// path  of the version
void set_freshness(const LibraryCall& call, const NamedVersion& version, std::string_view path,
                   Response& response) {
    set_header(response, "Cache-Control", version.is_newest ? "no-cache" : cache_control(false));
    if (version.is_newest)
        set_header(response, "Content-Location", call.responses().link(std::string(path)));
}

}  // namespace

std::string baked_path(const LibraryName& version, std::string_view file) {
    return "/v1/library/" + text_of(version) + "/baked/" + std::string(file);
}

std::variant<std::vector<Blob>, Response> bake(const LibraryCall& call, const Content& content,
                                               const LibraryName& version,
                                               const std::set<int>& lods) {
    const std::string id = text_of(version);
    const std::shared_ptr<const AtlasEntry> entry = entry_of(species_of(content), id);
    std::vector<Blob> files;
    files.reserve(lods.size());
    for (const int lod : lods) {
        const std::string level = std::to_string(lod);
        std::string target = "/v1/mushrooms/" + id;
        (target += ".glb?lod=") += level;
        Response response = grown(call, {{id, entry}}, target);
        if (response.status != 200) return response;
        Blob file{level + ".glb", glb_type, {}, {}};
        file.bytes.reserve(size_of(response.body));
        for (const Slice& slice : response.body)
            file.bytes.insert(file.bytes.end(), slice.data(), slice.data() + slice.size);
        file.sha256 =
            sha256_of({reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()});
        files.push_back(std::move(file));
    }
    return files;
}

Plan plan_publication(RouteCall& call) {
    // Problems of the body are reported by the job.
    std::vector<Problem> problems;
    const auto order = read_json<PublishOrder>(call.request.body, problems);
    const Cost baking{.base = problems.empty() ? cost_of_baking * order.bake.size() : 0};
    return plan_library(call, Scope::write, publish_species, baking);
}

Response list_baked(LibraryCall& call) {
    auto found = published(call);
    if (Response* const refused = std::get_if<Response>(&found)) return std::move(*refused);
    const NamedVersion& named = std::get<NamedVersion>(found);
    const LibraryName& version = named.name;
    Value files = Value::array();
    for (const Blob& file : call.records.files(version.owner, version.name, version.number))
        files.push(Value::object()
                       .set("lod", std::stoi(file.place))
                       .set("sha256", hex_of(file.sha256))
                       .set("url", call.responses().link(baked_path(version, file.place))));
    Response response = private_json(Value::object().set("files", std::move(files)));
    set_freshness(call, named, "/v1/library/" + text_of(version) + "/baked.json", response);
    return response;
}

Response get_baked(LibraryCall& call) {
    auto found = published(call);
    if (Response* const refused = std::get_if<Response>(&found)) return std::move(*refused);
    const NamedVersion& named = std::get<NamedVersion>(found);
    const LibraryName& version = named.name;
    const std::string name = call.captured[1] + ".glb";
    const auto missing = [&] {
        return call.problem(404, "of " + in_quotes(text_of(version)) + " no " + in_quotes(name) +
                                     " is baked; " +
                                     in_quotes("/v1/library/" + text_of(version) + "/baked.json") +
                                     " lists what is");
    };
    // The bytes, of which there may be many, are read only if they are sent.
    const std::vector<Blob> files = call.records.files(version.owner, version.name, version.number);
    const auto known = std::find_if(files.begin(), files.end(),
                                    [&](const Blob& file) { return file.place == name; });
    if (known == files.end()) return missing();
    Response response;
    const std::string etag = etag_of_text(known->sha256);
    response.headers = {
        {"Content-Type", known->media},
        {"ETag", etag},
        {"Content-Disposition", "inline; filename=\"" + version.owner + '-' + version.name + '-' +
                                    std::to_string(version.number) + '-' + name + '"'}};
    set_freshness(call, named, baked_path(version, name), response);
    const Conditions conditions(call.request);
    const std::vector<std::string> etags = {etag};
    if (conditions.match_fails(etags))
        return call.responses().precondition_failed(call.request, "If-Match", etags);
    if (conditions.unchanged(etags) || conditions.none_match_any())
        return call.responses().not_modified(call.request, std::move(response), etag);
    std::optional<Blob> file = call.records.file(version.owner, version.name, version.number, name);
    if (!file) return missing();  // withdrawn meanwhile
    response.body = {Slice(std::make_shared<const Bytes>(std::move(file->bytes)))};
    call.responses().select_range(call.request, response);
    if (response.status == 206) set_header(response, "Accept-Ranges", "bytes");
    return response;
}

}  // namespace sporeprint::api
