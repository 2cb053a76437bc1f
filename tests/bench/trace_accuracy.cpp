// How near a traced mushroom comes to the one that was traced: individuals of all species of a form are drawn by a
// camera, their outlines are traced, and what grows of them is drawn by the same camera.
//   trace_accuracy [--pitch 5] [--seeds 2] [--form capped]
// Prints the mean distance of both contours in % of the height, by species, and what the bars of a release are about.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "core/grow/mushroom.h"
#include "core/individual/mushroom_spec.h"
#include "core/math/elementary.h"
#include "core/trace/contour.h"
#include "core/trace/refine.h"
#include "core/trace/trace.h"
#include "core/trace/whole_species.h"
#include "tests/support/atlas.h"
#include "tests/support/contours.h"
#include "tests/support/photographs.h"

namespace {

using namespace sporeprint;

constexpr int side = 1024;
/// Of the largest side of the mushroom on the picture, pixels.
constexpr double pixels = 820.0;
/// Of the camera, in heights of the mushroom: as a tele lens has it.
constexpr double distance = 8.0;

/// Returns the pixels of a mesh before a camera that looks down by an angle.
trace::Mask seen(const Mesh& mesh, double pitch_deg) {
    const auto [sine, cosine] = sine_cosine(radians(pitch_deg));
    const Bounds box = bounds(mesh);
    const double height = box.max.y - box.min.y, middle = 0.5 * (box.max.y + box.min.y);
    std::vector<glm::dvec2> at;
    at.reserve(mesh.positions.size());
    glm::dvec2 low(1e300), high(-1e300);
    for (const glm::vec3& position : mesh.positions) {
        const double y = position.y - middle,
                     depth = distance * height - (position.z * cosine + y * sine);
        const glm::dvec2 place(position.x / depth, -(y * cosine - position.z * sine) / depth);
        low = {std::min(low.x, place.x), std::min(low.y, place.y)};
        high = {std::max(high.x, place.x), std::max(high.y, place.y)};
        at.push_back(place);
    }
    const double scale = pixels / std::max(high.x - low.x, high.y - low.y);
    for (glm::dvec2& place : at) place = 0.5 * side + scale * (place - 0.5 * (low + high));
    trace::Mask mask(side, side);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec2 a = at[mesh.indices[i]], b = at[mesh.indices[i + 1]],
                         c = at[mesh.indices[i + 2]];
        const auto edge = [](const glm::dvec2& from, const glm::dvec2& to,
                             const glm::dvec2& point) {
            return (to.x - from.x) * (point.y - from.y) - (to.y - from.y) * (point.x - from.x);
        };
        const auto first = [](double x, double y, double z) {
            return static_cast<int>(std::floor(std::min({x, y, z})));
        };
        const auto last = [](double x, double y, double z) {
            return static_cast<int>(std::ceil(std::max({x, y, z})));
        };
        for (int y = first(a.y, b.y, c.y); y <= last(a.y, b.y, c.y); ++y)
            for (int x = first(a.x, b.x, c.x); x <= last(a.x, b.x, c.x); ++x) {
                const glm::dvec2 point(x + 0.5, y + 0.5);
                const double u = edge(a, b, point), v = edge(b, c, point), w = edge(c, a, point);
                const bool is_inside =
                    (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
                if (is_inside && x >= 0 && y >= 0 && x < side && y < side)
                    mask.inside[mask.index(x, y)] = 1;
            }
    }
    // Without what is apart from it, such as the tip of a scale.
    trace::Mask line(side, side);
    for (const glm::dvec2& on : drawn_by_hand(mask).axis)
        line.inside[line.index(static_cast<int>(on.x), static_cast<int>(on.y))] = 1;
    return trace::connected_with(mask, line);
}

trace::Mask seen(MushroomSpec spec, double pitch_deg) {
    spec.params.textures = Textures::none;
    spec.params.base = Base::clean;
    return seen(mushroom_mesh(spec, resolve(spec, atlas())), pitch_deg);
}

/// Returns the error of one individual, of its height.
double error_of(const AtlasEntry& entry, std::uint32_t seed, double pitch_deg, trace::Form form) {
    constexpr double age = 0.7;
    MushroomSpec spec;
    spec.mix = {{entry.species.id.string(), 1000}};
    spec.params.age = age;
    spec.params.seed = seed;
    const trace::Mask truth = seen(spec, pitch_deg);
    trace::TraceParams params = trace::params_like(entry.species, age, 0.1);
    params.form = form;
    const trace::Traced found = trace::traced(truth, drawn_by_hand(truth), params);
    MushroomSpec own;
    Model model = entry.species.stages.back().model;
    model.shape = found.shape;
    model.deformation = {};
    model.ornaments = {};
    model.weathering = {};
    own.model = model;
    own.params.variation = 0.0;
    return contour_error(trace::contour_of(truth, 0.0),
                         trace::contour_of(seen(own, pitch_deg), 0.0));
}

}  // namespace

int main(int argc, char** argv) {
    double pitch_deg = 0.0;
    std::uint32_t seeds = 2;
    trace::Form form = trace::Form::capped;
    std::map<std::string, trace::Form> forms;
    for (const trace::Form one : {trace::Form::capped, trace::Form::morel, trace::Form::funnel,
                                  trace::Form::cup, trace::Form::club, trace::Form::puffball})
        forms[trace::name(one)] = one;
    CLI::App app("How near a traced mushroom comes to the one that was traced.", "trace_accuracy");
    app.add_option("--pitch", pitch_deg, "Degrees by which the camera looks down")
        ->check(CLI::Range(0.0, 60.0));
    app.add_option("--seeds", seeds, "Individuals of each species")->check(CLI::Range(1, 1000));
    app.add_option("--form", form, "Of the species")->transform(CLI::CheckedTransformer(forms));
    CLI11_PARSE(app, argc, argv);
    std::vector<double> errors;
    for (const AtlasEntry& entry : atlas().entries()) {
        if (!trace::can_be_template(entry.species, trace::has_face(form)) ||
            trace::params_like(entry.species, 0.7, 0.1).form != form)
            continue;
        std::printf("%-28s", entry.species.id.string().c_str());
        for (std::uint32_t seed = 1; seed <= seeds; ++seed) try {
                const double error = error_of(entry, seed, pitch_deg, form);
                errors.push_back(error);
                std::printf(" %5.2f", 100.0 * error);
            } catch (const std::exception& refusal) {
                std::printf(" (%s)", refusal.what());
            }
        std::printf("\n");
    }
    if (errors.empty()) return 1;
    std::sort(errors.begin(), errors.end());
    double mean = 0.0;
    for (const double error : errors) mean += error / static_cast<double>(errors.size());
    const auto within =
        std::count_if(errors.begin(), errors.end(), [](double error) { return error <= 0.01; });
    std::printf(
        "%s at %g degrees: %zu traced, mean %.2f %%, median %.2f, worst %.2f, within 1 %%: %.0f "
        "%%\n",
        trace::name(form), pitch_deg, errors.size(), 100.0 * mean,
        100.0 * errors[errors.size() / 2], 100.0 * errors.back(),
        100.0 * static_cast<double>(within) / static_cast<double>(errors.size()));
}
