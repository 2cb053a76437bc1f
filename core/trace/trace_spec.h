// The description of a trace, as clients write it: photographs, the gesture on each, and what the species
// should be.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/params/describe.h"
#include "core/params/messages.h"
#include "core/params/types.h"
#include "core/trace/form.h"
#include "core/trace/gesture.h"
#include "core/trace/trace.h"

namespace sporeprint::trace {

/// A point on a photograph as it is written: [x, y].
using PhotoPoint = std::array<double, 2>;

/// The gesture on a photograph, in pixels of the stored photograph from its upper left corner.
struct GestureSpec {
    static constexpr std::size_t most_points = 64, most_strokes = 16;

    std::vector<PhotoPoint> axis, cap;
    std::vector<std::vector<PhotoPoint>> keep, drop;
    std::optional<std::array<double, 4>> frame;

    static constexpr void fields(auto visit) {
        using G = GestureSpec;
        visit(&G::axis, Info{.name = "axis",
                             .unit = "px",
                             .max = 2048,
                             .most = most_points,
                             .doc = "A line from the foot to the top of the mushroom, at least two "
                                    "points, in pixels of the stored photograph, x to the right "
                                    "and y down from its upper left corner."});
        visit(&G::cap, Info{.name = "cap",
                            .unit = "px",
                            .max = 2048,
                            .most = most_points,
                            .doc = "A line across the cap."});
        visit(&G::keep, Info{.name = "keep",
                             .unit = "px",
                             .max = 2048,
                             .most = most_points,
                             .doc = "Lines on what belongs to the mushroom too."});
        visit(&G::drop, Info{.name = "drop",
                             .unit = "px",
                             .max = 2048,
                             .most = most_points,
                             .doc = "Lines on what does not belong to it."});
        visit(&G::frame, Info{.name = "frame",
                              .unit = "px",
                              .max = 2048,
                              .doc = "A rectangle with all of the mushroom in it: x and y of its "
                                     "upper left corner, width and height."});
    }
    /// Reports too many strokes, and a frame without an area.
    void check(const std::string& path, std::vector<Problem>& problems) const {
        const std::size_t strokes =
            (axis.empty() ? 0 : 1) + (cap.empty() ? 0 : 1) + keep.size() + drop.size();
        if (strokes > most_strokes)
            report(problems, path,
                   std::to_string(strokes) + " strokes; at most " + std::to_string(most_strokes) +
                       " are allowed");
        if (frame && ((*frame)[2] < 1.0 || (*frame)[3] < 1.0))
            report(problems, path + "/frame", "its width and its height are at least 1");
    }
    bool operator==(const GestureSpec&) const = default;
};

/// A view of a mushroom.
struct ViewSpec {
    Text<22> photo;
    std::optional<GestureSpec> gesture;

    static constexpr void fields(auto visit) {
        visit(&ViewSpec::photo,
              Info{.name = "photo",
                   .most = 22,
                   .doc = "Name of an uploaded photograph, as POST /v1/photos gives it."});
        visit(
            &ViewSpec::gesture,
            Info{.name = "gesture",
                 .doc = "Where the mushroom is, by at most 16 lines; may be left out for a picture "
                        "that is cut out already."});
    }
    bool operator==(const ViewSpec&) const = default;
};

/// A view of a face of the cap, from above or below.
struct FaceViewSpec {
    Text<22> photo;
    std::optional<GestureSpec> gesture;
    std::optional<PhotoPoint> centre, stem_end;

