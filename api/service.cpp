#include "api/service.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "api/cache.h"
#include "api/catalogue.h"
#include "api/documents.h"
#include "api/encoding.h"
#include "api/errors.h"
#include "api/mix.h"
#include "api/mushrooms.h"
#include "api/openapi.h"
#include "api/query.h"
#include "api/routes.h"
#include "api/stopwatch.h"
#include "api/surfaces.h"
#include "api/text.h"
#include "core/gltf/inspect.h"
#include "core/grow/mushroom.h"
#include "core/params/messages.h"
#include "core/params/query.h"
#include "core/params/reader.h"

#ifndef SPOREPRINT_VERSION
#error "SPOREPRINT_VERSION comes from the project's version in CMakeLists.txt"
#endif

namespace sporeprint::api {

namespace {

using Images = std::shared_ptr<const ImageSet>;
using Kept = std::shared_ptr<const Answer>;
using Plan = std::variant<Answer, Job>;

/// What only Service reads of a job's shared answer: the digest of an image set. Never sent.
constexpr const char* digest_header = ":digest";

constexpr const char* exposed_headers =
    "Cache-Status, Content-Disposition, Content-Length, Content-Location, ETag, Retry-After, "
    "Server-Timing, X-Request-Id";

std::string_view header_of(const Answer& answer, std::string_view name) {
    for (const auto& [key, value] : answer.headers)
        if (same_word(key, name)) return value;
    return {};
}

void set_header(Answer& answer, std::string_view name, std::string value) {
    for (auto& [key, old] : answer.headers)
        if (same_word(key, name)) {
            old = std::move(value);
            return;
        }
    answer.headers.emplace_back(std::string(name), std::move(value));
}

std::string take_header(Answer& answer, std::string_view name) {
    const auto found =
        std::find_if(answer.headers.begin(), answer.headers.end(),
                     [&](const Header& header) { return same_word(header.first, name); });
    if (found == answer.headers.end()) return {};
    std::string value = std::move(found->second);
    answer.headers.erase(found);
    return value;
}

std::size_t weight_of(const Answer& answer) {
    std::size_t bytes =
        size_of(answer.body) + sizeof(Answer) + answer.body.size() * (sizeof(Slice) + 64);
    for (const auto& [name, value] : answer.headers)
        bytes += name.size() + value.size() + 2 * sizeof(Header);
    return bytes;
}

bool proper_id(std::string_view id) {
    return !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), [](char c) {
        return (c >= '0' && c <= '9') || (lower(c) >= 'a' && lower(c) <= 'z') || c == '_' ||
               c == '-';
    });
}

/// Paths of core as the client wrote them.
std::vector<Problem> named(const InvalidInput& input, bool posted) {
    std::vector<Problem> problems = input.problems();
    for (Problem& problem : problems) problem.path = parameter_name(problem.path, posted);
    return problems;
}

bool kept_by_key(const Key& key) { return key.starts_with("mushroom."); }

Value vector_value(const glm::vec3& vector) {
    return Value(Value::Array{write(vector.x), write(vector.y), write(vector.z)});
}

}  // namespace

struct Service::Parts {
    std::shared_ptr<const Atlas> atlas;
    ServiceOptions options;
    Cache<Kept> answers;
    RememberingCache<Images> images;
    mutable Counters counters;

    std::map<std::string, Document, std::less<>> assets;
    Document about, species_list, schema, openapi, hint;
    std::map<std::string, Document, std::less<>> species;
    std::atomic<std::uint64_t> inspections{0};

    Parts(std::shared_ptr<const Atlas> the_atlas, ServiceOptions the_options)
        : atlas(std::move(the_atlas)),
          options(std::move(the_options)),
          answers(options.cache_bytes, [](const Kept& answer) { return weight_of(*answer); }),
          images(options.image_cache_bytes,
                 [](const Images& set) { return set->bytes() + sizeof(ImageSet); }) {
        if (!options.assets.empty()) assets = read_assets(options.assets);
        Value links = Value::object();
        links.set("species", "/v1/species")
            .set("mushroom_schema", "/v1/mushrooms/schema")
            .set("openapi", "/openapi.json")
            .set("docs", "/docs");
        Value root = Value::object();
        root.set("name", "sporeprint")
            .set("version", SPOREPRINT_VERSION)
            .set("generator_version", generator_version)
            .set("links", std::move(links));
        about = json_document(root);
        species_list = json_document(api::species_list(*atlas));
        schema = json_document(mushroom_schema(), "application/schema+json");
        openapi = json_document(api::openapi(*atlas, SPOREPRINT_VERSION));
        for (const AtlasEntry& entry : atlas->entries())
            species.emplace(entry.species.id.string(), document("application/json", entry.json));
        hint = document("text/plain; charset=utf-8",
                        "Sporeprint grows mushrooms. The page is not installed here; the API is:\n"
                        "  GET /v1/species\n  GET /v1/mushrooms/<species>.glb?age=0.6&seed=7\n  "
                        "GET /openapi.json\n",
                        revalidated);
    }

