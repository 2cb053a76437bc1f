#include "api/products/context.h"

#include <utility>

#include "core/params/messages.h"

namespace sporeprint::api {

std::shared_ptr<Context> with_guests(const Context& context, std::vector<AtlasGuest> guests) {
    auto own = std::make_shared<Context>(context);
    own->atlas = std::make_shared<const Atlas>(context.atlas, std::move(guests));
    own->has_guests = true;
    return own;
}

void refuse_query(const Target& target, ValidationErrors& errors) {
    for (const auto& pair : target.query)
        errors.add(400, printable(pair.first), "unknown parameter; this route takes none");
}

}  // namespace sporeprint::api
