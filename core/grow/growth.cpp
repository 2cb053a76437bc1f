#include "core/grow/growth.h"

#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "core/grow/level_choice.h"
#include "core/grow/mushroom.h"
#include "core/params/messages.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// Runs the work for one frame; the message of an exception names the frame.
template <class Work>
auto at_age(double age, const Work& work) {
    try {
        return work();
    } catch (const Impossible& refused) {
        std::vector<Problem> problems = refused.problems();
        for (Problem& problem : problems)
            problem.message += " (in the clip, at age " + number_text(age) + ")";
        throw Impossible(std::move(problems));
    }
}

MorphTarget difference(const Mesh& from, const Mesh& to, double age, Targets moved) {
    // A clip requires equal topology: places of features are drawn once, and ages only move
    // vertices.
    if (to.positions.size() != from.positions.size() || to.indices != from.indices)
        throw GenerationError("the mesh at age " + number_text(age) + " has other triangles");
    MorphTarget target{"age " + number_text(age), {}, {}};
    target.positions.reserve(to.positions.size());
    for (std::size_t i = 0; i < to.positions.size(); ++i)
        target.positions.push_back(to.positions[i] - from.positions[i]);
    if (moved == Targets::position) return target;
    target.normals.reserve(to.normals.size());
    for (std::size_t i = 0; i < to.normals.size(); ++i)
        target.normals.push_back(to.normals[i] - from.normals[i]);
    return target;
}

}  // namespace

std::vector<double> frame_ages(int frames) {
    std::vector<double> ages;
    ages.reserve(static_cast<std::size_t>(frames));
    for (int k = 0; k < frames; ++k) ages.push_back(static_cast<double>(k) / (frames - 1));
    return ages;
}

GrowthClip growth_clip(const MushroomSpec& spec, const Individual& individual, const Atlas& atlas,
                       const Mesh& mesh, const ExecutionContext& execution) {
    const std::vector<double> ages = frame_ages(spec.params.frames);
    GrowthClip growth;
    growth.targets.resize(ages.size());
    std::vector<std::exception_ptr> errors(ages.size());
    std::vector<std::function<void()>> pieces;
    // Clips have whole levels only. A number of triangles is that of the mesh with its wood.
    const int level = first_level(spec, individual).lod;
    // All ages are weights of one set, so the correspondence is looked up once.
    std::map<std::string, std::shared_ptr<const MorphSet>> sets;
    const GetOrCompute<MorphSet> morphs = [&](const std::string& key, const auto& make) {
        std::shared_ptr<const MorphSet>& set = sets[key];
        if (!set) set = execution.caches.morphs(key, make);
        return set;
    };
    for (std::size_t k = 0; k < ages.size(); ++k) {
        const double age = ages[k];
        MushroomSpec frame = spec;
        frame.params.age = age;
        frame.params.substrate = Substrate::none;
        frame.params.lod = level;
        frame.params.triangles.reset();
        frame.params.textures = Textures::none;  // texture coordinates are those of the base mesh
        Individual at_frame = at_age(age, [&] { return resolve(frame, atlas, morphs); });
        at_frame.trunk_radius = individual.trunk_radius;
        pieces.emplace_back([&, k, age, frame, at_frame = std::move(at_frame)] {
            try {
                throw_if_cancelled(execution);
                growth.targets[k] =
                    difference(mesh, at_age(age, [&] { return mushroom_mesh(frame, at_frame); }),
                               age, frame.params.targets);
            } catch (...) {
                errors[k] = std::current_exception();
            }
        });
    }
    execution.parallel(pieces);
    // Of several errors the one of the youngest frame is thrown, for any number of worker threads.
    for (const std::exception_ptr& error : errors)
        if (error) std::rethrow_exception(error);
    growth.clip.name = name(Animation::growth);
    growth.clip.weights.assign(ages.size() * ages.size(), 0.0F);
    for (std::size_t k = 0; k < ages.size(); ++k) {
        growth.clip.times.push_back(static_cast<float>(ages[k] * growth_seconds));
        growth.clip.weights[k * ages.size() + k] = 1.0F;
    }
    return growth;
}

}  // namespace sporeprint