    // --- The shape of every answer ---------------------------------------------------------

    /// Headers that every answer carries.
    void add_common_headers(const Request& request, Answer& answer) const {
        if (proper_id(request.id)) set_header(answer, "X-Request-Id", request.id);
        if (!options.allow_origin.empty()) {
            set_header(answer, "Access-Control-Allow-Origin", options.allow_origin);
            set_header(answer, "Access-Control-Expose-Headers", exposed_headers);
            set_header(answer, "Timing-Allow-Origin", options.allow_origin);
        }
        set_header(answer, "Cross-Origin-Resource-Policy", "cross-origin");
        set_header(answer, "X-Content-Type-Options", "nosniff");
    }

    Answer problem(const Request& request, int status, std::string_view detail,
                   std::span<const Problem> problems = {}, Value::Object more = {}) const {
        Answer answer = problem_answer(request, status, detail, problems, std::move(more));
        add_common_headers(request, answer);
        return answer;
    }

    Answer problem(const Request& request, const Faults& faults) const {
        return problem(request, faults.status(), {}, faults.problems());
    }

    /// Makes the answer the representation that the client asked for: encoding, caching, tags.
    void represent(const Request& request, Answer& answer, const Document* ready = nullptr) const {
        const std::string type(header_of(answer, "Content-Type"));
        if (compressible(type)) {
            set_header(answer, "Vary", "Accept-Encoding");
            if (accepts_gzip(request.header("Accept-Encoding"))) {
                const std::string etag(header_of(answer, "ETag"));
                if (!etag.empty()) set_header(answer, "ETag", gzip_etag(etag));
                set_header(answer, "Content-Encoding", "gzip");
                answer.body = {ready ? ready->gzipped : gzip(answer.body)};
            }
        }
        add_common_headers(request, answer);
    }

    /// The tag of the representation that `request` would get.
    static std::string selected_etag(const Request& request, const std::string& etag,
                                     std::string_view content_type) {
        return compressible(content_type) && accepts_gzip(request.header("Accept-Encoding"))
                   ? gzip_etag(etag)
                   : etag;
    }

    /// 304 with the headers that the 200 would carry.
    Answer not_modified(const Request& request, Answer answer) const {
        const std::string type = take_header(answer, "Content-Type");
        take_header(answer, "Content-Disposition");
        const std::string etag(header_of(answer, "ETag"));
        set_header(answer, "ETag", selected_etag(request, etag, type));
        if (compressible(type)) set_header(answer, "Vary", "Accept-Encoding");
        answer.status = 304;
        answer.body.clear();
        answer.has_body = false;
        add_common_headers(request, answer);
        return answer;
    }

    Answer answer_document(const Request& request, const Document& document) const {
        Answer answer;
        answer.headers = {{"Content-Type", document.content_type},
                          {"Cache-Control", document.cache_control},
                          {"ETag", document.etag}};
        const std::string_view condition = request.header("If-None-Match");
        if (names_any(condition) ||
            names_etag(condition, selected_etag(request, document.etag, document.content_type)))
            return not_modified(request, std::move(answer));
        answer.body = {document.body};
        represent(request, answer, &document);
        return answer;
    }

    static std::string cache_control(bool versioned) {
        return versioned ? immutable_for_a_year : cached_for_an_hour;
    }

    // --- Planning ----------------------------------------------------------------------------

