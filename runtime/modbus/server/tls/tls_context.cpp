#include "runtime/modbus/server/tls/tls_context.h"

#include <sys/stat.h>

#include <ctime>
#include <string>
#include <utility>

#include "runtime/modbus/server/tls/internal/native.h"

namespace stepwright::modbus::server {

namespace {

using result::fail;

// TLS 1.2 with forward secrecy and authenticated encryption only; TLS 1.3 has nothing else.
constexpr const char* kCiphers = "ECDHE+AESGCM:ECDHE+CHACHA20:!aNULL";
constexpr unsigned char kSessionContext[] = "stepwright-modbus";

tl::unexpected<result::Diagnostics> unreadable(const TlsOptions& options, const char* what,
                                               const std::filesystem::path& file, const char* hint) {
  return fail("R0114", options.where,
              "cannot read " + std::string(what) + " from " + file.string() + ": " + openssl_reason(), hint);
}

bool others_may_read(const std::filesystem::path& file) {
  struct stat found {};
  return ::stat(file.c_str(), &found) == 0 && (found.st_mode & (S_IROTH | S_IWOTH)) != 0;
}

// Asked for the passphrase of a key. Without it OpenSSL would ask whoever sits at the terminal, and the
// server would wait for an answer.
int no_passphrase(char*, int, int, void*) {
  return 0;
}

// Policy of the connections; no file is involved.
bool set_policy(SSL_CTX* context) {
  SSL_CTX_set_options(context, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION | SSL_OP_NO_TICKET |
                                   SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_mode(context, SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER |
                                SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_default_passwd_cb(context, no_passphrase);
  SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_verify(context, SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, nullptr);
  return SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION) == 1 &&
         SSL_CTX_set_num_tickets(context, 0) == 1 && SSL_CTX_set_cipher_list(context, kCiphers) == 1 &&
         SSL_CTX_set_session_id_context(context, kSessionContext, sizeof kSessionContext - 1) == 1;
}

bool load_revoked(SSL_CTX* context, const std::filesystem::path& file) {
  X509_STORE* const store = SSL_CTX_get_cert_store(context);
  X509_LOOKUP* const lookup = X509_STORE_add_lookup(store, X509_LOOKUP_file());
  if (lookup == nullptr || X509_load_crl_file(lookup, file.c_str(), X509_FILETYPE_PEM) <= 0) return false;
  return X509_STORE_set_flags(store, X509_V_FLAG_CRL_CHECK) == 1;
}

}  // namespace

result::Result<TlsContext> TlsContext::create(const TlsOptions& options) {
  ERR_clear_error();
  SslContext owner(SSL_CTX_new(TLS_server_method()));
  SSL_CTX* const context = owner.get();
  if (context == nullptr || !set_policy(context))
    return fail("R0114", options.where, "OpenSSL has no TLS 1.2: " + openssl_reason(), "");
  if (SSL_CTX_use_certificate_chain_file(context, options.certificate.c_str()) != 1)
    return unreadable(options, "the server's certificate", options.certificate,
                      "a PEM file that begins with the server's own certificate");
  if (others_may_read(options.key))
    return fail("R0116", options.where, "everybody on this machine may read the key " + options.key.string(),
                "chmod 600 it, and make a new one if others could have read it");
  if (SSL_CTX_use_PrivateKey_file(context, options.key.c_str(), SSL_FILETYPE_PEM) != 1) {
    const bool other = ERR_GET_REASON(ERR_peek_last_error()) == X509_R_KEY_VALUES_MISMATCH;
    if (!other)
      return unreadable(options, "the server's key", options.key, "a PEM file without a passphrase");
    return fail(
        "R0115", options.where,
        "the key " + options.key.string() + " is not that of the certificate " + options.certificate.string(),
        "");
  }
  if (SSL_CTX_load_verify_file(context, options.authorities.c_str()) != 1)
    return unreadable(options, "the clients' authorities", options.authorities,
                      "a PEM file with the certificates of whoever certifies clients");
  // Clients with several certificates choose by it.
  SSL_CTX_set_client_CA_list(context, SSL_load_client_CA_file(options.authorities.c_str()));
  if (!options.revoked.empty() && !load_revoked(context, options.revoked))
    return unreadable(options, "revocation lists", options.revoked,
                      "a PEM file with a list of every authority");
  ERR_clear_error();
  return TlsContext(std::make_shared<const Native>(Native{std::move(owner)}), options.handshake);
}

std::chrono::system_clock::time_point TlsContext::expires() const {
  const X509* const own = SSL_CTX_get0_certificate(native_->context.get());
  std::tm end{};
  if (own == nullptr || ASN1_TIME_to_tm(X509_get0_notAfter(own), &end) != 1) return {};
  return std::chrono::system_clock::from_time_t(timegm(&end));
}

}  // namespace stepwright::modbus::server
