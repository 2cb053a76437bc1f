#include "core/world/tree_growth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

/// Growth in height: H (1 - e^(-rate age))^shape.
constexpr double growth_rate = 0.028, growth_shape = 1.4;

/// Crowns of a tree: radius of a seedling, and metres of radius per metre of height.
constexpr double least_crown = 0.25, crown_growth = 0.13, greatest_crown = 5.0;

/// Diameters of the thinnest and of thick wood, metres, and how long the thinnest is there, compared with thick wood.
constexpr double thin = 0.04, thick = 0.15, lasting_of_thin = 0.5;

/// Radius of the top of a trunk, compared with that of its foot.
constexpr double top_radius = 0.2;

/// Returns how much of a snag stands, metres: tops break off first, piece by piece.
double height_of_snag(const DeadWood& wood, WorldTime time) {
    constexpr double lowest = 1.0;
    Random random(static_cast<std::uint32_t>(wood.id), purposes::plot_pieces, 1);
    const double broken =
        (0.15 + 0.55 * random.uniform()) * std::min(1.0, 2.5 * mass_lost(wood, time));
    return std::max(std::min(lowest, wood.length), wood.length * (1.0 - broken));
}

/// Returns the age at which a tree has a share of its final height below 1.
double exact_age(double share) {
    return -logarithm(1.0 - power(share, 1.0 / growth_shape)) / growth_rate;
}

/// Ages by heights. Competition asks for tens of thousands of them for each block.
class AgeTable {
  public:
    AgeTable() {
        for (std::size_t i = 0; i < ages_.size(); ++i)
            ages_[i] = exact_age(static_cast<double>(i) / steps);
    }
    [[nodiscard]] double age(double share) const {
        if (share >= 1.0) return 1e9;
        const double place = share * steps;
        const auto i = static_cast<std::size_t>(place);
        // The last steps have ages that differ too much for a straight line.
        if (i + 1 >= ages_.size()) return exact_age(share);
        return ages_[i] + (ages_[i + 1] - ages_[i]) * (place - static_cast<double>(i));
    }

  private:
    static constexpr double steps = 1024.0;
    std::array<double, 1015> ages_{};
};

}  // namespace

double height_at(const StandTree& tree, WorldTime time) {
    const double age = years_between(tree.born, std::max(time, tree.born));
    return tree.height * power(1.0 - exponential(-growth_rate * age), growth_shape);
}

double age_of_height(const StandTree& tree, double height) {
    static const AgeTable table;
    return table.age(std::max(0.0, height) / tree.height);
}

double crown_radius(double height) {
    return std::min(greatest_crown, least_crown + crown_growth * height);
}

double height_of_crown(double radius) {
    return std::max(0.0, (radius - least_crown) / crown_growth);
}

double trunk_diameter(double height) {
    // A closed stand of one age has space for as many trees as radius^-1.6, by the rules of competition here. With
    // trunks in proportion to crowns, numbers fall by the power -1.6 of the diameter, as [Reineke1933] found.
    return 0.128 * (least_crown + crown_growth * height);
}

double mass_lost(const DeadWood& wood, WorldTime time) {
    return 1.0 - exponential(-wood.decay * years_between(wood.died, std::max(time, wood.died)));
}

double radius_at(const DeadWood& wood, WorldTime time) {
    return wood.radius * std::sqrt(1.0 - mass_lost(wood, time));
}

double taper_at(const DeadWood& wood, double along) {
    return 1.0 - (1.0 - top_radius) * std::clamp(along / wood.length, 0.0, 1.0);
}

double lasting(double diameter) {
    const double thickness = std::clamp((diameter - thin) / (thick - thin), 0.0, 1.0);
    return lasting_of_thin + (1.0 - lasting_of_thin) * thickness;
}

double length_at(const DeadWood& wood, WorldTime time) {
    const double broken = height_of_snag(wood, std::min(time, wood.fell));
    if (time >= wood.gone) return 0.0;
    // Compared with the time that thick wood is there.
    const double age = lasting(2.0 * wood.radius) * years_between(wood.died, time) /
                       std::max(years_between(wood.died, wood.gone), 1e-9);
    if (age <= lasting_of_thin || wood.stands_at(time)) return broken;
    const double thinnest =
        thin + (thick - thin) * (age - lasting_of_thin) / (1.0 - lasting_of_thin);
    const double left = wood.length * (1.0 - thinnest / (2.0 * wood.radius)) / (1.0 - top_radius);
    return std::clamp(left, 0.0, broken);
}

WorldTime when_shorter(const DeadWood& wood, double along) {
    WorldTime before = wood.died, after = wood.gone;
    while (after - before > 1) {
        const WorldTime middle = before + (after - before) / 2;
        (length_at(wood, middle) < along ? after : before) = middle;
    }
    return after;
}

}  // namespace sporeprint
