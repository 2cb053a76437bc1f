#include "api/products/resource.h"

#include <algorithm>
#include <string>
#include <utility>

#include "api/http/compression.h"
#include "api/http/conditions.h"
#include "api/http/encoding.h"
#include "api/http/query.h"
#include "api/products/product.h"
#include "core/params/messages.h"

namespace sporeprint::api {

namespace {

constexpr const char* hit = "sporeprint; hit";
constexpr const char* hit_not_modified = "sporeprint; hit; detail=not-modified";
constexpr const char* missed = "sporeprint; fwd=miss";

/// Returns the response to HEAD of a resource that is not generated yet: the headers of GET without
/// the length. Whether a GLB has a gzip variant is known only once it exists, so these are the
/// headers of the identity.
Response unmade(const Context& context, const Request& request, Response head) {
    const std::string type(header_of(head, "Content-Type"));
    head.has_body = false;
    if (compressible(type)) {
        set_header(head, "Vary", "Accept-Encoding");
        if (accepts_gzip(request)) {
            set_header(head, "Content-Encoding", "gzip");
            set_header(head, "ETag", gzip_etag(header_of(head, "ETag")));
        }
    } else {
        if (type == glb_type) set_header(head, "Vary", "Accept-Encoding");
        set_header(head, "Accept-Ranges", "bytes");
    }
    set_header(head, "Cache-Status", missed);
    context.responses.add_common_headers(request, head);
    return head;
}

/// Returns true if the response may be the gzip variant of a GLB. A range is one of the identity
/// unless If-Range names the variant, so that a client combines only ranges of one representation.
bool takes_gzip_of_glb(const Request& request, std::string_view type, const std::string& etag) {
    if (type != glb_type || !accepts_gzip(request)) return false;
    return request.method != "GET" || !header_list(request, "Range") ||
           (header_list(request, "If-Range") && if_range_matches(request, gzip_etag(etag)));
}

/// Returns the headers of every response about a resource.
///
/// linked_elsewhere  true if its links differ from those of its canonical URL
Response resource_head(const Context& context, const Resource& resource, const std::string& etag,
                       bool versioned, bool linked_elsewhere) {
    Response head;
    head.headers = {{"Content-Type", resource.type},
                    {"ETag", etag},
                    {"Cache-Control", cache_control(versioned)},
                    {"Content-Disposition", "inline; filename=\"" + resource.file_name + '"'}};
    if (!resource.address.empty() && !linked_elsewhere && !context.options.signed_urls)
        head.headers.emplace_back("Content-Location", context.responses.link(resource.address));
    return head;
}

/// The cached representation of a resource that may have a gzip variant.
struct Found {
    /// The representation to send if it is cached, else the identity.
    std::optional<CachedResponse> cached;
    bool has_variants = false;
    bool is_chosen = false;  ///< true if it is the representation to send
};

Found find_cached(Store& store, const Key& key, bool takes_gzip) {
    Found found;
    if (takes_gzip && (found.cached = store.responses.find(gzip_key(key)))) {
        found.has_variants = found.is_chosen = true;
    } else if ((found.cached = store.responses.find(key))) {
        found.has_variants = !header_of(**found.cached, "Vary").empty();
        found.is_chosen = !takes_gzip || !found.has_variants;
    }
    return found;
}

/// Returns true if the gzip variant of a job's response fits into the cache.
bool stores_gzip(const Store& store, Response response, const Key& key) {
    select_gzip(response);
    return store.responses.fits(weight_of(response) + key.size() + entry_overhead);
}

/// Returns a function that sets Cache-Control, which depends on whether the URL has a version
/// token.
Delivery with_cache_control(bool versioned) {
    return [versioned](Response& response) {
        set_header(response, "Cache-Control", cache_control(versioned));
    };
}

/// Returns the job that computes the gzip variant of a cached GLB.
Job gzip_job(Store& store, CachedResponse cached, const Key& key, bool versioned) {
    const Cost cost = gzip_cost(size_of(cached->body));
    auto run = [&store, cached = std::move(cached), key = gzip_key(key)](
                   std::stop_token stop, const Observer& observer, const Parallel& parallel) {
        observer(Step::pack);
        Response response;
        response.headers = cached->headers;
        response.gzipped = gzip_glb(cached->body, stop, parallel);
        response.is_stored = true;
        const bool stored = stores_gzip(store, response, key);
        set_header(response, "Cache-Status",
                   cache_member("sporeprint-gzip", false, stored) + ", " + hit);
        return response;
    };
    return Job{.key = gzip_key(key),
               .cost = cost,
               .run = std::move(run),
               .delivery = with_cache_control(versioned)};
}

/// Returns the job that generates a resource which is not cached.
///
/// head  its headers, without Cache-Control
/// cost  of generating it; nothing if that is unknown until its correspondence is computed
Job generation_job(const Context& context, Resource resource, Response head,
                   const std::optional<Cost>& cost, bool takes_gzip, bool versioned) {
    Store& store = context.store;
    // What its owner may withdraw is not left in a folder.
    DirectoryStore* const directory =
        store.directory && !context.has_guests ? &*store.directory : nullptr;
    const Cost estimate = cost ? *cost : *resource.guess + resource.search;
    const Cost compressing = takes_gzip ? gzip_cost_of_glb(estimate) : Cost{};
    auto run = [&store, directory, takes_gzip,
                estimate_cost = cost ? nullptr : std::move(resource.estimate_cost),
                make = std::move(resource.make), head = std::move(head), key = resource.key](
                   std::stop_token stop, const Observer& observer, const Parallel& parallel) {
        Response response = head;
        const auto finished = [&](std::string status) {
            if (header_of(response, "Content-Type") == glb_type && is_worth_gzip(response.body)) {
                set_header(response, "Vary", "Accept-Encoding");
                if (takes_gzip) response.gzipped = gzip_glb(response.body, stop, parallel);
            }
            response.is_stored = true;
            if (!status.empty()) status += ", ";
            const bool stored =
                store.responses.fits(weight_of(response) + key.size() + entry_overhead);
            set_header(response, "Cache-Status",
                       status + cache_member("sporeprint", false, stored));
            return std::move(response);
        };
        // A stored file is possible and within its budget.
        if (directory)
            if (std::optional<Slice> written = directory->find(key)) {
                response.body = {*std::move(written)};
                return finished(cache_member("sporeprint-store", true, false));
            }
        JobContext job_context(store, stop, observer, parallel);
        if (estimate_cost) {
            observer(Step::resolve);
            static_cast<void>(estimate_cost(job_context.execution().caches));
        }
        response.body = make(job_context);
        ++store.counters.generated;
        if (directory) directory->insert(key, response.body);
        return finished(job_context.cache_status());
    };
    return Job{.key = std::move(resource.key),
               .cost = estimate + compressing,
               .run = std::move(run),
               .delivery = with_cache_control(versioned)};
}

/// Returns the cost of generating a resource. Adds what is impossible to `errors`, with the names
/// that the client uses.
Cost weighed(const Request& request, const Resource& resource, const Caches& caches,
             ValidationErrors& errors) {
    const bool posted = request.method == "POST";
    try {
        return resource.estimate_cost(caches);
    } catch (const Impossible& impossible) {
        errors.add(422, named(impossible, posted));
    } catch (const InvalidInput& invalid) {
        errors.add(400, named(invalid, posted));
    } catch (CacheMiss& missing) {
        missing.cost = resource.search;
        throw;
    }
    return {};
}

/// Returns the response to a request for a cached resource.
Response cached_response(const Context& context, const Request& request, const Found& found,
                         bool versioned) {
    Response response = **found.cached;
    set_header(response, "Cache-Control", cache_control(versioned));
    set_header(response, "Cache-Status", hit);
    if (!found.is_chosen) {
        select_gzip(response);
        response.has_body = false;
    }
    response.cacheable = true;
    context.responses.represent(request, response);
    context.responses.select_range(request, response);
    return response;
}

std::string too_many_texels(const ServiceOptions& options, std::uint64_t texels,
                            bool of_every_species, const char* parameter) {
    return std::to_string(texels) + " texels would be held" +
           (of_every_species ? ", those of every species" : "") + "; at most " +
           std::to_string(options.most_texels) + " are. Lower " + parameter;
}

}  // namespace

void refuse_over_budget(const ServiceOptions& options, const Estimate& cost, bool of_every_species,
                        bool is_clip, const FileOptions& file) {
    std::vector<Problem> problems;
    if (cost.vertices > options.most_vertices) {
        const std::string count = std::to_string(cost.vertices) +
                                  " vertices would be made; at most " +
                                  std::to_string(options.most_vertices) + " are. ";
        report(problems, "/lod", count + "Raise lod");
        if (file.lods != Lods::single) report(problems, "/lods", count + "Ask for lods=single");
        if (is_clip) report(problems, "/frames", count + "Lower frames");
    }
    if (cost.texels > options.most_texels)
        report(problems, "/texture_size",
               too_many_texels(options, cost.texels, of_every_species, "texture_size") +
                   " or raise lod");
    if (!problems.empty()) throw Impossible(std::move(problems));
}

void refuse_texels(const ServiceOptions& options, std::uint64_t texels, bool of_every_species,
                   ValidationErrors& errors) {
    if (texels > options.most_texels)
        errors.add(422, "side", too_many_texels(options, texels, of_every_species, "side"));
}

std::vector<Problem> named(const InvalidInput& input, bool posted) {
    std::vector<Problem> problems = input.problems();
    for (Problem& problem : problems) problem.path = parameter_name(problem.path, posted);
    return problems;
}

int link_depth(const Context& context, const Request& request) {
    std::string_view path = below(context.options.base_path, request.target);
    path = path.substr(0, path.find('?'));
    return static_cast<int>(std::count(path.begin(), path.end(), '/')) - 2;
}

Plan plan_resource(Context& context, const Request& request, Resource resource,
                   ValidationErrors& errors) {
    if (resource.is_linked && context.options.signed_urls)
        errors.add(422, request.method == "POST" ? "/textures" : "textures",
                   "addresses are signed here, and those of linked images are not; ask for "
                   "embedded or none");
    if (resource.is_linked && context.has_drafts)
        errors.add(422, request.method == "POST" ? "/textures" : "textures",
                   "images of a draft have no address of their own, since not everybody may see "
                   "it; ask for embedded or none");
    if (!errors.empty()) return context.responses.problem(request, errors);
    const int depth = link_depth(context, request);
    // Links are relative, so the bytes depend on the depth of the URL against which they are
    // resolved.
    const bool linked_elsewhere = resource.is_linked && depth != usual_depth;
    if (linked_elsewhere) resource.key += "\nlinked from depth " + std::to_string(depth);
    if (resource.requested_version && *resource.requested_version != resource.version) {
        static_cast<void>(weighed(request, resource, context.caches, errors));
        return superseded(context.responses, request, request.method == "POST" ? "/v" : "v",
                          *resource.requested_version, resource.version, resource.address, errors);
    }

    Store& store = context.store;
    const bool versioned = resource.requested_version.has_value() && request.method != "POST";
    const std::string etag = etag_of(resource.key);
    Response head = resource_head(context, resource, etag, versioned, linked_elsewhere);
    const bool takes_gzip = takes_gzip_of_glb(request, resource.type, etag);
    const Found found = find_cached(store, resource.key, takes_gzip);
    std::vector<std::string> etags = current_etags(request, etag, resource.type);
    if (resource.type == glb_type && accepts_gzip(request)) etags.push_back(gzip_etag(etag));

    // In the order of RFC 9110 section 13.2.2: If-Match leads to 412, then If-None-Match to 304, or
    // to 412 for POST.
    const Conditions conditions(request);
    const auto unchanged = [&](const std::string& current) {
        if (request.method == "POST")
            return context.responses.precondition_failed(request, "If-None-Match", etags);
        ++store.counters.glb_not_modified;
        set_header(head, "Cache-Status", hit_not_modified);
        if (resource.type == glb_type && (!found.cached || found.has_variants))
            set_header(head, "Vary", "Accept-Encoding");
        return context.responses.not_modified(request, std::move(head), current);
    };
    const bool match_fails = conditions.match_fails(etags);
    const bool any = conditions.none_match_any();
    if (const std::string* current = conditions.unchanged(etags); current && !match_fails)
        return unchanged(*current);
    if (found.cached && match_fails)
        return context.responses.precondition_failed(request, "If-Match", etags);
    if (found.cached && any)
        return unchanged(takes_gzip && found.has_variants ? gzip_etag(etag) : etags.front());
    if (found.cached) {
        ++store.counters.glb_hits;
        if (!found.is_chosen && request.method != "HEAD")
            return gzip_job(store, *found.cached, resource.key, versioned);
        return cached_response(context, request, found, versioned);
    }
    // A correspondence that is not cached takes milliseconds: the job that generates the body
    // computes it, if there is such a job.
    std::optional<Cost> cost;
    try {
        cost = weighed(request, resource, context.caches, errors);
    } catch (const CacheMiss&) {
        if (request.method == "HEAD" || any || match_fails || !resource.guess) throw;
    }
    if (!errors.empty()) return context.responses.problem(request, errors);
    if (match_fails) return context.responses.precondition_failed(request, "If-Match", etags);
    if (any) return unchanged(etags.front());
    if (request.method == "HEAD") return unmade(context, request, std::move(head));

    if (resource.prerequisite && !context.has_prerequisites)
        if (std::optional<Job> job = resource.prerequisite(store)) return *std::move(job);

    ++store.counters.glb_misses;
    take_header(head, "Cache-Control");
    return generation_job(context, std::move(resource), std::move(head), cost, takes_gzip,
                          versioned);
}

}  // namespace sporeprint::api
