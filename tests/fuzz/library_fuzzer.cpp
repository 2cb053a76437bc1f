// Fuzzes a service with a library of users' species: bodies of imports, which are checked and not stored, and addresses
// below "~owner". Neither causes a server error.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "api/http/message.h"
#include "api/library/tokens.h"
#include "api/service.h"
#include "core/atlas/atlas.h"
#include "core/params/reader.h"
#include "server/records/open.h"
#include "tests/fuzz/expect.h"
#include "tests/server/records/contract.h"

using namespace sporeprint;

namespace {

/// A service whose library has two versions of one species, and a token of its owner.
struct Library {
    server::test::TemporaryFolder folder;
    std::shared_ptr<api::Library> records =
        std::make_shared<api::Library>(server::open_records((folder / "library.sqlite").string()),
                                       [] { return api::Seconds{1'800'000'000}; });
    api::Secret token = api::new_secret(api::token_prefix);
    api::Service service{built_in_atlas(), api::ServiceOptions{}, records};

    Library() {
        records->records().add_owner("kaja", 1);
        records->records().add_token(api::stored_token(token, "kaja", "", api::Scope::admin, 1));
        Value species = write(built_in_atlas()->find("boletus_edulis")->species);
        species.set("id", "cep");
        expect(ask("POST", "/v1/library", dump(species)).status == 201, "a species is stored");
        for (int version = 1; version <= 2; ++version)
            expect(ask("POST", "/v1/library/~kaja.cep/publish", "{}").status == 201,
                   "and published");
    }

    [[nodiscard]] api::Request request(std::string method, std::string target,
                                       std::string body) const {
        return {std::move(method),
                std::move(target),
                {{"Authorization", "Bearer " + token.text},
                 {"Content-Type", "application/json"},
                 {"If-Match", "*"}},
                std::move(body),
                "fuzz"};
    }
    api::Response ask(std::string method, std::string target, std::string body) {
        return api::handle(service, request(std::move(method), std::move(target), std::move(body)));
    }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static Library library;
    if (size == 0) return 0;
    const std::string text(reinterpret_cast<const char*>(data + 1), size - 1);
    switch (data[0] % 3) {
        case 0: {
            const api::Response checked =
                library.ask("POST", "/v1/library/import?dry_run=true", text);
            expect(checked.status >= 200 && checked.status < 500,
                   "no import causes a server error");
            break;
        }
        case 1: {
            const api::Response found = library.ask("GET", "/v1/library/~" + text, {});
            expect(found.status >= 200 && found.status < 500,
                   "no name in the library causes a server error");
            break;
        }
        default: {
            const api::Request request = library.request("GET", "/v1/mushrooms/~" + text, {});
            const api::Plan plan = library.service.plan(request, library.service.route(request));
            if (const auto* response = std::get_if<api::Response>(&plan))
                expect(response->status >= 200 && response->status < 500,
                       "no species in a path causes a server error");
            else
                expect(!std::get<api::Job>(plan).key.empty(), "a job has a key");
        }
    }
    return 0;
}
