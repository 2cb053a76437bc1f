#include "server/http/deadlines.h"

#include <algorithm>

namespace sporeprint::server {

Deadlines::Deadlines(Clock::time_point now) : start_(now) {
    for (Timed& list : lists_) list.next_ = list.previous_ = &list;
    expired_.next_ = expired_.previous_ = &expired_;
}

std::int64_t Deadlines::tick_of(Clock::time_point time) const {
    if (time <= start_) return 0;
    if (time == Clock::time_point::max()) return never;
    return (time - start_ + tick - Clock::duration(1)) / tick;  // rounded up: never too early
}

void Deadlines::link(Timed& one) {
    one.tick_ = std::clamp(tick_of(one.deadline_), now_ + 1, now_ + wheel_size - 1);
    next_ = std::min(next_, one.tick_);
    one.link_after(lists_[static_cast<std::size_t>(one.tick_ % wheel_size)]);
}

void Deadlines::set(Timed& one, Clock::time_point deadline) {
    one.deadline_ = deadline;
    // Postponed: expire() visits its list earlier and then moves it to a later one.
    if (one.next_ && one.tick_ <= tick_of(deadline)) return;
    one.unlink();
    link(one);
}

void Deadlines::expire(Clock::time_point now, const std::function<void(Timed&)>& on_expired) {
    // Rounded down: a tick has passed when all its deadlines have.
    const std::int64_t reached = now <= start_ ? 0 : (now - start_) / tick;
    if (reached < next_) return;
    const std::int64_t first = std::max(next_, reached - wheel_size + 1);
    now_ = reached;
    for (std::int64_t at = first; at <= reached; ++at) {
        Timed& list = lists_[static_cast<std::size_t>(at % wheel_size)];
        for (Timed* one = list.next_; one != &list;) {
            Timed& here = *one;
            one = one->next_;
            here.unlink();
            if (here.deadline_ <= now)
                here.link_after(expired_);
            else
                link(here);  // at the front of a list, so it is not visited again
        }
    }
    next_ = never;
    for (std::int64_t at = now_ + 1; at < now_ + wheel_size && next_ == never; ++at) {
        const Timed& list = lists_[static_cast<std::size_t>(at % wheel_size)];
        if (list.next_ != &list) next_ = at;
    }
    while (expired_.next_ != &expired_) {
        Timed& one = *expired_.next_;
        one.unlink();
        on_expired(one);
    }
}

Clock::time_point Deadlines::next() const {
    return next_ == never ? Clock::time_point::max() : start_ + next_ * tick;
}

}  // namespace sporeprint::server
