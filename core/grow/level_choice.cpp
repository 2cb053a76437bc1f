#include "core/grow/level_choice.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/grow/mushroom.h"
#include "core/grow/wood.h"
#include "core/individual/proportion.h"

namespace sporeprint {

namespace {

constexpr int last_whole = static_cast<int>(details.size()) - 1;

double triangles_at(const Individual& individual, DetailLevel level, bool grows) {
    return static_cast<double>(body_count(individual, level, grows).triangles +
                               wood_count(individual, level).triangles);
}

/// Returns true if a mesh of this level is as sound as those of whole levels, at which every outline
/// is proven not to cross itself.
bool is_possible(const Individual& individual, DetailLevel level) {
    return level.is_whole() || individual.is_branched() ||
           !self_intersecting_curve(individual.outline, level);
}

/// Returns how many times one count is the other, at least 1.
double ratio(double a, double b) { return std::max(a, b) / std::min(a, b); }

/// A level and its triangles.
struct Counted {
    DetailLevel level;
    double triangles = 0.0;
};

/// Returns the coarsest level between two whose steps from both are within bounds or, where there is
/// none, the one nearest to their geometric mean; nothing where every level is too near to one of
/// them.
std::optional<Counted> inserted(const std::vector<Counted>& all, const Counted& finer,
                                const Counted& coarser) {
    std::optional<Counted> best;
    bool is_within = false;
    double least = 0.0;
    const double mean = std::sqrt(finer.triangles * coarser.triangles);
    for (const Counted& one : all) {
        if (one.level <= finer.level || one.level >= coarser.level) continue;
        const double above = finer.triangles / one.triangles,
                     below = one.triangles / coarser.triangles;
        if (above < least_step || below < least_step) continue;
        const double off = ratio(one.triangles, mean);
        if (above <= largest_step && below <= largest_step) {
            best = one;
            is_within = true;
        } else if (!is_within && (!best || off < least)) {
            best = one;
            least = off;
        }
    }
    return best;
}

/// Appends a level, and before it those that are needed between the last one and it.
///
/// all  the levels between whole ones that can be inserted
void append_with_steps(std::vector<Counted>& levels, const Counted& next,
                       const std::vector<Counted>& all) {
    const Counted last = levels.back();
    if (last.triangles > largest_step * next.triangles)
        if (const auto between = inserted(all, last, next)) {
            append_with_steps(levels, *between, all);
            return append_with_steps(levels, next, all);
        }
    levels.push_back(next);
}

bool grows(const MushroomSpec& spec) { return spec.params.animation != Animation::none; }

}  // namespace

DetailLevel first_level(const MushroomSpec& spec, const Individual& individual) {
    if (!spec.params.triangles) return spec.params.lod;
    const double wanted = *spec.params.triangles;
    DetailLevel nearest = 0;
    double least = 0.0;
    for (int lod = 0; lod <= last_whole; ++lod)
        for (int eighths = 0; eighths < DetailLevel::steps; ++eighths) {
            const DetailLevel level(lod, eighths);
            if (!level.is_whole() && (grows(spec) || lod == last_whole)) break;
            const double off = ratio(triangles_at(individual, level, grows(spec)), wanted);
            if ((level > 0 && off > least) || !is_possible(individual, level)) continue;
            nearest = level;
            least = off;
        }
    return nearest;
}

std::vector<DetailLevel> levels_from(DetailLevel first, const Individual& individual, bool grows) {
    if (first > last_whole) return {};
    std::vector<DetailLevel> levels{first};
    const double count = first.is_whole() ? 0.0 : triangles_at(individual, first, grows);
    for (int lod = first.lod + 1; lod <= last_whole; ++lod)
        if (first.is_whole() || count >= least_step * triangles_at(individual, lod, grows))
            levels.emplace_back(lod);
    return levels;
}

std::vector<DetailLevel> levels_in_file(const MushroomSpec& spec, const Individual& individual) {
    const DetailLevel first = first_level(spec, individual);
    if (spec.params.lod == impostor_lod) return {};
    if (spec.params.file.lods == Lods::single) return {first};
    const std::vector<DetailLevel> whole = levels_from(first, individual, grows(spec));
    std::vector<Counted> between;
    for (int lod = first.lod; lod < last_whole; ++lod)
        for (int eighths = 1; eighths < DetailLevel::steps; ++eighths)
            if (is_possible(individual, {lod, eighths}))
                between.push_back(
                    {{lod, eighths}, triangles_at(individual, {lod, eighths}, grows(spec))});
    std::vector<Counted> chain{{first, triangles_at(individual, first, grows(spec))}};
    for (const DetailLevel level : std::span(whole).subspan(1))
        append_with_steps(chain, {level, triangles_at(individual, level, grows(spec))}, between);
    std::vector<DetailLevel> levels;
    levels.reserve(chain.size());
    for (const Counted& one : chain) levels.push_back(one.level);
    return levels;
}

MushroomSpec image_spec(const MushroomSpec& spec, const Individual& individual) {
    MushroomSpec painted = spec;
    painted.params.lod = first_level(spec, individual).nearest();
    painted.params.triangles.reset();
    return painted;
}

}  // namespace sporeprint
