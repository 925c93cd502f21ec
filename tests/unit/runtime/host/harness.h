#pragma once

// A host runtime on a driver and a plant of the test's own.

#include <gtest/gtest.h>
#include <poll.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "runtime/host/host_runtime.h"
#include "tests/support/patience.h"
#include "tests/support/step_program.h"

namespace stepwright::host {

// A runtime on the real clock.
inline HostConfig real_time() {
  HostConfig config;
  config.clock = ClockMode::Real;
  return config;
}

// Remembers the newest outputs; may be lost; calls `on_read` on the scan thread.
class FakeDriver final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t now_ns, std::span<std::byte> inputs) override {
    if (on_read) on_read(now_ns);
    if (intervenes_.load(std::memory_order_acquire)) late_(now_ns);
    inputs[0] = std::byte{0x5A};
    if (fill) fill(inputs);
    reads.fetch_add(1);
    return lost ? image::IoStatus::Lost : image::IoStatus::Good;
  }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte> outputs) override {
    output.store(std::to_integer<int>(outputs[0]));
    return image::IoStatus::Good;
  }
  std::uint64_t held_reads() const override { return held.load(); }

  // The same as on_read, set once while scans run already.
  void intervene(std::function<void(std::int64_t)> act) {
    late_ = std::move(act);
    intervenes_.store(true, std::memory_order_release);
  }

  std::function<void(std::int64_t)> on_read;       // before anything scans
  std::function<void(std::span<std::byte>)> fill;  // gives the inputs, on the scan thread
  std::atomic<bool> lost{false};
  std::atomic<int> output{-1};
  std::atomic<std::uint64_t> reads{0};
  std::atomic<std::uint64_t> held{0};

 private:
  std::function<void(std::int64_t)> late_;
  std::atomic<bool> intervenes_{false};
};

// One value, which counts the faults injected.
class FakePlant final : public PlantAccess {
 public:
  std::span<const std::string> value_names() const override { return names_; }
  void read_values(std::span<double> values) const override { values[0] = faults_; }
  result::Result<void> inject_fault(const std::string& name, double) override {
    if (name != "leak") return result::fail("C0311", {}, "no fault is called '" + name + "'", "known: leak");
    faults_ = faults_ + 1;
    return {};
  }

 private:
  std::vector<std::string> names_{"faults"};
  double faults_ = 0;
};

class Harness {
 public:
  explicit Harness(const HostConfig& config = {}, bool with_plant = true) : config_(config) {
    auto created = HostRuntime::create(config_, driver, with_plant ? &plant : nullptr);
    EXPECT_TRUE(created);
    if (created) runtime = std::move(*created);
  }

  // The outcome of one command.
  Completion command(Command command) {
    command.ticket = ++ticket_;
    EXPECT_TRUE(runtime->submit(command));
    return completion();
  }
  Outcome command(CommandKind kind) {
    Command command;
    command.kind = kind;
    return this->command(command).outcome;
  }
  Completion download(std::vector<std::byte> container, const std::string& digest = "program") {
    auto loading = runtime->load(++ticket_, std::move(container), digest);
    EXPECT_TRUE(loading) << (loading ? "" : result::to_string(loading.error()));
    return completion();
  }
  // The same; what is refused at once comes as Refused with its problems, too.
  Completion try_load(std::vector<std::byte> container, const std::string& digest) {
    auto loading = runtime->load(++ticket_, std::move(container), digest);
    if (!loading) return {ticket_, Outcome::Refused, loading.error()};
    return completion();
  }
  Outcome load(std::vector<std::byte> container, const std::string& digest = "program") {
    const Completion done = download(std::move(container), digest);
    EXPECT_NE(done.outcome, Outcome::Refused) << result::to_string(done.problems);
    return done.outcome;
  }
  Outcome block(BlockWrite block) {
    auto written = runtime->write(++ticket_, std::move(block));
    EXPECT_TRUE(written) << (written ? "" : result::to_string(written.error()));
    return completion().outcome;
  }
  // As it was published last.
  std::vector<std::byte> image() const {
    return SnapshotReader::open(runtime->snapshot_descriptor()).value()->read()->image;
  }
  Outcome record(const record::RecordingOptions& options) {
    auto begun = runtime->record(++ticket_, options);
    EXPECT_TRUE(begun) << (begun ? "" : result::to_string(begun.error()));
    return completion().outcome;
  }
  // An online change; what is refused at once comes as ChangeOutdated with its problems.
  Completion change(std::vector<std::byte> container, const std::string& digest = "changed",
                    DownloadMode mode = DownloadMode::Change) {
    auto changing = runtime->change(++ticket_, std::move(container), digest, mode);
    if (!changing) return {ticket_, Outcome::ChangeOutdated, changing.error()};
    return completion();
  }
  Outcome start(bool barrier = false) {
    Command command;
    command.kind = CommandKind::Start;
    command.barrier = barrier;
    return this->command(command).outcome;
  }
  Outcome stop(const char* reason = "test") {
    Command command;
    command.kind = CommandKind::Stop;
    command.text = FixedText<kMaxReasonBytes>(reason);
    return this->command(command).outcome;
  }
  Outcome acknowledge(std::uint64_t event) {
    Command command;
    command.kind = CommandKind::Acknowledge;
    command.event = event;
    return this->command(command).outcome;
  }
  // Of the program that is loaded.
  Outcome bits(CommandKind kind, const ImageBits& bits) {
    return command(request(kind, bits, runtime->status().program_digest)).outcome;
  }
  static Command request(CommandKind kind, const ImageBits& bits, const std::string& digest) {
    Command command;
    command.kind = kind;
    command.bits = bits;
    command.program_digest = FixedText<kDigestLetters>(digest);
    return command;
  }

  // The next event; a failure of the test if none comes.
  StepEvent event() {
    StepEvent event;
    const bool came = wait([&] {
      if (auto next = runtime->take_event()) {
        event = std::move(*next);
        return true;
      }
      return false;
    });
    EXPECT_TRUE(came) << "no event came";
    return event;
  }

  // Waits until `condition` holds; it is asked again whenever the runtime has news, and every millisecond.
  bool wait(const std::function<bool()>& condition) {
    const auto deadline = std::chrono::steady_clock::now() + support::kPatience;
    while (std::chrono::steady_clock::now() < deadline) {
      runtime->clear();
      if (condition()) return true;
      pollfd entry{runtime->descriptor(), POLLIN, 0};
      poll(&entry, 1, 1);
    }
    return false;
  }

  FakeDriver driver;
  FakePlant plant;
  std::unique_ptr<HostRuntime> runtime;

 private:
  Completion completion() {
    Completion completion;
    const bool came = wait([&] {
      if (auto next = runtime->take_completion()) {
        completion = std::move(*next);
        return true;
      }
      return false;
    });
    EXPECT_TRUE(came) << "no completion came";
    EXPECT_EQ(completion.ticket, ticket_);
    return completion;
  }

  HostConfig config_;
  std::uint64_t ticket_ = 0;
};

}  // namespace stepwright::host
