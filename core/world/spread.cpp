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

/// Rain takes up this much of the spores on a cell for each metre that its water carries them, when that is little.
constexpr double wash_per_metre = 0.05;

/// Establishment per full deposit of a cell of its own, and growth and loss of cover, in five years.
constexpr double establishment_rate = 3.0, growth = 0.35, loss = 0.02;

/// Ground that a founder has at first, m^2, and the size of squares that have one founder each, metres.
constexpr double founder_area = 100.0, founder_square = 160.0;

/// Share of founders that are there from the first year on, in 1/256.
constexpr std::uint32_t early_founders = 154;

/// Fewer spores than this land all at once.
constexpr double least_passing = 1e-100;

/// Cells beyond the border in the array of spores in the air: as far as winds reach upwind.
constexpr int margin = 2;

constexpr double factor_of(std::uint8_t stored) { return 0.5 + stored / 255.0; }

std::uint8_t quantised_share(double share) {
    return static_cast<std::uint8_t>(std::clamp(std::floor(share * 255.0 + 0.5), 0.0, 255.0));
}

void transpose(int side, std::span<const double> from, std::span<double> to) {
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

/// The cover of a species, from one step to the next.
class Cover {
  public:
    Cover(const SpreadGround& ground, const SporeHabit& spores, std::span<const double> suitability)
        : fall_(ground, spores),
          suitability_(suitability),
          cover_(suitability.size()),
          source_(suitability.size()),
          deposit_(suitability.size()) {}

    void found(std::size_t cell, double share) {
        if (suitability_[cell] > 0.0) cover_[cell] = std::max(cover_[cell], share);
        is_empty_ = false;
    }

    /// Goes on by some years, at most ten.
    void step(int years) {
        if (is_empty_) return;
        const double fives = years / 5.0;
        for (std::size_t i = 0; i < cover_.size(); ++i) source_[i] = suitability_[i] * cover_[i];
        static_cast<void>(fall_.fall(source_, deposit_));
        for (std::size_t i = 0; i < cover_.size(); ++i) {
            const double x = fives * establishment_rate * deposit_[i] * suitability_[i];
            // 1 - e^(-x) up to a tenth, by the first terms of the series of e^x.
            const double arrived = 1.0 - 1.0 / (1.0 + x * (1.0 + 0.5 * x));
            const double gained = std::min(1.0, arrived + fives * growth * source_[i]);
            cover_[i] += (1.0 - cover_[i]) * gained - fives * loss * cover_[i];
        }
    }

    [[nodiscard]] std::vector<std::uint8_t> quantised() const {
        std::vector<std::uint8_t> out(cover_.size());
        std::transform(cover_.begin(), cover_.end(), out.begin(), quantised_share);
        return out;
    }

  private:
    SporeFall fall_;
    std::span<const double> suitability_;
    std::vector<double> cover_, source_, deposit_;
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

SporeFall::SporeFall(const SpreadGround& ground, const SporeHabit& spores)
    : ground_(ground), side_(ground.grid.side) {
    const std::size_t cells = ground.grid.nodes();
    const auto padded = static_cast<std::size_t>(side_ + 2 * margin);
    beside_.assign(cells, 0.0);
    gone_.assign(cells, 0.0);
    const double profile = wind_near_ground(1.0, spores.height, ground.cover);
    for (std::size_t k = 0; k < wind_sectors; ++k) {
        const WindSector& sector = ground.rose[k];
        plumes_[k] = plume_of(k, spores);
        std::vector<double>& carried = plumes_[k].carried;
        carried.resize(cells);
        std::array<DispersalKernel, 256> kernels;
        for (std::size_t i = 0; i < kernels.size(); ++i)
            kernels[i] =
                dispersal_kernel({spores.height, spores.settling,
                                  sector.speed * profile * factor_of(static_cast<std::uint8_t>(i)),
                                  ground.cover.grass});
        for (std::size_t i = 0; i < cells; ++i) {
            const DispersalKernel& kernel = kernels[ground.wind[k][i]];
            beside_[i] += sector.share * kernel.beside;
            gone_[i] += sector.share * kernel.gone;
            carried[i] = sector.share * kernel.carried;
        }
        if (plumes_[k].by_columns) {
            const std::vector<double> by_rows = carried;
            transpose(side_, by_rows, carried);
        }
    }
    passed_.assign(padded * padded, 0.0);
    for (std::vector<double>* const one : {&turned_source_, &turned_landed_, &landed_, &water_})
        one->assign(cells, 0.0);
    passed_row_.assign(static_cast<std::size_t>(side_), 0.0);
}

SporeFall::Plume SporeFall::plume_of(std::size_t sector, const SporeHabit& spores) const {
    const auto sign = [](double value) { return value > 0.5 ? 1 : value < -0.5 ? -1 : 0; };
    const WindSector& wind = ground_.rose[sector];
    Plume out;
    out.row_step = sign(wind.north);
    out.column_step = sign(wind.east);
    const bool is_diagonal = out.row_step != 0 && out.column_step != 0;
    out.by_columns = out.row_step == 0;
    if (out.by_columns) std::swap(out.row_step, out.column_step);

    // Spores sink by `settling` a second while the wind carries them along; they land evenly over the mean distance.
    const double profile = wind_near_ground(1.0, spores.height, ground_.cover);
    const double length = way_length(is_diagonal) * ground_.grid.cell;
    std::array<double, 256> passing{};
    for (std::size_t i = 0; i < passing.size(); ++i) {
        const double speed = wind.speed * profile * factor_of(static_cast<std::uint8_t>(i));
        const double mean = speed * spores.height / spores.settling;
        passing[i] = mean > 0.0 ? exponential(-length / mean) : 0.0;
    }
    std::vector<double> by_rows;
    by_rows.reserve(ground_.grid.nodes());
    for (const std::uint8_t factor : ground_.wind[sector]) by_rows.push_back(passing[factor]);
    out.passing = by_rows;
    if (out.by_columns) transpose(side_, by_rows, out.passing);

    const std::array<Target, 3> targets = targets_of(out.row_step, out.column_step);
    const auto is_outside = [&](int number) { return number < 0 || number >= side_; };
    for (int row = 0; row < side_; ++row)
        for (int column = 0; column < side_; ++column) {
            double share = 0.0;
            for (const Target& target : targets)
                if (is_outside(row + target.rows) || is_outside(column + target.columns))
                    share += target.share;
            if (share == 0.0) continue;
            out.leaving.push_back(
                static_cast<std::size_t>((row + margin) * (side_ + 2 * margin) + column + margin));
            out.leaving_shares.push_back(share);
        }
    return out;
}

double SporeFall::blow(const Plume& plume, std::span<const double> source,
                       std::vector<double>& landed) {
    const std::array<Target, 3> targets = targets_of(plume.row_step, plume.column_step);
    const std::ptrdiff_t stride = side_ + 2 * margin;
    std::array<std::ptrdiff_t, 3> upwind{};
    for (std::size_t k = 0; k < targets.size(); ++k)
        upwind[k] = -(targets[k].rows * stride + targets[k].columns);
    for (int number = 0; number < side_; ++number) {
        const int row = plume.row_step > 0 ? number : side_ - 1 - number;
        const auto begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(side_);
        const double* const emitted = &source[begin];
        const double* const carried = &plume.carried[begin];
        const double* const passing = &plume.passing[begin];
        double* __restrict const ground = &landed[begin];
        double* __restrict const passed = passed_row_.data();
        double* const here = &passed_[static_cast<std::size_t>((row + margin) * stride) + margin];
        const double* const straight = here + upwind[0];
        const double* const one_side = here + upwind[1];
        const double* const other_side = here + upwind[2];
        for (int i = 0; i < side_; ++i) {
            const double air = emitted[i] * carried[i] + straight_share * straight[i] +
                               side_share * (one_side[i] + other_side[i]);
            // Less would become denormal numbers, with which processors are slow.
            const double share = air > least_passing ? passing[i] : 0.0;
            passed[i] = share * air;
            ground[i] += air - passed[i];
        }
        // A row of its own, so that compilers see that no cell depends on another of it.
        std::copy_n(passed, side_, here);
    }
    double gone = 0.0;
    for (std::size_t i = 0; i < plume.leaving.size(); ++i)
        gone += plume.leaving_shares[i] * passed_[plume.leaving[i]];
    return gone;
}

double SporeFall::wash(std::span<double> deposit) {
    std::fill(water_.begin(), water_.end(), 0.0);
    double gone = 0.0;
    const WashGraph::Way* way = ground_.wash.ways.data();
    const WashGraph::Way* const ways = way;
    for (const WashGraph::Stop& stop : ground_.wash.stops) {
        const double taken = deposit[stop.cell] * stop.washed;
        const double water = water_[stop.cell] + taken;
        const double leaving = water * stop.leaving;
        deposit[stop.cell] += (water - leaving) - taken;
        const WashGraph::Way* const end = ways + stop.end;
        if (way == end) gone += leaving;
        for (; way < end; ++way) water_[way->to] += leaving * way->share;
    }
    return gone;
}

double SporeFall::fall(std::span<const double> source, std::span<double> deposit) {
    require_values(ground_.grid, source.size());
    require_values(ground_.grid, deposit.size());
    double gone = 0.0;
    for (std::size_t i = 0; i < source.size(); ++i) gone += source[i] * gone_[i];
    transpose(side_, source, turned_source_);
    std::fill(turned_landed_.begin(), turned_landed_.end(), 0.0);
    for (std::size_t i = 0; i < source.size(); ++i) landed_[i] = source[i] * beside_[i];
    for (const Plume& plume : plumes_)
        gone += plume.by_columns ? blow(plume, turned_source_, turned_landed_)
                                 : blow(plume, source, landed_);
    transpose(side_, turned_landed_, deposit);
    for (std::size_t i = 0; i < source.size(); ++i) deposit[i] += landed_[i];
    return gone + wash(deposit);
}

std::size_t Establishment::bytes() const {
    std::size_t sum = sizeof(*this);
    for (const std::vector<std::uint8_t>& one : shares) sum += one.size();
    return sum;
}

Establishment spread_of(const SpreadGround& ground, const SporeHabit& spores,
                        std::span<const double> suitability, std::span<const Founder> founders) {
    require_values(ground.grid, suitability.size());
    const Grid& grid = ground.grid;
    const double share = std::min(1.0, founder_area / (grid.cell * grid.cell));
    const auto cell_number = [&](double metres) {
        return static_cast<int>(std::floor(
            std::clamp((metres - grid.origin) / grid.cell + 0.5, -1.0, grid.side + 0.0)));
    };
    Cover cover(ground, spores, suitability);
    Establishment out{grid, {}};
    int before = spread_begin - 1;
    for (int year = spread_begin; year <= last_year;
         year += year < 0 ? spread_early_step : spread_step) {
        // Founders of the years since the last step begin with the next one.
        if (year > spread_begin) cover.step(year - before);
        for (const Founder& founder : founders) {
            const int column = cell_number(founder.x), row = cell_number(founder.y);
            const bool is_inside = column >= 0 && row >= 0 && column < grid.side && row < grid.side;
            const int arrival = std::max(founder.year, spread_begin);
            if (is_inside && arrival > before && arrival <= year)
                cover.found(grid.index(column, row), share);
        }
        before = year;
        if (year >= 0 && year % spread_interval == 0)
            out.shares[static_cast<std::size_t>(year / spread_interval)] = cover.quantised();
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
