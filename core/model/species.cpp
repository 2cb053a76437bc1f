#include "core/model/species.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace sporeprint {

namespace {

/// Reports the differences of a stage from the first that could not be interpolated.
class StageCheck {
  public:
    StageCheck(std::string path, std::vector<Problem>& problems)
        : path_(std::move(path)), problems_(problems) {}

    void operator()(const Model& first, const Model& model) {
        if (model.shape.index() != first.shape.index())
            return add("/form", "every stage has the form of the first");
        if (const auto* branched = std::get_if<Branched>(&model.shape))
            check_branched(std::get<Branched>(first.shape), *branched);
        if (const auto* swept = std::get_if<Swept>(&model.shape))
            check_swept(std::get<Swept>(first.shape), *swept);
        if (first.surface.cap.ramp.size() != model.surface.cap.ramp.size())
            add("/surface/cap/ramp", "every stage has as many colours as the first");
        if (first.surface.hymenium.pattern != model.surface.hymenium.pattern)
            add("/surface/hymenium/pattern", "every stage has the pattern of the first");
        if (first.surface.cap.skin.kind != model.surface.cap.skin.kind)
            add("/surface/cap/skin/kind", "every stage has the kind of the first");
        if (first.surface.stem.skin.kind != model.surface.stem.skin.kind)
            add("/surface/stem/skin/kind", "every stage has the kind of the first");
        check_places(first.warts, model.warts, "/warts");
        check_places(first.scales, model.scales, "/scales");
        check_places(first.volva, model.volva, "/volva");
        if (first.spines.count != model.spines.count || first.spines.from != model.spines.from ||
            first.spines.to != model.spines.to ||
            first.spines.is_folded() != model.spines.is_folded())
            add("/spines",
                "count, from, to and whether they have a breadth are those of the first stage");
        if (first.peridioles.count != model.peridioles.count)
            add("/peridioles/count",
                "every stage has as many as the first; how many are left is "
                "ornaments.peridioles");
        if (first.receptacle.meshes != model.receptacle.meshes)
            add("/receptacle/meshes",
                "every stage has as many as the first; how far it has "
                "unfolded is ornaments.receptacle");
    }

  private:
    void add(const char* member, std::string message) {
        report(problems_, path_ + member, std::move(message));
    }

    void check_branched(const Branched& first, const Branched& stage) {
        if (!(stage.ramification == first.ramification))
            add("/ramification", "every stage branches as the first; how far is limbs.unfolding");
        if (stage.segments.trunks != first.segments.trunks)
            add("/limbs/trunks", "every stage has as many trunks as the first");
    }

    void check_swept(const Swept& first, const Swept& stage) {
        const auto same = [&](std::size_t one, std::size_t other, const char* member) {
            if (one != other)
                add(member, std::to_string(other) + " control points; the first stage has " +
                                std::to_string(one));
        };
        same(first.silhouette.stem.size(), stage.silhouette.stem.size(), "/silhouette/stem");
        same(first.silhouette.hymenium.size(), stage.silhouette.hymenium.size(),
             "/silhouette/hymenium");
        same(first.silhouette.cap.size(), stage.silhouette.cap.size(), "/silhouette/cap");
        same(first.axis.size(), stage.axis.size(), "/axis");
    }

    // Places are drawn once per individual, so their parameters must be equal in all stages.
    void check_places(const PatchStyle& first, const PatchStyle& stage, const char* member) {
        if (!stage.has_places_of(first))
            add(member, "count, from, to, elongation and fray are those of the first stage");
    }

    std::string path_;  ///< of the model
    std::vector<Problem>& problems_;
};

}  // namespace

bool Species::is_lateral() const {
    return std::any_of(stages.begin(), stages.end(), [](const Stage& stage) {
        const auto* swept = std::get_if<Swept>(&stage.model.shape);
        return swept && swept->azimuth.lateral > Azimuth::wall_from;
    });
}

void Species::check(const std::string& path, std::vector<Problem>& problems) const {
    if (const std::string message = invalid_id_message(id); !message.empty())
        report(problems, path + "/id", message);
    if (stages.empty()) return report(problems, path + "/stages", "0 stages; at least 1 is needed");
    for (std::size_t i = 1; i < stages.size(); ++i) {
        const std::string stage = path + "/stages/" + std::to_string(i);
        if (stages[i].age <= stages[i - 1].age)
            report(problems, stage + "/age", "stages stand in ascending order of age");
        StageCheck(stage + "/model", problems)(stages.front().model, stages[i].model);
    }
}

}  // namespace sporeprint
