#include "core/trace/trace.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "core/math/elementary.h"
#include "core/problems.h"
#include "core/silhouette/morph_set.h"
#include "core/trace/axis.h"
#include "core/trace/cut.h"
#include "core/trace/fit.h"
#include "core/trace/marks.h"
#include "core/trace/profile.h"
#include "core/trace/refine.h"

namespace sporeprint::trace {

namespace {

constexpr int least_height = 120;  ///< pixels

/// Smoothing of the contour, of the height.
constexpr double smoothing = 0.0028;

/// The rows and columns that a mask reaches.
struct Extent {
    int left, top, right, bottom;
};

Extent extent_of(const Mask& mask) {
    Extent extent{mask.width, mask.height, -1, -1};
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y))
                extent = {std::min(extent.left, x), std::min(extent.top, y),
                          std::max(extent.right, x), std::max(extent.bottom, y)};
    return extent;
}

/// Requires that a mask has no more border than a mushroom: time grows with it.
void require_plain_border(const Mask& mask, const Extent& extent) {
    constexpr std::int64_t most_heights = 40;
    std::int64_t edges = 0;
    for (int y = extent.top; y <= extent.bottom; ++y)
        for (int x = extent.left; x <= extent.right; ++x) {
            if (!mask.at(x, y)) continue;
            for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
                edges += mask.at(x + dx, y + dy) ? 0 : 1;
        }
    if (edges > most_heights * (extent.bottom - extent.top + 1))
        throw InvalidInput("/photo", "the border of the mushroom is " + std::to_string(edges) +
                                         " pixels long, more than " + std::to_string(most_heights) +
                                         " times its height");
}

void require_whole(const Mask& mask, const Extent& extent) {
    const int height = extent.bottom - extent.top + 1;
    if (height < least_height)
        throw InvalidInput("/photo", "the mushroom is " + std::to_string(std::max(height, 0)) +
                                         " pixels high; at least " + std::to_string(least_height) +
                                         " are needed");
    const char* border = extent.left == 0                   ? "left"
                         : extent.right == mask.width - 1   ? "right"
                         : extent.top == 0                  ? "upper"
                         : extent.bottom == mask.height - 1 ? "lower"
                                                            : nullptr;
    if (border)
        throw InvalidInput("/photo", std::string("the mushroom is cut off by the ") + border +
                                         " border of the photograph");
}

double angle_of(const AxisPoint& from, const AxisPoint& to) {
    return arc_tangent(to.x - from.x, to.y - from.y) * (180.0 / pi);
}

/// Returns the contour of a mask without hairs, as nests have them; with them, if a thin stem would fall off.
Contour shaved(const Mask& mask, double height) {
    constexpr double hair = 0.008;  // half the width of the thickest, of the height
    const Mask bare = opened(mask, static_cast<int>(hair * height) + 1);
    Mask first(mask.width, mask.height);
    const auto pixel = std::find(bare.inside.begin(), bare.inside.end(), 1);
    if (pixel != bare.inside.end())
        first.inside[static_cast<std::size_t>(pixel - bare.inside.begin())] = 1;
    const Mask part = connected_with(bare, first);
    const bool is_whole = part.area() > 0 && part.area() == bare.area();
    return contour_of(is_whole ? without_holes(part) : mask, smoothing * height);
}

/// Returns a straight axis turned about its foot, to the right where the angle is positive.
TracedAxis turned(const TracedAxis& axis, double turn_deg) {
    const glm::dvec2 foot = axis.at(0.0), along = axis.at(axis.length()) - foot;
    const auto [sine, cosine] = sine_cosine(radians(turn_deg));
    return TracedAxis({foot, foot + cosine * along + sine * glm::dvec2(-along.y, along.x)});
}

/// Returns the form of a mushroom that is like one of two forms on a straight axis and on one that bends. Caps are
/// found on the one that bends, but in a wide mushroom it runs away.
Form chosen_form(Form on_straight, Form on_bent) {
    if (on_bent == Form::capped) return on_bent;
    if (on_straight == Form::funnel) return Form::funnel;
    if (on_straight == Form::capped) return is_hollow(on_bent) ? Form::funnel : Form::capped;
    return is_hollow(on_bent) ? on_straight : on_bent;
}

/// Returns the axis of a mushroom; a straight one, if that which bends leaves the mushroom half way.
TracedAxis sound_axis(const Contour& contour, const Stroke& drawn) {
    TracedAxis bent = axis_of(contour, drawn), straight = straight_axis(contour, drawn);
    return bent.length() < 0.5 * straight.length() ? straight : bent;
}

struct Found {
    Contour contour;
    TracedAxis axis;
    Marks marks;
};

/// Returns the axis and marks of a cup. Its stem is too short to bend: all of it stands as its edge does.
Found found_cup(Contour contour, const TracedAxis& middle, double height) {
    const TracedAxis axis =
        turned(middle, marks_of(contour, middle, height, Form::cup).cap_turn_deg);
    Marks marks = marks_of(contour, axis, height, Form::cup);
    marks.cap_turn_deg = 0.0;
    return {std::move(contour), axis, std::move(marks)};
}

