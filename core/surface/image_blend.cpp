#include "core/surface/image_blend.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string>
#include <vector>

#include "core/problems.h"
#include "core/surface/canvas.h"
#include "core/surface/plan.h"

namespace sporeprint {
namespace {

using Channels = std::array<double, blended_channels>;

// Groups of channels that share one contrast gain, so that hues and directions of slopes do not
// change: colour, slopes, occlusion, roughness.
struct Group {
    std::size_t from, to;
};
constexpr std::array<Group, 4> groups = {{{0, 3}, {3, 5}, {5, 6}, {6, 7}}};

void check(std::span<const RawImages* const> paintings, std::span<const double> weights) {
    if (paintings.empty() || paintings.size() > most_paintings ||
        paintings.size() != weights.size())
        throw InvalidInput("", std::to_string(paintings.size()) + " paintings and " +
                                   std::to_string(weights.size()) +
                                   " weights; expected one weight each of 1 to " +
                                   std::to_string(most_paintings) + " paintings");
    double sum = 0.0;
    for (const double weight : weights) {
        if (!(weight >= 0.0 && weight <= 1.0))
            throw InvalidInput("", "a weight of a painting is outside 0..1");
        sum += weight;
    }
    if (std::abs(sum - 1.0) > 1e-6)
        throw InvalidInput("", "the weights of the paintings do not sum to 1");
    for (const RawImages* painting : paintings) {
        if (!painting || !proper_side(painting->side) || painting->side != paintings[0]->side)
            throw InvalidInput(
                "/side", "paintings of one atlas have one side, a power of two from 16 to 2048");
        const std::size_t side = static_cast<std::size_t>(painting->side);
        for (const Bytes& image : painting->rgb)
            if (image.size() != 3 * side * side)
                throw InvalidInput("/side", "an image has " + std::to_string(image.size()) +
                                                " bytes; its side asks for " +
                                                std::to_string(3 * side * side));
    }
}

// Returns a texel as numbers that may be averaged.
Channels channels_at(const std::array<const std::uint8_t*, 3>& images, std::size_t at) {
    const std::array<float, 256>& linear = linear_table();
    const auto number = [&](std::size_t image, std::size_t c) {
        return static_cast<double>(images[image][at + c]);
    };
    Channels out{};
    for (std::size_t c = 0; c < 3; ++c) out[c] = static_cast<double>(linear[images[0][at + c]]);
    const double nz = std::max(number(1, 2) / 127.5 - 1.0, static_cast<double>(flattest_normal));
    out[3] = (number(1, 0) / 127.5 - 1.0) / nz;
    out[4] = (number(1, 1) / 127.5 - 1.0) / nz;
    out[5] = number(2, 0) / 255.0;
    out[6] = number(2, 1) / 255.0;
    return out;
}

// Accumulates the sums of a cell, and the scatter of samples about the means of their cells.
struct Moments {
    Channels sum{}, squares{}, scatter{};