    Plan plan(const Request& request) {
        if (request.target.size() > longest_target)
            return problem(request, 414,
                           "the address has " + std::to_string(request.target.size()) +
                               " bytes; at most " + std::to_string(longest_target) + " are taken");
        if (request.method == "OPTIONS" && request.target == "*")
            return options_answer(request, "GET, HEAD, POST, OPTIONS");
        Faults faults;
        std::vector<Problem> malformed;
        const Target target = split_target(request.target, malformed);
        const bool path_malformed =
            std::any_of(malformed.begin(), malformed.end(),
                        [](const Problem& one) { return one.path == "path"; });
        faults.add(400, malformed);
        if (path_malformed) return problem(request, faults);

        const Match match = match_route(request.method, target.segments);
        if (match.allow.empty()) {
            const std::string meant = closest_route(target.segments);
            const std::string detail =
                "there is nothing at " + in_quotes(target.path) +
                (meant.empty() ? "" : "; did you mean " + in_quotes(meant) + "?");
            return problem(request, 404, detail, faults.problems());
        }
        if (request.method == "OPTIONS") return options_answer(request, match.allow);
        if (!match.route) {
            Answer answer = problem(
                request, 405,
                in_quotes(request.method) + " is not answered here; " + match.allow + " are");
            set_header(answer, "Allow", match.allow);
            return answer;
        }
        const Route& route = *match.route;
        if (*route.takes)
            if (std::optional<Answer> refusal = refuse_body(request, route))
                return *std::move(refusal);

        switch (route.endpoint) {
            case Endpoint::page:
                return page(request, "index.html");
            case Endpoint::docs:
                return page(request, "docs.html");
            case Endpoint::asset:
                return asset(request, match.captured[0]);
            case Endpoint::root:
                return plain_document(request, target, faults, about);
            case Endpoint::mushroom_schema:
                return plain_document(request, target, faults, schema);
            case Endpoint::openapi:
                return plain_document(request, target, faults, openapi);
            case Endpoint::species_list:
                return list_species(request, target, faults);
            case Endpoint::species:
                return one_species(request, target, faults, match.captured[0]);
            case Endpoint::mushroom_glb:
                return mushroom(request,
                                read_mushroom(match.captured[0], target.query, *atlas, faults),
                                Product::glb, faults);
            case Endpoint::mushroom_json:
                return mushroom(request,
                                read_mushroom(match.captured[0], target.query, *atlas, faults),
                                Product::json, faults);
            case Endpoint::mushroom_post:
                refuse_query(target, faults);
                return mushroom(request, read_mushroom(request.body, *atlas, faults), Product::glb,
                                faults);
            case Endpoint::surface:
                return surface(request,
                               read_surface(match.captured[0], match.captured[1], target.query,
                                            *atlas, faults),
                               faults);
            case Endpoint::inspect:
                refuse_query(target, faults);
                return inspect(request, faults);
            case Endpoint::livez:
            case Endpoint::readyz:
            case Endpoint::metrics:
                break;  // the server's own; match_route never finds them
        }
        return problem(request, 404, "there is nothing at " + in_quotes(target.path));
    }

    Answer options_answer(const Request& request, const std::string& allow) const {
        Answer answer;
        answer.status = 204;
        answer.has_body = false;
        answer.headers = {{"Allow", allow}, {"Cache-Control", "no-store"}};
        if (!options.allow_origin.empty()) {
            set_header(answer, "Access-Control-Allow-Methods", allow);
            set_header(answer, "Access-Control-Allow-Headers",
                       "Cache-Control, Content-Type, If-None-Match, X-Request-Id");
            set_header(answer, "Access-Control-Max-Age", "86400");
        }
        add_common_headers(request, answer);
        return answer;
    }

    /// 413 and 415 of routes that take a body.
    std::optional<Answer> refuse_body(const Request& request, const Route& route) const {
        if (!request.header("Content-Encoding").empty())
            return problem(request, 415,
                           "bodies with a Content-Encoding are not taken; send it plain");
        const std::string_view given = request.header("Content-Type");
        const std::string_view type = trimmed(given.substr(0, given.find(';')));
        if (!same_word(type, route.takes))
            return problem(request, 415,
                           "the body is " + (type.empty() ? "of no stated type" : in_quotes(type)) +
                               "; send Content-Type: " + route.takes);
        if (request.body.size() > longest_body(route))
            return problem(request, 413,
                           "the body has " + std::to_string(request.body.size()) +
                               " bytes; at most " + std::to_string(longest_body(route)) +
                               " are taken");
        return std::nullopt;
    }

