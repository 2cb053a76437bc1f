#include "core/grow/offspring.h"

#include <xxhash.h>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "core/breed/inheritance.h"
#include "core/breed/mutation.h"
#include "core/breed/outlines.h"
#include "core/breed/traits.h"
#include "core/math/elementary.h"
#include "core/params/messages.h"
#include "core/params/reader.h"
#include "core/problems.h"
#include "core/trace/whole_species.h"

namespace sporeprint {

namespace {

/// How often the mutation of an outline is halved, and how often its way to the nearer parent.
constexpr int halvings = 6;

bool is_branched(const Species& species) {
    return std::holds_alternative<Branched>(species.stages.front().model.shape);
}

void require_one_family(const Species& a, const Species& b) {
    if (is_branched(a) == is_branched(b)) return;
    const auto described = [](const Species& species) {
        return in_quotes(species.id.view()) + (is_branched(species) ? " branches" : " does not");
    };
    throw Impossible("b", described(is_branched(a) ? a : b) + " and " +
                              described(is_branched(a) ? b : a) +
                              "; only species of one family can be crossed");
}

Swept& swept_of(Stage& stage) { return std::get<Swept>(stage.model.shape); }

/// Returns what no stage of a species may lack for its growth to be proven.
Certificate certificate_of(Species& species) {
    for (Stage& stage : species.stages)
        if (!problems_in(swept_of(stage).silhouette).empty())
            return {false, ProofMethod::checked, 0.0};
    return trace::growth_certificate(species);
}

/// Gives offspring outlines and axes.
class Shaping {
  public:
    /// a, b  both of the size of the offspring
    Shaping(const Species& a, const Species& b, double size, const Genes& genes,
            const GetOrCompute<MorphSet>& morphs)
        : a_(a), b_(b), size_(size), genes_(genes), morphs_(morphs) {}

    void shape(Offspring& out) const {
        for (const Stage& stage : out.species.stages) ages_.push_back(stage.age);
        give_axes(out.species);
        const double drawn = share_of("silhouette"), nearer = drawn <= 0.5 ? 0.0 : 1.0;
        out.outline = drawn;
        for (int halving = 0; halving <= halvings; ++halving) {
            if (give_outlines(out)) return;
            if (out.outline == nearer) break;
            out.outline = 0.5 * (out.outline + nearer);
        }
        out.outline = nearer;
        if (!give_outlines(out))
            throw Impossible(nearer == 0.0 ? "a" : "b",
                             "its outline crosses itself, or it would as it grows; draw its stages "
                             "so that each becomes the next");
    }

  private:
    [[nodiscard]] double share_of(const char* part) const {
        return genes_.is_locked(part) ? 0.0 : genes_.blended(part);
    }

    void give_axes(Species& species) const {
        const double share = share_of("axis");
        if (share > 0.0 && share < 1.0 && !(a_ == b_)) {
            const auto axes = axes_between(a_, b_, share, ages_);
            for (std::size_t i = 0; i < ages_.size(); ++i)
                swept_of(species.stages[i]).axis = axes[i];
        } else {
            const Species& of = share > 0.0 ? b_ : a_;
            for (Stage& stage : species.stages)
                swept_of(stage).axis = std::get<Swept>(model_at(of, stage.age).shape).axis;
        }
        if (genes_.mutation() > 0.0 && !genes_.is_locked("axis")) mutate_axes(species, genes_);
    }

    /// Gives outlines of a share of the second parent, mutated as far as they are proven.
    ///
    /// returns  false if they are not proven even without mutation
    bool give_outlines(Offspring& out) const {
        Species& species = out.species;
        try {
            if (out.outline > 0.0 && out.outline < 1.0 && !(a_ == b_)) {
                const auto outlines = outlines_between(a_, b_, out.outline, ages_, size_, morphs_);
                for (std::size_t i = 0; i < ages_.size(); ++i)
                    swept_of(species.stages[i]).silhouette = outlines[i];
            } else {
                const Species& of = out.outline > 0.0 ? b_ : a_;
                for (Stage& stage : species.stages)
                    swept_of(stage).silhouette =
                        std::get<Swept>(model_at(of, stage.age).shape).silhouette;
            }
            return mutate_as_far_as_proven(out);
        } catch (const Impossible&) {
            return false;
        }
    }

    bool mutate_as_far_as_proven(Offspring& out) const {
        const bool mutates = genes_.mutation() > 0.0 && !genes_.is_locked("silhouette");
        const CurveMutation mutation(genes_, "silhouette");
        const std::vector<Stage> without = out.species.stages;
        const auto is_proven = [&](double part) {
            out.species.stages = without;
            out.mutation = part;
            if (part > 0.0) mutate_outlines(out.species, mutation, part);
            out.certificate = certificate_of(out.species);
            return out.certificate.simple;
        };
        if (!mutates) {
            const bool proven = is_proven(0.0);
            out.mutation = 1.0;
            return proven;
        }
        if (is_proven(1.0)) return true;
        if (!is_proven(0.0)) return false;
        double part = 1.0;
        for (int halving = 0; halving < halvings; ++halving) {
            part *= 0.5;
            if (is_proven(part)) return true;
        }
        return is_proven(0.0);
    }

