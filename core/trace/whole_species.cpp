#include "core/trace/whole_species.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/math/elementary.h"
#include "core/params/messages.h"
#include "core/problems.h"
#include "core/silhouette/morph_set.h"
#include "core/silhouette/outline.h"
#include "core/trace/fit.h"

namespace sporeprint::trace {

namespace {

/// Ages at least so far from the traced one take over least, and what they take over.
constexpr double farthest = 0.6, least_taken = 0.6;

/// Ratios beyond these are not meant: they come from places near the axis or the ground.
constexpr double least_ratio = 0.2, most_ratio = 5.0;

const Silhouette& silhouette_of(const Stage& stage) {
    return std::get<Swept>(stage.model.shape).silhouette;
}

/// Returns the greatest height of an outline.
double height_of(const Silhouette& silhouette) {
    double height = 0.0;
    for (const auto* part : {&silhouette.stem, &silhouette.hymenium, &silhouette.cap})
        for (const OutlinePoint& point : *part) height = std::max(height, point.y);
    return height;
}

std::size_t nearest_stage(const Species& species, double age) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < species.stages.size(); ++i)
        if (std::abs(species.stages[i].age - age) < std::abs(species.stages[nearest].age - age))
            nearest = i;
    return nearest;
}

std::vector<OutlinePoint>& part_of(Silhouette& silhouette, CurveName curve) {
    return curve == CurveName::stem       ? silhouette.stem
           : curve == CurveName::hymenium ? silhouette.hymenium
                                          : silhouette.cap;
}

/// Returns a ratio of two lengths that is bounded; 1 where one is too small to tell.
double ratio(double of, double to, double least) {
    if (of < least || to < least) return 1.0;
    return std::clamp(of / to, least_ratio, most_ratio);
}

/// Changes outlines as one of them is changed.
class Change {
  public:
    Change(const Silhouette& from, const Silhouette& to)
        : to_(to),
          from_outline_(Outline::unproven(from, "/template")),
          to_outline_(Outline::unproven(to, "/silhouette")),
          size_(height_of(to) / height_of(from)) {
        for (const CurveName curve : curve_names) {
            if (part_of(to_, curve).empty()) continue;
            // Control points are the ends of the spline's segments.
            std::vector<double>& shares = shares_[static_cast<std::size_t>(curve)];
            shares = to_outline_.of(curve).segment_shares();
            if (shares.size() != part_of(to_, curve).size())
                throw GenerationError("a spline has a segment between two control points");
        }
    }

    /// Returns another outline with the same change.
    ///
    /// taken  how far ratios count, 0..1, rather than the change in size alone
    [[nodiscard]] Silhouette of(const Silhouette& other, double taken) const {
        const Outline outline = Outline::unproven(other, "/template");
        const double least = 0.01 * height_of(to_);
        Silhouette made = to_;
        made.junction = other.junction;
        made.margin = other.margin;
        for (const CurveName curve : curve_names) {
            std::vector<OutlinePoint>& points = part_of(made, curve);
            const std::vector<double>& shares = shares_[static_cast<std::size_t>(curve)];
            for (std::size_t i = 0; i < points.size(); ++i) {
                const OutlineSample own = outline.of(curve).at(shares[i]),
                                    before = from_outline_.of(curve).at(shares[i]),
                                    after = to_outline_.of(curve).at(shares[i]);
                const double wide = ratio(after.r, before.r * size_, least),
                             high = ratio(after.y, before.y * size_, least);
                points[i] = {own.r * size_ * power(wide, taken),
                             own.y * size_ * power(high, taken)};
            }
        }
        made.stem.front().r = made.cap.back().r = 0.0;
        if (!made.hymenium.empty()) made.hymenium.front() = made.stem.back();
        made.cap.front() = made.hymenium.empty() ? made.stem.back() : made.hymenium.back();
        return made;
    }

  private:
    Silhouette to_;
    Outline from_outline_, to_outline_;
    double size_;
    std::array<std::vector<double>, 3> shares_;
};

}  // namespace

bool can_be_template(const Species& species, bool has_face) {
    return std::all_of(species.stages.begin(), species.stages.end(), [&](const Stage& stage) {
        const auto* swept = std::get_if<Swept>(&stage.model.shape);
        return swept && height_of(swept->silhouette) > 0.0 &&
               swept->silhouette.hymenium.empty() != has_face;
    });
}

void require_template(const Species& species, bool has_face) {
    const std::string name = in_quotes(species.id.view());
    for (const Stage& stage : species.stages) {
        const auto* swept = std::get_if<Swept>(&stage.model.shape);
        if (!swept || height_of(swept->silhouette) <= 0.0)
            throw InvalidInput("/template", name + " has no outline; choose another species");
        if (swept->silhouette.hymenium.empty() != has_face) continue;
        throw InvalidInput(
            "/template",
            has_face ? name +
                           " has no lower face, and what was traced has one; choose another "
                           "species, or the form morel, club or puffball"
                     : name +
                           " has a lower face, and what was traced has none; choose another "
                           "species, or the form capped, funnel or cup");
    }
}

