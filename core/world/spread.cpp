#include "core/world/spread.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/problems.h"
#include "core/world/dispersal.h"
#include "core/world/drainage.h"
#include "core/world/neighbours.h"

namespace sporeprint {

namespace {

/// Share of the spores above a cell that goes straight on, and to each side of that.
constexpr double straight_share = 0.9, side_share = 0.05;

/// Fewer spores than this land all at once.
constexpr double least_passing = 1e-100;

/// Rain takes up this much of the spores on a cell for each metre that its water carries them, when that is little.
constexpr double wash_per_metre = 0.05;

/// Establishment per full deposit of a cell of its own, and growth and loss of cover, in five years.
constexpr double establishment_rate = 3.0, growth = 0.35, loss = 0.02;

/// Ground that a founder has at first, m^2, and the size of squares that have one founder each, metres.
constexpr double founder_area = 100.0, founder_square = 160.0;

/// Share of founders that are there from the first year on, in 1/256.
constexpr std::uint32_t early_founders = 154;

/// Cells beyond the border in a row of spores in the air: as far as winds reach upwind.
constexpr int margin = 2;

constexpr double factor_of(std::uint8_t stored) { return 0.5 + stored / 255.0; }

std::uint8_t quantised_share(double share) {
    return static_cast<std::uint8_t>(std::clamp(std::floor(share * 255.0 + 0.5), 0.0, 255.0));
}

template <class Cell>
void transpose(int side, std::span<const Cell> from, std::span<Cell> to) {
    const auto n = static_cast<std::size_t>(side);
    constexpr std::size_t tile = 8;
    for (std::size_t row = 0; row < n; row += tile)
        for (std::size_t column = 0; column < n; column += tile)
            for (std::size_t i = row; i < std::min(row + tile, n); ++i)
                for (std::size_t j = column; j < std::min(column + tile, n); ++j)
                    to[j * n + i] = from[i * n + j];
}

/// A cell downwind, as rows and columns to it, and the share that goes there.
struct Target {
    int rows = 0, columns = 0;
    double share = 0.0;
};

/// Returns where spores go from a cell. Diagonal winds have their sides two rows or two columns away, so that no cell
/// depends on another of its row.
std::array<Target, 3> targets_of(int row_step, int column_step) {
    if (column_step == 0)
        return {
            {{row_step, 0, straight_share}, {row_step, -1, side_share}, {row_step, 1, side_share}}};
    return {{{row_step, column_step, straight_share},
             {2 * row_step, column_step, side_share},
             {row_step, 2 * column_step, side_share}}};
}

/// Returns the mean length of a way to the next cell, in cells.
double way_length(bool is_diagonal) {
    return is_diagonal ? straight_share * std::sqrt(2.0) + 2.0 * side_share * std::sqrt(5.0)
                       : straight_share + 2.0 * side_share * std::sqrt(2.0);
}

/// A row of cells and the spores that a wind carries over it; of the rows upwind, the cells where those that come from
/// there are taken up.
struct WindRow {
    const std::uint8_t* wind;   ///< by cell: which of the factors of the speed
    const SporeLanes* carried;  ///< by factor: share of its spores that this wind carries
    const SporeLanes* passing;  ///< by factor: share of spores above it that do not land
    const SporeLanes* emitted;  ///< by cell
    const SporeLanes *straight, *one_side, *other_side;
    SporeLanes *passed, *landed;  ///< set, and added to
};

/// Blows spores over the cells of a row.
void blow_over(const WindRow& row, std::size_t cells) {
    for (std::size_t i = 0; i < cells; ++i) {
        const SporeLanes& carried = row.carried[row.wind[i]];
        const SporeLanes& passing = row.passing[row.wind[i]];
        // Sums of their own, so that compilers see that no lane depends on another.
        SporeLanes passed, landed = row.landed[i];
        for (std::size_t lane = 0; lane < spore_lanes; ++lane) {
            const double air = row.emitted[i].of[lane] * carried.of[lane] +
                               straight_share * row.straight[i].of[lane] +
                               side_share * (row.one_side[i].of[lane] + row.other_side[i].of[lane]);
            // Less would become denormal numbers, with which processors are slow.
            const double share = air > least_passing ? passing.of[lane] : 0.0;
            passed.of[lane] = share * air;
            landed.of[lane] += air - passed.of[lane];
        }
        row.passed[i] = passed;
        row.landed[i] = landed;
    }
}

/// Lets rain carry spores downhill. Returns those that leave the world.
///
/// water  as many zeros as there are cells
SporeLanes wash_down(const WashGraph& wash, std::span<SporeLanes> deposit,
                     std::span<SporeLanes> water) {
    SporeLanes gone;
    const WashGraph::Way* way = wash.ways.data();
    const WashGraph::Way* const ways = way;
    for (const WashGraph::Stop& stop : wash.stops) {
        const WashGraph::Way* const end = ways + stop.end;
        SporeLanes lying = deposit[stop.cell], leaving = water[stop.cell];
        for (std::size_t lane = 0; lane < spore_lanes; ++lane) {
            const double taken = lying.of[lane] * stop.washed;
            const double in_water = leaving.of[lane] + taken;
            leaving.of[lane] = in_water * stop.leaving;
            lying.of[lane] += (in_water - leaving.of[lane]) - taken;
        }
        deposit[stop.cell] = lying;
        if (way == end)
            for (std::size_t lane = 0; lane < spore_lanes; ++lane)
                gone.of[lane] += leaving.of[lane];
        for (; way < end; ++way) {
            SporeLanes there = water[way->to];
            for (std::size_t lane = 0; lane < spore_lanes; ++lane)
                there.of[lane] += leaving.of[lane] * way->share;
            water[way->to] = there;
        }
    }
    return gone;
}

/// The cover of some species, from one step to the next.
class Cover {
  public:
    Cover(const SpreadGround& ground, std::span<const Spreading> species,
          std::span<const SporeHabit> spores)
        : fall_(ground, spores),
          suitability_(ground.grid.nodes()),
          cover_(ground.grid.nodes()),
          source_(ground.grid.nodes()),
          deposit_(ground.grid.nodes()) {
        for (std::size_t lane = 0; lane < species.size(); ++lane)
            for (std::size_t i = 0; i < suitability_.size(); ++i)
                suitability_[i].of[lane] = species[lane].suitability[i];
    }

