#include "core/geometry/damage_cuts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/individual/proportion.h"
#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/mesh/detail.h"

namespace sporeprint {

namespace {

constexpr double whole_turn = 2.0 * pi;

// Shares of the faces that remain under the deepest cut.
constexpr double least_cap = 0.28, least_lower = 0.14;
// Below these shares nothing moves.
constexpr double fixed_cap = 0.18, fixed_lower = 0.06;
// Columns closer than this, in turns, are merged.
constexpr double merge_distance = 0.0002;
// Share of a cut's damage from which on its columns stand at their own places.
constexpr double open_at = 0.12;

// Numbers of cuts at a level of detail, which the species of a mix share; `inside`: columns on each
// side of a bite's middle: one beside its end, one at its cusp; `pair_splits`: splits of a pair, for
// the five of each species that are open at most by its data; `long_splits`: how many splits, if they
// are long enough, have a column in the middle of each lip beside those at the tip and on the margin.
// A pair of species needs all of its triangles: more columns would coarsen its other parts.
struct LodLimits {
    int bites, inside, splits, pair_splits, long_splits;
};
constexpr std::array<LodLimits, 4> limits_by_lod = {
    {{4, 2, 7, 10, 3}, {2, 0, 2, 2, 0}, {2, 0, 0, 0, 0}, {0, 0, 0, 0, 0}}};
// Least depth of such a split, in radii of the cap.
constexpr double long_split = 0.2;
// How far the lips of a split are raised at most, in radii of the cap.
constexpr double most_lift = 0.05;
// Where a bite has columns beside its ends, in shares of its half width: its arc is steepest there.
constexpr double beside_end = 0.95;

// Scales a share along its meridian so that the end moves to `last`; shares up to `fixed` are
// unchanged.
double scaled_share(double share, double fixed, double last) {
    if (share <= fixed || last >= 1.0) return share;
    return fixed + (share - fixed) * (last - fixed) / (1.0 - fixed);
}

// Returns the notches of a level of detail: those of each species, in the order of their onset. A
// mesh has vertices for all of them, since each image shows those of its own species.
std::vector<SizedNotch> notches_of(const Individual& individual, const LodLimits& limits) {
    const std::vector<MarginDamage>& all = individual.damage.margins;
    std::vector<SizedNotch> out;
    const auto add = [&out](const std::vector<Notch>& drawn, std::size_t most, double amount) {
        for (std::size_t i = 0; i < std::min(drawn.size(), most); ++i)
            out.push_back({drawn[i], begun(drawn[i].onset, amount)});
    };
    const int all_splits = all.size() == 2 ? limits.pair_splits : limits.splits;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::uint32_t seed = damage_seed(individual.weather_seed, all[k].stream);
        const std::size_t most_bites = own_share(limits.bites, all, k, &MarginDamage::can_bite),
                          most_splits = own_share(all_splits, all, k, &MarginDamage::can_split);
        if (most_bites > 0) add(bites(seed), most_bites, all[k].bites);
        if (most_splits > 0) add(splits(seed), most_splits, all[k].splits);
    }
    return out;
}

// Returns the angles from the middle of a bite at which it needs columns on one side.
std::vector<double> columns_of_bite(const Notch& bite, std::size_t side, int inside) {
    std::vector<double> out{bite.half_width};
    if (inside > 0) out.push_back(beside_end * bite.half_width);
    if (inside > 1) out.push_back((side == 0 ? -bite.cusps[0] : bite.cusps[1]) * bite.half_width);
    return out;
}

// Returns the angles from the tip of a split at which a lip has columns.
std::vector<double> columns_of_lip(const Lip& lip, bool is_long) {
    const auto& corners = lip.corners;
    if (is_long) return {corners[1].across, corners[3].across};
    return {corners[3].across};
}

}  // namespace

std::size_t own_share(int limit, std::span<const MarginDamage> all, std::size_t species,
                      bool MarginDamage::*can) {
    if (!(all[species].*can)) return 0;
    const auto able = [&](std::span<const MarginDamage> some) {
        return static_cast<std::size_t>(std::count_if(
            some.begin(), some.end(), [&](const MarginDamage& one) { return one.*can; }));
    };
    const std::size_t count = able(all), most = static_cast<std::size_t>(limit);
    return most / count + (able(all.first(species)) < most % count ? 1 : 0);
}

