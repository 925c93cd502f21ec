#include <openssl/ssl.h>

#include <boost/asio/ssl/context.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <vector>

#include "hmi_web/server/internal/wire.h"

namespace stepwright::server::internal {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;

class TlsContext {
 public:
  asio::ssl::context context{asio::ssl::context::tls_server};
};

namespace {

// Asio looks at no more than so many parts of a buffer sequence either.
using Parts = std::vector<asio::const_buffer>;

class PlainWire final : public WireKind {
 public:
  explicit PlainWire(tcp::socket socket) : stream_(std::move(socket)) {}

  void handshake(Done done) override { done({}); }
  void read_some(asio::mutable_buffer room, Moved moved) override {
    stream_.async_read_some(room, std::move(moved));
  }
  void write_some(std::span<const asio::const_buffer> parts, Moved moved) override {
    stream_.async_write_some(Parts(parts.begin(), parts.end()), std::move(moved));
  }
  void end(Done done) override {
    beast::websocket::async_teardown(beast::role_type::server, stream_.socket(), std::move(done));
  }
  beast::tcp_stream& transport() override { return stream_; }

 private:
  beast::tcp_stream stream_;
};

class TlsWire final : public WireKind {
 public:
  TlsWire(tcp::socket socket, asio::ssl::context& context) : stream_(std::move(socket), context) {}

  void handshake(Done done) override {
    stream_.async_handshake(asio::ssl::stream_base::server, std::move(done));
  }
  void read_some(asio::mutable_buffer room, Moved moved) override {
    stream_.async_read_some(room, std::move(moved));
  }
  void write_some(std::span<const asio::const_buffer> parts, Moved moved) override {
    stream_.async_write_some(Parts(parts.begin(), parts.end()), std::move(moved));
  }
  void end(Done done) override { stream_.async_shutdown(std::move(done)); }
  beast::tcp_stream& transport() override { return stream_.next_layer(); }

 private:
  beast::ssl_stream<beast::tcp_stream> stream_;
};

}  // namespace

void TlsContextDeleter::operator()(TlsContext* context) const {
  delete context;
}

result::Result<TlsContextPointer> load_tls(const std::filesystem::path& certificate,
                                           const std::filesystem::path& key) {
  const auto failed = [](const std::filesystem::path& file, const std::string& why) {
    return result::fail("H0003", {file.string(), 0, 0}, "TLS cannot be set up: " + why,
                        "[hmi] tls_certificate is a chain in PEM form, tls_key its private key");
  };
  TlsContextPointer tls(new TlsContext);
  beast::error_code error;
  asio::ssl::context& context = tls->context;
  context.set_options(asio::ssl::context::default_workarounds | asio::ssl::context::no_sslv2 |
                          asio::ssl::context::no_sslv3 | asio::ssl::context::no_tlsv1 |
                          asio::ssl::context::no_tlsv1_1,
                      error);
  SSL_CTX_set_options(context.native_handle(), SSL_OP_NO_RENEGOTIATION);
  context.use_certificate_chain_file(certificate.string(), error);
  if (error) return failed(certificate, error.message());
  context.use_private_key_file(key.string(), asio::ssl::context::pem, error);
  if (error) return failed(key, error.message());
  if (SSL_CTX_check_private_key(context.native_handle()) != 1)
    return failed(key, "the key does not belong to the certificate");
  return tls;
}

std::unique_ptr<WireKind> make_wire(tcp::socket socket, TlsContext* tls) {
  if (tls == nullptr) return std::make_unique<PlainWire>(std::move(socket));
  return std::make_unique<TlsWire>(std::move(socket), tls->context);
}

void beast_close_socket(Wire& wire) {
  beast::error_code ignored;
  wire.kind().transport().socket().close(ignored);
}

}  // namespace stepwright::server::internal
