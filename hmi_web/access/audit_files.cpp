#include "hmi_web/access/audit_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <system_error>

#include "hmi_web/storage/private_files.h"

namespace stepwright::access {
namespace {

constexpr std::size_t kPiece = std::size_t{4} << 20;  // read at a time
constexpr std::size_t kLongestLine = std::size_t{1} << 20;
constexpr std::size_t kDigits = 12;

class Pieces {
 public:
  static result::Result<Pieces> open(const std::filesystem::path& file) {
    Pieces made(file);
    std::error_code error;
    made.size_ = std::filesystem::file_size(file, error);
    if (error || !made.in_)
      return result::fail(storage::kFileFails, {file.string(), 0, 0}, "the audit trail cannot be read",
                          "see that the file is there and belongs to this user");
    return made;
  }
  std::uintmax_t size() const { return size_; }
  // Shorter at the end of the file.
  std::string read(std::uintmax_t from, std::size_t bytes) {
    std::string text(static_cast<std::size_t>(std::min<std::uintmax_t>(bytes, size_ - std::min(from, size_))),
                     '\0');
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(from));
    in_.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(in_.gcount(), 0)));
    return text;
  }
  // Of the first line that begins at `from` or behind it; the file's size: there is none.
  std::uintmax_t line_from(std::uintmax_t from) {
    if (from == 0) return 0;
    const std::string text = read(from - 1, kLongestLine);
    const std::size_t end = text.find('\n');
    return end == std::string::npos ? size_ : from + end;
  }
  // Of the first line whose number is not below `number`.
  std::uintmax_t find(std::uint64_t number) {
    std::uintmax_t low = 0, high = size_;
    while (low < high) {
      const std::uintmax_t line = line_from(low + (high - low) / 2);
      if (line >= high || sequence_of(read(line, kDigits + 16)) >= number)
        high = low + (high - low) / 2;
      else
        low = line + 1;
    }
    return line_from(low);
  }

 private:
  explicit Pieces(const std::filesystem::path& file) : in_(file, std::ios::binary) {}
  std::ifstream in_;
  std::uintmax_t size_ = 0;
};

std::uint64_t first_number(const std::filesystem::path& file) {
  auto pieces = Pieces::open(file);
  return pieces ? sequence_of(pieces->read(0, kDigits + 16)) : 0;
}

// The last lines of a text, whole ones, as many as there may be.
std::string_view last_lines(std::string_view text, std::size_t most) {
  std::size_t from = text.size();
  for (; from > 0 && most > 0; --most) {
    const std::size_t end = from >= 2 ? text.rfind('\n', from - 2) : std::string_view::npos;
    from = end == std::string_view::npos ? 0 : end + 1;
  }
  return text.substr(from);
}

// Of one file, before the byte `end`, which begins a line.
std::string end_of(Pieces& pieces, std::uintmax_t end, const MostLines& most) {
  const std::uintmax_t from = pieces.line_from(end - std::min<std::uintmax_t>(end, most.bytes));
  return std::string(
      last_lines(pieces.read(from, static_cast<std::size_t>(end - std::min(from, end))), most.lines));
}

result::Result<void> check_file(const std::filesystem::path& file, TrailCheck& trail) {
  auto pieces = Pieces::open(file);
  if (!pieces) return result::forward(pieces);
  std::uint64_t before = trail.chain.entries;
  for (std::uintmax_t at = 0; at < pieces->size();) {
    const std::string text = pieces->read(at, kPiece);
    if (text.empty()) return {};
    if (trail.first == 0) {
      const auto start = start_of(text);
      trail.first = start ? start->sequence + 1 : 1;
      trail.chain.entries = before = trail.first - 1;
      trail.chain.head = start ? start->head : first_hash();
    }
    trail.chain = check_chain(text, {trail.chain.entries, trail.chain.head});
    const bool goes_on = trail.chain.torn && at + text.size() < pieces->size() && trail.chain.right_bytes > 0;
    if (trail.chain.broken_line > 0 && !goes_on) {
      trail.file = file;
      trail.line = trail.chain.broken_line - before;
      return {};
    }
    trail.chain.broken_line = 0;
    at += trail.chain.right_bytes;
  }
  return {};
}

}  // namespace

