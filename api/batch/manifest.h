// Manifests of files that are made in advance: a list of addresses, or a spec of a few lines for millions of them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/params/value.h"

namespace sporeprint::api {

/// One file of a manifest.
struct BatchItem {
    std::string target;   ///< path and query of its request
    Value::Object drawn;  ///< what the manifest chose for it, by names
};

/// What a manifest says, each item by its number alone. Immutable, hence thread-safe.
///
/// A list has one path and query per line; `#` begins a comment. A spec is a JSON object:
///
///     path       path of the requests, with names in braces: "/v1/things/{name}.glb". Names that are not in the path
///                become parameters of the query
///     count      number of items; with `each`, its combinations unless it is given
///     seed       of all draws, 0 to 4294967295; 1 by itself
///     fixed      values by names
///     each       lists by names, of which all combinations are made in turn, the last name fastest
///     number     first values by names: integers that grow by 1 from item to item, or from one round of the combinations
///                to the next
///     choice     lists by names, of which each item draws one value
///     uniform    ranges [from, to] by names, of which each item draws a number of six digits
///     integer    ranges [first, last] by names, of which each item draws an integer
///     draws      "item" by itself: each item draws; "round": one draw for all combinations of `each`, as for the levels
///                of detail of one individual
///     per_shard  items of a shard, 1 to 1,000,000; 1000 by itself
///     labels     whether there is a file of labels beside each; true by itself
///     generator  version of the generator that it is meant for; any by itself
///
/// A draw depends on `seed`, the number of the item or the round and the name alone, so that another name changes no other
/// draw.
class BatchManifest {
  public:
    /// throws  InvalidInput with all problems; their paths are JSON pointers, or "line 3" of a list
    explicit BatchManifest(std::string_view text);

    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] std::uint64_t per_shard() const { return per_shard_; }
    [[nodiscard]] std::uint64_t shards() const {
        return count_ / per_shard_ + (count_ % per_shard_ > 0 ? 1 : 0);
    }
    [[nodiscard]] bool has_labels() const { return labels_; }
    /// Version of the generator that it requires; empty for any.
    [[nodiscard]] const std::string& generator() const { return generator_; }
    /// Lower-case hexadecimal SHA-256 of its text.
    [[nodiscard]] const std::string& digest() const { return digest_; }

    /// Returns an item.
    ///
    /// pre  number < count()
    [[nodiscard]] BatchItem item(std::uint64_t number) const;

  private:
    struct Each {
        std::vector<Value> values;
    };
    struct Number {
        double first = 0.0;
    };
    struct Choice {
        std::vector<Value> values;
    };
    struct Uniform {
        double from = 0.0, to = 0.0;
    };
    struct Integer {
        std::int64_t first = 0;
        std::uint64_t values = 1;
    };
    using Rule = std::variant<Value, Each, Number, Choice, Uniform, Integer>;
    struct Named {
        std::string name;
        Rule rule;
    };

    class Reader;
    /// Returns the value of a rule for an item.
    [[nodiscard]] Value value_of(const Named& named, std::uint64_t number,
                                 std::uint64_t combination) const;

    std::uint64_t count_ = 0, per_shard_ = 1000, combinations_ = 1;
    std::uint32_t seed_ = 1;
    bool labels_ = true, draws_by_round_ = false;
    std::string generator_, digest_;
    std::vector<std::string> list_;  ///< empty for a spec
    std::string path_;
    std::vector<Named>
        rules_;  ///< those of `each` in their order, what is fixed before them, all else behind
};

/// Returns a text with everything percent-encoded that may stand neither in a path nor in a query, and what separates their
/// parts.
[[nodiscard]] std::string escaped_in_address(std::string_view text);

}  // namespace sporeprint::api