    /// For routes without query parameters.
    static void refuse_query(const Target& target, Faults& faults) {
        for (const auto& pair : target.query)
            faults.add(400, printable(pair.first), "unknown parameter; this route takes none");
    }

    Answer page(const Request& request, std::string_view file) const {
        const auto found = assets.find(file);
        if (found != assets.end()) return answer_document(request, found->second);
        if (file == "index.html") return answer_document(request, hint);
        return problem(request, 404,
                       "the page is not installed here; the document is at /openapi.json");
    }

    Answer asset(const Request& request, const std::string& file) const {
        const auto found = assets.find(file);
        if (found != assets.end()) return answer_document(request, found->second);
        return problem(request, 404, "there is no file " + in_quotes(file));
    }

    Answer plain_document(const Request& request, const Target& target, Faults& faults,
                          const Document& document) const {
        refuse_query(target, faults);
        return faults.empty() ? answer_document(request, document) : problem(request, faults);
    }

    Answer list_species(const Request& request, const Target& target, Faults& faults) const {
        SpeciesFilter filter;
        std::vector<Problem> problems;
        read_query(target.query, filter, problems);
        faults.add(400, problems);
        if (!faults.empty()) return problem(request, faults);
        return answer_document(request, filter == SpeciesFilter{}
                                            ? species_list
                                            : json_document(api::species_list(*atlas, filter)));
    }

    Answer one_species(const Request& request, const Target& target, Faults& faults,
                       const std::string& id) const {
        refuse_query(target, faults);
        const auto found = species.find(id);
        if (found == species.end()) faults.add(404, "id", unknown_species(id, *atlas));
        return faults.empty() ? answer_document(request, found->second) : problem(request, faults);
    }

    // --- Mushrooms ---------------------------------------------------------------------------

    /// What an order will cost; adds to `faults` what of it is well-formed but impossible, as far as it can be told without
    /// making it (the individual is decided, nothing is built).
    Estimate weighed(const MushroomOrder& order, bool posted, Faults& faults) const {
        const auto where = [&](const char* parameter) {
            return posted ? '/' + std::string(parameter) : std::string(parameter);
        };
        if (order.mix.size() > 1)
            faults.add(
                422, "mix",
                "species cannot be mixed yet; ask for one of " + mix_text(order.mix) + " alone");
        if (order.model && order.params.textures == Textures::linked)
            faults.add(422, where("textures"),
                       "a model of your own has no address that images could be linked to; ask for "
                       "embedded or none");
        if (!faults.empty()) return {};
        Estimate cost;
        try {
            cost = estimate(order, *atlas);
        } catch (const Impossible& impossible) {
            faults.add(422, named(impossible, posted));
        } catch (const InvalidInput& invalid) {
            faults.add(400, named(invalid, posted));
        }
        if (cost.vertices > options.most_vertices)
            faults.add(422, where("lod"),
                       std::to_string(cost.vertices) + " vertices would be made; at most " +
                           std::to_string(options.most_vertices) + " are. Raise lod");
        if (cost.texels > options.most_texels)
            faults.add(422, where("texture_size"),
                       std::to_string(cost.texels) + " texels would be painted; at most " +
                           std::to_string(options.most_texels) +
                           " are. Lower texture_size or raise lod");
        return cost;
    }

