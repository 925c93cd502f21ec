#pragma once

// Private to this folder: one open page, from its WebSocket handshake to its end.

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <functional>
#include <memory>

#include "hmi_web/server/feed.h"

namespace stepwright::server::internal {

using HttpRequest = boost::beast::http::request<boost::beast::http::empty_body>;

// shared_ptr: each pending operation of Beast holds the session, which ends with the last of them.
class ViewerSession : public std::enable_shared_from_this<ViewerSession> {
 public:
  // `on_end` is called once, when the session has ended.
  ViewerSession(boost::asio::ip::tcp::socket socket, const Feed& feed, std::function<void()> on_end);
  ~ViewerSession();

  void start(HttpRequest request, std::chrono::seconds silent_viewer);
  // Sends what the viewer misses, unless a message is still under way.
  void pump();
  // Cuts the connection: the server ends.
  void cut();

 private:
  void read();
  void close(boost::beast::websocket::close_code code);

  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  boost::beast::flat_buffer input_;
  const Feed& feed_;
  Feed::Cursor cursor_;
  MessageText under_way_;  // null = nothing is being sent
  bool open_ = false;      // handshake done, not closing
  std::function<void()> on_end_;
};

}  // namespace stepwright::server::internal
