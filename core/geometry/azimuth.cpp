#include "core/geometry/azimuth.h"

#include <algorithm>
#include <cmath>

#include "core/individual/proportion.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

constexpr double least_columns_per_lobe = 2.5;
constexpr double gather = 0.45;  // how far columns turn towards the front of a fan, radians
constexpr double crowd = 0.40;   // how far they then turn to its sides, where the fan curves back
constexpr double back = 0.06;    // reach of a fan towards its substrate
constexpr double blunt = 0.15, pointed_blunt = 0.05;  // roundness of the tips of lobes, of rays

// How far columns turn towards the crests of rays of full depth.
constexpr double crest_gather = 0.5;

// Amplitudes of the two waves of a lift round the axis, in shares of it; their sum is a half.
constexpr double lift_wave = 0.3, second_lift_wave = 0.2;

/// Factor m by which a place moves towards the core (see the class), and its derivatives.
struct Pull {
    double value = 1.0, slope = 1.0;  ///< m, and the derivative of q m by q
    double by_share = 0.0;            ///< derivative of m by q
    double by_reach = 0.0;            ///< derivative of m by K
};

Pull pull_at(double q, double reach) {
    if (q <= 0.0) return {};
    const double below = 1.0 + 5.0 * reach;
    const double k = 6.0 * reach * reach / below, s = reach / below;
    const double k_by = 6.0 * reach * (2.0 + 5.0 * reach) / (below * below);
    const double s_by = 1.0 / (below * below);
    const double near = 1.0 / (1.0 + q / s);
    return {k + (1.0 - k) * near, k + (1.0 - k) * near * near, -(1.0 - k) * near * near / s,
            k_by * (1.0 - near) + (1.0 - k) * near * near * (q / (s * s)) * s_by};
}

/// Position between a lobe's crest (0) and the notch beside it (1) as a function of u, the cosine
/// of its phase: u is -1 on the crest and 1 in the notch.
struct Notch {
    double value, by_cosine;
};

/// Returns how far lobes are rays: 0 up to a sharpness of a half, 1 at full sharpness.
double ray_share(double sharpness) { return std::max(2.0 * sharpness - 1.0, 0.0); }

Notch notch_at(double u, double sharpness) {
    const double tip = blunt + ray_share(sharpness) * (pointed_blunt - blunt);
    const double scale = 1.0 / (std::sqrt(1.0 + tip * tip) - tip);
    const double sharp = std::abs(sharpness);
    // Positive sharpness gives crests as pointed as rays, negative notches as sharp as between
    // scallops; 0 is a cosine.
    const double side = sharpness > 0.0 ? u : -u;
    const double root = std::sqrt(0.5 * (1.0 + side) + tip * tip);
    const double tent = (root - tip) * scale, tent_by = 0.25 * scale / root;
    return {(1.0 - sharp) * 0.5 * (1.0 + u) + sharp * (sharpness > 0.0 ? tent : 1.0 - tent),
            (1.0 - sharp) * 0.5 + sharp * tent_by};
}

}  // namespace

AzimuthMap::AzimuthMap(const Individual& individual, int columns) : azimuth_(individual.azimuth) {
    Random count_stream(individual.shape_seed, purposes::lobes, 1);
    const double lot = count_stream.uniform();
    for (Azimuth form : individual.lobes) {
        if (form.lobes <= 0 || form.lobe_depth <= 0.0) continue;
        const int more = static_cast<int>(lot * (2 * form.lobe_spread + 1)) - form.lobe_spread;
        form.lobes = std::max(form.lobes + more, 1);
        layers_.push_back({form, 0.0, columns >= least_columns_per_lobe * form.lobes});
    }
    has_fan_ = azimuth_.lateral > 0.0;
    Extent extent{individual.stem_base, individual.stem_base};
    if (!identity())
        for (const CurveName name : curve_names) extent.include(individual.outline.of(name));
    radius_ = extent.radius;
    Random random(individual.shape_seed, purposes::lobes);
    phase_ = random.uniform(0.0, 2.0 * pi);
    first_ = random.uniform(0.0, 2.0 * pi);
    second_ = random.uniform(0.0, 2.0 * pi);
    third_ = random.uniform(0.0, 2.0 * pi);
    lift_phase_ = random.uniform(0.0, 2.0 * pi);
    second_lift_phase_ = random.uniform(0.0, 2.0 * pi);
    for (Layer& layer : layers_) {
        const Azimuth& form = layer.form;
        layer.root = extent.low + form.lobe_root * (extent.high - extent.low);
        if (layer.carried) continue;
        constexpr int samples = 64;
        const double less = 0.3 * form.lobe_uneven;
        double square = 0.0;
        for (int i = 0; i < samples; ++i) {
            const double notch =
                notch_at(cosine(2.0 * pi * i / samples), form.lobe_sharpness).value;
            const double reach = 1.0 - form.lobe_depth * (notch + less * (1.0 - notch));
            square += reach * reach / samples;
        }
        layer.mean_reach = std::sqrt(square);
    }
}

