#include "core/plant/leaf_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/noise.h"
#include "core/plant/cell_middle.h"
#include "core/plant/image_rows.h"
#include "core/plant/leaf_shell.h"
#include "core/plant/leaf_spray.h"
#include "core/plant/needle_shoot.h"

namespace sporeprint {

namespace {

// Linear colours of dry marks of insects and fungi and of their rims.
const glm::dvec3 dry(0.15, 0.085, 0.035), rim(0.36, 0.34, 0.1);

// Colours of the border of what is eaten, where the flesh dries, and of what lies behind it where no mesh
// is open; widths of that border and of the paler halo about it, in lengths of the lamina.
const glm::dvec3 bitten(0.11, 0.055, 0.02), behind(0.035, 0.026, 0.015);
constexpr double bitten_width = 0.009, halo_width = 0.022;

// Linear colour of the wax in pores of needles.
const glm::dvec3 pore_wax(0.42, 0.5, 0.46);

constexpr int finest_row = 512;  // points per row that resolve the veins of a leaf

// Returns a table of sRGB bytes for linear light in 4096 steps: finer than bytes, except for the
// darkest.
const std::array<std::uint8_t, 4097>& encoded_table() {
    static const std::array<std::uint8_t, 4097> table = [] {
        std::array<std::uint8_t, 4097> made{};
        for (std::size_t i = 0; i < made.size(); ++i)
            made[i] = share_as_byte(linear_to_srgb(static_cast<double>(i) / 4096.0));
        return made;
    }();
    return table;
}

// How far noise bends veins, in lengths of the lamina; no source or measurement is recorded for this
// and for what follows.
constexpr double vein_wander = 0.006, net_wander = 0.012;

// Shades of the lamina beside veins, and how far from them these reach; how far the tint of blotches
// departs from green to yellow, and that of the border to yellow.
constexpr double beside_main = 0.16, beside_side = 0.12, main_reach = 0.05, side_reach = 0.022;
const glm::dvec3 blotch_tint(0.2, 0.07, -0.12), border_tint(0.16, 0.05, -0.06);

// Laminae whose half breadth is a smaller share of their length than the first are needles, those
// from the second on have broad blades; rows of pores of a needle per half breadth.
constexpr double needle_breadth = 0.03, blade_breadth = 0.07, pore_rows = 12.0;

// Returns the distance from the nearest integer.
double from_line(double x) { return std::abs(x - std::floor(x + 0.5)); }

// Returns 1 on a line, 0 beside it, with a smooth profile between.
double line_profile(double distance, double width) {
    return distance < width ? 1.0 - smooth_step(0.0, width, distance) : 0.0;
}

// Returns the depth of a vein at a place, 0..1.
double vein_depth(const LaminaPlace& place) {
    const double main = line_profile(place.from_main, 0.028 * (1.0 - 0.7 * place.homothety));
    double side =
        line_profile(place.from_side, 0.014 * (1.0 - 0.5 * std::min(place.along_side, 1.0)));
    if (side > 0.0) side *= 1.0 - smooth_step(0.5, 1.1, place.along_side);
    return std::max(main, 0.6 * side);
}

// The two networks of finer veins: cells per length of the lamina along its main vein and along its
// side veins, and widths of their walls. Veins of third order join side veins, so their cells are
// longer along the main vein; the net between them is as much fainter.
struct Network {
    double along, up, width, share;
    std::uint32_t salt;
};
constexpr Network ladder = {11.0, 23.0, 0.09, 1.0, 17};
constexpr Network meshes = {52.0, 60.0, 0.2, 0.5, 71};

// Finds the walls between the cells of a network. It keeps the middles round the last place: most
// texels of a row are in the cell of the one before.
class Walls {
  public:
    explicit Walls(const Network& net) : net_(&net) {}

