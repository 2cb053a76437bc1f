// A species: facts, growth stages, the spread of individuals, and the ecology. Each is one JSON file
// in core/atlas/species.
#pragma once

#include "core/model/ecology.h"
#include "core/model/ground.h"
#include "core/model/model.h"

namespace sporeprint {

/// The growth form in the terms of field guides.
enum class GrowthForm {
    agaric,
    bolete,
    chanterelle,
    club,
    cup,
    bracket,
    shelving_agaric,
    morel,
    false_morel,
    puffball,
    earthstar,
    tooth,
    trumpet,
    jelly,
    stinkhorn,
    coral,
    antler,
    crust,
    cushion,
    nest,
    cage
};

constexpr const char* name(GrowthForm form) {
    switch (form) {
        case GrowthForm::agaric:
            return "agaric";
        case GrowthForm::bolete:
            return "bolete";
        case GrowthForm::chanterelle:
            return "chanterelle";
        case GrowthForm::club:
            return "club";
        case GrowthForm::cup:
            return "cup";
        case GrowthForm::bracket:
            return "bracket";
        case GrowthForm::shelving_agaric:
            return "shelving_agaric";
        case GrowthForm::morel:
            return "morel";
        case GrowthForm::false_morel:
            return "false_morel";
        case GrowthForm::puffball:
            return "puffball";
        case GrowthForm::earthstar:
            return "earthstar";
        case GrowthForm::tooth:
            return "tooth";
        case GrowthForm::trumpet:
            return "trumpet";
        case GrowthForm::jelly:
            return "jelly";
        case GrowthForm::stinkhorn:
            return "stinkhorn";
        case GrowthForm::coral:
            return "coral";
        case GrowthForm::antler:
            return "antler";
        case GrowthForm::crust:
            return "crust";
        case GrowthForm::cushion:
            return "cushion";
        case GrowthForm::nest:
            return "nest";
        case GrowthForm::cage:
            return "cage";
    }
    return nullptr;
}

/// Recorded facts of a species. Sizes are those of maturity (age 0.6).
struct Facts {
    Text<64> scientific_name;
    Text<64> common_name;
    GrowthForm form = GrowthForm::agaric;
    std::optional<Range> cap_diameter_m;
    Range height_m{0.05, 0.1};
    Text<64> substrate;
    Text<96> habitat;
    Text<64> habit;
    Text<96> hymenium;
    Text<32> colour;
    std::vector<int> season;
    std::vector<Text<160>> sources;

    static constexpr void fields(auto visit) {
        using F = Facts;
        visit(&F::scientific_name, Info{.name = "scientific_name", .most = 64, .doc = "Binomial."});
        visit(&F::common_name, Info{.name = "common_name", .most = 64, .doc = "English name."});
        visit(&F::form, Info{.name = "form", .doc = "Growth form."});
        visit(&F::cap_diameter_m,
              Info{.name = "cap_diameter_m",
                   .unit = "m",
                   .min = 0.001,
                   .max = 1.0,
                   .doc = "Recorded cap diameter, of corals the width of the bush; absent for "
                          "forms without either."});
        visit(&F::height_m, Info{.name = "height_m",
                                 .unit = "m",
                                 .min = 0.001,
                                 .max = 1.0,
                                 .doc = "Recorded height of the fruit body."});
        visit(&F::substrate, Info{.name = "substrate", .most = 64, .doc = "What it grows on."});
        visit(&F::habitat, Info{.name = "habitat", .most = 96, .doc = "Where it grows."});
        visit(&F::habit,
              Info{.name = "habit",
                   .most = 64,
                   .doc = "How it stands: alone, scattered, in tufts, troops or rings."});
        visit(&F::hymenium, Info{.name = "hymenium",
                                 .most = 96,
                                 .doc = "What carries the spores, in the field's words."});
        visit(&F::colour,
              Info{.name = "colour", .most = 32, .doc = "Main colour of the cap, in a word."});
        visit(&F::season, Info{.name = "season",
                               .min = 1,
                               .max = 12,
                               .most = 12,
                               .doc = "Months in which it fruits in the northern hemisphere."});
        visit(&F::sources,
              Info{.name = "sources", .most = 12, .doc = "Where the facts come from."});
    }
    bool operator==(const Facts&) const = default;
};

/// The spread of individuals about the template at variation 1, as natural logarithms of factors
/// unless stated otherwise.
struct Spread {
    double size = 0.3;
    double stem_length = 0.15;
    double stem_width = 0.15;
    double cap_height = 0.1;
    double bend_deg = 12.0;
    double lean_deg = 6.0;
    double imperfection = 0.3;
    double lightness = 0.1;
    double irregularity = 0.75;