    static constexpr void fields(auto visit) {
        using F = FaceViewSpec;
        visit(&F::photo,
              Info{.name = "photo",
                   .most = 22,
                   .doc = "Name of an uploaded photograph, as POST /v1/photos gives it."});
        visit(&F::gesture,
              Info{.name = "gesture",
                   .doc = "Where the cap is, by at most 16 lines, of which axis leads across it "
                          "from edge to edge; may be left out for a picture that is cut out "
                          "already."});
        visit(&F::centre, Info{.name = "centre",
                               .unit = "px",
                               .max = 2048,
                               .doc = "The apex of the cap seen from above, or where its stem is "
                                      "fixed seen from below; without it the middle of what is "
                                      "cut out."});
        visit(&F::stem_end,
              Info{.name = "stem_end",
                   .unit = "px",
                   .max = 2048,
                   .doc = "Where the stem ends on a photograph from below: what is between it and "
                          "the centre is hidden. Without it the stem points at the camera."});
    }
    /// Reports a missing photograph.
    void check(const std::string& path, std::vector<Problem>& problems) const {
        if (photo.empty()) report(problems, path + "/photo", "is missing");
    }
    bool operator==(const FaceViewSpec&) const = default;
};

/// The views that are traced.
struct ViewsSpec {
    ViewSpec side;
    std::optional<FaceViewSpec> above, below;

    static constexpr void fields(auto visit) {
        using V = ViewsSpec;
        visit(&V::side, Info{.name = "side", .doc = "The mushroom seen from the side."});
        visit(&V::above,
              Info{.name = "above",
                   .doc = "Its cap seen from above, which gives the colours and the image of the "
                          "cap; of a funnel or cup those of its inside."});
        visit(&V::below,
              Info{.name = "below",
                   .doc = "Its cap seen from below, which gives the colours and the image of the "
                          "lower face."});
    }
    /// Reports a stem that hides nothing.
    void check(const std::string& path, std::vector<Problem>& problems) const {
        if (above && above->stem_end)
            report(problems, path + "/above/stem_end",
                   "is for a photograph from below; from above the cap hides its stem");
    }
    bool operator==(const ViewsSpec&) const = default;
};

/// An outline on a photograph, in pixels of the stored photograph.
struct OutlineLinesSpec {
    std::vector<PhotoPoint> left, right, axis;

    static constexpr void fields(auto visit) {
        using O = OutlineLinesSpec;
        visit(&O::left, Info{.name = "left",
                             .unit = "px",
                             .max = 2048,
                             .most = MarkedOutline::most_points,
                             .doc = "The left side from the foot to the apex."});
        visit(&O::right, Info{.name = "right",
                              .unit = "px",
                              .max = 2048,
                              .most = MarkedOutline::most_points,
                              .doc = "The right side from the foot to the apex."});
        visit(&O::axis, Info{.name = "axis",
                             .unit = "px",
                             .max = 2048,
                             .most = MarkedOutline::most_points,
                             .doc = "The curve through the middle of the stem, from the foot "
                                    "upwards."});
    }
    bool operator==(const OutlineLinesSpec&) const = default;
};

/// The marks on an outline.
struct MarksSpec {
    std::vector<PhotoPoint> junctions, margins;
    std::optional<double> cap_turn_deg;

    static constexpr void fields(auto visit) {
        visit(&MarksSpec::junctions,
              Info{.name = "junctions",
                   .unit = "px",
                   .max = 2048,
                   .most = 2,
                   .doc = "Where stem and lower face meet, or stem and head: left and right."});
        visit(&MarksSpec::margins,
              Info{.name = "margins",
                   .unit = "px",
                   .max = 2048,
                   .most = 2,
                   .doc = "The margin of the cap, or the edge of a funnel or cup: left and right. "
                          "A morel, club or puffball has none; its junctions count."});
        visit(&MarksSpec::cap_turn_deg,
              Info{.name = "cap_turn_deg",
                   .unit = "deg",
                   .min = -45,
                   .max = 45,
                   .doc = "How the cap stands against the top of the stem, to the right where "
                          "positive; without it so that its halves are most alike."});
    }
    /// Reports marks that are not two.
    void check(const std::string& path, std::vector<Problem>& problems) const {
        const auto require_two = [&](const std::vector<PhotoPoint>& places, const char* name) {
            if (places.size() != 2)
                report(problems, path + "/" + name,
                       std::to_string(places.size()) + " places; two are needed, left and right");
        };
        require_two(junctions, "junctions");
        require_two(margins, "margins");
    }
    bool operator==(const MarksSpec&) const = default;
};

/// A trace.
struct TraceSpec {
    ViewsSpec views;
    std::optional<OutlineLinesSpec> outline;
    std::optional<MarksSpec> marks;
    Text<64> template_id{"auto"};
    Text<48> id{"my_mushroom"};
    Form form = Form::automatic;
    std::optional<double> hollow;
    std::optional<double> height_m;
    bool images = false;

