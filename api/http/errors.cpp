#include "api/http/errors.h"

#include <algorithm>
#include <array>

#include "core/colony/colony_spec.h"
#include "core/grow/set.h"
#include "core/individual/mushroom_spec.h"
#include "core/params/query.h"
#include "core/plant/tree_spec.h"
#include "core/trace/trace_spec.h"

namespace sporeprint::api {

namespace {

constexpr std::array<ProblemType, 24> types = {{
    {400, "invalid-parameters", "Invalid parameters",
     "Something is malformed, unknown, repeated or out of range; every culprit is named.",
     "Correct the parameters that `errors` names; each says what is allowed."},
    {401, "unauthorized", "Unauthorized",
     "The token is missing, unknown, expired or revoked, or its owner is disabled.",
     "Send 'Authorization: Bearer spk_...' with a token of the owner."},
    {403, "forbidden", "Forbidden",
     "The signature of the address is missing, wrong or expired, or the token does not allow this.",
     "Ask whoever gave you the address or the token for a new one; a signature covers every "
     "character "
     "of an address."},
    {404, "not-found", "Not found", "There is no such route, species or preset.",
     "Take an address from the lists that /v1 links to; `detail` names the closest one."},
    {405, "method-not-allowed", "Method not allowed",
     "The route does not answer this method; Allow names those it does.",
     "Use one of the methods in the Allow header."},
    {408, "request-timeout", "Request timeout", "The request did not arrive in time.",
     "Send the request again, head and body without long pauses."},
    {409, "name-taken", "Name taken", "The name is in use, or was that of what was withdrawn.",
     "Choose another name; names are never given again."},
    {410, "superseded", "Superseded",
     "The version asked for is no longer made; `canonical` is the address of today's.",
     "Go to the address in `canonical`, or leave out `v` for whatever is made today."},
    {410, "withdrawn", "Withdrawn", "The owner has withdrawn it, and its bytes are gone.",
     "Ask the owner; nothing else is at this address."},
    {411, "length-required", "Length required", "Send Content-Length instead of Transfer-Encoding.",
     "Send the body with Content-Length, not in chunks."},
    {412, "precondition-failed", "Precondition failed",
     "If-Match names none of the resource's entity tags, or If-None-Match of a POST names one.",
     "Send the request without the condition, or with today's ETag. Of a draft, `current` is that "
     "ETag "
     "and `changed` names what differs from what you sent."},
    {413, "body-too-large", "Body too large", "The body is longer than this route takes.",
     "Send a smaller body; `detail` says how many bytes are taken."},
    {414, "uri-too-long", "URI too long", "The address is longer than 4096 bytes.",
     "Leave out parameters that have their default, or POST them in a body."},
    {415, "unsupported-media-type", "Unsupported media type",
     "The body is of a type or encoding that this route does not take.",
     "Send the Content-Type that `detail` names, and no Content-Encoding."},
    {416, "range-not-satisfiable", "Range not satisfiable",
     "The body has no byte in this range; Content-Range says how many bytes it has.",
     "Ask for a range within the length in Content-Range, or without Range."},
    {422, "impossible", "Impossible", "The request is well-formed, but no such thing can be made.",
     "Change the parameters that `errors` names: each value is allowed, but not all of them at "
     "once."},
    {428, "precondition-required", "Precondition required",
     "A draft is changed only by whoever has seen it: If-Match is missing.",
     "Send If-Match with the ETag of the draft that you have read, or '*' for any."},
    {429, "too-many-requests", "Too many requests",
     "This client asks for too much; Retry-After says when to come back.",
     "Wait as many seconds as Retry-After says."},
    {431, "header-too-large", "Header too large", "The header has too many or too long lines.",
     "Send fewer or shorter header lines; cookies are not needed here."},
    {500, "internal-error", "Internal error",
     "The fault is ours; the log holds the details under the request id.",
     "Tell the operator the `instance` of the answer: it is the request id."},
    {501, "not-implemented", "Not implemented", "The method is not known.",
     "Use GET, HEAD, POST, PUT, DELETE or OPTIONS."},
    {503, "unavailable", "Unavailable",
     "The service is saturated or shutting down; Retry-After says when to come back.",
     "Wait as many seconds as Retry-After says, then try again."},
    {504, "timeout", "Timeout", "The work took longer than a request may.",
     "Ask for less: a higher lod, a smaller texture_size or fewer individuals."},
    {507, "quota-exceeded", "Quota exceeded", "The owner has as much as is allowed.",
     "Purge what is no longer needed, or ask the operator for more; `detail` says how much there "
     "is."},
}};

/// If several statuses apply, the first of these is the status of the response.
constexpr std::array<int, 4> strongest_first = {404, 400, 422, 410};

std::string count_of(std::span<const Problem> problems, int status) {
    const std::size_t count = problems.size();
    const char* what = status == 422   ? "impossible"
                       : status == 404 ? "not found or invalid"
                                       : "invalid";
    return std::to_string(count) + (count == 1 ? " parameter is " : " parameters are ") + what;
}

template <class T>
bool is_field_of(std::string_view key) {
    return key_count<T>(key) > 0;  // also those of inlined members
}

}  // namespace

std::span<const ProblemType> problem_types() { return types; }

const ProblemType& problem_type(int status) {
    const auto row = std::find_if(types.begin(), types.end(),
                                  [&](const ProblemType& type) { return type.status == status; });
    return row != types.end() ? *row : problem_type(500);
}

void ValidationErrors::add(int status, std::string parameter, std::string detail) {
    if (problems_.size() >= most_problems) return;
    problems_.push_back({std::move(parameter), std::move(detail)});
    statuses_.push_back(status);
}

void ValidationErrors::add(int status, const std::vector<Problem>& problems) {
    for (const Problem& problem : problems) add(status, problem.path, problem.message);
}

void ValidationErrors::point_into_body() {
    for (Problem& problem : problems_) {
        if (problem.path.empty() || problem.path.starts_with('/')) continue;
        std::replace(problem.path.begin(), problem.path.end(), '.', '/');
        problem.path.insert(problem.path.begin(), '/');
    }
}

bool ValidationErrors::any(int status) const {
    return std::find(statuses_.begin(), statuses_.end(), status) != statuses_.end();
}

int ValidationErrors::status() const {
    for (const int status : strongest_first)
        if (any(status)) return status;
    return statuses_.empty() ? 200 : statuses_.front();
}

Response problem_response(const Request& request, int status, std::string_view detail,
                          std::span<const Problem> problems, const Value::Object& more,
                          std::string_view base) {
    const ProblemType& type = problem_type(status);
    Value body = Value::object();
    body.set("type", std::string(base) + "/problems/" + type.slug);
    body.set("title", type.title);
    body.set("status", status);
    // What is wrong with a whole body has no parameter to be counted.
    const bool is_whole = problems.size() == 1 && problems[0].path.empty();
    body.set("detail", !detail.empty()    ? std::string(detail)
                       : problems.empty() ? std::string(type.meaning)
                       : is_whole         ? problems[0].message
                                          : count_of(problems, status));
    body.set("instance", request.id);
    if (!problems.empty()) {
        Value errors = Value::array();
        for (const Problem& problem : problems) {
            Value error = Value::object();
            error.set("parameter", problem.path);
            error.set("detail", problem.message);
            errors.push(std::move(error));
        }
        body.set("errors", std::move(errors));
    }
    for (const auto& [key, value] : more) body.set(key, value);
    Response response;
    response.status = status;
    response.headers = {{"Content-Type", "application/problem+json"},
                        {"Cache-Control", "no-store"}};
    response.body = {slice_of(dump(body))};
    return response;
}

std::string parameter_name(std::string_view pointer, bool posted) {
    if (!pointer.starts_with('/'))
        return pointer.empty() && posted ? std::string() : std::string(pointer);
    const std::string_view first = pointer.substr(1, pointer.find('/', 1) - 1);
    const bool of_params = is_field_of<MushroomParams>(first) || is_field_of<ColonyParams>(first) ||
                           is_field_of<TreeParams>(first) || is_field_of<SetParams>(first) ||
                           is_field_of<trace::TraceSpec>(first) || first == "world" ||
                           first == "bbox";
    if (posted)
        return first == "model" || first == "mix" || first == "arcs" || of_params
                   ? std::string(pointer)
                   : "/model" + std::string(pointer);
    return of_params ? query_name(pointer) : "mix";
}

namespace {

bool has_body(const Request& request) {
    return request.method == "POST" || request.method == "PUT";
}

}  // namespace

Response problem_response(const Request& request, std::exception_ptr error, std::string_view base) {
    const auto named = [&](const InvalidInput& input, int status) {
        std::vector<Problem> problems = input.problems();
        for (Problem& problem : problems)
            problem.path = parameter_name(problem.path, has_body(request));
        return problem_response(request, status, {}, problems, {}, base);
    };
    try {
        std::rethrow_exception(error);
    } catch (const Impossible& impossible) {
        return named(impossible, 422);
    } catch (const InvalidInput& invalid) {
        return named(invalid, 400);
    } catch (const Unavailable&) {
        Response response = problem_response(
            request, 503, "the database of the library cannot be used at the moment", {}, {}, base);
        response.headers.emplace_back("Retry-After", "5");
        return response;
    } catch (const Cancelled&) {
        Response response =
            problem_response(request, 503, "the work was stopped before it was done", {}, {}, base);
        response.headers.emplace_back("Retry-After", "1");
        return response;
    } catch (...) {
        return problem_response(request, 500, {}, {}, {}, base);
    }
}

}  // namespace sporeprint::api
