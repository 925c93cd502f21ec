#include "hmi_web/server/tls_files.h"

#include "hmi_web/server/internal/wire.h"

namespace stepwright::server {

result::Result<void> check_tls_files(const std::filesystem::path& certificate,
                                     const std::filesystem::path& key) {
  if (auto tls = internal::load_tls(certificate, key); !tls) return result::forward(tls);
  return {};
}

}  // namespace stepwright::server
