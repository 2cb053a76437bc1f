#include "core/model/species.h"

namespace sporeprint {

void Species::check(const std::string& path, std::vector<Problem>& problems) const {
    if (const std::string message = invalid_id_message(id); !message.empty())
        report(problems, path + "/id", message);
    if (stages.empty()) return report(problems, path + "/stages", "0 stages; at least 1 is needed");
    const auto at = [&](std::size_t i, const char* what) {
        return path + "/stages/" + std::to_string(i) + what;
    };
    const Model& first = stages.front().model;
    for (std::size_t i = 1; i < stages.size(); ++i) {
        const Model& model = stages[i].model;
        if (stages[i].age <= stages[i - 1].age)
            report(problems, at(i, "/age"), "stages stand in ascending order of age");
        if (model.shape.index() != first.shape.index()) {
            report(problems, at(i, "/model/form"), "every stage has the form of the first");
            continue;
        }
        if (const auto* branched = std::get_if<Branched>(&model.shape)) {
            const auto& before = std::get<Branched>(first.shape);
            if (!(branched->ramification == before.ramification))
                report(problems, at(i, "/model/ramification"),
                       "every stage branches as the first; how far is limbs.unfolding");
            if (branched->segments.trunks != before.segments.trunks)
                report(problems, at(i, "/model/limbs/trunks"),
                       "every stage has as many trunks as the first");
        }
        const auto* const swept = std::get_if<Swept>(&model.shape);
        const Swept none, &a = swept ? std::get<Swept>(first.shape) : none,
                          &b = swept ? *swept : none;
        const auto same = [&](std::size_t one, std::size_t other, const char* what) {
            if (one != other)
                report(problems, at(i, what),
                       std::to_string(other) + " control points; the first stage has " +
                           std::to_string(one));
        };
        same(a.silhouette.stem.size(), b.silhouette.stem.size(), "/model/silhouette/stem");
        same(a.silhouette.hymenium.size(), b.silhouette.hymenium.size(),
             "/model/silhouette/hymenium");
        same(a.silhouette.cap.size(), b.silhouette.cap.size(), "/model/silhouette/cap");
        same(a.axis.size(), b.axis.size(), "/model/axis");
        if (first.surface.cap.ramp.size() != model.surface.cap.ramp.size())
            report(problems, at(i, "/model/surface/cap/ramp"),
                   "every stage has as many colours as the first");
        if (first.surface.hymenium.pattern != model.surface.hymenium.pattern)
            report(problems, at(i, "/model/surface/hymenium/pattern"),
                   "every stage has the pattern of the first");
        // Places are drawn once per individual, so their parameters must be equal in all stages.
        const auto placed = [&](const PatchStyle& one, const PatchStyle& other, const char* what) {
            if (one.count != other.count || one.from != other.from || one.to != other.to ||
                one.elongation != other.elongation)
                report(problems, at(i, what),
                       "count, from, to and elongation are those of the first stage");
        };
        placed(first.warts, model.warts, "/model/warts");
        placed(first.scales, model.scales, "/model/scales");
        placed(first.volva, model.volva, "/model/volva");
    }
}

}  // namespace sporeprint
