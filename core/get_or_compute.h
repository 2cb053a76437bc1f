// Memory lent from above: what is expensive to make is made once per key.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace sporeprint {

/// Returns what it kept under `key`, or what `make` makes now.
template <class T>
using Remember = std::function<std::shared_ptr<const T>(
    const std::string& key, const std::function<std::shared_ptr<const T>()>& make)>;

/// Remembers nothing.
template <class T>
std::shared_ptr<const T> make_anew(const std::string& /*key*/,
                                   const std::function<std::shared_ptr<const T>()>& make) {
    return make();
}

}  // namespace sporeprint
