#include "core/trace/photo_colours.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "core/trace/colour_sample.h"
#include "core/trace/contour.h"
#include "core/trace/lab.h"
#include "core/trace/skin_patch.h"

namespace sporeprint::trace {

namespace {

/// Returns the place on a line that is nearest to a point.
std::size_t nearest_on(const std::vector<glm::dvec2>& line, const glm::dvec2& point) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        if (glm::length(line[i] - point) < glm::length(line[nearest] - point)) nearest = i;
    return nearest;
}

/// Heights in a cap, and the shares of its meridian that are seen there.
class CapPlaces {
  public:
    explicit CapPlaces(const Traced& traced)
        : margin_(0.5 * (traced.margins[0] + traced.margins[1])) {
        // From the side the inside of a funnel or cup is hidden.
        if (traced.left.empty() || traced.right.empty() || is_hollow(traced.form)) return;
        const glm::dvec2 up = traced.left.back() - margin_;
        if (glm::dot(up, up) < 1.0) return;
        up_ = up / glm::dot(up, up);
        for (std::size_t side = 0; side < 2; ++side)
            add(side == 0 ? traced.left : traced.right, traced.margins[side]);
        is_known_ = true;
    }

    /// Returns the share of the meridian from the apex to a pixel of the cap; none for a pixel below it.
    [[nodiscard]] std::optional<double> share(const glm::dvec2& pixel) const {
        const double height = glm::dot(pixel - margin_, up_);
        if (!is_known_ || height < 0.0) return std::nullopt;
        const auto row = std::min(static_cast<std::size_t>(height * rows), rows - 1);
        return 1.0 - 0.5 * from_margin_[row];
    }

  private:
    static constexpr std::size_t rows = 128;
    glm::dvec2 margin_, up_{0.0};
    bool is_known_ = false;
    std::array<double, rows> from_margin_{};  // sums of both sides

    void add(const std::vector<glm::dvec2>& side, const glm::dvec2& margin) {
        const std::vector<glm::dvec2> cap(
            side.begin() + static_cast<std::ptrdiff_t>(nearest_on(side, margin)), side.end());
        const std::vector<double> arcs = arc_lengths(cap);
        // The first place that is as high as a row: what is beyond it is hidden.
        std::size_t at = 0;
        for (std::size_t row = 0; row < rows; ++row) {
            const double height = (static_cast<double>(row) + 0.5) / static_cast<double>(rows);
            while (at + 1 < cap.size() && glm::dot(cap[at] - margin_, up_) < height) ++at;
            from_margin_[row] += arcs.back() > 0.0 ? arcs[at] / arcs.back() : 1.0;
        }
    }
};

glm::dvec3 lab_of(Colour colour) { return trace::lab_of(glm::dvec3(colour.r, colour.g, colour.b)); }

Colour colour_of(const glm::dvec3& lab) {
    const glm::dvec3 rgb = rgb_of(lab);
    const auto whole = [](double value) { return static_cast<std::uint8_t>(value + 0.5); };
    return {whole(rgb.x), whole(rgb.y), whole(rgb.z)};
}

/// Returns the colour of evenly spaced ones at a share of the way; `first` and `last` are the places of
/// the first and the last one.
template <class At>
glm::dvec3 between(std::size_t count, double first, double last, double share, At at) {
    if (count == 1) return at(0);
    const double place =
        std::clamp((share - first) / (last - first), 0.0, 1.0) * static_cast<double>(count - 1);
    const auto below = std::min(static_cast<std::size_t>(place), count - 2);
    const double part = place - static_cast<double>(below);
    return (1.0 - part) * at(below) + part * at(below + 1);
}

glm::dvec3 on_ramp(const std::vector<Colour>& ramp, double share) {
    return between(ramp.size(), 0.0, 1.0, share, [&](std::size_t i) { return lab_of(ramp[i]); });
}

glm::dvec3 on_photo(const std::array<glm::dvec3, PartColours::places>& quarters, double share) {
    // Quarters are known at their middles.
    constexpr double half = 0.5 / PartColours::places;
    return between(quarters.size(), half, 1.0 - half, share,
                   [&](std::size_t i) { return quarters[i]; });
}

}  // namespace

