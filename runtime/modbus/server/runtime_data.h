#pragma once

// The values of a Stepwright runtime for the server: reads from its shared snapshot, writes by its service.
//
// A thread of its own talks to the runtime: it connects again and again, reads the program and builds its
// map, receives the status, sends writes and takes their answers, so that the server's loop never waits for
// the runtime. Stale values are never returned: without a program, without a connection, when nothing has
// been heard for `stale_after`, or, in real time, when the snapshot does not change for so long (and three
// intervals of the slowest task), every request gets exception 4. So does the moment between two programs: an
// address is only ever looked up in the map of the program that the snapshot is of.
//
// Threads: ProcessData's functions on the server's; create and destroy it there too. `news` is called on the
// inner thread.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/modbus/map/map_config.h"
#include "runtime/modbus/server/process_data.h"

namespace stepwright::modbus::server {

struct RuntimeDataOptions {
  std::filesystem::path socket;
  map::MapConfig map;
  bool writes = false;     // false: it attends as an observer, who can change nothing
  bool real_time = false;  // the snapshot has to change
  std::chrono::milliseconds stale_after{1'000};
  std::chrono::milliseconds write_timeout{2'000};  // then exception 4; whether it was written is not known
};

// Report of the inner thread: a kind for the log and a sentence.
using News =
    std::function<void(const char* kind, const std::string& text, const result::Diagnostics& problems)>;

class RuntimeData final : public ProcessData {
 public:
  // Fails with R0101: the system gives no descriptors. It does not wait for the runtime.
  [[nodiscard]] static result::Result<std::unique_ptr<RuntimeData>> create(const RuntimeDataOptions& options,
                                                                           News news);
  ~RuntimeData() override;

  pdu::Exception read(const pdu::Request& request, std::span<std::byte> table) override;
  pdu::Exception begin_write(std::uint64_t ticket, const pdu::Request& request) override;
  std::optional<Written> take_written() override;
  int descriptor() const override;
  void clear() override;

  // Whether a program can be read now.
  bool serving();

 private:
  struct State;
  explicit RuntimeData(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::modbus::server
