#include "core/surface/uploaded_image.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/math/elementary.h"
#include "core/surface/canvas.h"
#include "core/surface/codecs.h"

namespace sporeprint {
namespace {

// One uploaded image of a painting, and the member that holds its rotation.
struct Place {
    const Upload& (*upload)(const PaintParams&);
    double ImageRotations::*turn;
    std::size_t part;
    const char* path;
};

constexpr std::array<Place, 3> places = {{
    {[](const PaintParams& p) -> const Upload& { return p.surface.cap.image; },
     &ImageRotations::cap, 0, "/surface/cap/image"},
    {[](const PaintParams& p) -> const Upload& { return p.surface.hymenium.image; },
     &ImageRotations::hymenium, 1, "/surface/hymenium/image"},
    {[](const PaintParams& p) -> const Upload& { return p.surface.stem.image; },
     &ImageRotations::stem, 2, "/surface/stem/image"},
}};

constexpr int profile_rows = 24;

bool is_oversampled(const UploadedImage& image, const Frame& frame) {
    return image.width > 2 * frame.width || image.height > 2 * frame.height;
}

// Halves each side of an image that has more than two texels to one of the frame.
// texel  returns the linear light of a channel by its index, three channels per texel
template <class Texel>
UploadedImage halved(const UploadedImage& image, const Frame& frame, Texel texel) {
    const int across = image.width > 2 * frame.width ? 2 : 1;
    const int down = image.height > 2 * frame.height ? 2 : 1;
    UploadedImage half;
    half.width = image.width / across;
    half.height = image.height / down;
    half.light.resize(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height) *
                      3);
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x)
            for (int c = 0; c < 3; ++c) {
                float sum = 0.0F;
                for (int j = 0; j < down; ++j)
                    for (int i = 0; i < across; ++i)
                        sum += texel(static_cast<std::size_t>(
                            ((y * down + j) * image.width + x * across + i) * 3 + c));
                half.light[static_cast<std::size_t>((y * half.width + x) * 3 + c)] =
                    sum / static_cast<float>(across * down);
            }
    return half;
}

}  // namespace

UploadedImage uploaded_image(const Upload& upload, const Frame& frame, const std::string& path) {
    UploadedImage image;
    if (upload.empty()) return image;
    Picture picture = decoded_picture(upload.bytes, path);
    const std::array<float, 256>& table = linear_table();
    image.width = picture.width;
    image.height = picture.height;
    // The first halving reads the bytes: 2048 x 2048 texels would take 48 MB as floats.
    const auto texel = [&](std::size_t i) { return table[picture.rgb[i]]; };
    if (is_oversampled(image, frame)) {
        image = halved(image, frame, texel);
    } else {
        image.light.resize(picture.rgb.size());
        for (std::size_t i = 0; i < picture.rgb.size(); ++i) image.light[i] = texel(i);
    }
    picture = {};
    while (is_oversampled(image, frame))
        image = halved(image, frame, [&](std::size_t i) { return image.light[i]; });
    return image;
}

void rotate(UploadedImage& image, double turns) {
    const double shown = turns - std::floor(turns);
    const SineCosine angle = sine_cosine(2.0 * pi * shown);
    image.turn = static_cast<float>(shown);
    image.cosine = static_cast<float>(angle.cosine);
    image.sine = static_cast<float>(angle.sine);
}

std::vector<double> angular_profile(const UploadedImage& image, ChartMap map) {
    std::vector<double> profile;
    double mean = 0.0;
    for (int i = 0; i < profile_samples; ++i) {
        const double share = (i + 0.5) / profile_samples;
        const SineCosine angle = sine_cosine(2.0 * pi * share);
        double sum = 0.0;
        for (int row = 0; row < profile_rows; ++row) {
            const double along = (row + 0.5) / profile_rows;
            const double radius = 0.5 * (0.15 + 0.80 * along);  // excludes the pole and the rim
            const bool disc = map == ChartMap::disc;
            const double u = disc ? 0.5 + radius * angle.cosine : along;
            const double v = disc ? 0.5 + radius * angle.sine : share;
            const auto x = static_cast<std::size_t>(u * image.width);
            const auto y = static_cast<std::size_t>(v * image.height);
            const float* const light =
                image.light.data() + 3 * (y * static_cast<std::size_t>(image.width) + x);
            for (int c = 0; c < 3; ++c) sum += static_cast<double>(light[c]);
        }
        profile.push_back(sum);
        mean += sum / profile_samples;
    }
    for (double& value : profile) value -= mean;
    return profile;
}

int best_shift(std::span<const double> a, std::span<const double> b) {
    const int n = static_cast<int>(a.size());
    int best = 0;
    double most = 0.0;
    for (int i = 0; i < n; ++i) {
        // Shifts are tried in the order 0, 1, -1, 2, -2, ...
        const int shift = i % 2 == 1 ? (i + 1) / 2 : -(i / 2);
        double sum = 0.0;
        for (int k = 0; k < n; ++k)
            sum +=
                a[static_cast<std::size_t>(k)] * b[static_cast<std::size_t>((k + shift + n) % n)];
        // Better by more than rounding.
        if (i == 0 || sum > most + 1e-9 * std::abs(most)) {
            most = sum;
            best = shift;
        }
    }
    return best;
}

std::vector<ImageRotations> aligned_rotations(std::span<const PaintParams* const> paintings,
                                              std::span<const double> weights) {
    std::vector<ImageRotations> turns(paintings.size());
    for (const Place& place : places) {
        std::vector<double> reference;
        std::vector<std::pair<std::size_t, double>> ahead;  // painting, turns ahead
        double mean = 0.0, weight = 0.0;
        for (std::size_t i = 0; i < paintings.size(); ++i) {
            const Upload& upload = place.upload(*paintings[i]);
            if (upload.empty()) continue;
            const Frame frame = chart_frames(paintings[i]->side)[place.part];
            const std::vector<double> profile = angular_profile(
                uploaded_image(upload, frame, place.path), swept_charts[place.part].map);
            if (reference.empty()) reference = profile;
            ahead.emplace_back(
                i, static_cast<double>(best_shift(reference, profile)) / profile_samples);
            mean += weights[i] * ahead.back().second;
            weight += weights[i];
        }
        if (weight <= 0.0) continue;
        for (const auto& [i, turn] : ahead) turns[i].*place.turn = turn - mean / weight;
    }
    return turns;
}

}  // namespace sporeprint
