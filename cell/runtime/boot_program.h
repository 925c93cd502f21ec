#pragma once

// The program that a runtime has without a download: the one that was downloaded last, if it is kept, or else
// the one that the configuration names. What is wrong with it, and that it is not one for this cell, is said,
// in the status too; the runtime comes up and waits for a download.
//
// Threads: the service's. What is kept is written by a thread of its own, as the disk may take its time; what
// the disk refuses is tried again. Invariant: the kept file is always one whole program.
//
//   BootProgram boot(config.boot, *runtime);
//   auto server = Server::create({.socket = socket, .persistence = boot.persistence()}, *runtime);
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

#include "cell/config/retain_config.h"
#include "runtime/ground/result/result.h"
#include "runtime/host/host_runtime.h"
#include "runtime/host/notifier.h"
#include "runtime/service/program_persistence.h"

namespace stepwright::cell_runtime {

struct FoundProgram {
  std::filesystem::path file;
  std::vector<std::byte> container;  // not verified yet
};

// The program that a start of this cell would load; nothing if there is none to load. Fails with R0024 and
// R0026.
[[nodiscard]] result::Result<std::optional<FoundProgram>> find_boot_program(
    const config::BootSection& config);

class BootProgram final : private service::ProgramPersistence {
 public:
  // Why a program is not for this cell, before it is loaded; nothing: it is. Empty: every one is.
  using Refusal = std::function<result::Diagnostics(std::span<const std::byte>)>;

  BootProgram(config::BootSection config, host::HostRuntime& runtime, Refusal refusal = {});
  // Returns when the program is kept.
  ~BootProgram() override;
  BootProgram(const BootProgram&) = delete;
  BootProgram& operator=(const BootProgram&) = delete;

  // For ServerConfig::persistence; null if nothing is to be kept.
  service::ProgramPersistence* persistence() { return config_.keep.empty() ? nullptr : this; }

  // Loads and starts the program, as far as it is asked for. Returns why not, with its place: R0024 and R0026
  // of the file, those of the verifier, R0025 of what it retains; those of the refusal.
  result::Diagnostics run();

 private:
  [[nodiscard]] result::Result<void> load_and_start();
  [[nodiscard]] result::Result<void> complete(int commands);
  void keep(std::span<const std::byte> container) override;
  std::optional<result::Diagnostics> outcome() override;
  int descriptor() const override { return decided_.descriptor(); }
  void keep_on();
  void decide(std::optional<result::Diagnostics> outcome);

  config::BootSection config_;
  host::HostRuntime& runtime_;
  const Refusal refusal_;
  std::string booted_;  // digest of what was loaded at the start, until another program comes

  host::Notifier decided_;
  std::mutex mutex_;  // of all below but the thread
  std::condition_variable news_;
  std::optional<std::vector<std::byte>> next_;  // the newest program, until it is kept
  std::optional<result::Diagnostics> outcome_ = result::Diagnostics{};
  bool quit_ = false;
  std::thread thread_;
};

}  // namespace stepwright::cell_runtime