    const Species &a_, &b_;
    double size_;
    const Genes& genes_;
    const GetOrCompute<MorphSet>& morphs_;
    mutable std::vector<double> ages_;
};

/// Returns the beginning of a text that fits, in whole characters.
std::string beginning(std::string_view text, std::size_t most) {
    std::size_t size = 0;
    while (size < text.size()) {
        const std::size_t character = std::max<std::size_t>(utf8_length(text.substr(size)), 1);
        if (size + character > most) break;
        size += character;
    }
    return std::string(text.substr(0, size));
}

/// Returns "Amanita muscaria × Boletus edulis", of hybrids what stands first in their names.
template <std::size_t Most>
Text<Most> crossed_name(const Text<Most>& a, const Text<Most>& b) {
    constexpr std::string_view sign = " × ";
    // A name that one parent lacks would be that of the other one alone.
    if (a == b || a.view().empty()) return a;
    if (b.view().empty()) return b;
    const auto first = [&](const Text<Most>& name) {
        return name.view().substr(0, name.view().find(sign));
    };
    const std::string one = beginning(first(a), (Most - sign.size()) / 2);
    return Text<Most>(std::string_view(one + std::string(sign) +
                                       beginning(first(b), Most - sign.size() - one.size())));
}

std::string note_of(const Species& a, const Species& b, const BreedingParams& params) {
    std::string note = "Bred of " + a.id.string() + " and " + b.id.string() + ": seed " +
                       std::to_string(params.seed) + ", share " + number_text(params.share) +
                       ", mutation " + number_text(params.mutation);
    for (const Text<64>& lock : params.lock) note += ", lock " + lock.string();
    return note;
}

/// Names an offspring, and tells in its sources what it was bred of.
void describe(Offspring& out, const Species& a, const Species& b, const BreedingParams& params) {
    Facts& facts = out.species.facts;
    facts.common_name = crossed_name(a.facts.common_name, b.facts.common_name);
    facts.scientific_name = crossed_name(a.facts.scientific_name, b.facts.scientific_name);
    std::vector<std::string> notes = {note_of(a, b, params)};
    if (out.mutation < 1.0)
        notes.push_back("Its outline has " + number_text(out.mutation) +
                        " of its mutation, since with more it would cross itself.");
    const std::size_t most = info_of<Facts>("sources").most;
    std::vector<Text<160>> sources;
    sources.reserve(notes.size() + facts.sources.size());
    for (const std::string& note : notes)
        sources.emplace_back(std::string_view(beginning(note, 160)));
    for (const Text<160>& source : facts.sources)
        if (sources.size() < most) sources.push_back(source);
    facts.sources = std::move(sources);
    out.species.id = {};
    // Individuals draw by the id, so it must not depend on the ecology, which has no part in their shapes.
    Value shape = write(out.species);
    shape.erase("ecology");
    const std::string text = dump(shape);
    std::uint64_t hash = XXH3_64bits(text.data(), text.size());
    std::string id = "offspring_";
    for (int digit = 0; digit < 16; ++digit, hash <<= 4U) id += "0123456789abcdef"[hash >> 60U];
    out.species.id = Text<48>(std::string_view(id));
}

/// Returns the size of an offspring, within what the outlines of both parents can have.
double drawn_size(const Species& a, const Species& b, const Genes& genes) {
    const double of_a = size_of(a), of_b = size_of(b);
    const double share = genes.is_locked(size_part) ? 0.0 : genes.blended(size_part);
    double size = share > 0.0 ? of_b : of_a;
    if (share > 0.0 && share < 1.0 && of_a != of_b)
        size = exponential((1.0 - share) * logarithm(of_a) + share * logarithm(of_b));
    // A mutated outline reaches farther than that of its parents.
    constexpr double headway = 0.7;
    const double most = headway * std::min(most_scale(a) * of_a, most_scale(b) * of_b);
    const double factor = mutated_size(genes);
    return factor == 1.0 ? size : std::min(size * factor, std::max(size, most));
}

}  // namespace

Offspring offspring(const Species& a, const Species& b, const BreedingParams& params,
                    const GetOrCompute<MorphSet>& morphs) {
    require_valid(params);
    require_one_family(a, b);
    if (std::vector<Problem> problems = lock_problems(a, params); !problems.empty())
        throw InvalidInput(std::move(problems));
    const Genes genes(params);
    const double size = drawn_size(a, b, genes);
    const Species scaled_a = scaled(a, size / size_of(a)), scaled_b = scaled(b, size / size_of(b));
    Offspring out;
    out.species = crossed(scaled_a, scaled_b, genes);
    mutate(out.species, genes);
    if (!is_branched(a)) Shaping(scaled_a, scaled_b, size, genes, morphs).shape(out);
    describe(out, a, b, params);
    if (const std::vector<Problem> problems = problems_in(out.species); !problems.empty())
        throw GenerationError("an offspring is invalid: " + problems.front().path + ": " +
                              problems.front().message);
    return out;
}

}  // namespace sporeprint
