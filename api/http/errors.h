// What goes wrong as RFC 9457 problems: one table of statuses, one table of exceptions.
#pragma once

#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/http/message.h"
#include "core/params/value.h"
#include "core/problems.h"

namespace sporeprint::api {

/// One row of the table: what a status is called in `type` and `title`.
struct ProblemType {
    int status;
    const char* slug;  ///< "/problems/<slug>"
    const char* title;
    const char* meaning;  ///< one sentence for the documents
    const char* remedy;   ///< what the client can do about it
};

[[nodiscard]] std::span<const ProblemType> problem_types();

/// The row of a status; that of 500 when there is none.
[[nodiscard]] const ProblemType& problem_type(int status);

/// Problems found while a request is understood. Each says by which status it counts; the answer's is the strongest of
/// them: 404, then 400, 422, 410.
class ValidationErrors {
  public:
    void add(int status, std::string parameter, std::string detail);
    void add(int status, const std::vector<Problem>& problems);

    [[nodiscard]] bool empty() const { return problems_.empty(); }
    [[nodiscard]] bool any(int status) const;
    [[nodiscard]] int status() const;
    [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

  private:
    std::vector<Problem> problems_;
    std::vector<int> statuses_;
};

/// A problem as an answer: `Cache-Control: no-store`, no ETag, body as in the contract.
///
/// detail    a sentence; empty for "n parameters are invalid"
/// problems  become `errors`, absent when empty; `path` is what the answer calls `parameter`
/// more      further members of the body, such as `canonical`
/// base      path under which clients see the service
[[nodiscard]] Response problem_response(const Request& request, int status, std::string_view detail,
                                        std::span<const Problem> problems = {},
                                        const Value::Object& more = {}, std::string_view base = {});

/// The one table from what is thrown below to status and words. InvalidInput 400, Impossible 422, GenerationError 500,
/// Cancelled 503, anything else 500 without detail. Paths of problems are made what the client wrote: query names for GET,
/// pointers into the body for POST.
[[nodiscard]] Response problem_response(const Request& request, std::exception_ptr error,
                                        std::string_view base = {});

/// What the client calls the parameter at a JSON pointer that core reports.
///
/// posted  the request brought a body: the answer is a pointer into it; otherwise a query name
[[nodiscard]] std::string parameter_name(std::string_view pointer, bool posted);

}  // namespace sporeprint::api