    // Returns how far the line of a wall is at a place, 0..1, times the network's share.
    //
    // source  [Worley1996], with the distance from the line half-way between the two nearest points
    double at(double abscissa, double height, std::uint32_t seed) {
        const glm::dvec2 at(net_->along * abscissa, net_->up * height);
        look_round(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)), seed);
        glm::dvec2 nearest(0.0), second(0.0);
        double least = 1e9, next = 1e9;
        for (const glm::dvec2& middle : middles_) {
            const glm::dvec2 away = middle - at;
            const double square = glm::dot(away, away);
            if (square < least) {
                next = least;
                second = nearest;
                least = square;
                nearest = away;
            } else if (square < next) {
                next = square;
                second = away;
            }
        }
        const double distance =
            0.5 * (next - least) / std::max(glm::length(second - nearest), 1e-6);
        return line_profile(distance, net_->width) * net_->share;
    }

  private:
    const Network* net_;
    int x_ = 0, y_ = 0;
    std::uint32_t seed_ = 0;
    bool is_empty_ = true;
    std::array<glm::dvec2, 9> middles_{};

    void look_round(int x, int y, std::uint32_t seed) {
        if (!is_empty_ && x == x_ && y == y_ && seed == seed_) return;
        auto middle = middles_.begin();
        for (int i = -1; i <= 1; ++i)
            for (int k = -1; k <= 1; ++k) *middle++ = cell_middle(x + i, y + k, net_->salt + seed);
        x_ = x;
        y_ = y;
        seed_ = seed;
        is_empty_ = false;
    }
};

// The veins of third order and the net between them, of one row.
struct FineVeins {
    Walls rungs{ladder}, net{meshes};
};

// Returns how far a vein of third order or the net is at a place, 0..1. Both halves have their own.
double net_at(const LaminaPlace& place, double bend, FineVeins& veins) {
    if (place.affinity >= 1.0) return 0.0;
    const auto half = static_cast<std::uint32_t>(2 * place.lobe + place.side);
    const double height = place.height + bend, abscissa = place.abscissa - 0.15 * place.height;
    const double rung = veins.rungs.at(abscissa, height, 97 * half);
    const double mesh = veins.net.at(abscissa, height, 97 * half);
    return std::max(rung, mesh) * (1.0 - smooth_step(0.92, 1.0, place.affinity));
}

// Returns how far a place belongs to the bands of pores on either side of a needle's main vein, 0..1:
// rows of pores along the needle.
double pores_at(const LaminaPlace& place, double cell) {
    const double band =
        smooth_step(0.14, 0.24, place.affinity) * (1.0 - smooth_step(0.62, 0.74, place.affinity));
    const double row = from_line(pore_rows * place.affinity);
    return band * (0.45 + (0.55 + 0.5 * cell) * line_profile(row, 0.32));
}

// Returns how far a dry mark covers a place, 0..1: where blotches are high, with ragged borders. Below
// 0 is its pale rim.
double mark_at(double marks, double blotch, double cell) {
    if (marks <= 0.0) return 0.0;
    const double over = blotch + 0.16 * cell - (0.72 - 0.5 * marks);
    return over > 0.0 ? smooth_step(0.0, 0.05, over) : -smooth_step(-0.07, 0.0, over);
}

// The coordinates of a place beyond the border.
constexpr LaminaPlace beyond_lamina = {.affinity = 1.0, .homothety = 1.0, .from_main = 1e9};

struct Texel {
    glm::dvec3 light{0.0};
    double occlusion = 0.0, roughness = 0.0;

    void add(double share, const glm::dvec3& colour, double occluded, double rough) {
        light += colour;
        occlusion += share * occluded;
        roughness += share * rough;
    }
};

