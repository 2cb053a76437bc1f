// A cache interface that callers of core provide: expensive results are computed once per key.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace sporeprint {

/// Returns the value cached under `key`, or the result of `make`.
template <class T>
using GetOrCompute = std::function<std::shared_ptr<const T>(
    const std::string& key, const std::function<std::shared_ptr<const T>()>& make)>;

/// Computes the value without caching.
template <class T>
std::shared_ptr<const T> uncached(const std::string& /*key*/,
                                  const std::function<std::shared_ptr<const T>()>& make) {
    return make();
}

}  // namespace sporeprint
