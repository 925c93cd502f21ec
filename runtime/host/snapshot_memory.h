#pragma once

// The image that a runtime publishes, in memory shared with other processes: written between two scans, read
// at any time by anyone who holds the descriptor. A seqlock of atomic words: the writer never waits, and a
// reader that was overtaken copies again.
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

#include "runtime/host/messages.h"
#include "runtime/result/result.h"

namespace stepwright::host {

class SnapshotWriter {
 public:
  // Room for the largest image and the named plant values (kMaxPlantValues, names of kMaxNameBytes; more are
  // an error). Fails with R0001 if the system refuses the memory.
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
  explicit SnapshotView(const std::byte* memory);
  const std::byte* memory_;
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

  // The newest snapshot; none before the first, or if the writer died in the middle of one.
  std::optional<Snapshot> read() const;

  // Some bytes of the newest snapshot, all of the same one, without heap: `copy(view)` takes them, once more
  // each time the writer came between. False: there is none yet, or the writer has been in the middle of one
  // for too long.
  template <typename Copy>
  [[nodiscard]] bool consistent(const Copy& copy) const {
    for (int attempt = 0; attempt < kPatience; ++attempt) {
      const std::uint64_t before = begin(attempt);
      if (before == 0) return false;
      if (before % 2 != 0) continue;
      copy(SnapshotView(memory_));
      if (unchanged(before)) return true;
    }
    return false;
  }
  // Grows with every snapshot that is published.
  std::uint64_t sequence() const;

 private:
  static constexpr int kPatience = 20'000;
  SnapshotReader() = default;
  std::uint64_t begin(int attempt) const;
  bool unchanged(std::uint64_t before) const;
  const std::byte* memory_ = nullptr;
  std::vector<std::string> names_;
};

}  // namespace stepwright::host