std::filesystem::path segment_name(const std::filesystem::path& file, std::uint64_t first) {
  const std::string name =
      file.stem().string() + fmt::format("-{:0{}}", first, kDigits) + file.extension().string();
  return file.parent_path() / name;
}

std::vector<Segment> segments_of(const std::filesystem::path& file) {
  std::vector<Segment> all;
  const std::string begin = file.stem().string() + "-", end = file.extension().string();
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(file.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begin) || !name.ends_with(end) || name.size() < begin.size() + end.size() + kDigits)
      continue;
    const std::string digits = name.substr(begin.size(), name.size() - begin.size() - end.size());
    std::uint64_t first = 0;
    const auto [stop, wrong] = std::from_chars(digits.data(), digits.data() + digits.size(), first);
    if (wrong == std::errc() && stop == digits.data() + digits.size() && first > 0)
      all.push_back({entry.path(), first, entry.file_size(error)});
  }
  std::sort(all.begin(), all.end(), [](const Segment& a, const Segment& b) { return a.first < b.first; });
  if (std::filesystem::exists(file, error))
    all.push_back({file, first_number(file), std::filesystem::file_size(file, error)});
  return all;
}

result::Result<std::string> lines_before(const std::filesystem::path& file, std::uint64_t before,
                                         const MostLines& most) {
  const std::vector<Segment> segments = segments_of(file);
  std::string lines;
  MostLines left = most;
  for (auto each = segments.rbegin(); each != segments.rend() && left.lines > 0 && left.bytes > 0; ++each) {
    if (each->first == 0 || (before > 0 && each->first >= before)) continue;
    auto pieces = Pieces::open(each->file);
    if (!pieces) return result::forward(pieces);
    // What is being written at this moment has no end yet.
    std::uintmax_t end = before > 0 ? pieces->find(before) : pieces->size();
    if (end == pieces->size()) {
      const std::string tail = pieces->read(end - std::min<std::uintmax_t>(end, kLongestLine), kLongestLine);
      end -= tail.size() - (tail.rfind('\n') + 1);
    }
    const std::string more = end_of(*pieces, end, left);
    left.lines -= std::min(left.lines, static_cast<std::size_t>(std::count(more.begin(), more.end(), '\n')));
    left.bytes -= std::min(left.bytes, more.size());
    lines.insert(0, more);
    if (more.size() < end) break;  // what is left of this file comes before any older one
  }
  return lines;
}

result::Result<ChainCheck> check_end(const std::filesystem::path& file, std::size_t bytes,
                                     const ChainStart* start) {
  auto pieces = Pieces::open(file);
  if (!pieces) return result::forward(pieces);
  const std::uintmax_t from =
      pieces->line_from(pieces->size() - std::min<std::uintmax_t>(pieces->size(), bytes));
  const std::string text = pieces->read(from, static_cast<std::size_t>(pieces->size() - from));
  const auto said = start_of(text);
  // The first entry of all follows nothing; the first of a window, or behind what was removed, follows what
  // it says.
  const bool takes_over = said && (from > 0 || (start == nullptr && said->sequence > 0));
  ChainCheck check = check_chain(text, takes_over ? *said : start != nullptr ? *start : ChainStart{});
  check.right_bytes += static_cast<std::size_t>(from);
  return check;
}

result::Result<TrailCheck> check_trail(const std::filesystem::path& file) {
  TrailCheck trail;
  std::vector<Segment> segments = segments_of(file);
  if (segments.empty() || segments.back().file != file) segments.push_back({file, 0, 0});
  for (const Segment& each : segments) {
    if (auto done = check_file(each.file, trail); !done) return result::forward(done);
    if (trail.chain.broken_line > 0) break;
  }
  return trail;
}

}  // namespace stepwright::access
