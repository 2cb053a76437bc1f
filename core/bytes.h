// Immutable bytes that are shared and never copied: the content of GLB files and images.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sporeprint {

using Bytes = std::vector<std::uint8_t>;

/// A range of shared immutable bytes.
struct Slice {
    std::shared_ptr<const Bytes> owner;
    std::size_t offset = 0;
    std::size_t size = 0;

    Slice() = default;
    explicit Slice(std::shared_ptr<const Bytes> bytes)
        : owner(std::move(bytes)), size(owner ? owner->size() : 0) {}
    Slice(std::shared_ptr<const Bytes> bytes, std::size_t at, std::size_t length)
        : owner(std::move(bytes)), offset(at), size(length) {}

    [[nodiscard]] const std::uint8_t* data() const {
        return owner ? owner->data() + offset : nullptr;
    }
};

/// A body is the concatenation of its slices.
using Body = std::vector<Slice>;

[[nodiscard]] inline std::size_t size_of(const Body& body) {
    std::size_t total = 0;
    for (const Slice& slice : body) total += slice.size;
    return total;
}

/// Returns one slice that owns a copy of `text`.
[[nodiscard]] inline Slice slice_of(const std::string& text) {
    return Slice(std::make_shared<const Bytes>(text.begin(), text.end()));
}

}  // namespace sporeprint
