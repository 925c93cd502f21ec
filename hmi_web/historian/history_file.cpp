#include "hmi_web/historian/history_file.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "hmi_web/historian/block.h"
#include "hmi_web/historian/internal/tail.h"

namespace stepwright::historian {
namespace {

constexpr std::int32_t kApplication = 0x53574849;  // "SWHI"
constexpr std::int32_t kSchemaVersion = 1;
constexpr std::int32_t kPageBytes = 8192;
constexpr std::size_t kDeletedAtOnce = 512;

constexpr const char* kSchema = R"(
CREATE TABLE tag(id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE);
CREATE TABLE block(id INTEGER PRIMARY KEY, data BLOB NOT NULL);
CREATE TABLE node(key INTEGER PRIMARY KEY, last_ns INTEGER, block INTEGER, data BLOB NOT NULL);
CREATE INDEX node_last ON node(last_ns) WHERE block IS NOT NULL;
CREATE TABLE open(tag INTEGER PRIMARY KEY, number INTEGER NOT NULL, data BLOB NOT NULL);
CREATE TABLE tail(id INTEGER PRIMARY KEY, data BLOB NOT NULL);
)";

constexpr std::int64_t key_of(TagId tag, std::uint32_t level, std::uint32_t number) {
  return static_cast<std::int64_t>(tag.value) << 36 | static_cast<std::int64_t>(level) << 32 | number;
}
constexpr std::uint32_t number_of(std::int64_t key) {
  return static_cast<std::uint32_t>(key & 0xFFFFFFFF);
}
constexpr TagId tag_of(std::int64_t key) {
  return TagId(static_cast<std::uint32_t>(key >> 36));
}

storage::DatabaseOptions options_of(bool read_only, bool durable, std::int64_t most_pages) {
  storage::DatabaseOptions options;
  options.application = kApplication;
  options.schema_version = kSchemaVersion;
  options.read_only = read_only;
  options.durable = durable;
  options.page_bytes = kPageBytes;
  options.most_pages = most_pages;
  return options;
}

result::Diagnostic damage(const std::filesystem::path& file, std::string message) {
  return {
      "S0011", result::Severity::Warning, {file.string()}, std::move(message), "its samples are left out"};
}

}  // namespace

result::Result<HistoryFile> HistoryFile::open(const std::filesystem::path& file, bool durable,
                                              std::int64_t most_pages) {
  auto lock = storage::FileLock::take(file);
  if (!lock) return result::forward(lock);
  auto database = storage::Database::open(file, options_of(false, durable, most_pages), kSchema);
  if (!database) return result::forward(database);
  HistoryFile made(std::move(*lock), std::move(*database), file);
  if (auto ready = made.prepare(); !ready) return result::forward(ready);
  return made;
}

result::Result<void> HistoryFile::prepare() {
  constexpr const char* kTexts[] = {
      "INSERT INTO tag(id, name) VALUES(?, ?)",
      "INSERT INTO block(data) VALUES(?) RETURNING id",
      "INSERT INTO node(key, last_ns, block, data) VALUES(?, ?, nullif(?, 0), ?)",
      "INSERT INTO tail(data) VALUES(?)",
      "DELETE FROM tail",
      "INSERT OR REPLACE INTO open(tag, number, data) VALUES(?, ?, ?)",
      "SELECT key, block FROM node WHERE block IS NOT NULL AND last_ns < ? ORDER BY last_ns LIMIT ?",
      "DELETE FROM node WHERE key = ?",
      "DELETE FROM block WHERE id = ?"};
  std::vector<storage::Statement> made;
  for (const char* text : kTexts) {
    auto statement = database_.prepare(text);
    if (!statement) return result::forward(statement);
    made.push_back(std::move(*statement));
  }
  statements_.emplace(Statements{std::move(made[0]), std::move(made[1]), std::move(made[2]),
                                 std::move(made[3]), std::move(made[4]), std::move(made[5]),
                                 std::move(made[6]), std::move(made[7]), std::move(made[8])});
  return {};
}

result::Result<std::vector<StoredTag>> HistoryFile::load(result::Diagnostics& warnings) {
  auto rows = database_.prepare("SELECT id, name FROM tag ORDER BY id");
  if (!rows) return result::forward(rows);
  std::vector<StoredTag> tags;
  while (true) {
    auto more = rows->step();
    if (!more) return result::forward(more);
    if (!*more) break;
    const std::int64_t id = rows->integer(0);
    if (id < 0 || id >= kMostTags) {
      warnings.push_back(damage(file_, "a tag has the impossible number " + std::to_string(id)));
      continue;
    }
    tags.emplace_back().row = {TagId(static_cast<std::uint32_t>(id)), std::string(rows->text(1))};
  }
  for (StoredTag& tag : tags)
    if (auto done = load_tree(tag, warnings); !done) return result::forward(done);
  if (auto done = load_open(tags, warnings); !done) return result::forward(done);
  return tags;
}

