#pragma once

// Records what a runtime does, so that `stepwright replay` can do it again: the service thread's end of a
// recording, and the thread that writes it.
//
//   Recorder recorder;
//   auto session = recorder.begin({.file = "run.swrec"}, facts);
//   tap.begin(*session);                          // the scan thread
//   recorder.announce(digest, container);         // before a further program is loaded
//   tap.end("told to");                           // the scan thread
//   recorder.status().state == RecordingState::Done
//
// Threads: one service thread calls everything here; the writer is the recorder's own. The scan thread knows
// the Session only (scan_tap.h). Destroy it after the scan thread has ended or released its session.
// Invariants: whatever the disk does costs the recording, never a scan; what the writer has taken is in the
// file within kFlushPeriod.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/record/recording_file.h"
#include "runtime/record/scan_tap.h"
#include "runtime/scan/safe_state.h"

namespace stepwright::record {

struct RecordingOptions {
  std::filesystem::path file;
  std::uint64_t max_bytes = 0;           // of the file and the one before it together; 0: no bound
  std::uint32_t hash_every = 1;          // scans
  std::uint32_t keyframe_every = 1'000;  // scans; 0: no keyframes
  std::size_t ring_bytes = 4u << 20;
};

// Facts of the runtime that a replay needs beside its programs.
struct RuntimeFacts {
  bool real_time = false;
  std::uint64_t budget = 0;          // scan::ScanConfig
  scan::SafeMatrix safe_state = {};  // what it refers to must outlive the recorder
};

enum class RecordingState : std::uint8_t { Off = 0, Recording = 1, Done = 2, Failed = 3 };

struct RecordingStatus {
  RecordingState state = RecordingState::Off;
  std::string file;
  std::uint64_t scans = 0;
  std::uint64_t bytes = 0;  // of the newest file
  std::uint64_t gaps = 0;
  std::uint64_t first_gap = 0;  // the scan with which it begins
  std::string problem;          // of RecordingState::Failed
};

class Recorder {
 public:
  static constexpr std::chrono::milliseconds kPollPeriod{10};
  static constexpr std::chrono::milliseconds kFlushPeriod{200};

  Recorder() = default;
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Opens the file and gives the session that the scan thread is to begin. Fails with R0051 (the file), R0052
  // (there is a recording already), R0071 (the system gives no thread) or R0072 (no memory).
  [[nodiscard]] result::Result<Session*> begin(const RecordingOptions& options, RuntimeFacts facts);
  // The session will never reach the scan thread.
  void abandon();
  // A container that may come to be loaded while it records.
  void announce(const std::string& digest, std::span<const std::byte> container);

  bool active() const { return state() == RecordingState::Recording; }
  RecordingStatus status() const;

 private:
  using Container = std::shared_ptr<const std::vector<std::byte>>;

  RecordingState state() const;
  void write_until_end();
  [[nodiscard]] result::Result<void> take(std::span<const std::byte> record);
  [[nodiscard]] result::Result<void> open_file();
  [[nodiscard]] result::Result<void> add_program(const std::string& digest);
  [[nodiscard]] result::Result<void> next_segment();
  Container announced(const std::string& digest);
  void finish(const result::Result<void>& outcome);
  void join();

  RecordingOptions options_;
  RuntimeFacts facts_;
  std::unique_ptr<Session> session_;
  // Of recordings that failed while the scan thread still held them.
  std::vector<std::unique_ptr<Session>> retired_;
  std::thread writer_;
  std::atomic<bool> quit_{false};

  mutable std::mutex mutex_;                                  // of service thread and writer
  std::vector<std::pair<std::string, Container>> announced_;  // with their digests, the newest last
  RecordingStatus status_;

  // The writer's.
  std::unique_ptr<RecordingFile> file_;
  std::uint32_t segment_ = 0;
  std::vector<std::string> written_;  // digests of the programs in the file
  bool ended_ = false;
};

}  // namespace stepwright::record
