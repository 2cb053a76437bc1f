#include "core/individual/gill_layout.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/math/elementary.h"
#include "core/math/purposes.h"
#include "core/math/random.h"

namespace sporeprint {

namespace {

// greatest number of blades per gap between those that reach the stem
constexpr int most_between = 16;

// Share of the meridian over which a fork rises, hidden in the ridge from which it swings out.
constexpr double fork_rise = 0.09;

// One lane of the hash of core/math/noise.inl.
constexpr std::uint32_t prime_x = 0x9E3779B1U, prime_y = 0x85EBCA77U;

std::uint32_t hashed(std::uint32_t h) {
    h *= 0x27D4EB2DU;
    return h ^ (h >> 15U);
}

std::uint32_t integer_bits(int integer) {
    return std::bit_cast<std::uint32_t>(static_cast<float>(integer) + 12582912.0F);
}

float upper_part(std::uint32_t h) {
    return static_cast<float>(static_cast<std::int32_t>(h)) * (1.0F / 2147483648.0F);
}

int cells_in_row(const CellRows& cells, int row) {
    const float count =
        std::floor(static_cast<float>(cells.from) +
                   static_cast<float>(cells.grow) * (static_cast<float>(row) + 0.5F));
    return std::max(static_cast<int>(count), 3);
}

}  // namespace

SlotAssignment slot_assignment(int gill_layout, HymeniumPattern pattern, int blades, int tiers) {
    SlotAssignment assignment{.blades = blades, .tiers = tiers};
    if (gill_layout < 1) return assignment;
    const bool ridges = pattern == HymeniumPattern::ridges;
    const int all = ridges ? blades : blades << tiers;
    int filled = 0;
    while (gill_layout << filled < all) ++filled;
    if (ridges || all < gill_layout) {
        if (gill_layout << filled == blades) return assignment;
        assignment.slots = gill_layout << filled;
        assignment.occupied = all;
        assignment.stride = all / blades;
        return assignment;
    }
    assignment.blades = gill_layout;
    assignment.tiers = filled;
    if (filled > 0) {
        const int before = gill_layout << (filled - 1);
        assignment.last_tier = static_cast<double>(all - before) / before;
    }
    return assignment;
}

double cubic_wave(double t) {
    const double u = std::abs(t - std::floor(t) - 0.5) * 2.0;
    return u * u * (6.0 - 4.0 * u) - 1.0;
}

double Wander::at(double turn, double share) const {
    double sum = 0.0;
    for (const Wave& wave : waves)
        sum += wave.size * cubic_wave(wave.count * turn + wave.lean * share + wave.phase);
    return sum;
}

Wander wander_of(std::uint32_t seed) {
    Random random(seed, purposes::wander);
    // The shortest waves are about as long as gaps are wide, so that neighbouring gaps differ.
    constexpr std::array<int, 6> counts = {2, 5, 11, 19, 31, 47};
    constexpr std::array<double, 6> sizes = {0.30, 0.26, 0.18, 0.10, 0.10, 0.06};
    // Short waves lean little, so that blades do not zigzag between neighbours.
    constexpr std::array<double, 6> leans = {1.1, 1.1, 0.8, 0.4, 0.3, 0.3};
    Wander wander;
    for (std::size_t i = 0; i < wander.waves.size(); ++i) {
        const double lean = random.symmetric();
        const double phase = random.uniform();
        wander.waves[i] = {counts[i], leans[i] * lean, sizes[i], phase};
    }
    return wander;
}

std::array<std::uint32_t, 8> hymenium_words(std::uint32_t seed) {
    Random stream(seed, purposes::hymenium);
    std::array<std::uint32_t, 8> words{};
    for (std::uint32_t& word : words) word = stream.bits();
    return words;
}

float hashed_symmetric(int integer, std::uint32_t word) {
    return upper_part(hashed(hashed(integer_bits(integer) * prime_x) ^ word));
}

BladeRow::BladeRow(const SlotAssignment& assignment, HymeniumPattern pattern, double forking,
                   std::uint32_t seed, int slots)
    : assignment_(assignment),
      wander_size_(pattern == HymeniumPattern::ridges ? ridge_wander : gill_wander),
      wander_(wander_of(seed)),
      blades_(static_cast<std::size_t>(slots)) {
    const auto words = hymenium_words(seed);
    const int n = assignment.blades;
    for (int k = 0; k < n; ++k) {
        const double at = k;
        put(at, {.presence = 1.0, .from = at, .to = at});
    }
    if (pattern == HymeniumPattern::ridges) {
        for (int level = 0; level < 2; ++level)
            for (int k = 0; k < n << level; ++k) {
                const auto i = static_cast<std::size_t>(level);
                const double chance = static_cast<double>(
                    hashed_symmetric(k, words[2] + static_cast<std::uint32_t>(level)));
                const double side = static_cast<double>(
                    hashed_symmetric(k, words[3] + static_cast<std::uint32_t>(level)));
                const double begin =
                    fork_begins[i] + (1.0 - forking) * fork_missing + chance * fork_strays[i];
                const double gap = 1.0 / (1 << level), left = k * gap;
                Blade fork{.presence = smooth_step(0.0, 1.0, (1.0 - begin) / 0.12),
                           .begin = std::min(begin, 1.0),
                           .rise = fork_rise};
                fork.from = side < 0.0 ? left : left + gap;
                fork.to = left + 0.5 * gap;
                put(fork.to, fork);
            }
        return;
    }
    for (int tier = 0; tier < assignment.tiers; ++tier)
        for (int k = 0; k < n << tier; ++k) {
            if (tier + 1 == assignment.tiers && assignment.last_tier < 1.0) {
                const float rank = static_cast<float>(k) * static_cast<float>(golden_step);
                if (!(rank - std::floor(rank) < static_cast<float>(assignment.last_tier))) continue;
            }
            const double at = (k + 0.5) / (1 << tier);
            const double chance = static_cast<double>(
                hashed_symmetric(k, words[2] + static_cast<std::uint32_t>(tier)));
            put(at, {.presence = 1.0,
                     .begin = tier_begin(tier) + chance * tier_strays,
                     .rise = 1.0 / tier_rise,
                     .from = at,
                     .to = at});
        }
}

// Blades on slots take the slot nearest to their even spacing.
double BladeRow::turn_of(double gaps) const {
    if (assignment_.slots == 0) return gaps / assignment_.blades;
    const double occupied = gaps * assignment_.stride;
    const double integer = std::floor(occupied);
    const auto slot = [&](double k) {
        return std::floor(k * assignment_.slots / assignment_.occupied + 0.501);
    };
    return (slot(integer) + (occupied - integer) * (slot(integer + 1.0) - slot(integer))) /
           assignment_.slots;
}

void BladeRow::put(double gaps, Blade blade) {
    const auto slots = static_cast<int>(blades_.size());
    const int slot = static_cast<int>(std::floor(turn_of(gaps) * slots + 0.5 + 1e-9)) % slots;
    Blade& here = blades_[static_cast<std::size_t>(slot)];
    if (here.presence > 0.0) return;
    here = blade;
    here.number = static_cast<int>(gaps * most_between + 0.5);
}

double BladeRow::turn(const Blade& blade, double share) const {
    const double begun = std::max(share - blade.begin, 0.0);
    const double swung = smooth_step(0.0, 1.0, begun * fork_swing);
    const double turn = turn_of(blade.from + (blade.to - blade.from) * swung);
    return turn - wander_size_ * wander_.at(turn - std::floor(turn), share);
}

std::vector<CrossVein> cross_veins(int ridges, double forking, std::uint32_t seed) {
    const std::uint32_t word = hymenium_words(seed)[4];
    const int rows = cross_vein_rows(ridges);
    std::vector<CrossVein> veins;
    for (int row = 0; row < rows; ++row)
        for (int ridge = 0; ridge < ridges; ++ridge) {
            const int integer = ridge + vein_rows_apart * row;
            const auto random = [&](std::uint32_t which) {
                return static_cast<double>(hashed_symmetric(integer, word + which));
            };
            veins.push_back(
                {ridge, (row + 0.5 + vein_stray * random(0)) / rows, vein_tilt * random(1) / rows,
                 std::clamp(vein_steepness * (veins_there(forking) - 0.5 * random(2)), 0.0, 1.0)});
        }
    return veins;
}

int cell_count(const CellRows& cells) {
    int count = 0;
    for (int row = 0; row < cells.rows; ++row) count += cells_in_row(cells, row);
    return count;
}

CellRows cell_rows(double arc, double inner, double outer, double per_metre, int most) {
    const auto of = [&](int rows) {
        return CellRows{rows, 2.0 * pi * inner / arc * rows, 2.0 * pi * (outer - inner) / arc};
    };
    int rows = std::clamp(static_cast<int>(arc * per_metre), 3, 400);
    while (rows > 3 && cell_count(of(rows)) > most) --rows;
    return of(rows);
}

std::vector<CellPlace> cell_places(const CellRows& cells, std::uint32_t seed) {
    const std::uint32_t word = hymenium_words(seed)[5];
    std::vector<CellPlace> places;
    for (int row = 0; row < cells.rows; ++row) {
        const int count = cells_in_row(cells, row);
        const double shift = row % 2 == 0 ? 0.0 : 0.5;
        const std::uint32_t row_bits = integer_bits(row) * prime_y + word;
        for (int column = 0; column < count; ++column) {
            const std::uint32_t h = hashed((integer_bits(column) * prime_x) ^ row_bits);
            const double x =
                column + 0.5 + static_cast<double>(upper_part(h) * cell_jitter) + shift;
            const double y = row + 0.5 + static_cast<double>(upper_part(h << 16U) * cell_jitter);
            places.push_back(
                {x / count, y / cells.rows, static_cast<double>(upper_part(hashed(h) << 16U))});
        }
    }
    return places;
}

}  // namespace sporeprint
