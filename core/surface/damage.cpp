#include "core/surface/damage.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/individual/damage.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/surface/canvas.h"
#include "core/surface/charts.h"
#include "core/surface/paint.h"
#include "core/surface/plan.h"

namespace sporeprint {
namespace {

constexpr float single(double value) { return static_cast<float>(value); }

double diagonal(double a, double b) { return std::sqrt(a * a + b * b); }

std::array<float, 3> light_of(Colour colour) {
    const std::array<float, 256>& table = linear_table();
    return {table[colour.r], table[colour.g], table[colour.b]};
}

/// Coordinate system of one chart, in which damage is placed.
class ChartSpace {
  public:
    ChartSpace(const PaintPlan& plan, Part part) : plan_(plan), part_(part) {}

    [[nodiscard]] bool strip() const { return part_ == Part::stem; }

    /// Position on the chart of a point of the meridian at an angle.
    struct Place {
        double x, y;              // relative to the chart
        double along_x, along_y;  // unit, along the meridian
        double widening;          // length of a step round the axis over that on the chart
    };
    [[nodiscard]] Place place(double sigma, double theta) const {
        if (strip()) return {sigma * aspect(), theta / (2.0 * pi), 1.0, 0.0, 1.0};
        const SineCosine turn = sine_cosine(theta);
        const double inner = disc().inner;
        const double rho = inner + (1.0 - inner) * sigma;
        return {rho * turn.cosine, rho * turn.sine, turn.cosine, turn.sine, widening(rho)};
    }

    /// Returns the length of one texel on the chart.
    [[nodiscard]] double texel() const {
        return strip() ? std::max<double>(plan_.stem.texel_along, plan_.stem.texel_round)
                       : static_cast<double>(disc().per_texel);
    }

    /// Returns the length of the meridian on the chart.
    [[nodiscard]] double unit() const {
        return strip() ? 1.0 : 1.0 - static_cast<double>(disc().inner);
    }

    [[nodiscard]] double widening(double rho) const {
        const DiscPlan& d = disc();
        if (d.bend > 0.0F) {
            if (rho < 1e-4) return 1.0;
            const double angle = std::min(rho * static_cast<double>(d.bend), 0.5 * pi);
            return std::max(static_cast<double>(d.sphere) * sine(angle) / rho, 0.1);
        }
        const double share = std::max(rho - static_cast<double>(d.inner), 0.0) /
                             (1.0 - static_cast<double>(d.inner));
        return std::max(
            (static_cast<double>(d.cone_from) + static_cast<double>(d.cone_grow) * share) /
                std::max(rho, 0.05),
            0.1);
    }
    [[nodiscard]] double aspect() const { return plan_.stem.aspect; }

  private:
    [[nodiscard]] const DiscPlan& disc() const {
        return part_ == Part::cap ? plan_.cap.disc : plan_.hymenium.disc;
    }
    const PaintPlan& plan_;
    Part part_;
};

class DamagePlanner {
  public:
    DamagePlanner(const PaintParams& params, PaintPlan& plan) : params_(params), plan_(plan) {}

    void add_all() {
        const PaintedWeathering<Plain>& w = params_.weathering;
        const bool has_margin = params_.metrics.hymenium_arc > quantised_length(0.0);
        if (w.creases > 0.0) add_furrows(w.creases);
        if (w.bumps > 0.0) {
            add_ovals(DamageKind::lump, DamageSpotKind::lump, Part::cap, w.bumps);
            add_ovals(DamageKind::lump, DamageSpotKind::lump, Part::stem, w.bumps);
        }
        if (w.bruise > 0.0)
            for (const Part part : {Part::cap, Part::hymenium, Part::stem})
                add_ovals(DamageKind::bruise, DamageSpotKind::bruise, part, w.bruise);
        if (w.peel > 0.0 && has_margin) add_tongues(w.peel);
        if (w.cracks > 0.0) add_cracks(w.cracks);
        if (w.bites > 0.0) {
            add_ovals(DamageKind::pit, DamageSpotKind::pit, Part::cap, w.bites);
            add_ovals(DamageKind::pit, DamageSpotKind::pit, Part::stem, w.bites);
            if (has_margin) add_notches(bites(params_.damage_seed), DamageKind::bite, w.bites);
        }
        if (w.splits > 0.0 && has_margin)
            add_notches(splits(params_.damage_seed), DamageKind::split, w.splits);
        if (w.dew > 0.0) {
            add_ovals(DamageKind::drop, DamageSpotKind::dew, Part::cap, w.dew);
            add_ovals(DamageKind::drop, DamageSpotKind::dew, Part::stem, w.dew);
        }
    }