    void found(std::size_t lane, std::size_t cell, double share) {
        double& cover = cover_[cell].of[lane];
        if (suitability_[cell].of[lane] > 0.0) cover = std::max(cover, share);
        is_empty_ = false;
    }

    /// Goes on by some years, at most ten.
    void step(int years) {
        if (is_empty_) return;
        for (std::size_t i = 0; i < cover_.size(); ++i)
            for (std::size_t lane = 0; lane < spore_lanes; ++lane)
                source_[i].of[lane] = suitability_[i].of[lane] * cover_[i].of[lane];
        static_cast<void>(fall_.fall(source_, deposit_));
        const double fives = years / 5.0;
        for (std::size_t i = 0; i < cover_.size(); ++i) {
            SporeLanes cover = cover_[i];
            for (std::size_t lane = 0; lane < spore_lanes; ++lane) {
                const double x =
                    fives * establishment_rate * deposit_[i].of[lane] * suitability_[i].of[lane];
                // 1 - e^(-x) up to a tenth, by the first terms of the series of e^x.
                const double arrived = 1.0 - 1.0 / (1.0 + x * (1.0 + 0.5 * x));
                const double gained = std::min(1.0, arrived + fives * growth * source_[i].of[lane]);
                cover.of[lane] += (1.0 - cover.of[lane]) * gained - fives * loss * cover.of[lane];
            }
            cover_[i] = cover;
        }
    }