AzimuthMap::Phase AzimuthMap::phase_of(const Layer& layer, double angle) const {
    const double n = layer.form.lobes, uneven = n * layer.form.lobe_uneven;
    const auto one = sine_cosine(angle + first_), two = sine_cosine(2.0 * angle + second_);
    // The phase increases with the angle: its derivative is at least 0.35 n.
    return {n * angle + phase_ + uneven * (0.25 * one.sine + 0.2 * two.sine),
            n + uneven * (0.25 * one.cosine + 0.4 * two.cosine)};
}

AzimuthMap::Reach AzimuthMap::lobe_at(const Layer& layer, double angle) const {
    const Azimuth& form = layer.form;
    const double lift = form.lobe_lift * form.lobe_depth * radius_;
    if (!layer.carried) return {layer.mean_reach, 0.0, 0.5 * lift, 0.0};
    const Phase phase = phase_of(layer, angle);
    const auto low = sine_cosine(2.0 * angle + third_);
    const auto turn = sine_cosine(phase.value);
    const Notch notch = notch_at(turn.cosine, form.lobe_sharpness);
    const double notch_by = -notch.by_cosine * turn.sine * phase.by_angle;
    const double mean = 0.3 * form.lobe_uneven;
    const double less = mean * (1.0 + low.sine), less_by = 2.0 * mean * low.cosine;
    const auto once = sine_cosine(angle + lift_phase_),
               twice = sine_cosine(2.0 * angle + second_lift_phase_);
    return {1.0 - form.lobe_depth * (notch.value + less * (1.0 - notch.value)),
            -form.lobe_depth * (notch_by * (1.0 - less) + less_by * (1.0 - notch.value)),
            lift * (0.5 + lift_wave * once.sine + second_lift_wave * twice.sine),
            lift * (lift_wave * once.cosine + 2.0 * second_lift_wave * twice.cosine)};
}

AzimuthMap::Phase AzimuthMap::gathered(double angle) const {
    Phase to{angle, 1.0};
    for (const Layer& layer : layers_) {
        if (!layer.carried) continue;
        // The front of a fan has its own gathering.
        const double gathering = crest_gather * layer.form.lobe_depth *
                                 ray_share(layer.form.lobe_sharpness) * (1.0 - azimuth_.lateral);
        if (gathering <= 0.0) continue;
        const Phase phase = phase_of(layer, angle);
        const auto turn = sine_cosine(phase.value);
        const double n = layer.form.lobes;
        to.value += gathering / n * turn.sine;
        to.by_angle += gathering / n * turn.cosine * phase.by_angle;
    }
    return to;
}

AzimuthMap::Reach AzimuthMap::fan_at(const SineCosine& direction, double turning) const {
    if (!has_fan_) return {};
    // The front is +z. A fan is an ellipse between two lines that run back from its front, beside
    // the axis.
    const double x = direction.cosine, z = direction.sine, x_by = -z, z_by = x;
    const double wide = azimuth_.width * azimuth_.width;
    const double ellipse = 1.0 / std::sqrt(z * z + x * x / wide);
    const double ellipse_by = -ellipse * ellipse * ellipse * (z * z_by + x * x_by / wide);
    const auto opening = sine_cosine(radians(azimuth_.fan_deg));
    const double side = std::sqrt(x * x + 0.01);
    const double beyond = (side * opening.cosine - z * opening.sine) / back;
    double lines = 1.0, lines_by = 0.0;
    if (beyond > 0.0) {
        const double beyond_by = (x * x_by / side * opening.cosine - z_by * opening.sine) / back;
        const double square = beyond * beyond, whole = 1.0 + square * square;
        lines = 1.0 / std::sqrt(std::sqrt(whole));
        lines_by = -beyond * square * beyond_by * lines / whole;
    }
    return {1.0 + azimuth_.lateral * (ellipse * lines - 1.0),
            azimuth_.lateral * (ellipse_by * lines + ellipse * lines_by) * turning};
}

