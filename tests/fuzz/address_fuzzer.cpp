// Fuzzes URLs through Service::plan(): each gets a response or a job with a key; its canonical URL
// has the same key and is its own canonical form.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "api/http/response_builder.h"
#include "api/service.h"
#include "core/atlas/atlas.h"
#include "tests/fuzz/expect.h"

using namespace sporeprint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static api::Service service(built_in_atlas(), api::ServiceOptions{});
    const auto ask = [](std::string method, std::string target) {
        const api::Request request{std::move(method), std::move(target), {}, {}, "fuzz"};
        return service.plan(request, service.route(request));
    };
    const std::string target = '/' + std::string(reinterpret_cast<const char*>(data), size);
    const auto plan = ask("GET", target);
    if (const auto* response = std::get_if<api::Response>(&plan)) {
        expect(response->status >= 200 && response->status < 500, "no URL causes a server error");
        return 0;
    }
    const api::Key key = std::get<api::Job>(plan).key;
    expect(!key.empty(), "a job has a key");

    // HEAD gets a response without a job, with the canonical URL.
    const auto head = ask("HEAD", target);
    const auto* response = std::get_if<api::Response>(&head);
    if (response == nullptr) return 0;  // a document whose length is not yet known
    expect(response->status == 200, "HEAD of a resource that GET would generate");
    const std::string canonical(api::header_of(*response, "Content-Location"));
    if (canonical.empty()) return 0;
    const auto again = ask("GET", canonical);
    const auto* job = std::get_if<api::Job>(&again);
    expect(job != nullptr && job->key == key, "the canonical URL has the same key");
    const auto own = ask("HEAD", canonical);
    expect(api::header_of(std::get<api::Response>(own), "Content-Location") == canonical,
           "it is its own canonical form");
    expect(
        api::header_of(std::get<api::Response>(own), "ETag") == api::header_of(*response, "ETag"),
        "with the same ETag");
    return 0;
}
