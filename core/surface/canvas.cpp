#include "core/surface/canvas.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "core/math/elementary.h"
#include "core/surface/charts.h"
#include "core/surface/codecs.h"

namespace sporeprint {
namespace {

// Pool of the memory of finished paintings, for at most four of the default size.
class CanvasPool {
  public:
    Bytes acquire(std::size_t size) {
        Bytes found;
        {
            const std::lock_guard lock(mutex_);
            if (!free_.empty()) {
                found = std::move(free_.back());
                free_.pop_back();
            }
        }
        found.resize(size);
        return found;
    }
    void release(Bytes canvas) {
        if (canvas.capacity() > largest_canvas) return;
        const std::lock_guard lock(mutex_);
        if (free_.size() < most_canvases) free_.push_back(std::move(canvas));
    }

  private:
    static constexpr std::size_t largest_canvas = 10U << 20U;
    static constexpr std::size_t most_canvases = 4;
    std::mutex mutex_;
    std::vector<Bytes> free_;
};

CanvasPool& canvas_pool() {
    static CanvasPool shared;
    return shared;
}

}  // namespace

Canvas::Canvas(int side)
    : side_(side),
      size_(3 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side)),
      bytes_(canvas_pool().acquire(3 * size_)) {}

Canvas::~Canvas() { canvas_pool().release(std::move(bytes_)); }

namespace {

/// How an image is encoded.
struct Quality {
    int jpeg;
    Chroma chroma;
    int webp;
};

/// Qualities by ImageKind. WebP always halves the resolution of chroma, of which normals have most;
/// roughness and occlusion stand lower qualities than colours.
constexpr std::array<Quality, 3> qualities = {
    {{88, Chroma::halved, 75}, {89, Chroma::full, 68}, {88, Chroma::halved, 50}}};

/// Returns an image with alpha as a file.
Bytes with_alpha(std::span<const std::uint8_t> rgb, std::span<const std::uint8_t> alpha, int width,
                 int height, ImageFormat format, int quality) {
    Bytes rgba(4 * alpha.size());
    for (std::size_t i = 0; i < alpha.size(); ++i) {
        std::copy_n(&rgb[3 * i], 3, &rgba[4 * i]);
        rgba[4 * i + 3] = alpha[i];
    }
    return format == ImageFormat::webp ? webp_with_alpha(rgba, width, height, quality)
                                       : png(rgba, width, height);
}

/// alpha  of the base colour; empty for an opaque one
ImageSet encoded(const std::array<std::span<const std::uint8_t>, 3>& rgb,
                 std::span<const std::uint8_t> alpha, int width, int height, ImageFormat format,
                 const Parallel& parallel) {
    ImageSet out;
    out.format = format;
    out.has_alpha = !alpha.empty();
    const auto encode = [&](ImageKind kind) {
        const auto i = static_cast<std::size_t>(kind);
        const Quality& quality = qualities[i];
        Bytes file;
        if (out.has_alpha && kind == ImageKind::base_color)
            file = with_alpha(rgb[i], alpha, width, height, format, quality.webp);
        else if (format == ImageFormat::webp)
            file = webp(rgb[i], width, height, quality.webp);
        else
            file = jpeg(rgb[i], width, height, quality.jpeg, quality.chroma);
        out.files[i] = Slice(std::make_shared<const Bytes>(std::move(file)));
    };
    // The image that takes longest first.
    const std::array<std::function<void()>, 3> pieces = {[&] { encode(ImageKind::normal); },
                                                         [&] { encode(ImageKind::base_color); },
                                                         [&] { encode(ImageKind::orm); }};
    parallel(pieces);
    return out;
}

}  // namespace

ImageSet encoded(const std::array<std::span<const std::uint8_t>, 3>& rgb, int width, int height,
                 ImageFormat format, const Parallel& parallel) {
    return encoded(rgb, {}, width, height, format, parallel);
}

ImageSet encoded(const Canvas& canvas, ImageFormat format, const Parallel& parallel) {
    std::array<std::span<const std::uint8_t>, 3> rgb;
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = {canvas.image(i), canvas.size()};
    return encoded(rgb, canvas.side(), canvas.side(), format, parallel);
}

ImageSet encoded(const RawImages& images, ImageFormat format, const Parallel& parallel) {
    const std::array<std::span<const std::uint8_t>, 3> rgb = {images.rgb[0], images.rgb[1],
                                                              images.rgb[2]};
    const bool is_png = format == ImageFormat::png;
    Bytes opaque;
    std::span<const std::uint8_t> alpha;
    if (format != ImageFormat::jpg) alpha = images.alpha;
    if (is_png && alpha.empty())
        alpha = opaque = Bytes(images.rgb[0].size() / 3, std::uint8_t{255});
    return encoded(rgb, alpha, images.side, images.side, is_png ? ImageFormat::jpg : format,
                   parallel);
}

RawImages raw(const Canvas& canvas) {
    RawImages out;
    out.side = canvas.side();
    for (std::size_t i = 0; i < 3; ++i)
        out.rgb[i].assign(canvas.image(i), canvas.image(i) + canvas.size());
    return out;
}

std::array<Frame, part_count> chart_frames(int side) {
    std::array<Frame, part_count> frames;
    for (std::size_t i = 0; i < part_count; ++i) {
        const Chart& chart = swept_charts[i];
        Frame& frame = frames[i];
        frame.x = static_cast<int>(chart.u * side);
        frame.y = static_cast<int>(chart.v * side);
        frame.width = static_cast<int>(chart.width * side);
        frame.height = static_cast<int>(chart.height * side);
        frame.inset = static_cast<float>(chart.inset);
    }
    return frames;
}

const std::array<float, 256>& linear_table() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> out{};
        for (int i = 0; i < 256; ++i)
            out[static_cast<std::size_t>(i)] = static_cast<float>(srgb_to_linear(i / 255.0));
        return out;
    }();
    return table;
}

}  // namespace sporeprint