AzimuthMap::Column AzimuthMap::column(double angle) const {
    Column column;
    column.from = sine_cosine(angle);
    const Phase near = gathered(angle);
    double to = near.value;
    column.turning = near.by_angle;
    column.to = sine_cosine(to);
    if (has_fan_) {
        // Columns turn towards the front, then from there to both sides, and with these slightly
        // backwards to the substrate.
        const SineCosine at = column.to;
        const double turn = gather * azimuth_.lateral;
        const double beside = crowd * azimuth_.lateral * (2.0 - azimuth_.lateral);
        const double nearer = to + turn * at.cosine;
        const auto twice = sine_cosine(2.0 * nearer);
        const double sides = nearer - beside * twice.sine;
        const auto at_side = sine_cosine(sides);
        to = sides - back * azimuth_.lateral * at_side.cosine;
        column.to = sine_cosine(to);
        column.turning *= (1.0 - turn * at.sine) * (1.0 - 2.0 * beside * twice.cosine) *
                          (1.0 + back * azimuth_.lateral * at_side.sine);
    }
    for (std::size_t k = 0; k < layers_.size(); ++k) {
        column.lobes[k] = lobe_at(layers_[k], to);
        column.lobes[k].by_angle *= column.turning;
        column.lobes[k].lift_by_angle *= column.turning;
    }
    column.fan = fan_at(column.to, column.turning);
    return column;
}

AzimuthMap::Place AzimuthMap::placed(double r, double y, const Column& column) const {
    Place place{r, y};
    for (std::size_t k = 0; k < layers_.size(); ++k) {
        const Azimuth& form = layers_[k].form;
        const Reach& reach = column.lobes[k];
        const double core = form.lobe_from * radius_, width = radius_ - core;
        const double out = place.r - core;
        if (out <= 0.0) continue;
        const Pull pull = pull_at(out / width, reach.value);
        // Derivatives of m by the position after the previous layers, and by the angle.
        const double by_out = pull.by_share / width, by_angle = pull.by_reach * reach.by_angle;
        const double up = place.y - layers_[k].root, share = form.lobe_pull;
        const double pulled = 1.0 + share * (pull.value - 1.0);
        place.y = layers_[k].root + up * pulled;
        place.y_by_y *= pulled;
        place.y_by_r = pulled * place.y_by_r + up * share * by_out * place.r_by_r;
        place.y_by_angle =
            pulled * place.y_by_angle + up * share * (by_out * place.r_by_angle + by_angle);
        place.r = core + out * pull.value;
        place.r_by_angle = pull.slope * place.r_by_angle + out * by_angle;
        place.r_by_r *= pull.slope;
        const double reached = (place.r - core) / width, steepness = 2.0 * reached / width;
        place.y += reach.lift * reached * reached;
        place.y_by_r += reach.lift * steepness * place.r_by_r;
        place.y_by_angle +=
            reach.lift * steepness * place.r_by_angle + reach.lift_by_angle * reached * reached;
    }
    if (has_fan_) {
        const double core = azimuth_.core * radius_, width = radius_ - core;
        const double out = place.r - core;
        const Pull pull = pull_at(out / width, column.fan.value);
        if (out > 0.0) {
            place.r = core + out * pull.value;
            place.r_by_angle =
                pull.slope * place.r_by_angle + out * pull.by_reach * column.fan.by_angle;
            place.r_by_r *= pull.slope;
        }
    }
    return place;
}

void AzimuthMap::apply(SurfacePoint& point, const Column& column) const {
    if (identity()) return;
    const auto [s, c] = column.from;
    const auto [sine_to, cosine_to] = column.to;
    const double r = point.position.x * c + point.position.z * s;
    const Place place = placed(r, point.position.y, column);
    const double widening = r > 0.0 ? place.r / r : 1.0;
    for (glm::dvec3* v : {&point.meridian, &point.azimuth}) {
        const double out = v->x * c + v->z * s, round = v->z * c - v->x * s;
        const double turn = r > 0.0 ? round / r : 0.0;
        const double out_to = place.r_by_r * out + place.r_by_angle * turn;
        const double round_to = widening * column.turning * round;
        *v = {out_to * cosine_to - round_to * sine_to,
              place.y_by_r * out + place.y_by_y * v->y + place.y_by_angle * turn,
              out_to * sine_to + round_to * cosine_to};
    }
    point.position = {place.r * cosine_to, place.y, place.r * sine_to};
}

glm::dvec3 AzimuthMap::moved(const glm::dvec3& point) const {
    if (identity()) return point;
    SurfacePoint at{point, glm::dvec3(0.0), glm::dvec3(0.0)};
    apply(at, column(arc_tangent(point.z, point.x)));
    return at.position;
}

}  // namespace sporeprint
