#include "core/trace/photo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace sporeprint::trace {

namespace {

/// A stretch of pixels of the original, and the share of each that a pixel of the copy covers.
struct Cover {
    int first = 0;
    std::vector<double> shares;  // their sum is 1
};

std::vector<Cover> covers(int from, int to) {
    std::vector<Cover> found(static_cast<std::size_t>(to));
    const double step = static_cast<double>(from) / to;
    for (int i = 0; i < to; ++i) {
        Cover& cover = found[static_cast<std::size_t>(i)];
        const double begin = i * step, end = std::min((i + 1) * step, static_cast<double>(from));
        cover.first = static_cast<int>(std::floor(begin));
        for (int k = cover.first; k < end && k < from; ++k)
            cover.shares.push_back((std::min(end, k + 1.0) - std::max(begin, k * 1.0)) / step);
    }
    return found;
}

/// Gives a value to all pixels of a row or column that are within a reach of one that has it.
///
/// first, step, count  the pixels of the row or column
void spread(Mask& mask, std::size_t first, std::size_t step, int count, std::uint8_t value,
            int reach) {
    const auto pixel = [&](int i) -> std::uint8_t& {
        return mask.inside[first + static_cast<std::size_t>(i) * step];
    };
    // Beyond both ends are zeros.
    int free_from = value == 0 ? reach : 0;
    for (int i = 0; i < count; ++i) {
        if (pixel(i) != value) continue;
        for (int k = std::max(free_from, i - reach); k < i; ++k) pixel(k) = value;
        int last = i;
        while (last + 1 < count && pixel(last + 1) == value) ++last;
        i = std::min(last + reach, count - 1);
        int next = last + 1;
        for (; next <= i; ++next) {
            // Pixels that have the value by themselves carry it on.
            if (pixel(next) == value) i = std::min(next + reach, count - 1);
            pixel(next) = value;
        }
        free_from = next;
    }
    if (value != 0) return;
    for (int i = 0; i < std::min(reach, count); ++i) pixel(i) = pixel(count - 1 - i) = 0;
}

/// Marks all pixels that hang together with those of a list and have a value in a mask: row by row, each time all
/// that hang together in a row.
///
/// returns  their number without those of the list
std::size_t flood(const Mask& mask, bool value, std::vector<std::array<int, 2>> open,
                  Mask& reached) {
    std::size_t count = 0;
    const auto is_new_at = [&](std::size_t pixel) {
        return (mask.inside[pixel] != 0) == value && reached.inside[pixel] == 0;
    };
    while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        const std::size_t row = mask.index(0, y);
        const auto mark = [&](std::size_t pixel) {
            const bool is_new = is_new_at(pixel);
            if (is_new) {
                reached.inside[pixel] = 1;
                ++count;
            }
            return is_new;
        };
        int left = x, right = x;
        while (left > 0 && mark(row + static_cast<std::size_t>(left - 1))) --left;
        while (right + 1 < mask.width && mark(row + static_cast<std::size_t>(right + 1))) ++right;
        for (const int v : {y - 1, y + 1}) {
            if (v < 0 || v >= mask.height) continue;
            const std::size_t beside_row = mask.index(0, v);
            bool was_new = false;
            for (int u = left; u <= right; ++u) {
                const std::size_t pixel = beside_row + static_cast<std::size_t>(u);
                const bool is_new = is_new_at(pixel);
                if (is_new && !was_new) {
                    mark(pixel);
                    open.push_back({u, v});
                }
                was_new = is_new;
            }
        }
    }
    return count;
}

}  // namespace

PictureSize reduced_size(int width, int height, int side) {
    const int longest = std::max(width, height);
    if (longest <= side) return {width, height};
    const auto scaled = [&](int length) {
        return std::max(1, (2 * length * side + longest) / (2 * longest));
    };
    return {scaled(width), scaled(height)};
}

