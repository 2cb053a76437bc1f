#include "server/operations/metrics.h"

#include <prometheus/counter.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <array>
#include <mutex>
#include <unordered_map>
#include <utility>

#include "server/operations/machine.h"

namespace sporeprint::server {

namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;

const prometheus::Histogram::BucketBoundaries request_seconds = {
    0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10};

const char* method_label(std::string_view method) {
    for (const char* one : {"GET", "HEAD", "POST", "PUT", "DELETE", "OPTIONS"})
        if (method == one) return one;
    return "other";
}

using Labels = std::vector<std::pair<std::string, std::string>>;

/// Appends metric families whose values are read at this scrape.
class Snapshot {
  public:
    explicit Snapshot(std::vector<MetricFamily>& families) : families_(families) {}

    Snapshot& family(std::string name, std::string help, MetricType type) {
        families_.push_back({std::move(name), std::move(help), type, {}});
        return *this;
    }

    Snapshot& value(double value, const Labels& labels = {}) {
        ClientMetric metric;
        for (const auto& [name, text] : labels) metric.label.push_back({name, text});
        if (families_.back().type == MetricType::Counter)
            metric.counter.value = value;
        else
            metric.gauge.value = value;
        families_.back().metric.push_back(std::move(metric));
        return *this;
    }

    template <class Count>
    Snapshot& count(const Count& count, const Labels& labels = {}) {
        return value(static_cast<double>(static_cast<std::uint64_t>(count)), labels);
    }

