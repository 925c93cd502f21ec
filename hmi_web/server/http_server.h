#pragma once

// The HTTP and WebSocket server: hands out the client and feeds every page that is open.
//
//   auto server = HttpServer::listen({"127.0.0.1", 8080}, client::assets(), feed);
//   if (!server) return report(server.error());
//   (*server)->run();                    // until stop()
//
// Thread rule: run() in one thread; stop() and notify() from any. The feed outlives the server. Invariants:
// memory per viewer is bounded (one message under way, none queued); no request and no sequence of bytes ends
// the process. Without an API it accepts only requests without a body and viewers' messages (Feed::hear); any
// other input ends the connection. With an API it accepts the rows of the route table too, and nothing else.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "hmi_web/api/request_guard.h"
#include "hmi_web/protocol/asset.h"
#include "hmi_web/server/feed.h"
#include "hmi_web/server/request_policy.h"
#include "runtime/ground/result/result.h"

namespace stepwright::server {

struct ServerLimits {
  std::size_t connections = 128;             // for more there is room only in place of some that say nothing
  std::size_t viewers = 96;                  // of these
  std::size_t viewers_of_one = 24;           // session, or address where nobody logs in
  std::size_t header_bytes = 8'192;          // of a request
  std::size_t body_bytes = 16'384;           // of a request to the API, unless its route takes more
  std::chrono::seconds request_timeout{10};  // from the first byte expected to the last
  std::chrono::seconds large_request_timeout{60};  // of routes that take a larger body
  std::chrono::seconds silent_viewer{15};          // without any answer to pings: disconnected
  std::chrono::seconds viewer_begins{10};          // within this: a page says at once what it shows
};

class HttpServer {
 public:
  // Binds and listens. Fails with H0001 (port in use), H0002 (any other reason: no such address, no right),
  // H0003 (TLS).
  [[nodiscard]] static result::Result<std::unique_ptr<HttpServer>> listen(const ListenAddress& address,
                                                                          protocol::Assets assets,
                                                                          const Feed& feed,
                                                                          const ServerLimits& limits = {});
  // The same without page and viewers: kMetricsPath is all there is. `text` as in serve_metrics.
  [[nodiscard]] static result::Result<std::unique_ptr<HttpServer>> listen_for_metrics(
      const ListenAddress& address, std::function<std::string()> text, std::string content_type,
      const ServerLimits& limits = {});
  ~HttpServer();

  // Sets the text of kMetricsPath, which is made by the thread of run() for each request; without it the path
  // is unknown. Before run().
  void serve_metrics(std::function<std::string()> text, std::string content_type);

  // Sets the receiver of exceptions of a network step; an exception costs that step. Before run().
  void tell_trouble(std::function<void(const std::string&)> on_trouble);

  // Everything goes through this guard from now on. Before run(); the guard outlives the server.
  void serve_api(const api::RequestGuard& guard);

  // The port that is bound.
  std::uint16_t port() const;
  // Serves until stop().
  void run();
  void stop();
  // The feed has something new for the viewers.
  void notify();

  struct State;  // of the implementation

 private:
  explicit HttpServer(std::unique_ptr<State> state);
  [[nodiscard]] static result::Result<std::unique_ptr<HttpServer>> bind(const ListenAddress& address,
                                                                        protocol::Assets assets,
                                                                        std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::server
