#include "core/plant/leaf_spray.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/plant/lamina.h"
#include "core/plant/leaf_image.h"

namespace sporeprint {

namespace {

// The lamina is below both: chart_of() with LeafLayout::with_sprays.
constexpr LeafPanel twig_panel{0.37, 0.115, 0.42, 0.905, 0.42},
    branch_panel{0.25, 0.235, 0.5, 0.465, 0.44};

// Length of a petiole in that of its lamina, half the breadth of a twig in the length of a spray.
constexpr double petiole_length = 0.12, half_twig = 0.007, half_petiole = 0.005,
                 half_branch = 0.010;

// A leaf of a twig before random deviations.
struct Station {
    double along, angle_deg, size;
};

// Leaves are alternate along a twig, on either side in turn, and one ends it.
constexpr Station stations[] = {{0.05, 84.0, 0.33},
                                {0.13, -80.0, 0.33},
                                {0.24, 62.0, 0.29},
                                {0.34, -54.0, 0.27},
                                {0.48, 3.0, 0.42}};

// Twigs on either side of a branch.
constexpr int twigs_on_side = 5;

// Groups of more leaves are branches.
constexpr double most_on_twig = 6.0;

std::size_t index_of(LeafGroup spray) { return spray == LeafGroup::twig ? 0 : 1; }

// Returns a leaf with its own deviations.
SprayLeaf leaf_at(const glm::dvec2& root, double angle_deg, double size, Random& random) {
    SprayLeaf leaf{root, angle_deg + 14.0 * (random.uniform() - 0.5),
                   size * (0.88 + 0.24 * random.uniform()), 0.86 + 0.28 * random.uniform()};
    leaf.slope = {0.7 * (random.uniform() - 0.5), 0.7 * (random.uniform() - 0.5)};
    return leaf;
}

// Appends a twig with alternate leaves and one at its end.
//
// length, leaf  of the twig and of a lamina
void add_twig(const glm::dvec2& root, double angle_deg, double length, double leaf,
              SprayParts& parts, Random& random) {
    const SineCosine turn = sine_cosine(radians(angle_deg));
    const glm::dvec2 way(turn.sine, turn.cosine);
    const int beside = static_cast<int>(std::floor(length / (0.8 * leaf)));
    double last = std::max(0.0, length - 0.9 * leaf);
    parts.leaves.push_back(leaf_at(root + last * way, angle_deg, leaf, random));
    for (int k = 0; k < beside; ++k) {
        const double at = length * (k + 0.5) / (beside + 0.5);
        last = std::max(last, at);
        const double side = k % 2 == 0 ? 1.0 : -1.0;
        parts.leaves.push_back(
            leaf_at(root + at * way, angle_deg + 58.0 * side, 0.95 * leaf, random));
    }
    parts.wood.push_back({root, root + last * way, half_twig});
}

}  // namespace

bool shows_sprays(const LeafShape& shape) {
    return shape.leaflets.count == 0 && !has_shoot(shape.venation);
}

LeafLayout layout_on_trees(const LeafShape& shape) {
    return shows_sprays(shape) ? LeafLayout::with_sprays : LeafLayout::alone;
}

LeafGroup group_of(double leaves) {
    // A leaf in place of one or two looks like them.
    if (leaves <= 2.0) return LeafGroup::leaf;
    return leaves < most_on_twig ? LeafGroup::twig : LeafGroup::branch;
}

const LeafPanel& panel_of(LeafGroup spray) {
    return spray == LeafGroup::twig ? twig_panel : branch_panel;
}

SprayParts parts_of(LeafGroup spray, std::uint32_t seed) {
    Random random(seed, purposes::leaf_spray, static_cast<std::uint32_t>(spray));
    SprayParts parts;
    if (spray == LeafGroup::twig) {
        for (const Station& one : stations)
            parts.leaves.push_back(leaf_at({0.0, one.along}, one.angle_deg, one.size, random));
        parts.wood.push_back(
            {{0.0, 0.0}, {0.0, stations[std::size(stations) - 1].along}, half_twig});
        return parts;
    }
    constexpr double lamina = 0.16;
    const double half = branch_panel.half_breadth;
    for (int k = 0; k < 2 * twigs_on_side; ++k) {
        const double along = 0.03 + 0.66 * k / (2.0 * twigs_on_side - 1.0),
                     side = k % 2 == 0 ? 1.0 : -1.0, angle = 78.0 - 30.0 * along;
        // A twig ends at the border of the triangle.
        const SineCosine turn = sine_cosine(radians(angle));
        const double length = 0.94 * half * (1.0 - along) / (turn.sine + half * turn.cosine);
        add_twig({0.0, along}, side * angle, length, lamina * (1.0 - 0.25 * along), parts, random);
    }
    add_twig({0.0, 0.6}, 0.0, 0.36, 0.8 * lamina, parts, random);
    parts.wood.push_back({{0.0, 0.0}, {0.0, 0.62}, half_branch});
    return parts;
}

double covered_share(const LeafShape& shape, LeafGroup spray) {
    double squares = 0.0;
    for (const SprayLeaf& leaf : parts_of(spray, 1).leaves) squares += leaf.size * leaf.size;
    const double lamina = lamina_area(shape) / (shape.length * shape.length);
    return std::clamp(squares * lamina / panel_of(spray).half_breadth, 0.1, 0.9);
}

SprayPainter::SprayPainter(const LeafChart& chart, std::span<const std::uint8_t> colours,
                           std::span<const float> covered, std::size_t side, const glm::dvec3& twig,
                           std::uint32_t seed)
    : chart_(chart), columns_(side / 4), rows_(side / 2), texels_(columns_ * rows_), twig_(twig) {
    float all = 0.0F;
    glm::vec3 upper(0.0F), lower(0.0F);
    const auto light = [&](std::size_t texel) {
        const auto part = [&](std::size_t k) {
            return static_cast<float>(srgb_to_linear(colours[3 * texel + k] / 255.0));
        };
        return glm::vec3(part(0), part(1), part(2));
    };
    for (std::size_t y = 0; y < rows_; ++y)
        for (std::size_t x = 0; x < columns_; ++x) {
            Texel& one = texels_[y * columns_ + x];
            for (std::size_t k = 0; k < 4; ++k) {
                const std::size_t row = 2 * y + k / 2, column = 2 * x + k % 2;
                const float share = covered[row * (side / 2) + column];
                if (share <= 0.0F) continue;
                one.covered += share;
                one.upper += share * light(row * side + column);
                one.lower += share * light(row * side + column + side / 2);
            }
            if (one.covered <= 0.0F) continue;
            all += one.covered;
            upper += one.upper;
            lower += one.lower;
            one.upper /= one.covered;
            one.lower /= one.covered;
            one.covered *= 0.25F;
        }
    if (all > 0.0F) {
        mean_upper_ = glm::dvec3(upper / all);
        mean_lower_ = glm::dvec3(lower / all);
    }
    for (const LeafGroup spray : all_sprays) {
        SprayParts parts = parts_of(spray, seed);
        Drawn& drawn = drawn_[index_of(spray)];
        drawn.wood = std::move(parts.wood);
        for (const SprayLeaf& leaf : parts.leaves) {
            const SineCosine turn = sine_cosine(radians(leaf.angle_deg));
            drawn.leaves.push_back({leaf, {turn.sine, turn.cosine}, {turn.cosine, -turn.sine}});
        }
    }
}

const SprayPainter::Texel* SprayPainter::texel_at(const glm::dvec2& place) const {
    const glm::dvec2 at = chart_.texture_point(place, true) * static_cast<double>(rows_);
    if (!(at.x >= 0.0 && at.y >= 0.0)) return nullptr;
    const auto x = static_cast<std::size_t>(at.x), y = static_cast<std::size_t>(at.y);
    if (x >= columns_ || y >= rows_) return nullptr;
    const Texel& one = texels_[y * columns_ + x];
    return one.covered >= 0.5F ? &one : nullptr;
}

PanelPoint SprayPainter::at(LeafGroup spray, double along, double across) const {
    const auto& [placed, wood] = drawn_[index_of(spray)];
    const glm::dvec2 place(across * panel_of(spray).half_breadth, along);
    for (std::size_t i = placed.size(); i-- > 0;) {
        const Placed& one = placed[i];
        const glm::dvec2 from = place - one.leaf.root;
        const double stem = petiole_length * one.leaf.size, up = glm::dot(from, one.along),
                     right = glm::dot(from, one.right);
        const Texel* texel = texel_at(glm::dvec2(right, up - stem) / one.leaf.size);
        if (texel != nullptr) {
            // Leaves above take light from those below; both halves stand up a little.
            const double open =
                0.85 + 0.3 * (static_cast<double>(i) + 1.0) / static_cast<double>(placed.size());
            const double fold = -0.3 * std::clamp(8.0 * right / one.leaf.size, -1.0, 1.0);
            return {one.leaf.light * open * glm::dvec3(texel->upper),
                    one.leaf.light * open * glm::dvec3(texel->lower),
                    (one.leaf.slope.x + fold) * one.right + one.leaf.slope.y * one.along,
                    std::min(open, 1.0)};
        }
        if (up > 0.0 && up < 1.1 * stem && std::abs(right) < half_petiole)
            return {0.8 * twig_, 0.8 * twig_, {}, 0.7};
    }
    for (const SprayWood& one : wood) {
        const glm::dvec2 way = one.to - one.from, at = place - one.from;
        const double t = std::clamp(glm::dot(at, way) / glm::dot(way, way), 0.0, 1.0);
        if (glm::distance(at, t * way) < one.half_breadth * (1.0 - 0.5 * t))
            return {0.6 * twig_, 0.6 * twig_, {}, 0.6};
    }
    return {0.9 * mean_upper_, 0.9 * mean_lower_, {}, 0.8, false};
}

}  // namespace sporeprint
