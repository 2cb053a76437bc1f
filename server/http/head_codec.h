// The library cpp-httplib without its loop: it binds, parses the request lines that `head` has
// passed, and formats the heads of answers.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "api/http/message.h"
#include "server/http/transport.h"

namespace sporeprint::server {

/// An answer on its way out.
struct Sending {
    std::string head;  ///< ready to be sent; empty when none could be made
    api::Response response;
    bool with_body = true;
    bool closing = false;  ///< whether the head says that the connection ends after this
};

class HttpHeadCodec {
  public:
    explicit HttpHeadCodec(const TransportOptions& options);
    ~HttpHeadCodec();
    HttpHeadCodec(const HttpHeadCodec&) = delete;
    HttpHeadCodec& operator=(const HttpHeadCodec&) = delete;

    /// Binds and listens; the socket does not block.
    ///
    /// throws  std::runtime_error, one sentence for a person
    void bind(const std::string& host, int port, int backlog);

    [[nodiscard]] int socket() const;  ///< -1 after close()
    void close();

    /// One request on its way through the library; may be used on any thread.
    ///
    /// request_line  "GET /a HTTP/1.1"; a method that the library does not know is as good as GET,
    ///               since only HEAD changes a head
    /// make          the answer to a request that the library accepts
    /// refuse        the answer with this status when it does not; the connection ends then
    /// closing       asked last: whether the connection ends after this
    [[nodiscard]] Sending send(const std::string& request_line,
                               const std::function<api::Response()>& make,
                               const std::function<api::Response(int status)>& refuse,
                               const std::function<bool()>& closing);

  private:
    class Server;
    std::unique_ptr<Server> server_;
};

/// IMF-fixdate of now, "Sun, 06 Nov 1994 08:49:37 GMT"; made anew once in a second on each thread.
[[nodiscard]] const std::string& http_date();

}  // namespace sporeprint::server