const Silhouette& silhouette_at(const Species& species, double age) {
    return silhouette_of(species.stages[nearest_stage(species, age)]);
}

double height_at(const Species& species, double age) {
    return height_of(silhouette_at(species, age));
}

Certificate growth_certificate(const Species& species) {
    std::vector<ControlShape> shapes;
    shapes.reserve(species.stages.size());
    double size = 0.0;
    for (const Stage& stage : species.stages)
        size = std::max(size, height_of(silhouette_of(stage)));
    for (const Stage& stage : species.stages)
        shapes.push_back({silhouette_of(stage), size, 0, stage.age});
    Certificate all;
    const auto add = [&all](const Certificate& one) {
        all.simple = all.simple && one.simple;
        all.method = std::max(all.method, one.method);
        all.indirect = std::max(all.indirect, one.indirect);
    };
    try {
        const MorphSet set(shapes);
        const auto between = [&](const Stage& from, const Stage& to) {
            add(set.certificate(set.growth_weights(from.age), set.growth_weights(to.age)));
        };
        for (std::size_t i = 0; i + 1 < species.stages.size(); ++i)
            between(species.stages[i], species.stages[i + 1]);
        between(species.stages.front(), species.stages.back());
    } catch (const Impossible&) {
        return {false, ProofMethod::checked, 0.0};
    }
    return all;
}

WholeSpecies whole_species(const Species& template_species, const Swept& shape, double age) {
    require_template(template_species, !shape.silhouette.hymenium.empty());
    WholeSpecies found{template_species, nearest_stage(template_species, age), 1.0, {}};
    const std::vector<Stage>& stages = template_species.stages;
    const Change change(silhouette_of(stages[found.stage]), shape.silhouette);
    while (true) {
        for (std::size_t i = 0; i < stages.size(); ++i) {
            auto& swept = std::get<Swept>(found.species.stages[i].model.shape);
            const double away =
                std::min(std::abs(stages[i].age - stages[found.stage].age) / farthest, 1.0);
            swept.silhouette = i == found.stage
                                   ? shape.silhouette
                                   : change.of(silhouette_of(stages[i]),
                                               found.likeness * (1.0 - (1.0 - least_taken) * away));
            swept.axis = unfolded(shape.axis, swept.silhouette);
        }
        found.certificate = growth_certificate(found.species);
        if (found.likeness == 0.0 || found.certificate.simple) return found;
        found.likeness = found.likeness > 0.1 ? 0.5 * found.likeness : 0.0;
    }
}

WholeSpecies sized_species(const Species& template_species, const std::vector<AxisPoint>& axis,
                           double height_m, double age) {
    WholeSpecies found{template_species, nearest_stage(template_species, age), 0.0, {}};
    const double size = height_m / height_at(template_species, age);
    for (Stage& stage : found.species.stages) {
        auto& swept = std::get<Swept>(stage.model.shape);
        for (const CurveName curve : curve_names)
            for (OutlinePoint& point : part_of(swept.silhouette, curve))
                point = {size * point.r, size * point.y};
        swept.axis = unfolded(axis, swept.silhouette);
    }
    found.certificate = growth_certificate(found.species);
    return found;
}

void move_ages(Species& species, std::size_t stage, double age) {
    const double before = species.stages.at(stage).age;
    // Four digits, so that the document is short; stages are farther apart.
    constexpr double digits = 1e4;
    for (Stage& other : species.stages) {
        const double moved = other.age == before ? age
                             : other.age < before
                                 ? other.age * age / before
                                 : age + (other.age - before) * (1.0 - age) / (1.0 - before);
        other.age = std::floor(moved * digits + 0.5) / digits;
    }
}

double hollow_of(const Silhouette& silhouette) {
    double edge = silhouette.hymenium.back().y;
    for (const OutlinePoint& point : silhouette.cap) edge = std::max(edge, point.y);
    const double above = edge - silhouette.stem.back().y;
    return above > 0.0
               ? std::clamp((edge - silhouette.cap.back().y) / above, least_hollow, most_hollow)
               : least_hollow;
}

TraceParams params_like(const Species& species, double age, double height_m) {
    TraceParams params;
    params.height_m = height_m;
    const Stage& stage = species.stages[nearest_stage(species, age)];
    const std::optional<Form> form = form_of(species.facts.form);
    const auto* swept = std::get_if<Swept>(&stage.model.shape);
    if (!form || !swept) return params;
    params.form = *form;
    if (is_hollow(*form)) params.hollow = hollow_of(swept->silhouette);
    return params;
}

}  // namespace sporeprint::trace
