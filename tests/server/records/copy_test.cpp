// A library moves from a file into PostgreSQL and back.
#include "server/records/copy.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "api/http/errors.h"
#include "api/library/tokens.h"
#include "core/problems.h"
#include "server/records/administration.h"
#include "tests/server/records/backends.h"

namespace sporeprint::server::records_copy_test {
namespace {

using namespace api;
using namespace test;

class Copies : public testing::TestWithParam<NamedBackend> {
  protected:
    void SetUp() override {
        ASSERT_TRUE(GetParam().is_installed()) << "server/install test installs it";
        backend_ = GetParam().make();
        other_ = backend_->open();
    }

    SqliteBackend file_;
    std::unique_ptr<Records> library_ = file_.open();
    std::unique_ptr<Backend> backend_;
    std::unique_ptr<Records> other_;
};

Token token(const std::string& id, std::optional<Seconds> expires = std::nullopt) {
    Token token;
    token.id = id;
    token.owner = "kaja";
    token.secret = sha256_of(id);
    token.scope = Scope::write;
    token.created = 3;
    token.expires = expires;
    return token;
}

TEST_P(Copies, EverythingThatIsStillGoodIsThere) {
    for (const char* const owner : {"kaja", "sami"}) library_->add_owner(owner, 1);
    library_->create("kaja", "bolete", content("draft"), "~sami.cap@2", "", 5);
    for (int i = 1; i <= most_versions; ++i) {
        const std::string text = "version \xC3\xA9 " + std::to_string(i);
        library_->replace("kaja", "bolete", std::nullopt,
                          content(text, {blob("/a", "pixels of " + text)}), i);
        Publication publication{"note"};
        if (i == 7) {
            publication.number = i;
            publication.files = {
                {"0.glb", "model/gltf-binary", sha256_of("glTF"), {'g', 'l', 'T', 'F'}}};
        }
        library_->publish("kaja", "bolete", std::nullopt, publication, i);
    }
    library_->create("kaja", "unlisted", content("unlisted"), "", "", 6);
    library_->publish("kaja", "unlisted", std::nullopt, {}, 7);
    library_->withdraw("kaja", "unlisted", std::nullopt, false, 8);
    library_->create("kaja", "gone", content("gone"), "", "", 6);
    library_->publish("kaja", "gone", std::nullopt, {}, 7);
    library_->withdraw("kaja", "gone", std::nullopt, true, 8);
    library_->create("sami", "draft", content("only a draft"), "", "", 9);
    for (const Token& one : {token("goodtokn"), token("expired1", 50), token("revoked1")})
        library_->add_token(one);
    library_->revoke_token("kaja", "revoked1", 9);
    for (const Share& share : {Share{"goodkey1", sha256_of("a"), 10, 1000, false},
                               Share{"expired1", sha256_of("b"), 10, 50, false},
                               Share{"revoked1", sha256_of("c"), 10, 1000, false}})
        library_->add_share("kaja", "bolete", share);
    library_->revoke_share("kaja", "bolete", "revoked1");
    library_->set_limits("kaja", 1, 10);  // less than there is
    library_->set_disabled("sami", true, 9);

    const Copied copied = copy_records(*library_, *other_, 100);
    EXPECT_EQ(copied.owners, 2);
    EXPECT_EQ(copied.documents, 4);
    EXPECT_EQ(copied.versions, most_versions + 1 + 2 + 1);
    for (const char* const name : {"kaja", "sami"}) {
        const Owner was = library_->owner(name).value(), is = other_->owner(name).value();
        EXPECT_EQ(is.documents, was.documents);
        EXPECT_EQ(is.used_bytes, was.used_bytes);
        EXPECT_EQ(is.max_documents, was.max_documents);
        EXPECT_EQ(is.max_bytes, was.max_bytes);
        EXPECT_EQ(is.is_disabled, was.is_disabled);
    }
    for (int i = 0; i <= most_versions; ++i) {
        const Version was = library_->version("kaja", "bolete", i).value(),
                      is = other_->version("kaja", "bolete", i).value();
        EXPECT_EQ(is.content.text, was.content.text);
        EXPECT_EQ(is.content.hash, was.content.hash);
        EXPECT_EQ(is.content.blobs.front().bytes, was.content.blobs.front().bytes);
        EXPECT_EQ(is.made, was.made);
        EXPECT_EQ(is.note, was.note);
    }
    EXPECT_EQ(other_->file("kaja", "bolete", 7, "0.glb")->sha256, sha256_of("glTF"));
    EXPECT_EQ(other_->document("kaja", "bolete")->parent, "~sami.cap@2");
    EXPECT_EQ(other_->document("kaja", "unlisted")->state, DocumentState::unlisted);
    EXPECT_EQ(other_->document("kaja", "gone")->state, DocumentState::purged);
    EXPECT_EQ(other_->create("kaja", "gone", content("new"), "", "", 200).result,
              WriteResult::taken);
    EXPECT_EQ(other_->changes(0).size(), 3U) << "what is published, unlisted and purged";
    EXPECT_TRUE(other_->token("goodtokn"));
    EXPECT_FALSE(other_->token("expired1"));
    EXPECT_FALSE(other_->token("revoked1"));
    EXPECT_EQ(other_->shares("kaja", "bolete").size(), 1U);

    EXPECT_THROW(copy_records(*library_, *other_, 100), InvalidInput) << "not empty any more";
    SqliteBackend back;
    const std::unique_ptr<Records> third = back.open();
    EXPECT_EQ(copy_records(*other_, *third, 100).versions, copied.versions);
    EXPECT_EQ(third->version("kaja", "bolete", 7)->content.hash,
              library_->version("kaja", "bolete", 7)->content.hash);
}

TEST_P(Copies, TheCommandCopiesToWhatItNames) {
    library_->add_owner("kaja", 1);
    library_->create("kaja", "bolete", content("draft"), "", "", 5);
    LibraryCommand command;
    command.verb = "copy";
    command.to = backend_->library();
    EXPECT_EQ(administer(command, file_.library(), 9),
              "Copied 1 owners, 1 documents and 1 versions, drafts included\n");
    EXPECT_EQ(other_->version("kaja", "bolete", 0)->content.text, "draft");
    command.to = "/no/such/folder/library.db";
    EXPECT_THROW(static_cast<void>(administer(command, file_.library(), 9)), Unavailable);
}

INSTANTIATE_TEST_SUITE_P(All, Copies, testing::ValuesIn(backends), name_of_backend);

}  // namespace
}  // namespace sporeprint::server::records_copy_test
