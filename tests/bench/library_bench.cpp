// The library of users' species: how long a draft takes to be saved, and a token to be refused.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/library/tokens.h"
#include "api/service.h"
#include "core/atlas/atlas.h"
#include "core/params/reader.h"
#include "server/records/administration.h"
#include "tests/server/records/backends.h"

namespace {

using namespace sporeprint;
using namespace sporeprint::api;
using namespace sporeprint::server;

constexpr Seconds now = 1'800'000'000;

/// A service with a library of one owner and one draft, in a database of the kind that a benchmark names.
class LibraryService {
  public:
    explicit LibraryService(const benchmark::State& state)
        : backend_(test::backends[static_cast<std::size_t>(state.range(0))].make()),
          library_(std::make_shared<Library>(backend_->open(), [] { return now; })),
          service_(built_in_atlas(), ServiceOptions{}, library_),
          token_(first_token(library_->records(), now).value()) {
        species_ = sporeprint::write(built_in_atlas()->find("boletus_edulis")->species);
        species_.set("id", "red_bolete");
        send("POST", "/v1/library", token_, dump(species_));
    }

    Response send(const char* method, const std::string& target, const std::string& token,
                  const std::string& body = "") {
        Request request{method, target, {}, body, "bench-1"};
        if (!token.empty()) request.headers.emplace_back("Authorization", "Bearer " + token);
        request.headers.emplace_back("Content-Type", "application/json");
        request.headers.emplace_back("If-Match", "*");
        return handle(service_, request);
    }

    [[nodiscard]] const std::string& token() const { return token_; }
    [[nodiscard]] Records& records() const { return library_->records(); }

    /// Returns the JSON of the species with another title, so that it is another draft.
    std::string changed_species() {
        species_.find("facts")->set("common_name", "Bolete " + std::to_string(++changes_));
        return dump(species_);
    }

  private:
    std::unique_ptr<test::Backend> backend_;
    std::shared_ptr<Library> library_;
    Service service_;
    std::string token_;
    Value species_;
    int changes_ = 0;
};

/// Runs a request again and again; counts the median and the 95th percentile, and the responses of another status.
template <class Send>
void measure(benchmark::State& state, int status, Send send) {
    std::vector<double> spent;
    int others = 0;
    for (auto _ : state) {
        const auto begin = std::chrono::steady_clock::now();
        const Response response = send();
        spent.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
                .count());
        others += response.status != status ? 1 : 0;
    }
    std::sort(spent.begin(), spent.end());
    state.counters["p50_ms"] = spent[spent.size() / 2];
    state.counters["p95_ms"] = spent[spent.size() * 95 / 100];
    state.counters["other_statuses"] = others;
}

void names_of_backends(benchmark::internal::Benchmark* one) {
    for (std::size_t i = 0; i < test::backends.size(); ++i)
        if (test::backends[i].is_installed()) one->Arg(static_cast<int>(i));
    one->ArgName("database")->UseRealTime();
}

/// The page saves a draft a while after each change.
void save_draft(benchmark::State& state) {
    LibraryService service(state);
    measure(state, 200, [&] {
        return service.send("PUT", "/v1/library/~me.red_bolete", service.token(),
                            service.changed_species());
    });
}
BENCHMARK(save_draft)->Apply(names_of_backends);

void grow_draft(benchmark::State& state) {
    LibraryService service(state);
    measure(state, 200, [&] {
        return service.send("GET", "/v1/mushrooms/~me.red_bolete@draft.glb?lod=2&textures=none",
                            service.token());
    });
}
BENCHMARK(grow_draft)->Apply(names_of_backends);

/// Who guesses tokens must not learn from the time which ids exist: compare the next two.
void refuse_unknown_id(benchmark::State& state) {
    LibraryService service(state);
    const std::string token = new_secret(token_prefix).text;
    measure(state, 401, [&] { return service.send("GET", "/v1/library/quota", token); });
}
BENCHMARK(refuse_unknown_id)->Apply(names_of_backends);

void refuse_wrong_secret(benchmark::State& state) {
    LibraryService service(state);
    std::string token = service.token();
    token.back() = token.back() == 'A' ? 'Q' : 'A';
    measure(state, 401, [&] { return service.send("GET", "/v1/library/quota", token); });
}
BENCHMARK(refuse_wrong_secret)->Apply(names_of_backends);

}  // namespace
