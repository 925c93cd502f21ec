#pragma once

// Private to this folder: the server's answers as responses of Beast.

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "hmi_web/api/request_guard.h"
#include "hmi_web/protocol/asset.h"
#include "hmi_web/server/request_policy.h"

namespace stepwright::server::internal {

namespace beast = boost::beast;
namespace http = boost::beast::http;

using Response = http::response<http::string_body>;

inline std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

inline void add_common_fields(Response& response) {
  for (const auto& [name, value] : kSecurityHeaders) {
    response.set(beast::string_view(name.data(), name.size()),
                 beast::string_view(value.data(), value.size()));
  }
}

inline void fill_with_asset(Response& response, const Decision& decision, bool accepts_gzip, bool head_only) {
  const protocol::Asset& asset = *decision.asset;
  response.set(http::field::content_type, std::string(asset.content_type));
  response.set(http::field::etag, std::string(asset.etag));
  response.set(http::field::vary, "Accept-Encoding");
  response.set(http::field::cache_control,
               asset.immutable ? "public, max-age=31536000, immutable" : "no-cache");
  if (decision.status == 304) return;
  if (accepts_gzip) response.set(http::field::content_encoding, "gzip");
  const std::string_view body = accepts_gzip ? asset.gzip : asset.body;
  response.content_length(body.size());
  if (!head_only) response.body() = std::string(body);
}

inline void fill_with_metrics(Response& response, std::string text, const std::string& type, bool head_only) {
  response.set(http::field::content_type, type);
  response.set(http::field::cache_control, "no-store");
  response.content_length(text.size());
  if (!head_only) response.body() = std::move(text);
}

inline void fill_with_error(Response& response, const Decision& decision, bool head_only) {
  const std::string body = std::to_string(decision.status) + " " + std::string(decision.reason) + "\n";
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  if (decision.status == 405) response.set(http::field::allow, "GET, HEAD");
  if (decision.status == 426) response.set(http::field::upgrade, "websocket");
  response.content_length(body.size());
  if (!head_only) response.body() = body;
}

inline void fill_with_answer(Response& response, const api::Answer& answer, const std::string& allowed,
                             const std::string& cookie) {
  response.set(http::field::content_type, answer.content_type);
  response.set(http::field::cache_control, answer.etag.empty() ? "no-store" : "private, no-cache");
  if (!answer.etag.empty()) response.set(http::field::etag, answer.etag);
  if (!allowed.empty()) response.set(http::field::allow, allowed);
  if (answer.retry_after.count() > 0)
    response.set(http::field::retry_after, std::to_string(answer.retry_after.count()));
  if (!answer.file_name.empty())
    response.set(http::field::content_disposition, "attachment; filename=\"" + answer.file_name + "\"");
  if (!answer.set_cookie.empty()) {
    const bool ends = answer.set_cookie == "-";
    response.set(http::field::set_cookie, cookie + "=" + (ends ? "; Max-Age=0" : answer.set_cookie) +
                                              "; Path=/; Secure; HttpOnly; SameSite=Strict");
  }
  response.content_length(answer.text.size());
  response.body() = answer.text;
}

}  // namespace stepwright::server::internal
