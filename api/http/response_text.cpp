#include "api/http/response_text.h"

#include <vector>

#include "core/problems.h"

namespace sporeprint::api {

std::string text_of(const Body& body) {
    std::string text;
    for (const Slice& slice : body)
        text.append(reinterpret_cast<const char*>(slice.data()), slice.size);
    return text;
}

Value problem_of(const Response& response) {
    std::vector<Problem> malformed;
    Value problem = parse(text_of(response.body), malformed);
    return malformed.empty() ? problem : Value(response.status);
}

}  // namespace sporeprint::api
