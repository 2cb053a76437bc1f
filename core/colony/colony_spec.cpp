#include "core/colony/colony_spec.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/model/mentions.h"
#include "core/params/messages.h"

namespace sporeprint {

namespace {

/// Returns true for growth forms whose stem can be separated from the rest.
bool has_cap_on_stem(GrowthForm form) {
    switch (form) {
        case GrowthForm::agaric:
        case GrowthForm::bolete:
        case GrowthForm::chanterelle:
        case GrowthForm::club:
        case GrowthForm::morel:
        case GrowthForm::tooth:
        case GrowthForm::stinkhorn:
            return true;
        case GrowthForm::cup:
        case GrowthForm::bracket:
        case GrowthForm::shelving_agaric:
        case GrowthForm::puffball:
        case GrowthForm::earthstar:
        case GrowthForm::false_morel:
        case GrowthForm::trumpet:
        case GrowthForm::jelly:
        case GrowthForm::coral:
        case GrowthForm::antler:
        case GrowthForm::crust:
        case GrowthForm::cushion:
        case GrowthForm::nest:
        case GrowthForm::cage:
            return false;
    }
    return false;
}

/// Reports controls of roots and of stems.
template <class Report>
void report_given(const ColonyRootsOf<Maybe>& growth, bool roots, bool stems, const Report& say) {
    static constexpr std::array<std::string_view, 4> of_stems = {"stem_height", "stem_displacement",
                                                                 "stem_segments", "stem_decay"};
    ColonyRootsOf<Maybe>::fields([&](auto member, const Info& info) {
        if (!(growth.*member)) return;
        const std::string_view name = info.name;
        const bool stem = std::find(of_stems.begin(), of_stems.end(), name) != of_stems.end();
        if (!stems && stem)
            say(name, "these species stand without a stem of the colony's");
        else if (!roots && name != "root_radius" && (!stem || name == "stem_decay"))
            say(name, "only habit=rooted has it");
    });
}

}  // namespace

Habit habit_of(const Species& species) {
    // Terms of field guides; the first one recorded is the typical habit.
    struct Word {
        std::string_view text;
        Habit habit;
    };
    static constexpr std::array<Word, 14> words = {{{"tuft", Habit::tuft},
                                                    {"cluster", Habit::tuft},
                                                    {"caespitose", Habit::tuft},
                                                    {"tier", Habit::tier},
                                                    {"shelf", Habit::tier},
                                                    {"rosette", Habit::tier},
                                                    {"trunk", Habit::tier},
                                                    {"branch", Habit::tier},
                                                    {"ring", Habit::ring},
                                                    {"troop", Habit::troop},
                                                    {"group", Habit::troop},
                                                    {"swarm", Habit::troop},
                                                    {"scattered", Habit::troop},
                                                    {"gregarious", Habit::troop}}};
    return species.is_lateral()
               ? Habit::tier
               : first_mentioned(species.facts.habit.view(), words, &Word::habit, Habit::troop);
}

ColonyTraits colony_traits(const ColonySpec& spec, const Atlas& atlas) {
    const ColonyParams& params = spec.params;
    std::vector<Problem> problems;
    check(params, Info{.name = ""}, "", problems);
    const MixPart* most = nullptr;
    ColonyTraits traits;
    std::uint32_t names = 0;
    for (const MixPart& part : spec.mix) {
        const AtlasEntry* entry = atlas.find(part.id);
        if (!entry) {
            report(problems, "mix", in_quotes(part.id) + " is no species of the atlas");
            continue;
        }
        const Facts& facts = entry->species.facts;
        names ^= stream_of(part.id);
        const bool is_lateral = entry->species.is_lateral();
        traits.lateral = traits.lateral || is_lateral;
        traits.capped = traits.capped && has_cap_on_stem(facts.form) && !is_lateral;
        if (!most || part.weight > most->weight ||
            (part.weight == most->weight && part.id < most->id)) {
            most = &part;
            traits.habit = habit_of(entry->species);
            traits.substrate = wood_of(facts);
        }
    }
    if (spec.mix.empty()) report(problems, "mix", "names no species");
    if (!problems.empty()) throw InvalidInput(std::move(problems));

    if (traits.lateral) traits.habit = Habit::tier;
    if (params.habit && traits.lateral && *params.habit != Habit::tier)
        report(problems, "/habit", "what grows from a wall stands in tiers");
    traits.habit = params.habit.value_or(traits.habit);
    traits.roots = params.roots.value_or(traits.habit == Habit::rooted ? RootsShown::shown
                                                                       : RootsShown::buried);
    if (traits.roots == RootsShown::shown && traits.habit != Habit::rooted)
        report(problems, "/roots", "only habit=rooted has roots to show");
    if (params.trunk_radius && traits.habit != Habit::tier)
        report(problems, "/trunk_radius", "only habit=tier has a trunk");
    if (params.substrate.value_or(Substrate::none) != Substrate::none &&
        traits.habit != Habit::tier)
        report(problems, "/substrate", "only habit=tier has a trunk");
    traits.substrate =
        traits.habit == Habit::tier ? params.substrate.value_or(traits.substrate) : Substrate::none;
    report_given(params.growth, traits.habit == Habit::rooted, traits.capped,
                 [&](std::string_view name, const char* why) {
                     report(problems, '/' + std::string(name), why);
                 });
    if (!traits.capped && params.cap_scale != ColonyParams{}.cap_scale)
        report(problems, "/cap_scale", "these species stand whole: no cap is set on a stem");
    if (!problems.empty()) throw Impossible(std::move(problems));
    traits.seed = Random(params.seed, purposes::colony_layout, names).bits();
    return traits;
}

}  // namespace sporeprint
