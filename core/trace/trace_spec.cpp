#include "core/trace/trace_spec.h"

namespace sporeprint::trace {

namespace {

Stroke stroke_of(const std::vector<PhotoPoint>& points) {
    Stroke stroke;
    stroke.reserve(points.size());
    for (const PhotoPoint& point : points) stroke.emplace_back(point[0], point[1]);
    return stroke;
}

std::vector<Stroke> strokes_of(const std::vector<std::vector<PhotoPoint>>& lines) {
    std::vector<Stroke> strokes;
    strokes.reserve(lines.size());
    for (const std::vector<PhotoPoint>& line : lines) strokes.push_back(stroke_of(line));
    return strokes;
}

}  // namespace

Gesture gesture_of(const GestureSpec& spec) {
    Gesture gesture{stroke_of(spec.axis), stroke_of(spec.cap), strokes_of(spec.keep),
                    strokes_of(spec.drop), std::nullopt};
    if (const auto& frame = spec.frame)
        gesture.frame = PhotoFrame{{(*frame)[0], (*frame)[1]},
                                   {(*frame)[0] + (*frame)[2], (*frame)[1] + (*frame)[3]}};
    return gesture;
}

std::optional<MarkedOutline> marked_outline_of(const TraceSpec& spec) {
    if (!spec.outline || !spec.marks) return std::nullopt;
    const auto pair_of = [](const std::vector<PhotoPoint>& places) {
        return std::array<glm::dvec2, 2>{glm::dvec2(places[0][0], places[0][1]),
                                         glm::dvec2(places[1][0], places[1][1])};
    };
    return MarkedOutline{stroke_of(spec.outline->left), stroke_of(spec.outline->right),
                         stroke_of(spec.outline->axis), pair_of(spec.marks->junctions),
                         pair_of(spec.marks->margins),  spec.marks->cap_turn_deg};
}

}  // namespace sporeprint::trace
