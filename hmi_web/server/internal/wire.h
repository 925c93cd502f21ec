#pragma once

// Private to this folder: a connection with TLS or without, behind one type, so that all of Beast is compiled
// for one kind of stream only. `Wire` is the stream for HTTP and WebSocket.
//
// Thread rule: as Boost.Asio; the handlers of one wire are called one after the other.

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "runtime/ground/result/result.h"

namespace stepwright::server::internal {

using ErrorCode = boost::beast::error_code;

// Interface of a connection, with TLS or without.
class WireKind {
 public:
  using Moved = std::function<void(ErrorCode, std::size_t)>;
  using Done = std::function<void(ErrorCode)>;

  virtual ~WireKind() = default;
  virtual void handshake(Done done) = 0;  // `done` may be called at once
  virtual void read_some(boost::asio::mutable_buffer room, Moved moved) = 0;
  virtual void write_some(std::span<const boost::asio::const_buffer> parts, Moved moved) = 0;
  // Shuts the connection down in order.
  virtual void end(Done done) = 0;
  virtual boost::beast::tcp_stream& transport() = 0;
};

// Certificate and key, read and found to belong together. Null where there is no TLS.
class TlsContext;
struct TlsContextDeleter {
  void operator()(TlsContext* context) const;
};
using TlsContextPointer = std::unique_ptr<TlsContext, TlsContextDeleter>;

// TLS 1.2 and later. Fails with H0003.
[[nodiscard]] result::Result<TlsContextPointer> load_tls(const std::filesystem::path& certificate,
                                                         const std::filesystem::path& key);

std::unique_ptr<WireKind> make_wire(boost::asio::ip::tcp::socket socket, TlsContext* tls);

// Models Beast's AsyncStream for completion handlers (not for other tokens).
class Wire {
 public:
  using executor_type = boost::beast::tcp_stream::executor_type;

  explicit Wire(std::unique_ptr<WireKind> kind) : kind_(std::move(kind)) {}

  executor_type get_executor() { return kind_->transport().get_executor(); }

  template <typename Buffers, typename Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    boost::asio::mutable_buffer room;
    const auto end = boost::asio::buffer_sequence_end(buffers);
    for (auto each = boost::asio::buffer_sequence_begin(buffers); each != end && room.size() == 0; ++each)
      room = *each;
    kind_->read_some(room, shared(std::forward<Handler>(handler)));
  }

  template <typename Buffers, typename Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    std::array<boost::asio::const_buffer, 16> parts;
    std::size_t count = 0;
    const auto end = boost::asio::buffer_sequence_end(buffers);
    for (auto each = boost::asio::buffer_sequence_begin(buffers); each != end && count < parts.size(); ++each)
      parts[count++] = *each;
    kind_->write_some({parts.data(), count}, shared(std::forward<Handler>(handler)));
  }

  WireKind& kind() { return *kind_; }

 private:
  // Handlers of Beast can be moved only, a std::function wants to be copied.
  template <typename Handler>
  static WireKind::Moved shared(Handler&& handler) {
    auto kept = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler));
    return [kept](ErrorCode error, std::size_t bytes) { (*kept)(error, bytes); };
  }

  std::unique_ptr<WireKind> kind_;
};

// Called by a WebSocket when it ends; found by the type of its stream.
template <typename Handler>
void async_teardown(boost::beast::role_type, Wire& wire, Handler&& handler) {
  auto kept = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler));
  wire.kind().end([kept](ErrorCode error) { (*kept)(error); });
}
void beast_close_socket(Wire& wire);

}  // namespace stepwright::server::internal
