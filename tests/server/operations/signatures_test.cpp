#include "server/operations/signatures.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "core/problems.h"

namespace sporeprint::server::operations_signatures_test {
namespace {

std::string bytes_from(char first) {
    std::string bytes;
    for (int i = 0; i < 32; ++i) bytes += static_cast<char>(first + i);
    return bytes;
}

const SigningKey old_key{"a", bytes_from(0)}, new_key{"b", bytes_from(1)};
constexpr std::string_view agaric = "/v1/mushrooms/amanita_muscaria.glb?age=0.5";
constexpr std::int64_t now = 1'900'000'000;

std::string why(const Signatures& signatures, std::string_view target,
                std::string_view method = "GET", std::string_view body = "") {
    return signatures.check(method, target, body, now).refusal;
}

/// Returns the messages of InvalidInput for a text of keys.
std::string error_of(std::string_view text) {
    try {
        static_cast<void>(Signatures::from_text("keys.txt", text));
        return "(none)";
    } catch (const InvalidInput& input) {
        std::string all;
        for (const Problem& problem : input.problems())
            all += problem.path + ": " + problem.message + '\n';
        return all;
    }
}

// Computed with another implementation of HMAC-SHA256.
TEST(Signatures, MatchAnIndependentImplementation) {
    const Signatures signatures({old_key});
    EXPECT_EQ(signatures.signed_target("GET", agaric, "", 2'000'000'000),
              std::string(agaric) +
                  "&key=a&expires=2000000000&sig=iUgVaMp6hYK4yszMnh7UcaxbdzFLzHWGkLWLczaufuQ");
    EXPECT_EQ(signatures.signed_target("POST", "/v1/mushrooms.glb", R"({"mix":"amanita_muscaria"})",
                                       std::nullopt),
              "/v1/mushrooms.glb?key=a&sig=cVR71aaTwitccMrPczm_Wz5cFczfpNPdZdHt6XYcjIc");
}

TEST(Signatures, OfGetAreValidForHeadAndAbsoluteTargets) {
    const Signatures signatures({old_key});
    const std::string target = signatures.signed_target("GET", agaric, "", std::nullopt);
    EXPECT_EQ(signatures.check("GET", target, "", now).target, agaric);
    EXPECT_EQ(signatures.check("HEAD", target, "", now).target, agaric);
    EXPECT_EQ(signatures.check("GET", "http://host:80" + target, "", now).target, agaric);
    EXPECT_FALSE(signatures.check("POST", target, "", now).is_valid);
}

TEST(Signatures, CoverTheBodyOfAPost) {
    const Signatures signatures({old_key});
    const std::string target = signatures.signed_target("POST", "/v1/leaves.glb", "{}", now + 1);
    EXPECT_EQ(signatures.check("POST", target, "{}", now).target, "/v1/leaves.glb");
    EXPECT_EQ(why(signatures, target, "POST", "{} "), "the signature is not that of this address");
    EXPECT_FALSE(signatures.check("GET", target, "", now).is_valid);
}

TEST(Signatures, Expire) {
    const Signatures signatures({old_key});
    EXPECT_EQ(signatures.check("GET", signatures.signed_target("GET", agaric, "", now + 1), "", now)
                  .target,
              agaric);
    EXPECT_EQ(why(signatures, signatures.signed_target("GET", agaric, "", now)),
              "the address was good until 1900000000");
    EXPECT_EQ(why(signatures, signatures.signed_target("GET", agaric, "", -1)),
              "the address was good until -1");
}

TEST(Signatures, OfAllKeysAreValidAndTheFirstKeySigns) {
    const Signatures both({new_key, old_key}), before({old_key}), after({new_key});
    const std::string of_old = before.signed_target("GET", agaric, "", std::nullopt);
    EXPECT_TRUE(both.check("GET", of_old, "", now).is_valid);
    EXPECT_TRUE(
        after.check("GET", both.signed_target("GET", agaric, "", now + 9), "", now).is_valid);
    EXPECT_EQ(why(after, of_old), "there is no key 'a'");
    // A key with a known id and another secret is not accepted.
    EXPECT_EQ(why(Signatures({{"a", new_key.secret}}), of_old),
              "the signature is not that of this address");
}

TEST(Signatures, ThatAreMissingOrMisplacedAreReported) {
    const Signatures signatures({old_key});
    const std::string good = signatures.signed_target("GET", agaric, "", std::nullopt);
    const std::string none = "the address is not signed; its last parameter has to be sig";
    for (const std::string& target :
         {std::string(agaric), std::string("/v1"), std::string(), good + "&seed=7", good + "#x&",
          std::string("/sig=x"), std::string("/?sig"), std::string("/?a=sig=")})
        EXPECT_FALSE(signatures.check("GET", target, "", now).is_valid) << target;
    EXPECT_EQ(why(signatures, agaric), none);
    EXPECT_EQ(why(signatures, good + "&seed=7"), none);
    EXPECT_EQ(why(signatures, "/v1?sig=x"),
              "a signed address ends with key, expires if it does, and sig, in this order");
    EXPECT_EQ(why(signatures, good + "A"), "the signature is not that of this address");
    EXPECT_EQ(why(signatures, good.substr(0, good.size() - 1)),
              "the signature is not that of this address");
}

// After any change a signed target is invalid, or it is the same request.
RC_GTEST_PROP(SignaturesProperty, NoChangedTargetIsValid, ()) {
    const Signatures signatures({old_key, new_key});
    std::string target = signatures.signed_target("GET", agaric, "", now + 100);
    const std::string before = target;
    const auto at = *rc::gen::inRange<std::size_t>(0, target.size());
    switch (*rc::gen::inRange(0, 3)) {
        case 0:
            target[at] = *rc::gen::arbitrary<char>();
            break;
        case 1:
            target.erase(at, *rc::gen::inRange<std::size_t>(1, 10));
            break;
        default:
            target.insert(at, *rc::gen::string<std::string>());
    }
    const SignatureCheck checked = signatures.check("GET", target, "", now);
    RC_ASSERT(checked.is_valid == (target == before));
    RC_ASSERT(checked.is_valid == checked.refusal.empty());
}

RC_GTEST_PROP(SignaturesProperty, SignedTargetsAreValidAndReturnedWithoutSignature, ()) {
    const Signatures signatures({new_key, old_key});
    const auto word = rc::gen::container<std::string>(
        rc::gen::elementOf(std::string("abcdefghijklmnopqrstuvwxyz0123456789.,:=%_-/")));
    std::string target = "/" + *word;
    const auto parameters = *rc::gen::container<std::vector<std::string>>(word);
    for (std::size_t i = 0; i < parameters.size(); ++i)
        target += (i == 0 ? "?p=" : "&p=") + parameters[i];
    const std::string body = *rc::gen::arbitrary<std::string>();
    const bool posted = *rc::gen::arbitrary<bool>();
    const std::string_view method = posted ? "POST" : "GET";
    const std::string generated = signatures.signed_target(method, target, body, now + 1);
    const SignatureCheck checked = signatures.check(method, generated, body, now);
    RC_ASSERT(checked.is_valid);
    RC_ASSERT(checked.target == target);
}

TEST(Signatures, ReadKeysFromAText) {
    const Signatures signatures =
        Signatures::from_text("keys.txt", "# new first\r\n\n b \t" + std::string(32, 'a') +
                                              "\r\na " + std::string(64, 'F'));
    EXPECT_TRUE(signatures
                    .check("GET",
                           Signatures({{"a", std::string(32, '\xff')}})
                               .signed_target("GET", agaric, "", std::nullopt),
                           "", now)
                    .is_valid);
    EXPECT_NE(signatures.signed_target("GET", agaric, "", std::nullopt).find("&key=b&"),
              std::string::npos);
}

TEST(Signatures, EveryInvalidLineIsReportedWithoutSecrets) {
    const std::string secret(40, 'e');
    EXPECT_EQ(error_of("a " + secret + "x\nb\nc " + secret + " d\n"),
              "keys.txt:1: a line is an id and a secret in hexadecimal digits\n"
              "keys.txt:2: a line is an id and a secret in hexadecimal digits\n"
              "keys.txt:3: a line is an id and a secret in hexadecimal digits\n");
    EXPECT_NE(error_of("# nothing").find("there is no key"), std::string::npos);
    EXPECT_NE(error_of("a 00").find("has 1 bytes; allowed are 16 to 64"), std::string::npos);
    EXPECT_NE(error_of("a&b " + secret).find("keys.txt:1: the id has to be 1 to 32 of"),
              std::string::npos);
    const std::string twice = error_of("a " + secret + "\na " + secret);
    EXPECT_NE(twice.find("keys.txt:2: a key before it has the same id"), std::string::npos);
    EXPECT_EQ(twice.find(secret), std::string::npos);
    // Secret and id swapped.
    EXPECT_EQ(error_of(secret + " abcd").find(secret), std::string::npos);
    EXPECT_EQ(error_of(secret + secret + " " + secret).find(secret), std::string::npos);
    EXPECT_THROW(static_cast<void>(Signatures::from_file("/no/such/keys")), InvalidInput);
}

}  // namespace
}  // namespace sporeprint::server::operations_signatures_test
