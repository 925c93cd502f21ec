#pragma once

// A client of OpenSSL and our transport, joined by a pair of buffers: no sockets, no time, every byte in our
// hands.

#include <openssl/ssl.h>

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "runtime/modbus/server/tls/tls_acceptor.h"
#include "runtime/modbus/server/transport.h"

namespace stepwright::modbus::server {

using Stream = std::deque<std::byte>;

// The inside of our transport: bytes from and to the client.
class BufferTransport final : public Transport {
 public:
  BufferTransport(Stream& in, Stream& out) : in_(in), out_(out) {}

  int descriptor() const override { return -1; }
  Moved read(std::span<std::byte> into) override;
  Moved write(std::span<const std::byte> from) override;
  const Peer* peer() const override { return &peer_; }

  std::size_t piece = 4096;      // at most so many bytes are moved at once
  std::size_t limit = SIZE_MAX;  // so many more bytes can be read
  bool ended = false;            // the client has closed its socket

 private:
  Stream& in_;
  Stream& out_;
  Peer peer_{"192.0.2.7", "", false};
};

struct ClientOptions {
  std::string certificate;  // file; "" shows none
  std::string key;
  std::string authorities;
  int most_version = 0;  // TLS1_1_VERSION ...; 0: the newest
};

class TlsPair {
 public:
  TlsPair(const TlsContext& context, const ClientOptions& client);
  ~TlsPair();

  // Moves until nothing moves any more. True if both sides have finished the handshake.
  bool shake_hands();
  // The client sends, and the server reads all that arrives.
  std::string to_server(const std::string& text);
  std::string to_client(const std::string& text);
  // The client asks for new keys by a handshake within the connection (TLS 1.2); true if it gets them.
  bool renegotiate();

  // Moves the bytes of both sides to the other one; they are not read yet.
  void move_bytes();

  Transport& server() { return *server_; }
  BufferTransport& inside() { return *inside_; }
  SSL* client() { return client_; }
  // Bytes that the server has read so far, and whether the end was among them.
  std::string received;
  bool server_closed = false;
  std::vector<std::string> refused;

 private:
  void turn();

  Stream to_server_;
  Stream from_server_;
  SSL_CTX* client_context_ = nullptr;
  SSL* client_ = nullptr;
  std::unique_ptr<Acceptor> acceptor_;
  std::unique_ptr<Transport> server_;
  BufferTransport* inside_ = nullptr;
};

}  // namespace stepwright::modbus::server
