#include "core/breed/mutation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "core/breed/traits.h"
#include "core/math/elementary.h"
#include "core/params/shared_params.h"
#include "core/trace/lab.h"

namespace sporeprint {

namespace {

/// The deviation of a number at mutation 1, in lengths of its range.
constexpr double share_of_range = 0.25;

/// The same of colours, in units of CIE L*a*b*.
constexpr double lightness_deviation = 8.0, hue_deviation = 12.0;

/// Sizes have ranges of many powers of ten; they mutate as far as a scale of the whole does.
const double log_range = logarithm(size_info.max / size_info.min);

/// Returns true for lengths, and for what there is of something to a length.
bool is_size_or_density(const Info& info) {
    const std::string_view unit = info.unit;
    return unit == "m" || unit == "1/mm";
}

/// Returns x, or where it is outside the range as far inside.
double reflected(double x, double least, double most) {
    for (int turns = 0; turns < 8 && !(x >= least && x <= most); ++turns)
        x = x < least ? 2.0 * least - x : 2.0 * most - x;
    return std::clamp(x, least, most);
}

/// Returns x times a factor, within the range of numbers of its sign.
double multiplied(double x, double factor, const Info& info) {
    const double size = std::abs(x), most = x > 0.0 ? info.max : -info.min;
    const double least = info.min > 0.0 ? info.min : 0.01 * size;
    const double by_ratio = exponential(
        reflected(logarithm(size) + logarithm(factor), logarithm(least), logarithm(most)));
    return std::clamp(x > 0.0 ? by_ratio : -by_ratio, info.min, info.max);
}

/// Mutates a number in all stages by one draw.
template <class T>
void mutate_number(const std::vector<T*>& stages, const Info& info, double draw, double mutation) {
    double most = 0.0;
    for (const T* x : stages) most = std::max(most, std::abs(static_cast<double>(*x)));
    if (most == 0.0) return;
    const bool is_ratio = is_size_or_density(info) || std::is_integral_v<T>;
    const double factor = exponential(share_of_range * log_range * mutation * draw);
    const double step = share_of_range * (info.max - info.min) * mutation * draw;
    for (T* number : stages) {
        const auto x = static_cast<double>(*number);
        if (x == 0.0) continue;
        if (is_ratio && std::is_integral_v<T>)
            *number = static_cast<T>(std::clamp(std::floor(multiplied(x, factor, info) + 0.5),
                                                std::max(info.min, 1.0), info.max));
        else if (is_ratio)
            *number = static_cast<T>(multiplied(x, factor, info));
        else
            *number = static_cast<T>(reflected(x + step * std::abs(x / most), info.min, info.max));
    }
}

void mutate_colour(const std::vector<Colour*>& stages, Random random, double mutation) {
    const double lightness = random.normal(), a = random.normal(), b = random.normal();
    for (Colour* colour : stages) {
        glm::dvec3 lab = trace::lab_of({colour->r, colour->g, colour->b});
        lab.x = reflected(lab.x + lightness_deviation * mutation * lightness, 0.0, 100.0);
        lab.y += hue_deviation * mutation * a;
        lab.z += hue_deviation * mutation * b;
        const glm::dvec3 rgb = trace::rgb_of(lab);
        const auto channel = [](double value) {
            return static_cast<std::uint8_t>(std::clamp(std::floor(value + 0.5), 0.0, 255.0));
        };
        *colour = {channel(rgb.x), channel(rgb.y), channel(rgb.z)};
    }
}

/// Where something begins and ends, which keep their order.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> ordered = {
    {{"from", "to"}, {"zone_from", "zone_to"}}};

/// Puts `from` before `to` again in a struct that has both.
template <Described T>
void keep_order(T& mutated, const T& before) {
    const auto number_named = [](auto& value, std::string_view wanted) {
        std::conditional_t<std::is_const_v<std::remove_reference_t<decltype(value)>>, const double*,
                           double*>
            found = nullptr;
        T::fields([&](auto member, const Info& info) {
            if constexpr (std::is_same_v<decltype(member), double T::*>)
                if (wanted == info.name) found = &(value.*member);
        });
        return found;
    };
    for (const auto& [from, to] : ordered) {
        double* const first = number_named(mutated, from);
        double* const last = number_named(mutated, to);
        if (!first || !last || !(*number_named(before, from) <= *number_named(before, to)))
            continue;
        if (*first > *last) std::swap(*first, *last);
    }
}

template <class T>
void mutate_all(const std::vector<T*>& stages, const Info& info, const std::string& path,
                const Genes& genes);

template <Described T>
void mutate_members(const std::vector<T*>& stages, const std::string& path, const Genes& genes) {
    std::vector<T> before;
    before.reserve(stages.size());
    for (const T* stage : stages) before.push_back(*stage);
    T::fields([&](auto member, const Info& info) {
        mutate_all(members_of(stages, member), info, part_path(path, info), genes);
    });
    std::vector<Problem> problems;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        keep_order(*stages[i], before[i]);
        if constexpr (requires { stages[i]->check(path, problems); })
            stages[i]->check(path, problems);
    }
    if (problems.empty()) return;
    for (std::size_t i = 0; i < stages.size(); ++i) *stages[i] = before[i];
}