// Paints images row by row.
class LeafPainter {
  public:
    LeafPainter(const LeafShape& shape, const LeafPalette& palette, double autumn,
                std::uint32_t seed, std::size_t side, LeafLayout layout, double snow)
        : sampler_(lamina_of(shape.venation, leaf_steps(shape.venation, 0))),
          has_shoots_(is_slim(sampler_.lamina())),
          has_sprays_(layout == LeafLayout::with_sprays && !has_shoots_),
          chart_(chart_of(sampler_.lamina(), has_sprays_ ? layout : LeafLayout::alone)),
          colour_map_(palette),
          autumn_(autumn),
          snow_(snow),
          relief_(shape.relief),
          net_(shape.venation.net),
          marks_(palette.marks),
          broad_(smooth_step(needle_breadth, blade_breadth, half_breadth(sampler_.lamina()))),
          eaten_(spots_of(shape, seed)),
          seed_(seed),
          count_(side),
          points_(std::clamp<std::size_t>(finest_row / side, 1, most_points)),
          share_(1.0 / static_cast<double>(points_ * points_)),
          tile_(std::max<std::size_t>(side / most_tiles, 1)) {
        LaminaPlace vein;
        vein.from_side = 0.0;
        petiole_ = colour_map_.at(vein, autumn_).upper;
        heights_.assign(count_ * count_ / 2, 0.0F);
        images_.side = static_cast<int>(side);
        for (Bytes& image : images_.rgb) image.assign(3 * count_ * count_, 0);
        for (std::size_t i = 0; i < count_ / 2 * points_; ++i) {
            bool upper = false;
            columns_.push_back(chart_.place({along(i), 0.0}, upper).x);
            for (std::size_t k = 0; k < 2; ++k)
                across_[k].push_back(static_cast<float>(columns_.back() + 8.0) * features[k]);
        }
        LaminaPlace blade;
        blade.affinity = 0.5;
        blade.homothety = 0.3;
        blade.from_main = blade.from_side = 1e9;
        const LeafColourMap::Faces needle = colour_map_.at(blade, autumn_);
        blade.homothety = 1.0;
        blade.affinity = 0.9;
        if (has_shoots_)
            shoots_.emplace(ShootPainter::Colours{needle, colour_map_.at(blade, autumn_), petiole_},
                            snow_, seed_);
        if (has_shoots_ || has_sprays_) images_.alpha.assign(count_ * count_, opaque);
        if (has_sprays_) on_lamina_.assign(count_ * count_ / 2, 0.0F);
        find_lamina_tiles();
        const LeafColourMap::Faces beyond = colour_map_.at(beyond_lamina, autumn_);
        for (const bool upper : {true, false}) {
            const Painted flat = painted_texel(
                {upper ? beyond.upper : beyond.lower, 1.0, (upper ? 0.5 : 0.75) + 0.2 * autumn_});
            for (std::size_t x = 0; x < count_ / 2; ++x) {
                flat_[0].insert(flat_[0].end(), flat.begin(), flat.begin() + 3);
                flat_[1].insert(flat_[1].end(),
                                {share_as_byte(0.5), share_as_byte(0.5), share_as_byte(1.0)});
                flat_[2].insert(flat_[2].end(), {flat[3], flat[4], 0});
            }
        }
    }

    // Computes colour, occlusion, roughness and the height of the upper face.
    void colour_row(std::size_t y) {
        const std::size_t half = count_ / 2;
        const bool of_petiole =
            (static_cast<double>(y) + 0.5) / static_cast<double>(count_) > petiole_strip;
        const Span painted = of_petiole ? Span{0, half} : spans_[y / tile_];
        for (const std::size_t image : {0, 2})
            std::copy(flat_[image].begin(), flat_[image].end(),
                      &images_.rgb[image][3 * y * count_]);
        std::array<Line, most_points> lines;
        for (std::size_t i = 0; i < points_ && painted.first < painted.last; ++i)
            lines[i] = line_at(y * points_ + i, painted);
        for (std::size_t x = 0; x < half; ++x) {
            if (!of_petiole && !shown_[y / tile_ * (half / tile_) + x / tile_]) continue;
            Texel upper, lower;
            double height = 0.0, inside = 0.0;
            for (std::size_t i = 0; i < points_; ++i)
                for (std::size_t point = x * points_; point < (x + 1) * points_; ++point) {
                    if (of_petiole)
                        add_petiole(lines[i], point, upper);
                    else
                        inside += add_faces(lines[i], point, upper, lower, height) ? share_ : 0.0;
                }
            if (has_sprays_) on_lamina_[y * half + x] = static_cast<float>(inside);
            const Painted one = painted_texel(upper);
            put_texel(y * count_ + x, one);
            // The strip of the petiole is mirrored where both halves meet.
            if (of_petiole)
                put_texel((y + 1) * count_ - 1 - x, one);
            else
                put_texel(y * count_ + half + x, painted_texel(lower));
            heights_[y * half + x] = static_cast<float>(height);
        }
    }

