#include "tests/unit/runtime/modbus/server/tls/tls_pair.h"

#include <openssl/bio.h>
#include <openssl/err.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace stepwright::modbus::server {

namespace {

constexpr int kTurns = 200;

// Lets one client in: the transport that it is given.
class OneAcceptor final : public Acceptor {
 public:
  explicit OneAcceptor(std::unique_ptr<Transport> transport) : transport_(std::move(transport)) {}
  int descriptor() const override { return -1; }
  std::unique_ptr<Transport> admit() override { return std::move(transport_); }
  void turn_away() override { transport_.reset(); }
  std::string name() const override { return "tcp 127.0.0.1:802"; }

 private:
  std::unique_ptr<Transport> transport_;
};

void must(bool condition, const char* what) {
  if (!condition) throw std::runtime_error(what);
}

}  // namespace

Moved BufferTransport::read(std::span<std::byte> into) {
  const std::size_t count = std::min({into.size(), in_.size(), piece, limit});
  if (count == 0) return {ended ? Moved::State::Closed : Moved::State::WouldBlock, 0};
  std::copy_n(in_.begin(), count, into.begin());
  in_.erase(in_.begin(), in_.begin() + static_cast<std::ptrdiff_t>(count));
  limit -= count;
  return {Moved::State::Done, count};
}

Moved BufferTransport::write(std::span<const std::byte> from) {
  const std::size_t count = std::min(from.size(), piece);
  out_.insert(out_.end(), from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count));
  return {Moved::State::Done, count};
}

TlsPair::TlsPair(const TlsContext& context, const ClientOptions& options) {
  client_context_ = SSL_CTX_new(TLS_client_method());
  must(client_context_ != nullptr, "no client");
  SSL_CTX_set_security_level(client_context_, options.most_version == 0 ? 2 : 0);
  if (options.most_version != 0) SSL_CTX_set_max_proto_version(client_context_, options.most_version);
  if (!options.certificate.empty()) {
    must(SSL_CTX_use_certificate_file(client_context_, options.certificate.c_str(), SSL_FILETYPE_PEM) == 1,
         "certificate");
    must(SSL_CTX_use_PrivateKey_file(client_context_, options.key.c_str(), SSL_FILETYPE_PEM) == 1, "key");
  }
  must(SSL_CTX_load_verify_file(client_context_, options.authorities.c_str()) == 1, "authorities");
  SSL_CTX_set_verify(client_context_, SSL_VERIFY_PEER, nullptr);
  client_ = SSL_new(client_context_);
  SSL_set_bio(client_, BIO_new(BIO_s_mem()), BIO_new(BIO_s_mem()));
  SSL_set_connect_state(client_);

  auto inside = std::make_unique<BufferTransport>(to_server_, from_server_);
  inside_ = inside.get();
  acceptor_ = std::make_unique<TlsAcceptor>(std::make_unique<OneAcceptor>(std::move(inside)), context,
                                            [this](const std::string& address, const std::string& reason) {
                                              refused.push_back(address + ": " + reason);
                                            });
  server_ = acceptor_->admit();
}

TlsPair::~TlsPair() {
  SSL_free(client_);
  SSL_CTX_free(client_context_);
  ERR_clear_error();
}

// From the client's memory to ours and back.
void TlsPair::move_bytes() {
  std::array<char, 4096> buffer;
  for (int count; (count = BIO_read(SSL_get_wbio(client_), buffer.data(), buffer.size())) > 0;) {
    const auto bytes = std::as_bytes(std::span(buffer)).first(static_cast<std::size_t>(count));
    to_server_.insert(to_server_.end(), bytes.begin(), bytes.end());
  }
  const std::vector<std::byte> bytes(from_server_.begin(), from_server_.end());
  from_server_.clear();
  if (!bytes.empty()) BIO_write(SSL_get_rbio(client_), bytes.data(), static_cast<int>(bytes.size()));
}

void TlsPair::turn() {
  move_bytes();
  std::array<std::byte, 64> buffer;
  while (!server_closed) {
    const Moved moved = server_->read(buffer);
    server_closed = moved.state == Moved::State::Closed;
    if (moved.state != Moved::State::Done) break;
    for (std::size_t i = 0; i < moved.bytes; ++i) received += static_cast<char>(buffer[i]);
  }
  move_bytes();
}

bool TlsPair::shake_hands() {
  for (int i = 0; i < kTurns; ++i) {
    ERR_clear_error();
    const int done = SSL_do_handshake(client_);
    turn();
    if (done == 1 && server_->peer() != nullptr) return true;
    if (server_closed) return false;
  }
  return false;
}

std::string TlsPair::to_server(const std::string& text) {
  received.clear();
  must(SSL_write(client_, text.data(), static_cast<int>(text.size())) == static_cast<int>(text.size()),
       "write");
  for (int i = 0; i < kTurns && received.size() < text.size(); ++i) turn();
  return received;
}

std::string TlsPair::to_client(const std::string& text) {
  std::string got;
  std::size_t sent = 0;
  for (int i = 0; i < kTurns && got.size() < text.size(); ++i) {
    if (sent < text.size()) {
      const Moved moved = server_->write(std::as_bytes(std::span(text)).subspan(sent));
      if (moved.state == Moved::State::Closed) break;
      sent += moved.bytes;
    }
    turn();
    std::array<char, 512> buffer;
    for (int count; (count = SSL_read(client_, buffer.data(), buffer.size())) > 0;)
      got.append(buffer.data(), static_cast<std::size_t>(count));
    ERR_clear_error();
  }
  return got;
}

bool TlsPair::renegotiate() {
  if (SSL_renegotiate(client_) != 1) return false;
  const std::size_t before = static_cast<std::size_t>(SSL_num_renegotiations(client_));
  for (int i = 0; i < kTurns; ++i) {
    const int done = SSL_do_handshake(client_);
    turn();
    if (server_closed || (done <= 0 && SSL_get_error(client_, done) != SSL_ERROR_WANT_READ)) break;
    if (done == 1 && SSL_renegotiate_pending(client_) == 0) {
      ERR_clear_error();
      return static_cast<std::size_t>(SSL_num_renegotiations(client_)) > before;
    }
  }
  ERR_clear_error();
  return false;
}

}  // namespace stepwright::modbus::server