Picture reduced(const Picture& photo, int side) {
    if (std::max(photo.width, photo.height) <= side) return photo;
    const PictureSize size = reduced_size(photo.width, photo.height, side);
    Picture copy{size.width, size.height, {}};
    const std::vector<Cover> columns = covers(photo.width, copy.width),
                             rows = covers(photo.height, copy.height);
    copy.rgb.reserve(3 * columns.size() * rows.size());
    std::vector<double> line(3 * columns.size());
    for (const Cover& row : rows) {
        std::fill(line.begin(), line.end(), 0.0);
        for (std::size_t k = 0; k < row.shares.size(); ++k) {
            const std::uint8_t* from = &photo.rgb[3 * (static_cast<std::size_t>(row.first) + k) *
                                                  static_cast<std::size_t>(photo.width)];
            for (std::size_t x = 0; x < columns.size(); ++x)
                for (std::size_t i = 0; i < columns[x].shares.size(); ++i) {
                    const double share = row.shares[k] * columns[x].shares[i];
                    const std::uint8_t* pixel =
                        from + 3 * (static_cast<std::size_t>(columns[x].first) + i);
                    for (std::size_t c = 0; c < 3; ++c) line[3 * x + c] += share * pixel[c];
                }
        }
        for (const double value : line)
            copy.rgb.push_back(static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)));
    }
    return copy;
}

std::size_t Mask::area() const {
    return std::accumulate(inside.begin(), inside.end(), std::size_t{0});
}

Mask connected_with(const Mask& mask, const Mask& seeds) {
    Mask reached(mask.width, mask.height);
    std::vector<std::array<int, 2>> open;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y) && seeds.at(x, y)) {
                reached.inside[reached.index(x, y)] = 1;
                open.push_back({x, y});
            }
    static_cast<void>(flood(mask, true, std::move(open), reached));
    return reached;
}

Mask without_holes(const Mask& mask) {
    Mask outside(mask.width, mask.height);
    std::vector<std::array<int, 2>> open;
    const auto start = [&](int x, int y) {
        if (mask.at(x, y) || outside.at(x, y)) return;
        outside.inside[outside.index(x, y)] = 1;
        open.push_back({x, y});
    };
    for (int x = 0; x < mask.width; ++x) {
        start(x, 0);
        start(x, mask.height - 1);
    }
    for (int y = 0; y < mask.height; ++y) {
        start(0, y);
        start(mask.width - 1, y);
    }
    static_cast<void>(flood(mask, false, std::move(open), outside));
    return inverted(outside);
}

Mask largest_part(const Mask& mask) {
    Mask seen(mask.width, mask.height);
    std::optional<std::array<int, 2>> first_of_largest;
    std::size_t largest = 0;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            if (!mask.at(x, y) || seen.at(x, y)) continue;
            seen.inside[seen.index(x, y)] = 1;
            const std::size_t area = 1 + flood(mask, true, {{x, y}}, seen);
            if (area <= largest) continue;
            largest = area;
            first_of_largest = {x, y};
        }
    Mask seed(mask.width, mask.height);
    if (first_of_largest)
        seed.inside[seed.index((*first_of_largest)[0], (*first_of_largest)[1])] = 1;
    return connected_with(mask, seed);
}

Mask inverted(const Mask& mask) {
    Mask found = mask;
    for (std::uint8_t& value : found.inside) value = value == 0 ? 1 : 0;
    return found;
}

Mask opened(const Mask& mask, int reach) {
    Mask found = mask;
    // What is outside the picture is outside the mask.
    for (const std::uint8_t value : {std::uint8_t{0}, std::uint8_t{1}}) {
        for (int y = 0; y < mask.height; ++y)
            spread(found, found.index(0, y), 1, mask.width, value, reach);
        for (int x = 0; x < mask.width; ++x)
            spread(found, found.index(x, 0), found.index(0, 1), mask.height, value, reach);
    }
    return found;
}

Mask resized(const Mask& mask, int width, int height) {
    Mask found(width, height);
    const auto source = [](int i, int from, int to) {
        return static_cast<int>((2LL * i + 1) * from / (2LL * to));
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            found.inside[found.index(x, y)] =
                mask.at(source(x, mask.width, width), source(y, mask.height, height)) ? 1 : 0;
    return found;
}

}  // namespace sporeprint::trace
