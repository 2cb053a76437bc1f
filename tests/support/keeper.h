// Execution contexts for tests: one with an image cache, one that runs all tasks in parallel.
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

/// An execution context that caches images by their key and counts lookups.
struct Keeper {
    std::map<std::string, std::shared_ptr<const ImageSet>> cached;
    int lookups = 0, made = 0;
    ExecutionContext execution;

    Keeper() {
        execution.caches.images = [this](const std::string& key, const auto& make) {
            ++lookups;
            auto& images = cached[key];
            if (!images) {
                images = make();
                ++made;
            }
            return images;
        };
    }
};

/// Returns true if a slice of the body shares memory with `slice`.
inline bool shares_bytes(const Body& body, const Slice& slice) {
    return std::any_of(body.begin(), body.end(),
                       [&](const Slice& s) { return s.owner == slice.owner; });
}

/// Runs each task on a thread of its own.
inline void in_threads(std::span<const std::function<void()>> tasks) {
    std::vector<std::jthread> threads;
    for (const auto& task : tasks) threads.emplace_back(task);
}

}  // namespace sporeprint
