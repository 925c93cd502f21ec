#include "tests/fuzz/guarded_run.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "runtime/bytecode/container_parse.h"
#include "runtime/bytecode/program.h"
#include "runtime/native/internal/program_facts.h"
#include "runtime/native/native_engine.h"
#include "runtime/vm/interpreter.h"
#include "tests/fuzz/guarded.h"
#include "tests/fuzz/guarded_new.h"

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

// One engine with its memory.
struct Runner {
  Runner(const Program& program, Side side) : memory(program.memory_size(), side) {
    const auto initial = program.container().section(Section::InitialData);
    std::ranges::copy(initial, bytes().begin());
  }
  std::span<std::byte> bytes() { return std::as_writable_bytes(memory.inner()); }

  Guarded<std::uint8_t> memory;
  std::unique_ptr<bytecode::Engine> engine;
};

struct Result {
  bytecode::Trap trap;
  std::uint64_t budget = kBudget;

  bool operator==(const Result&) const = default;
};

Outcome run_task(const Program& program, std::uint32_t task, std::int64_t now_ns,
                 std::span<const std::unique_ptr<Runner>> runners) {
  const bytecode::ContainerView& view = program.container();
  const bytecode::TaskRecord record = view.record<Section::Tasks>(task);
  for (std::uint32_t i = 0; i < record.call_count; ++i) {
    const auto call = view.record<Section::ProgramCalls>(record.first_call + i);
    Result first;
    for (const auto& each : runners) {
      Result result;
      result.trap = each->engine->run({call.function, call.instance, now_ns, program.frames_of(task)},
                                      each->bytes(), result.budget);
      if (result.budget > kBudget || !is_plausible(program, result.trap)) return Outcome::BrokeOut;
      if (each == runners.front()) first = result;
      if (!(result == first)) return Outcome::Differs;
    }
  }
  return Outcome::Ran;
}

Outcome run_scans(const Program& program, std::span<const std::unique_ptr<Runner>> runners) {
  for (const std::int64_t now_ns : kScanTimes) {
    for (std::uint32_t task = 0; task < program.container().count<Section::Tasks>(); ++task) {
      const Outcome outcome = run_task(program, task, now_ns, runners);
      if (outcome != Outcome::Ran) return outcome;
    }
    for (const auto& each : runners) {
      if (!each->memory.intact()) return Outcome::BrokeOut;
      if (!std::ranges::equal(each->bytes(), runners.front()->bytes())) return Outcome::Differs;
    }
  }
  return Outcome::Ran;
}

// The engine's slots lie at the guard, too.
std::unique_ptr<native::NativeEngine> native_engine(const Program& program, Side side,
                                                    native::NativeEngine::Form form) {
  const std::size_t bytes = (native::ProgramFacts(program).context_bytes() + 7) / 8 * 8;
  const GuardedSize guard(bytes, side);
  auto compiled = native::NativeEngine::compile(program, form);
  // A verified program can always be compiled.
  if (!compiled || GuardedSize::live() == 0) std::abort();
  return std::move(*compiled);
}

Outcome run_program(const Program& program, Side side) {
  if (program.memory_size() > kMostMemory || program.sizes().stack_slots > kMostSlots)
    return Outcome::TooLarge;
  Guarded<std::uint64_t> stack(program.sizes().stack_slots, side);
  Guarded<std::uint8_t> quick_code(program.container().section(Section::Code).size(), side);
  std::vector<std::unique_ptr<Runner>> runners;
  const native::NativeEngine* checked = nullptr;  // the last of them
  runners.push_back(std::make_unique<Runner>(program, side));
  runners.back()->engine = std::make_unique<vm::Interpreter>(program, stack.inner());
  runners.push_back(std::make_unique<Runner>(program, side));
  runners.back()->engine =
      std::make_unique<vm::Interpreter>(program, stack.inner(), std::as_writable_bytes(quick_code.inner()));
  if (native::NativeEngine::supported()) {
    for (const auto form : {native::NativeEngine::Form::Plain, native::NativeEngine::Form::Checked}) {
      auto engine = native_engine(program, side, form);
      checked = engine.get();
      runners.push_back(std::make_unique<Runner>(program, side));
      runners.back()->engine = std::move(engine);
    }
  }
  const Outcome outcome = run_scans(program, runners);
  if (outcome == Outcome::Ran && checked != nullptr && checked->broken_check()) return Outcome::Differs;
  return stack.intact() && quick_code.intact() ? outcome : Outcome::BrokeOut;
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

Outcome guarded_run(std::span<const std::byte> bytes, Side side) {
  const std::uint64_t words = bytecode::verify_scratch_words(bytes);
  if (words > kMostScratch) return Outcome::TooLarge;
  Guarded<std::uint32_t> scratch(static_cast<std::size_t>(words), side);
  Program program;
  const bool accepted = bytecode::verify(bytes, scratch.inner(), program).ok();
  if (!scratch.intact()) return Outcome::BrokeOut;
  return accepted ? run_program(program, side) : Outcome::Refused;
}

}  // namespace stepwright::fuzz
