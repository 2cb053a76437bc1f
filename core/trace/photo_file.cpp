#include "core/trace/photo_file.h"

#include <algorithm>
#include <utility>

namespace sporeprint::trace {

namespace {

/// Shares of a picture that are transparent if it is cut out.
constexpr double least_transparent = 0.02, most_transparent = 0.98;

constexpr std::uint8_t half_opaque = 128;

bool is_cut_out(const Bytes& alpha) {
    const auto transparent = std::count_if(alpha.begin(), alpha.end(),
                                           [](std::uint8_t value) { return value < half_opaque; });
    const double share = static_cast<double>(transparent) /
                         static_cast<double>(std::max<std::size_t>(alpha.size(), 1));
    return share >= least_transparent && share <= most_transparent;
}

bool reaches_border(const LayeredPicture& of) {
    const auto width = static_cast<std::size_t>(of.picture.width),
               height = static_cast<std::size_t>(of.picture.height);
    const auto is_opaque = [&](std::size_t x, std::size_t y) {
        return of.alpha[y * width + x] >= half_opaque;
    };
    for (std::size_t x = 0; x < width; ++x)
        if (is_opaque(x, 0) || is_opaque(x, height - 1)) return true;
    for (std::size_t y = 0; y < height; ++y)
        if (is_opaque(0, y) || is_opaque(width - 1, y)) return true;
    return false;
}

/// Returns a picture with a border of transparent white paper round it.
LayeredPicture bordered(const LayeredPicture& of, int border) {
    LayeredPicture found;
    found.picture.width = of.picture.width + 2 * border;
    found.picture.height = of.picture.height + 2 * border;
    const auto width = static_cast<std::size_t>(found.picture.width),
               height = static_cast<std::size_t>(found.picture.height),
               columns = static_cast<std::size_t>(of.picture.width),
               edge = static_cast<std::size_t>(border);
    found.picture.rgb.assign(3 * width * height, 255);
    found.alpha.assign(width * height, 0);
    for (std::size_t y = 0; y < static_cast<std::size_t>(of.picture.height); ++y) {
        const std::size_t from = y * columns, to = (y + edge) * width + edge;
        std::copy_n(&of.picture.rgb[3 * from], 3 * columns, &found.picture.rgb[3 * to]);
        std::copy_n(&of.alpha[from], columns, &found.alpha[to]);
    }
    return found;
}

}  // namespace

PhotoFile decoded_photo(std::span<const std::uint8_t> file, const std::string& path) {
    // A JPEG file is decoded at up to twice the size that is needed, and then made smaller by means of areas.
    LayeredPicture from = decoded_layers(file, 2 * decoded_side - 1, path);
    if (!is_cut_out(from.alpha)) return {reduced(from.picture, decoded_side), std::nullopt};
    // A border is 2 % of the longest side, at each of its ends.
    const bool has_border = reaches_border(from);
    const int side = has_border ? decoded_side * 24 / 25 : decoded_side;
    LayeredPicture small{reduced(from.picture, side), {}};
    from.picture.rgb = {};
    Picture grey{from.picture.width, from.picture.height, {}};
    grey.rgb.reserve(3 * from.alpha.size());
    for (const std::uint8_t alpha : from.alpha) grey.rgb.insert(grey.rgb.end(), 3, alpha);
    const Picture alpha = reduced(grey, side);
    small.alpha.reserve(alpha.rgb.size() / 3);
    for (std::size_t i = 0; i < alpha.rgb.size(); i += 3) small.alpha.push_back(alpha.rgb[i]);
    if (has_border)
        small = bordered(small, 2 + std::max(small.picture.width, small.picture.height) / 50);
    PhotoFile found{std::move(small.picture), Mask(0, 0)};
    found.cut_out = Mask(found.picture.width, found.picture.height);
    for (std::size_t i = 0; i < found.cut_out->inside.size(); ++i)
        found.cut_out->inside[i] = small.alpha[i] >= half_opaque ? 1 : 0;
    return found;
}

}  // namespace sporeprint::trace