MarginCuts::MarginCuts(const Individual& individual, DetailLevel level) {
    const Outline& outline = individual.outline;
    const LodLimits& limits = at_level(limits_by_lod, level);
    std::vector<SizedNotch> notches;
    if (!outline.hymenium.empty()) {
        notches = notches_of(individual, limits);
        melts_ = individual.damage.melts;
    }
    possible_ = melts_ || !notches.empty();
    if (possible_) {
        cap_length_ = outline.cap.length();
        lower_length_ = outline.hymenium.length();
        cap_radius_ = greatest_radius(outline.cap);
        for (const auto& [notch, size] : notches)
            if (size > 0.0) open_.push_back({notch, notch.depth * cap_radius_, size});
    }
    if (melts_) {
        melted_ = melted(individual.damage.amounts.deliquescence) * cap_length_;
        phase_ = MixedRandom(damage_shares(individual), purposes::ragged).uniform(0.0, whole_turn);
    }
    place_columns(columns_of(notches, {limits.inside, limits.long_splits}), notches,
                  detail_of(level).columns);
    placed_turns_ = turns_;
    const auto turn_of = [this](std::size_t k) { return k == turns_.size() ? 1.0 : turns_[k]; };
    for (const InsertedColumn& column : inserted_) {
        double on_chords = 0.0;
        for (const Chord& chord : chords(column))
            on_chords += chord.weight *
                         (turn_of(chord.left) + collapsed_width * chord.share *
                                                    (turn_of(chord.right) - turn_of(chord.left)));
        placed_turns_[column.column] =
            on_chords + column.open * (turns_[column.column] - on_chords);
    }
    if (none()) return;
    depths_ = depths_of(false);
    lower_depths_ = depths_of(true);
}

std::vector<double> MarginCuts::depths_of(bool lower) const {
    std::vector<double> own;
    own.reserve(turns_.size() + 1);
    for (const double turn : turns_) own.push_back(cut_at(whole_turn * turn, lower));
    own.push_back(own.front());
    std::vector<double> out = own;
    for (const InsertedColumn& column : inserted_) {
        double on_chords = 0.0;
        for (const Chord& chord : chords(column))
            on_chords += chord.weight *
                         (own[chord.left] + chord.share * (own[chord.right] - own[chord.left]));
        out[column.column] = on_chords + column.open * (own[column.column] - on_chords);
    }
    return out;
}

std::vector<MarginCuts::CutColumn> MarginCuts::columns_of(const std::vector<SizedNotch>& notches,
                                                          ColumnLimits limits) {
    std::vector<CutColumn> own;
    for (const auto& [notch, size] : notches) {
        const double open = smooth_step(0.0, open_at, size);
        const auto add = [&](double angle) {
            const double turn = angle / whole_turn;
            own.push_back({turn - std::floor(turn), open});
        };
        const bool is_long = !notch.bitten && notch.depth > long_split && limits.long_splits-- > 0;
        if (!notch.bitten) add(notch.theta);
        for (const std::size_t side : {0U, 1U}) {
            const double sign = side == 0 ? -1.0 : 1.0;
            const Lip& lip = notch.lips[side];
            for (const double across : notch.bitten ? columns_of_bite(notch, side, limits.inside)
                                                    : columns_of_lip(lip, is_long))
                add(notch.theta + sign * across);
        }
    }
    std::stable_sort(own.begin(), own.end(),
                     [](const CutColumn& a, const CutColumn& b) { return a.turn < b.turn; });
    return own;
}

