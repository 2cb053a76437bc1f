// How a species spreads over a world in decades: spores fall beside their bodies, travel with the wind and are washed
// downhill; where they find suitable ground, the species establishes itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/model/ecology.h"
#include "core/world/ground.h"
#include "core/world/wind.h"

namespace sporeprint {

/// Number of cells along each side of the grid on which species spread.
inline constexpr int spread_grid_side = 128;

/// Years between two steps of the spread and between those before year 0, the year of its first one, and years between
/// two moments that are stored.
inline constexpr int spread_step = 5, spread_early_step = 10, spread_begin = -200,
                     spread_interval = 20;

/// Number of moments that are stored: years 0, 20, ... 200.
inline constexpr std::size_t spread_moments = 11;

/// Where water carries spores: for each cell the lower neighbours that its water runs to. Water of the border leaves.
struct WashGraph {
    /// A neighbour and how much of the spores that the water takes from a cell gets there.
    struct Way {
        std::uint32_t to = 0;
        double share = 0.0;
    };
    /// A cell, and what rain does with the spores on it.
    struct Stop {
        std::uint32_t cell = 0;
        std::uint32_t end = 0;  ///< its ways end here, and begin where those of the stop before end
        double washed = 0.0;    ///< share of the spores on it that rain takes up
        double leaving = 0.0;   ///< share of the spores in its water that does not settle there
    };
    std::vector<Stop> stops;  ///< all cells, each before those that its water runs to
    std::vector<Way> ways;
};

/// What decides on the spread of all species of a world.
struct SpreadGround {
    Grid grid;  ///< its nodes are the middles of the cells
    WindRose rose;
    /// By sector and cell: the factor of its speed (LocalWind), 0 for 0.5 and 255 for 1.5.
    std::array<std::vector<std::uint8_t>, wind_sectors> wind;
    WindCover cover;
    WashGraph wash;
};

/// Returns the grid of the cells on which species spread: 128 a side over the grid of a ground.
[[nodiscard]] Grid spread_grid(const Grid& ground);

/// Returns where rain carries spores.
///
/// grid     side N >= 3
/// heights  N*N heights in 1/height_units m
/// rain     of a year, mm
/// source   wash and settling by [Quinn1991] for the ways; how much and how far are chosen: water carries spores as
///          many metres as the product of its yearly flow, m^3 per metre of contour, and the slope
[[nodiscard]] WashGraph wash_graph(const Grid& grid, std::span<const std::int32_t> heights,
                                   double rain);

/// Returns what decides on the spread of species over a ground.
///
/// cost  about 10 ms
[[nodiscard]] SpreadGround spread_ground(const Ground& ground, const ClimateParams& climate,
                                         const WindCover& cover);

/// Where and when a species arrives from elsewhere.
struct Founder {
    double x = 0.0, y = 0.0;  ///< metres from the centre of the world
    int year = spread_begin;
    bool operator==(const Founder&) const = default;
};

/// Returns the founders of a species: one in each square of 160 m, on ground that suits it. Three of five are there from
/// the first year, the others arrive in any year up to the last one of the world.
///
/// species  stream_of() its id
/// suitability  one value for each cell, 0..1
[[nodiscard]] std::vector<Founder> founders_of(const Grid& grid, std::uint32_t seed,
                                               std::uint32_t species,
                                               std::span<const double> suitability);

/// Number of species whose spores fall at once.
inline constexpr std::size_t spore_lanes = 4;

/// A number of each species.
struct alignas(sizeof(double) * spore_lanes) SporeLanes {
    std::array<double, spore_lanes> of{};
    bool operator==(const SporeLanes&) const = default;
};

/// The spores of up to four species that fall in a year. What one of them does is the same whatever the others are.
class SporeFall {
  public:
    /// spores  of 1 to spore_lanes species
    SporeFall(const SpreadGround& ground, std::span<const SporeHabit> spores);

    /// Computes where spores come down, and where rain leaves them.
    ///
    /// source    spores that leave the bodies of each cell, in any unit
    /// deposit   set to those that lie on each cell in the end
    /// returns   those that leave the world, on the wind or in water: with the deposit they add up to the source
    /// cost      0.2 ms
    SporeLanes fall(std::span<const SporeLanes> source, std::span<SporeLanes> deposit);

  private:
    using ByFactor = std::array<SporeLanes, 256>;
    /// A cell of a row from which a way leads out of the grid, and how much of what passes over it goes there.
    struct Exit {
        int column = 0;
        double share = 0.0;
    };
    /// One of the winds, on the cells by rows or, if it blows along rows, by columns.
    struct Plume {
        bool by_columns = false;
        int row_step = 0, column_step = 0;       ///< to the next cell downwind
        const std::uint8_t* wind = nullptr;      ///< by cell: factor of its speed
        std::vector<std::uint8_t> turned_wind;   ///< by columns
        ByFactor carried;                        ///< share of its spores that this wind carries
        ByFactor passing;                        ///< share of spores above it that do not land
        std::vector<SporeLanes> rows;            ///< of spores above cells, the last three
        std::vector<Exit> exits;                 ///< by rows in the order of the wind
        std::vector<std::uint32_t> first_exits;  ///< of each row, and how many there are
    };
    /// Plumes that go over the rows in one order.
    struct Sweep {
        int row_step = 0;
        std::vector<std::size_t> plumes;
    };
    void set_plume(std::size_t sector, std::span<const SporeHabit> spores);
    void blow(const Sweep& sweep, std::span<const SporeLanes> source, std::span<SporeLanes> landed,
              SporeLanes& gone);
    void blow_row(Plume& plume, int number, std::span<const SporeLanes> source,
                  std::span<SporeLanes> landed, SporeLanes& gone);

    const SpreadGround& ground_;
    int side_;
    std::vector<SporeLanes> beside_, gone_;  ///< by cell: shares that fall beside bodies, that rise
    std::array<Plume, wind_sectors> plumes_;
    std::vector<Sweep> by_rows_, by_columns_;
    std::vector<SporeLanes> turned_source_, turned_landed_, landed_, water_;
};

/// How far a species has spread over a world: for each moment and cell 255 where it is as common as it can be.
struct Establishment {
    Grid grid;
    std::array<std::vector<std::uint8_t>, spread_moments> shares;

    /// Returns the memory that it takes.
    [[nodiscard]] std::size_t bytes() const;
};

/// Computes the spread of a species from its founders on.
///
/// suitability  one value for each cell, 0..1; nothing lives where it is 0
/// founders     those outside the grid or after the last year are ignored
/// throws       InvalidInput if there is not one value for each cell
/// cost         15 ms
[[nodiscard]] Establishment spread_of(const SpreadGround& ground, const SporeHabit& spores,
                                      std::span<const double> suitability,
                                      std::span<const Founder> founders);

/// A species, from which spread_of() would compute its spread.
struct Spreading {
    SporeHabit spores;
    std::span<const double> suitability;
    std::span<const Founder> founders;
};

/// Computes the spread of up to four species at once, in a third of the time.
[[nodiscard]] std::vector<Establishment> spread_together(const SpreadGround& ground,
                                                         std::span<const Spreading> species);

/// Returns how far a species has spread at a place, 0..1: linear between the middles of cells and between moments.
///
/// year  0 to last_year
[[nodiscard]] double establishment_at(const Establishment& establishment, double x, double y,
                                      double year);

}  // namespace sporeprint
