// Workshops for tests: one that keeps images by their key, one that does all pieces of work at once.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/bytes.h"
#include "core/grow/execution_context.h"

namespace sporeprint {

/// A workshop that keeps images by their key.
struct Keeper {
    std::map<std::string, std::shared_ptr<const ImageSet>> cached;
    int lookups = 0, made = 0;
    ExecutionContext execution;

    Keeper() {
        execution.caches.images = [this](const std::string& key, const auto& make) {
            ++lookups;
            auto& place = cached[key];
            if (!place) {
                place = make();
                ++made;
            }
            return place;
        };
    }
};

inline bool shares_bytes(const Body& body, const Slice& slice) {
    return std::any_of(body.begin(), body.end(),
                       [&](const Slice& s) { return s.owner == slice.owner; });
}

/// A thread for every piece of work.
inline void in_threads(std::span<const std::function<void()>> pieces) {
    std::vector<std::jthread> hands;
    for (const auto& piece : pieces) hands.emplace_back(piece);
}

}  // namespace sporeprint