    // Computes the normals from the slopes of the upper face, negated for the lower one.
    void normal_row(std::size_t y) {
        const std::size_t half = count_ / 2;
        std::uint8_t* upper = &images_.rgb[1][3 * y * count_];
        std::uint8_t* lower = upper + 3 * half;
        // Rows without relief have a constant normal.
        Span span = spans_[y / tile_];
        for (const std::size_t row :
             {y - std::min<std::size_t>(y, 1), std::min(y + 1, count_ - 1)}) {
            span.first = std::min(span.first, spans_[row / tile_].first);
            span.last = std::max(span.last, spans_[row / tile_].last);
        }
        span.first -= std::min<std::size_t>(span.first, 1);
        span.last = std::min(span.last + 1, half);
        std::copy(flat_[1].begin(), flat_[1].end(), upper);
        if (span.first >= span.last) return;
        const float* here = &heights_[y * half];
        const float* above = y == 0 ? here : here - half;
        const float* below = y + 1 == count_ ? here : here + half;
        const double texels = 0.5 * chart_.scale * static_cast<double>(count_);
        std::vector<double> along(half), across(half), size(half);
        for (std::size_t x = std::max<std::size_t>(span.first, 1);
             x < std::min(span.last, half - 1); ++x)
            along[x] =
                texels * (static_cast<double>(here[x - 1]) - static_cast<double>(here[x + 1]));
        for (std::size_t x = span.first; x < span.last; ++x) {
            across[x] = texels * (static_cast<double>(below[x]) - static_cast<double>(above[x]));
            size[x] = 1.0 / std::sqrt(along[x] * along[x] + across[x] * across[x] + 1.0);
        }
        for (std::size_t x = span.first; x < span.last; ++x)
            put_normals(upper + 3 * x, lower + 3 * x, along[x] * size[x], across[x] * size[x],
                        size[x]);
        // The faces are adjacent in the image but not on the leaf, so no slope is computed across
        // the line between them; each face has a one-sided slope at its outer edge.
        const auto outer = [&](std::uint8_t* at, std::size_t x, double slope, double sign) {
            const double one = 1.0 / std::sqrt(slope * slope + across[x] * across[x] + 1.0);
            std::array<std::uint8_t, 3> other{};
            put_normals(at, other.data(), sign * slope * one, sign * across[x] * one, one);
        };
        const auto slope = [&](std::size_t left) {
            return texels * (static_cast<double>(here[left]) - static_cast<double>(here[left + 1]));
        };
        if (span.first == 0) outer(upper, 0, slope(0), 1.0);
        if (span.last == half) outer(lower + 3 * (half - 1), half - 1, slope(half - 2), -1.0);
    }

    // Takes what has been painted as the leaf of sprays.
    void take_leaf() {
        if (has_sprays_)
            sprays_.emplace(chart_, images_.rgb[0], on_lamina_, count_, petiole_, seed_);
    }

    // Paints a shoot of needles and a spray of shoots beside a needle, or sprays of leaves.
    void panel_row(std::size_t y) {
        // What is beside a panel is clear too, as far as smaller copies of the image blend it in.
        if (has_shoots_) {
            clear(y, shoot_panel, 0.11, 0.50);
            paint_panel(y, shoot_panel, [this](double along, double across) {
                return shoots_->shoot_at(along, across);
            });
            paint_panel(y, spray_panel, [this](double along, double across) {
                return shoots_->spray_at(along, across);
            });
        }
        if (!has_sprays_) return;
        clear(y, panel_of(LeafGroup::twig), 0.245, 0.50);
        clear(y, panel_of(LeafGroup::branch), 0.0, 0.50);
        for (const LeafGroup spray : all_sprays)
            paint_panel(y, panel_of(spray), [this, spray](double along, double across) {
                return sprays_->at(spray, along, across);
            });
    }

