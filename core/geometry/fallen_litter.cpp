#include "core/geometry/fallen_litter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/geometry/litter_piece.h"
#include "core/math/direction.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"

namespace sporeprint {

namespace {

// No source or measurement is recorded for the values below.

/// Ages from and to which the pieces of a cap grow to their size: before, it was under the soil or
/// in its veil.
constexpr double bare_until = 0.2, littered_from = 0.5;

/// Where the middles of pieces are, in the radius of the cap from its apex; what lies nearer to the
/// margin slides off.
constexpr double innermost = 0.12, outermost = 0.74;

/// How far a piece lies above the cap, in its thickness: its lower face is a little in the skin.
constexpr double above = 0.6;

/// Grids of whole levels by their columns; empty where no piece is built, and at the finest level
/// that of the kind of litter.
struct Resolution {
    int least_columns;
    bool is_built;
    SolidGrid grid;
};
constexpr std::array<Resolution, 3> resolutions = {
    {{72, true, {}}, {28, true, {3, 3, false}}, {0, false, {}}}};

int built(const LitterStyle& style, const Detail& detail) {
    if (!by_columns(resolutions, detail).is_built) return 0;
    return static_cast<int>(std::ceil(detail.ground * style.fallen));
}

/// The upper face of a cap, at rest.
class CapTop {
  public:
    explicit CapTop(const OrnamentContext& context)
        : context_(context),
          rings_(context.outline.rings(CurveName::cap, context.level)),
          columns_(detail_of(context.level).columns) {}

    /// A place on the cap, in radii of the cap in a plane that its skin is spread out in.
    struct Place {
        double x = 0.0, z = 0.0;

        [[nodiscard]] double from_apex() const { return std::min(std::sqrt(x * x + z * z), 1.0); }
        [[nodiscard]] double angle() const {
            return x == 0.0 && z == 0.0 ? 0.0 : arc_tangent(z, x);
        }
    };

    struct Point {
        glm::dvec3 place, normal;
    };

    [[nodiscard]] Point at(const Place& place) const {
        const double sigma = place.from_apex(), angle = place.angle();
        const OutlineSample sample = context_.outline.cap.at(1.0 - context_.cuts.cap(sigma, angle));
        const SurfacePoint point =
            context_.rest_surface.meshed(Part::cap, rings_, columns_, sample.share, angle);
        const glm::dvec3 normal =
            unit_or(glm::cross(point.meridian, point.azimuth), glm::dvec3(0.0, 1.0, 0.0));
        return {point.position + context_.dents.cap(sigma, angle) * normal, normal};
    }

  private:
    const OrnamentContext& context_;
    std::vector<OutlineSample> rings_;
    int columns_;
};

/// How a piece lies on a cap.
struct Lie {
    CapTop::Place middle;
    glm::dvec2 heading{1.0, 0.0};  ///< unit direction on the cap
    double size = 1.0;             ///< of the longest

    [[nodiscard]] CapTop::Place at(double by) const {
        return {middle.x + by * heading.x, middle.z + by * heading.y};
    }
};

Lie drawn_lie(int number, Random& random) {
    const double far = random.uniform();
    const auto turn = sine_cosine(spread_angle(number, random));
    const auto head = sine_cosine(random.uniform(0.0, 2.0 * pi));
    const double size = random.uniform(0.6, 1.0);
    const double out =
        std::sqrt(innermost * innermost + (outermost * outermost - innermost * innermost) * far);
    return {{out * turn.cosine, out * turn.sine}, {head.cosine, head.sine}, size};
}

/// Returns a piece that lies on a cap: a parabola through three points of it.
///
/// reach  half its length, in radii of the cap
/// half   its middle
Rod rod_on(const CapTop& cap, const Lie& lie, double reach, const CapTop::Point& half,
           const LitterForm& form, double curled) {
    const CapTop::Point from = cap.at(lie.at(-reach)), to = cap.at(lie.at(reach));
    const glm::dvec3 bulge = half.place - 0.5 * (from.place + to.place),
                     start = to.place - from.place + 4.0 * bulge;
    Rod rod;
    rod.length = glm::length(start);
    rod.along = unit_or(start, square_to(half.normal, {lie.heading.x, 0.1, lie.heading.y}));
    rod.bend = rod.length > 0.0 ? -4.0 * bulge / rod.length : glm::dvec3(0.0);
    rod.side = unit_or(glm::cross(half.normal, rod.along), square_to(rod.along, {1.0, 0.1, 0.3}));
    rod.take_form(form, curled);
    rod.from = from.place + above * rod.thickness * half.normal;
    return rod;
}

}  // namespace

MeshCount fallen_litter_count(const std::vector<GroundLayer>& layers, const Detail& detail) {
    MeshCount sum;
    for (const GroundLayer& layer : layers) {
        const LitterStyle& style = layer.style.litter;
        const SolidGrid grid = grid_of(form_of(style.kind), by_columns(resolutions, detail).grid);
        sum += grid.count().times(built(style, detail));
    }
    return sum;
}

void add_fallen_litter(Mesh& mesh, const Individual& individual, const OrnamentContext& context) {
    const double amount = smooth_step(bare_until, littered_from, individual.effective.age);
    const CapTop cap(context);
    const AxisStation station = context.deformer.frozen_station(context.deformer.top());
    const double radius = context.outline.cap.length();
    for (const GroundLayer& layer : individual.grounds) {
        const LitterStyle& style = layer.style.litter;
        const LitterForm form = form_of(style.kind);
        const SolidGrid grid = grid_of(form, by_columns(resolutions, context.detail).grid);
        for (int number = 0; number < built(style, context.detail); ++number) {
            Random random(context.seed, purposes::fallen_litter,
                          layer.stream + static_cast<std::uint32_t>(number));
            const Lie lie = drawn_lie(number, random);
            const double reach = std::min(
                0.5 * lie.size * layer.weight * amount * style.length / radius, 0.5 * outermost);
            const double window = random.uniform(), curled = random.uniform(-0.2, 0.5);
            const CapTop::Point half = cap.at(lie.middle);
            const Rod rod = rod_on(cap, lie, reach, half, form, curled);
            GridSolid solid{grid, Part::ground, {}, {}};
            solid.window = litter_paint(window).window();
            solid.corners = corners_of(rod, grid, random);
            context.deformer.apply(solid.corners, station);
            if (!context.curl.none()) {
                const glm::dvec3 by =
                    context.curl.moved(true, lie.middle.from_apex(), lie.middle.angle());
                for (glm::dvec3& corner : solid.corners) corner += by;
            }
            append(mesh, solid, unit_or(station.direction(half.place, half.normal), half.normal),
                   context.textured, rod.length > 0.0 || context.keep_absent);
        }
    }
}

}  // namespace sporeprint