PartColours part_colours(const Picture& picture, const Mask& mask, const Traced& traced) {
    const CapPlaces cap(traced);
    const glm::dvec2 foot = traced.axis.front();
    const glm::dvec2 up = 0.5 * (traced.junctions[0] + traced.junctions[1]) - foot;
    std::array<ColourSample, PartColours::places> quarters;
    std::array<ColourSample, 2> stem;
    ColourSample face;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            const glm::dvec2 pixel(x + 0.5, y + 0.5);
            if (!is_well_inside(mask, pixel)) continue;
            const std::uint8_t* rgb = &picture.rgb[3 * mask.index(x, y)];
            if (const std::optional<double> share = cap.share(pixel)) {
                const auto quarter = static_cast<std::size_t>(*share * PartColours::places);
                quarters[std::min(quarter, PartColours::places - 1)].add(rgb);
                continue;
            }
            // The chord of a stem is near enough to its axis to separate its thirds.
            const double share = glm::dot(pixel - foot, up) / std::max(glm::dot(up, up), 1.0);
            if (is_hollow(traced.form) && share > 1.05)
                face.add(rgb);
            else if (share > 2.0 / 3.0 && share < 0.95)
                stem[0].add(rgb);
            else if (share > 0.03 && share < 1.0 / 3.0)
                stem[1].add(rgb);
        }
    ColourSample whole;
    for (const ColourSample& quarter : quarters) whole.add(quarter);
    const Hue of_cap = whole.commonest_hue();
    PartColours found;
    found.cap.emplace();
    for (std::size_t k = 0; k < PartColours::places && found.cap; ++k)
        if (const std::optional<glm::dvec3> colour = quarters[k].colour(of_cap))
            (*found.cap)[k] = *colour;
        else
            found.cap.reset();
    const auto of_stem = [](const ColourSample& third) {
        return third.colour(third.commonest_hue());
    };
    const std::optional<glm::dvec3> top = of_stem(stem[0]), base = of_stem(stem[1]);
    if (top && base) found.stem = {*top, *base};
    found.face = face.colour(face.commonest_hue());
    return found;
}

void give_colours(Species& species, std::size_t stage, const PartColours& colours) {
    const Surface before = species.stages.at(stage).model.surface;
    const auto moved = [](Colour& colour, const glm::dvec3& difference) {
        colour = colour_of(lab_of(colour) + difference);
    };
    for (std::size_t i = 0; i < species.stages.size(); ++i) {
        Surface& surface = species.stages[i].model.surface;
        if (colours.cap) {
            std::vector<Colour>& ramp = surface.cap.ramp;
            glm::dvec3 mean(0.0);
            for (std::size_t k = 0; k < PartColours::places; ++k) {
                const double share = (static_cast<double>(k) + 0.5) / PartColours::places;
                mean += ((*colours.cap)[k] - on_ramp(before.cap.ramp, share)) /
                        static_cast<double>(PartColours::places);
            }
            for (std::size_t k = 0; k < ramp.size(); ++k) {
                const double share =
                    ramp.size() > 1 ? static_cast<double>(k) / static_cast<double>(ramp.size() - 1)
                                    : 0.5;
                const glm::dvec3 seen = on_photo(*colours.cap, share);
                ramp[k] = colour_of(
                    i == stage ? seen : lab_of(ramp[k]) + seen - on_ramp(before.cap.ramp, share));
            }
            moved(surface.cap.patch_colour, mean);
            moved(surface.damage.faded, mean);
        }
        if (colours.face) {
            const glm::dvec3 difference = *colours.face - lab_of(before.hymenium.colour);
            HymeniumSurface& hymenium = surface.hymenium;
            for (Colour* colour : {&hymenium.colour, &hymenium.edge, &hymenium.depth})
                moved(*colour, difference);
            if (!colours.cap)
                for (Colour& colour : surface.cap.ramp) moved(colour, difference);
        }
        if (colours.stem) {
            moved(surface.stem.top, (*colours.stem)[0] - lab_of(before.stem.top));
            moved(surface.stem.base, (*colours.stem)[1] - lab_of(before.stem.base));
        }
    }
}

}  // namespace sporeprint::trace