  private:
    std::vector<MetricFamily>& families_;
};

constexpr MetricType counter = MetricType::Counter, gauge = MetricType::Gauge;

void add_cache_families(const api::Counters& counters, const Gauges& gauges, Snapshot& now) {
    now.family("sporeprint_generated_total", "Answers made", counter).count(counters.generated);
    now.family("sporeprint_painted_total", "Image sets painted", counter).count(counters.painted);
    now.family("sporeprint_cache_requests_total", "Look-ups in the caches", counter)
        .count(gauges.connections.hot_hits, {{"cache", "hot"}, {"result", "hit"}})
        .count(gauges.connections.hot_not_modified, {{"cache", "hot"}, {"result", "not_modified"}})
        .count(counters.glb_hits, {{"cache", "glb"}, {"result", "hit"}})
        .count(counters.glb_misses, {{"cache", "glb"}, {"result", "miss"}})
        .count(counters.glb_not_modified, {{"cache", "glb"}, {"result", "not_modified"}})
        .count(counters.image_hits, {{"cache", "images"}, {"result", "hit"}})
        .count(counters.image_misses, {{"cache", "images"}, {"result", "miss"}})
        .count(counters.painting_hits, {{"cache", "paintings"}, {"result", "hit"}})
        .count(counters.painting_misses, {{"cache", "paintings"}, {"result", "miss"}})
        .count(counters.morph_hits, {{"cache", "morphs"}, {"result", "hit"}})
        .count(counters.morph_misses, {{"cache", "morphs"}, {"result", "miss"}})
        .count(counters.ground_hits, {{"cache", "worlds"}, {"result", "hit"}})
        .count(counters.ground_misses, {{"cache", "worlds"}, {"result", "miss"}})
        .count(counters.block_hits, {{"cache", "blocks"}, {"result", "hit"}})
        .count(counters.block_misses, {{"cache", "blocks"}, {"result", "miss"}})
        .count(counters.store_hits, {{"cache", "store"}, {"result", "hit"}})
        .count(counters.store_misses, {{"cache", "store"}, {"result", "miss"}});
    now.family("sporeprint_cache_bytes", "Bytes kept", gauge)
        .count(gauges.connections.hot_bytes, {{"cache", "hot"}})
        .count(counters.glb_cache_bytes, {{"cache", "glb"}})
        .count(counters.image_cache_bytes, {{"cache", "images"}})
        .count(counters.morph_cache_bytes, {{"cache", "morphs"}})
        .count(counters.world_cache_bytes, {{"cache", "worlds"}})
        .count(counters.block_cache_bytes, {{"cache", "blocks"}})
        .count(counters.store_bytes, {{"cache", "store"}});
    now.family("sporeprint_cache_entries", "Entries kept", gauge)
        .count(gauges.connections.hot_entries, {{"cache", "hot"}})
        .count(counters.glb_cache_entries, {{"cache", "glb"}})
        .count(counters.image_cache_entries, {{"cache", "images"}})
        .count(counters.morph_cache_entries, {{"cache", "morphs"}})
        .count(counters.world_cache_entries, {{"cache", "worlds"}})
        .count(counters.block_cache_entries, {{"cache", "blocks"}})
        .count(counters.store_entries, {{"cache", "store"}});
    now.family("sporeprint_cache_evictions_total", "Entries given up for others", counter)
        .count(gauges.connections.hot_evictions, {{"cache", "hot"}})
        .count(counters.glb_evictions, {{"cache", "glb"}})
        .count(counters.image_evictions, {{"cache", "images"}})
        .count(counters.morph_evictions, {{"cache", "morphs"}})
        .count(counters.world_evictions, {{"cache", "worlds"}})
        .count(counters.block_evictions, {{"cache", "blocks"}})
        .count(counters.store_evictions, {{"cache", "store"}});
    now.family("sporeprint_store_faults_total", "Kept files lost: damaged, or not written", counter)
        .count(counters.store_damaged, {{"fault", "damaged"}})
        .count(counters.store_unwritten, {{"fault", "unwritten"}});
}

void add_work_families(const Gauges& gauges, Snapshot& now) {
    now.family("sporeprint_workers", "Compute slots", gauge).count(gauges.workers);
    now.family("sporeprint_workers_busy", "Compute slots at work", gauge)
        .count(gauges.busy_workers);
    now.family("sporeprint_generate_in_progress", "Keys queued or being made", gauge)
        .count(gauges.in_flight);
    now.family("sporeprint_waiters", "Requests that wait for one of them", gauge)
        .count(gauges.waiters);
    now.family("sporeprint_queue_depth", "Work waiting for a slot", gauge).count(gauges.queue);
    now.family("sporeprint_queue_limit", "Work that may wait for a slot", gauge)
        .count(gauges.queue_limit);
}

void add_connection_families(const Gauges& gauges, Snapshot& now) {
    now.family("sporeprint_connections", "Connections, by what they do", gauge);
    for (std::size_t i = 0; i < Transport::phases.size(); ++i)
        now.count(gauges.connections.connections[i], {{"state", Transport::phases[i]}});
    now.family("sporeprint_requests_waiting", "Requests that wait for a worker", gauge)
        .count(gauges.connections.queue);
    now.family("sporeprint_connections_refused_total", "Connections turned away", counter)
        .count(gauges.connections.refused);
    now.family("sporeprint_connections_limited_total", "Connections beyond the limit of a client",
               counter)
        .count(gauges.connections.limited);
    now.family("sporeprint_pinned_bytes", "Bytes of answers that wait for slow clients", gauge)
        .count(gauges.connections.pinned);
    now.family("sporeprint_given_up_total", "Answers not waited for, to spare memory", counter)
        .count(gauges.connections.aborted_responses);
    now.family("sporeprint_body_bytes", "Bytes of request bodies that have arrived", gauge)
        .count(gauges.connections.body_bytes);
    now.family("sporeprint_uploads_given_up_total", "Bodies refused midway, to spare memory",
               counter)
        .count(gauges.connections.aborted_uploads);
}

void add_process_families(Snapshot& now) {
    const Usage used = usage();
    now.family("process_resident_memory_bytes", "Resident memory", gauge)
        .count(used.resident_bytes);
    now.family("process_cpu_seconds_total", "Processor time", counter).value(used.cpu_seconds);
    now.family("process_start_time_seconds", "Start, since 1970", gauge).value(used.started);
    now.family("process_open_fds", "Open files", gauge).count(used.open_files);
}

}  // namespace

struct Metrics::Parts {
    prometheus::Registry registry;
    prometheus::Family<prometheus::Counter>& requests;
    prometheus::Family<prometheus::Histogram>& durations;
    prometheus::Family<prometheus::Histogram>& spans;
    prometheus::Family<prometheus::Counter>& rejections;
    prometheus::Counter& bytes;
    prometheus::Counter& collapses;
    std::string version, generator_version;