  private:
    void add(Part part, SpotPlan painted) {
        plan_.damage.damage_spots[index_of(part)].push_back(painted);
        if (part != Part::stem) return;
        // A copy on the other side of the seam.
        const float turn = painted.middle_y < 0.5F ? 1.0F : -1.0F;
        painted.y += turn;
        painted.middle_y += turn;
        plan_.damage.damage_spots[2].push_back(painted);
    }

    void add_ovals(DamageKind kind, DamageSpotKind spotted, Part part, double amount) {
        const ChartSpace chart(plan_, part);
        const CurveName curve = part == Part::cap        ? CurveName::cap
                                : part == Part::hymenium ? CurveName::hymenium
                                                         : CurveName::stem;
        const std::uint32_t seed = kind == DamageKind::drop
                                       ? params_.dew_seed.value_or(params_.seed)
                                       : params_.damage_seed;
        for (const DamageSpot& spot : damage_spots(spotted, curve, seed)) {
            const double scale = grown(spot.onset, amount);
            if (scale <= 0.0) continue;
            const ChartSpace::Place at = chart.place(spot.sigma, spot.theta);
            const double size = kind == DamageKind::drop ? scale : faded_in_size(scale);
            const double radius = std::max(spot.radius * size, 1e-4) * chart.unit();
            const double length = radius * spot.elongation, width = radius / at.widening;
            SpotPlan painted;
            painted.kind = kind;
            painted.x = single(at.x);
            painted.y = single(at.y);
            painted.along_x = single(at.along_x);
            painted.along_y = single(at.along_y);
            painted.per_length = single(1.0 / length);
            painted.per_width = single(1.0 / width);
            painted.middle_x = painted.x;
            painted.middle_y = painted.y;
            painted.reach = 1.5F * single(std::max(length, width));
            painted.rows = single(std::sqrt(static_cast<double>(oval_window(kind))) *
                                  diagonal(length * at.along_y, width * at.along_x));
            painted.seed = Random(params_.damage_seed,
                                  purposes::painted_damage + static_cast<std::uint32_t>(part),
                                  static_cast<std::uint32_t>(kind) * 1000U + spot.id)
                               .bits();
            const double shown = std::min(1.0, radius / chart.texel());
            switch (kind) {
                case DamageKind::pit:
                    painted.height = single(0.30 * radius);
                    painted.strength = single(pit_depth(scale) * shown);
                    break;
                case DamageKind::bruise:
                    painted.strength = single(scale);
                    break;
                case DamageKind::drop:
                    painted.height = single(0.55 * radius);
                    painted.strength = single(shown * shown);
                    break;
                default:
                    // Every third lump is a hollow. Half of its height is painted, the rest is
                    // geometry.
                    painted.height = single(lump_height(spot) * scale * 0.5 * chart.unit());
                    break;
            }
            add(part, painted);
        }
    }

