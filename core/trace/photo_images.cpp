#include "core/trace/photo_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/elementary.h"
#include "core/silhouette/outline.h"
#include "core/trace/axis.h"
#include "core/trace/hue.h"
#include "core/trace/skin_patch.h"

namespace sporeprint::trace {

namespace {

constexpr double quarter = pi / 4.0;

/// Beyond this angle from the front a skin is too foreshortened.
constexpr double widest = 62.0 * pi / 180.0;

/// How far a place may stand out, in root mean squares of its row.
constexpr double most_contrast = 2.0;

/// A hue is quite another one by more steps: a brown cap may have a cream margin.
constexpr int other_hue = 4;

// --- From the photograph ----------------------------------------------------------------

/// Hides what follows a long gap on the way from the first row to the last, and a little before it: behind a
/// margin that stands up the other side is seen, and its shade.
void hide_beyond_gaps(SkinPatch& patch) {
    const std::size_t longest = patch.rows / 8, shade = patch.rows / 25;
    for (std::size_t column = 0; column < patch.columns; ++column) {
        std::size_t gap = 0;
        bool has_begun = false;  // an apex seen from the side is hidden at first
        for (std::size_t row = 0; row < patch.rows; ++row) {
            const bool is_seen = patch.is_seen[row * patch.columns + column];
            has_begun = has_begun || is_seen;
            gap = is_seen ? 0 : gap + 1;
            if (!has_begun || gap <= longest) continue;
            const std::size_t from = row + 1 - gap;
            for (std::size_t i = from > shade ? from - shade : 0; i < patch.rows; ++i)
                patch.is_seen[i * patch.columns + column] = false;
            break;
        }
    }
}

/// Returns a part of the skin, without what the photograph does not show of it.
///
/// surely  shares up to it are the part itself, whose hue is theirs
/// place   maps a share of the part and the sine of the angle from the front to the photograph
template <class Place>
SkinPatch patch_of(const Picture& picture, const Mask& mask, std::size_t rows, double surely,
                   Place place) {
    const PhotoLight light(picture);
    SkinPatch patch;
    patch.rows = rows;
    patch.columns = rows / 2;
    patch.reach = widest;
    const std::size_t texels = patch.rows * patch.columns;
    patch.light.reserve(texels);
    patch.is_seen.reserve(texels);
    std::vector<Pixel> pixels, seen;
    pixels.reserve(texels);
    seen.reserve(texels);
    for (std::size_t row = 0; row < patch.rows; ++row) {
        const double share = (static_cast<double>(row) + 0.5) / static_cast<double>(patch.rows);
        for (std::size_t column = 0; column < patch.columns; ++column) {
            const glm::dvec2 at = place(share, sine(patch.angle(column)));
            patch.light.push_back(light.at(at));
            patch.is_seen.push_back(is_well_inside(mask, at));
            pixels.push_back(patch.is_seen.back() ? light.pixel(at) : Pixel{});
            if (patch.is_seen.back() && share < surely) seen.push_back(pixels.back());
        }
    }
    // What has quite another hue is none of the skin: warts, grass, a lower face below a raised margin.
    const Hue hue = commonest_hue(std::move(seen));
    for (std::size_t i = 0; i < texels; ++i)
        if (patch.is_seen[i] && !are_near(hue_of(pixels[i]), hue, other_hue))
            patch.is_seen[i] = false;
    hide_beyond_gaps(patch);
    return patch;
}

/// Hides what a ring covers of a stem: it hangs down from where it is attached.
void hide_ring(SkinPatch& patch, const RingMeasure& ring, const SubCurve& stem, double height_m) {
    const double reach = 0.02 * height_m + 0.5 * ring.width_m;
    for (std::size_t row = 0; row < patch.rows; ++row) {
        const double share = (static_cast<double>(row) + 0.5) / static_cast<double>(patch.rows);
        if (std::abs(stem.at(share).y - ring.height_m) > reach) continue;
        for (std::size_t column = 0; column < patch.columns; ++column)
            patch.is_seen[row * patch.columns + column] = false;
    }
}

/// Returns the height of a traced mushroom, pixels.
double height_of(const Traced& traced) {
    double top = traced.axis.front().y, bottom = top;
    for (const std::vector<glm::dvec2>* side : {&traced.left, &traced.right})
        for (const glm::dvec2& point : *side) {
            top = std::min(top, point.y);
            bottom = std::max(bottom, point.y);
        }
    return bottom - top;
}

// --- Round the mushroom -----------------------------------------------------------------

/// Copies of a patch that are laid round a mushroom, an eighth of a turn apart; each reaches to its neighbours.
struct Copy {
    double turned;   ///< the angle of the patch in its middle, shares of an eighth of a turn
    double shifted;  ///< along the part, shares of it
    bool is_mirrored;
};
constexpr std::size_t copy_count = 8;
constexpr std::array<Copy, copy_count> copies = {{{0.21, 0.000, false},
                                                  {-0.30, 0.017, true},
                                                  {0.05, -0.022, false},
                                                  {0.33, 0.009, true},
                                                  {-0.14, -0.013, true},
                                                  {-0.26, 0.024, false},
                                                  {0.12, -0.006, true},
                                                  {0.29, 0.014, false}}};

/// A patch that goes on round the mushroom without a seam: the colours along the part, and on them copies of what
/// is finer.
class Round {
  public:
    explicit Round(const SkinPatch& patch)
        : rows_(patch.rows), columns_(patch.columns), reach_(patch.reach) {
        bases_.reserve(rows_);
        details_.reserve(patch.light.size());
        for (std::size_t row = 0; row < rows_; ++row) add_row(patch, row);
    }

