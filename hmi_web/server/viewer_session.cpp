#include "hmi_web/server/internal/viewer_session.h"

#include <boost/asio/buffer.hpp>
#include <utility>

namespace stepwright::server::internal {
namespace {

namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;

// Viewers have nothing to say yet; this is room for the frames of the protocol itself.
constexpr std::size_t kMaxMessageBytes = 4'096;

// Whoever listened has logged out, or was logged out (hmi_web/doc/protocol.md).
constexpr std::uint16_t kLoggedOut = 4'401;

websocket::stream_base::timeout timeouts(std::chrono::seconds silent_viewer) {
  websocket::stream_base::timeout timeout{};
  timeout.handshake_timeout = std::chrono::seconds(10);
  timeout.idle_timeout = silent_viewer;
  timeout.keep_alive_pings = true;
  return timeout;
}

}  // namespace

ViewerSession::ViewerSession(Wire wire, const Feed& feed, std::function<bool()> may_listen,
                             std::function<void()> on_end)
    : socket_(std::move(wire)), feed_(feed), may_listen_(std::move(may_listen)), on_end_(std::move(on_end)) {}

ViewerSession::~ViewerSession() {
  on_end_();
}

void ViewerSession::start(HttpRequest request, std::chrono::seconds silent_viewer,
                          const std::string& protocol) {
  socket_.set_option(timeouts(silent_viewer));
  socket_.read_message_max(kMaxMessageBytes);
  socket_.text(true);
  socket_.auto_fragment(false);  // one message, one frame
  if (!protocol.empty()) {
    socket_.set_option(websocket::stream_base::decorator([protocol](websocket::response_type& response) {
      response.set(beast::http::field::sec_websocket_protocol, protocol);
    }));
  }
  // The request outlives the call: it is moved into the handler.
  auto kept = std::make_shared<HttpRequest>(std::move(request));
  socket_.async_accept(*kept, [self = shared_from_this(), kept](beast::error_code error) {
    if (error) return;
    self->open_ = true;
    self->read();
    self->pump();
  });
}

void ViewerSession::pump() {
  if (!open_ || under_way_) return;
  if (!may_listen_()) return close(static_cast<websocket::close_code>(kLoggedOut));
  under_way_ = feed_.next(cursor_);
  if (!under_way_) return;
  socket_.async_write(boost::asio::buffer(*under_way_),
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        self->under_way_ = nullptr;
                        if (error) {
                          self->open_ = false;
                          return;
                        }
                        self->pump();
                      });
}

void ViewerSession::cut() {
  open_ = false;
  beast_close_socket(socket_.next_layer());
}

// A pending read is what makes Beast answer pings and closes.
void ViewerSession::read() {
  socket_.async_read(input_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) {
      self->open_ = false;
      return;
    }
    self->close(websocket::close_code::policy_error);
  });
}

void ViewerSession::close(websocket::close_code code) {
  open_ = false;
  socket_.async_close(code, [self = shared_from_this()](beast::error_code) {});
}

}  // namespace stepwright::server::internal