    Plan mushroom(const Request& request, MushroomRequest asked, Product product, Faults& faults) {
        const bool posted = request.method == "POST";
        if (!faults.empty()) return problem(request, faults);
        const MushroomOrder& order = asked.order;
        const std::string version = version_token(order.mix, *atlas);
        const std::string address = order.model ? std::string() : canonical_address(order, product);
        Key key = key_of(order, product, version);
        const char* type = product == Product::glb ? "model/gltf-binary" : "application/json";

        if (asked.version && *asked.version != version) {
            static_cast<void>(weighed(order, posted, faults));
            faults.add(410, posted ? "/v" : "v",
                       in_quotes(*asked.version) + " is no longer made; today's version is " +
                           in_quotes(version));
            Value::Object more;
            if (faults.status() == 410 && !address.empty())
                more.emplace_back("canonical", with_version(address, version));
            return problem(request, faults.status(), {}, faults.problems(), std::move(more));
        }

        Answer head;  // what every answer about this resource carries
        head.headers = {
            {"Content-Type", type},
            {"ETag", etag_of(key)},
            {"Cache-Control", cache_control(asked.version.has_value() && !posted)},
            {"Content-Disposition", "inline; filename=\"" + file_name(order, product) + '"'}};
        if (!address.empty())
            head.headers.emplace_back("Content-Location", with_version(address, version));

        const std::string_view condition = request.header("If-None-Match");
        const bool named_tag = names_etag(condition, selected_etag(request, etag_of(key), type));
        if (named_tag || (names_any(condition) && answers.holds(key))) {
            ++counters.glb_not_modified;
            set_header(head, "Cache-Status", "sporeprint; hit; detail=not-modified");
            return not_modified(request, std::move(head));
        }
        if (const std::optional<Kept> kept = answers.find(key)) {
            ++counters.glb_hits;
            Answer answer = **kept;
            set_header(answer, "Cache-Control",
                       cache_control(asked.version.has_value() && !posted));
            set_header(answer, "Cache-Status", "sporeprint; hit");
            represent(request, answer);
            return answer;
        }
        const Estimate estimated = weighed(order, posted, faults);
        if (!faults.empty()) return problem(request, faults);
        if (names_any(condition)) {
            ++counters.glb_not_modified;
            set_header(head, "Cache-Status", "sporeprint; hit; detail=not-modified");
            return not_modified(request, std::move(head));
        }
        if (request.method == "HEAD") {
            head.has_body = false;
            set_header(head, "ETag", selected_etag(request, etag_of(key), type));
            if (compressible(type)) {
                set_header(head, "Vary", "Accept-Encoding");
                if (accepts_gzip(request.header("Accept-Encoding")))
                    set_header(head, "Content-Encoding", "gzip");
            }
            set_header(head, "Cache-Status", "sporeprint; fwd=miss");
            add_common_headers(request, head);
            return head;
        }

        ++counters.glb_misses;
        take_header(head, "Cache-Control");
        const bool json = product == Product::json;
        Cost cost{estimated.vertices, json ? 0 : estimated.texels,
                  json ? estimated.vertices * 32 : estimated.bytes};
        auto shared_order = std::make_shared<const MushroomOrder>(std::move(asked.order));
        auto run = [this, product, shared_order, head = std::move(head), key, address, version](
                       std::stop_token stop, const Observer& observer, const Parallel& parallel) {
            Answer answer = head;
            std::string status;
            if (product == Product::glb)
                answer.body =
                    grow(*shared_order, address, version, status, stop, observer, parallel);
            else
                answer.body = describe(*shared_order, version, observer);
            ++counters.generated;
            if (!status.empty()) status += ", ";
            const bool stored = answers.fits(weight_of(answer) + key.size() + entry_overhead);
            set_header(answer, "Cache-Status",
                       status + (stored ? "sporeprint; fwd=miss; stored" : "sporeprint; fwd=miss"));
            return answer;
        };
        return Job{std::move(key), cost, std::move(run)};
    }

    /// The GLB; `status` becomes the Cache-Status of its images.
    Body grow(const MushroomOrder& order, const std::string& address, const std::string& version,
              std::string& status, std::stop_token stop, const Observer& observer,
              const Parallel& parallel) {
        Extras extras;
        extras.canonical = address;
        if (order.params.textures == Textures::linked) {
            const PaintParams painted =
                paint_params(order, *atlas, surface_metrics(resolve(order, *atlas)));
            const SurfaceAddress image = surface_address(order, painted);
            for (std::size_t i = 0; i < extras.image_addresses.size(); ++i)
                extras.image_addresses[i] = with_version(
                    canonical_address(order.mix, static_cast<ImageKind>(i), image), version);
        }
        Workshop workshop;
        workshop.observer = observer;
        workshop.parallel = parallel;
        workshop.stop = stop;
        workshop.memo.images = [&](const std::string& key, const std::function<Images()>& make) {
            bool hit = false, stored = false;
            Images set = remember(key, make, stop, hit, stored);
            status = image_status(hit, stored);
            return set;
        };
        return grow_mushroom(order, *atlas, extras, workshop).glb;
    }

    static const char* image_status(bool hit, bool stored) {
        return hit      ? "sporeprint-images; hit"
               : stored ? "sporeprint-images; fwd=miss; stored"
                        : "sporeprint-images; fwd=miss";
    }

