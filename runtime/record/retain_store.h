#pragma once

// The file that holds retained values: their names and types once, the values twice. A write goes to the
// older of the two slots and ends when the disk has it; who reads takes the newest slot that is whole. So a
// crash or a power cut at any instant leaves the values of the write before or of this one. Specified in
// runtime/doc/retain.md.
//
// Threads: one at a time; waits for the disk, and so is not for a scan thread. Any bytes are safe to read.
//
//   auto found = RetainStore::read(path);                    // nothing, values, or why not
//   auto store = RetainStore::create(path, layout, payload, 1);
//   store->write(payload);                                   // returned: it is there for good

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/record/state_layout.h"

namespace stepwright::record {

// Contents of a store: the values of `layout`, in its order.
struct StoredState {
  StateLayout layout;
  std::vector<std::byte> payload;
  std::uint64_t sequence = 0;
  std::string damage;  // what of it is damaged, where the other slot stood in; empty: nothing
};

class RetainStore {
 public:
  static constexpr std::uint16_t kVersion = 1;

  // Nothing if there is no file. Fails with R0023 if it is damaged, foreign or of another version, or if what
  // it holds are no values of their types, with R0024 if it cannot be read; the place of the fault is in the
  // message.
  [[nodiscard]] static result::Result<std::optional<StoredState>> read(const std::filesystem::path& path);

  // Refuses a place that a store must neither replace nor move: a folder, a device, a file that is no store,
  // or one that cannot be read (R0024, with a hint). No file, an empty one and a store, however damaged, are
  // right.
  [[nodiscard]] static result::Result<void> check_place(const std::filesystem::path& path);

  // A file with these values in place of what is there, which stays if this fails (R0024): as at check_place,
  // too.
  [[nodiscard]] static result::Result<RetainStore> create(const std::filesystem::path& path,
                                                          const StateLayout& layout,
                                                          std::span<const std::byte> payload,
                                                          std::uint64_t sequence);
  // To go on with a file that `read` found whole. Fails with R0024.
  [[nodiscard]] static result::Result<RetainStore> resume(const std::filesystem::path& path,
                                                          const StoredState& state);

  // Moves a damaged store aside, to the path with ".damaged" behind it, or ".damaged-N" if that is taken.
  // Fails with R0024, where check_place does, too.
  [[nodiscard]] static result::Result<std::filesystem::path> set_aside(const std::filesystem::path& path);

  RetainStore(RetainStore&& other) noexcept;
  RetainStore& operator=(RetainStore&& other) noexcept;
  ~RetainStore();

  // Requires as many bytes as at the creation. Fails with R0024; then the values of the write before hold,
  // and it may be tried again.
  [[nodiscard]] result::Result<void> write(std::span<const std::byte> payload);

  std::uint64_t sequence() const { return sequence_; }  // of the newest values
  bool is_there() const;  // the path still names the file: nobody removed, moved or replaced it

 private:
  RetainStore() = default;
  [[nodiscard]] result::Result<void> open(const std::filesystem::path& path, const StateLayout& layout);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t digest_ = 0;  // of the layout
  std::size_t first_slot_ = 0;
  std::size_t slot_stride_ = 0;
  std::uint32_t payload_bytes_ = 0;
  std::uint64_t sequence_ = 0;
  std::vector<std::byte> buffer_;  // of one slot
};

}  // namespace stepwright::record