void MarginCuts::place_columns(const std::vector<CutColumn>& own,
                               const std::vector<SizedNotch>& notches, int even) {
    auto next = own.begin();
    std::vector<double> open;  // per column from an even one to the next
    for (int j = 0; j < even; ++j) {
        const double from = static_cast<double>(j) / even, to = static_cast<double>(j + 1) / even;
        const std::size_t left = turns_.size();
        turns_.push_back(from);
        open.assign(1, 1.0);
        for (; next != own.end() && next->turn < to; ++next) {
            if (to - next->turn <= merge_distance) continue;
            if (next->turn - turns_.back() > merge_distance) {
                turns_.push_back(next->turn);
                open.push_back(next->open);
            } else {
                open.back() = std::max(open.back(), next->open);
            }
        }
        open.push_back(1.0);
        const bool reached =
            melts_ || std::any_of(notches.begin(), notches.end(), [&](const SizedNotch& cut) {
                return std::abs(turn_between(cut.notch.theta, pi * (from + to))) <=
                       cut.notch.half_width + pi * (to - from) + 1e-9;
            });
        may_cut_.insert(may_cut_.end(), turns_.size() - left, reached);
        insert_columns(left, to, open);
    }
}

// Lists the chords on which each column from the even column `left` to the next, at the turn `to`,
// lies while its cut is closed. `open` says how far each of these columns is open, both even ones
// included.
void MarginCuts::insert_columns(std::size_t left, double to, const std::vector<double>& open) {
    const auto turn_of = [&](std::size_t k) {
        return k + 1 == open.size() ? to : turns_[left + k];
    };
    for (std::size_t k = 1; k + 1 < open.size(); ++k) {
        InsertedColumn column{left + k, open[k], chords_.size(), 0};
        double before = 1.0;  // weight of the columns further left
        for (std::size_t l = k; l-- > 0 && before > 0.0; before *= 1.0 - open[l]) {
            double after = before * open[l];
            for (std::size_t r = k + 1; r < open.size() && after > 0.0; ++r) {
                if (open[r] > 0.0)
                    chords_.push_back({left + l, left + r,
                                       (turn_of(k) - turn_of(l)) / (turn_of(r) - turn_of(l)),
                                       after * open[r]});
                after *= 1.0 - open[r];
            }
        }
        column.last = chords_.size();
        inserted_.push_back(column);
    }
}

double MarginCuts::cut_at(double angle, bool lower) const {
    double deepest = 0.0;
    for (const Open& cut : open_)
        deepest = std::max(deepest, cut.depth * (lower ? 1.0 + cut.notch.undercut : 1.0) *
                                        notch_depth(cut.notch, cut.size, angle));
    if (melted_ > 0.0) {
        const double ragged = 0.5 * sine(3.0 * angle + phase_) + 0.3 * sine(7.0 * angle - phase_) +
                              0.2 * sine(13.0 * angle + 2.0 * phase_);
        deepest += melted_ * (1.0 + 0.2 * ragged);
    }
    return deepest;
}

double MarginCuts::depth(double angle) const { return between_columns(depths_, angle); }

double MarginCuts::between_columns(const std::vector<double>& depths, double angle) const {
    if (depths.empty()) return 0.0;
    double turn = angle / whole_turn;
    turn -= std::floor(turn);
    const auto next = static_cast<std::size_t>(
        std::upper_bound(turns_.begin(), turns_.end(), turn) - turns_.begin());
    const double from = turns_[next - 1], to = next == turns_.size() ? 1.0 : turns_[next];
    const double t = (turn - from) / (to - from);
    return depths[next - 1] + t * (depths[next] - depths[next - 1]);
}

double MarginCuts::lift(double angle) const {
    double highest = 0.0;
    for (const Open& cut : open_) highest = std::max(highest, lip_lift(cut.notch, cut.size, angle));
    return most_lift * cap_radius_ * highest;
}

double MarginCuts::cap_end(double angle) const {
    if (none() || cap_length_ <= 0.0) return 1.0;
    return std::max(1.0 - depth(angle) / cap_length_, least_cap);
}

double MarginCuts::lower_end(double angle) const {
    if (none() || lower_length_ <= 0.0) return 1.0;
    return std::max(1.0 - between_columns(lower_depths_, angle) / lower_length_, least_lower);
}

double MarginCuts::cap_to(double sigma, double end) { return scaled_share(sigma, fixed_cap, end); }

double MarginCuts::lower_to(double share, double end) {
    return scaled_share(share, fixed_lower, end);
}

}  // namespace sporeprint
