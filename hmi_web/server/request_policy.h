#pragma once

// Decides what happens to an HTTP request, before and apart from any networking.
//
// A page that some other site planted in the browser can reach a loopback port too. Hence: the Host must be
// one of our names (DNS rebinding), and a WebSocket upgrade that says where it comes from must come from our
// own page (RFC 6455, 10.2).
//
//   RequestPolicy policy({"127.0.0.1", 8080}, assets);
//   Decision decision = policy.decide({"GET", "/", "localhost:8080"});   // status 200, the page
//
// Thread rule: immutable after construction.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hmi_web/protocol/asset.h"

namespace stepwright::server {

struct ListenAddress {
  std::string host = "127.0.0.1";          // a name or an IPv4 or IPv6 address without brackets
  std::uint16_t port = 8080;               // 0 = any free one
  std::string setting = "hmi";             // the table of the configuration that says so, for hints
  std::filesystem::path certificate = {};  // a chain in PEM form; empty: no TLS
  std::filesystem::path key = {};
  std::vector<std::string> names = {};  // what the page is called beside its host, without a port

  bool tls() const { return !certificate.empty(); }
};

struct RequestHead {
  std::string_view method;
  std::string_view target;
  std::string_view host;    // the header; empty = there is none
  std::string_view origin;  // likewise
  std::string_view if_none_match = {};
  bool upgrade = false;  // asks for a WebSocket
};

struct Decision {
  // 101 = upgrade, 200 and 304 = `asset` (without one: the metrics), anything else = an error with `reason`
  unsigned status = 0;
  const protocol::Asset* asset = nullptr;
  std::string_view reason = {};
};

// Sent with every response.
inline constexpr std::array kSecurityHeaders = {
    std::pair<std::string_view, std::string_view>{
        "Content-Security-Policy",
        // Pictures of screens stand in their own files: data of pixels, which cannot run.
        "default-src 'self'; img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors "
        "'none'; object-src 'none'"},
    std::pair<std::string_view, std::string_view>{"X-Content-Type-Options", "nosniff"},
    std::pair<std::string_view, std::string_view>{"X-Frame-Options", "DENY"},
    std::pair<std::string_view, std::string_view>{"Referrer-Policy", "no-referrer"},
    std::pair<std::string_view, std::string_view>{"Cross-Origin-Opener-Policy", "same-origin"},
    std::pair<std::string_view, std::string_view>{"Cross-Origin-Resource-Policy", "same-origin"},
};

inline constexpr std::string_view kLivePath = "/live";        // of the WebSocket
inline constexpr std::string_view kMetricsPath = "/metrics";  // made for each request, where there are any

class RequestPolicy {
 public:
  // The address with the port that is really bound. Its host (unless it means all addresses), its names and
  // the loopback names are ours.
  RequestPolicy(const ListenAddress& address, protocol::Assets assets);

  Decision decide(const RequestHead& request) const;
  // A Host header is one of our names.
  bool is_own_authority(std::string_view authority) const;
  // An Origin header is our own page.
  bool is_own_origin(std::string_view origin) const;

 private:
  std::string_view scheme_;
  std::vector<std::string> authorities_;  // "localhost:8080", in lower case
  protocol::Assets assets_;
};

}  // namespace stepwright::server
