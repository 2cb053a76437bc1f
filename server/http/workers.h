// A small thread pool for request handlers, so that they never block the reactor.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace sporeprint::server {

/// Runs tasks in the order of submission. Thread-safe.
class Workers {
  public:
    /// count    threads, at least 1
    /// longest  queue length from which offer() refuses tasks
    Workers(std::size_t count, std::size_t longest);

    /// Returns when all queued tasks have run.
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    /// Appends a task to the queue. It must not throw.
    ///
    /// returns  false if the queue is full; the task will not run
    [[nodiscard]] bool offer(std::function<void()> task);

    /// Appends a task that continues a request already begun; it is never refused.
    void post(std::function<void()> task);

    [[nodiscard]] std::size_t waiting() const;  ///< number of queued tasks

  private:
    void work();

    std::size_t longest_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<std::function<void()>> queue_;
    bool stopping_ = false;
    std::vector<std::jthread> threads_;
};

}  // namespace sporeprint::server