    [[nodiscard]] std::vector<std::uint8_t> quantised(std::size_t lane) const {
        std::vector<std::uint8_t> out(cover_.size());
        std::transform(cover_.begin(), cover_.end(), out.begin(),
                       [&](const SporeLanes& cover) { return quantised_share(cover.of[lane]); });
        return out;
    }

  private:
    SporeFall fall_;
    std::vector<SporeLanes> suitability_, cover_, source_, deposit_;
    bool is_empty_ = true;
};

}  // namespace

Grid spread_grid(const Grid& ground) {
    const double length = (ground.side - 1) * ground.cell;
    const double cell = length / spread_grid_side;
    return {spread_grid_side, cell, ground.origin + 0.5 * cell};
}

WashGraph wash_graph(const Grid& grid, std::span<const std::int32_t> heights, double rain) {
    constexpr double contour_straight = 0.5, contour_diagonal = 0.35355339059327379;
    const FloodedGround ground = flooded(grid, heights);
    const std::vector<double> areas = catchments(grid, ground);
    const std::vector<std::uint8_t> is_inner = inner_nodes(grid);
    const NeighbourOffsets offsets = neighbour_offsets(grid);
    WashGraph out;
    out.stops.reserve(grid.nodes());
    out.ways.reserve(4 * grid.nodes());
    for (std::size_t rank = grid.nodes(); rank-- > 0;) {
        const std::uint32_t cell = ground.order[rank];
        double slope = least_slope;
        if (is_inner[cell] != 0) {
            const FlowWeights weights = flow_weights(&ground.heights[cell], offsets);
            double contour = 0.0;
            for (std::size_t k = 0; k < neighbours; ++k) {
                if (weights.of[k] <= 0.0) continue;
                contour += is_diagonal(k) ? contour_diagonal : contour_straight;
                out.ways.push_back(
                    {static_cast<std::uint32_t>(cell + offsets[k]), weights.of[k] / weights.sum});
            }
            slope = 0.25 * weights.sum / (height_units * grid.cell * contour);
        }
        const double metres = 1e-3 * rain * areas[cell] / grid.cell * slope;
        out.stops.push_back({cell, static_cast<std::uint32_t>(out.ways.size()),
                             1.0 - exponential(-wash_per_metre * metres),
                             metres / (metres + grid.cell)});
    }
    return out;
}

SpreadGround spread_ground(const Ground& ground, const ClimateParams& climate,
                           const WindCover& cover) {
    SpreadGround out;
    out.grid = spread_grid(ground.grid);
    out.rose = wind_rose(climate);
    out.cover = cover;
    const WindRelief relief = wind_relief(ground.grid, ground.heights);
    for (std::size_t k = 0; k < wind_sectors; ++k) out.wind[k].reserve(out.grid.nodes());
    std::vector<std::int32_t> heights;
    heights.reserve(out.grid.nodes());
    const int step = (ground.grid.side - 1) / spread_grid_side;
    for (int row = 0; row < out.grid.side; ++row)
        for (int column = 0; column < out.grid.side; ++column) {
            heights.push_back(
                ground.heights[ground.grid.index(column * step + step / 2, row * step + step / 2)]);
            for (std::size_t k = 0; k < wind_sectors; ++k) {
                const LocalWind wind =
                    wind_at(relief, out.grid.place(column), out.grid.place(row), out.rose[k]);
                out.wind[k].push_back(quantised_share(wind.factor - 0.5));
            }
        }
    out.wash = wash_graph(out.grid, heights, climate.rain);
    return out;
}

std::vector<Founder> founders_of(const Grid& grid, std::uint32_t seed, std::uint32_t species,
                                 std::span<const double> suitability) {
    require_values(grid, suitability.size());
    const int cells = std::max(1, static_cast<int>(std::floor(founder_square / grid.cell + 0.5)));
    const auto square_at = [&](int number) {
        return static_cast<std::uint32_t>(
            static_cast<std::int32_t>(std::floor(grid.place(number) / founder_square)));
    };
    std::vector<Founder> out;
    for (int south = 0; south < grid.side; south += cells)
        for (int west = 0; west < grid.side; west += cells) {
            const int north = std::min(south + cells, grid.side);
            const int east = std::min(west + cells, grid.side);
            // Squares of all worlds have the same draws. Sums of integers have no order.
            std::uint64_t sum = 0;
            for (int row = south; row < north; ++row)
                for (int column = west; column < east; ++column)
                    sum += quantised_share(suitability[grid.index(column, row)]);
            if (sum == 0) continue;
            const auto draws =
                philox({species, square_at(west), square_at(south), 0}, {seed, purposes::founders});
            std::uint64_t left = (std::uint64_t{draws[0] >> 8} * sum) >> 24;
            Founder one;
            bool is_placed = false;
            for (int row = south; row < north && !is_placed; ++row)
                for (int column = west; column < east && !is_placed; ++column) {
                    const std::uint64_t here =
                        quantised_share(suitability[grid.index(column, row)]);
                    is_placed = left < here;
                    if (is_placed)
                        one = {grid.place(column), grid.place(row), spread_begin};
                    else
                        left -= here;
                }
            constexpr std::uint64_t years = last_year - spread_begin;
            if ((draws[1] >> 24) >= early_founders)
                one.year += static_cast<int>((std::uint64_t{draws[2]} * years) >> 32);
            out.push_back(one);
        }
    return out;
}

SporeFall::SporeFall(const SpreadGround& ground, std::span<const SporeHabit> spores)
    : ground_(ground), side_(ground.grid.side) {
    if (spores.empty() || spores.size() > spore_lanes)
        throw InvalidInput("", "spores of one to four species fall at once");
    const std::size_t cells = ground.grid.nodes();
    for (std::vector<SporeLanes>* const one :
         {&beside_, &gone_, &turned_source_, &turned_landed_, &landed_, &water_})
        one->resize(cells);
    for (std::size_t k = 0; k < wind_sectors; ++k) {
        set_plume(k, spores);
        std::vector<Sweep>& sweeps = plumes_[k].by_columns ? by_columns_ : by_rows_;
        if (sweeps.empty() || sweeps.back().row_step != plumes_[k].row_step)
            sweeps.push_back({plumes_[k].row_step, {}});
        sweeps.back().plumes.push_back(k);
    }
}

void SporeFall::set_plume(std::size_t sector, std::span<const SporeHabit> spores) {
    const auto sign = [](double value) { return value > 0.5 ? 1 : value < -0.5 ? -1 : 0; };
    const WindSector& wind = ground_.rose[sector];
    Plume& out = plumes_[sector];
    out.row_step = sign(wind.north);
    out.column_step = sign(wind.east);
    const bool is_diagonal = out.row_step != 0 && out.column_step != 0;
    out.by_columns = out.row_step == 0;
    if (out.by_columns) std::swap(out.row_step, out.column_step);
    const std::vector<std::uint8_t>& factors = ground_.wind[sector];
    out.wind = factors.data();
    if (out.by_columns) {
        out.turned_wind.resize(factors.size());
        transpose<std::uint8_t>(side_, factors, out.turned_wind);
        out.wind = out.turned_wind.data();
    }
    out.rows.resize(3 * static_cast<std::size_t>(side_ + 2 * margin));

    const std::array<Target, 3> targets = targets_of(out.row_step, out.column_step);
    const auto is_outside = [&](int at) { return at < 0 || at >= side_; };
    for (int number = 0; number < side_; ++number) {
        const int row = out.row_step > 0 ? number : side_ - 1 - number;
        out.first_exits.push_back(static_cast<std::uint32_t>(out.exits.size()));
        for (int column = 0; column < side_; ++column) {
            double share = 0.0;
            for (const Target& target : targets)
                if (is_outside(row + target.rows) || is_outside(column + target.columns))
                    share += target.share;
            if (share > 0.0) out.exits.push_back({column, share});
        }
    }
    out.first_exits.push_back(static_cast<std::uint32_t>(out.exits.size()));

    // Spores sink by `settling` a second while the wind carries them along; they land evenly over the mean distance.
    const double length = way_length(is_diagonal) * ground_.grid.cell;
    ByFactor beside, gone;
    for (std::size_t lane = 0; lane < spores.size(); ++lane) {
        const SporeHabit& habit = spores[lane];
        const double profile = wind_near_ground(1.0, habit.height, ground_.cover);
        for (std::size_t i = 0; i < out.passing.size(); ++i) {
            const double speed = wind.speed * profile * factor_of(static_cast<std::uint8_t>(i));
            const DispersalKernel kernel =
                dispersal_kernel({habit.height, habit.settling, speed, ground_.cover.grass});
            beside[i].of[lane] = wind.share * kernel.beside;
            gone[i].of[lane] = wind.share * kernel.gone;
            out.carried[i].of[lane] = wind.share * kernel.carried;
            const double mean = speed * habit.height / habit.settling;
            out.passing[i].of[lane] = mean > 0.0 ? exponential(-length / mean) : 0.0;
        }
    }
    for (std::size_t i = 0; i < factors.size(); ++i)
        for (std::size_t lane = 0; lane < spore_lanes; ++lane) {
            beside_[i].of[lane] += beside[factors[i]].of[lane];
            gone_[i].of[lane] += gone[factors[i]].of[lane];
        }
}

void SporeFall::blow_row(Plume& plume, int number, std::span<const SporeLanes> source,
                         std::span<SporeLanes> landed, SporeLanes& gone) {
    const int row = plume.row_step > 0 ? number : side_ - 1 - number;
    const std::size_t begin = ground_.grid.index(0, row);
    const std::ptrdiff_t stride = side_ + 2 * margin;
    // The row that so many rows ago the wind went over.
    const auto before = [&](int rows) {
        return plume.rows.data() + (number + 3 - rows) % 3 * stride + margin;
    };
    const std::array<Target, 3> targets = targets_of(plume.row_step, plume.column_step);
    const auto upwind = [&](const Target& target) {
        return before(std::abs(target.rows)) - target.columns;
    };
    SporeLanes* const passed = before(0);
    blow_over({plume.wind + begin, plume.carried.data(), plume.passing.data(), &source[begin],
               upwind(targets[0]), upwind(targets[1]), upwind(targets[2]), passed, &landed[begin]},
              static_cast<std::size_t>(side_));
    for (const Exit* exit =
             plume.exits.data() + plume.first_exits[static_cast<std::size_t>(number)];
         exit < plume.exits.data() + plume.first_exits[static_cast<std::size_t>(number) + 1];
         ++exit)
        for (std::size_t lane = 0; lane < spore_lanes; ++lane)
            gone.of[lane] += exit->share * passed[exit->column].of[lane];
}

void SporeFall::blow(const Sweep& sweep, std::span<const SporeLanes> source,
                     std::span<SporeLanes> landed, SporeLanes& gone) {
    for (const std::size_t k : sweep.plumes)
        std::fill(plumes_[k].rows.begin(), plumes_[k].rows.end(), SporeLanes());
    for (int number = 0; number < side_; ++number)
        for (const std::size_t k : sweep.plumes) blow_row(plumes_[k], number, source, landed, gone);
}

SporeLanes SporeFall::fall(std::span<const SporeLanes> source, std::span<SporeLanes> deposit) {
    require_values(ground_.grid, source.size());
    require_values(ground_.grid, deposit.size());
    SporeLanes gone;
    for (std::size_t i = 0; i < source.size(); ++i)
        for (std::size_t lane = 0; lane < spore_lanes; ++lane) {
            gone.of[lane] += source[i].of[lane] * gone_[i].of[lane];
            landed_[i].of[lane] = source[i].of[lane] * beside_[i].of[lane];
        }
    transpose<SporeLanes>(side_, source, turned_source_);
    std::fill(turned_landed_.begin(), turned_landed_.end(), SporeLanes());
    for (const Sweep& sweep : by_rows_) blow(sweep, source, landed_, gone);
    for (const Sweep& sweep : by_columns_) blow(sweep, turned_source_, turned_landed_, gone);
    transpose<SporeLanes>(side_, turned_landed_, deposit);
    for (std::size_t i = 0; i < source.size(); ++i)
        for (std::size_t lane = 0; lane < spore_lanes; ++lane)
            deposit[i].of[lane] += landed_[i].of[lane];
    std::fill(water_.begin(), water_.end(), SporeLanes());
    const SporeLanes in_water = wash_down(ground_.wash, deposit, water_);
    for (std::size_t lane = 0; lane < spore_lanes; ++lane) gone.of[lane] += in_water.of[lane];
    return gone;
}

std::size_t Establishment::bytes() const {
    std::size_t sum = sizeof(*this);
    for (const std::vector<std::uint8_t>& one : shares) sum += one.size();
    return sum;
}

Establishment spread_of(const SpreadGround& ground, const SporeHabit& spores,
                        std::span<const double> suitability, std::span<const Founder> founders) {
    const Spreading one{spores, suitability, founders};
    return std::move(spread_together(ground, {&one, 1}).front());
}

std::vector<Establishment> spread_together(const SpreadGround& ground,
                                           std::span<const Spreading> species) {
    const Grid& grid = ground.grid;
    std::vector<SporeHabit> spores;
    for (const Spreading& one : species) {
        require_values(grid, one.suitability.size());
        spores.push_back(one.spores);
    }
    const double share = std::min(1.0, founder_area / (grid.cell * grid.cell));
    const auto cell_number = [&](double metres) {
        return static_cast<int>(std::floor(
            std::clamp((metres - grid.origin) / grid.cell + 0.5, -1.0, grid.side + 0.0)));
    };
    Cover cover(ground, species, spores);
    std::vector<Establishment> out(species.size(), {grid, {}});
    int before = spread_begin - 1;
    for (int year = spread_begin; year <= last_year;
         year += year < 0 ? spread_early_step : spread_step) {
        // Founders of the years since the last step begin with the next one.
        if (year > spread_begin) cover.step(year - before);
        for (std::size_t lane = 0; lane < species.size(); ++lane) {
            for (const Founder& founder : species[lane].founders) {
                const int column = cell_number(founder.x), row = cell_number(founder.y);
                const bool is_inside =
                    column >= 0 && row >= 0 && column < grid.side && row < grid.side;
                const int arrival = std::max(founder.year, spread_begin);
                if (is_inside && arrival > before && arrival <= year)
                    cover.found(lane, grid.index(column, row), share);
            }
            if (year >= 0 && year % spread_interval == 0)
                out[lane].shares[static_cast<std::size_t>(year / spread_interval)] =
                    cover.quantised(lane);
        }
        before = year;
    }
    return out;
}

double establishment_at(const Establishment& establishment, double x, double y, double year) {
    const Grid& grid = establishment.grid;
    const auto along = [&](double metres) {
        return std::clamp((metres - grid.origin) / grid.cell, 0.0, grid.side - 1.0);
    };
    const double column = along(x), row = along(y);
    const double time = std::clamp(year / spread_interval, 0.0, spread_moments - 1.0);
    const int i = std::min(static_cast<int>(column), grid.side - 2);
    const int j = std::min(static_cast<int>(row), grid.side - 2);
    const auto moment = std::min(static_cast<std::size_t>(time), spread_moments - 2);
    const auto mix = [](double from, double to, double t) { return from + (to - from) * t; };
    const auto at_moment = [&](std::size_t which) {
        const std::uint8_t* const south = &establishment.shares[which][grid.index(i, j)];
        const std::uint8_t* const north = south + grid.side;
        return mix(mix(south[0], south[1], column - i), mix(north[0], north[1], column - i),
                   row - j);
    };
    return mix(at_moment(moment), at_moment(moment + 1), time - static_cast<double>(moment)) /
           255.0;
}

}  // namespace sporeprint
