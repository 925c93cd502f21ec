#pragma once

// A file of the web client as it is embedded in the program: what the client provides and the server serves.

#include <span>
#include <string_view>

namespace stepwright::protocol {

struct Asset {
  std::string_view path;  // "/assets/index-3fa1.js"; the page itself is "/"
  std::string_view content_type;
  std::string_view etag;   // quoted, a hash of the content
  bool immutable = false;  // the path carries a hash of the content: caches may keep it for ever
  std::string_view body;
  std::string_view gzip;  // the same, compressed
};

using Assets = std::span<const Asset>;

}  // namespace stepwright::protocol