    /// The counters of one kind of request, cached so that labels are not formatted per request.
    struct Kind {
        prometheus::Counter* requests = nullptr;
        prometheus::Histogram* durations = nullptr;
    };
    std::mutex kinds_mutex;
    std::unordered_map<std::string, Kind> kinds;  ///< by status, method and label

    Parts(std::string the_version, std::string the_generator_version)
        : requests(prometheus::BuildCounter()
                       .Name("sporeprint_http_requests_total")
                       .Help("Requests answered")
                       .Register(registry)),
          durations(prometheus::BuildHistogram()
                        .Name("sporeprint_http_request_duration_seconds")
                        .Help("From the last byte of a request to the last of its answer")
                        .Register(registry)),
          spans(prometheus::BuildHistogram()
                    .Name("sporeprint_request_span_seconds")
                    .Help("Steps of what was made")
                    .Register(registry)),
          rejections(prometheus::BuildCounter()
                         .Name("sporeprint_queue_rejected_total")
                         .Help("Requests that were not worked on to their end")
                         .Register(registry)),
          bytes(prometheus::BuildCounter()
                    .Name("sporeprint_bytes_sent_total")
                    .Help("Bytes of answers")
                    .Register(registry)
                    .Add({})),
          collapses(prometheus::BuildCounter()
                        .Name("sporeprint_collapsed_total")
                        .Help("Requests that got the result of another's work")
                        .Register(registry)
                        .Add({})),
          version(std::move(the_version)),
          generator_version(std::move(the_generator_version)) {
        for (const char* reason : {"queue", "deadline", "left", "signature", "budget"})
            rejections.Add({{"reason", reason}});
    }
};

Metrics::Metrics(std::string version, std::string generator_version)
    : parts_(std::make_unique<Parts>(std::move(version), std::move(generator_version))) {}

Metrics::~Metrics() = default;

void Metrics::served(const Served& served) {
    const char* const method = method_label(served.method);
    thread_local std::string key;
    key.assign(1, static_cast<char>(served.status / 100));
    ((key += static_cast<char>(served.status % 100)) += method) += served.label;
    Parts::Kind kind;
    {
        const std::lock_guard lock(parts_->kinds_mutex);
        Parts::Kind& cached = parts_->kinds[key];
        if (!cached.requests) {
            cached.requests = &parts_->requests.Add({{"route", served.label},
                                                     {"method", method},
                                                     {"code", std::to_string(served.status)}});
            cached.durations = &parts_->durations.Add({{"route", served.label}}, request_seconds);
        }
        kind = cached;
    }
    kind.requests->Increment();
    kind.durations->Observe(served.milliseconds / 1000);
    parts_->bytes.Increment(static_cast<double>(served.bytes));
}

void Metrics::generated(const api::Timing& timing) {
    timing.each([&](const char* step, double milliseconds) {
        parts_->spans.Add({{"span", step}}, request_seconds).Observe(milliseconds / 1000);
    });
}

void Metrics::collapsed() { parts_->collapses.Increment(); }

void Metrics::rejected(std::string_view reason) {
    parts_->rejections.Add({{"reason", std::string(reason)}}).Increment();
}

std::string Metrics::text(const api::Counters& counters, const Gauges& gauges) const {
    std::vector<MetricFamily> families = parts_->registry.Collect();
    Snapshot now(families);
    add_cache_families(counters, gauges, now);
    add_work_families(gauges, now);
    add_connection_families(gauges, now);
    now.family("sporeprint_clients", "Clients whose budgets are remembered", gauge)
        .count(gauges.clients);
    now.family("sporeprint_ready", "Whether /readyz says so", gauge).count(gauges.ready ? 1u : 0u);
    now.family("sporeprint_build_info", "What runs here", gauge)
        .value(1, {{"version", parts_->version}, {"generator_version", parts_->generator_version}});
    add_process_families(now);
    return prometheus::TextSerializer().Serialize(families);
}

}  // namespace sporeprint::server