/// Returns the axis and marks of any other form.
///
/// rough  tells where the stem ends: middles in the cap then do not count
Found found_on(Contour contour, const Stroke& drawn, const TracedAxis& rough, double height,
               Form form) {
    Marks of_rough = marks_of(contour, rough, height, form);
    // A club has no cap whose middles mislead.
    if (form == Form::club) return {std::move(contour), rough, std::move(of_rough)};
    const TracedAxis axis = axis_of(contour, drawn, rough.at(of_rough.stem_top));
    Marks marks = marks_of(contour, axis, height, form);
    return {std::move(contour), axis, std::move(marks)};
}

Found found_in(const Mask& mask, const Stroke& drawn, double height, Form form) {
    Form on_straight = form;
    if (form == Form::automatic || form == Form::cup) {
        const Contour contour = shaved(mask, height);
        const TracedAxis middle = straight_axis(contour, drawn);
        if (form == Form::automatic) on_straight = likely_form(contour, middle, height);
        if (on_straight == Form::cup) return found_cup(contour, middle, height);
    }
    const Contour contour = contour_of(mask, smoothing * height);
    const TracedAxis rough = sound_axis(contour, drawn);
    if (form != Form::automatic) return found_on(contour, drawn, rough, height, form);
    const Form chosen = chosen_form(on_straight, likely_form(contour, rough, height));
    try {
        return found_on(contour, drawn, rough, height, chosen);
    } catch (const InvalidInput&) {
        if (chosen != Form::capped) throw;
    }
    // What looked like a cap has no stem.
    return found_on(contour, drawn, rough, height, Form::puffball);
}

struct FittedProfile {
    Profile profile;
    FittedShape shape;
    bool has_plain_stem = false;
};

/// Replaces a stem by one that is nearly as wide below as above, and meets the rest at an angle.
void make_stem_plain(Profile& profile) {
    constexpr double below = 0.9;  // of the radius above
    const glm::dvec2 top = profile.stem.back();
    profile.stem = {{below * top.x, 0.0}, {0.5 * (below + 1.0) * top.x, 0.5 * top.y}, top};
    profile.has_foot = false;
    // A smooth join with a short stem could swing through the axis.
    profile.has_corner = true;
}

/// Returns the profile and its spline. If the outline would touch itself, a hollow is less deep than stated, and
/// last the stem is a plain one.
FittedProfile fitted_profile(const Contour& contour, const TracedAxis& axis, const Marks& marks,
                             double height, const TraceParams& params) {
    constexpr double last_hollow = 0.1;
    FittedProfile found;
    for (double hollow = params.hollow;;) {
        found.profile = profile_of(contour, axis, marks, height, hollow);
        if (found.has_plain_stem) make_stem_plain(found.profile);
        try {
            found.shape = fitted_shape(found.profile, axis, marks, height, params.height_m);
            // The rings of all levels of detail stay apart too.
            static_cast<void>(MorphSet({{found.shape.silhouette, params.height_m, 0, 0.6}}));
            return found;
        } catch (const Impossible&) {
            if (is_hollow(marks.form) && hollow >= last_hollow) {
                hollow *= 0.5;
            } else if (!found.has_plain_stem) {
                found.has_plain_stem = true;
                hollow = params.hollow;
            } else {
                throw;
            }
        }
    }
}

/// Returns a trace with a shape that was found on an outline.
Traced with_shape(const FoundOutline& found_outline, const MeasuredOutline& on,
                  const Profile& profile, const FittedShape& fitted, const TraceParams& params) {
    Traced found;
    static_cast<MarkedOutline&>(found) = found_outline.outline;
    found.cap_turn_deg = on.marks.cap_turn_deg;
    found.form = found_outline.form;
    found.shape.silhouette = fitted.silhouette;
    found.shape.axis = unfolded(fitted.axis, fitted.silhouette);
    found.error = fitted.error;
    found.asymmetry = profile.asymmetry;
    if (found.shape.axis != fitted.axis) found.method = TraceMethod::straightened;
    const std::vector<AxisPoint>& points = found.shape.axis;
    found.lean_deg = angle_of(points.front(), points.back());
    found.bend_deg = std::abs(angle_of(points[points.size() - 2], points.back()) -
                              angle_of(points[0], points[1]));
    if (found.bend_deg > 180.0) found.bend_deg = 360.0 - found.bend_deg;
    const double scale = params.height_m / on.height;
    if (profile.ring)
        found.ring = RingMeasure{profile.ring->height * scale, profile.ring->width * scale};
    return found;
}

/// Returns a profile on an axis that follows the stem and the cap, from the cap's turn as it was measured or from
/// the line between its margins, whichever is more alike.
std::optional<RefinedProfile> refined_axis(const Profile& profile, const MeasuredOutline& on,
                                           const TraceParams& params) {
    constexpr double alike_deg = 3.0;
    auto best = refined_profile(profile, on.axis, on.marks, on.height, LowerEdge::face);
    const auto &left = on.marks.sides[0], &right = on.marks.sides[1];
    const CapFrame straight(on.axis, on.marks.stem_top, 0.0);
    const glm::dvec2 across =
        straight.local(right.points[right.margin]) - straight.local(left.points[left.margin]);
    Marks level = on.marks;
    level.cap_turn_deg = arc_tangent(-across.y, across.x) * (180.0 / pi);
    if (std::abs(level.cap_turn_deg - on.marks.cap_turn_deg) < alike_deg) return best;
    const Profile measured_level = profile_of(on.contour, on.axis, level, on.height, params.hollow);
    auto other = refined_profile(measured_level, on.axis, level, on.height, LowerEdge::face);
    return other && (!best || other->apart < best->apart) ? other : best;
}