    [[nodiscard]] RawImages take() { return std::move(images_); }

  private:
    // Numbers of blotches and of cells between veins per length of a lamina.
    static constexpr std::array<float, 2> features = {7.0F, 60.0F};

    static constexpr std::size_t most_points = 4;
    static constexpr std::uint8_t opaque = 255;

    // Width of the painted margin around the lamina, in its lengths: as much as mipmaps of a
    // quarter of the side blend in. Beyond it the image is constant. The margin is found by tiles.
    static constexpr double margin = 0.016;
    static constexpr std::size_t most_tiles = 64;

    // A range of columns of one half.
    struct Span {
        std::size_t first = 0, last = 0;
    };

    [[nodiscard]] double side() const { return static_cast<double>(count_); }
    [[nodiscard]] std::size_t column(double at) const {
        return static_cast<std::size_t>(at * side());
    }

    // How far beyond the ends of a panel is clear, in its length.
    static constexpr double clear_beyond = 0.05;

    /// Returns how far along a panel the middle of a row of texels is.
    [[nodiscard]] double along_panel(std::size_t y, const LeafPanel& panel) const {
        return (panel.root - (static_cast<double>(y) + 0.5) / side()) / panel.length;
    }

    /// Clears a row between two columns, in texture lengths, if it is one of a panel.
    void clear(std::size_t y, const LeafPanel& panel, double first, double last) {
        const double along = along_panel(y, panel);
        if (along < -clear_beyond || along > 1.0 + clear_beyond) return;
        for (std::size_t x = column(first); x < column(last); ++x)
            for (const std::size_t at : {y * count_ + x, y * count_ + x + count_ / 2})
                images_.alpha[at] = 0;
    }

    /// Paints a row of a panel.
    ///
    /// point  returns what is at a place along and across what it shows
    template <class Point>
    void paint_panel(std::size_t y, const LeafPanel& panel, const Point& point) {
        const double along = along_panel(y, panel);
        if (along < -clear_beyond || along > 1.0 + clear_beyond) return;
        const int points = count_ < 1024 ? 2 : 1;
        const std::size_t last = column(panel.middle + panel.half);
        for (std::size_t x = column(panel.middle - panel.half); x < last; ++x) {
            PanelPoint sum{};
            double covered = 0.0;
            for (int i = 0; i < points * points; ++i) {
                const int row = i / points, across = i % points;
                const double dx = (across + 0.5) / points - 0.5, dy = (row + 0.5) / points - 0.5;
                const PanelPoint one = point(
                    along - dy / (side() * panel.length),
                    ((static_cast<double>(x) + 0.5 + dx) / side() - panel.middle) / panel.half);
                if (!one.is_drawn) continue;
                covered += 1.0;
                sum.upper += one.upper;
                sum.lower += one.lower;
                sum.slope += one.slope;
                sum.open += one.open;
            }
            // What is clear has the colour of needles, which smaller copies blend in.
            if (covered == 0.0) {
                sum = point(-1.0, 0.0);
            } else {
                sum.upper /= covered;
                sum.lower /= covered;
                sum.slope /= covered;
                sum.open /= covered;
            }
            const double rough = 0.55 + 0.2 * autumn_;
            const double unit = 1.0 / std::sqrt(1.0 + glm::dot(sum.slope, sum.slope));
            const std::size_t at = y * count_ + x, below = at + count_ / 2;
            put_texel(at, painted_texel({sum.upper, sum.open, rough}));
            put_texel(below, painted_texel({sum.lower, sum.open, rough + 0.15}));
            put_normals(&images_.rgb[1][3 * at], &images_.rgb[1][3 * below], unit * sum.slope.x,
                        unit * sum.slope.y, unit);
            images_.alpha[at] = images_.alpha[below] =
                static_cast<std::uint8_t>(opaque * covered / (points * points));
        }
    }

