// The codec of heads: cpp-httplib without its event loop. It binds the listening socket, parses
// request lines that scan_head() has accepted, and formats the heads of responses.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "api/http/message.h"
#include "server/http/transport.h"

namespace sporeprint::server {

/// A response ready to be sent.
struct Sending {
    std::string head;  ///< status line and headers; empty if formatting failed
    api::Response response;
    bool with_body = true;
    bool closing = false;  ///< the head has "Connection: close"
};

/// Formats the heads of responses and owns the listening socket.
class HttpHeadCodec {
  public:
    explicit HttpHeadCodec(const TransportOptions& options);
    ~HttpHeadCodec();
    HttpHeadCodec(const HttpHeadCodec&) = delete;
    HttpHeadCodec& operator=(const HttpHeadCodec&) = delete;

    /// Binds and listens on a non-blocking socket.
    ///
    /// throws  std::runtime_error with a message for the operator
    void bind(const std::string& host, int port, int backlog);

    /// Returns the descriptor of the listening socket; -1 after close().
    [[nodiscard]] int socket() const;
    /// Closes the listening socket.
    void close();

    /// Passes a request line through cpp-httplib (the library) and returns the response with its
    /// formatted head. The callbacks run on the calling thread. Thread-safe.
    ///
    /// request_line  "GET /a HTTP/1.1"; a method unknown to the library is treated as GET, since
    ///               only HEAD changes the head of a response
    /// make          returns the response to a request that the library accepts
    /// refuse        returns the response with this status if the library does not accept the
    ///               request; the connection is closed after it
    /// closing       called last; returns true if the connection is closed after this response
    [[nodiscard]] Sending send(const std::string& request_line,
                               const std::function<api::Response()>& make,
                               const std::function<api::Response(int status)>& refuse,
                               const std::function<bool()>& closing);

  private:
    class Server;
    std::unique_ptr<Server> server_;
};

/// Returns the current time as IMF-fixdate, "Sun, 06 Nov 1994 08:49:37 GMT"; formatted once per
/// second and thread. The reference is to a variable of this thread, which the next call may
/// change.
[[nodiscard]] const std::string& http_date();

}  // namespace sporeprint::server
