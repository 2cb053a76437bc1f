#include "api/http.h"

#include <algorithm>

#include "api/text.h"

namespace sporeprint::api {

std::string_view Request::header(std::string_view name) const {
    for (const auto& [key, value] : headers)
        if (same_word(key, name)) return value;
    return {};
}

}  // namespace sporeprint::api
