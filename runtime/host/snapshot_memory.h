#pragma once

// The image that a runtime publishes, in memory shared with other processes: written between two scans, read
// at any time by anyone who holds the descriptor. Two slots of atomic words that are written in turn: the
// writer never waits, the newest complete snapshot stays where it is while the next one is written (for good,
// if the writer dies), and a reader is overtaken only by the one after that; then it copies again.
//
// Threads: one SnapshotWriter in the runtime, used by the scan thread; any number of SnapshotReaders
// elsewhere. Invariants: the memory is sealed: it can neither shrink nor, from the shared descriptor, be
// written.
//
//   auto writer = SnapshotWriter::create({"level_a1_percent"});
//   writer->publish(7, 60'000'000, digest, image, truths);
//   auto reader = SnapshotReader::open(writer->descriptor());
//   std::optional<Snapshot> snapshot = reader->read();

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/host/messages.h"

namespace stepwright::host {

class SnapshotWriter {
 public:
  // Room for the largest image and the named plant values (kMaxPlantValues, names of kMaxNameBytes; more are
  // an error). Fails with R0077 if the system refuses the memory.
  [[nodiscard]] static result::Result<std::unique_ptr<SnapshotWriter>> create(
      std::span<const std::string> plant_names);
  ~SnapshotWriter();
  SnapshotWriter(const SnapshotWriter&) = delete;
  SnapshotWriter& operator=(const SnapshotWriter&) = delete;

  // No heap, lock or system call. Requires an image within kMaxImageBytes and as many values as names.
  void publish(std::uint64_t scan, std::int64_t time_ns, std::string_view digest,
               std::span<const std::byte> image, std::span<const double> plant);

  // Read-only, to be passed to other processes; stays with the writer.
  int descriptor() const { return shared_; }

 private:
  SnapshotWriter() = default;
  std::byte* memory_ = nullptr;
  int shared_ = -1;
};

// The snapshot while it is being read: what it gives is worth something only if it was not overtaken, which
// SnapshotReader::consistent finds out.
class SnapshotView {
 public:
  // Whether it is of the program with this hexadecimal digest.
  bool is_of(std::string_view digest) const;
  std::uint64_t scan() const;
  // Bytes of the image from `offset` on. False, and nothing copied, beyond its end.
  [[nodiscard]] bool load(std::size_t offset, std::span<std::byte> to) const;

 private:
  friend class SnapshotReader;
  explicit SnapshotView(const std::byte* slot);
  const std::byte* slot_;
  std::size_t image_bytes_ = 0;
};

class SnapshotReader {
 public:
  // Maps what the descriptor names; the descriptor stays with the caller. Fails with R0005 if that is no
  // snapshot.
  [[nodiscard]] static result::Result<std::unique_ptr<SnapshotReader>> open(int descriptor);
  ~SnapshotReader();
  SnapshotReader(const SnapshotReader&) = delete;
  SnapshotReader& operator=(const SnapshotReader&) = delete;

  // The newest snapshot; none before the first, or if every attempt was overtaken (of a writer that publishes
  // without a pause, faster than this thread copies).
  std::optional<Snapshot> read() const;

  // Some bytes of the newest snapshot, all of the same one, without heap: `copy(view)` takes them, once more
  // each time that it was overtaken. False as read() gives none.
  template <typename Copy>
  [[nodiscard]] bool consistent(const Copy& copy) const {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const std::uint64_t newest = sequence();
      if (newest == 0) return false;
      copy(SnapshotView(slot_of(newest)));
      if (untouched(newest)) return true;
      let_others_run(attempt);
    }
    return false;
  }
  // Grows with every snapshot that is published.
  std::uint64_t sequence() const;

 private:
  // Each is a whole copy.
  static constexpr int kAttempts = 1'000;
  SnapshotReader() = default;
  const std::byte* slot_of(std::uint64_t number) const;
  bool untouched(std::uint64_t number) const;
  static void let_others_run(int attempt);
  const std::byte* memory_ = nullptr;
  std::vector<std::string> names_;
};

}  // namespace stepwright::host
