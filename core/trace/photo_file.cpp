#include "core/trace/photo_file.h"

#include <algorithm>

namespace sporeprint::trace {

PhotoFile decoded_photo(std::span<const std::uint8_t> file, const std::string& path) {
    const LayeredPicture from = decoded_layers(file, decoded_side, path);
    constexpr double least = 0.02, most = 0.98;
    PhotoFile found{reduced(from.picture, decoded_side), std::nullopt};
    std::size_t transparent = 0;
    for (const std::uint8_t alpha : from.alpha) transparent += alpha < 128 ? 1 : 0;
    const double share = static_cast<double>(transparent) /
                         static_cast<double>(std::max<std::size_t>(from.alpha.size(), 1));
    if (share < least || share > most) return found;
    Picture grey{from.picture.width, from.picture.height, Bytes(from.picture.rgb.size())};
    for (std::size_t i = 0; i < grey.rgb.size(); ++i) grey.rgb[i] = from.alpha[i / 3];
    const Picture alpha = reduced(grey, decoded_side);
    found.cut_out = Mask(alpha.width, alpha.height);
    for (std::size_t i = 0; i < found.cut_out->inside.size(); ++i)
        found.cut_out->inside[i] = alpha.rgb[3 * i] >= 128 ? 1 : 0;
    return found;
}

}  // namespace sporeprint::trace
