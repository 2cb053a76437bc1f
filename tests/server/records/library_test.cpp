// The library of users' species through the service, on a database.
#include "api/library/library.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>

#include "api/http/response_builder.h"
#include "api/library/tokens.h"
#include "api/routes.h"
#include "api/service.h"
#include "core/atlas/atlas.h"
#include "core/params/reader.h"
#include "server/records/administration.h"
#include "tests/server/records/backends.h"

namespace sporeprint::server::records_library_test {
namespace {

using namespace api;

class LibraryRoutes : public testing::TestWithParam<test::NamedBackend> {
  protected:
    void SetUp() override {
        ASSERT_TRUE(GetParam().is_installed()) << "server/install test installs it";
        backend_ = GetParam().make();
        open();
        for (const char* const owner : {"kaja", "sami"}) {
            ASSERT_TRUE(library_->records().add_owner(owner, now_));
            for (const Scope scope : {Scope::read, Scope::write, Scope::admin})
                tokens_[std::string(owner) + ' ' + api::name(scope)] = token(owner, scope);
        }
    }

    void open() {
        service_.reset();
        library_ = std::make_shared<Library>(backend_->open(), [this] { return now_; });
        service_.emplace(built_in_atlas(), ServiceOptions{}, library_);
    }

    /// Adds a token of an owner and returns its text.
    std::string token(const std::string& owner, Scope scope,
                      std::optional<Seconds> expires = std::nullopt) {
        const Secret secret = new_secret(token_prefix);
        Token token;
        token.id = secret.id;
        token.owner = owner;
        token.secret = secret.digest;
        token.scope = scope;
        token.created = now_;
        token.expires = expires;
        EXPECT_EQ(library_->records().add_token(token), WriteResult::done);
        return secret.text;
    }

    Response ask(const std::string& method, const std::string& target,
                 const std::string& token = "", const std::string& body = "",
                 const std::string& if_match = "") {
        Request request{method, target, {}, body, "test-1"};
        if (!token.empty()) request.headers.emplace_back("Authorization", "Bearer " + token);
        if (method == "POST" || method == "PUT")
            request.headers.emplace_back("Content-Type", "application/json");
        if (!if_match.empty()) request.headers.emplace_back("If-Match", if_match);
        return handle(*service_, request);
    }
    Response as_kaja(const std::string& method, const std::string& target,
                     const std::string& body = "", const std::string& if_match = "") {
        return ask(method, target, tokens_.at("kaja write"), body, if_match);
    }

    static std::string text_of(const Response& response) {
        std::string text;
        for (const Slice& slice : response.body)
            text.append(reinterpret_cast<const char*>(slice.data()), slice.size);
        return text;
    }
    static Value json_of(const Response& response) {
        std::vector<Problem> problems;
        Value value = parse(text_of(response), problems);
        EXPECT_TRUE(problems.empty()) << text_of(response);
        return value;
    }
    static std::string detail_of(const Response& response) {
        const Value body = json_of(response);
        const Value* const detail = body.find("detail");
        return detail ? detail->as_string() : std::string();
    }

    /// Returns the JSON of a built-in species under another name.
    static std::string species_json(const std::string& name,
                                    const std::string& like = "boletus_edulis",
                                    const std::string& title = "") {
        Value json = write(built_in_atlas()->find(like)->species);
        json.set("id", name);
        if (!title.empty()) json.find("facts")->set("common_name", title);
        return dump(json);
    }

    /// Creates and publishes a species of kaja.
    void publish(const std::string& name, const std::string& like = "boletus_edulis") {
        ASSERT_EQ(as_kaja("POST", "/v1/library", species_json(name, like)).status, 201);
        ASSERT_EQ(as_kaja("POST", "/v1/library/~kaja." + name + "/publish", "{}", "*").status, 201);
    }

