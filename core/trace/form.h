// The forms of mushrooms that can be traced from the side, in the terms of field guides.
#pragma once

#include <optional>

#include "core/model/species.h"

namespace sporeprint::trace {

/// What is looked for on a photograph. automatic: the form that fits the outline.
enum class Form { automatic, capped, funnel, morel, club, puffball, cup };

constexpr const char* name(Form form) {
    switch (form) {
        case Form::automatic:
            return "auto";
        case Form::capped:
            return "capped";
        case Form::funnel:
            return "funnel";
        case Form::morel:
            return "morel";
        case Form::club:
            return "club";
        case Form::puffball:
            return "puffball";
        case Form::cup:
            return "cup";
    }
    return nullptr;
}

/// Returns true if mushrooms of a form have a lower face, or an outer one, between stem and upper face; all
/// others are a stem and a head. Not for Form::automatic.
[[nodiscard]] constexpr bool has_face(Form form) {
    return form == Form::capped || form == Form::funnel || form == Form::cup;
}

/// Returns true if the upper face of a form is hidden behind its edge from the side.
[[nodiscard]] constexpr bool is_hollow(Form form) {
    return form == Form::funnel || form == Form::cup;
}

/// Returns the form by which mushrooms of a growth form are traced; none if they cannot be, because they
/// branch or grow from a wall.
[[nodiscard]] constexpr std::optional<Form> form_of(GrowthForm growth) {
    switch (growth) {
        case GrowthForm::agaric:
        case GrowthForm::bolete:
        case GrowthForm::tooth:
        case GrowthForm::stinkhorn:
            return Form::capped;
        case GrowthForm::chanterelle:
        case GrowthForm::trumpet:
            return Form::funnel;
        case GrowthForm::morel:
        case GrowthForm::false_morel:
            return Form::morel;
        case GrowthForm::club:
            return Form::club;
        case GrowthForm::puffball:
            return Form::puffball;
        case GrowthForm::cup:
        case GrowthForm::nest:
            return Form::cup;
        case GrowthForm::bracket:
        case GrowthForm::shelving_agaric:
        case GrowthForm::earthstar:
        case GrowthForm::jelly:
        case GrowthForm::coral:
        case GrowthForm::antler:
        case GrowthForm::crust:
        case GrowthForm::cushion:
        case GrowthForm::cage:
            return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace sporeprint::trace
