// A request between the thread that owns the sockets and those that answer it: it goes to a worker,
// its answer comes back through a mailbox.
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

struct Reply {
    Connection* to = nullptr;  ///< lives until it has got this
    Sending sending;
    std::string label;
    std::shared_ptr<const HotResponse> hot;  ///< when others may get the same
    std::uint64_t epoch = 0;                 ///< if it is still that
};

/// Replies from any thread to the one that owns the connections, which it wakes.
class Mailbox {
  public:
    /// throws  std::runtime_error when the system has no descriptor left
    Mailbox();
    ~Mailbox();
    Mailbox(const Mailbox&) = delete;
    Mailbox& operator=(const Mailbox&) = delete;

    void post(Reply reply);
    void wake();

    /// All that has come, and quiet until more comes.
    [[nodiscard]] std::vector<Reply> take();

    [[nodiscard]] int descriptor() const { return descriptor_; }  ///< readable when there is mail

  private:
    int descriptor_;
    std::mutex mutex_;
    std::vector<Reply> replies_;
};

/// What stands behind the reactor; all may be used on any thread.
struct SharedState {
    const Handlers& handlers;
    HttpHeadCodec& codec;
    Workers& workers;
    Mailbox& mailbox;
    std::atomic<bool> draining{false};
    std::atomic<std::uint64_t> epoch{
        0};  ///< raised when answers of before are not to be given again

    /// handlers.refuse, or a bare status when it throws.
    [[nodiscard]] api::Response refusal(const api::Request& request, int status,
                                        std::string_view detail) const;

    /// handlers.judge_head, or none when it throws.
    [[nodiscard]] std::optional<api::Response> judge_head(const api::Request& request) const;

    /// handlers.label, or nothing when it throws.
    [[nodiscard]] std::string label(std::string_view method, std::string_view target) const;
};

class WorkerRequest final : public PendingRequest,
                            public std::enable_shared_from_this<WorkerRequest> {
  public:
    /// from     gets exactly one reply, unless drop() comes first
    /// client   who asks
    /// closing  whether the connection ends after this
    WorkerRequest(SharedState& back, Connection& from, api::Request request, const Address& client,
                  bool closing)
        : shared_(back),
          from_(&from),
          request_(std::move(request)),
          client_(client),
          closing_(closing) {}
    ~WorkerRequest() override;

    void start();        ///< on a worker
    void end(CancelReason why);  ///< the client has left, or has waited long enough
    void drop();         ///< there will be no reply

    [[nodiscard]] const api::Request& request() const override { return request_; }
    [[nodiscard]] const Address& client() const override { return client_; }
    [[nodiscard]] bool is_gone() const override { return is_gone_; }
    void reply(api::Response response) override;
    void resume(std::function<void()> go_on) override;
    void wait(std::function<void(CancelReason)> over) override;

  private:
    [[nodiscard]] bool claim();  ///< whether nobody has answered before

    SharedState& shared_;
    Connection* from_;
    api::Request request_;
    Address client_;
    bool closing_;
    std::uint64_t epoch_ = 0;  ///< when it began
    std::string label_;
    std::atomic<bool> is_gone_{false}, responded_{false};
    std::mutex mutex_;
    std::optional<CancelReason> over_;
    std::function<void(CancelReason)> notify_;  ///< may hold this exchange: let go when it is answered
};

}  // namespace sporeprint::server