    Seconds now_ = 1'800'000'000;
    std::unique_ptr<test::Backend> backend_;
    std::shared_ptr<Library> library_;
    std::optional<Service> service_;
    std::map<std::string, std::string> tokens_;
};

TEST_P(LibraryRoutes, ADraftBecomesAVersionThatGrows) {
    const Response created = as_kaja("POST", "/v1/library", species_json("red_bolete"));
    ASSERT_EQ(created.status, 201) << text_of(created);
    EXPECT_EQ(header_of(created, "Location"), "/v1/library/~kaja.red_bolete");
    const std::string etag(header_of(created, "ETag"));
    EXPECT_EQ(json_of(created).find("draft")->as_string(), etag);

    const Response draft = as_kaja("GET", "/v1/library/~kaja.red_bolete");
    EXPECT_EQ(draft.status, 200);
    EXPECT_EQ(text_of(draft), species_json("red_bolete")) << "the bytes that were sent";
    EXPECT_EQ(header_of(draft, "ETag"), etag);
    EXPECT_EQ(header_of(draft, "Cache-Control"), "private, no-store");

    const Response published =
        as_kaja("POST", "/v1/library/~kaja.red_bolete/publish", R"({"note":"first"})", etag);
    ASSERT_EQ(published.status, 201) << text_of(published);
    EXPECT_EQ(header_of(published, "Location"), "/v1/library/~kaja.red_bolete@1");
    EXPECT_EQ(json_of(published).find("links")->find("model")->as_string(),
              "/v1/mushrooms/~kaja.red_bolete@1.glb");

    const Response glb = ask("GET", "/v1/mushrooms/~kaja.red_bolete@1.glb?lod=3&textures=none");
    ASSERT_EQ(glb.status, 200) << text_of(glb);
    const Response built_in = ask("GET", "/v1/mushrooms/boletus_edulis.glb?lod=3&textures=none");
    EXPECT_NE(header_of(glb, "ETag"), header_of(built_in, "ETag"));
    EXPECT_TRUE(std::string(header_of(glb, "Content-Location"))
                    .starts_with("/v1/mushrooms/~kaja.red_bolete@1.glb"));
    EXPECT_FALSE(glb.cacheable) << "its owner may withdraw it";
}

TEST_P(LibraryRoutes, WhoPaysIsKnownForAMinuteAfterATokenWasLetIn) {
    const auto owner_of = [&](const std::string& token) {
        Request request{"GET", "/v1/species", {{"Authorization", "Bearer " + token}}, {}, "test-1"};
        return service_->owner_of(request);
    };
    const std::string token = tokens_.at("kaja read");
    EXPECT_EQ(owner_of(token), "") << "nobody has looked";
    ASSERT_EQ(ask("GET", "/v1/library/quota", token).status, 200);
    EXPECT_EQ(owner_of(token), "kaja");
    EXPECT_EQ(owner_of(tokens_.at("sami read")), "");
    std::string wrong = token;
    wrong.back() = wrong.back() == 'A' ? 'B' : 'A';
    EXPECT_EQ(ask("GET", "/v1/library/quota", wrong).status, 401);
    EXPECT_EQ(owner_of(wrong), "");
    EXPECT_EQ(owner_of("spk_"), "");
    now_ += 60;
    EXPECT_EQ(owner_of(token), "kaja");
    now_ += 1;
    EXPECT_EQ(owner_of(token), "");
}

TEST_P(LibraryRoutes, WithoutANumberTheNewestVersionIsMeant) {
    publish("red_bolete");
    const std::string open = "/v1/mushrooms/~kaja.red_bolete.json?age=0.5";
    const Response first = ask("GET", open);
    ASSERT_EQ(first.status, 200) << text_of(first);
    EXPECT_EQ(header_of(first, "Cache-Control"), "no-cache");
    EXPECT_NE(header_of(first, "Content-Location").find("@1"), std::string_view::npos);
    EXPECT_EQ(header_of(ask("GET", open), "Cache-Control"), "no-cache") << "from the cache too";

    const std::string etag(header_of(as_kaja("GET", "/v1/library/~kaja.red_bolete"), "ETag"));
    ASSERT_EQ(as_kaja("PUT", "/v1/library/~kaja.red_bolete",
                      species_json("red_bolete", "amanita_muscaria"), etag)
                  .status,
              200);
    ASSERT_EQ(as_kaja("POST", "/v1/library/~kaja.red_bolete/publish", "{}", "*").status, 201);
    const Response second = ask("GET", open);
    EXPECT_NE(header_of(second, "Content-Location").find("@2"), std::string_view::npos);
    EXPECT_NE(header_of(second, "ETag"), header_of(first, "ETag"));
    const Response old = ask("GET", "/v1/mushrooms/~kaja.red_bolete@1.json?age=0.5");
    EXPECT_EQ(header_of(old, "ETag"), header_of(first, "ETag"));
    EXPECT_EQ(ask("GET", "/v1/mushrooms/~kaja.red_bolete@3.json").status, 404);
}

TEST_P(LibraryRoutes, PublishedSpeciesMixMorphAndFormColonies) {
    publish("red_bolete");
    for (const char* const target :
         {"/v1/mushrooms/~kaja.red_bolete@1:0.5,amanita_muscaria:0.5.glb?lod=3&textures=none",
          "/v1/mushrooms/amanita_muscaria:1,~kaja.red_bolete:2.json",
          "/v1/morphs/~kaja.red_bolete@1/amanita_muscaria",
          "/v1/morphs/amanita_muscaria/~kaja.red_bolete",
          "/v1/colonies/~kaja.red_bolete@1.json?count=3",
          "/v1/offspring/~kaja.red_bolete/amanita_muscaria.json?seed=3",
          "/v1/offspring/amanita_muscaria/~kaja.red_bolete@1.glb?seed=3&lod=3&textures=none",
          "/v1/mushrooms/~kaja.red_bolete@1/base_color.jpg?texture_size=128"}) {
        const Response response = ask("GET", target);
        EXPECT_EQ(response.status, 200) << target << ": " << text_of(response);
    }
    const Response posted = ask("POST", "/v1/mushrooms.glb", "",
                                R"({"mix":{"~kaja.red_bolete@1":1,"boletus_edulis":1},"lod":3,)"
                                R"("textures":"none"})");
    EXPECT_EQ(posted.status, 200) << text_of(posted);
    // Both names of one version are the same species.
    EXPECT_EQ(ask("GET", "/v1/mushrooms/~kaja.red_bolete@1:1,~kaja.red_bolete:1.json").status, 400);
}

TEST_P(LibraryRoutes, PublishedSpeciesLendWhatAPhotographDoesNotShow) {
    publish("red_bolete");
    const std::string portrait =
        "/v1/mushrooms/~kaja.red_bolete.png?view=front&width=256&height=256&background=transparent";
    Request upload{"POST", "/v1/photos", {{"Content-Type", "image/png"}}, "", "test-1"};
    upload.body = text_of(ask("GET", portrait));
    const std::string photo = json_of(handle(*service_, upload)).find("photo")->as_string();
    const auto traced = [&](const std::string& lender) {
        return ask(
            "POST", "/v1/traces", "",
            R"({"views":{"side":{"photo":")" + photo + R"("}},"template":")" + lender + "\"}");
    };
    const Response found = traced("~kaja.red_bolete");
    ASSERT_EQ(found.status, 200) << text_of(found);
    EXPECT_EQ(json_of(found).find("template")->as_string(), "~kaja.red_bolete@1");
    EXPECT_EQ(traced("~kaja.no_such").status, 404);
    EXPECT_EQ(traced("~kaja.Red").status, 404);
}

TEST_P(LibraryRoutes, AVersionHasItsBytesAfterARestart) {
    publish("red_bolete");
    const std::string target = "/v1/mushrooms/~kaja.red_bolete@1.glb?lod=2&textures=none";
    const std::string before = text_of(ask("GET", target));
    const std::string etag(header_of(ask("GET", "/v1/library/~kaja.red_bolete@1"), "ETag"));
    open();
    EXPECT_EQ(text_of(ask("GET", target)), before);
    const Response version = ask("GET", "/v1/library/~kaja.red_bolete@1");
    EXPECT_EQ(header_of(version, "ETag"), etag);
    Request conditional{
        "GET", "/v1/library/~kaja.red_bolete@1", {{"If-None-Match", etag}}, "", "t"};
    EXPECT_EQ(handle(*service_, conditional).status, 304);
}

TEST_P(LibraryRoutes, WhatIsUnknownIsNamed) {
    publish("red_bolete");
    EXPECT_NE(detail_of(ask("GET", "/v1/mushrooms/~kaja.nothing.glb")).find("'~kaja.nothing'"),
              std::string::npos);
    EXPECT_NE(detail_of(ask("GET", "/v1/mushrooms/~kaja.red_bolete@9.glb")).find("the newest is 1"),
              std::string::npos);
    EXPECT_NE(detail_of(ask("GET", "/v1/mushrooms/~Kaja.glb")).find("~owner.name@3"),
              std::string::npos);
    Service without(built_in_atlas(), ServiceOptions{});
    for (const char* const target : {"/v1/mushrooms/~kaja.red_bolete@1.glb", "/v1/library",
                                     "/v1/library/~kaja.red_bolete", "/v1/tokens"}) {
        const Response response = handle(without, {"GET", target, {}, "", "t"});
        EXPECT_EQ(response.status, 404) << target;
        EXPECT_NE(text_of(response).find("has no library"), std::string::npos) << target;
    }
}

TEST_P(LibraryRoutes, ADraftIsChangedOnlyAfterItWasRead) {
    const std::string path = "/v1/library/~kaja.red_bolete";
    as_kaja("POST", "/v1/library", species_json("red_bolete"));
    const std::string seen(header_of(as_kaja("GET", path), "ETag"));
    EXPECT_EQ(as_kaja("PUT", path, species_json("red_bolete")).status, 428);
    const std::string one = species_json("red_bolete", "boletus_edulis", "One");
    EXPECT_EQ(as_kaja("PUT", path, one, seen).status, 200);
    const Response late =
        as_kaja("PUT", path, species_json("red_bolete", "boletus_edulis", "Two"), seen);
    EXPECT_EQ(late.status, 412);
    const Value body = json_of(late);
    EXPECT_EQ(body.find("current")->as_string(), header_of(as_kaja("GET", path), "ETag"));
    ASSERT_EQ(body.find("changed")->items().size(), 1U);
    EXPECT_EQ(body.find("changed")->items()[0].as_string(), "/facts/common_name");
    EXPECT_EQ(text_of(as_kaja("GET", path)), one);
    EXPECT_EQ(as_kaja("PUT", path, species_json("red_bolete"), "\"0000\"").status, 412);
    // A client that accepts gzip has seen the entity tag of that variant.
    std::string gzipped(header_of(as_kaja("GET", path), "ETag"));
    gzipped.insert(gzipped.size() - 1, "-gz");
    EXPECT_EQ(as_kaja("PUT", path, species_json("red_bolete"), gzipped).status, 200);
    EXPECT_EQ(as_kaja("PUT", path, species_json("other_name"), "*").status, 400) << "another id";
}

TEST_P(LibraryRoutes, WithdrawnSpeciesAreUnlistedOrGone) {
    publish("red_bolete");
    publish("pale_bolete");
    const std::string path = "/v1/library/~kaja.red_bolete";
    EXPECT_EQ(as_kaja("DELETE", path).status, 428);
    EXPECT_EQ(as_kaja("DELETE", path, "", "*").status, 204);
    EXPECT_EQ(json_of(ask("GET", "/v1/library")).find("species")->items().size(), 1U);
    EXPECT_EQ(ask("GET", path + "@1").status, 200) << "published addresses go on";
    EXPECT_EQ(ask("GET", "/v1/mushrooms/~kaja.red_bolete@1.json").status, 200);

    EXPECT_EQ(as_kaja("DELETE", path + "?purge=true", "", "*").status, 204);
    for (const std::string& target :
         {path, path + "@1", std::string("/v1/mushrooms/~kaja.red_bolete@1.json"),
          std::string("/v1/mushrooms/~kaja.red_bolete.glb?lod=3")}) {
        const Response gone = ask("GET", target);
        EXPECT_EQ(gone.status, 410) << target;
        EXPECT_EQ(json_of(gone).find("type")->as_string(), "/problems/withdrawn");
    }
    EXPECT_EQ(as_kaja("POST", "/v1/library", species_json("red_bolete")).status, 409)
        << "the name is never given again";
    EXPECT_EQ(as_kaja("PUT", path, species_json("red_bolete"), "*").status, 410);
}

TEST_P(LibraryRoutes, OfWhatWasNeverPublishedNobodyElseKnows) {
    const std::string path = "/v1/library/~kaja.secret";
    as_kaja("POST", "/v1/library", species_json("secret"));
    EXPECT_EQ(as_kaja("DELETE", path, "", "*").status, 204);
    for (const char* const target : {"/v1/mushrooms/~kaja.secret.glb", "/v1/library/~kaja.secret",
                                     "/v1/library/~kaja.secret@1"})
        EXPECT_EQ(ask("GET", target).status, 404) << target;
    EXPECT_EQ(as_kaja("DELETE", path + "?purge=true", "", "*").status, 204);
    EXPECT_EQ(ask("GET", path).status, 404);
    EXPECT_EQ(ask("GET", "/v1/mushrooms/~kaja.secret.glb").status, 404);
    EXPECT_EQ(as_kaja("GET", path).status, 410) << "its owner is told";
    EXPECT_EQ(as_kaja("PUT", path, species_json("secret"), "\"stale\"").status, 410);
    EXPECT_EQ(as_kaja("POST", path + "/publish", "{}", "*").status, 410);
    open();
    EXPECT_EQ(ask("GET", "/v1/mushrooms/~kaja.secret.glb").status, 404);
}

TEST_P(LibraryRoutes, ImagesThatAreNoneAreNotPublished) {
    Value json = write(built_in_atlas()->find("boletus_edulis")->species);
    json.set("id", "no_image");
    const std::string text = "this is no image";
    json.find("stages")->items()[1].find("model")->find("surface")->find("cap")->set(
        "image", base64_text({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}));
    ASSERT_EQ(as_kaja("POST", "/v1/library", dump(json)).status, 201);
    const Response refused = as_kaja("POST", "/v1/library/~kaja.no_image/publish", "{}", "*");
    EXPECT_EQ(refused.status, 422) << text_of(refused);
}

TEST_P(LibraryRoutes, AnotherProcessLearnsOfWhatIsPublished) {
    Library other(backend_->open(), [this] { return now_; });
    publish("red_bolete");
    EXPECT_EQ(other.find("~kaja.red_bolete").status, 404);
    EXPECT_TRUE(other.refresh());
    EXPECT_EQ(other.find("~kaja.red_bolete").name.number, 1);
    EXPECT_FALSE(other.refresh());
    as_kaja("DELETE", "/v1/library/~kaja.red_bolete?purge=true", "", "*");
    EXPECT_TRUE(other.refresh());
    EXPECT_EQ(other.find("~kaja.red_bolete@1").status, 410);
}

TEST_P(LibraryRoutes, WhatCannotBeGrownIsNotPublished) {
    Value json = write(built_in_atlas()->find("boletus_edulis")->species);
    json.set("id", "knot");
    // The cap of one stage crosses itself.
    for (Value& stage : json.find("stages")->items()) {
        Value::Array& cap = stage.find("model")->find("silhouette")->find("cap")->items();
        ASSERT_GT(cap.size(), 3U);
        std::swap(cap[1], cap[cap.size() - 2]);
    }
    ASSERT_EQ(as_kaja("POST", "/v1/library", dump(json)).status, 201)
        << "a draft may be unfinished";
    const Response refused = as_kaja("POST", "/v1/library/~kaja.knot/publish", "{}", "*");
    EXPECT_EQ(refused.status, 422) << text_of(refused);
    EXPECT_EQ(library_->find("~kaja.knot").status, 404);
}

TEST_P(LibraryRoutes, ForksHaveTheirParent) {
    publish("red_bolete");
    const std::string sami = tokens_.at("sami write");
    const Response forked =
        ask("POST", "/v1/library/~kaja.red_bolete/fork", sami, R"({"name":"mine"})");
    ASSERT_EQ(forked.status, 201) << text_of(forked);
    EXPECT_EQ(json_of(forked).find("parent")->as_string(), "~kaja.red_bolete@1");
    EXPECT_EQ(text_of(ask("GET", "/v1/library/~sami.mine", sami)), species_json("mine"));
    EXPECT_EQ(ask("POST", "/v1/library/~kaja.red_bolete/fork", sami, R"({"name":"mine"})").status,
              409);
    EXPECT_EQ(ask("POST", "/v1/library/~kaja.red_bolete/fork", sami, R"({"name":"Mine"})").status,
              400);
    ask("POST", "/v1/library/~sami.mine/publish", sami, "{}", "*");
    const Value children = json_of(ask("GET", "/v1/library?parent=~kaja.red_bolete"));
    ASSERT_EQ(children.find("species")->items().size(), 1U);
    EXPECT_EQ(children.find("species")->items()[0].find("id")->as_string(), "~sami.mine");
    as_kaja("POST", "/v1/library", species_json("secret"));
    EXPECT_EQ(ask("POST", "/v1/library/~kaja.secret/fork", sami, R"({"name":"stolen"})").status,
              404);
}

TEST_P(LibraryRoutes, ListsArePagedAndFiltered) {
    for (const char* const name : {"alpha", "beta", "gamma"}) publish(name);
    as_kaja("POST", "/v1/library", species_json("draft_only"));
    const auto ids = [&](const std::string& query, const std::string& token = "") {
        const Value list = json_of(ask("GET", "/v1/library" + query, token));
        std::vector<std::string> names;
        for (const Value& one : list.find("species")->items())
            names.push_back(one.find("name")->as_string());
        return names;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(ids(""), (Names{"alpha", "beta", "gamma"}));
    EXPECT_EQ(ids("?limit=2"), (Names{"alpha", "beta"}));
    EXPECT_EQ(json_of(ask("GET", "/v1/library?limit=2")).find("next")->as_string(), "~kaja.beta");
    EXPECT_EQ(ids("?limit=2&after=~kaja.beta"), Names{"gamma"});
    EXPECT_TRUE(json_of(ask("GET", "/v1/library?after=~kaja.beta")).find("next")->is_null());
    EXPECT_EQ(ids("?mine=true", tokens_.at("kaja read")),
              (Names{"alpha", "beta", "draft_only", "gamma"}));
    EXPECT_EQ(ids("?mine=true", tokens_.at("sami read")), Names{});
    EXPECT_EQ(ids("?owner=sami"), Names{});
    EXPECT_EQ(ids("?q=BET"), Names{"beta"});
    EXPECT_EQ(ids("?form=bolete"), (Names{"alpha", "beta", "gamma"}));
    EXPECT_EQ(ids("?form=club"), Names{});
    EXPECT_EQ(ask("GET", "/v1/library?mine=true").status, 401);
    EXPECT_EQ(ask("GET", "/v1/library?limit=101").status, 400);
    EXPECT_EQ(ask("GET", "/v1/library?after=beta").status, 400);
    EXPECT_EQ(ask("GET", "/v1/library?mne=true").status, 400);
}

TEST_P(LibraryRoutes, AnExportIsImportedByteForByte) {
    publish("red_bolete");
    as_kaja("PUT", "/v1/library/~kaja.red_bolete",
            species_json("red_bolete", "amanita_muscaria", "Second"), "*");
    as_kaja("POST", "/v1/library/~kaja.red_bolete/publish", R"({"note":"second"})", "*");
    as_kaja("PUT", "/v1/library/~kaja.red_bolete",
            species_json("red_bolete", "boletus_edulis", "Draft"), "*");
    const Response exported = as_kaja("GET", "/v1/library/~kaja.red_bolete/export.json");
    ASSERT_EQ(exported.status, 200);
    const std::string file = text_of(exported), sami = tokens_.at("sami write");
    const Response tried = ask("POST", "/v1/library/import?dry_run=true", sami, file);
    EXPECT_EQ(tried.status, 200) << text_of(tried);
    EXPECT_FALSE(json_of(tried).find("written")->as_bool());
    EXPECT_EQ(library_->find("~sami.red_bolete").status, 404);
    const Response imported = ask("POST", "/v1/library/import", sami, file);
    ASSERT_EQ(imported.status, 201) << text_of(imported);
    EXPECT_EQ(json_of(imported).find("newest")->as_number(), 2);
    for (const char* const version : {"@1", "@2"}) {
        const Response one = ask("GET", std::string("/v1/library/~kaja.red_bolete") + version);
        const Response other = ask("GET", std::string("/v1/library/~sami.red_bolete") + version);
        EXPECT_EQ(text_of(one), text_of(other));
        EXPECT_EQ(header_of(one, "ETag"), header_of(other, "ETag"));
    }
    EXPECT_EQ(ask("GET", "/v1/mushrooms/~sami.red_bolete@2.json").status, 200);
    EXPECT_EQ(ask("POST", "/v1/library/import", sami, file).status, 409);
}

TEST_P(LibraryRoutes, ADamagedExportIsNamedAndNothingIsWritten) {
    publish("red_bolete");
    const Value good = json_of(as_kaja("GET", "/v1/library/~kaja.red_bolete/export.json"));
    const auto refused = [&](const char* parameter, auto change) {
        Value damaged = good;
        change(damaged);
        const Response response =
            ask("POST", "/v1/library/import", tokens_.at("sami write"), dump(damaged));
        EXPECT_EQ(response.status, 400) << parameter;
        EXPECT_NE(text_of(response).find(parameter), std::string::npos) << text_of(response);
        EXPECT_FALSE(library_->records().document("sami", "red_bolete"));
    };
    refused("\"/format\"", [](Value& v) { v.set("format", 2); });
    refused("\"/name\"", [](Value& v) { v.set("name", "Red"); });
    refused("\"/state\"", [](Value& v) { v.set("state", "purged"); });
    refused("\"/parent\"", [](Value& v) { v.set("parent", "~x"); });
    refused("\"/versions\"", [](Value& v) { v.erase("versions"); });
    refused("\"/versions/1/number\"",
            [](Value& v) { v.find("versions")->items()[1].set("number", 5); });
    refused("\"/versions/1/sha256\"",
            [](Value& v) { v.find("versions")->items()[1].set("sha256", std::string(64, '0')); });
    refused("\"/versions/0/text\"", [](Value& v) {
        Value& version = v.find("versions")->items()[0];
        version.set("text", "{}").set("sha256", hex_of(sha256_of("{}")));
    });
    refused("\"/versions/0/note\"",
            [](Value& v) { v.find("versions")->items()[0].set("note", std::string(201, 'n')); });
    const std::string none = hex_of(sha256_of(""));
    refused("\"/versions/0/images\"", [&](Value& v) {  // an image that the text does not name
        v.find("images")->push(
            Value::object().set("media", "image/png").set("sha256", none).set("base64", ""));
        v.find("versions")
            ->items()[0]
            .find("images")
            ->push(Value::object().set("place", "/nowhere").set("sha256", none));
    });
    refused("\"/versions/0/images/0/sha256\"", [&](Value& v) {
        v.find("versions")
            ->items()[0]
            .find("images")
            ->push(Value::object().set("place", "/nowhere").set("sha256", none));
    });
    refused("\"/versions/0/text\"", [](Value& v) {  // white space: another text of the same species
        Value& version = v.find("versions")->items()[0];
        const std::string text = version.find("text")->as_string() + ' ';
        version.set("text", text).set("sha256", hex_of(sha256_of(text)));
    });
}

TEST_P(LibraryRoutes, SharesShowADraftUntilTheyEnd) {
    as_kaja("POST", "/v1/library", species_json("red_bolete"));
    const std::string path = "/v1/library/~kaja.red_bolete";
    const Response made = as_kaja("POST", path + "/shares", R"({"expires_s":3600})");
    ASSERT_EQ(made.status, 201) << text_of(made);
    const Value share = json_of(made);
    const std::string address = share.find("address")->as_string();
    EXPECT_EQ(ask("GET", address).status, 200);
    EXPECT_EQ(ask("GET", path).status, 404);
    EXPECT_EQ(ask("GET", path + "?share=" + new_secret(share_prefix).text).status, 404);
    as_kaja("POST", "/v1/library", species_json("other"));
    EXPECT_EQ(
        ask("GET", "/v1/library/~kaja.other?share=" + share.find("share")->as_string()).status,
        404);
    EXPECT_EQ(as_kaja("GET", path + "/shares").status, 200);
    EXPECT_EQ(text_of(as_kaja("GET", path + "/shares")).find("sps_"), std::string::npos)
        << "the secret is shown once";
    now_ += 3601;
    EXPECT_EQ(ask("GET", address).status, 404);
    now_ -= 3601;
    EXPECT_EQ(ask("GET", address).status, 200);
    EXPECT_EQ(as_kaja("DELETE", path + "/shares/" + share.find("id")->as_string()).status, 204);
    EXPECT_EQ(ask("GET", address).status, 404);
    EXPECT_EQ(as_kaja("DELETE", path + "/shares/nothing1").status, 404);
    EXPECT_EQ(as_kaja("POST", path + "/shares", R"({"expires_s":31536001})").status, 400);
}

TEST_P(LibraryRoutes, BakedFilesAreTheBytesOfTheDay) {
    ASSERT_EQ(as_kaja("POST", "/v1/library", species_json("red_bolete")).status, 201);
    const std::string path = "/v1/library/~kaja.red_bolete";
    EXPECT_EQ(as_kaja("POST", path + "/publish", R"({"bake":[4]})", "*").status, 400);
    EXPECT_EQ(as_kaja("POST", path + "/publish", R"({"bake":[0,1,2,3,3]})", "*").status, 400);
    ASSERT_EQ(as_kaja("POST", path + "/publish", R"({"bake":[3,2,3]})", "*").status, 201);
    const Value list = json_of(ask("GET", path + "@1/baked.json"));
    ASSERT_EQ(list.find("files")->items().size(), 2U);
    for (const Value& file : list.find("files")->items()) {
        const std::string lod = number_text(file.find("lod")->as_number());
        const Response baked = ask("GET", file.find("url")->as_string());
        ASSERT_EQ(baked.status, 200) << text_of(baked);
        EXPECT_EQ(header_of(baked, "Content-Type"), "model/gltf-binary");
        EXPECT_EQ(header_of(baked, "ETag"), '"' + file.find("sha256")->as_string() + '"');
        EXPECT_EQ(hex_of(sha256_of(text_of(baked))), file.find("sha256")->as_string());
        EXPECT_EQ(text_of(baked),
                  text_of(ask("GET", "/v1/mushrooms/~kaja.red_bolete@1.glb?lod=" + lod)))
            << "as this generator makes it";
    }
    const std::string lod3 = path + "@1/baked/3.glb";
    Request again{"GET",
                  lod3,
                  {{"If-None-Match", std::string(header_of(ask("GET", lod3), "ETag"))}},
                  {},
                  "test-2"};
    EXPECT_EQ(handle(*service_, again).status, 304);
    Request part{"GET", lod3, {{"Range", "bytes=0-3"}}, {}, "test-3"};
    EXPECT_EQ(handle(*service_, part).status, 206);
    EXPECT_EQ(text_of(handle(*service_, part)), "glTF");
    // Without a number another version may be meant tomorrow.
    EXPECT_NE(header_of(ask("GET", lod3), "Cache-Control").find("public"), std::string::npos);
    EXPECT_EQ(header_of(ask("GET", lod3), "Content-Location"), "");
    for (const std::string file : {"/baked/3.glb", "/baked.json"}) {
        const Response newest = ask("GET", path + file);
        EXPECT_EQ(newest.status, 200);
        EXPECT_EQ(header_of(newest, "Cache-Control"), "no-cache");
        EXPECT_EQ(header_of(newest, "Content-Location"), path + "@1" + file);
    }
    EXPECT_EQ(ask("GET", path + "@1/baked/0.glb").status, 404);
    EXPECT_EQ(ask("GET", path + "@1/baked/-3.glb").status, 404);
    EXPECT_EQ(ask("GET", path + "@2/baked/3.glb").status, 404);
    EXPECT_EQ(ask("GET", path + "/baked/3.glb").status, 200) << "of the newest version";
    const double used = json_of(as_kaja("GET", "/v1/library/quota")).find("bytes")->as_number();
    EXPECT_GT(used, static_cast<double>(text_of(ask("GET", lod3)).size()));
    ASSERT_EQ(as_kaja("POST", path + "/publish", "{}", "*").status, 201);
    EXPECT_EQ(ask("GET", path + "/baked/3.glb").status, 404);
    EXPECT_EQ(ask("GET", lod3).status, 200);
    const Response exported = as_kaja("GET", path + "/export.json");
    EXPECT_EQ(ask("POST", "/v1/library/import", tokens_.at("sami write"), text_of(exported)).status,
              201)
        << "without what is baked";
    as_kaja("DELETE", path + "?purge=true", "", "*");
    EXPECT_EQ(ask("GET", lod3).status, 410);
    EXPECT_EQ(json_of(as_kaja("GET", "/v1/library/quota")).find("bytes")->as_number(), 0);
}

TEST_P(LibraryRoutes, DraftsGrowForThoseWhoMaySeeThem) {
    ASSERT_EQ(as_kaja("POST", "/v1/library", species_json("red_bolete")).status, 201);
    const std::string glb = "/v1/mushrooms/~kaja.red_bolete@draft.glb?lod=3&textures=none",
                      reads = tokens_.at("kaja read");
    EXPECT_EQ(ask("GET", glb).status, 401);
    EXPECT_EQ(ask("GET", glb, "spk_abc").status, 401);
    EXPECT_EQ(ask("GET", glb, tokens_.at("sami admin")).status, 404);
    EXPECT_EQ(ask("GET", "/v1/mushrooms/~kaja.nothing@draft.glb", reads).status, 404);
    const Response first = ask("GET", glb, reads);
    ASSERT_EQ(first.status, 200) << text_of(first);
    EXPECT_EQ(text_of(first).substr(0, 4), "glTF");
    EXPECT_EQ(header_of(first, "Cache-Control"), "private, no-store");
    EXPECT_EQ(header_of(first, "Content-Location"), "");
    EXPECT_FALSE(first.cacheable);
    EXPECT_EQ(text_of(ask("GET", glb, reads)), text_of(first));

    const Response share =
        as_kaja("POST", "/v1/library/~kaja.red_bolete/shares", "{\"expires_s\":60}");
    ASSERT_EQ(share.status, 201) << text_of(share);
    const std::string key = json_of(share).find("share")->as_string();
    EXPECT_EQ(text_of(ask("GET", glb, key)), text_of(first));
    ASSERT_EQ(as_kaja("POST", "/v1/library", species_json("other")).status, 201);
    EXPECT_EQ(ask("GET", "/v1/mushrooms/~kaja.other@draft.glb?lod=3", key).status, 404)
        << "the key of another species";
    now_ += 100;
    EXPECT_EQ(ask("GET", glb, key).status, 404) << "expired";

    as_kaja("PUT", "/v1/library/~kaja.red_bolete", species_json("red_bolete", "amanita_muscaria"),
            "*");
    const Response second = ask("GET", glb, reads);
    EXPECT_NE(text_of(second), text_of(first));
    EXPECT_NE(header_of(second, "ETag"), header_of(first, "ETag"));
    EXPECT_EQ(ask("GET", glb, reads, "", std::string(header_of(first, "ETag"))).status, 412);

    publish("published");
    for (const char* const path :
         {"/v1/mushrooms/~kaja.red_bolete@draft:2,amanita_muscaria:1.glb?lod=3&textures=none",
          "/v1/mushrooms/~kaja.red_bolete@draft:1,~kaja.published:2.glb?lod=3&textures=none",
          "/v1/mushrooms/~kaja.red_bolete@draft.png?width=64&height=64",
          "/v1/offspring/~kaja.red_bolete@draft/~kaja.published@1.json"}) {
        const Response grown = ask("GET", path, reads);
        EXPECT_EQ(grown.status, 200) << path << ": " << text_of(grown);
        EXPECT_EQ(header_of(grown, "Cache-Control"), "private, no-store") << path;
        EXPECT_EQ(ask("GET", path).status, 401) << path;
    }
    EXPECT_EQ(ask("GET", glb + "&age=7", reads).status, 400);
    const Response linked =
        ask("GET", "/v1/mushrooms/~kaja.red_bolete@draft.glb?lod=3&textures=linked", reads);
    EXPECT_EQ(linked.status, 422);
    EXPECT_EQ(
        as_kaja("POST", "/v1/library?parent=~kaja.red_bolete@draft", species_json("child")).status,
        404);
    EXPECT_EQ(as_kaja("GET", "/v1/library/~kaja.red_bolete@draft").status, 404);
}

TEST_P(LibraryRoutes, TokensAreMadeAndRevokedByTokens) {
    const std::string admin = tokens_.at("kaja admin");
    const Response made =
        ask("POST", "/v1/tokens", admin, R"({"label":"build","scope":"read","expires_s":3600})");
    ASSERT_EQ(made.status, 201) << text_of(made);
    const std::string text = json_of(made).find("token")->as_string();
    EXPECT_EQ(ask("GET", "/v1/library/quota", text).status, 200);
    EXPECT_EQ(json_of(ask("GET", "/v1/library/quota", text)).find("owner")->as_string(), "kaja");
    EXPECT_EQ(ask("POST", "/v1/tokens", admin, R"({"label":"\u202eevil","scope":"read"})").status,
              400);
    const Response listed = ask("GET", "/v1/tokens", admin);
    EXPECT_EQ(json_of(listed).find("tokens")->items().size(), 4U);
    EXPECT_EQ(text_of(listed).find(text), std::string::npos) << "secrets are shown once";
    now_ += 3601;
    EXPECT_EQ(ask("GET", "/v1/library/quota", text).status, 401);
    now_ -= 3601;
    EXPECT_EQ(ask("DELETE", "/v1/tokens/" + json_of(made).find("id")->as_string(), admin).status,
              204);
    EXPECT_EQ(ask("GET", "/v1/library/quota", text).status, 401);
    EXPECT_EQ(ask("DELETE", "/v1/tokens/" + json_of(made).find("id")->as_string(),
                  tokens_.at("sami admin"))
                  .status,
              404);
    EXPECT_EQ(ask("POST", "/v1/tokens", admin, R"({"scope":"root"})").status, 400);
}

TEST_P(LibraryRoutes, QuotasAreNamed) {
    library_->records().set_limits("kaja", 1, 1 << 20);
    ASSERT_EQ(as_kaja("POST", "/v1/library", species_json("one")).status, 201);
    const Response full = as_kaja("POST", "/v1/library", species_json("two"));
    EXPECT_EQ(full.status, 507);
    EXPECT_NE(detail_of(full).find("1 of 1 species"), std::string::npos) << detail_of(full);
    library_->records().set_limits("kaja", 10, 10);
    EXPECT_EQ(as_kaja("POST", "/v1/library", species_json("two")).status, 507);
    EXPECT_EQ(as_kaja("POST", "/v1/library/~kaja.one/publish", "{}", "*").status, 507);
    EXPECT_EQ(library_->find("~kaja.one").status, 404);
}

/// Fills the names of a pattern.
std::string path_of(std::string pattern) {
    for (const auto& [name, value] :
         {std::pair("{species}", "~kaja.red_bolete"), std::pair("{share}", "abcdefgh"),
          std::pair("{token}", "abcdefgh")})
        if (const std::size_t at = pattern.find(name); at != std::string::npos)
            pattern.replace(at, std::string_view(name).size(), value);
    return pattern;
}

TEST_P(LibraryRoutes, OfSeveralTokensNoneCounts) {
    Request request{"GET", "/v1/library/quota", {}, "", "test-1"};
    for (const char* const who : {"kaja read", "sami read"})
        request.headers.emplace_back("Authorization", "Bearer " + tokens_.at(who));
    const Response response = handle(*service_, request);
    EXPECT_EQ(response.status, 401);
    EXPECT_NE(detail_of(response).find("single 'Bearer'"), std::string::npos);
    request.headers.pop_back();
    EXPECT_EQ(handle(*service_, request).status, 200);
}

TEST_P(LibraryRoutes, EveryRouteAsksForItsToken) {
    publish("red_bolete");
    const std::string expired = token("kaja", Scope::admin, now_ - 1),
                      revoked = token("kaja", Scope::admin), disabled = token("sami", Scope::admin);
    library_->records().revoke_token("kaja", revoked.substr(4, 8), now_);
    std::string wrong = tokens_.at("kaja admin");
    wrong.back() = wrong.back() == 'A' ? 'B' : 'A';
    const std::vector<std::pair<const char*, std::string>> refused = {
        {"expired", expired},           {"revoked", revoked},
        {"wrong secret", wrong},        {"unknown", new_secret(token_prefix).text},
        {"of another form", "spk_abc"}, {"a key of a share", new_secret(share_prefix).text}};
    const std::map<std::string, Scope> needed = {
        {"create_library_species", Scope::write}, {"get_quota", Scope::read},
        {"import_library_species", Scope::write}, {"put_library_species", Scope::write},
        {"delete_library_species", Scope::write}, {"publish_library_species", Scope::write},
        {"fork_library_species", Scope::write},   {"list_shares", Scope::read},
        {"create_share", Scope::write},           {"delete_share", Scope::write},
        {"export_library_species", Scope::read},  {"list_tokens", Scope::admin},
        {"create_token", Scope::admin},           {"delete_token", Scope::admin}};
    std::size_t required = 0;
    for (const Route* const route : route_table().routes()) {
        if (route->kind != RouteKind::record) continue;
        const std::string path = path_of(route->pattern);
        for (const auto& [what, text] : refused) {
            const Response response = ask(route->method, path, text, "{}");
            EXPECT_EQ(response.status, 401) << route->id << ", " << what;
            EXPECT_FALSE(header_of(response, "WWW-Authenticate").empty());
        }
        if (route->access != Access::required) continue;
        ++required;
        EXPECT_EQ(ask(route->method, path, "", "{}").status, 401) << route->id;
        const Scope scope = needed.at(route->id);
        for (const Scope given : {Scope::read, Scope::write, Scope::admin}) {
            const Response response =
                ask(route->method, path, tokens_.at(std::string("kaja ") + name(given)), "{}");
            if (given < scope)
                EXPECT_EQ(response.status, 403) << route->id << ", " << name(given);
            else
                EXPECT_TRUE(response.status != 401 && response.status != 403)
                    << route->id << ", " << name(given) << ": " << response.status;
        }
        // What belongs to another is not there.
        const std::string_view id = route->id;
        if (path.find("~kaja") == std::string::npos || id == "fork_library_species") continue;
        const std::string body =
            id == "put_library_species" ? species_json("red_bolete") : std::string("{}");
        EXPECT_EQ(ask(route->method, path, tokens_.at("sami admin"), body, "*").status, 404) << id;
    }
    EXPECT_EQ(required, needed.size());
    library_->records().set_disabled("sami", true, now_);
    EXPECT_EQ(ask("GET", "/v1/library/quota", disabled).status, 401);
}

TEST_P(LibraryRoutes, HostileBodiesAndNamesAreRefused) {
    for (const char* const body :
         {"", "{", "[]", "null", "{\"id\":\"x\"}", "{\"id\":7}", "\"text\""})
        EXPECT_EQ(as_kaja("POST", "/v1/library", body).status, 400) << body;
    EXPECT_EQ(as_kaja("POST", "/v1/library", species_json("twenty_five_characters_xx")).status,
              400);
    EXPECT_EQ(as_kaja("POST", "/v1/library",
                      species_json("deceiver", "boletus_edulis",
                                   "a\xE2\x80\xAE"
                                   "b"))
                  .status,
              400);
    EXPECT_EQ(as_kaja("POST", "/v1/library?parent=nothing", species_json("orphan")).status, 404);
    for (const char* const path :
         {"/v1/library/kaja", "/v1/library/~", "/v1/library/~kaja.x@0", "/v1/library/%00",
          "/v1/library/~kaja.x%2Fy", "/v1/library/..%2F..", "/v1/library/~kaja.'--"}) {
        const int status = ask("GET", path).status;
        EXPECT_TRUE(status == 404 || status == 400) << path << ": " << status;
    }
    EXPECT_EQ(as_kaja("PUT", "/v1/library/~kaja.x@1", species_json("x"), "*").status, 404);
    for (const char* const body : {"{\"versions\":[{}]}", "{\"format\":1e300}", "{\"format\":-1}"})
        EXPECT_EQ(as_kaja("POST", "/v1/library/import", body).status, 400) << body;
}

TEST_P(LibraryRoutes, OperatorsAddAndLimitOwners) {
    const std::string database = backend_->library();
    const auto run = [&](LibraryCommand command) { return administer(command, database, now_); };
    LibraryCommand command;
    command.verb = "owner-add";
    command.owner = "anna";
    const std::string printed = run(command);
    const std::size_t at = printed.find("spk_");
    ASSERT_NE(at, std::string::npos);
    const std::string text = printed.substr(at, 56);
    EXPECT_EQ(ask("GET", "/v1/library/quota", text).status, 200);
    EXPECT_THROW(run(command), InvalidInput) << "twice";
    command.owner = "Anna";
    EXPECT_THROW(run(command), InvalidInput);
    command = {};
    command.verb = "owner-limit";
    command.owner = "anna";
    command.max_documents = 3;
    EXPECT_NE(run(command).find("0 of 3 documents"), std::string::npos);
    command.verb = "owner-disable";
    EXPECT_NE(run(command).find("disabled"), std::string::npos);
    EXPECT_EQ(ask("GET", "/v1/library/quota", text).status, 401);
    command.owner = "nobody";
    EXPECT_THROW(run(command), InvalidInput);
    command.verb = "owner-list";
    EXPECT_NE(run(command).find("kaja: 0 of 200 documents"), std::string::npos);
    EXPECT_FALSE(first_token(library_->records(), now_)) << "there are owners";
    // A mistyped path makes no empty library.
    const std::filesystem::path mistyped =
        std::filesystem::temp_directory_path() / "no_such_library.db";
    for (const char* const verb : {"owner-list", "copy", "token"}) {
        command.verb = verb;
        EXPECT_THROW(static_cast<void>(administer(command, mistyped.string(), now_)), InvalidInput);
    }
    EXPECT_FALSE(std::filesystem::exists(mistyped));
}

INSTANTIATE_TEST_SUITE_P(All, LibraryRoutes, testing::ValuesIn(test::backends),
                         test::name_of_backend);

}  // namespace
}  // namespace sporeprint::server::records_library_test