    // Adds a piece of a crack or furrow from one point to the next; half widths are relative to the
    // chart.
    void add_line(Part part, DamageKind kind, double ax, double ay, double bx, double by,
                  double width_a, double width_b, double strength, std::uint32_t seed) {
        if (width_a <= 0.0 && width_b <= 0.0) return;
        const ChartSpace chart(plan_, part);
        const double dx = bx - ax, dy = by - ay, length = std::sqrt(dx * dx + dy * dy);
        if (length < 1e-9) return;
        // Where the chart compresses the circumference, a crack along the meridian is wider on the
        // chart.
        double stretch = 1.0;
        if (!chart.strip()) {
            const double mx = 0.5 * (ax + bx), my = 0.5 * (ay + by);
            const double rho = std::max(std::sqrt(mx * mx + my * my), 1e-6);
            const double across = (mx * dx + my * dy) / (rho * length);
            const double k = chart.widening(rho);
            stretch = 1.0 / std::sqrt(across * across * k * k + (1.0 - across * across));
        }
        const double texel = 0.62 * chart.texel();
        const double mean = 0.5 * (width_a + width_b) * stretch;
        SpotPlan painted;
        painted.shape = DamageShape::line;
        painted.kind = kind;
        painted.x = single(ax);
        painted.y = single(ay);
        painted.along_x = single(dx / length);
        painted.along_y = single(dy / length);
        painted.length = single(length);
        painted.width = single(std::max(width_a * stretch, texel));
        const float width_end = single(std::max(width_b * stretch, texel));
        painted.width_grow = (width_end - painted.width) / painted.length;
        // A line thinner than a texel has the opacity of its share of the texel.
        painted.strength = single(strength * std::min(1.0, mean / texel));
        painted.height = single(mean);
        painted.middle_x = single(0.5 * (ax + bx));
        painted.middle_y = single(0.5 * (ay + by));
        const float widest = std::max(painted.width, width_end);
        const float rise = std::abs(painted.along_y);
        painted.reach = single(0.5 * length) + 2.6F * widest;
        painted.cover = 1.02F * line_window(kind) * widest;
        painted.rows = std::min(painted.reach, rise * painted.length * 0.5F + painted.cover);
        // A line almost parallel to the rows is limited by its bounding circle only.
        const bool crosses = rise > 0.05F;
        painted.lean = crosses ? painted.along_x / painted.along_y : 0.0F;
        painted.breadth = crosses ? painted.cover / rise : 1e9F;
        painted.seed = seed;
        add(part, painted);
    }

    void add_cracks(double amount) {
        // Share of radial cracks: the growth strain, shifted by the preference of the species.
        const double own = params_.surface.damage.cracking;
        const double strain = params_.metrics.radial_strain / 16.0;
        const double radial =
            std::clamp(own < 0.0 ? strain * (1.0 + own) : strain + (1.0 - strain) * own, 0.0, 1.0);
        const std::uint32_t seed =
            Random(params_.damage_seed, purposes::painted_damage + 8U).bits();
        const double net_share = 1.0 - smooth_step(0.55, 1.0, radial);
        const auto pieces = [&](const Crack& crack, auto width_at) {
            for (std::size_t i = 0; i + 1 < crack.points.size(); ++i) {
                const CrackPoint &a = crack.points[i], &b = crack.points[i + 1];
                add_line(Part::cap, DamageKind::crack, a.x, a.y, b.x, b.y, width_at(a), width_at(b),
                         1.0, seed);
            }
        };
        if (net_share > 0.0)
            for (const Crack& crack : crack_net(params_.damage_seed)) {
                const double scale = grown(crack.onset, amount);
                if (scale <= 0.0) continue;
                pieces(crack, [&](const CrackPoint& p) {
                    const double rho = std::sqrt(p.x * p.x + p.y * p.y);
                    // A net on the disc, where the strain is isotropic; cracks open from their
                    // middle to their ends.
                    const double here = net_share * (1.0 - radial * smooth_step(0.35, 0.9, rho)) *
                                        (1.0 - 0.5 * smooth_step(0.85, 1.0, rho));
                    const double open =
                        smooth_step(0.0, 0.35, 1.35 * scale - p.along) * (0.35 + 0.65 * scale);
                    return 0.017 * crack.width * here * open;
                });
            }
        const double radial_share = smooth_step(0.0, 0.7, radial);
        if (radial_share > 0.0)
            for (const Crack& crack : radial_cracks(params_.damage_seed)) {
                const double scale = grown(crack.onset, amount);
                if (scale <= 0.0) continue;
                pieces(crack, [&](const CrackPoint& p) {
                    const double left = std::max(0.0, 1.0 - p.along / scale);
                    return 0.024 * crack.width * radial_share * (0.4 + 0.6 * scale) *
                           std::sqrt(left);
                });
            }
    }