    /// The images kept under `key`, or what `make` paints; counts.
    Images remember(const std::string& key, const std::function<Images()>& make,
                    std::stop_token stop, bool& hit, bool& stored) {
        const auto counted = [&] {
            Images set = make();
            ++counters.painted;
            return set;
        };
        Images set = images.remember(key, counted, std::move(stop), hit);
        stored = images.cache().fits(images.cache().weight(key, set));
        ++(hit ? counters.image_hits : counters.image_misses);
        return set;
    }

    /// What would be made, as JSON.
    Body describe(const MushroomOrder& order, const std::string& version,
                  const Observer& observer) const {
        observer(Step::resolve);
        const Individual individual = resolve(order, *atlas);
        observer(Step::build);
        const Bounds box = bounds(mushroom_mesh(order, individual));
        observer(Step::pack);
        const Estimate cost = estimate(order, *atlas);
        Value mix = Value::array();
        for (const MixPart& part : order.mix)
            mix.push(Value::object().set("id", part.id).set("weight", part.weight / 1000.0));
        Value body = Value::object();
        // The address of the GLB: what a person copies from here into a game.
        body.set("canonical", canonical_address(order, Product::glb));
        body.set("v", version);
        body.set("mix", std::move(mix));
        body.set("effective", write(individual.effective));
        body.set("estimate", Value::object()
                                 .set("vertices", cost.vertices)
                                 .set("triangles", cost.triangles)
                                 .set("bytes", cost.bytes));
        body.set(
            "bounds_m",
            Value::object().set("min", vector_value(box.min)).set("max", vector_value(box.max)));
        // resolve() refuses crossing outlines by exact predicates on the sampled polyline; who got here has passed.
        body.set("certificate", Value::object().set("simple", true).set("method", "exact"));
        return {slice_of(dump(body))};
    }

    // --- Surfaces ----------------------------------------------------------------------------

    /// What every answer about an image carries; the tag is that of what is painted.
    Answer surface_head(const SurfaceRequest& asked, std::string_view digest,
                        const std::string& version) const {
        Answer head;
        head.headers = {
            {"Content-Type", "image/jpeg"},
            {"ETag", '"' + std::string(digest) + '-' + name(*asked.kind) + '"'},
            {"Cache-Control", cache_control(asked.version.has_value())},
            {"Content-Location",
             with_version(canonical_address(asked.mix, *asked.kind, asked.address), version)},
            {"Content-Disposition", "inline; filename=\"" + asked.mix.front().id + '-' +
                                        std::to_string(asked.address.seed) + '-' +
                                        name(*asked.kind) + ".jpg\""}};
        return head;
    }

    Plan surface(const Request& request, const SurfaceRequest& asked, Faults& faults) {
        if (!faults.empty()) return problem(request, faults);
        if (asked.mix.size() > 1)
            faults.add(
                422, "mix",
                "species cannot be mixed yet; ask for one of " + mix_text(asked.mix) + " alone");
        PaintParams painted;
        if (faults.empty()) {
            try {
                painted = painted_at(asked.address, asked.mix, *atlas);
            } catch (const Impossible& impossible) {
                faults.add(422, named(impossible, false));
            } catch (const InvalidInput& invalid) {
                faults.add(400, named(invalid, false));
            }
        }
        const auto side = static_cast<std::uint64_t>(painted.side);
        if (3 * side * side > options.most_texels)
            faults.add(422, "texture_size",
                       std::to_string(3 * side * side) + " texels would be painted; at most " +
                           std::to_string(options.most_texels) + " are");
        const std::string version = version_token(asked.mix, *atlas);
        if (asked.version && *asked.version != version) {
            faults.add(410, "v",
                       in_quotes(*asked.version) + " is no longer made; today's version is " +
                           in_quotes(version));
            Value::Object more;
            if (faults.status() == 410)
                more.emplace_back(
                    "canonical",
                    with_version(canonical_address(asked.mix, *asked.kind, asked.address),
                                 version));
            return problem(request, faults.status(), {}, faults.problems(), std::move(more));
        }
        if (!faults.empty()) return problem(request, faults);

        const Key key = image_key(painted);
        const std::string digest = digest_of(key);
        Answer head = surface_head(asked, digest, version);
        const std::string_view condition = request.header("If-None-Match");
        if (names_any(condition) || names_etag(condition, header_of(head, "ETag"))) {
            set_header(head, "Cache-Status", "sporeprint-images; hit; detail=not-modified");
            return not_modified(request, std::move(head));
        }
        if (const std::optional<Images> kept = images.cache().find(key)) {
            ++counters.image_hits;
            head.body = {(*kept)->files[static_cast<std::size_t>(*asked.kind)]};
            set_header(head, "Cache-Status", "sporeprint-images; hit");
            represent(request, head);
            return head;
        }
        if (request.method == "HEAD") {
            head.has_body = false;
            set_header(head, "Cache-Status", "sporeprint-images; fwd=miss");
            add_common_headers(request, head);
            return head;
        }
        // One flight for the three images of an atlas: its answer holds them all, deliver() hands out the one asked for.
        auto shared = std::make_shared<const PaintParams>(std::move(painted));
        auto run = [this, shared, key, digest](std::stop_token stop, const Observer& observer,
                                               const Parallel& parallel) {
            observer(Step::paint);
            bool hit = false, stored = false;
            const Images set = remember(
                key, [&] { return std::make_shared<const ImageSet>(paint(*shared, parallel)); },
                stop, hit, stored);
            Answer answer;
            answer.headers = {{digest_header, digest}, {"Cache-Status", image_status(hit, stored)}};
            answer.body.assign(set->files.begin(), set->files.end());
            return answer;
        };
        return Job{key, Cost{0, 3 * side * side, 3 * side * side}, std::move(run)};
    }

