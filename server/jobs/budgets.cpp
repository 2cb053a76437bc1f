#include "server/jobs/budgets.h"

#include <algorithm>

namespace sporeprint::server {

namespace {

constexpr std::int64_t millionths = 1'000'000;
constexpr std::uint64_t most_work =
    1'000'000'000'000;  ///< far from overflow when counted in millionths

std::int64_t in_millionths(std::uint64_t work) {
    return static_cast<std::int64_t>(std::min(work, most_work)) * millionths;
}

/// Returns a / b rounded up; both are positive.
std::int64_t ceil_div(std::int64_t a, std::int64_t b) { return a / b + (a % b != 0 ? 1 : 0); }

}  // namespace

Budgets::Budgets(const BudgetOptions& options)
    : rate_(static_cast<std::int64_t>(std::clamp<std::uint64_t>(options.rate, 1, 1'000'000'000))),
      capacity_(in_millionths(std::max<std::uint64_t>(options.burst, 1))),
      most_clients_(std::max<std::size_t>(options.most_clients, 1)) {}

Budgets::Bucket Budgets::bucket_of(const Payer& payer, std::int64_t now) const {
    const auto found = buckets_.find(payer);
    if (found == buckets_.end()) return {capacity_, now, now};
    Bucket bucket = found->second;
    fill(bucket, now);
    return bucket;
}

void Budgets::take(const Payer& payer, Bucket bucket, std::int64_t amount) {
    bucket.level -= amount;
    auto found = buckets_.find(payer);
    if (found == buckets_.end()) {
        if (buckets_.size() >= most_clients_) evict_one();
        found = buckets_.emplace(payer, bucket).first;
    } else {
        by_full_at_.erase({found->second.full_at, payer});
        found->second = bucket;
    }
    index(found);
}

std::chrono::microseconds Budgets::spend(const Payer& payer, std::uint64_t work, Time time) {
    const std::int64_t amount = in_millionths(work);
    const std::lock_guard lock(mutex_);
    const Bucket bucket = bucket_of(payer, advance(time));
    const std::int64_t enough = std::min(amount, capacity_);
    if (bucket.level < enough)
        return std::chrono::microseconds(ceil_div(enough - bucket.level, rate_));
    if (amount > 0) take(payer, bucket, amount);
    return {};
}

void Budgets::owe(const Payer& payer, std::uint64_t work, Time time) {
    if (work == 0) return;
    const std::lock_guard lock(mutex_);
    Bucket bucket = bucket_of(payer, advance(time));
    // A level never falls below that after the largest job, so that its millionths do not overflow.
    take(payer, bucket, std::min(in_millionths(work), bucket.level + in_millionths(most_work)));
}

void Budgets::give_back(const Payer& payer, std::uint64_t work, Time time) {
    const std::lock_guard lock(mutex_);
    const auto found = buckets_.find(payer);
    if (found == buckets_.end()) return;
    by_full_at_.erase({found->second.full_at, payer});
    fill(found->second, advance(time));
    found->second.level = std::min(capacity_, found->second.level + in_millionths(work));
    index(found);
}

Budgets::Level Budgets::level(const Payer& payer, Time time) const {
    using std::chrono::floor, std::chrono::microseconds;
    const std::lock_guard lock(mutex_);
    const std::int64_t now = std::max(now_, floor<microseconds>(time.time_since_epoch()).count());
    Bucket bucket{capacity_, now, now};
    if (const auto found = buckets_.find(payer); found != buckets_.end())
        fill(bucket = found->second, now);
    return {static_cast<std::uint64_t>(std::max<std::int64_t>(bucket.level, 0) / millionths),
            microseconds(ceil_div(capacity_ - bucket.level, rate_))};
}

std::size_t Budgets::clients() const {
    const std::lock_guard lock(mutex_);
    return buckets_.size();
}

/// Returns the time of the buckets, which is monotonic even if delayed threads pass earlier times.
std::int64_t Budgets::advance(Time now) {
    using std::chrono::floor, std::chrono::microseconds;
    return now_ = std::max(now_, floor<microseconds>(now.time_since_epoch()).count());
}

void Budgets::fill(Bucket& bucket, std::int64_t now) const {
    const std::int64_t missing = capacity_ - bucket.level, passed = now - bucket.at;
    // Compared by division, as passed * rate_ may overflow.
    bucket.level = passed >= ceil_div(missing, rate_) ? capacity_ : bucket.level + passed * rate_;
    bucket.at = now;
}

void Budgets::index(Buckets::iterator bucket) {
    Bucket& it = bucket->second;
    it.full_at = it.at + ceil_div(capacity_ - it.level, rate_);
    by_full_at_.emplace(it.full_at, bucket->first);
}

void Budgets::evict_one() {
    const auto first = by_full_at_.begin();
    buckets_.erase(first->second);
    by_full_at_.erase(first);
}

}  // namespace sporeprint::server