    static constexpr void fields(auto visit) {
        using T = TraceSpec;
        visit(&T::views, Info{.name = "views", .doc = "Photographs of the mushroom."});
        visit(&T::outline,
              Info{.name = "outline",
                   .doc = "The outline to be measured, as a trace gives it or as a person has "
                          "changed it. Then nothing is cut out, and the gesture does not count."});
        visit(&T::marks,
              Info{.name = "marks",
                   .doc = "The marks on this outline, as a trace gives them or as a person has "
                          "moved them. The form must be stated too."});
        visit(&T::template_id,
              Info{.name = "template",
                   .most = 64,
                   .doc = "The species that lends all that the photograph does not show: other "
                          "ages, the lower face, ornaments, spread. auto: of those of its form "
                          "the one that it looks like most."});
        visit(&T::id, Info{.name = "id", .most = 48, .doc = "Id of the new species."});
        visit(&T::form, Info{.name = "form",
                             .doc = "What is looked for: capped (stem and cap), funnel (hollow "
                                    "above, without an angle below), morel (a head on a stem), "
                                    "club, puffball or cup. auto: the form of the template, or the "
                                    "one that fits the outline."});
        visit(&T::hollow,
              Info{.name = "hollow",
                   .min = least_hollow,
                   .max = most_hollow,
                   .doc = "How deep a funnel or cup is, of the height of its edge above "
                          "its stem; without it as deep as the template."});
        visit(&T::height_m, Info{.name = "height_m",
                                 .unit = "m",
                                 .min = 0.002,
                                 .max = 1.0,
                                 .doc = "Height of the photographed mushroom; without it that of "
                                        "the template at its age."});
        visit(&T::images,
              Info{.name = "images",
                   .doc = "Paint cap and stem, and a lower face that is seen from below, with "
                          "images from the photographs: laid flat, without their shade, closed "
                          "round the mushroom."});
    }
    /// Reports a missing photograph, and ids that no species can have.
    void check(const std::string& path, std::vector<Problem>& problems) const {
        if (views.side.photo.empty()) report(problems, path + "/views/side/photo", "is missing");
        if (outline && !marks)
            report(problems, path + "/marks", "is missing; an outline is measured by its marks");
        if (marks && !outline)
            report(problems, path + "/outline", "is missing; marks are on an outline");
        if (marks && form == Form::automatic)
            report(problems, path + "/form",
                   "auto is for photographs; with marks state the form that the trace gave: "
                   "capped, funnel, morel, club, puffball or cup");
        if (const std::string said = invalid_id_message(id); !said.empty())
            report(problems, path + "/id", said);
        // Species of a library have names of their own.
        if (const std::string said = invalid_id_message(template_id);
            !said.empty() && !template_id.view().starts_with('~'))
            report(problems, path + "/template", said);
    }
    bool operator==(const TraceSpec&) const = default;
};

/// Returns a gesture as it is traced.
[[nodiscard]] Gesture gesture_of(const GestureSpec& spec);

/// Returns a place on a photograph.
[[nodiscard]] inline glm::dvec2 place_of(const PhotoPoint& point) { return {point[0], point[1]}; }

/// Returns an outline with marks as it is measured; none if there is none.
[[nodiscard]] std::optional<MarkedOutline> marked_outline_of(const TraceSpec& spec);

}  // namespace sporeprint::trace