// The number of the next block, and the nodes that have begun above it.
result::Result<void> HistoryFile::load_tree(StoredTag& tag, result::Diagnostics& warnings) {
  auto ends = database_.prepare("SELECT min(key), max(key) FROM node WHERE key BETWEEN ? AND ?");
  if (!ends) return result::forward(ends);
  ends->bind(1, key_of(tag.row.tag, 0, 0)).bind(2, key_of(tag.row.tag, 0, ~0U));
  auto row = ends->step();
  if (!row) return result::forward(row);
  if (ends->text(0).empty()) return {};  // NULL: no block
  tag.first_number = number_of(ends->integer(0));
  tag.next_number = number_of(ends->integer(1)) + 1;
  ends->reset();
  auto children = database_.prepare("SELECT data FROM node WHERE key >= ? AND key < ?");
  if (!children) return result::forward(children);
  std::uint32_t end = tag.next_number;
  for (std::uint32_t level = 0; level < kLevels && end > 0; ++level, end /= kFanOut) {
    Summary& partial = tag.partial.emplace_back();
    children->bind(1, key_of(tag.row.tag, level, end - end % kFanOut))
        .bind(2, key_of(tag.row.tag, level, end));
    while (true) {
      auto child = children->step();
      if (!child) return result::forward(child);
      if (!*child) break;
      if (const auto summary = decode_summary(children->bytes(0))) {
        partial.add(*summary);
      } else {
        warnings.push_back(damage(file_, "a summary of " + tag.row.name + " is damaged"));
      }
    }
  }
  return {};
}

result::Result<void> HistoryFile::load_open(std::vector<StoredTag>& tags, result::Diagnostics& warnings) {
  std::unordered_map<std::uint32_t, StoredTag*> by_id;
  for (StoredTag& tag : tags) by_id[tag.row.tag.value] = &tag;
  const auto take = [&](TagId id, std::uint32_t number, std::span<const std::byte> block) {
    const auto found = by_id.find(id.value);
    if (found == by_id.end() || number != found->second->next_number) return;  // in a full block since
    if (!decode_block(block, found->second->open))
      warnings.push_back(damage(file_, "the newest samples of " + found->second->row.name + " are damaged"));
  };
  auto open = database_.prepare("SELECT tag, number, data FROM open");
  if (!open) return result::forward(open);
  while (true) {
    auto more = open->step();
    if (!more) return result::forward(more);
    if (!*more) break;
    take(TagId(static_cast<std::uint32_t>(open->integer(0))), static_cast<std::uint32_t>(open->integer(1)),
         open->bytes(2));
  }
  auto tail = database_.prepare("SELECT data FROM tail ORDER BY id");
  if (!tail) return result::forward(tail);
  while (true) {
    auto more = tail->step();
    if (!more) return result::forward(more);
    if (!*more) break;
    std::vector<OpenRow> rows;
    if (!internal::decode_tail(tail->bytes(0), rows))
      warnings.push_back(damage(file_, "the samples of one of the last writes are damaged"));
    for (const OpenRow& row : rows) take(row.tag, row.number, row.block);
  }
  for (StoredTag& tag : tags) {
    std::ranges::stable_sort(tag.open, {}, &Sample::time_ns);
    // What a suppression held was written to be sure, and once more when it was kept.
    const auto twice = std::ranges::unique(tag.open);
    tag.open.erase(twice.begin(), twice.end());
  }
  return {};
}

result::Result<std::size_t> HistoryFile::write(const WriteSet& set, const std::vector<BlockRow>& blocks,
                                               const std::vector<ParentRow>& parents) {
  if (auto begun = database_.execute("BEGIN IMMEDIATE"); !begun) return result::forward(begun);
  auto written = write_all(set, blocks, parents);
  if (written) {
    if (auto committed = database_.execute("COMMIT"); committed)
      return written;
    else
      written = result::forward(committed);
  }
  database_.roll_back();
  return written;
}

