// A few threads that do what takes more than a moment, so that the reactor never does.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace sporeprint::server {

class Workers {
  public:
    /// count    threads, at least 1
    /// longest  tasks that may wait when offered
    Workers(std::size_t count, std::size_t longest);

    /// Returns when every task has been done.
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    /// Puts a task at the end of the queue. It must not throw.
    ///
    /// returns  false when the queue is full: the task will not be done
    [[nodiscard]] bool offer(std::function<void()> task);

    /// The same for what has been begun and must go on: never refused.
    void post(std::function<void()> task);

    [[nodiscard]] std::size_t waiting() const;  ///< tasks in the queue

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