    // A line of sample points: its position, its noise from a point on, and the state of the
    // previous lookup.
    struct Line {
        double y = 0.0;
        std::size_t from = 0;
        std::vector<float> spots, cells;
        LaminaSampler::Hint hint;
        FineVeins veins;
    };

    // Colour, occlusion and roughness.
    using Painted = std::array<std::uint8_t, 5>;

    // Finds the tiles that contain the lamina's border, its margin or its interior.
    void find_lamina_tiles() {
        const std::size_t rows = count_ / tile_, columns = rows / 2;
        shown_.assign(rows * columns, false);
        const auto tile_of = [&](double texture, std::size_t most) {
            const double at = texture * static_cast<double>(rows);
            return std::min(static_cast<std::size_t>(std::max(at, 0.0)), most - 1);
        };
        const auto show = [&](const glm::dvec2& place) {
            const glm::dvec2 low = chart_.texture_point(place + glm::dvec2(-margin, margin), true);
            const glm::dvec2 high = chart_.texture_point(place + glm::dvec2(margin, -margin), true);
            for (std::size_t i = tile_of(low.y, rows); i <= tile_of(high.y, rows); ++i)
                for (std::size_t j = tile_of(low.x, columns); j <= tile_of(high.x, columns); ++j)
                    shown_[i * columns + j] = true;
        };
        const std::vector<glm::dvec2> border = border_of(sampler_.lamina());
        for (std::size_t i = 0; i < border.size(); ++i) {
            const glm::dvec2 from = border[i], way = border[(i + 1) % border.size()] - from;
            const double steps = std::floor(glm::length(way) / margin) + 1.0;
            for (double step = 0.0; step < steps; step += 1.0) show(from + (step / steps) * way);
        }
        for (std::size_t i = 0; i < rows; ++i) {
            LaminaSampler::Hint hint;
            Span span{count_, 0};
            for (std::size_t j = 0; j < columns; ++j) {
                bool upper = false;
                const auto middle = [&](std::size_t tile) {
                    return (static_cast<double>(tile) + 0.5) / static_cast<double>(rows);
                };
                if (sampler_.at(chart_.place({middle(j), middle(i)}, upper), hint).inside)
                    shown_[i * columns + j] = true;
                if (!shown_[i * columns + j]) continue;
                span.first = std::min(span.first, j * tile_);
                span.last = (j + 1) * tile_;
            }
            spans_.push_back(span);
        }
    }

    // Writes the normals of both faces; components are in -1..1.
    static void put_normals(std::uint8_t* upper, std::uint8_t* lower, double x, double y,
                            double z) {
        const auto part = [](double share) {
            return static_cast<std::uint8_t>((0.5 + 0.5 * share) * 255.0 + 0.5);
        };
        upper[0] = part(x);
        upper[1] = part(y);
        lower[0] = part(-x);
        lower[1] = part(-y);
        upper[2] = lower[2] = part(z);
    }

    [[nodiscard]] Painted painted_texel(const Texel& texel) const {
        const auto colour = [&](int k) {
            return encoded_[static_cast<std::size_t>(
                static_cast<int>(std::clamp(texel.light[k], 0.0, 1.0) * 4096.0 + 0.5))];
        };
        return {colour(0), colour(1), colour(2), share_as_byte(texel.occlusion),
                share_as_byte(texel.roughness)};
    }

    void put_texel(std::size_t at, const Painted& texel) {
        std::copy_n(texel.begin(), 3, &images_.rgb[0][3 * at]);
        std::copy_n(texel.begin() + 3, 2, &images_.rgb[2][3 * at]);
    }

    [[nodiscard]] double along(std::size_t point) const {
        const std::size_t texel = point / points_, in_texel = point % points_;
        const double offset = (static_cast<double>(in_texel) + 0.5) / static_cast<double>(points_);
        return (static_cast<double>(texel) + offset) / static_cast<double>(count_);
    }