    void add_furrows(double amount) {
        constexpr int steps = 28;
        const double aspect = plan_.stem.aspect;
        const std::uint32_t seed =
            Random(params_.damage_seed, purposes::painted_damage + 9U).bits();
        for (const Furrow& furrow : furrows(params_.damage_seed)) {
            const double scale = grown(furrow.onset, amount);
            if (scale <= 0.0) continue;
            const auto place = [&](double sigma) {
                return furrow_angle(furrow, sigma) / (2.0 * pi);
            };
            for (int k = 0; k < steps; ++k) {
                const double a = static_cast<double>(k) / steps,
                             b = static_cast<double>(k + 1) / steps;
                const double wa = furrow_depth(furrow, a) * scale,
                             wb = furrow_depth(furrow, b) * scale;
                add_line(Part::stem, DamageKind::furrow, a * aspect, place(a), b * aspect, place(b),
                         0.020 * wa, 0.020 * wb, 0.35 + 0.65 * scale, seed);
                // The deepest furrows split when they are dry.
                const double torn =
                    smooth_step(0.55, 1.0, amount) * smooth_step(0.6, 0.85, furrow.depth);
                const auto open = [&](double sigma) {
                    const double t =
                        (sigma - furrow.split_from) / (furrow.split_to - furrow.split_from);
                    return t <= 0.0 || t >= 1.0 ? 0.0 : 0.022 * torn * 4.0 * t * (1.0 - t);
                };
                if (torn > 0.0)
                    add_line(Part::stem, DamageKind::crack, a * aspect, place(a), b * aspect,
                             place(b), open(a), open(b), 1.0, seed);
            }
        }
    }

    void add_notches(const std::vector<Notch>& notches, DamageKind kind, double amount) {
        const double radius = length_of_step(params_.metrics.cap_radius);
        for (const Notch& notch : notches) {
            const double scale = grown(notch.onset, amount);
            if (scale <= 0.0) continue;
            // The lips of a split move apart while it grows.
            const double open = notch.bitten ? 1.0 : power(scale, lip_power);
            for (const Part part : {Part::cap, Part::hymenium}) {
                const double arc = length_of_step(part == Part::cap ? params_.metrics.cap_arc
                                                                    : params_.metrics.hymenium_arc);
                const ChartSpace chart(plan_, part);
                const double under = part == Part::cap ? 1.0 : 1.0 + notch.undercut;
                const double depth = std::min(notch.depth * under * scale * radius / arc, 0.9);
                // Width of the gnawed or frayed border beyond the cut.
                const double rim = std::min(kind == DamageKind::bite ? 0.028 : 0.012, depth) *
                                   (part == Part::cap ? 1.0 : 0.6);
                // A cut shallower than a texel has the opacity of its share of the texel.
                const double shown = std::min(1.0, depth * chart.unit() / chart.texel());
                if (notch.bitten) {
                    for (const Scallop& scallop : notch.scallops)
                        add_margin_spot(part, kind, notch.theta + scallop.middle * notch.half_width,
                                        scallop.half_width * notch.half_width,
                                        scallop.depth * depth * chart.unit(), rim, notch.id, shown);
                    continue;
                }
                add_margin_spot(part, kind, notch.theta, notch.half_width * open,
                                depth * chart.unit(), rim, notch.id, shown);
                SpotPlan& painted = plan_.damage.damage_spots[index_of(part)].back();
                painted.per_width = single(1.0 / (notch.lips[1].corners.back().across * open));
                painted.x = single(1.0 / (notch.lips[0].corners.back().across * open));
            }
        }
    }

    void add_tongues(double amount) {
        const double most = params_.surface.damage.peel_reach;
        for (const Tongue& tongue : tongues(params_.damage_seed)) {
            const double scale = grown(tongue.onset, amount);
            if (scale <= 0.0 || most <= 0.0) continue;
            add_margin_spot(Part::cap, DamageKind::tongue, tongue.theta,
                            tongue.half_width * (0.6 + 0.4 * scale),
                            std::min(tongue.reach * most * scale, 0.95), 0.05, 200U + tongue.id,
                            std::min(1.0, 4.0 * scale));
            SpotPlan& painted = plan_.damage.damage_spots[0].back();
            painted.x = single(tongue.phases[0]);
            painted.y = single(tongue.phases[1]);
            painted.length = single(tongue.phases[2]);
        }
    }

