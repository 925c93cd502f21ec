#include "hmi_web/server/request_policy.h"

#include <algorithm>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::server {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = naming::to_lower(c);
  return result;
}

}  // namespace

RequestPolicy::RequestPolicy(const ListenAddress& address, protocol::Assets assets)
    : scheme_(address.tls() ? "https://" : "http://"), assets_(assets) {
  std::vector<std::string> hosts = address.names;
  hosts.insert(hosts.end(), {"localhost", "127.0.0.1", "::1"});
  // All addresses of a machine are a name of none.
  if (address.host != "0.0.0.0" && address.host != "::") hosts.push_back(address.host);
  for (const std::string& host : hosts) {
    const bool is_ipv6 = host.find(':') != std::string::npos;
    const std::string own = is_ipv6 ? "[" + lower(host) + "]" : lower(host);
    authorities_.push_back(own + ":" + std::to_string(address.port));
    // Browsers leave the default port out.
    if (address.port == (address.tls() ? 443 : 80)) authorities_.push_back(own);
  }
}

Decision RequestPolicy::decide(const RequestHead& request) const {
  if (!is_own_authority(request.host)) return {403, nullptr, "this name is not served here"};
  if (request.method != "GET" && request.method != "HEAD") return {405, nullptr, "only GET and HEAD"};

  const std::string_view path = request.target.substr(0, request.target.find('?'));
  if (path == kLivePath) {
    if (!request.upgrade || request.method != "GET") return {426, nullptr, "this is a WebSocket"};
    // Programs that are no browser send no Origin; a browser always does.
    if (!request.origin.empty() && !is_own_origin(request.origin)) {
      return {403, nullptr, "not from this page"};
    }
    return {101};
  }
  if (path == kMetricsPath) return {200};
  const auto asset =
      std::find_if(assets_.begin(), assets_.end(), [&](const auto& entry) { return entry.path == path; });
  if (asset == assets_.end()) return {404, nullptr, "there is nothing here"};
  return {request.if_none_match == asset->etag ? 304u : 200u, &*asset};
}

bool RequestPolicy::is_own_authority(std::string_view authority) const {
  return std::find(authorities_.begin(), authorities_.end(), lower(authority)) != authorities_.end();
}

bool RequestPolicy::is_own_origin(std::string_view origin) const {
  return origin.starts_with(scheme_) && is_own_authority(origin.substr(scheme_.size()));
}

}  // namespace stepwright::server
