#include "core/individual/sources.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/individual/gill_layout.h"
#include "core/problems.h"
#include "core/silhouette/weights.h"

namespace sporeprint {

namespace {

std::vector<double> growth_weights(const std::vector<Stage>& stages, double age) {
    std::vector<double> weights(stages.size(), 0.0);
    if (age <= stages.front().age) {
        weights.front() = 1.0;
        return weights;
    }
    for (std::size_t i = 1; i < stages.size(); ++i)
        if (age <= stages[i].age) {
            weights[i] = (age - stages[i - 1].age) / (stages[i].age - stages[i - 1].age);
            weights[i - 1] = 1.0 - weights[i];
            return weights;
        }
    weights.back() = 1.0;
    return weights;
}

/// Returns the overall size of a shape: the half diagonal of the bounding box of its control points
/// rotated about the axis, or the height of a branched shape.
double size_of(const Model& model) {
    if (const auto* branched = std::get_if<Branched>(&model.shape))
        return branched->segments.height;
    const Silhouette& s = silhouette_of(model);
    double radius = 0.0, low = s.stem.front().y, high = low;
    for (const auto* part : {&s.stem, &s.hymenium, &s.cap})
        for (const OutlinePoint& p : *part) {
            radius = std::max(radius, p.r);
            low = std::min(low, p.y);
            high = std::max(high, p.y);
        }
    return std::sqrt(radius * radius + 0.25 * (high - low) * (high - low));
}

Source source_of(const AtlasEntry& entry, double weight, double age) {
    const Species& species = entry.species;
    Source source;
    source.id = species.id.string();
    const Facts& facts = species.facts;
    source.label =
        (facts.scientific_name.view().empty() ? facts.common_name : facts.scientific_name).string();
    source.weight = weight;
    source.hash = entry.hash;
    source.spread = species.spread;
    source.ground = species.ground;
    source.wood = wood_of(facts);
    source.growth = growth_weights(species.stages, age);
    source.mature = growth_weights(species.stages, mature_age);
    Shares<Model> stages;
    double size = 0.0;
    for (std::size_t i = 0; i < species.stages.size(); ++i) {
        const Model& model = species.stages[i].model;
        source.stages.push_back(&model);
        source.ages.push_back(species.stages[i].age);
        stages.add(model, source.growth[i]);
        size += source.mature[i] * size_of(model);
    }
    source.size = size;
    source.now = blend(stages);
    // Blades and tiers are taken together from one stage: they form one layout.
    GillLayout most;
    for (const Model* stage : source.stages) {
        const GillLayout gill_layout{stage->hymenium.blades, stage->hymenium.tiers};
        if (gill_layout.at_margin() > most.at_margin()) most = gill_layout;
    }
    source.now.hymenium.blades = most.blades;
    source.now.hymenium.tiers = most.tiers;
    return source;
}

/// Refuses mixes of swept and branched shapes, which have no correspondence.
void refuse_two_families(const std::vector<Source>& sources) {
    std::string branching, others;
    int one = 0, other = 0;
    for (const Source& source : sources) {
        std::string& names = source.is_branched() ? branching : others;
        if (!names.empty()) names += ", ";
        names += source.label;
        ++(source.is_branched() ? one : other);
    }
    if (one > 0 && other > 0)
        throw Impossible("mix", branching + (one > 1 ? " branch; " : " branches; ") + others +
                                    (other > 1 ? " do not" : " does not") +
                                    ": a mix needs one family");
}

}  // namespace

const Silhouette& silhouette_of(const Model& model) {
    return std::get<Swept>(model.shape).silhouette;
}

std::vector<Source> sources_of(const MushroomSpec& spec, const Atlas& atlas) {
    std::vector<Source> sources;
    if (spec.model) {
        Source own;
        own.label = "this model";
        own.stages = {&*spec.model};
        own.ages = {mature_age};
        own.growth = {1.0};
        own.mature = {1.0};
        own.size = size_of(*spec.model);
        own.now = *spec.model;
        sources.push_back(std::move(own));
        return sources;
    }
    std::vector<Problem> problems;
    if (spec.mix.empty() || spec.mix.size() > most_blended)
        report(problems, "mix",
               std::to_string(spec.mix.size()) + " species; a mix has 1 to " +
                   std::to_string(most_blended));
    double sum = 0.0;
    for (const MixPart& part : spec.mix) {
        if (!atlas.find(part.id))
            report(problems, "mix", "'" + part.id + "' is no species of the atlas");
        if (part.weight <= 0)
            report(problems, "mix", "the weight of '" + part.id + "' is not positive");
        for (const MixPart& other : spec.mix)
            if (&other < &part && other.id == part.id)
                report(problems, "mix", "'" + part.id + "' is named twice");
        sum += part.weight;
    }
    if (!problems.empty()) throw InvalidInput(std::move(problems));
    Mix mix = spec.mix;
    std::sort(mix.begin(), mix.end(),
              [](const MixPart& a, const MixPart& b) { return a.id < b.id; });
    std::vector<double> weights;
    for (const MixPart& part : mix) weights.push_back(part.weight / sum);
    weights = eased_weights(std::move(weights));
    for (std::size_t i = 0; i < mix.size(); ++i)
        sources.push_back(source_of(*atlas.find(mix[i].id), weights[i], spec.params.age));
    refuse_two_families(sources);
    return sources;
}

}  // namespace sporeprint
