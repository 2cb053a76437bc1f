#include "api/store.h"

#include <utility>

#include "core/silhouette/morph_set.h"

namespace sporeprint::api {

namespace {

std::size_t weight_of(const Painted& painted) {
    if (const Images* images = std::get_if<Images>(&painted))
        return (*images)->bytes() + sizeof(ImageSet);
    const RawImages& raw = *std::get<Painting>(painted);
    return raw.rgb[0].size() + raw.rgb[1].size() + raw.rgb[2].size() + sizeof(RawImages);
}

/// What a cache did when it was asked.
struct Asked {
    bool hit = false, stored = false;
};

/// Asks a cache whose values hold a shared_ptr<const T>, perhaps as an alternative.
template <class T, class Value>
std::shared_ptr<const T> ask(RememberingCache<Value>& cache, const std::string& key,
                             const std::function<std::shared_ptr<const T>()>& make,
                             const std::stop_token& stop, Asked& asked) {
    Value value = cache.remember(
        key, [&] { return Value(make()); }, stop, asked.hit);
    asked.stored = cache.cache().fits(cache.cache().weight(key, value));
    if constexpr (std::is_same_v<Value, Painted>)
        return std::get<std::shared_ptr<const T>>(value);
    else
        return value;
}

void count(std::atomic<std::uint64_t>& hits, std::atomic<std::uint64_t>& misses, bool hit) {
    ++(hit ? hits : misses);
}

}  // namespace

Store::Store(const ServiceOptions& options)
    : answers(options.cache_bytes, [](const Kept& answer) { return api::weight_of(*answer); }),
      images(options.image_cache_bytes, [](const Painted& painted) { return weight_of(painted); }),
      morphs(options.morph_cache_bytes,
             [](const Morph& morph) { return morph->bytes() + sizeof(MorphSet); }) {
    if (!options.store.empty())
        directory.emplace(options.store, options.store_bytes, options.store_event);
}

void Store::measure() {
    const CacheStats of_answers = answers.stats(), of_images = images.cache().stats(),
                     of_morphs = morphs.cache().stats();
    counters.glb_cache_bytes = of_answers.bytes;
    counters.glb_cache_entries = of_answers.entries;
    counters.glb_evictions = of_answers.evictions;
    counters.image_cache_bytes = of_images.bytes;
    counters.image_cache_entries = of_images.entries;
    counters.image_evictions = of_images.evictions;
    counters.morph_cache_bytes = of_morphs.bytes;
    counters.morph_cache_entries = of_morphs.entries;
    counters.morph_evictions = of_morphs.evictions;
    if (!directory) return;
    const DirectoryStats of_directory = directory->stats();
    counters.store_hits = of_directory.hits;
    counters.store_misses = of_directory.misses;
    counters.store_damaged = of_directory.damaged;
    counters.store_unwritten = of_directory.unwritten;
    counters.store_bytes = of_directory.bytes;
    counters.store_entries = of_directory.entries;
    counters.store_evictions = of_directory.evictions;
}

Memo kept_only(Store& store) {
    Memo memo;
    memo.morphs = [&store](const std::string& key, const std::function<Morph()>&) {
        if (std::optional<Morph> kept = store.morphs.cache().find(key)) return *std::move(kept);
        throw NotKept{key, {}};
    };
    return memo;
}

Memo made_at_once(Store& store) {
    Memo memo;
    memo.morphs = [&store](const std::string& key, const std::function<Morph()>& make) {
        const std::optional<Morph> kept = store.morphs.cache().find(key);
        count(store.counters.morph_hits, store.counters.morph_misses, kept.has_value());
        if (kept) return *kept;
        Morph made = make();
        store.morphs.cache().insert(key, made);
        return made;
    };
    return memo;
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
        Asked asked;
        const auto counted = [&] {
            Images set = make();
            ++store_.counters.painted;
            return set;
        };
        Images set = ask<ImageSet>(store_.images, key, counted, workshop_.stop, asked);
        count(store_.counters.image_hits, store_.counters.image_misses, asked.hit);
        note(images_, cache_member("sporeprint-images", asked.hit, asked.stored));
        return set;
    };
    workshop_.memo.paintings = [this](const std::string& key,
                                      const std::function<Painting()>& make) {
        Asked asked;
        Painting painting = ask<RawImages>(store_.images, key, make, workshop_.stop, asked);
        count(store_.counters.painting_hits, store_.counters.painting_misses, asked.hit);
        return painting;
    };
    workshop_.memo.morphs = [this](const std::string& key, const std::function<Morph()>& make) {
        Asked asked;
        Morph morph = ask<MorphSet>(store_.morphs, key, make, workshop_.stop, asked);
        count(store_.counters.morph_hits, store_.counters.morph_misses, asked.hit);
        note(morphs_, cache_member("sporeprint-morph", asked.hit, asked.stored));
        return morph;
    };
}

void Loan::note(std::string& said, std::string member) {
    const std::lock_guard lock(mutex_);
    if (said.empty()) said = std::move(member);
}

std::string Loan::cache_status() const {
    const std::lock_guard lock(mutex_);
    return morphs_ + (morphs_.empty() || images_.empty() ? "" : ", ") + images_;
}

}  // namespace sporeprint::api
