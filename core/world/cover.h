// What covers the ground of a world at a place: soil, leaves, needles, moss, grass, herbs, rock or water.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/world/ground.h"

namespace sporeprint {

/// The largest number of kinds of trees in a stand.
inline constexpr std::size_t most_kinds = 8;

/// How much wider crowns are for the cover than the circles by which trees compete. Such circles reach the trunks of
/// others at most and leave half of the ground of a wood open; crowns in nature grow into the gaps beside them, until nine
/// tenths are covered.
inline constexpr double crown_filling = 1.5;

/// What the cover of a place depends on.
struct CoverConditions {
    double light = 1.0;    ///< share of the light of the open sky, below crowns that are not filled
    double wetness = 0.5;  ///< as wetness_on()
    double acidity = 0.5;  ///< of the soil, 0..1
    double slope = 0.0;    ///< rise per metre along the steepest line
    double stream = 0.0;   ///< as stream_at()
    int day = 1;           ///< of the year, 1..365
    /// Litter of each kind of tree that falls in a year, relative to that of a closed wood: litterfall().
    std::array<double, most_kinds> fall{};
    std::array<bool, most_kinds> has_needles{};
};

/// Sets the conditions that the ground of a place gives: wetness, slope and stream.
///
/// x, y        metres
/// soil_water  of the day or of a mean, mm, as wetness_on() takes it
void set_ground(CoverConditions& conditions, const Ground& ground, double x, double y,
                double soil_water);

/// Shares of the ground, which sum to 1.
struct Cover {
    double soil = 0.0, needles = 0.0, moss = 0.0, grass = 0.0, herb = 0.0, rock = 0.0, water = 0.0;
    std::array<double, most_kinds> leaves{};  ///< by kind of tree

    [[nodiscard]] double all_leaves() const;
    bool operator==(const Cover&) const = default;
};

/// Returns the cover of a place. Leaves of broad-leaved trees fall in October and November and are gone
/// after four years; herbs have their leaves from March to June; needles fall all the year.
///
/// source  the decay of litter in four years [MuellerUsing2009]; all other constants are chosen by eye
[[nodiscard]] Cover cover_of(const CoverConditions& conditions);

/// The fallen leaves that lie on a day.
struct FallenLeaves {
    double new_share =
        1.0;  ///< of those on top that fell in the last autumn, or in this one once leaves fall again
    double faded = 0.0;  ///< how far those have faded: 0 as they fall to 1 a year later
    double fresh = 0.0;  ///< 1 while they fall, 0 from the winter on

    /// Returns whether a leaf is one of those.
    ///
    /// age  which of all leaves, 0 for the last ones that fell to 1
    [[nodiscard]] bool is_new(double age) const { return age < new_share; }
    /// Returns how far a leaf has faded.
    [[nodiscard]] double faded_at(double age) const { return is_new(age) ? faded : 1.0; }
};

/// Returns the fallen leaves of a day of the northern year. Those of earlier years have faded altogether.
///
/// source  chosen by eye: litter is bright in autumn, brown in winter and greyish brown from spring on
[[nodiscard]] FallenLeaves fallen_leaves(int day);

/// The crown of a tree from which litter falls.
struct LitterSource {
    double x = 0.0, y = 0.0;  ///< metres
    double radius = 1.0;      ///< of the crown by the rule of competition, metres
    std::size_t kind = 0;
};

/// How far litter is blown beyond its crown: mean and largest distance, metres.
inline constexpr double litter_drift = 3.0, most_litter_drift = 15.0;

/// Leaves that fall in a year in an oak wood whose crowns are closed, per m², and the area of each, m².
/// source  [Carlisle1966]
inline constexpr double leaves_per_year = 2360.0, area_of_leaf = 20.6e-4;

/// Returns the litter that falls from a tree at a place in a year, relative to that of a closed wood:
/// the leaves of a disc, each of which is blown an exponentially distributed distance downwind.
///
/// x, y            place, metres from the foot of the tree
/// radius          of the crown, metres
/// wind_x, wind_y  unit vector, the direction to which the wind blows
/// returns         0..1; 0 beyond most_litter_drift. The integral over the plane is the area of the
///                 crown, but for less than a share of e^-5 that would be blown farther
[[nodiscard]] double litterfall(double x, double y, double radius, double wind_x, double wind_y);

/// Returns that of all trees, by kind, in the order of the sources. Their crowns are wider by crown_filling.
[[nodiscard]] std::array<double, most_kinds> litterfall(std::span<const LitterSource> sources,
                                                        double x, double y, double wind_x,
                                                        double wind_y);

/// Cover on a grid of nodes at multiples of `step`, so that neighbouring fields share nodes.
struct CoverField {
    static constexpr double finest_step = 0.5;
    double step = finest_step;  ///< metres: finest_step times a power of two
    int west = 0, south = 0;    ///< numbers of the first column and row
    int columns = 0, rows = 0;
    std::vector<Cover> nodes;  ///< by rows from south to north

    /// Returns the cover at a place of the field, linear between nodes.
    [[nodiscard]] Cover at(double x, double y) const;
    [[nodiscard]] const Cover& node(int column, int row) const {
        return nodes[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    }
};

/// Returns where the nodes of the field of a rectangle lie, without their cover.
[[nodiscard]] CoverField cover_lattice(const WorldBox& box, double margin,
                                       double step = CoverField::finest_step);

/// Computes the cover of a rectangle and of some ground round it.
///
/// margin  metres
/// cover   of a place, metres
/// step    of the field, metres
[[nodiscard]] CoverField cover_field(const WorldBox& box, double margin,
                                     const std::function<Cover(double, double)>& cover,
                                     double step = CoverField::finest_step);

}  // namespace sporeprint