template <class T>
void mutate_all(const std::vector<T*>& stages, const Info& info, const std::string& path,
                const Genes& genes) {
    if constexpr (std::is_same_v<T, Silhouette> || std::is_same_v<T, std::vector<AxisPoint>>) {
        return;  // These mutate as curves.
    } else if constexpr (Described<T>) {
        mutate_members(stages, path, genes);
    } else if constexpr (is_variant<T>) {
        std::visit(
            [&](auto& first) {
                using Form = std::remove_cvref_t<decltype(first)>;
                std::vector<Form*> forms;
                forms.reserve(stages.size());
                for (T* stage : stages) forms.push_back(&std::get<Form>(*stage));
                mutate_all(forms, info, path, genes);
            },
            *stages.front());
    } else if constexpr (is_list<T>) {
        // Nested lists are tables whose rows belong together.
        if constexpr (!is_list<typename T::value_type>) {
            for (const T* stage : stages)
                if (stage->size() != stages.front()->size()) return;
            for (std::size_t i = 0; i < stages.front()->size(); ++i) {
                std::vector<typename T::value_type*> items;
                items.reserve(stages.size());
                for (T* stage : stages) items.push_back(&(*stage)[i]);
                mutate_all(items, info, path + '.' + std::to_string(i), genes);
            }
        }
    } else if constexpr (std::is_same_v<T, Colour>) {
        if (!genes.is_locked(path)) mutate_colour(stages, genes.mutating(path), genes.mutation());
    } else if constexpr (Number<T>) {
        if (!genes.is_locked(path))
            mutate_number(stages, info, genes.mutating(path).normal(), genes.mutation());
    }
    // Names, switches, kinds and images do not mutate.
}

}  // namespace

double mutated_size(const Genes& genes) {
    if (genes.mutation() == 0.0 || genes.is_locked(size_part)) return 1.0;
    const double step =
        share_of_range * log_range * genes.mutation() * genes.mutating(size_part).normal();
    return exponential(reflected(step, -0.5 * log_range, 0.5 * log_range));
}

void mutate(Species& species, const Genes& genes) {
    if (genes.mutation() == 0.0) return;
    const Info none{.name = ""};
    mutate_all(std::vector<Spread*>{&species.spread}, none, "spread", genes);
    mutate_all(std::vector<GroundStyle*>{&species.ground}, none, "ground", genes);
    std::vector<Model*> models;
    models.reserve(species.stages.size());
    for (Stage& stage : species.stages) models.push_back(&stage.model);
    mutate_all(models, none, "", genes);
}

}  // namespace sporeprint