    static constexpr void fields(auto visit) {
        using S = Spread;
        visit(&S::size, Info{.name = "size",
                             .min = 0,
                             .max = 1.2,
                             .doc = "Of the whole; 0.3 means from 0.74 to 1.35 times."});
        visit(&S::stem_length, Info{.name = "stem_length",
                                    .min = 0,
                                    .max = 0.8,
                                    .doc = "Of the stem's length, of corals that of the trunk."});
        visit(&S::stem_width, Info{.name = "stem_width",
                                   .min = 0,
                                   .max = 0.8,
                                   .doc = "Of the stem's width, of corals that of all limbs."});
        visit(&S::cap_height, Info{.name = "cap_height",
                                   .min = 0,
                                   .max = 0.6,
                                   .doc = "Of the height of the cap over its margin, of corals "
                                          "how far forks open."});
        visit(&S::bend_deg, Info{.name = "bend_deg",
                                 .unit = "deg",
                                 .min = 0,
                                 .max = 60,
                                 .doc = "Added to the template's bend, at most."});
        visit(&S::lean_deg, Info{.name = "lean_deg",
                                 .unit = "deg",
                                 .min = 0,
                                 .max = 30,
                                 .doc = "Added to the template's lean, at most."});
        visit(&S::imperfection, Info{.name = "imperfection",
                                     .min = 0,
                                     .max = 1,
                                     .doc = "Added to the template's imperfection, at most."});
        visit(&S::lightness,
              Info{.name = "lightness", .min = 0, .max = 0.5, .doc = "Of the cap's lightness."});
        visit(
            &S::irregularity,
            Info{.name = "irregularity",
                 .min = 0,
                 .max = 1,
                 .doc = "Added to the template's irregularity at the end of life, at most; to that "
                        "of a button half as much. In full from variation 0.5 on."});
    }
    bool operator==(const Spread&) const = default;
};

/// One growth stage.
struct Stage {
    double age = 0.6;
    Text<48> name;
    Model model;

    static constexpr void fields(auto visit) {
        visit(&Stage::age,
              Info{.name = "age", .min = 0, .max = 1, .doc = "When it looks like this."});
        visit(&Stage::name,
              Info{.name = "name", .most = 48, .doc = "What a mycologist calls the stage."});
        visit(&Stage::model, Info{.name = "model", .doc = "The template."});
    }
    bool operator==(const Stage&) const = default;
};

/// One species of the atlas.
struct Species {
    Text<48> id;
    Facts facts;
    Spread spread;
    GroundStyle ground;
    Ecology ecology;
    std::vector<Stage> stages;

    static constexpr void fields(auto visit) {
        visit(&Species::id, Info{.name = "id",
                                 .most = 48,
                                 .doc = "Name in addresses: lower-case letters and underscores."});
        visit(&Species::facts, Info{.name = "facts", .doc = "What is recorded."});
        visit(&Species::spread, Info{.name = "spread", .doc = "How far individuals vary."});
        visit(&Species::ground,
              Info{.name = "ground", .doc = "Soil, litter and mycelium at the foot."});
        visit(&Species::ecology,
              Info{.name = "ecology",
                   .doc = "Where it lives in a world, how its mycelia spread and when it fruits; "
                          "the shape of a mushroom does not depend on it."});
        visit(&Species::stages, Info{.name = "stages",
                                     .most = 8,
                                     .doc = "Growth stages by age; every stage has as many control "
                                            "points on each sub-curve."});
    }
    /// Returns true for what grows forwards from a wall.
    [[nodiscard]] bool is_lateral() const;
    void check(const std::string& path,
               std::vector<Problem>& problems) const;  // core/model/species.cpp
    bool operator==(const Species&) const = default;
};

}  // namespace sporeprint
