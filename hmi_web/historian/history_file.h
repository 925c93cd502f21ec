#pragma once

// The file of a historian as rows: tags, full blocks with their summaries, summaries of 16, 256, 4096 ...
// blocks, and what is not a full block yet (hmi_web/doc/history_format.md). One writer, any number of
// readers.
//
// Thread rule: an object belongs to one thread at a time; writer and readers have connections of their own.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hmi_web/historian/sample.h"
#include "hmi_web/historian/summary.h"
#include "hmi_web/storage/database.h"
#include "hmi_web/storage/file_lock.h"
#include "runtime/ground/result/result.h"

namespace stepwright::historian {

// A node of a tag's tree: level 0 is a block, a node of level k covers 16 of level k - 1.
inline constexpr std::uint32_t kFanOutBits = 4;
inline constexpr std::uint32_t kFanOut = 1U << kFanOutBits;
inline constexpr std::uint32_t kLevels = 8;
// Ids of tags are below this.
inline constexpr std::uint32_t kMostTags = 1U << 27;

struct BlockRow {
  TagId tag;
  std::uint32_t number = 0;  // counts the tag's blocks, from 0
  Summary summary;
  std::vector<std::byte> block;
};

struct ParentRow {
  TagId tag;
  std::uint32_t level = 1;
  std::uint32_t number = 0;
  Summary summary;
};

// Samples of a block that is not full.
struct OpenRow {
  TagId tag;
  std::uint32_t number = 0;
  std::vector<std::byte> block;
};

struct TagRow {
  TagId tag;
  std::string name;
};

// Rows of one transaction.
struct WriteSet {
  std::vector<TagRow> tags;
  std::vector<OpenRow> tail;  // what has come since the last write, without what is in full blocks
  std::vector<OpenRow> open;  // whole open blocks; not empty: every earlier tail goes
  bool is_checkpoint = false;
};

// State of a tag in a file that was opened.
struct StoredTag {
  TagRow row;
  std::uint32_t first_number = 0;  // of the oldest block behind which all are there
  std::uint32_t next_number = 0;   // of the block that is not full
  std::vector<Sample> open;        // its samples, in order
  std::vector<Summary> partial;    // of the children of the unfinished node of level 1, 2, ...
};

// A block that was deleted.
struct BlockNumber {
  TagId tag;
  std::uint32_t number = 0;
};

struct Kept {
  std::int64_t oldest_ns;        // what ended before it goes; the least integer keeps all
  std::uint64_t most_bytes = 0;  // 0: no bound
};

class HistoryFile {
 public:
  // Makes the file if there is none and takes its lock. Fails with a diagnostic of storage/database.h.
  [[nodiscard]] static result::Result<HistoryFile> open(const std::filesystem::path& file, bool durable,
                                                        std::int64_t most_pages);

  // Once, before anything is written. Damaged rows are left out and told as warnings (S0011).
  [[nodiscard]] result::Result<std::vector<StoredTag>> load(result::Diagnostics& warnings);

  // All or nothing; gives the bytes that went into the tail.
  [[nodiscard]] result::Result<std::size_t> write(const WriteSet& set, const std::vector<BlockRow>& blocks,
                                                  const std::vector<ParentRow>& parents);

  // Deletes the oldest blocks beyond the bounds, a limited number in a call; gives which.
  [[nodiscard]] result::Result<std::vector<BlockNumber>> retain(const Kept& kept);

  [[nodiscard]] result::Result<std::uint64_t> used_bytes() const { return database_.used_bytes(); }

 private:
  HistoryFile(storage::FileLock lock, storage::Database database, std::filesystem::path file)
      : lock_(std::move(lock)), database_(std::move(database)), file_(std::move(file)) {}
  result::Result<void> prepare();
  result::Result<std::vector<StoredTag>> load_tags(result::Diagnostics& warnings);
  result::Result<std::vector<OpenRow>> load_pieces(result::Diagnostics& warnings);
  result::Result<void> load_trees(std::vector<StoredTag>& tags, result::Diagnostics& warnings);
  result::Result<void> load_partials(StoredTag& tag, storage::Statement& children,
                                     result::Diagnostics& warnings);
  result::Result<std::size_t> write_all(const WriteSet& set, const std::vector<BlockRow>& blocks,
                                        const std::vector<ParentRow>& parents);
  result::Result<std::vector<BlockNumber>> delete_oldest(std::int64_t before_ns, std::size_t most);

  struct Statements {
    storage::Statement tag, block, node, tail, clear_tail, open, oldest, delete_node, delete_block;
  };

  storage::FileLock lock_;
  storage::Database database_;
  std::filesystem::path file_;
  std::optional<Statements> statements_;
};

// One connection that reads.
class HistoryView {
 public:
  struct Node {
    std::uint32_t number = 0;
    std::int64_t block = 0;          // level 0: where its samples are
    std::optional<Summary> summary;  // nullopt: damaged
  };

  [[nodiscard]] static result::Result<HistoryView> open(const std::filesystem::path& file);

  // Everything between begin and end is of one state of the file.
  [[nodiscard]] result::Result<void> begin() const { return database_.execute("BEGIN"); }
  void end() const { database_.roll_back(); }

  // The nodes of a level with numbers from `first` to below `end`, in order.
  [[nodiscard]] result::Result<void> nodes(TagId tag, std::uint32_t level, std::uint32_t first,
                                           std::uint32_t end, std::vector<Node>& into);
  // False: there is no such block, or it is damaged.
  [[nodiscard]] result::Result<bool> samples(std::int64_t block, std::vector<Sample>& into);

 private:
  HistoryView(storage::Database database, storage::Statement nodes, storage::Statement block)
      : database_(std::move(database)), nodes_(std::move(nodes)), block_(std::move(block)) {}

  storage::Database database_;
  storage::Statement nodes_, block_;
};

}  // namespace stepwright::historian