    void add_margin_spot(Part part, DamageKind kind, double theta, double half_width, double depth,
                         double rim, std::uint32_t id, double strength) {
        const SineCosine turn = sine_cosine(theta);
        const double out = depth + 2.5 * rim;
        SpotPlan painted;
        painted.shape = DamageShape::margin;
        painted.kind = kind;
        painted.along_x = single(turn.cosine);
        painted.along_y = single(turn.sine);
        painted.per_length = single(1.0 / std::max(depth, 1e-4));
        painted.per_width = single(1.0 / half_width);
        painted.rim = single(rim / std::max(std::min(depth, half_width), 1e-4));
        painted.height = single(rim);
        painted.strength = single(strength);
        // Bounding circle of an arc of the rim with the depth of the mark.
        const double middle = 1.0 - 0.5 * out + 0.03;
        painted.middle_x = single(middle * turn.cosine);
        painted.middle_y = single(middle * turn.sine);
        painted.reach = painted.rows =
            single(std::max(1.35 * half_width + 2.0 * rim, 0.5 * out + 0.08) + 0.06);
        painted.seed = Random(params_.damage_seed, purposes::painted_damage + 7U, id).bits();
        add(part, painted);
    }

    const PaintParams& params_;
    PaintPlan& plan_;
};

void sort_into_rows(PaintPlan& plan, Part part) {
    const auto& painted_spots = plan.damage.damage_spots[index_of(part)];
    auto& by_row = plan.damage.by_row[index_of(part)];
    if (painted_spots.empty()) return;
    const Frame& frame = plan.frames[index_of(part)];
    const double inset = frame.inset;
    const double per = part == Part::stem ? 1.0 - 2.0 * inset : 0.5 - inset;
    const double last = frame.height + 1.0;
    struct Rows {
        std::size_t from, to;
    };
    std::vector<Rows> crossed;
    crossed.reserve(painted_spots.size());
    by_row.first.assign(static_cast<std::size_t>(frame.height) + 3, 0);
    for (const SpotPlan& painted : painted_spots) {
        const double middle =
            (part == Part::stem ? inset + per * static_cast<double>(painted.middle_y)
                                : 0.5 + per * static_cast<double>(painted.middle_y)) *
            frame.height;
        const double half = static_cast<double>(painted.rows) * per * frame.height + 1.0;
        const Rows rows{static_cast<std::size_t>(std::clamp(middle - half + 1.0, 0.0, last)),
                        static_cast<std::size_t>(std::clamp(middle + half + 2.0, 0.0, last))};
        crossed.push_back(rows);
        for (std::size_t y = rows.from; y < rows.to; ++y) ++by_row.first[y + 1];
    }
    std::partial_sum(by_row.first.begin(), by_row.first.end(), by_row.first.begin());
    by_row.spot_index.resize(by_row.first.back());
    std::vector<std::uint32_t> next = by_row.first;
    for (std::size_t i = 0; i < crossed.size(); ++i)
        for (std::size_t y = crossed[i].from; y < crossed[i].to; ++y)
            by_row.spot_index[next[y]++] = static_cast<std::uint32_t>(i);
}

}  // namespace

void plan_damage(const PaintParams& params, PaintPlan& plan) {
    DamagePlan& damage = plan.damage;
    const DamageSurface& look = params.surface.damage;
    damage.flesh = light_of(params.surface.flesh.colour);
    damage.bruise = light_of(look.bruise);
    damage.faded = light_of(look.faded);
    damage.dusty = light_of(look.dust);
    damage.dust = single(params.weathering.dust);
    damage.melted = single(params.weathering.deliquescence);
    damage.seed = Random(params.damage_seed, purposes::damage_grain).bits();
    const double gone = melted(params.weathering.deliquescence);
    const double arc = length_of_step(params.metrics.cap_arc),
                 lower = std::max(length_of_step(params.metrics.hymenium_arc), 1e-5);
    damage.ink_front = single(1.0 - gone);
    damage.ink_lower = single(std::max(0.0, 1.0 - gone * arc / lower));
    DamagePlanner(params, plan).add_all();
    for (const Part part : {Part::cap, Part::hymenium, Part::stem}) sort_into_rows(plan, part);
}

}  // namespace sporeprint
