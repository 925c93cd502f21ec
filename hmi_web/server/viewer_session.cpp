#include "hmi_web/server/internal/viewer_session.h"

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <utility>

namespace stepwright::server::internal {
namespace {

namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;

// A page says what it shows when that changes: some times a second while somebody scrolls.
constexpr double kMessagesAtOnce = 40;
constexpr double kMessagesPerSecond = 20;

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

void ViewerSession::start(HttpRequest request, Patience patience, const std::string& protocol) {
  socket_.set_option(timeouts(patience.silent));
  socket_.read_message_max(protocol::kMostViewerBytes);
  socket_.text(true);
  socket_.auto_fragment(false);  // one message, one frame
  if (!protocol.empty()) {
    socket_.set_option(websocket::stream_base::decorator([protocol](websocket::response_type& response) {
      response.set(beast::http::field::sec_websocket_protocol, protocol);
    }));
  }
  // The request outlives the call: it is moved into the handler.
  auto kept = std::make_shared<HttpRequest>(std::move(request));
  socket_.async_accept(*kept,
                       [self = shared_from_this(), kept, begins = patience.begins](beast::error_code error) {
                         if (error) return;
                         self->open_ = true;
                         self->said_ = std::chrono::steady_clock::now();
                         self->begins_by_ = self->said_ + begins;
                         self->may_say_ = kMessagesAtOnce;
                         self->read();
                         self->pump();
                       });
}

void ViewerSession::pump() {
  if (!open_ || under_way_) return;
  if (!may_listen_()) return close(static_cast<websocket::close_code>(kLoggedOut));
  // Who does not begin is of another version, or holds the connection for nothing.
  if (cursor_.greeted && !cursor_.begun && std::chrono::steady_clock::now() > begins_by_)
    return close(websocket::close_code::policy_error, "the page does not begin");
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

// A pending read is what makes Beast answer pings and closes, too.
void ViewerSession::read() {
  socket_.async_read(input_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) {
      self->open_ = false;
      return;
    }
    if (!self->hear()) return;
    self->read();
    self->pump();
  });
}

// False: it was wrong, and the connection ends.
bool ViewerSession::hear() {
  if (!open_) return false;
  if (!is_within_rate()) return close(websocket::close_code::policy_error, "too many messages"), false;
  if (!socket_.got_text()) return close(websocket::close_code::policy_error, "text is expected"), false;
  const auto bytes = input_.cdata();
  const auto why = feed_.hear(cursor_, {static_cast<const char*>(bytes.data()), bytes.size()});
  input_.consume(bytes.size());
  if (why) close(websocket::close_code::policy_error, *why);
  return !why;
}

bool ViewerSession::is_within_rate() {
  const Time now = std::chrono::steady_clock::now();
  const double passed_s = std::chrono::duration<double>(now - said_).count();
  said_ = now;
  may_say_ = std::min(kMessagesAtOnce, may_say_ + kMessagesPerSecond * passed_s);
  if (may_say_ < 1) return false;
  may_say_ -= 1;
  return true;
}

void ViewerSession::close(websocket::close_code code, std::string_view reason) {
  open_ = false;
  const websocket::close_reason why(code, {reason.data(), reason.size()});
  socket_.async_close(why, [self = shared_from_this()](beast::error_code) {});
}

}  // namespace stepwright::server::internal
