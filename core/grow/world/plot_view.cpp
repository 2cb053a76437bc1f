#include "core/grow/world/plot_view.h"

#include "core/math/elementary.h"

namespace sporeprint {

namespace {

double ground_at(const Ground& ground, double x, double y) {
    return place_at(ground, coordinate_at(ground.grid, x), coordinate_at(ground.grid, y)).height;
}

}  // namespace

StandingCamera camera_of(const PlotContent& content, PlotView view, double turn_deg) {
    const SineCosine turn = sine_cosine(radians(turn_deg));
    const double x = metres(content.centre.x), y = metres(content.centre.y);
    const double middle = ground_at(*content.ground, x, y), size = content.size;
    /// Returns a place so far from the middle, so high above the ground there.
    const auto beside = [&](double distance, double height) {
        const double east = distance * turn.sine, south = distance * turn.cosine;
        const double own = ground_at(*content.ground, x + east, y - south);
        return glm::dvec3(east, own - middle + height, south);
    };
    switch (view) {
        case PlotView::standing:
            return {beside(0.48 * size, 1.65), beside(-0.1 * size, 0.45), 75.0};
        case PlotView::kneeling:
            return {beside(0.42 * size, 0.5), beside(0.1 * size, 0.1), 60.0};
        case PlotView::aslant:
            return {beside(1.05 * size, 0.9 * size), {0.0, 0.0, 0.0}, 55.0};
        case PlotView::top:
            break;
    }
    // A little beside the middle, so that up is away from the viewer.
    return {{1e-3 * size * turn.sine, size, 1e-3 * size * turn.cosine}, {0.0, 0.0, 0.0}, 56.0};
}

}  // namespace sporeprint