    void add(const Channels& value) {
        for (std::size_t c = 0; c < blended_channels; ++c) {
            sum[c] += value[c];
            squares[c] += value[c] * value[c];
        }
    }
    void end_cell(double count) {
        for (std::size_t c = 0; c < blended_channels; ++c) {
            scatter[c] += std::max(squares[c] - sum[c] * sum[c] / count, 0.0);
            sum[c] = squares[c] = 0.0;
        }
    }
    [[nodiscard]] double deviation(const Group& group, double count) const {
        double variance = 0.0;
        for (std::size_t c = group.from; c < group.to; ++c) variance += scatter[c] / count;
        return std::sqrt(variance);
    }
};

// Returns the weighted mean of each cell with its eight neighbours (binomial kernel).
std::vector<float> smoothed(const std::vector<Channels>& cells, int columns, int rows) {
    std::vector<float> out;
    out.reserve(cells.size() * blended_channels);
    const auto cell = [&](int i, int j) -> const Channels& {
        const int x = std::clamp(i, 0, columns - 1), y = std::clamp(j, 0, rows - 1);
        return cells[static_cast<std::size_t>(y * columns + x)];
    };
    constexpr double weights[3] = {0.25, 0.5, 0.25};
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            for (std::size_t c = 0; c < blended_channels; ++c) {
                double sum = 0.0;
                for (int dj = 0; dj < 3; ++dj)
                    for (int di = 0; di < 3; ++di)
                        sum += weights[dj] * weights[di] * cell(i + di - 1, j + dj - 1)[c];
                out.push_back(static_cast<float>(sum));
            }
    return out;
}

// Measures a chart at about 128 x 128 samples of the atlas: the means of its cells, and the gain
// that restores the contrast which a plain mean of the paintings loses.
ChartBlend measured(const BlendPlan& plan, Part part) {
    const Frame& frame = plan.frames[index_of(part)];
    const int cell = blend_cell(plan.side);
    const int step = std::max(1, plan.side / 128);
    ChartBlend chart;
    chart.columns = std::max(1, frame.width / cell);
    chart.rows = std::max(1, frame.height / cell);
    std::array<Moments, most_paintings> own{};
    Moments mixed;
    std::vector<Channels> cells;
    double all = 0.0;
    for (int j = 0; j < chart.rows; ++j)
        for (int i = 0; i < chart.columns; ++i) {
            double count = 0.0;
            for (int y = j * cell + step / 2; y < std::min((j + 1) * cell, frame.height); y += step)
                for (int x = i * cell + step / 2; x < std::min((i + 1) * cell, frame.width);
                     x += step) {
                    const std::size_t at = 3 * (static_cast<std::size_t>(frame.y + y) *
                                                    static_cast<std::size_t>(plan.side) +
                                                static_cast<std::size_t>(frame.x + x));
                    Channels mean{};
                    for (std::size_t k = 0; k < plan.paintings; ++k) {
                        const Channels value = channels_at(plan.images[k], at);
                        own[k].add(value);
                        for (std::size_t c = 0; c < blended_channels; ++c)
                            mean[c] += static_cast<double>(plan.weights[k]) * value[c];
                    }
                    mixed.add(mean);
                    count += 1.0;
                }
            Channels& means = cells.emplace_back(mixed.sum);
            for (double& mean : means) mean /= count;
            for (std::size_t k = 0; k < plan.paintings; ++k) own[k].end_cell(count);
            mixed.end_cell(count);
            all += count;
        }
    chart.means = smoothed(cells, chart.columns, chart.rows);
    double squares = 0.0;
    for (std::size_t k = 0; k < plan.paintings; ++k)
        squares += static_cast<double>(plan.weights[k]) * static_cast<double>(plan.weights[k]);
    const double most = 1.0 / std::sqrt(squares);
    for (const Group& group : groups) {
        double wanted = 0.0;
        for (std::size_t k = 0; k < plan.paintings; ++k)
            wanted += static_cast<double>(plan.weights[k]) * own[k].deviation(group, all);
        const double found = mixed.deviation(group, all);
        // A deviation below a tenth of a level is rounding, not contrast.
        const double gain = found > 4e-4 ? std::clamp(wanted / found, 1.0, most) : 1.0;
        for (std::size_t c = group.from; c < group.to; ++c)
            chart.surplus[c] = static_cast<float>(gain - 1.0);
    }
    return chart;
}

void blend_onto(Canvas& canvas, std::span<const RawImages* const> paintings,
                std::span<const double> weights, const Parallel& parallel,
                std::span<const PaintParams* const> patches_of) {
    if (!patches_of.empty() && patches_of.size() != paintings.size())
        throw InvalidInput("", "patches are laid for all paintings or for none");
    PaintPlan patches;
    BlendPlan plan;
    if (!patches_of.empty()) patches = patch_blend_plan(patches_of, weights);
    if (!patches.patches.empty()) plan.patches = &patches;
    plan.side = canvas.side();
    plan.frames = chart_frames(plan.side);
    plan.linear = linear_table().data();
    for (std::size_t i = 0; i < paintings.size(); ++i) {
        if (weights[i] <= 0.0) continue;
        for (std::size_t image = 0; image < 3; ++image)
            plan.images[plan.paintings][image] = paintings[i]->rgb[image].data();
        plan.weights[plan.paintings] = static_cast<float>(weights[i]);
        ++plan.paintings;
    }
    const PaintTarget target = canvas.target();
    if (plan.paintings == 1 && !plan.patches) {
        std::uint8_t* const to[3] = {target.base_color, target.normal, target.orm};
        for (std::size_t image = 0; image < 3; ++image)
            std::memcpy(to[image], plan.images[0][image], canvas.size());
        return;
    }
    std::vector<std::function<void()>> pieces;
    pieces.reserve(std::size(all_parts));
    for (const Part part : all_parts)
        pieces.emplace_back([&plan, part] { plan.charts[index_of(part)] = measured(plan, part); });
    parallel(pieces);
    pieces.clear();
    for (const Part part : all_parts) {
        const int height = plan.frames[index_of(part)].height;
        for (int from = 0; from < height; from += rows_per_piece) {
            const int to = std::min(from + rows_per_piece, height);
            pieces.emplace_back(
                [&plan, &target, part, from, to] { blend_piece(plan, part, from, to, target); });
        }
    }
    parallel(pieces);
}

}  // namespace

PaintParams without_patches(PaintParams params) {
    params.warts = {};
    params.scales = {};
    params.ornaments = {};
    return params;
}

RawImages blend_raw(std::span<const RawImages* const> paintings, std::span<const double> weights,
                    const Parallel& parallel, std::span<const PaintParams* const> patches_of) {
    check(paintings, weights);
    Canvas canvas(paintings[0]->side);
    blend_onto(canvas, paintings, weights, parallel, patches_of);
    return raw(canvas);
}

ImageSet blend_images(std::span<const RawImages* const> paintings, std::span<const double> weights,
                      const Parallel& parallel, std::span<const PaintParams* const> patches_of,
                      ImageFormat format) {
    check(paintings, weights);
    Canvas canvas(paintings[0]->side);
    blend_onto(canvas, paintings, weights, parallel, patches_of);
    return encoded(canvas, format, parallel);
}

}  // namespace sporeprint