    /// Returns the light at a share of the part and an angle round the mushroom. Two copies are mixed about their
    /// mean, which is 0; dividing by the length of the weights gives the mix the contrast of each.
    [[nodiscard]] glm::dvec3 at(double share, double angle) const {
        const double eighths = angle / quarter;
        glm::dvec3 detail(0.0);
        double squares = 0.0;
        for (int side = 0; side < 2; ++side) {
            const double middle = std::floor(eighths) + side;
            const double away = eighths - middle;
            const double half = cosine(0.5 * pi * away);
            const double weight = half * half;
            const auto number =
                static_cast<std::size_t>(static_cast<int>(middle) + 16 * 8) % copy_count;
            const Copy& copy = copies[number];
            const double seen = (copy.is_mirrored ? -away : away) + copy.turned;
            detail += weight * detail_at(share + copy.shifted, seen * quarter);
            squares += weight * weight;
        }
        const glm::dvec3 light = base_at(share) + detail / std::sqrt(squares);
        return glm::max(light, glm::dvec3(0.0));
    }

  private:
    std::size_t rows_, columns_;
    double reach_;
    std::vector<glm::dvec3> bases_, details_;

    /// Columns to either side whose mean is the coarse light of a row.
    [[nodiscard]] std::size_t window() const { return columns_ / 10; }

    void add_row(const SkinPatch& patch, std::size_t row) {
        std::vector<glm::dvec3> sums(columns_ + 1, glm::dvec3(0.0));
        for (std::size_t column = 0; column < columns_; ++column)
            sums[column + 1] = sums[column] + patch.light[row * columns_ + column];
        bases_.push_back(sums.back() / static_cast<double>(columns_));
        for (std::size_t column = 0; column < columns_; ++column) {
            const std::size_t from = column > window() ? column - window() : 0,
                              to = std::min(column + window() + 1, columns_);
            details_.push_back(patch.light[row * columns_ + column] -
                               (sums[to] - sums[from]) / static_cast<double>(to - from));
        }
        level(row);
    }

    /// Bounds what stands out from a row: a gleam is seen once on a mushroom, and spots are not all alike.
    void level(std::size_t row) {
        const auto first = details_.begin() + static_cast<std::ptrdiff_t>(row * columns_);
        const auto last = first + static_cast<std::ptrdiff_t>(columns_);
        double squares = 0.0;
        for (auto detail = first; detail != last; ++detail) squares += glm::dot(*detail, *detail);
        const double most = most_contrast * std::sqrt(squares / static_cast<double>(columns_));
        for (auto detail = first; detail != last; ++detail)
            if (const double contrast = glm::length(*detail); contrast > most)
                *detail *= most / contrast;
    }

    /// Returns a place between the middles of rows or columns.
    static double between(double share, std::size_t count) {
        return std::clamp(share * static_cast<double>(count) - 0.5, 0.0,
                          static_cast<double>(count) - 1.001);
    }

    [[nodiscard]] glm::dvec3 base_at(double share) const {
        const double place = between(share, rows_);
        const auto row = static_cast<std::size_t>(place);
        const double part = place - static_cast<double>(row);
        return (1.0 - part) * bases_[row] + part * bases_[row + 1];
    }

    [[nodiscard]] glm::dvec3 detail_at(double share, double angle) const {
        const double down = between(share, rows_),
                     across = between(0.5 + 0.5 * angle / reach_, columns_);
        return between_texels(across, down, [this](std::size_t column, std::size_t row) {
            return details_[row * columns_ + column];
        });
    }
};

}  // namespace

PhotoImages photo_images(const Picture& picture, const Mask& mask, const Traced& traced,
                         double height_m) {
    constexpr std::size_t rows = 256;
    const Outline outline = Outline::unproven(traced.shape.silhouette, "/silhouette");
    const TracedAxis axis(traced.axis);
    const double scale = height_of(traced) / height_m;  // pixels of a metre
    PhotoImages images;

    SkinPatch stem = patch_of(picture, mask, rows, 1.0, [&](double share, double to_right) {
        const OutlineSample sample = outline.stem.at(share);
        return axis.beside(to_right * sample.r * scale, std::max(sample.y, 0.0) * scale);
    });
    if (traced.ring) hide_ring(stem, *traced.ring, outline.stem, height_m);
    if (shows_enough(stem, stem.light.size())) {
        fill(stem);
        unshade(stem, true);
        const Round round(stem);
        images.stem = picture_of(image_side, image_side / 2, [&](double along, double across) {
            return round.at(along, 2.0 * pi * across);
        });
    }

    const glm::dvec2 middle = 0.5 * (traced.margins[0] + traced.margins[1]);
    const glm::dvec2 width = traced.margins[1] - traced.margins[0];
    if (glm::length(width) < 1.0 || is_hollow(traced.form)) return images;
    const glm::dvec2 right = width / glm::length(width), up(right.y, -right.x);
    const OutlinePoint margin = traced.shape.silhouette.cap.front();
    // Both ends of the cap's width are measured, so its own scale is better than that of the axis.
    const double of_cap = margin.r > 0.0 ? 0.5 * glm::length(width) / margin.r : scale;
    SkinPatch cap = patch_of(picture, mask, rows, 0.5, [&](double share, double to_right) {
        const OutlineSample sample = outline.cap.at(1.0 - share);
        return middle + of_cap * (to_right * sample.r * right + (sample.y - margin.y) * up);
    });
    if (shows_enough(cap, cap.light.size())) {
        fill(cap);
        unshade(cap, false);
        const Round round(cap);
        images.cap = picture_of(image_side, image_side, [&](double u, double v) {
            const double x = 2.0 * u - 1.0, y = 2.0 * v - 1.0;
            return round.at(std::min(std::sqrt(x * x + y * y), 0.9999), arc_tangent(y, x));
        });
    }
    return images;
}

}  // namespace sporeprint::trace