    // --- Inspection --------------------------------------------------------------------------

    Plan inspect(const Request& request, Faults& faults) {
        if (!faults.empty()) return problem(request, faults);
        auto file = std::make_shared<const std::string>(request.body);
        const std::size_t bytes = file->size();
        auto run = [file](std::stop_token, const Observer& observer, const Parallel&) {
            observer(Step::resolve);
            const Inspection found =
                inspect_glb({reinterpret_cast<const std::uint8_t*>(file->data()), file->size()});
            std::vector<Problem> problems;
            const Target target = split_target(found.canonical, problems);
            const bool ours = found.canonical.empty() ||
                              (problems.empty() && found.canonical.starts_with("/v1/") &&
                               match_route("GET", target.segments).route);
            if (!ours)
                throw InvalidInput(
                    "", "the canonical request in this file is not an address of Sporeprint");
            Value effective =
                parse(found.effective_json.empty() ? "{}" : found.effective_json, problems);
            if (!problems.empty() || !effective.is_object())
                throw InvalidInput("", "the effective parameters in this file are not JSON");
            Value counts = Value::object();
            counts.set("vertices", found.vertices)
                .set("triangles", found.triangles)
                .set("meshes", found.meshes);
            counts.set("materials", found.materials)
                .set("images", found.images)
                .set("bytes", found.bytes);
            Value body = Value::object();
            body.set("generator", found.generator);
            body.set("canonical", found.canonical.empty() ? Value() : Value(found.canonical));
            body.set("effective", std::move(effective));
            body.set("counts", std::move(counts));
            Answer answer;
            answer.headers = {{"Content-Type", "application/json"}, {"Cache-Control", "no-store"}};
            answer.body = {slice_of(dump(body))};
            return answer;
        };
        // Each upload is its own piece of work: a number makes the key, not a hash of up to 64 MB.
        return Job{"inspection " + std::to_string(inspections++), Cost{0, 0, bytes},
                   std::move(run)};
    }

    // --- Delivery ----------------------------------------------------------------------------

    void finish(const Key& key, const Answer& answer) {
        if (answer.status != 200 || !kept_by_key(key)) return;
        auto kept = std::make_shared<Answer>(answer);
        take_header(*kept, "Cache-Status");
        answers.insert(key, std::move(kept));
    }

