#pragma once

// Answers everybody who connects to a Unix socket with one text, and asks such a socket. For this user only.
//
// Threads: the server has its own; `text` is called there.

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "runtime/ground/result/result.h"

namespace stepwright::device_status {

class StatusServer {
 public:
  // Takes the place of a socket that a killed process left. Fails with R0127.
  [[nodiscard]] static result::Result<std::unique_ptr<StatusServer>> create(
      const std::filesystem::path& path, std::function<std::string()> text);
  ~StatusServer();
  StatusServer(const StatusServer&) = delete;
  StatusServer& operator=(const StatusServer&) = delete;

 private:
  StatusServer(std::filesystem::path path, int listener, std::function<std::string()> text);
  void serve();

  std::filesystem::path path_;
  int listener_;
  std::function<std::string()> text_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

// The server's text. Fails with R0127 if there is no server.
[[nodiscard]] result::Result<std::string> ask_status(const std::filesystem::path& path);

}  // namespace stepwright::device_status
