// The parameter structs that the tests of core/params read, write and blend: one member of each
// kind.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "core/params/describe.h"

namespace sporeprint::sample {

enum class Animation { none, growth };

constexpr const char* name(Animation animation) {
    switch (animation) {
        case Animation::none:
            return "none";
        case Animation::growth:
            return "growth";
    }
    return nullptr;
}

struct Cap {
    double radius = 0.04;
    double tilt_deg = 4.0;
    int gill_count = 90;
    Colour colour{0xd2, 0x2b, 0x1f};

    static constexpr void fields(auto visit) {
        visit(&Cap::radius, Info{.name = "radius",
                                 .unit = "m",
                                 .min = 0.002,
                                 .max = 0.5,
                                 .doc = "Distance from axis to rim.",
                                 .step = 0.001});
        visit(&Cap::tilt_deg, Info{.name = "tilt_deg",
                                   .unit = "deg",
                                   .min = 0,
                                   .max = 60,
                                   .doc = "Lean of the cap against the stem."});
        visit(&Cap::gill_count,
              Info{.name = "gill_count", .min = 0, .max = 400, .doc = "Number of full gills."});
        visit(&Cap::colour, Info{.name = "colour", .doc = "Colour of the skin."});
    }
    bool operator==(const Cap&) const = default;
};

/// A point of an outline, for lists of structs.
struct Knot {
    double r = 0.1, y = 0.2;

    static constexpr void fields(auto visit) {
        visit(&Knot::r,
              Info{.name = "r", .unit = "m", .min = 0, .max = 1, .doc = "Distance from the axis."});
        visit(&Knot::y,
              Info{.name = "y", .unit = "m", .min = -1, .max = 1, .doc = "Height above ground."});
    }
    bool operator==(const Knot&) const = default;
};

struct Swept {
    static constexpr const char* form = "swept";
    std::vector<Knot> outline = {{0.1, 0.0}, {0.2, 0.5}};
    double twist = 0.0;

    static constexpr void fields(auto visit) {
        visit(&Swept::outline, Info{.name = "outline", .most = 8, .doc = "Knots, base to apex."});
        visit(&Swept::twist,
              Info{.name = "twist", .min = -1, .max = 1, .doc = "Turns per height."});
    }
    bool operator==(const Swept&) const = default;
};

struct Branched {
    static constexpr const char* form = "branched";
    std::uint32_t forks = 3;

    static constexpr void fields(auto visit) {
        visit(&Branched::forks,
              Info{.name = "forks", .min = 1, .max = 9, .doc = "How often a branch divides."});
    }
    bool operator==(const Branched&) const = default;
};

/// A form without parameters of its own.
struct Bare {
    static constexpr const char* form = "bare";
    static constexpr void fields(auto) {}
    bool operator==(const Bare&) const = default;
};

/// A shape inlined beside a surface: {"form": "swept", "outline": [...], "gloss": 0.5}.
struct Model {
    std::variant<Swept, Branched> shape;
    double gloss = 0.5;

    static constexpr void fields(auto visit) {
        visit(&Model::shape, Info{.name = ""});
        visit(&Model::gloss, Info{.name = "gloss", .min = 0, .max = 1, .doc = "Wetness."});
    }
    bool operator==(const Model&) const = default;
};

template <template <class> class M>
struct BendOf {
    M<double> bend_deg{};
    M<Animation> mode{};

    static constexpr void fields(auto visit) {
        visit(&BendOf::bend_deg, Info{.name = "bend_deg",
                                      .unit = "deg",
                                      .min = 0,
                                      .max = 90,
                                      .doc = "Bend of the axis."});
        visit(&BendOf::mode, Info{.name = "mode", .doc = "How it bends."});
    }
    bool operator==(const BendOf&) const = default;
};

template <template <class> class M>
struct DeformationOf {
    BendOf<M> low, high;
    M<double> taper{};