    Answer deliver(const Request& request, const Answer& shared, Outcome outcome,
                   const Timing& timing) const {
        Answer answer = shared;
        std::string status = take_header(answer, "Cache-Status");
        if (outcome == Outcome::collapsed && !status.ends_with("; hit")) {
            if (status.ends_with("; stored"))
                status.resize(status.size() - std::string_view("; stored").size());
            status += "; collapsed";
        }
        const std::string digest = take_header(answer, digest_header);
        std::vector<Problem> ignored;
        const Target target = split_target(request.target, ignored);
        const Match match = match_route(request.method, target.segments);
        const Endpoint endpoint = match.route ? match.route->endpoint : Endpoint::inspect;

        if (endpoint == Endpoint::surface && !digest.empty()) {
            Faults none;
            const SurfaceRequest asked =
                read_surface(match.captured[0], match.captured[1], target.query, *atlas, none);
            if (!none.empty()) return problem(request, none);
            const Body images_of_atlas = std::move(answer.body);
            answer = surface_head(asked, digest, version_token(asked.mix, *atlas));
            answer.body = {images_of_atlas[static_cast<std::size_t>(*asked.kind)]};
            set_header(answer, "Cache-Status", std::move(status));
        } else if (endpoint != Endpoint::inspect && answer.status == 200) {
            const bool versioned = std::any_of(target.query.begin(), target.query.end(),
                                               [](const auto& pair) { return pair.first == "v"; });
            set_header(answer, "Cache-Control", cache_control(versioned));
            set_header(answer, "Cache-Status", std::move(status));
        }
        std::string spent;
        const std::array<std::pair<const char*, double>, 5> steps = {{{"queue", timing.queue},
                                                                      {"resolve", timing.resolve},
                                                                      {"build", timing.build},
                                                                      {"paint", timing.paint},
                                                                      {"pack", timing.pack}}};
        for (const auto& [step, milliseconds] : steps) {
            if (milliseconds < 0.0) continue;
            if (!spent.empty()) spent += ", ";
            ((spent += step) += ";dur=") += number_text(
                static_cast<double>(static_cast<std::int64_t>(milliseconds * 1000.0 + 0.5)) /
                1000.0);
        }
        if (!spent.empty()) set_header(answer, "Server-Timing", std::move(spent));
        represent(request, answer);
        return answer;
    }
};

Service::Service(std::shared_ptr<const Atlas> atlas, ServiceOptions options)
    : parts_(std::make_unique<Parts>(std::move(atlas), std::move(options))) {}

Service::~Service() = default;

std::variant<Answer, Job> Service::plan(const Request& request) {
    try {
        return parts_->plan(request);
    } catch (...) {
        return problem(request, std::current_exception());
    }
}

void Service::finish(const Key& key, const Answer& answer) { parts_->finish(key, answer); }

Answer Service::deliver(const Request& request, const Answer& shared, Outcome outcome,
                        const Timing& timing) const {
    return parts_->deliver(request, shared, outcome, timing);
}

Answer Service::problem(const Request& request, int status, std::string_view detail,
                        const std::vector<Header>& extra) const {
    Answer answer = parts_->problem(request, status, detail);
    for (const auto& [name, value] : extra) set_header(answer, name, value);
    return answer;
}

Answer Service::problem(const Request& request, std::exception_ptr error) const {
    Answer answer = problem_answer(request, std::move(error));
    parts_->add_common_headers(request, answer);
    return answer;
}

bool Service::self_test() {
    try {
        if (parts_->atlas->entries().empty()) return false;
        MushroomOrder order;
        order.mix = {{parts_->atlas->entries().front().species.id.string(), 1000}};
        order.params.lod = 3;
        order.params.texture_size = {128};
        return size_of(grow_mushroom(order, *parts_->atlas).glb) > 0;
    } catch (...) {
        return false;
    }
}

std::size_t Service::most_body(std::string_view method, std::string_view target) const {
    std::vector<Problem> ignored;
    const Match match =
        match_route(method, split_target(target.substr(0, longest_target), ignored).segments);
    return match.route ? longest_body(*match.route) : 256u << 10;
}

const Counters& Service::counters() const {
    Counters& counters = parts_->counters;
    const CacheStats answers = parts_->answers.stats(), images = parts_->images.cache().stats();
    counters.glb_cache_bytes = answers.bytes;
    counters.glb_cache_entries = answers.entries;
    counters.glb_evictions = answers.evictions;
    counters.image_cache_bytes = images.bytes;
    counters.image_cache_entries = images.entries;
    counters.image_evictions = images.evictions;
    return counters;
}

Answer handle(Service& service, const Request& request) {
    std::variant<Answer, Job> planned = service.plan(request);
    if (Answer* answer = std::get_if<Answer>(&planned)) return std::move(*answer);
    Job& job = std::get<Job>(planned);
    try {
        Stopwatch watch;
        const Answer shared = job.run({}, watch.observer(), in_turn);
        service.finish(job.key, shared);
        return service.deliver(request, shared, Outcome::made, watch.timing());
    } catch (...) {
        return service.problem(request, std::current_exception());
    }
}

}  // namespace sporeprint::api