    [[nodiscard]] std::vector<float> noise(std::size_t feature, double y, const Span& span) const {
        const std::size_t points = (span.last - span.first) * points_;
        const std::span<const float> x =
            std::span(across_[feature]).subspan(span.first * points_, points);
        std::vector<float> out(points);
        gradient_noise(x,
                       std::vector<float>(points, static_cast<float>(y + 8.0) * features[feature]),
                       seed_ * 2U + static_cast<std::uint32_t>(feature), out);
        return out;
    }

    [[nodiscard]] Line line_at(std::size_t line, const Span& span) const {
        bool upper = false;
        const double y = chart_.place({0.0, along(line)}, upper).y;
        return {y, span.first * points_, noise(0, y, span), noise(1, y, span), {}, {}};
    }

    // Both faces show the same positions and blotches go through the leaf, so each point is looked
    // up once for both. Returns whether it is on the lamina.
    bool add_faces(Line& line, std::size_t point, Texel& upper, Texel& lower,
                   double& height) const {
        const auto blotch = static_cast<double>(line.spots[point - line.from]);
        const auto cell = static_cast<double>(line.cells[point - line.from]);
        // Veins wander, and differently on both halves.
        LaminaPlace place = sampler_.at({columns_[point] + 0.5 * vein_wander * broad_ * blotch,
                                         line.y + vein_wander * broad_ * blotch},
                                        line.hint);
        const double depth = vein_depth(place);
        if (net_ > 0.0)
            place.net = net_ * net_at(place, net_wander * blotch + 0.002 * cell, line.veins);
        const double own = std::clamp(autumn_ + blotch * autumn_ * (1.0 - autumn_), 0.0, 1.0);
        LeafColourMap::Faces faces = colour_map_.at(place, own);
        const double yellow = 0.6 * blotch, rim_yellow = smooth_step(0.6, 1.0, place.affinity);
        const double beside =
            beside_main * line_profile(place.from_main, main_reach) * (1.0 - place.homothety) +
            beside_side * line_profile(place.from_side, side_reach);
        const glm::dvec3 tint =
            (1.0 - broad_ * beside * (1.0 - depth)) *
            (1.0 + broad_ * (1.0 - autumn_) * (yellow * blotch_tint + rim_yellow * border_tint));
        faces.upper *= tint;
        faces.lower *= tint;
        if (broad_ < 1.0) {
            const double pores = (1.0 - broad_) * (1.0 - autumn_) * pores_at(place, cell);
            faces.lower += 0.75 * pores * (pore_wax - faces.lower);
            faces.upper += 0.12 * pores * (pore_wax - faces.upper);
        }
        const double mark = mark_at(marks_, blotch, cell);
        for (glm::dvec3* face : {&faces.upper, &faces.lower})
            *face +=
                std::abs(mark) * ((mark > 0.0 ? dry : rim) - *face) * (mark > 0.0 ? 0.85 : 0.4);
        for (const EatenSpot& spot : eaten_) {
            const glm::dvec2 at(columns_[point], line.y);
            const double reach = EatenSpot::farthest * spot.radius + halo_width;
            if (std::abs(at.x - spot.middle.x) > reach || std::abs(at.y - spot.middle.y) > reach)
                continue;
            const double out = spot.outside(at) + 0.003 * cell;
            const double halo = 0.5 * (1.0 - smooth_step(0.0, halo_width, out)),
                         edge = 1.0 - smooth_step(0.3 * bitten_width, bitten_width, out),
                         hole = 1.0 - smooth_step(-bitten_width, -0.5 * bitten_width, out);
            for (glm::dvec3* face : {&faces.upper, &faces.lower}) {
                *face += halo * (rim - *face);
                *face += edge * (bitten - *face);
                *face += hole * (behind - *face);
            }
        }
        const double shade = share_ * (1.0 + 0.16 * blotch + 0.1 * cell);
        const double rough = 0.08 * cell + 0.2 * autumn_;
        if (snow_ > 0.0) {
            // Patches of it, which melt from the border inwards.
            const double lies = 2.2 * snow_ - 0.9 + 0.9 * blotch + 0.25 * cell - 0.3 * rim_yellow;
            faces.upper += smooth_step(0.0, 0.12, lies) * (snow_light - faces.upper);
        }
        const double gloss = 0.1 * blotch - 0.06 * depth + 0.05 * place.net;
        upper.add(share_, shade * faces.upper, 1.0 - 0.25 * relief_ * depth, 0.48 + gloss + rough);
        lower.add(share_, shade * faces.lower, 1.0, 0.75 + rough);
        height -= share_ * relief_ * (0.006 * depth + 0.0011 * place.net - 0.0006 * cell);
        return place.inside;
    }

