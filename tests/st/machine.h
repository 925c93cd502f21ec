#pragma once

// A loaded program with memory of its own on one engine, run scan by scan without I/O.
//
//   Machine machine(loaded, EngineKind::Vm);
//   machine.set("main.go", "TRUE");
//   const scan::ScanReport report = machine.scan();
//   if (!machine.equals("main.x", "5")) ... machine.shown("main.x") ...

#include <memory>
#include <string>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/host/engine_choice.h"
#include "runtime/scan/scan_cycle.h"

namespace stepwright::st_test {

using host::EngineKind;

// Both where the machine has both.
std::vector<EngineKind> engines();
const char* name_of(EngineKind kind);

class Machine {
 public:
  // Requires a program that outlives it. Throws std::runtime_error if the engine cannot take it.
  Machine(const reader::LoadedProgram& program, EngineKind kind);
  ~Machine();

  scan::ScanReport scan();

  // A cold start if the last scan trapped, so that one program shows several traps.
  void restart_after_trap();

  // Values as in tests/st/directive.h. A path without its program means one of `main`. Throw
  // std::runtime_error if there is no such variable or the text is no value of its type.
  void set(const std::string& path, const std::string& value);
  bool equals(const std::string& path, const std::string& expected) const;
  std::string shown(const std::string& path) const;

  // The memory without frames.
  std::span<const std::byte> image() const;

 private:
  struct Parts;
  reader::Variable find(const std::string& path) const;

  std::unique_ptr<Parts> parts_;
};

}  // namespace stepwright::st_test
