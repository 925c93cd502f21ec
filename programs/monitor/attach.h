#pragma once

// A runtime as a monitor sees it: its service, its program by names, its newest image.
//
//   auto runtime = Attached::open(config, service::Role::Observer);
//   auto sample = (*runtime)->sample();
//   reader::read_text(variable, sample->image);
//
// Threads: one.

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/service/connection.h"

namespace stepwright::monitor {

inline constexpr std::chrono::seconds kPatience{5};

class Attached {
 public:
  // Fails with R0001: no runtime serves the cell's socket.
  [[nodiscard]] static result::Result<std::unique_ptr<Attached>> open(const config::CellConfig& config,
                                                                      service::Role role);

  service::Connection& connection() { return *connection_; }
  [[nodiscard]] result::Result<service::Reply> ask(service::RequestBody body) {
    return connection_->call(std::move(body), kPatience);
  }

  // The program that is loaded now. Fails with R0002 without one.
  [[nodiscard]] result::Result<void> read_program();
  const reader::ProgramInfo& program() const { return *info_; }
  const std::string& digest() const { return digest_; }

  // The image between two scans of the program that was read; reads the program again, and says so by
  // program_changed(), if another one has taken its place.
  [[nodiscard]] result::Result<host::Snapshot> sample();
  bool program_changed() { return std::exchange(changed_, false); }

  // The newest status that the runtime has sent; waits for one if none has come yet.
  std::optional<host::RuntimeStatus> status();

 private:
  std::unique_ptr<service::Connection> connection_;
  std::optional<reader::ProgramInfo> info_;
  std::string digest_;
  bool changed_ = false;
  std::optional<host::RuntimeStatus> status_;
};

}  // namespace stepwright::monitor
