#include "core/params/mix.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/grow/names.h"

namespace sporeprint::params_mix_test {
namespace {

int total(const Mix& mix) {
    int sum = 0;
    for (const MixPart& part : mix) sum += part.weight;
    return sum;
}

TEST(CanonicalMix, IsThatOfTheContract) {
    const std::pair<Weights, const char*> cases[] = {
        {{{"a", 1}}, "a"},
        {{{"a", 5}}, "a"},
        {{{"a", 9999}, {"b", 1}}, "a"},
        {{{"b", 0.3}, {"a", 0.7}}, "a:0.7,b:0.3"},
        {{{"a", 7}, {"b", 3}}, "a:0.7,b:0.3"},
        {{{"a", 1}, {"b", 1}}, "a:0.5,b:0.5"},
        {{{"c", 1}, {"b", 1}, {"a", 1}},
         "a:0.334,b:0.333,c:0.333"},                          // the tie goes to the first id
        {{{"a", 0.5005}, {"b", 0.4995}}, "a:0.501,b:0.499"},  // a tie that doubles do not see
        {{{"a", 5005}, {"b", 4995}}, "a:0.501,b:0.499"},      // the same in other words
        {{{"a", 1e308}, {"b", 1e308}}, "a:0.5,b:0.5"},        // the sum would overflow
        {{{"a", 5e-324}, {"b", 5e-324}}, "a:0.5,b:0.5"},
        {{{"a", 1e308}, {"b", 5e-324}}, "a"},
    };
    for (const auto& [weights, text] : cases) {
        const Mix mix = canonical_mix(weights);
        EXPECT_EQ(mix_text(mix), text);
        EXPECT_EQ(total(mix), 1000);
    }
}

RC_GTEST_PROP(CanonicalMixProperty, IsIdempotentSumsToAThousandAndIgnoresScaleAndOrder, ()) {
    const auto numbers = *rc::gen::container<std::vector<int>>(
        static_cast<std::size_t>(*rc::gen::inRange(1, 9)), rc::gen::inRange(1, 100'000));
    Weights weights, scaled;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        weights.emplace_back(std::string(1, static_cast<char>('a' + i)), numbers[i]);
        scaled.insert(scaled.begin(), {weights.back().first, numbers[i] * 0.37});
    }
    const Mix mix = canonical_mix(weights);
    RC_ASSERT(total(mix) == 1000);
    RC_ASSERT(mix == canonical_mix(scaled));
    Weights again;
    for (const MixPart& part : mix) {
        RC_ASSERT(part.weight > 0);
        again.emplace_back(part.id,
                           std::stod(number_text(part.weight / 1000.0)));  // as from its own text
    }
    RC_ASSERT(canonical_mix(again) == mix);
    // Largest remainder never moves a share by a whole thousandth.
    double sum = 0.0;
    for (const int number : numbers) sum += number;
    for (const MixPart& part : mix) {
        const double exact = numbers[static_cast<std::size_t>(part.id[0] - 'a')] / sum * 1000.0;
        RC_ASSERT(part.weight > exact - 1.001 && part.weight < exact + 1.001);
    }
}

}  // namespace
}  // namespace sporeprint::params_mix_test
