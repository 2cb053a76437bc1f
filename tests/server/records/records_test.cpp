// The contract of a database of documents, tested with every kind of database.
#include "api/library/records.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "api/library/tokens.h"
#include "tests/server/records/backends.h"

namespace sporeprint::server::records_test {
namespace {

using namespace api;
using namespace test;

class RecordsContract : public testing::TestWithParam<NamedBackend> {
  protected:
    std::unique_ptr<Backend> backend_;
    std::unique_ptr<Records> records_;

    void SetUp() override {
        ASSERT_TRUE(GetParam().is_installed()) << "server/install test installs it";
        backend_ = GetParam().make();
        records_ = backend_->open();
        ASSERT_TRUE(records_->add_owner("kaja", 1000));
        ASSERT_TRUE(records_->add_owner("sami", 1001));
    }
    [[nodiscard]] std::int64_t used(std::string_view owner) {
        return records_->owner(owner).value().used_bytes;
    }
    /// Returns the bytes that an owner's documents have by a count of all of them.
    [[nodiscard]] std::int64_t counted(std::string_view owner) {
        std::int64_t bytes = 0;
        std::map<Digest, std::size_t> blobs;
        Listing listing;
        listing.reader = listing.owner = owner;
        listing.limit = 1'000'000;
        for (const StoredDocument& document : records_->list(listing))
            for (int number = 0; number <= document.newest; ++number) {
                const Version version =
                    records_->version(document.owner, document.name, number).value();
                bytes += static_cast<std::int64_t>(version.content.text.size());
                for (const Blob& one : version.content.blobs) blobs[one.sha256] = one.bytes.size();
            }
        for (const auto& [digest, size] : blobs) bytes += static_cast<std::int64_t>(size);
        return bytes;
    }
};

TEST_P(RecordsContract, OwnersAreUniqueAndListedByName) {
    EXPECT_FALSE(records_->add_owner("kaja", 5));
    EXPECT_TRUE(records_->add_owner("anna", 5));
    std::vector<std::string> names;
    for (const Owner& owner : records_->owners()) names.push_back(owner.name);
    EXPECT_EQ(names, (std::vector<std::string>{"anna", "kaja", "sami"}));
    EXPECT_EQ(records_->owner("kaja")->created, 1000);
    EXPECT_FALSE(records_->owner("nobody"));
    EXPECT_TRUE(records_->set_disabled("kaja", true, 7));
    EXPECT_TRUE(records_->owner("kaja")->is_disabled);
    EXPECT_TRUE(records_->set_disabled("kaja", false, 8));
    EXPECT_FALSE(records_->owner("kaja")->is_disabled);
    EXPECT_FALSE(records_->set_disabled("nobody", true, 8));
    EXPECT_FALSE(records_->set_limits("nobody", 1, 1));
}

TEST_P(RecordsContract, TokensAreFoundRevokedAndBounded) {
    Token token;
    token.id = "abcdefgh";
    token.owner = "kaja";
    token.secret = sha256_of("secret");
    token.label = "laptop";
    token.scope = Scope::write;
    token.created = 50;
    token.expires = 100;
    EXPECT_EQ(records_->add_token(token), WriteResult::done);
    const Token found = records_->token("abcdefgh").value();
    EXPECT_EQ(found.owner, "kaja");
    EXPECT_EQ(found.secret, token.secret);
    EXPECT_EQ(found.label, "laptop");
    EXPECT_EQ(found.scope, Scope::write);
    EXPECT_EQ(found.expires, 100);
    EXPECT_FALSE(found.last_used);
    EXPECT_FALSE(found.revoked);
    EXPECT_FALSE(found.is_owner_disabled);
    EXPECT_FALSE(records_->token("abcdefgi"));

    records_->note_use("abcdefgh", 1000);
    records_->note_use("abcdefgh", 1030);
    EXPECT_EQ(records_->token("abcdefgh")->last_used, 1000) << "noted once a minute";
    records_->note_use("abcdefgh", 1090);
    EXPECT_EQ(records_->token("abcdefgh")->last_used, 1090);

    EXPECT_FALSE(records_->revoke_token("sami", "abcdefgh", 60)) << "another's token";
    EXPECT_TRUE(records_->revoke_token("kaja", "abcdefgh", 60));
    EXPECT_TRUE(records_->revoke_token("kaja", "abcdefgh", 70));
    EXPECT_EQ(records_->token("abcdefgh")->revoked, 60);
    records_->set_disabled("kaja", true, 61);
    EXPECT_TRUE(records_->token("abcdefgh")->is_owner_disabled);

    token.owner = "sami";
    token.expires.reset();
    for (int i = 0; i < most_tokens; ++i) {
        token.id = "token" + std::to_string(100 + i);
        EXPECT_EQ(records_->add_token(token), WriteResult::done);
    }
    token.id = "one_more";
    EXPECT_EQ(records_->add_token(token), WriteResult::too_many);
    EXPECT_TRUE(records_->revoke_token("sami", "token100", 60));
    EXPECT_EQ(records_->add_token(token), WriteResult::done);
    EXPECT_EQ(records_->tokens("sami").size(), static_cast<std::size_t>(most_tokens) + 1);
    token.owner = "nobody";
    token.id = "two_more";
    EXPECT_EQ(records_->add_token(token), WriteResult::missing);
}

TEST_P(RecordsContract, ADraftIsReadAsItWasWritten) {
    const Content written = content("first", {blob("/a", "pixels"), blob("/b", "more pixels")});
    const Written created = records_->create("kaja", "bolete", written, "~sami.cap@2", "", 20);
    EXPECT_EQ(created.result, WriteResult::done);
    EXPECT_EQ(created.revision, 1);
    EXPECT_EQ(created.current, written.hash);
    const Version draft = records_->version("kaja", "bolete", 0).value();
    EXPECT_EQ(draft.content.text, "first");
    EXPECT_EQ(draft.content.hash, written.hash);
    EXPECT_EQ(draft.content.kind, "capped");
    EXPECT_EQ(draft.content.title, "Title of first");
    EXPECT_EQ(draft.made, 20);
    ASSERT_EQ(draft.content.blobs.size(), 2U);
    EXPECT_EQ(draft.content.blobs[0].place, "/a");
    EXPECT_EQ(std::string(draft.content.blobs[1].bytes.begin(), draft.content.blobs[1].bytes.end()),
              "more pixels");
    const StoredDocument document = records_->document("kaja", "bolete").value();
    EXPECT_EQ(document.newest, 0);
    EXPECT_EQ(document.parent, "~sami.cap@2");
    EXPECT_EQ(document.created, 20);
    EXPECT_FALSE(records_->version("kaja", "bolete", 1));
    EXPECT_FALSE(records_->document("sami", "bolete"));
    EXPECT_EQ(records_->create("kaja", "bolete", written, "", "", 21).result, WriteResult::taken);
    EXPECT_EQ(records_->create("sami", "bolete", written, "", "", 21).result, WriteResult::done);
    EXPECT_EQ(records_->create("nobody", "bolete", written, "", "", 21).result,
              WriteResult::missing);
}

TEST_P(RecordsContract, OfTwoWritersOneIsStale) {
    records_->create("kaja", "bolete", content("first"), "", "", 1);
    const std::unique_ptr<Records> other = backend_->open();
    const std::optional<Digest> seen = sha256_of("first");
    const Written one = records_->replace("kaja", "bolete", seen, content("second"), 2);
    EXPECT_EQ(one.result, WriteResult::done);
    EXPECT_EQ(one.revision, 2);
    const Written two = other->replace("kaja", "bolete", seen, content("third"), 3);
    EXPECT_EQ(two.result, WriteResult::stale);
    EXPECT_EQ(two.current, sha256_of("second"));
    EXPECT_EQ(records_->version("kaja", "bolete", 0)->content.text, "second");
    EXPECT_EQ(other->publish("kaja", "bolete", seen, {}, 4).result, WriteResult::stale);
    EXPECT_EQ(other->withdraw("kaja", "bolete", seen, true, 4).result, WriteResult::stale);
    EXPECT_EQ(other->replace("kaja", "bolete", std::nullopt, content("third"), 3).result,
              WriteResult::done)
        << "any draft";
    EXPECT_EQ(records_->replace("kaja", "nothing", seen, content("x"), 2).result,
              WriteResult::missing);
}

TEST_P(RecordsContract, APublishedVersionNeverChanges) {
    records_->create("kaja", "bolete", content("first", {blob("/a", "pixels")}), "", "", 1);
    const Written published =
        records_->publish("kaja", "bolete", sha256_of("first"), {"the first"}, 2);
    EXPECT_EQ(published.result, WriteResult::done);
    EXPECT_EQ(published.number, 1);
    for (int i = 2; i <= most_versions; ++i) {
        const std::string text = "version " + std::to_string(i);
        ASSERT_EQ(records_->replace("kaja", "bolete", std::nullopt, content(text), i).result,
                  WriteResult::done);
        ASSERT_EQ(records_->publish("kaja", "bolete", sha256_of(text), {}, i).number, i);
    }
    EXPECT_EQ(records_->publish("kaja", "bolete", std::nullopt, {}, 99).result,
              WriteResult::too_many);
    records_ = backend_->open();
    const Version first = records_->version("kaja", "bolete", 1).value();
    EXPECT_EQ(first.content.text, "first");
    EXPECT_EQ(first.content.hash, sha256_of("first"));
    EXPECT_EQ(first.note, "the first");
    EXPECT_EQ(first.made, 2);
    ASSERT_EQ(first.content.blobs.size(), 1U) << "the draft has no blob any more, the version has";
    EXPECT_EQ(first.content.blobs[0].sha256, sha256_of("pixels"));
    EXPECT_EQ(records_->version("kaja", "bolete", 7)->content.text, "version 7");
    EXPECT_EQ(used("kaja"), counted("kaja"));
}

TEST_P(RecordsContract, PurgedDocumentsHaveNoBytesAndKeepTheirNames) {
    const std::string secret_text = "a text that must not be found again 7f3a";
    const std::string secret_pixels = "pixels that must not be found again 9c1e";
    records_->create("kaja", "bolete", content(secret_text, {blob("/a", secret_pixels)}), "", "",
                     1);
    records_->publish("kaja", "bolete", std::nullopt, {}, 2);
    records_->create("sami", "other", content("other", {blob("/a", "shared pixels")}), "", "", 1);
    records_->create("kaja", "copy", content("copy", {blob("/a", "shared pixels")}), "", "", 1);
    EXPECT_TRUE(backend_->contains(secret_text));
    EXPECT_TRUE(backend_->contains(secret_pixels));

    EXPECT_EQ(records_->withdraw("kaja", "bolete", std::nullopt, true, 3).result,
              WriteResult::done);
    EXPECT_EQ(records_->withdraw("kaja", "copy", std::nullopt, true, 3).result, WriteResult::done);
    EXPECT_EQ(records_->document("kaja", "bolete")->state, DocumentState::purged);
    EXPECT_FALSE(records_->version("kaja", "bolete", 1));
    EXPECT_FALSE(records_->version("kaja", "bolete", 0));
    EXPECT_EQ(records_->create("kaja", "bolete", content("new"), "", "", 4).result,
              WriteResult::taken);
    EXPECT_EQ(records_->replace("kaja", "bolete", std::nullopt, content("new"), 4).result,
              WriteResult::purged);
    EXPECT_EQ(records_->publish("kaja", "bolete", std::nullopt, {}, 4).result, WriteResult::purged);
    EXPECT_EQ(used("kaja"), 0);
    EXPECT_EQ(records_->owner("kaja")->documents, 0);
    EXPECT_EQ(records_->version("sami", "other", 0)->content.blobs.size(), 1U)
        << "what another document has stays";
    EXPECT_FALSE(backend_->contains(secret_text));
    EXPECT_FALSE(backend_->contains(secret_pixels));
}

TEST_P(RecordsContract, FilesOfAVersionStayWithIt) {
    records_->create("kaja", "bolete", content("first", {blob("/a", "pixels")}), "", "", 1);
    const std::int64_t before = used("kaja");
    const std::vector<Blob> files = {blob("0.glb", "many triangles"), blob("3.glb", "few")};
    EXPECT_EQ(records_->publish("kaja", "bolete", std::nullopt, {"", files, 2}, 2).result,
              WriteResult::stale)
        << "files of another version than the next";
    records_->set_limits("kaja", 10, before + 10);
    EXPECT_EQ(records_->publish("kaja", "bolete", std::nullopt, {"", files, 1}, 2).result,
              WriteResult::too_large);
    EXPECT_EQ(used("kaja"), before);
    records_->set_limits("kaja", 10, 1'000'000);
    EXPECT_EQ(records_->publish("kaja", "bolete", std::nullopt, {"", files, 1}, 2).number, 1);
    EXPECT_EQ(used("kaja"), before + 5 + 14 + 3) << "the text and the files";
    EXPECT_EQ(records_->version("kaja", "bolete", 1)->content.blobs.size(), 1U)
        << "files are not read with the text";
    const std::vector<Blob> named = records_->files("kaja", "bolete", 1);
    ASSERT_EQ(named.size(), 2U);
    EXPECT_EQ(named[0].place, "0.glb");
    EXPECT_EQ(named[1].sha256, sha256_of("few"));
    const Blob file = records_->file("kaja", "bolete", 1, "3.glb").value();
    EXPECT_EQ(std::string(file.bytes.begin(), file.bytes.end()), "few");
    EXPECT_FALSE(records_->file("kaja", "bolete", 1, "1.glb"));
    EXPECT_FALSE(records_->file("kaja", "bolete", 1, "/a")) << "an image of the text is no file";
    EXPECT_TRUE(records_->files("kaja", "bolete", 0).empty());
    records_->publish("kaja", "bolete", std::nullopt, {}, 3);
    EXPECT_TRUE(records_->files("kaja", "bolete", 2).empty()) << "the next version has none";
    records_->withdraw("kaja", "bolete", std::nullopt, true, 4);
    EXPECT_FALSE(records_->file("kaja", "bolete", 1, "3.glb"));
    EXPECT_EQ(used("kaja"), 0);
    EXPECT_FALSE(backend_->contains("many triangles"));
}

TEST_P(RecordsContract, UnlistedDocumentsStayAndAreListedAgainWhenPublished) {
    records_->create("kaja", "bolete", content("first"), "", "", 1);
    records_->publish("kaja", "bolete", std::nullopt, {}, 2);
    EXPECT_EQ(records_->list({}).size(), 1U);
    EXPECT_EQ(records_->withdraw("kaja", "bolete", std::nullopt, false, 3).result,
              WriteResult::done);
    EXPECT_TRUE(records_->list({}).empty());
    EXPECT_EQ(records_->version("kaja", "bolete", 1)->content.text, "first");
    records_->publish("kaja", "bolete", std::nullopt, {}, 4);
    EXPECT_EQ(records_->list({}).size(), 1U);
}

TEST_P(RecordsContract, ListsContainWhatTheReaderMaySee) {
    for (const char* const name : {"alpha", "beta", "gamma_cap", "delta"})
        records_->create("kaja", name, content(name),
                         name == std::string("beta") ? "~sami.cap@2" : "", "", 1);
    records_->create("sami", "cap", content("Cap"), "", "", 1);
    for (const char* const name : {"alpha", "beta", "gamma_cap"})
        records_->publish("kaja", name, std::nullopt, {}, 2);
    const auto names = [&](const Listing& listing) {
        std::vector<std::string> found;
        for (const StoredDocument& document : records_->list(listing))
            found.push_back(document.name);
        return found;
    };
    using Names = std::vector<std::string>;
    Listing listing;
    EXPECT_EQ(names(listing), (Names{"alpha", "beta", "gamma_cap"}));
    listing.reader = "sami";
    EXPECT_EQ(names(listing), (Names{"alpha", "beta", "gamma_cap", "cap"})) << "own drafts too";
    listing.reader = "kaja";
    EXPECT_EQ(names(listing), (Names{"alpha", "beta", "delta", "gamma_cap"}));
    listing.limit = 2;
    EXPECT_EQ(names(listing), (Names{"alpha", "beta"}));
    listing.after_owner = "kaja";
    listing.after_name = "beta";
    EXPECT_EQ(names(listing), (Names{"delta", "gamma_cap"}));
    listing = {};
    listing.parent = "~sami.cap";
    EXPECT_EQ(names(listing), Names{"beta"}) << "of any version";
    listing.parent = "~sami.cap@2";
    EXPECT_EQ(names(listing), Names{"beta"});
    listing.parent = "~sami.ca";
    EXPECT_EQ(names(listing), Names{});
    listing = {};
    listing.part = "A_C";
    EXPECT_EQ(names(listing), Names{"gamma_cap"}) << "'_' stands for itself";
    listing.part = "title of b";
    EXPECT_EQ(names(listing), Names{"beta"});
    listing.part = "%";
    EXPECT_EQ(names(listing), Names{});
    listing = {};
    listing.kind = "club";
    EXPECT_EQ(names(listing), Names{});
}

TEST_P(RecordsContract, ChangesTellOthersWhatIsPublished) {
    const std::unique_ptr<Records> other = backend_->open();
    records_->create("kaja", "bolete", content("first"), "", "", 1);
    EXPECT_TRUE(other->changes(0).empty()) << "drafts are no news";
    records_->publish("kaja", "bolete", std::nullopt, {}, 2);
    records_->create("sami", "cap", content("cap"), "", "", 1);
    records_->publish("sami", "cap", std::nullopt, {}, 2);
    std::vector<Change> changes = other->changes(0);
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_EQ(changes[0].name, "bolete");
    ASSERT_EQ(changes[0].versions.size(), 1U);
    EXPECT_EQ(changes[0].versions[0].first, 1);
    EXPECT_EQ(changes[0].versions[0].second, sha256_of("first"));
    EXPECT_LT(changes[0].serial, changes[1].serial);
    const std::int64_t seen = changes.back().serial;
    EXPECT_TRUE(other->changes(seen).empty());
    records_->withdraw("kaja", "bolete", std::nullopt, true, 3);
    changes = other->changes(seen);
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_EQ(changes[0].state, DocumentState::purged);
    EXPECT_TRUE(changes[0].versions.empty());
}

TEST_P(RecordsContract, SharesAreBoundedAndRevoked) {
    records_->create("kaja", "bolete", content("first"), "", "", 1);
    Share share{"share000", sha256_of("key"), 10, 100, false};
    for (int i = 0; i < most_shares; ++i) {
        share.id = "share" + std::to_string(100 + i);
        EXPECT_EQ(records_->add_share("kaja", "bolete", share), WriteResult::done);
    }
    share.id = "share999";
    EXPECT_EQ(records_->add_share("kaja", "bolete", share), WriteResult::too_many);
    EXPECT_EQ(records_->share("kaja", "bolete", "share101")->expires, 100);
    EXPECT_FALSE(records_->share("kaja", "bolete", "nothing1"));
    EXPECT_FALSE(records_->share("sami", "bolete", "share101"));
    EXPECT_TRUE(records_->revoke_share("kaja", "bolete", "share100"));
    EXPECT_FALSE(records_->revoke_share("sami", "bolete", "share101"));
    EXPECT_EQ(records_->add_share("kaja", "bolete", share), WriteResult::done);
    const std::vector<Share> shares = records_->shares("kaja", "bolete");
    ASSERT_EQ(shares.size(), static_cast<std::size_t>(most_shares) + 1);
    EXPECT_TRUE(shares.front().is_revoked);
    EXPECT_EQ(shares.front().secret, sha256_of("key"));
    EXPECT_EQ(shares.front().expires, 100);
    EXPECT_EQ(records_->add_share("kaja", "nothing", share), WriteResult::missing);
    for (int i = 0; i < 300; ++i) {  // what is revoked does not pile up
        records_->revoke_share("kaja", "bolete", share.id);
        share.id = "again" + std::to_string(100 + i);
        EXPECT_EQ(records_->add_share("kaja", "bolete", share), WriteResult::done);
    }
    EXPECT_LE(records_->shares("kaja", "bolete").size(), 5 * static_cast<std::size_t>(most_shares));
}

TEST_P(RecordsContract, ADocumentIsRestoredWithAllItsVersionsOrNotAtAll) {
    StoredDocument document;
    document.owner = "kaja";
    document.name = "bolete";
    document.parent = "~sami.cap@1";
    document.created = 5;
    document.updated = 6;
    std::vector<Version> versions;
    for (int i = 0; i <= 3; ++i) {
        Version version;
        version.number = i;
        version.made = 100 + i;
        version.content = content("version " + std::to_string(i), {blob("/a", "pixels")});
        versions.push_back(version);
    }
    const std::int64_t most = records_->owner("kaja")->max_bytes;
    records_->set_limits("kaja", 10, 30);
    EXPECT_EQ(records_->restore(document, versions).result, WriteResult::too_large);
    EXPECT_FALSE(records_->document("kaja", "bolete"));
    EXPECT_EQ(used("kaja"), 0);
    records_->set_limits("kaja", 10, most);
    EXPECT_EQ(records_->restore(document, versions).result, WriteResult::done);
    EXPECT_EQ(records_->document("kaja", "bolete")->newest, 3);
    EXPECT_EQ(records_->version("kaja", "bolete", 2)->content.text, "version 2");
    EXPECT_EQ(records_->version("kaja", "bolete", 2)->made, 102);
    EXPECT_EQ(used("kaja"), counted("kaja"));
    EXPECT_EQ(records_->changes(0).size(), 1U);
    EXPECT_EQ(records_->restore(document, versions).result, WriteResult::taken);
}

TEST_P(RecordsContract, TheBytesOfAnOwnerAreThoseOfTheDocuments) {
    std::mt19937 random(7);
    const auto below = [&](int end) {
        return static_cast<int>(random() % static_cast<unsigned>(end));
    };
    for (int step = 0; step < 300; ++step) {
        const std::string owner = below(2) == 0 ? "kaja" : "sami";
        const std::string name = std::string("document") + static_cast<char>('a' + below(6));
        std::vector<Blob> blobs;
        for (int i = below(4); i > 0; --i)
            blobs.push_back(blob("/" + std::to_string(i), "pixels" + std::to_string(below(5))));
        const Content written = content(
            std::string(static_cast<std::size_t>(below(200)), 'x') + std::to_string(step), blobs);
        switch (below(8)) {
            case 0:
            case 1:
                records_->create(owner, name, written, "", "", step);
                break;
            case 2:
            case 3:
            case 4:
                records_->replace(owner, name, std::nullopt, written, step);
                break;
            case 5:
            case 6:
                records_->publish(owner, name, std::nullopt, {}, step);
                break;
            default:
                if (below(6) == 0) records_->withdraw(owner, name, std::nullopt, true, step);
        }
    }
    for (const char* const owner : {"kaja", "sami"}) {
        EXPECT_GT(used(owner), 0);
        EXPECT_EQ(used(owner), counted(owner)) << owner;
    }
}

TEST_P(RecordsContract, FiftyWritersNeverPassAQuota) {
    records_->set_limits("kaja", 7, 1000);
    std::atomic<int> done{0}, refused{0};
    {
        std::vector<std::jthread> writers;
        for (int i = 0; i < 50; ++i)
            writers.emplace_back([&, i] {
                const Written written =
                    records_->create("kaja", "document" + std::to_string(i),
                                     content(std::string(100, 'x') + std::to_string(i)), "", "", 1);
                ++(written.result == WriteResult::done ? done : refused);
            });
    }
    EXPECT_EQ(done, 7);
    EXPECT_EQ(refused, 43);
    EXPECT_LE(used("kaja"), 1000);
    records_->set_limits("kaja", 100, 1000);
    std::atomic<int> large{0};
    {
        std::vector<std::jthread> writers;
        for (int i = 0; i < 50; ++i)
            writers.emplace_back([&, i] {
                if (records_
                        ->create("kaja", "later" + std::to_string(i),
                                 content(std::string(100, 'y') + std::to_string(i)), "", "", 1)
                        .result == WriteResult::too_large)
                    ++large;
            });
    }
    EXPECT_GT(large, 0);
    EXPECT_LE(used("kaja"), 1000);
    EXPECT_EQ(used("kaja"), counted("kaja"));
}

TEST_P(RecordsContract, WhatIsAcknowledgedSurvivesTheEndOfTheProcess) {
    std::set<int> acknowledged;
    std::mt19937 random(3);
    for (int round = 0; round < 40; ++round) {
        std::array<int, 2> channel{};
        ASSERT_EQ(pipe(channel.data()), 0);
        const pid_t child = fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            close(channel[0]);
            const std::unique_ptr<Records> records = backend_->open();
            for (int i = 0;; ++i) {
                const int number = round * 100000 + i;
                const Content written = content(std::string(3000, 'z') + std::to_string(number));
                const bool is_done =
                    i % 3 == 0 ? records->create("kaja", "document" + std::to_string(number),
                                                 written, "", "", number)
                                         .result == WriteResult::done
                               : false;
                if (is_done && ::write(channel[1], &number, sizeof number) != sizeof number)
                    _exit(1);
                if (i > 150) _exit(0);
            }
        }
        close(channel[1]);
        int number = 0;
        if (::read(channel[0], &number, sizeof number) == sizeof number)
            acknowledged.insert(number);
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 20'000));
        kill(child, SIGKILL);
        while (::read(channel[0], &number, sizeof number) == sizeof number)
            acknowledged.insert(number);
        close(channel[0]);
        int status = 0;
        waitpid(child, &status, 0);
        records_->set_limits("kaja", 100000, std::int64_t{1} << 40U);
    }
    records_ = backend_->open();
    for (const int number : acknowledged) {
        const std::optional<Version> found =
            records_->version("kaja", "document" + std::to_string(number), 0);
        ASSERT_TRUE(found) << number;
        EXPECT_EQ(found->content.hash, sha256_of(found->content.text));
    }
    EXPECT_GE(acknowledged.size(), 40U);
    EXPECT_EQ(used("kaja"), counted("kaja"));
}

INSTANTIATE_TEST_SUITE_P(All, RecordsContract, testing::ValuesIn(backends), name_of_backend);

}  // namespace
}  // namespace sporeprint::server::records_test
