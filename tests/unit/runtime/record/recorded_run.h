#pragma once

// The sample program (tests/support/sample_model.h) on random inputs with a tap behind each scan, as the host
// has one, and its replay.

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/writer/container_writer.h"
#include "runtime/record/recorder.h"
#include "runtime/record/recording_reader.h"
#include "runtime/record/replay.h"
#include "runtime/scan/no_clock.h"
#include "runtime/scan/scan_cycle.h"
#include "runtime/vm/interpreter.h"
#include "tests/support/sample_model.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::record {

using support::TemporaryFolder;

// The interpreter with its memory.
class OwningInterpreter final : public bytecode::Engine {
 public:
  explicit OwningInterpreter(const bytecode::Program& program)
      : stack_(program.sizes().stack_slots), interpreter_(program, stack_) {}
  bytecode::Trap run(const bytecode::Invocation& invocation, std::span<std::byte> memory,
                     std::uint64_t& budget) override {
    return interpreter_.run(invocation, memory, budget);
  }
  void set_interrupt(const bytecode::Interrupt* interrupt) override { interpreter_.set_interrupt(interrupt); }

 private:
  std::vector<std::uint64_t> stack_;
  vm::Interpreter interpreter_;
};

inline ReplayOptions interpreted() {
  ReplayOptions options;
  options.engine = [](const bytecode::Program& program) {
    return result::Result<std::unique_ptr<bytecode::Engine>>(std::make_unique<OwningInterpreter>(program));
  };
  return options;
}

// Inputs that change now and then; a device that does not answer when told so.
class RandomIo final : public image::IoDriver {
 public:
  explicit RandomIo(std::uint32_t seed) : random_(seed) {}

  image::IoStatus read_inputs(std::int64_t, std::span<std::byte> inputs) override {
    given.resize(inputs.size());
    if (random_() % 3 == 0) given[random_() % given.size()] = static_cast<std::byte>(random_());
    std::copy(given.begin(), given.end(), inputs.begin());
    return read_good ? image::IoStatus::Good : image::IoStatus::Lost;
  }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte>) override {
    return write_good ? image::IoStatus::Good : image::IoStatus::Lost;
  }

  std::vector<std::byte> given;
  bool read_good = true;
  bool write_good = true;

 private:
  std::mt19937 random_;
};

class RecordedRun {
 public:
  explicit RecordedRun(std::uint32_t seed = 1, std::vector<std::byte> container =
                                                   writer::write_container(support::sample_model()).value())
      : container_(std::move(container)),
        loaded_(reader::LoadedProgram::load(container_, "sample").value()),
        memory_(loaded_.program().memory_size()),
        image_(memory_, scan::layout_of(loaded_.program())),
        safe_outputs_(image_.outputs().size()),
        engine_(loaded_.program()),
        io(seed),
        cycle(loaded_.program(), engine_, image_, safe_outputs_, io, clock_,
              {.budget = kBudget, .safe_state = kSafeState}) {
    cycle.start({});
  }

  static RuntimeFacts facts() { return {false, kBudget, kSafeState}; }
  Running running() { return {kDigest, cycle, image_}; }

  // Begins a recording with the present state.
  result::Result<void> begin(Recorder& recorder, const RecordingOptions& options) {
    auto begun = recorder.begin(options, facts());
    if (!begun) return result::forward(begun);
    recorder.announce(kDigest, container_);
    session = *begun;
    tap.begin(*begun);
    tap.state(StateCause::Begin, running());
    return {};
  }

  void scans(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) scan();
  }
  void scan() {
    const scan::ScanReport report = cycle.run_scan();
    tap.scanned(report, {io.given, io.read_good, io.write_good}, running());
  }

  void start() {
    cycle.start({cycle.next_time_ns(), cycle.scan(), cycle.trace_hash()});
    tap.state(StateCause::Start, running());
  }
  void stop() {
    cycle.stop();
    tap.stopped("test");
  }
  void force(const image::Force& force) {
    EXPECT_TRUE(cycle.forces().set(force, image_.bytes().size()));
    tap.forced(force);
  }
  void unforce(const image::Force& force) {
    EXPECT_TRUE(cycle.forces().clear(force.address, force.bit));
    tap.unforced(force.address, force.bit);
  }
  void write(std::uint32_t address, std::byte value) {
    image_.bytes()[address] = value;
    tap.wrote(address, std::span(&value, 1));
  }

  static constexpr const char* kDigest = "sample";
  static constexpr std::uint64_t kBudget = 1'000'000;
  static constexpr std::array<scan::SafeOutput, 1> kSafe = {{{0, 0x03, scan::SafeMode::Value, 0x02}}};
  static constexpr scan::SafeRules kRules = {kSafe, {}};
  static constexpr scan::SafeMatrix kSafeState = {kRules, kRules, kRules, kRules, kRules, kRules};

 private:
  std::vector<std::byte> container_;
  reader::LoadedProgram loaded_;
  std::vector<std::byte> memory_;
  image::ProcessImage image_;
  std::vector<std::byte> safe_outputs_;
  OwningInterpreter engine_;
  scan::NoClock clock_;

 public:
  RandomIo io;
  scan::ScanCycle cycle;
  ScanTap tap;
  const Session* session = nullptr;  // of the recording
};

// Waits until the writer has ended.
inline RecordingStatus finished(const Recorder& recorder) {
  while (recorder.active()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return recorder.status();
}

// The records of a file.
inline std::vector<std::vector<std::byte>> records_of(const std::string& path) {
  std::vector<std::vector<std::byte>> records;
  auto reader = RecordingReader::open(path);
  EXPECT_TRUE(reader);
  while (reader) {
    auto record = (*reader)->next();
    EXPECT_TRUE(record) << (record ? "" : result::to_string(record.error()));
    if (!record || !*record) break;
    records.emplace_back((*record)->begin(), (*record)->end());
  }
  return records;
}

// Writes records with that many in each chunk.
inline void write_records(const std::string& path, const std::vector<std::vector<std::byte>>& records,
                          std::size_t per_chunk) {
  auto file = RecordingFile::create(path);
  ASSERT_TRUE(file);
  for (std::size_t i = 0; i < records.size(); ++i) {
    ASSERT_TRUE((*file)->add(records[i]));
    if ((i + 1) % per_chunk != 0) continue;
    ASSERT_TRUE((*file)->flush());
  }
  ASSERT_TRUE((*file)->close());
}

inline RecordKind kind_of(const std::vector<std::byte>& record) {
  return static_cast<RecordKind>(record[0]);
}

}  // namespace stepwright::record