    void add_petiole(const Line& line, std::size_t point, Texel& texel) const {
        const double shade =
            share_ * (0.8 + 0.2 * static_cast<double>(line.spots[point - line.from]));
        const auto cell = static_cast<double>(line.cells[point - line.from]);
        texel.add(share_, shade * petiole_, 1.0, 0.75 + 0.08 * cell + 0.2 * autumn_);
    }

    LaminaSampler sampler_;
    bool has_shoots_, has_sprays_;  // beside the lamina
    LeafChart chart_;
    LeafColourMap colour_map_;
    const std::array<std::uint8_t, 4097>& encoded_ = encoded_table();
    double autumn_, snow_, relief_, net_, marks_;
    double broad_;  // 0 for a needle, 1 for a blade
    std::vector<EatenSpot> eaten_;
    std::uint32_t seed_;
    std::size_t count_;   // texels in a row
    std::size_t points_;  // per texel in each direction, because veins are narrow
    double share_;        // weight of a point in its texel
    glm::dvec3 petiole_{0.0};
    std::vector<double> columns_;               // x in the plane of the lamina, by point
    std::array<std::vector<float>, 2> across_;  // the same in units of the noise lattice
    std::size_t tile_;                          // texels across
    std::vector<bool> shown_;                   // by row and column of tiles: not constant
    std::vector<Span> spans_;                   // of each row of tiles
    std::array<Bytes, 3> flat_;                 // a row of each image outside the leaf
    std::vector<float> heights_;                // of the upper face, in lengths of the lamina
    std::vector<float> on_lamina_;              // share of each texel of the upper face, for sprays
    std::optional<SprayPainter> sprays_;
    std::optional<ShootPainter> shoots_;
    RawImages images_;
};

}  // namespace

bool has_shoot(const Venation& venation) {
    return is_slim(lamina_of(venation, leaf_steps(venation, 0)));
}

bool shows_shoots(const LeafShape& shape) {
    return shape.leaflets.count > 0 && shape.leaflets.turn_deg != 180.0 &&
           has_shoot(shape.venation);
}

RawImages leaf_images(const LeafShape& shape, const LeafPalette& palette, double autumn,
                      std::uint32_t seed, int side, LeafLayout layout, double snow,
                      const Parallel& parallel) {
    std::vector<Problem> problems;
    check(shape, Info{.name = ""}, "", problems);
    check(palette, Info{.name = ""}, "", problems);
    if (side < 16 || side > 2048 || (side & (side - 1)) != 0)
        report(problems, "/side", std::to_string(side) + " is no power of two in 16..2048");
    if (!(autumn >= 0.0 && autumn <= 1.0)) report(problems, "/autumn", "is outside 0..1");
    if (!(snow >= 0.0 && snow <= 1.0)) report(problems, "/snow", "is outside 0..1");
    if (!problems.empty()) throw InvalidInput(std::move(problems));

    LeafPainter painter(shape, palette, autumn, seed, static_cast<std::size_t>(side), layout, snow);
    for_each_row(side, parallel, [&](std::size_t y) { painter.colour_row(y); });
    for_each_row(side, parallel, [&](std::size_t y) { painter.normal_row(y); });
    painter.take_leaf();
    for_each_row(side, parallel, [&](std::size_t y) { painter.panel_row(y); });
    return painter.take();
}

}  // namespace sporeprint