    static constexpr void fields(auto visit) {
        visit(&DeformationOf::low, Info{.name = "low", .doc = "Below the middle."});
        visit(&DeformationOf::high, Info{.name = "high", .doc = "Above the middle."});
        visit(&DeformationOf::taper,
              Info{.name = "taper", .min = -1, .max = 1, .doc = "Narrowing."});
    }
    bool operator==(const DeformationOf&) const = default;
};

/// The cross-field rule: the stem is thinner than the cap.
struct Request {
    std::uint32_t seed = 1;
    double age = 0.6;
    bool has_ring = false;
    Animation animation = Animation::none;
    Choice<128, 256, 512, 1024> texture_size{1024};
    float rough = 0.3f;
    Cap cap;
    Knot origin;  // inlined
    double stem_radius = 0.008;
    DeformationOf<Maybe> deformation;
    std::optional<Colour> tint;
    std::optional<Range> season;
    std::optional<Cap> spare;
    Text<12> v;
    Model model;
    std::variant<Bare, Branched> roots;
    std::variant<Bare> ground;
    Range span{0.25, 0.5};
    std::array<double, 3> wind{0.0, 0.0, 0.0};
    std::vector<double> profile = {1.0, 0.9, 1.1};
    std::vector<Text<8>> tags;
    Upload image;

    static constexpr void fields(auto visit) {
        visit(&Request::seed,
              Info{.name = "seed", .min = 0, .max = 4294967295.0, .doc = "The individual."});
        visit(&Request::age, Info{.name = "age", .min = 0, .max = 1, .doc = "Button to decay."});
        visit(&Request::has_ring, Info{.name = "has_ring", .doc = "Whether a ring is left."});
        visit(&Request::animation, Info{.name = "animation", .doc = "What moves."});
        visit(&Request::texture_size, Info{.name = "texture_size", .doc = "Side of the atlas."});
        visit(&Request::rough, Info{.name = "rough", .min = 0.1, .max = 0.3, .doc = "Roughness."});
        visit(&Request::cap, Info{.name = "cap", .doc = "The cap and its gills."});
        visit(&Request::origin, Info{.name = ""});
        visit(&Request::stem_radius, Info{.name = "stem_radius",
                                          .unit = "m",
                                          .min = 0.0005,
                                          .max = 0.1,
                                          .doc = "Radius at half height."});
        visit(&Request::deformation, Info{.name = "deformation", .doc = "Bends."});
        visit(&Request::tint, Info{.name = "tint", .doc = "Another colour."});
        visit(&Request::season,
              Info{.name = "season", .min = 1, .max = 12, .doc = "Months of growth."});
        visit(&Request::spare, Info{.name = "spare", .doc = "A second cap."});
        visit(&Request::v, Info{.name = "v", .doc = "Version token."});
        visit(&Request::model, Info{.name = "model", .doc = "Shape and surface."});
        visit(&Request::roots, Info{.name = "roots", .doc = "What is below ground."});
        visit(&Request::ground, Info{.name = "ground", .doc = "What it stands on."});
        visit(&Request::span, Info{.name = "span", .min = 0, .max = 1, .doc = "Zone."});
        visit(&Request::wind, Info{.name = "wind", .min = -9, .max = 9, .doc = "Wind vector."});
        visit(&Request::profile,
              Info{.name = "profile", .min = 0.1, .max = 4, .most = 16, .doc = "Stem radii."});
        visit(&Request::tags, Info{.name = "tags", .most = 4, .doc = "Labels."});
        visit(&Request::image, Info{.name = "image", .most = 1000, .doc = "A picture."});
    }
    void check(const std::string& path, std::vector<Problem>& problems) const {
        if (stem_radius >= cap.radius)
            report(problems, path + "/stem_radius", "must be smaller than /cap/radius");
    }
    bool operator==(const Request&) const = default;
};

static_assert(well_described<Request>());

}  // namespace sporeprint::sample
