#pragma once

// The listening socket of a service, and the lock beside it that says whose it is.
//
// Threads: one.

#include <filesystem>
#include <string>

#include "runtime/ground/files/descriptor.h"
#include "runtime/ground/result/result.h"

namespace stepwright::service::internal {

using files::Descriptor;

class Listener {
 public:
  // Binds `path` for the owner's user only (mode 0600). A socket that a killed process left is replaced; one
  // that is in use is R0001, as are a path that is too long or that names another file.
  [[nodiscard]] static result::Result<Listener> bind(const std::filesystem::path& path);
  Listener(Listener&&) = default;
  Listener& operator=(Listener&&) = delete;
  ~Listener();

  int descriptor() const { return socket_.get(); }
  // The next client, if one waits.
  Descriptor accept() const;

 private:
  Listener(std::filesystem::path path, Descriptor lock, Descriptor socket);

  std::filesystem::path path_;
  Descriptor lock_;
  Descriptor socket_;
};

}  // namespace stepwright::service::internal
