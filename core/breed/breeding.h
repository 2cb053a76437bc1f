// The parameters of an offspring, and the random draws of its genes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/purposes.h"
#include "core/math/random.h"
#include "core/model/species.h"
#include "core/params/describe.h"

namespace sporeprint {

/// What an offspring has of its parents.
struct BreedingParams {
    std::uint32_t seed = 1;
    double share = 0.5;
    double mutation = 0.2;
    std::vector<Text<64>> lock{};

    static constexpr void fields(auto visit) {
        using B = BreedingParams;
        visit(&B::seed, Info{.name = "seed",
                             .min = 0,
                             .max = 4294967295.0,
                             .doc = "The offspring: same parents, seed and parameters, same "
                                    "species, bit for bit."});
        visit(&B::share, Info{.name = "share",
                              .min = 0,
                              .max = 1,
                              .doc = "How much it has of the second parent: 0 is the first parent, "
                                     "1 the second."});
        visit(&B::mutation, Info{.name = "mutation",
                                 .min = 0,
                                 .max = 1,
                                 .doc = "How far its genes depart from those of its parents; 0 is "
                                        "not at all."});
        visit(&B::lock,
              Info{.name = "lock",
                   .most = 64,
                   .doc = "Parts that stay as in the first parent, such as surface.cap or "
                          "silhouette; all other parts are the same with and without."});
    }
    bool operator==(const BreedingParams&) const = default;
};
static_assert(well_described<BreedingParams>());

/// Returns everything that `lock` can name for species of the family of this one: parts of a
/// species and what is in them, with dots, in the order of their descriptions.
[[nodiscard]] std::vector<std::string> lockable_parts(const Species& species);

/// Returns the problems of locks that name no part of species of the family of this one, with paths
/// "/lock/<i>".
[[nodiscard]] std::vector<Problem> lock_problems(const Species& species,
                                                 const BreedingParams& params);

/// The draws and locks of one offspring. Every gene has a stream of its own, keyed by its path, so
/// that neither a new gene nor a locked one changes another.
class Genes {
  public:
    explicit Genes(const BreedingParams& params) : params_(params) {}

    [[nodiscard]] double mutation() const { return params_.mutation; }
    [[nodiscard]] double share() const { return params_.share; }

    /// Returns true if a part is locked, alone or with the part that it belongs to; the amount of an
    /// ornament belongs to the ornament too.
    [[nodiscard]] bool is_locked(std::string_view path) const {
        constexpr std::string_view amounts = "ornaments.";
        if (path.starts_with(amounts) && is_locked(path.substr(amounts.size()))) return true;
        return std::any_of(params_.lock.begin(), params_.lock.end(), [&](const Text<64>& lock) {
            const std::string_view part = lock;
            return path.starts_with(part) &&
                   (path.size() == part.size() || path[part.size()] == '.');
        });
    }
    /// Returns true if something in a part is locked, but not all of it.
    [[nodiscard]] bool is_locked_within(std::string_view path) const {
        return std::any_of(params_.lock.begin(), params_.lock.end(), [&](const Text<64>& lock) {
            const std::string_view part = lock;
            return part.size() > path.size() && part.starts_with(path) && part[path.size()] == '.';
        });
    }

    /// Returns the share of the second parent in a part that blends: `share` and a spread that is
    /// 0.35 wide for equal shares and vanishes where one parent has all.
    [[nodiscard]] double blended(std::string_view path) const {
        Random random(params_.seed, purposes::crossing, stream_of(path));
        const double spread = 1.4 * params_.share * (1.0 - params_.share);
        return std::clamp(params_.share + spread * (random.uniform() - 0.5), 0.0, 1.0);
    }
    /// Returns true if a part that cannot blend comes from the second parent.
    [[nodiscard]] bool is_of_second(std::string_view path) const {
        Random random(params_.seed, purposes::crossing, stream_of(path));
        return random.uniform() < params_.share;
    }
    /// Returns the stream of the mutation of a gene.
    [[nodiscard]] Random mutating(std::string_view path) const {
        return {params_.seed, purposes::mutation, stream_of(path)};
    }

  private:
    const BreedingParams& params_;
};

}  // namespace sporeprint
