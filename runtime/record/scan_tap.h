#pragma once

// The scan thread's end of a recording: writes, after every scan and after every command between two scans,
// the data to run it again. While nothing is recorded every function returns at once.
//
// Threads: the scan thread. No heap, lock, log or system call; what the ring cannot take becomes a gap in the
// recording, from which it goes on with a complete state as soon as there is room: a recording never claims
// a scan that it does not hold, and a scan never waits for its recording (in simulated time the host asks
// has_room() first).
//
//   ScanTap tap;
//   tap.begin(session);
//   tap.state(StateCause::Begin, {digest, cycle, image});
//   ... tap.scanned(report, io, {digest, cycle, image});     // after each scan
//   tap.end("told to");

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/image/force_table.h"
#include "runtime/image/process_image.h"
#include "runtime/record/byte_ring.h"
#include "runtime/record/recording_format.h"
#include "runtime/scan/scan_cycle.h"

namespace stepwright::record {

// State of one recording that scan thread and writer thread share. Owned by the Recorder.
struct Session {
  // Takes all memory that recording needs.
  Session(std::size_t ring_bytes, std::uint32_t hash_every_scans, std::uint32_t keyframe_every_scans);

  ByteRing ring;
  std::vector<std::byte> inputs;          // the scan thread's: of the scan before
  std::vector<std::byte> scratch;         // the scan thread's: for one record without its image
  const std::uint32_t hash_every;         // scans; 1: every scan
  const std::uint32_t keyframe_every;     // scans; 0: none
  std::atomic<bool> failed{false};        // set by the writer: nobody empties the ring any more
  std::atomic<bool> want_segment{false};  // set by the writer: a State is wanted to begin a new file with
  std::atomic<bool> released{false};      // set by the scan thread: it does not know the session any more
  std::atomic<std::uint64_t> scans{0};
  std::atomic<std::uint64_t> gaps{0};
  std::atomic<std::uint64_t> first_gap{0};  // its first scan
};

// Inputs and outcome of the driver in a scan.
struct ScanIo {
  std::span<const std::byte> inputs;  // of the program's input area, as the driver gave them
  bool read_good = true;
  bool write_good = true;
};

// The program that runs.
struct Running {
  std::string_view digest;
  scan::ScanCycle& cycle;
  image::ProcessImage& image;
};

class ScanTap {
 public:
  bool recording() const { return session_ != nullptr; }

  // An earlier recording is given up without an end.
  void begin(Session* session);
  void end(std::string_view reason);

  // False while a scan might not find room. True without a recording.
  bool has_room(std::size_t image_bytes) const;

  void state(StateCause cause, const Running& program);
  void scanned(const scan::ScanReport& report, const ScanIo& io, const Running& program);
  void loaded(std::string_view digest);
  void stopped(std::string_view reason);
  void forced(const image::Force& force);
  void unforced(std::uint32_t address, std::uint8_t bit);
  void wrote(std::uint32_t address, std::span<const std::byte> bytes);

 private:
  bool usable();
  void push(std::span<const std::byte> record);
  bool push_state(StateCause cause, const Running& program);
  bool push_scan(const scan::ScanReport& report, const ScanIo& io);
  void lose(std::uint64_t scan);

  Session* session_ = nullptr;
  std::int64_t time_ns_ = 0;  // of the scan before
  std::int64_t step_ns_ = 0;  // between the two scans before
  std::uint64_t scan_ = 0;
  bool in_gap_ = false;
};

}  // namespace stepwright::record
