// Images before and after encoding, and the function that runs independent tasks in parallel.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>

#include "core/bytes.h"

namespace sporeprint {

enum class ImageKind { base_color, normal, orm };

constexpr const char* name(ImageKind kind) {
    switch (kind) {
        case ImageKind::base_color:
            return "base_color";
        case ImageKind::normal:
            return "normal";
        case ImageKind::orm:
            return "orm";
    }
    return nullptr;
}

/// The format of encoded images. PNG is that of a base colour with alpha beside JPEG images.
enum class ImageFormat { jpg, webp, png };

constexpr const char* name(ImageFormat format) {
    switch (format) {
        case ImageFormat::jpg:
            return "jpg";
        case ImageFormat::webp:
            return "webp";
        case ImageFormat::png:
            return "png";
    }
    return nullptr;
}

/// Returns the media type of a format.
constexpr const char* media_type(ImageFormat format) {
    switch (format) {
        case ImageFormat::jpg:
            break;
        case ImageFormat::webp:
            return "image/webp";
        case ImageFormat::png:
            return "image/png";
    }
    return "image/jpeg";
}

/// The three images before encoding, indexed by ImageKind: `side` rows of `side` RGB texels each.
struct RawImages {
    int side = 0;
    std::array<Bytes, 3> rgb;
    Bytes alpha;  ///< of the base colour, a byte for each texel; empty for an opaque one
    [[nodiscard]] std::size_t bytes() const {
        return rgb[0].size() + rgb[1].size() + rgb[2].size() + alpha.size();
    }
};

/// Three encoded files, indexed by ImageKind.
struct ImageSet {
    std::array<Slice, 3> files;
    ImageFormat format = ImageFormat::jpg;  ///< jpg or webp
    bool has_alpha = false;                 ///< of the base colour
    [[nodiscard]] std::size_t bytes() const {
        return files[0].size + files[1].size + files[2].size;
    }
    /// Returns the format of one of the files: JPEG has no alpha.
    [[nodiscard]] ImageFormat format_of(ImageKind kind) const {
        return has_alpha && kind == ImageKind::base_color && format == ImageFormat::jpg
                   ? ImageFormat::png
                   : format;
    }
};

/// A function that runs independent tasks, possibly in parallel, returns when all are done and
/// rethrows the exception of a failed one. The caller of core supplies it, since core has no
/// threads of its own.
using Parallel = std::function<void(std::span<const std::function<void()>>)>;

/// Runs the tasks one after another.
inline void in_turn(std::span<const std::function<void()>> tasks) {
    for (const std::function<void()>& task : tasks) task();
}

}  // namespace sporeprint
