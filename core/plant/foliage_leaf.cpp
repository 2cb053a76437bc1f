#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/math/principal_axes.h"
#include "core/mesh/measure.h"
#include "core/plant/lamina.h"
#include "core/plant/leaf_image.h"
#include "core/plant/leaf_shell.h"
#include "core/plant/leaf_spray.h"

namespace sporeprint {

namespace {

double area_of(const std::vector<glm::dvec2>& border) {
    double twice = 0.0;
    for (std::size_t i = 0; i < border.size(); ++i) {
        const glm::dvec2 a = border[i], b = border[(i + 1) % border.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

double twice_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Returns the right half of a border, from the root to the tip, reduced to `count` corners: the
// corner whose removal changes the area least is removed first. All remain visible from the centre.
std::vector<glm::dvec2> simplified(std::vector<glm::dvec2> half, const glm::dvec2& centre,
                                   std::size_t count) {
    const auto ahead = [&](std::size_t a, std::size_t b) {
        return twice_area(centre, half[a], half[b]) > 1e-6;
    };
    // Of two corners in the same direction from the centre the nearer one is removed.
    for (std::size_t i = 0; i + 1 < half.size();) {
        if (ahead(i, i + 1) || half.size() == 2) {
            ++i;
            continue;
        }
        const bool first_goes =
            i > 0 && (i + 2 == half.size() ||
                      glm::distance(half[i], centre) < glm::distance(half[i + 1], centre));
        half.erase(half.begin() + static_cast<long>(first_goes ? i : i + 1));
        i -= i > 0 ? 1 : 0;
    }
    while (half.size() > count) {
        std::size_t least = 0;
        double smallest = 1e300;
        for (std::size_t i = 1; i + 1 < half.size(); ++i) {
            if (!ahead(i - 1, i + 1)) continue;
            const double loss = std::abs(twice_area(half[i - 1], half[i], half[i + 1]));
            if (loss >= smallest) continue;
            smallest = loss;
            least = i;
        }
        if (least == 0) break;
        half.erase(half.begin() + static_cast<long>(least));
    }
    return half;
}

}  // namespace

double lamina_area(const LeafShape& shape) {
    if (shape.leaflets.count > 0) {
        double squares = 0.0;
        for (const PlacedLeaflet& one : placed_leaflets(shape.leaflets))
            squares += one.size * one.size;
        return squares * lamina_area(leaflet_of(shape)) * shape.length * shape.length;
    }
    return area_of(border_of(lamina_of(shape.venation, leaf_steps(shape.venation, 0)))) *
           shape.length * shape.length;
}

namespace {

/// Scales the right half of a border, from the root to the tip, to the length and width of the
/// whole border, and moves the corners that are neither widest nor tip inwards until the areas are
/// equal.
void stretch(std::vector<glm::dvec2>& half, glm::dvec2& centre,
             const std::vector<glm::dvec2>& whole) {
    glm::dvec2 low(0.0), high(0.0);
    for (const glm::dvec2& place : whole) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    const auto widest = static_cast<std::size_t>(
        std::max_element(half.begin(), half.end(),
                         [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x; }) -
        half.begin());
    double lowest = 0.0, highest = 0.0;
    for (const glm::dvec2& place : half) {
        lowest = std::min(lowest, place.y);
        highest = std::max(highest, place.y);
    }
    if (half[widest].x < 1e-9 || highest < 1e-9) return;
    const double wider = high.x / half[widest].x, longer = high.y / highest,
                 deeper = lowest < -1e-9 ? std::clamp(low.y / lowest, 0.5, 2.0) : 1.0;
    for (glm::dvec2& place : half) {
        place.x *= wider;
        place.y *= place.y < 0.0 ? deeper : longer;
    }
    centre.y *= longer;
    // Twice the area of the half is the sum over its corners of x times the difference in y of the
    // two neighbours.
    double fixed = 0.0, drawn = 0.0;
    for (std::size_t i = 1; i + 1 < half.size(); ++i)
        (i == widest ? fixed : drawn) += half[i].x * (half[i + 1].y - half[i - 1].y);
    if (drawn <= 0.0) return;
    double share = std::clamp((area_of(whole) - fixed) / drawn, 0.2, 1.0);
    const std::vector<glm::dvec2> before = half;
    for (int tries = 0; tries < 8; ++tries, share += 0.3 * (1.0 - share)) {
        bool seen = true;
        for (std::size_t i = 1; i + 1 < half.size(); ++i)
            half[i].x = (i == widest ? 1.0 : share) * before[i].x;
        for (std::size_t i = 0; i + 1 < half.size(); ++i)
            seen = seen && twice_area(centre, half[i], half[i + 1]) > 1e-6;
        if (seen) return;
    }
    half = before;
}

}  // namespace

namespace {

// A leaf to simplify: itself, or the star that stands for a compound one.
struct Model {
    LeafShape shape;
    LeafChart chart;
    double area;  // of the lamina, in squares of its length
    bool is_star = false;
    const LeafPanel* card = nullptr;  // what a card shows; null for a leaf that is none
};

// Returns the place in the image of a place of a card: from -1 to 1 across, from 0 at its root to 1.
glm::dvec2 card_texture(const LeafPanel& panel, const glm::dvec2& place, bool upper) {
    return {(upper ? 0.0 : 0.5) + panel.middle + panel.half * place.x,
            panel.root - panel.length * place.y};
}

// Longest side veins of a star, in edges of its middle vein: of leaflets in a plane, and of needles all round a shoot,
// whose star would be a broad blade and not a twig.
constexpr double widest_star = 3.0, widest_shoot = 0.9;

// Share of the triangle of a card that the needles of a spray of shoots cover, and the length of a spray that covers
// as much as a shoot, in that of the shoot.
constexpr double covered_by_shoots = 0.68, spray_of_shoot = 0.69;

Model model_of(const LeafShape& shape, LeafLayout layout) {
    const double area = lamina_area(shape) / (shape.length * shape.length);
    if (shape.leaflets.count == 0)
        return {shape, chart_of(lamina_of(shape.venation, leaf_steps(shape.venation, 0)), layout),
                area};
    if (shows_shoots(shape))
        return {shape, {}, 2.0 * shoot_panel.half_breadth, false, &shoot_panel};
    Model model{star_of(shape), {}, area, true};
    // The star has the area of all leaflets as far as it can be wide, and shows the middle of the image of one.
    Venation& veins = model.shape.venation;
    const auto border_at = [&] { return border_of(lamina_of(veins, 1)); };
    const double widest = shape.leaflets.turn_deg == 180.0 ? widest_star : widest_shoot;
    veins.side_length = std::clamp(veins.side_length * area / area_of(border_at()), 0.1, widest);
    // Many long leaflets cover each other.
    model.area = std::min(area, area_of(border_at()));
    const auto half_width = [](const std::vector<glm::dvec2>& border) {
        double half = 0.0;
        for (const glm::dvec2& place : border) half = std::max(half, place.x);
        return half;
    };
    const Venation& leaflet = shape.venation;
    const Lamina shown = lamina_of(leaflet, leaf_steps(leaflet, 0));
    const LeafChart chart = chart_of(shown);
    const double share =
        std::min(0.9, 0.8 * half_width(border_of(shown)) / half_width(border_at()));
    const glm::dvec2 middle(0.0, 0.5);
    model.chart = {middle + (chart.corner - middle) / share, chart.scale * share};
    return model;
}

// The border of a model: its right half from the root to the tip, reduced to a few corners, and the
// place from which all of it is seen.
struct Outline {
    std::vector<glm::dvec2> half;
    glm::dvec2 centre;
};

Outline outline_of(const Model& model, std::size_t corners, Preserved preserved) {
    const LeafShape& shape = model.shape;
    const Lamina lamina = lamina_of(shape.venation, leaf_steps(shape.venation, 0));
    // The border is straight between the ends of veins; otherwise all corners would be spent on the
    // bays of a frond.
    Venation plain = shape.venation;
    plain.teeth = 0.0;
    if (!model.is_star) plain.sinus = 0.0;
    const Lamina outline = lamina_of(plain, plain.lobes.value == 1 && !model.is_star ? 2 : 1);
    const Lobe& middle = outline.lobes[outline.lobes.size() / 2];
    glm::dvec2 centre(0.0, outline.lobes.size() > 1 ? 0.3 : 0.5);
    const glm::dvec2 tip = middle.place(0, middle.reach, 0.0);
    std::vector<glm::dvec2> half;
    for (const glm::dvec2& place : border_of(outline)) {
        half.push_back(place);
        if (place == tip) break;
    }
    half = simplified(half, centre, corners);
    if (preserved == Preserved::extent) stretch(half, centre, border_of(lamina));
    return {std::move(half), centre};
}

// Returns the whole border of which one half is given.
std::vector<glm::dvec2> mirrored(const std::vector<glm::dvec2>& half) {
    std::vector<glm::dvec2> border = half;
    for (std::size_t i = half.size() - 2; i > 0; --i) border.emplace_back(-half[i].x, half[i].y);
    return border;
}

// Returns both faces as fans about a centre.
//
// border     all round, as seen from above
// stretch    of the border and the centre across and along
// thickness  at the centre
// texture    called with a place of the border, or the centre, and whether the upper face is meant
template <class Texture>
Shell fan_shell(const std::vector<glm::dvec2>& border, const glm::dvec2& centre,
                const glm::dvec2& stretch, double thickness, const Bending& bent,
                const Texture& texture) {
    Shell shell;
    const auto count = static_cast<std::uint32_t>(border.size());
    for (const bool upper : {true, false}) {
        for (const glm::dvec2& place : border)
            shell.add(bent.at(stretch * place, 0.0), texture(place, upper));
        const double lift = upper ? 0.5 * thickness : -0.5 * thickness;
        shell.add(bent.at(stretch * centre, lift), texture(centre, upper));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count, below = count + 1;
        shell.triangles.push_back({i, next, count});
        shell.triangles.push_back({below + next, below + i, below + count});
    }
    return shell;
}

// Returns the border of a card, from -1 to 1 across and from 0 to 1 along, with so many corners on either
// side.
std::vector<glm::dvec2> border_of_card(std::size_t corners) {
    std::vector<glm::dvec2> border;
    for (const double side : {1.0, -1.0})
        for (std::size_t i = 0; i < corners; ++i) {
            const double up = static_cast<double>(i) / static_cast<double>(corners - 1);
            border.emplace_back(side, side > 0.0 ? up : 1.0 - up);
        }
    return border;
}

Shell simplified_shell(const Model& model, const Bending& bent, std::size_t triangles,
                       Preserved preserved) {
    const double thickness = model.shape.thickness;
    if (model.card)
        return fan_shell(border_of_card(triangles / 4), {0.0, 0.5}, {model.card->half_breadth, 1.0},
                         thickness, bent, [&](const glm::dvec2& place, bool upper) {
                             return card_texture(*model.card, place, upper);
                         });
    const Outline outline = outline_of(model, triangles / 4 + 1, preserved);
    const std::vector<glm::dvec2> border = mirrored(outline.half);
    const double grown =
        preserved == Preserved::area ? std::sqrt(model.area / area_of(border)) : 1.0;
    return fan_shell(border, outline.centre, glm::dvec2(grown), thickness, bent,
                     [&](const glm::dvec2& place, bool upper) {
                         return model.chart.texture_point(place, upper);
                     });
}

/// Returns a leaf without a centre, folded along the line from its root to its tip; of no triangles if
/// one of its halves is not seen from the root.
///
/// texture  called with a place of the lamina and whether its upper face is meant
template <class Texture>
Shell folded_shell(const std::vector<glm::dvec2>& half, double area, const Bending& bent,
                   std::size_t triangles, const Texture& texture) {
    Shell shell;
    if (half.size() != triangles / 4 + 2) return shell;
    for (std::size_t i = 1; i + 1 < half.size(); ++i)
        if (!(twice_area(half[0], half[i], half[i + 1]) > 1e-6)) return shell;
    const std::vector<glm::dvec2> border = mirrored(half);
    const double grown = std::sqrt(area / area_of(border));
    const auto count = static_cast<std::uint32_t>(border.size()),
               tip = static_cast<std::uint32_t>(half.size() - 1);
    for (const bool upper : {true, false})
        for (const glm::dvec2& place : border)
            shell.add(bent.at(grown * place, 0.0), texture(place, upper));
    for (std::uint32_t i = 1; i + 1 < count; ++i) {
        // The left half ends where the right one begins, at the tip.
        if (i == tip) continue;
        shell.triangles.push_back({0, i, i + 1});
        shell.triangles.push_back({count, count + i + 1, count + i});
    }
    shell.triangles.push_back({0, tip, tip + 1});
    shell.triangles.push_back({count, count + tip + 1, count + tip});
    return shell;
}

/// Returns the flat leaf of two or four triangles.
///
/// share  its area by that of the lamina
Shell flat_shell(const Model& model, std::size_t triangles, double share) {
    // A needle is as thick as broad: its plane is that of its middle surface.
    Model thin = model;
    thin.shape.thickness = 0.0;
    const auto finest = [](const Model& one) {
        return simplified_shell(one, Bending(one.shape), most_foliage_triangles, Preserved::area)
            .mesh(1.0);
    };
    const Mesh fine = finest(thin);
    const SurfaceMoments of = surface_moments(fine);
    const PrincipalAxes axes = principal_axes(of.covariance);
    // A leaf may be broader than long.
    const std::size_t first =
        std::abs(axes.directions[0].z) >= std::abs(axes.directions[1].z) ? 0 : 1;
    glm::dvec3 along = axes.directions[first], across = axes.directions[1 - first];
    if (along.z < 0.0) along = -along;
    if (glm::cross(along, across).y < 0.0) across = -across;
    const double slender = std::sqrt(axes.variances[first] / axes.variances[1 - first]);
    const double area = 0.5 * share * of.area;  // of one face
    // Corners of a face, along and across. The variance along a kite is a sixth of the square of
    // half its length, along a rectangle a third, along a triangle an eighteenth of that of its length;
    // across a triangle it is a sixth of the square of half its base.
    std::vector<glm::dvec2> corners, of_card;
    if (triangles == 2) {
        const double half_base = std::sqrt(area / (std::sqrt(3.0) * slender)),
                     length = area / half_base;
        corners = {
            {-length / 3.0, half_base}, {-length / 3.0, -half_base}, {2.0 * length / 3.0, 0}};
        of_card = {{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}};
    } else if (model.card) {
        const double half_breadth = std::sqrt(0.25 * area / slender),
                     half_length = slender * half_breadth;
        corners = {{-half_length, half_breadth},
                   {-half_length, -half_breadth},
                   {half_length, -half_breadth},
                   {half_length, half_breadth}};
        of_card = {{1.0, 0.0}, {-1.0, 0.0}, {-1.0, 1.0}, {1.0, 1.0}};
    } else {
        const double half_breadth = std::sqrt(0.5 * area / slender),
                     half_length = slender * half_breadth;
        corners = {
            {-half_length, 0.0}, {0.0, -half_breadth}, {half_length, 0.0}, {0.0, half_breadth}};
    }
    // It shows a part of the image that is a little larger than itself: the border of a lamina, with
    // the pale tips of needles, is a larger part of its area than of a kite's.
    constexpr double shown = 1.15;
    Model pressed = thin;
    pressed.shape.curl_deg = pressed.shape.fold_deg = pressed.shape.wave = 0.0;
    const double middle = surface_moments(finest(pressed)).middle.z;
    const double side = across.x < 0.0 ? 1.0 : -1.0;
    Shell shell;
    for (const bool upper : {true, false})
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2 corner = corners[i];
            shell.add(of.middle + corner.x * along + corner.y * across,
                      model.card
                          ? card_texture(*model.card, of_card[i], upper)
                          : model.chart.texture_point(
                                {shown * side * corner.y, middle + shown * corner.x}, upper));
        }
    const auto count = static_cast<std::uint32_t>(corners.size());
    for (std::uint32_t i = 2; i < count; ++i) {
        shell.triangles.push_back({0, i - 1, i});
        shell.triangles.push_back({count, count + i, count + i - 1});
    }
    return shell;
}

}  // namespace

Shell foliage_shell(const LeafShape& shape, const Bending& bent, std::size_t triangles,
                    Preserved preserved) {
    return simplified_shell(model_of(shape, LeafLayout::alone), bent, triangles, preserved);
}

namespace {

void require_triangles(std::size_t triangles) {
    if (triangles == 2 ||
        (triangles >= 4 && triangles <= most_foliage_triangles && triangles % 4 == 0))
        return;
    throw InvalidInput("/triangles", std::to_string(triangles) + " is not 2, 4, 8, 12 or 16");
}

/// Returns the share of a card that a spray covers.
double covered_by(const LeafShape& shape, std::size_t triangles, LeafGroup spray) {
    // All leaves are within the triangle, which is half of the card.
    return (triangles == 2 ? 1.0 : 0.5) * covered_share(shape, spray);
}

/// Returns the length of a card whose spray covers as much as a leaf, in lengths of the leaf.
double length_of(const LeafShape& shape, std::size_t triangles, LeafGroup spray) {
    const double area = 2.0 * panel_of(spray).half_breadth * covered_by(shape, triangles, spray);
    return std::sqrt(lamina_area(shape) / area) / shape.length;
}

}  // namespace

GroupLeaf leaf_of_group(const LeafShape& shape, std::size_t triangles, LeafGroup group,
                        double share) {
    const bool is_spray = shows_sprays(shape);
    if (group == LeafGroup::leaf || !(is_spray || shows_shoots(shape)))
        return {foliage_leaf(shape, triangles, share, layout_on_trees(shape))};
    throw_if_invalid(shape);
    require_triangles(triangles);
    Model model{shape, {}, 0.0, false, is_spray ? &panel_of(group) : &spray_panel};
    model.area = 2.0 * model.card->half_breadth;
    const Shell shell =
        triangles <= 4 ? flat_shell(model, triangles, share)
                       : simplified_shell(model, Bending(model.shape), triangles, Preserved::area);
    if (!is_spray) return {shell.mesh(shape.length * spray_of_shoot), covered_by_shoots};
    return {shell.mesh(shape.length * length_of(shape, triangles, group)),
            covered_by(shape, triangles, group)};
}

Mesh foliage_leaf(const LeafShape& shape, std::size_t triangles, double share, LeafLayout layout) {
    throw_if_invalid(shape);
    require_triangles(triangles);
    if (triangles <= 4)
        return flat_shell(model_of(shape, layout), triangles, share).mesh(shape.length);
    const Model model = model_of(shape, layout);
    return simplified_shell(model, Bending(model.shape), triangles, Preserved::area)
        .mesh(shape.length);
}

namespace {

// How far the card of a shoot is folded.
constexpr double card_fold_deg = 22.0;

/// Returns a card of four triangles, or of eight that are folded along what it shows.
Shell folded_card(const LeafShape& shape, const LeafPanel& panel, std::size_t triangles) {
    LeafShape card = shape;
    card.fold_deg = card_fold_deg;
    card.wave = 0.0;
    const Bending bent(card);
    const std::vector<double> columns =
        triangles == 4 ? std::vector<double>{1.0, -1.0} : std::vector<double>{1.0, 0.0, -1.0};
    Shell shell;
    const auto count = static_cast<std::uint32_t>(2 * columns.size());
    for (const bool upper : {true, false})
        for (const double up : {0.0, 1.0})
            for (const double across : columns)
                shell.add(bent.at({panel.half_breadth * across, up}, 0.0),
                          card_texture(panel, {across, up}, upper));
    const std::uint32_t row = count / 2;
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
        const std::array<std::array<std::uint32_t, 3>, 2> quad = {
            {{i, row + i, row + i + 1}, {i, row + i + 1, i + 1}}};
        for (const auto& [a, b, c] : quad) {
            shell.triangles.push_back({a, b, c});
            shell.triangles.push_back({count + a, count + c, count + b});
        }
    }
    return shell;
}

/// Appends a shell, turned by a right angle about the line from its root to its tip.
void append_crossed(Shell& shell, const Shell& other) {
    const auto shift = static_cast<std::uint32_t>(shell.places.size());
    for (const glm::dvec3& place : other.places)
        shell.places.emplace_back(-place.y, place.x, place.z);
    shell.texture.insert(shell.texture.end(), other.texture.begin(), other.texture.end());
    for (const auto& [a, b, c] : other.triangles)
        shell.triangles.push_back({a + shift, b + shift, c + shift});
}

}  // namespace

std::size_t finest_leaf_vertices(std::size_t triangles) {
    return triangles + (triangles <= 8 ? 4 : 8);
}

Mesh finest_foliage_leaf(const LeafShape& shape, std::size_t triangles, LeafGroup group) {
    throw_if_invalid(shape);
    const bool is_blade = triangles == 4 || triangles == 8;
    if (group != LeafGroup::leaf && shows_sprays(shape))
        return is_blade ? folded_card(shape, panel_of(group), triangles)
                              .mesh(shape.length * length_of(shape, triangles, group))
                        : leaf_of_group(shape, triangles, group).mesh;
    Shell folded;
    if (shape.leaflets.count == 0 && is_blade) {
        const Model model = model_of(shape, layout_on_trees(shape));
        folded =
            folded_shell(outline_of(model, triangles / 4 + 2, Preserved::area).half, model.area,
                         Bending(shape), triangles, [&](const glm::dvec2& place, bool upper) {
                             return model.chart.texture_point(place, upper);
                         });
    } else if (shows_shoots(shape) && (is_blade || triangles == 12 || triangles == 16)) {
        const bool is_spray = group != LeafGroup::leaf;
        const LeafPanel& panel = is_spray ? spray_panel : shoot_panel;
        folded = folded_card(shape, panel, std::min<std::size_t>(triangles, 8));
        // A second card stands square to the first.
        if (!is_blade) append_crossed(folded, folded_card(shape, panel, triangles - 8));
        return folded.mesh(shape.length * (is_spray ? spray_of_shoot : 1.0));
    }
    return folded.triangles.empty() ? foliage_leaf(shape, triangles, 1.0, layout_on_trees(shape))
                                    : folded.mesh(shape.length);
}

}  // namespace sporeprint
