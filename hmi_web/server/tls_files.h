#pragma once

// The files of the page's TLS, looked at as the server does at its start. Any thread; reads files.

#include <filesystem>

#include "runtime/ground/result/result.h"

namespace stepwright::server {

// H0003: one of them cannot be read or is no PEM, or the key is that of another certificate.
[[nodiscard]] result::Result<void> check_tls_files(const std::filesystem::path& certificate,
                                                   const std::filesystem::path& key);

}  // namespace stepwright::server
