#include "core/build/skin.h"

#include "core/model/proportion.h"

namespace sporeprint {

Skin::Skin(const Individual& individual, int columns)
    : outline_(individual.outline),
      waves_(individual.waves, greatest_radius(individual.outline.cap), columns,
             individual.effective.seed),
      azimuth_(individual, columns) {}

Skin::Column Skin::column(double angle) const {
    Column column{azimuth_.column(angle)};
    if (!waves_.flat()) column.waves = waves_.phases(angle);
    return column;
}

const SubCurve& Skin::curve(Part part) const {
    return part == Part::stem       ? outline_.stem
           : part == Part::hymenium ? outline_.hymenium
                                    : outline_.cap;
}

SurfacePoint Skin::at(Part part, const OutlineSample& sample, const Column& column) const {
    const auto [s, c] = column.azimuth.from;
    SurfacePoint point{{sample.r * c, sample.y, sample.r * s},
                       {sample.tangent_r * c, sample.tangent_y, sample.tangent_r * s},
                       {-s, 0.0, c}};
    if (part != Part::stem && !waves_.flat()) {
        const bool cap = part == Part::cap;
        const double length = curve(part).length();
        const auto wave = waves_.at(cap ? 1.0 - sample.share : sample.share, column.waves);
        point.position.y += wave.height;
        if (length > 0.0) point.meridian.y += (cap ? -wave.by_share : wave.by_share) / length;
        if (sample.r > 0.0) point.azimuth.y += wave.by_angle / sample.r;
    }
    azimuth_.apply(point, column.azimuth);
    return point;
}

SurfacePoint Skin::at(Part part, double share, double angle) const {
    return at(part, curve(part).at(share), column(angle));
}

}  // namespace sporeprint
