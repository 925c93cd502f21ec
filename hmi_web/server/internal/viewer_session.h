#pragma once

// Private to this folder: one open page, from its WebSocket handshake to its end.

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "hmi_web/server/feed.h"
#include "hmi_web/server/internal/wire.h"

namespace stepwright::server::internal {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;

// shared_ptr: each pending operation of Beast holds the session, which ends with the last of them.
class ViewerSession : public std::enable_shared_from_this<ViewerSession> {
 public:
  // `may_listen` is asked before each message: false when whoever looks has logged out meanwhile. `on_end`
  // is called once, when the session has ended.
  ViewerSession(Wire wire, const Feed& feed, std::function<bool()> may_listen, std::function<void()> on_end);
  ~ViewerSession();

  struct Patience {
    std::chrono::seconds silent{15};  // without any answer to pings
    std::chrono::seconds begins{10};  // until it has said what it shows
  };
  // `protocol`: the subprotocol that is agreed to; may be empty.
  void start(HttpRequest request, Patience patience, const std::string& protocol);
  // Sends what the viewer misses, unless a message is still under way.
  void pump();
  // Cuts the connection: the server ends.
  void cut();

 private:
  using Time = std::chrono::steady_clock::time_point;

  void read();
  bool hear();
  bool is_within_rate();
  void close(boost::beast::websocket::close_code code, std::string_view reason = {});

  boost::beast::websocket::stream<Wire> socket_;
  boost::beast::flat_buffer input_;
  const Feed& feed_;
  Feed::Cursor cursor_;
  MessageText under_way_;  // null = nothing is being sent
  bool open_ = false;      // handshake done, not closing
  Time begins_by_{};
  double may_say_ = 0;  // messages that it may send at once
  Time said_{};         // when that was counted
  std::function<bool()> may_listen_;
  std::function<void()> on_end_;
};

}  // namespace stepwright::server::internal
