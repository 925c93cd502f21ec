#include "tests/fuzz/guarded_run.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "runtime/bytecode/container_parse.h"
#include "runtime/bytecode/program.h"
#include "runtime/vm/interpreter.h"
#include "tests/fuzz/guarded.h"

namespace stepwright::fuzz {

namespace {

using bytecode::Program;
using bytecode::Section;

constexpr std::uint64_t kMostMemory = 1u << 20;
constexpr std::uint64_t kMostSlots = 1u << 16;
constexpr std::uint64_t kMostScratch = 1u << 22;
constexpr std::uint64_t kBudget = 20'000;
constexpr std::int64_t kScanTimes[] = {0, 10'000'000, INT64_MAX};

// A trap lies on an instruction of a function; none has no code.
bool is_plausible(const Program& program, const bytecode::Trap& trap) {
  const bytecode::ContainerView& view = program.container();
  if (!trap) return true;
  return static_cast<std::uint8_t>(trap.code) < bytecode::kTrapCodeCount &&
         trap.function < view.count<Section::Functions>() &&
         trap.pc < view.record<Section::Functions>(trap.function).code_size;
}

bool run_task(const Program& program, std::uint32_t task, std::int64_t now_ns, vm::Interpreter& engine,
              std::span<std::byte> memory, std::vector<std::uint64_t>& traps) {
  const bytecode::ContainerView& view = program.container();
  const bytecode::TaskRecord record = view.record<Section::Tasks>(task);
  for (std::uint32_t i = 0; i < record.call_count; ++i) {
    const auto call = view.record<Section::ProgramCalls>(record.first_call + i);
    std::uint64_t budget = kBudget;
    const bytecode::Trap trap =
        engine.run({call.function, call.instance, now_ns, program.frames_of(task)}, memory, budget);
    traps.insert(traps.end(), {static_cast<std::uint64_t>(trap.code), trap.function, trap.pc, budget});
    if (budget > kBudget || !is_plausible(program, trap)) return false;
  }
  return true;
}

// What the tasks leave in the memory and where they stop, in either form of the interpreter's code.
struct Run {
  bool held = true;
  std::vector<std::uint64_t> traps;  // code, function, pc, the budget that is left
  std::vector<std::byte> memory;
};

Run run_all(const Program& program, bool quick) {
  Guarded<std::uint8_t> memory(program.memory_size());
  Guarded<std::uint64_t> stack(program.sizes().stack_slots);
  const auto initial = program.container().section(Section::InitialData);
  const auto bytes = std::as_writable_bytes(memory.inner());
  std::copy(initial.begin(), initial.end(), bytes.begin());
  Guarded<std::uint8_t> code(program.container().section(Section::Code).size());
  const auto code_bytes = std::as_writable_bytes(code.inner());
  vm::Interpreter engine =
      quick ? vm::Interpreter(program, stack.inner(), code_bytes) : vm::Interpreter(program, stack.inner());
  Run out;
  for (const std::int64_t now_ns : kScanTimes) {
    for (std::uint32_t task = 0; task < program.container().count<Section::Tasks>(); ++task) {
      out.held = out.held && run_task(program, task, now_ns, engine, bytes, out.traps);
    }
  }
  out.held = out.held && memory.intact() && stack.intact() && code.intact();
  out.memory.assign(bytes.begin(), bytes.end());
  return out;
}

Outcome run_program(const Program& program) {
  if (program.memory_size() > kMostMemory || program.sizes().stack_slots > kMostSlots)
    return Outcome::TooLarge;
  const Run plain = run_all(program, false);
  const Run quick = run_all(program, true);
  const bool same = plain.memory == quick.memory && plain.traps == quick.traps;
  return plain.held && quick.held && same ? Outcome::Ran : Outcome::BrokeOut;
}

}  // namespace

void repair_header(std::span<std::byte> bytes) {
  if (bytes.size() < sizeof(bytecode::FileHeader)) return;
  bytecode::FileHeader header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  header.magic = bytecode::kMagic;
  header.version = bytecode::kVersion;
  header.total_bytes = static_cast<std::uint32_t>(bytes.size());
  std::memcpy(bytes.data(), &header, sizeof(header));
  header.checksum = bytecode::container_checksum(bytes);
  std::memcpy(bytes.data(), &header, sizeof(header));
}

Outcome guarded_run(std::span<const std::byte> bytes) {
  const std::uint64_t words = bytecode::verify_scratch_words(bytes);
  if (words > kMostScratch) return Outcome::TooLarge;
  Guarded<std::uint32_t> scratch(static_cast<std::size_t>(words));
  Program program;
  const bool accepted = bytecode::verify(bytes, scratch.inner(), program).ok();
  if (!scratch.intact()) return Outcome::BrokeOut;
  return accepted ? run_program(program) : Outcome::Refused;
}

}  // namespace stepwright::fuzz
