#pragma once

// The program that a runtime has without a download: the one that was downloaded last, if it is kept, or else
// the one that the configuration names. What is wrong with it is said, in the status too; the runtime comes
// up and waits for a download.
//
// Threads: the service's. What is kept is written by a thread of its own, as the disk may take its time.
// Invariant: the kept file is always one whole program.
//
//   BootProgram boot(config.boot, *runtime);
//   auto server = Server::create({socket, lost_after, boot.keeper()}, *runtime);
//   if (const auto problems = boot.run(); !problems.empty()) ...

#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "programs/config/retain_config.h"
#include "runtime/host/host_runtime.h"
#include "runtime/result/result.h"

namespace stepwright::cell_runtime {

struct FoundProgram {
  std::filesystem::path file;
  std::vector<std::byte> container;  // not verified yet
};

// The program that a start of this cell would load; nothing if there is none to load. Fails with R0024 and
// R0026.
[[nodiscard]] result::Result<std::optional<FoundProgram>> find_boot_program(
    const config::BootSection& config);

class BootProgram {
 public:
  BootProgram(config::BootSection config, host::HostRuntime& runtime);
  // What is to be kept is kept when it returns.
  ~BootProgram();
  BootProgram(const BootProgram&) = delete;
  BootProgram& operator=(const BootProgram&) = delete;

  // For ServerConfig::on_program; empty if nothing is to be kept. Must not outlive this object.
  std::function<void(std::span<const std::byte>)> keeper();

  // Loads and starts the program, as far as it is asked for. Returns why not, with its place: R0024 and R0026
  // of the file, those of the verifier, R0025 of what it retains.
  result::Diagnostics run();

 private:
  [[nodiscard]] result::Result<void> load_and_start();
  [[nodiscard]] result::Result<void> complete(int commands);
  void keep_on();

  config::BootSection config_;
  host::HostRuntime& runtime_;
  std::string booted_;  // digest of what was loaded at the start, until another program comes

  std::mutex mutex_;  // of the two below
  std::condition_variable news_;
  std::optional<std::vector<std::byte>> next_;  // the newest program, until it is kept
  bool quit_ = false;
  std::thread thread_;
};

}  // namespace stepwright::cell_runtime