/// Replaces a trace by one whose drawing is nearer to the contour that was measured, if there is one.
void refine(Traced& best, const FoundOutline& found, const MeasuredOutline& on,
            const Profile& profile, const TraceParams& params) {
    // What is measured counts more where both are nearly as near. A lower face that hangs looks much like the near
    // half of a margin that is seen from above.
    constexpr double least_gain = 0.0008, of_pitch = 0.86;  // of the height, and a factor
    const auto distance_of = [&](const Traced& made) {
        return seen_distance(made.shape, made.pitch_deg.value_or(0.0), on.marks, on.height,
                             params.height_m);
    };
    double least = distance_of(best) - least_gain;
    // First the axis, then what is measured along it.
    const auto first = refined_axis(profile, on, params);
    if (!first) return;
    const auto marks_on = [&](const RefinedProfile& one) {
        Marks marks = on.marks;
        marks.stem_top = one.stem_top;
        marks.cap_turn_deg = 0.0;
        return marks;
    };
    const Marks again = marks_at(on.marks.sides, first->axis, on.height, on.marks.form, 0.0);
    const Profile measured_again =
        profile_of(on.contour, first->axis, again, on.height, params.hollow);
    for (const LowerEdge edge : {LowerEdge::face, LowerEdge::margin}) {
        const auto refined = refined_profile(measured_again, first->axis, again, on.height, edge);
        if (!refined) continue;
        const Marks marks = marks_on(*refined);
        FittedShape shape;
        try {
            // What is seen from above looks less high.
            shape = fitted_shape(refined->profile, refined->axis, marks,
                                 on.height / cosine(radians(refined->pitch_deg)), params.height_m);
            static_cast<void>(MorphSet({{shape.silhouette, params.height_m, 0, 0.6}}));
        } catch (const Impossible&) {
            continue;
        }
        Traced made = with_shape(found, on, refined->profile, shape, params);
        made.asymmetry = best.asymmetry;
        if (made.method == TraceMethod::fitted) made.method = TraceMethod::refined;
        if (edge == LowerEdge::margin) made.pitch_deg = refined->pitch_deg;
        const double distance = distance_of(made);
        if (!(distance < (edge == LowerEdge::margin ? of_pitch : 1.0) * least)) continue;
        least = distance;
        best = std::move(made);
    }
}

}  // namespace

Traced on_copy(Traced traced, double factor) {
    MarkedOutline& outline = traced;
    outline = scaled(outline, factor);
    return traced;
}

FoundOutline outline_on(const Mask& mask, const Gesture& gesture, Form form) {
    const Extent extent = extent_of(mask);
    require_whole(mask, extent);
    require_plain_border(mask, extent);
    const double height = extent.bottom - extent.top + 1.0;
    const auto [contour, axis, marks] = found_in(mask, gesture.axis, height, form);
    return {reported(marks, axis), marks.form};
}

Traced traced(const Mask& mask, const Gesture& gesture, const TraceParams& params) {
    require_valid(params);
    return traced(outline_on(mask, gesture, params.form), params);
}

Traced traced(const FoundOutline& found, const TraceParams& params) {
    const MeasuredOutline on = measured(found.outline, found.form);
    const FittedProfile fitted = fitted_profile(on.contour, on.axis, on.marks, on.height, params);
    Traced made = with_shape(found, on, fitted.profile, fitted.shape, params);
    if (fitted.has_plain_stem) made.method = TraceMethod::simplified;
    if (found.form == Form::capped) refine(made, found, on, fitted.profile, params);
    return made;
}

Traced stretched(const FoundOutline& found, const TraceParams& params, const Silhouette& other,
                 double share) {
    const MeasuredOutline on = measured(found.outline, found.form);
    const Profile profile = profile_of(on.contour, on.axis, on.marks, on.height, params.hollow);
    Traced made = with_shape(
        found, on, profile,
        stretched_shape(other, profile, on.axis, on.marks, on.height, params.height_m, share),
        params);
    made.method = TraceMethod::stretched;
    return made;
}

Traced traced(const MarkedOutline& outline, const TraceParams& params) {
    require_valid(params);
    require_measurable(outline, params.form);
    return traced(FoundOutline{outline, params.form}, params);
}

Traced traced(const Picture& photo, const Gesture& gesture, const TraceParams& params) {
    require_valid(params);
    const Mask mask = cut_out(photo, gesture);
    const double factor = static_cast<double>(mask.width) / photo.width;
    return on_copy(traced(mask, gesture.scaled(factor), params), 1.0 / factor);
}

}  // namespace sporeprint::trace
