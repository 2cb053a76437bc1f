#include "core/breed/inheritance.h"

#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/breed/traits.h"
#include "core/params/blend.h"
#include "core/silhouette/aligned.h"

namespace sporeprint {

namespace {

/// Multiplies all lengths of a value.
template <class T>
void scale(T& value, const Info& info, double factor) {
    const auto number = [&](double x) { return std::clamp(x * factor, info.min, info.max); };
    if constexpr (Described<T>) {
        // Mycelia and the distances between fruit bodies do not grow with the size of the bodies.
        if constexpr (!std::is_same_v<T, Ecology>)
            T::fields([&](auto member, const Info& sub) { scale(value.*member, sub, factor); });
    } else if constexpr (is_variant<T>) {
        std::visit([&](auto& one) { scale(one, info, factor); }, value);
    } else if constexpr (is_optional<T>) {
        if (value) scale(*value, info, factor);
    } else if constexpr (is_list<T>) {
        for (auto& item : value) scale(item, info, factor);
    } else if constexpr (std::is_same_v<T, double>) {
        if (std::string_view(info.unit) == "m") value = number(value);
    } else if constexpr (std::is_same_v<T, Range>) {
        if (std::string_view(info.unit) == "m") value = {number(value.from), number(value.to)};
    }
}

/// Returns the name by which a trait is drawn: that of the trait with which alone it fits.
std::string drawn_with(const std::string& trait) {
    constexpr std::string_view amounts = "ornaments.";
    if (trait == "ornaments.glow") return "material";
    if (trait.starts_with(amounts)) return drawn_with(trait.substr(amounts.size()));
    if (trait == "surface.hymenium") return "hymenium";
    if (trait == "sac") return "volva";
    if (trait == "ground" || trait == "ecology") return "azimuth";
    return trait;
}

/// Decides from which parent each trait comes.
class Inheritance {
  public:
    Inheritance(const Species& a, const Genes& genes) : genes_(genes) {
        Model any = a.stages.front().model;
        const auto lock = [&](const std::string& trait) {
            if (genes.is_locked(trait)) locked_.push_back(drawn_with(trait));
        };
        visit_traits(
            any, any, any, "",
            [&](auto&, const auto&, const auto&, const std::string& trait) { lock(trait); });
        lock("ground");
        lock("ecology");
    }

    [[nodiscard]] bool is_of_second(const std::string& trait) const {
        const std::string name = drawn_with(trait);
        return std::find(locked_.begin(), locked_.end(), name) == locked_.end() &&
               genes_.is_of_second(name);
    }

    /// Sets a trait.
    template <class T>
    void inherit(T& out, const T& a, const T& b, const std::string& trait) const {
        if constexpr (is_blended_trait<T>) {
            const double share = genes_.is_locked(trait) ? 0.0 : genes_.blended(trait);
            if (share > 0.0 && share < 1.0) {
                Shares<T> shares;
                shares.add(a, 1.0 - share);
                shares.add(b, share);
                out = blend(shares);
            } else {
                out = share > 0.0 ? b : a;
            }
        } else {
            out = is_of_second(trait) ? b : a;
        }
        restore_locked(out, a, trait);
    }

  private:
    /// Sets what is locked in a trait that is not locked itself.
    template <class T>
    void restore_locked(T& out, const T& a, const std::string& path) const {
        if (genes_.is_locked(path)) {
            out = a;
        } else if constexpr (Described<T>) {
            if (!genes_.is_locked_within(path)) return;
            T::fields([&](auto member, const Info& info) {
                restore_locked(out.*member, a.*member, part_path(path, info));
            });
        }
    }

    const Genes& genes_;
    std::vector<std::string> locked_;  ///< as drawn_with() names them
};

}  // namespace

Species scaled(Species species, double factor) {
    if (factor != 1.0) scale(species, Info{.name = ""}, factor);
    return species;
}

double most_scale(const Species& species) {
    double most = std::numeric_limits<double>::infinity();
    const Info r = info_of<OutlinePoint>("r"), y = info_of<OutlinePoint>("y");
    for (const Stage& stage : species.stages) {
        const auto* swept = std::get_if<Swept>(&stage.model.shape);
        if (!swept) continue;
        const Silhouette& silhouette = swept->silhouette;
        for (const auto* points : {&silhouette.stem, &silhouette.hymenium, &silhouette.cap})
            for (const OutlinePoint& point : *points) {
                if (point.r > 0.0) most = std::min(most, r.max / point.r);
                if (point.y > 0.0) most = std::min(most, y.max / point.y);
                if (point.y < 0.0) most = std::min(most, y.min / point.y);
            }
    }
    return most;
}

Model model_at(const Species& species, double age) {
    std::vector<double> ages;
    ages.reserve(species.stages.size());
    for (const Stage& stage : species.stages) ages.push_back(stage.age);
    const std::vector<double> growth = stage_weights(ages, age);
    Shares<Model> shares;
    for (std::size_t i = 0; i < growth.size(); ++i) {
        if (growth[i] == 1.0) return species.stages[i].model;
        shares.add(species.stages[i].model, growth[i]);
    }
    return blend(shares);
}

Species crossed(const Species& a, const Species& b, const Genes& genes) {
    const Inheritance inheritance(a, genes);
    const bool is_of_second = !genes.is_locked(stages_part) && genes.is_of_second(stages_part);
    Species out = is_of_second ? b : a;
    inheritance.inherit(out.spread, a.spread, b.spread, "spread");
    inheritance.inherit(out.ground, a.ground, b.ground, "ground");
    inheritance.inherit(out.ecology, a.ecology, b.ecology, "ecology");
    for (Stage& stage : out.stages) {
        const Model first = model_at(a, stage.age), second = model_at(b, stage.age);
        visit_traits(
            stage.model, first, second, "",
            [&]<class T>(T& trait, const T& of_first, const T& of_second, const std::string& path) {
                if constexpr (!std::is_same_v<T, Silhouette> &&
                              !std::is_same_v<T, std::vector<AxisPoint>>)
                    inheritance.inherit(trait, of_first, of_second, path);
            });
        if (auto* branched = std::get_if<Branched>(&stage.model.shape)) {
            const Model& of = inheritance.is_of_second("ramification") ? second : first;
            branched->segments.trunks = std::get<Branched>(of.shape).segments.trunks;
        }
    }
    return out;
}

}  // namespace sporeprint
