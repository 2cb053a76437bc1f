#include "api/store.h"

#include <utility>

namespace sporeprint::api {

Store::Store(const ServiceOptions& options)
    : answers(options.cache_bytes, [](const Kept& answer) { return weight_of(*answer); }),
      images(options.image_cache_bytes,
             [](const Images& set) { return set->bytes() + sizeof(ImageSet); }) {}

void Store::measure() {
    const CacheStats of_answers = answers.stats(), of_images = images.cache().stats();
    counters.glb_cache_bytes = of_answers.bytes;
    counters.glb_cache_entries = of_answers.entries;
    counters.glb_evictions = of_answers.evictions;
    counters.image_cache_bytes = of_images.bytes;
    counters.image_cache_entries = of_images.entries;
    counters.image_evictions = of_images.evictions;
}

std::string cache_member(std::string_view cache, bool hit, bool stored) {
    return std::string(cache) + (hit ? "; hit" : stored ? "; fwd=miss; stored" : "; fwd=miss");
}

Loan::Loan(Store& store, std::stop_token stop, const Observer& observer, const Parallel& parallel)
    : store_(store) {
    workshop_.observer = observer;
    workshop_.parallel = parallel;
    workshop_.stop = std::move(stop);
    workshop_.memo.images = [this](const std::string& key, const std::function<Images()>& make) {
        return images(key, make);
    };
}

Images Loan::images(const std::string& key, const std::function<Images()>& make) {
    const auto counted = [&] {
        Images set = make();
        ++store_.counters.painted;
        return set;
    };
    bool hit = false;
    Images set = store_.images.remember(key, counted, workshop_.stop, hit);
    const Cache<Images>& cache = store_.images.cache();
    images_ = cache_member("sporeprint-images", hit, cache.fits(cache.weight(key, set)));
    ++(hit ? store_.counters.image_hits : store_.counters.image_misses);
    return set;
}

}  // namespace sporeprint::api
