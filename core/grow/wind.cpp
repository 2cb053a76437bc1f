#include "core/grow/wind.h"

#include <algorithm>
#include <array>
#include <string>

#include "core/colony/cap.h"
#include "core/grow/mushroom.h"
#include "core/math/elementary.h"
#include "core/problems.h"

namespace sporeprint {

namespace {

/// Dynamic pressure of a breeze of 3 m/s, Pa: half of 1.2 kg/m^3 times its square.
constexpr double pressure = 5.4;
/// Drag coefficient of a cap, and Young's modulus of the flesh of a stem, Pa: estimates between
/// those of a sphere and a disc, and of fresh plant tissue.
constexpr double drag = 0.8, modulus = 2e6;
/// Largest displacement of the top, in heights: a bent stem turns its cap out of the wind.
constexpr double most_displacement = 0.3;

/// Returns the channels of bend, flutter, phase and branch.
std::array<const char*, 4> channels_of(WindFormat format) {
    switch (format) {
        case WindFormat::uv:
            return {"TEXCOORD_1.x", "TEXCOORD_2.x", "TEXCOORD_1.y", "TEXCOORD_2.y"};
        case WindFormat::attribute:
            return {"_WIND.x", "_WIND.y", "_WIND.z", "_WIND.w"};
        case WindFormat::color:
            return {"COLOR_0.x", "COLOR_0.y", "COLOR_0.z", "COLOR_0.w"};
        case WindFormat::none:
            break;
    }
    throw GenerationError("a file without wind has no channels");
}

}  // namespace

Value wind_value(const Wind& wind) {
    const auto [bend, flutter, phase, branch] = channels_of(wind.format);
    Value channels = Value::object();
    channels.set("bend", Value(std::string(bend)));
    channels.set("flutter", Value(std::string(flutter)));
    channels.set("phase", Value(std::string(phase)));
    channels.set("branch", Value(std::string(branch)));
    return Value::object()
        .set("channels", std::move(channels))
        .set("sway_m", Value(wind.sway))
        .set("flutter_m", Value(wind.flutter));
}

double deflection(double along) {
    if (along <= 0.0) return 0.0;
    if (along >= 1.0) return 1.0 + 1.5 * (along - 1.0);
    return 0.5 * along * along * (3.0 - along);
}

SwayingStem swaying_stem(const Individual& individual) {
    if (individual.grows_from_wall()) return {};
    const StemFit fit = stem_fit(individual);
    if (individual.is_branched()) return {fit.height, fit.radius, fit.height, fit.cap_radius};
    double top = fit.height;
    for (const double along : {0.0, 0.25, 0.5, 0.75, 1.0})
        top = std::max(top, individual.outline.cap.at(along).y);
    // What has no stem is its own.
    const bool has_stem = fit.height > fit.radius;
    return {has_stem ? fit.height : top, has_stem ? fit.radius : fit.cap_radius, top,
            fit.cap_radius};
}

double displacement_of_top(const SwayingStem& stem) {
    if (!(stem.length > 0.0)) return 0.0;
    const double depth = std::max(stem.top - stem.length, 0.2 * stem.cap_radius);
    const double force = pressure * drag * 0.5 * pi * stem.cap_radius * depth;
    const double inertia = 0.25 * pi * stem.radius * stem.radius * stem.radius * stem.radius;
    const double of_end =
        force * stem.length * stem.length * stem.length / (3.0 * modulus * inertia);
    return std::min(of_end * deflection(stem.top / stem.length), most_displacement * stem.top);
}

std::vector<Sway> sway_of(const Mesh& mesh, const SwayingStem& stem) {
    std::vector<Sway> sway(mesh.positions.size());
    if (!(stem.length > 0.0)) return sway;
    const double most = deflection(stem.top / stem.length);
    for (std::size_t i = 0; i < sway.size(); ++i) {
        const double along = static_cast<double>(mesh.positions[i].y) / stem.length;
        sway[i].bend = static_cast<float>(std::min(deflection(along) / most, 1.0));
    }
    return sway;
}

}  // namespace sporeprint