result::Result<std::size_t> HistoryFile::write_all(const WriteSet& set, const std::vector<BlockRow>& blocks,
                                                   const std::vector<ParentRow>& parents) {
  Statements& sql = *statements_;
  for (const TagRow& tag : set.tags) {
    auto done = sql.tag.bind(1, std::int64_t{tag.tag.value}).bind(2, tag.name).run();
    if (!done) return result::forward(done);
  }
  for (const BlockRow& row : blocks) {
    auto made = sql.block.bind(1, row.block).step();
    if (!made) return result::forward(made);
    const std::int64_t id = sql.block.integer(0);
    if (auto ended = sql.block.run(); !ended) return result::forward(ended);
    const auto summary = encode(row.summary);
    sql.node.bind(1, key_of(row.tag, 0, row.number)).bind(2, row.summary.last.time_ns).bind(3, id);
    if (auto done = sql.node.bind(4, summary).run(); !done) return result::forward(done);
  }
  for (const ParentRow& row : parents) {
    const auto summary = encode(row.summary);
    sql.node.bind(1, key_of(row.tag, row.level, row.number)).bind(2, row.summary.last.time_ns);
    auto done = sql.node.bind(3, std::int64_t{0}).bind(4, summary).run();
    if (!done) return result::forward(done);
  }
  for (const OpenRow& row : set.open) {
    sql.open.bind(1, std::int64_t{row.tag.value}).bind(2, std::int64_t{row.number});
    if (auto done = sql.open.bind(3, row.block).run(); !done) return result::forward(done);
  }
  if (set.is_checkpoint) {
    if (auto done = sql.clear_tail.run(); !done) return result::forward(done);
  }
  if (set.tail.empty()) return 0;
  const std::vector<std::byte> tail = internal::encode_tail(set.tail);
  if (auto done = sql.tail.bind(1, tail).run(); !done) return result::forward(done);
  return tail.size();
}

result::Result<std::vector<BlockNumber>> HistoryFile::retain(const Kept& kept) {
  auto aged = delete_oldest(kept.oldest_ns, kDeletedAtOnce);
  if (!aged || !aged->empty() || kept.most_bytes == 0) return aged;
  auto used = database_.used_bytes();
  if (!used) return result::forward(used);
  if (*used <= kept.most_bytes) return aged;
  const std::uint64_t excess = *used - kept.most_bytes;
  // A block is rarely below half a kilobyte.
  const auto blocks = std::clamp<std::uint64_t>(excess / 512, 1, kDeletedAtOnce);
  return delete_oldest(std::numeric_limits<std::int64_t>::max(), static_cast<std::size_t>(blocks));
}

result::Result<std::vector<BlockNumber>> HistoryFile::delete_oldest(std::int64_t before_ns,
                                                                    std::size_t most) {
  struct Row {
    std::int64_t key, block;
  };
  std::vector<Row> rows;
  Statements& sql = *statements_;
  sql.oldest.bind(1, before_ns).bind(2, static_cast<std::int64_t>(most));
  while (true) {
    auto more = sql.oldest.step();
    if (!more) return result::forward(more);
    if (!*more) break;
    rows.push_back({sql.oldest.integer(0), sql.oldest.integer(1)});
  }
  if (rows.empty()) return std::vector<BlockNumber>();
  const auto delete_all = [&]() -> result::Result<void> {
    for (const Row& row : rows) {
      // A node above tells of the block that goes, and must go, too; readers descend where there is none.
      for (std::uint32_t level = 0; level < kLevels; ++level) {
        const std::uint32_t number = number_of(row.key) >> (level * kFanOutBits);
        if (auto done = sql.delete_node.bind(1, key_of(tag_of(row.key), level, number)).run(); !done)
          return done;
      }
      if (auto done = sql.delete_block.bind(1, row.block).run(); !done) return done;
    }
    return database_.execute("COMMIT");
  };
  if (auto begun = database_.execute("BEGIN IMMEDIATE"); !begun) return result::forward(begun);
  if (auto done = delete_all(); !done) {
    database_.roll_back();
    return result::forward(done);
  }
  std::vector<BlockNumber> deleted;
  for (const Row& row : rows) deleted.push_back({tag_of(row.key), number_of(row.key)});
  return deleted;
}

result::Result<HistoryView> HistoryView::open(const std::filesystem::path& file) {
  auto database = storage::Database::open(file, options_of(true, false, 0));
  if (!database) return result::forward(database);
  auto nodes = database->prepare("SELECT key, block, data FROM node WHERE key >= ? AND key < ?");
  if (!nodes) return result::forward(nodes);
  auto block = database->prepare("SELECT data FROM block WHERE id = ?");
  if (!block) return result::forward(block);
  return HistoryView(std::move(*database), std::move(*nodes), std::move(*block));
}

result::Result<void> HistoryView::nodes(TagId tag, std::uint32_t level, std::uint32_t first,
                                        std::uint32_t end, std::vector<Node>& into) {
  into.clear();
  nodes_.bind(1, key_of(tag, level, first)).bind(2, key_of(tag, level, end));
  while (true) {
    auto more = nodes_.step();
    if (!more) return result::forward(more);
    if (!*more) return {};
    into.push_back({number_of(nodes_.integer(0)), nodes_.integer(1), decode_summary(nodes_.bytes(2))});
  }
}

result::Result<bool> HistoryView::samples(std::int64_t block, std::vector<Sample>& into) {
  auto row = block_.bind(1, block).step();
  if (!row) return row;
  const bool sound = *row && decode_block(block_.bytes(0), into);
  block_.reset();
  return sound;
}

}  // namespace stepwright::historian
