#include "runtime/modbus/server/tls/internal/tls_transport.h"

#include <openssl/bio.h>

#include <limits>
#include <optional>
#include <utility>

#include "runtime/modbus/server/tls/internal/role.h"

namespace stepwright::modbus::server {

namespace {

using Clock = std::chrono::steady_clock;

Transport& inner_of(BIO* bio) {
  return *static_cast<Transport*>(BIO_get_data(bio));
}

int bio_result(BIO* bio, Moved moved, std::size_t* bytes, int direction) {
  BIO_clear_retry_flags(bio);
  *bytes = moved.bytes;
  if (moved.state == Moved::State::Done) return 1;
  if (moved.state == Moved::State::WouldBlock) BIO_set_flags(bio, direction | BIO_FLAGS_SHOULD_RETRY);
  return 0;
}

int bio_read(BIO* bio, char* into, std::size_t size, std::size_t* bytes) {
  const Moved moved = inner_of(bio).read(std::as_writable_bytes(std::span(into, size)));
  return bio_result(bio, moved, bytes, BIO_FLAGS_READ);
}

int bio_write(BIO* bio, const char* from, std::size_t size, std::size_t* bytes) {
  const Moved moved = inner_of(bio).write(std::as_bytes(std::span(from, size)));
  return bio_result(bio, moved, bytes, BIO_FLAGS_WRITE);
}

long bio_control(BIO*, int command, long, void*) {
  return command == BIO_CTRL_FLUSH ? 1 : 0;
}

// Made once; OpenSSL wants it to outlive every BIO.
const BIO_METHOD* bio_method() {
  static const BIO_METHOD* const method = [] {
    BIO_METHOD* const made = BIO_meth_new(BIO_get_new_index() | BIO_TYPE_SOURCE_SINK, "stepwright transport");
    BIO_meth_set_read_ex(made, bio_read);
    BIO_meth_set_write_ex(made, bio_write);
    BIO_meth_set_ctrl(made, bio_control);
    return made;
  }();
  return method;
}

}  // namespace

TlsTransport::TlsTransport(std::unique_ptr<Transport> inner, const TlsContext& context,
                           const OnRefused& on_refused)
    : inner_(std::move(inner)),
      context_(context),
      on_refused_(on_refused),
      ssl_(SSL_new(context.native().context.get())),
      begun_(Clock::now()) {
  BIO* const bio = BIO_new(bio_method());
  if (!ssl_ || bio == nullptr) {
    BIO_free(bio);
    failed_ = true;
    return;
  }
  BIO_set_data(bio, inner_.get());
  BIO_set_init(bio, 1);
  SSL_set_bio(ssl_.get(), bio, bio);
  SSL_set_accept_state(ssl_.get());
}

TlsTransport::~TlsTransport() {
  // The close_notify alert that tells a planned end from a cut connection; nobody waits for its answer.
  if (ready_ && !failed_) SSL_shutdown(ssl_.get());
  ERR_clear_error();
}

Moved TlsTransport::refuse(const std::string& reason) {
  failed_ = true;
  if (!ready_ && on_refused_) on_refused_(inner_->peer() == nullptr ? "" : inner_->peer()->address, reason);
  return {Moved::State::Closed, 0};
}

// What a call of OpenSSL came to.
Moved TlsTransport::after(int result, std::size_t bytes) {
  needs_writable_ = false;
  if (result > 0) return {Moved::State::Done, bytes};
  switch (SSL_get_error(ssl_.get(), result)) {
    case SSL_ERROR_WANT_WRITE:
      needs_writable_ = true;
      return {Moved::State::WouldBlock, 0};
    case SSL_ERROR_WANT_READ:
      return {Moved::State::WouldBlock, 0};
    default:
      break;
  }
  const long verified = SSL_get_verify_result(ssl_.get());
  if (!ready_ && verified != X509_V_OK) return refuse(X509_verify_cert_error_string(verified));
  return refuse(ERR_peek_last_error() == 0 ? "the connection ended in the handshake" : openssl_reason());
}

bool TlsTransport::admit_peer() {
  const Certificate certificate(SSL_get1_peer_certificate(ssl_.get()));
  // The handshake has seen to both; whoever changes its policy must not let anybody in by it.
  if (!certificate || SSL_get_verify_result(ssl_.get()) != X509_V_OK) return false;
  std::optional<std::string> role = role_of(certificate.get());
  if (!role || inner_->peer() == nullptr) return false;
  peer_ = {inner_->peer()->address, std::move(*role), true};
  ready_ = true;
  return true;
}

bool TlsTransport::shake_hands(Moved& waiting) {
  if (ready_) return true;
  if (Clock::now() - begun_ > context_.handshake()) {
    waiting = refuse("the handshake took too long");
    return false;
  }
  waiting = after(SSL_do_handshake(ssl_.get()), 0);
  if (waiting.state != Moved::State::Done) return false;
  if (admit_peer()) return true;
  waiting = refuse("the role in its certificate is none");
  return false;
}

Moved TlsTransport::read(std::span<std::byte> into) {
  if (failed_) return {Moved::State::Closed, 0};
  ERR_clear_error();
  Moved waiting;
  if (!shake_hands(waiting)) return waiting;
  std::size_t bytes = 0;
  const int result = SSL_read_ex(ssl_.get(), into.data(), into.size(), &bytes);
  return after(result, bytes);
}

Moved TlsTransport::write(std::span<const std::byte> from) {
  if (failed_) return {Moved::State::Closed, 0};
  ERR_clear_error();
  Moved waiting;
  if (!shake_hands(waiting)) return waiting;
  std::size_t bytes = 0;
  const int result = SSL_write_ex(ssl_.get(), from.data(), from.size(), &bytes);
  return after(result, bytes);
}

// SSL_has_pending would also count the half of a record that nobody can read yet.
bool TlsTransport::has_buffered() const {
  return !failed_ && ready_ && SSL_pending(ssl_.get()) > 0;
}

}  // namespace stepwright::modbus::server
