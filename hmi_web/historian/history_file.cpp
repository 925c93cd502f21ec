#include "hmi_web/historian/history_file.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>
#include <unordered_map>

#include "hmi_web/historian/block.h"
#include "runtime/base/byte_reader.h"
#include "runtime/base/crc32c.h"

namespace stepwright::historian {
namespace {

constexpr std::int32_t kApplication = 0x53574849;  // "SWHI"
constexpr std::int32_t kSchemaVersion = 1;
constexpr std::int32_t kPageBytes = 8192;
constexpr std::size_t kDeletedAtOnce = 512;
constexpr std::int64_t kSpareTags = 1024;
constexpr std::uint32_t kGreatestNumber = 1U << 31;  // of a block

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

// A tail (hmi_web/doc/history_format.md): the samples of one write.
constexpr std::uint8_t kTailVersion = 1;

void append_number(std::vector<std::byte>& out, std::uint32_t value) {
  const auto at = out.size();
  out.resize(at + sizeof value);
  std::memcpy(out.data() + at, &value, sizeof value);
}

std::vector<std::byte> encode_tail(const std::vector<OpenRow>& rows) {
  std::vector<std::byte> bytes = {static_cast<std::byte>(kTailVersion)};
  for (const OpenRow& row : rows) {
    append_number(bytes, row.tag.value);
    append_number(bytes, row.number);
    append_number(bytes, static_cast<std::uint32_t>(row.block.size()));
    bytes.insert(bytes.end(), row.block.begin(), row.block.end());
  }
  append_number(bytes, base::crc32c(bytes));
  return bytes;
}

// False if the bytes are no sound tail; `rows` is unchanged then.
bool decode_tail(std::span<const std::byte> bytes, std::vector<OpenRow>& rows) {
  if (bytes.size() < 5) return false;
  const auto content = bytes.first(bytes.size() - 4);
  if (base::ByteReader(bytes.last(4)).read<std::uint32_t>() != base::crc32c(content)) return false;
  base::ByteReader in(content);
  if (in.read<std::uint8_t>() != kTailVersion) return false;
  std::vector<OpenRow> read;
  while (in.ok() && !in.at_end()) {
    OpenRow row;
    row.tag = TagId(in.read<std::uint32_t>());
    row.number = in.read<std::uint32_t>();
    const auto block = in.read_bytes(in.read<std::uint32_t>());
    row.block.assign(block.begin(), block.end());
    read.push_back(std::move(row));
  }
  if (!in.ok()) return false;
  rows.insert(rows.end(), std::make_move_iterator(read.begin()), std::make_move_iterator(read.end()));
  return true;
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
      "INSERT OR REPLACE INTO node(key, last_ns, block, data) VALUES(?, ?, nullif(?, 0), ?)",
      "INSERT INTO tail(data) VALUES(?)",
      "DELETE FROM tail",
      "INSERT OR REPLACE INTO open(tag, number, data) VALUES(?, ?, ?)",
      "SELECT key, block FROM node WHERE block IS NOT NULL AND last_ns < ? ORDER BY last_ns LIMIT ?",
      "DELETE FROM node WHERE key = ?",
      "DELETE FROM block WHERE id = ?"};
  auto made = database_.prepare_all(kTexts);
  if (!made) return result::forward(made);
  statements_.emplace(Statements{std::move((*made)[0]), std::move((*made)[1]), std::move((*made)[2]),
                                 std::move((*made)[3]), std::move((*made)[4]), std::move((*made)[5]),
                                 std::move((*made)[6]), std::move((*made)[7]), std::move((*made)[8])});
  return {};
}

result::Result<std::vector<StoredTag>> HistoryFile::load(result::Diagnostics& warnings) {
  auto tags = load_tags(warnings);
  if (!tags) return tags;
  auto pieces = load_pieces(warnings);
  if (!pieces) return result::forward(pieces);
  std::unordered_map<std::uint32_t, StoredTag*> by_id;
  for (StoredTag& tag : *tags) by_id[tag.row.tag.value] = &tag;
  // Of a tag whose blocks are all deleted only these know how far its numbers have come.
  for (const OpenRow& piece : *pieces) {
    if (const auto found = by_id.find(piece.tag.value); found != by_id.end())
      found->second->next_number = std::max(found->second->next_number, piece.number);
  }
  if (auto done = load_trees(*tags, warnings); !done) return result::forward(done);
  for (const OpenRow& piece : *pieces) {
    const auto found = by_id.find(piece.tag.value);
    if (found == by_id.end() || piece.number != found->second->next_number) continue;  // in a full block
    if (!decode_block(piece.block, found->second->open))
      warnings.push_back(damage(file_, "the newest samples of " + found->second->row.name + " are damaged"));
  }
  for (StoredTag& tag : *tags) {
    std::ranges::stable_sort(tag.open, {}, &Sample::time_ns);
    // What a suppression held was written to be sure, and once more when it was kept.
    const auto twice = std::ranges::unique(tag.open);
    tag.open.erase(twice.begin(), twice.end());
  }
  return tags;
}

result::Result<std::vector<StoredTag>> HistoryFile::load_tags(result::Diagnostics& warnings) {
  auto rows = database_.prepare("SELECT id, name, (SELECT count(*) FROM tag) FROM tag ORDER BY id");
  if (!rows) return result::forward(rows);
  std::vector<StoredTag> tags;
  while (true) {
    auto more = rows->step();
    if (!more) return result::forward(more);
    if (!*more) return tags;
    const std::int64_t id = rows->integer(0);
    // Numbers are given without gaps, and memory is taken up to the greatest.
    if (id < 0 || id >= kMostTags || id >= 2 * rows->integer(2) + kSpareTags) {
      warnings.push_back(damage(file_, "a tag has the impossible number " + std::to_string(id)));
      continue;
    }
    tags.emplace_back().row = {TagId(static_cast<std::uint32_t>(id)), std::string(rows->text(1))};
  }
}

// What is in no full block, in the order in which it was written.
result::Result<std::vector<OpenRow>> HistoryFile::load_pieces(result::Diagnostics& warnings) {
  std::vector<OpenRow> pieces;
  auto open = database_.prepare("SELECT tag, number, data FROM open");
  if (!open) return result::forward(open);
  while (true) {
    auto more = open->step();
    if (!more) return result::forward(more);
    if (!*more) break;
    const auto bytes = open->bytes(2);
    pieces.push_back({TagId(static_cast<std::uint32_t>(open->integer(0))),
                      static_cast<std::uint32_t>(open->integer(1)),
                      {bytes.begin(), bytes.end()}});
  }
  auto tail = database_.prepare("SELECT data FROM tail ORDER BY id");
  if (!tail) return result::forward(tail);
  while (true) {
    auto more = tail->step();
    if (!more) return result::forward(more);
    if (!*more) break;
    if (!decode_tail(tail->bytes(0), pieces))
      warnings.push_back(damage(file_, "the samples of one of the last writes are damaged"));
  }
  std::erase_if(pieces, [&](const OpenRow& piece) {
    if (piece.number <= kGreatestNumber) return false;
    warnings.push_back(damage(file_, "a block has the impossible number " + std::to_string(piece.number)));
    return true;
  });
  return pieces;
}

// The numbers of each tag's blocks, and the nodes that have begun above them.
result::Result<void> HistoryFile::load_trees(std::vector<StoredTag>& tags, result::Diagnostics& warnings) {
  auto ends = database_.prepare("SELECT min(key), max(key), count(*) FROM node WHERE key BETWEEN ? AND ?");
  if (!ends) return result::forward(ends);
  auto children = database_.prepare("SELECT data FROM node WHERE key >= ? AND key < ?");
  if (!children) return result::forward(children);
  for (StoredTag& tag : tags) {
    ends->bind(1, key_of(tag.row.tag, 0, 0)).bind(2, key_of(tag.row.tag, 0, kGreatestNumber));
    if (auto row = ends->step(); !row) return result::forward(row);
    const bool has_blocks = ends->integer(2) > 0;
    if (has_blocks) tag.next_number = std::max(tag.next_number, number_of(ends->integer(1)) + 1);
    tag.first_number = has_blocks ? number_of(ends->integer(0)) : tag.next_number;
    ends->reset();
    if (auto done = load_partials(tag, *children, warnings); !done) return done;
  }
  return {};
}

result::Result<void> HistoryFile::load_partials(StoredTag& tag, storage::Statement& children,
                                                result::Diagnostics& warnings) {
  std::uint32_t end = tag.next_number;
  for (std::uint32_t level = 0; level < kLevels && end > 0; ++level, end /= kFanOut) {
    Summary& partial = tag.partial.emplace_back();
    const std::uint32_t begin = end - end % kFanOut;
    children.bind(1, key_of(tag.row.tag, level, begin)).bind(2, key_of(tag.row.tag, level, end));
    std::uint32_t sound = 0;
    while (true) {
      auto child = children.step();
      if (!child) return result::forward(child);
      if (!*child) break;
      const auto summary = decode_summary(children.bytes(0));
      if (summary) partial.add(*summary);
      sound += summary ? 1 : 0;
      if (!summary) warnings.push_back(damage(file_, "a summary of " + tag.row.name + " is damaged"));
    }
    // A node above that does not tell of all is not written: readers descend to what there is.
    if (sound < end - begin) tag.first_number = std::max(tag.first_number, end << (level * kFanOutBits));
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
  const std::vector<std::byte> tail = encode_tail(set.tail);
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
