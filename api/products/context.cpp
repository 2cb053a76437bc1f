#include "api/products/context.h"

#include "core/params/messages.h"

namespace sporeprint::api {

void refuse_query(const Target& target, ValidationErrors& errors) {
    for (const auto& pair : target.query)
        errors.add(400, printable(pair.first), "unknown parameter; this route takes none");
}

}  // namespace sporeprint::api
