// Errors as RFC 9457 problems: one table of statuses, one table of exceptions.
#pragma once

#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "api/http/message.h"
#include "core/params/value.h"
#include "core/problems.h"

namespace sporeprint::api {

/// One row of the table: the names of a status in `type` and `title`.
struct ProblemType {
    int status;
    const char* slug;  ///< "/problems/<slug>"
    const char* title;
    const char* meaning;  ///< one sentence, for the documentation
    const char* remedy;   ///< what the client can do about it
};

[[nodiscard]] std::span<const ProblemType> problem_types();

/// Returns the row of a status; that of 500 if there is none.
[[nodiscard]] const ProblemType& problem_type(int status);

/// Thrown if something that the service depends on, such as a database, cannot be used at the moment: 503. The text
/// is for the operator's log; clients do not see it.
class Unavailable : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The problems found while a request is parsed. Each has a status; the status of the response is
/// the first of 404, 400, 422, 410 that occurs.
class ValidationErrors {
  public:
    void add(int status, std::string parameter, std::string detail);
    void add(int status, const std::vector<Problem>& problems);

    /// Turns names of parameters into pointers into a body: "stand.kinds" into "/stand/kinds". Pointers stay.
    void point_into_body();

    [[nodiscard]] bool empty() const { return problems_.empty(); }
    [[nodiscard]] bool any(int status) const;
    [[nodiscard]] int status() const;
    [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

  private:
    std::vector<Problem> problems_;
    std::vector<int> statuses_;
};

/// Returns a problem as a response: `Cache-Control: no-store`, no ETag, a JSON body.
///
/// detail    a sentence; empty for "n parameters are invalid"
/// problems  listed as `errors`, which is absent if there are none; `path` becomes `parameter`
/// more      further members of the body, such as `canonical`
/// base      path under which clients see the service
[[nodiscard]] Response problem_response(const Request& request, int status, std::string_view detail,
                                        std::span<const Problem> problems = {},
                                        const Value::Object& more = {}, std::string_view base = {});

/// Maps an exception to a problem: InvalidInput 400, Impossible 422, GenerationError 500, Cancelled
/// 503, anything else 500 without detail. Paths of problems are converted to the notation of the
/// client: names of query parameters for GET, pointers into the body for POST.
[[nodiscard]] Response problem_response(const Request& request, std::exception_ptr error,
                                        std::string_view base = {});

/// Returns the client's name of the parameter at a JSON pointer that core reports.
///
/// posted  true if the request has a body: the result is a pointer into it; otherwise it is the
///         name of a query parameter
[[nodiscard]] std::string parameter_name(std::string_view pointer, bool posted);

}  // namespace sporeprint::api
