// A request passed from the reactor thread to a worker, and the mailbox that returns its response.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/http/message.h"
#include "server/http/head_codec.h"
#include "server/http/transport.h"
#include "server/http/workers.h"

namespace sporeprint::server {

class Connection;
struct HotResponse;

/// A response addressed to a connection.
struct Reply {
    Connection* to = nullptr;  ///< lives until it has received this
    Sending sending;
    std::string label;
    std::shared_ptr<const HotResponse> hot;  ///< set if the response may be reused
    std::uint64_t epoch = 0;                 ///< the epoch in which it may be reused
};

/// A queue of replies from any thread to the reactor thread, which it wakes.
class Mailbox {
  public:
    /// throws  std::runtime_error if the system has no descriptor left
    Mailbox();
    ~Mailbox();
    Mailbox(const Mailbox&) = delete;
    Mailbox& operator=(const Mailbox&) = delete;

    void post(Reply reply);
    void wake();

    /// Removes and returns all replies, and clears the wake-up signal.
    [[nodiscard]] std::vector<Reply> take();

    /// Returns a descriptor that is readable while there are replies.
    [[nodiscard]] int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
    std::mutex mutex_;
    std::vector<Reply> replies_;
};

/// The state shared by the reactor and the workers. Every member is thread-safe.
struct SharedState {
    const Handlers& handlers;
    HttpHeadCodec& codec;
    Workers& workers;
    Mailbox& mailbox;
    std::atomic<bool> draining{false};
    std::atomic<std::uint64_t> epoch{0};  ///< incremented when earlier responses must not be reused

    /// Calls handlers.refuse; returns a response without headers and body if it throws.
    [[nodiscard]] api::Response refusal(const api::Request& request, int status,
                                        std::string_view detail) const;

    /// Calls handlers.route; returns a null pointer if it throws.
    [[nodiscard]] std::shared_ptr<const api::RoutedRequest> route(
        const api::Request& request) const;
};

/// Returns the label of a routed request; "UNKNOWN" for a null pointer.
[[nodiscard]] std::string label_of(const std::shared_ptr<const api::RoutedRequest>& routed);

/// A pending request of one connection.
class WorkerRequest final : public PendingRequest,
                            public std::enable_shared_from_this<WorkerRequest> {
  public:
    /// from     receives exactly one reply, unless drop() is called first
    /// routed   route of the request; null: a worker finds it
    /// client   address of the client
    /// closing  true: the connection is closed after this response
    WorkerRequest(SharedState& shared, Connection& from, api::Request request,
                  std::shared_ptr<const api::RoutedRequest> routed, const Address& client,
                  bool closing)
        : shared_(shared),
          from_(&from),
          request_(std::move(request)),
          routed_(std::move(routed)),
          client_(client),
          closing_(closing) {}
    ~WorkerRequest() override;

    void start();                      ///< called on a worker
    void cancel(CancelReason reason);  ///< called by the reactor
    void drop();                       ///< discards the reply

    [[nodiscard]] const api::Request& request() const override { return request_; }
    [[nodiscard]] const api::RoutedRequest& routed() const override { return *routed_; }
    [[nodiscard]] const Address& client() const override { return client_; }
    [[nodiscard]] bool is_disconnected() const override { return is_disconnected_; }
    void reply(api::Response response) override;
    void resume(std::function<void()> task) override;
    void wait(std::function<void(CancelReason)> on_cancel) override;

  private:
    [[nodiscard]] bool claim();  ///< returns true for the first response

    SharedState& shared_;
    Connection* from_;
    api::Request request_;
    std::shared_ptr<const api::RoutedRequest> routed_;
    Address client_;
    bool closing_;
    std::uint64_t epoch_ = 0;  ///< of its start
    std::atomic<bool> is_disconnected_{false}, responded_{false};
    std::mutex mutex_;
    std::optional<CancelReason> cancelled_;
    /// may own this request, so it is released with the response
    std::function<void(CancelReason)> on_cancel_;
};

}  // namespace sporeprint::server
