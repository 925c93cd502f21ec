#include "ladder/source/excerpt.h"

#include <algorithm>
#include <vector>

namespace stepwright::source {

namespace {

constexpr std::string_view kDots = "...";

// One character as it is shown.
struct Cell {
  std::string text;
  std::size_t width = 1;
  bool tab = false;
};

struct Range {
  char32_t first;
  char32_t last;
};

constexpr Range kNoWidth[] = {{0x0300, 0x036F}, {0x0483, 0x0489}, {0x0591, 0x05BD}, {0x064B, 0x065F},
                              {0x200B, 0x200D}, {0x2060, 0x2064}, {0x20D0, 0x20F0}, {0xFE00, 0xFE0F},
                              {0xFE20, 0xFE2F}, {0xFEFF, 0xFEFF}};
// Control characters, and those that turn the direction of the text around.
constexpr Range kObeyed[] = {{0x0000, 0x001F}, {0x007F, 0x009F}, {0x061C, 0x061C},
                             {0x200E, 0x200F}, {0x202A, 0x202E}, {0x2066, 0x2069}};
constexpr Range kTwoColumns[] = {{0x1100, 0x115F},   {0x2E80, 0x303E},   {0x3041, 0xA4CF},  {0xAC00, 0xD7A3},
                                 {0xF900, 0xFAFF},   {0xFE30, 0xFE4F},   {0xFF00, 0xFF60},  {0xFFE0, 0xFFE6},
                                 {0x1F300, 0x1F64F}, {0x1F900, 0x1F9FF}, {0x20000, 0x3FFFD}};

bool in_ranges(char32_t code, const Range* begin, const Range* end) {
  return std::any_of(begin, end, [&](const Range& each) { return each.first <= code && code <= each.last; });
}

std::size_t columns_of(char32_t code) {
  if (in_ranges(code, std::begin(kNoWidth), std::end(kNoWidth))) return 0;
  return in_ranges(code, std::begin(kTwoColumns), std::end(kTwoColumns)) ? 2 : 1;
}

// Bytes of the character that begins with `lead`.
std::size_t length_of(unsigned char lead) {
  return lead < 0xC0 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
}

char32_t decode(std::string_view bytes) {
  const auto lead = static_cast<unsigned char>(bytes[0]);
  if (bytes.size() == 1) return lead;
  char32_t code = lead & (0xFFu >> (bytes.size() + 1));
  for (const char c : bytes.substr(1)) code = (code << 6) | (static_cast<unsigned char>(c) & 0x3Fu);
  return code;
}

// The byte where the character with this number begins, or the end of the line.
std::size_t byte_of(std::string_view line, std::size_t character) {
  std::size_t at = 0;
  for (std::size_t seen = 0; at < line.size(); ++at) {
    const bool begins = (static_cast<unsigned char>(line[at]) & 0xC0u) != 0x80u || at == 0;
    if (begins && seen++ == character) break;
  }
  return at;
}

std::vector<Cell> cells_of(std::string_view line) {
  std::vector<Cell> cells;
  for (std::size_t at = 0; at < line.size();) {
    const auto lead = static_cast<unsigned char>(line[at]);
    std::size_t length = 1;
    while (length < length_of(lead) && at + length < line.size() &&
           (static_cast<unsigned char>(line[at + length]) & 0xC0u) == 0x80u)
      ++length;
    const std::string_view bytes = line.substr(at, length);
    const bool whole = length == length_of(lead) && (lead < 0x80 || lead >= 0xC2);
    Cell cell{std::string(bytes), 1, lead == '\t'};
    const char32_t code = whole ? decode(bytes) : 0;
    if (!whole || (in_ranges(code, std::begin(kObeyed), std::end(kObeyed)) && !cell.tab)) {
      cell.text = "?";
    } else if (!cell.tab) {
      cell.width = columns_of(code);
    }
    cells.push_back(std::move(cell));
    at += length;
  }
  return cells;
}

std::size_t width_of(const std::vector<Cell>& cells, std::size_t begin, std::size_t end) {
  std::size_t width = 0;
  for (std::size_t i = begin; i < end; ++i) width += cells[i].width;
  return width;
}

}  // namespace

Excerpt excerpt(std::string_view line, std::uint32_t column, std::size_t width) {
  // Of a very long line only what lies about the place is looked at.
  const std::size_t span = 16 * width;
  std::size_t from = 0;
  std::size_t to = line.size();
  if (line.size() > 4 * span) {
    const std::size_t place = byte_of(line, column > 0 ? column - 1 : 0);
    from = place > span ? place - span : 0;
    while (from < place && (static_cast<unsigned char>(line[from]) & 0xC0u) == 0x80u) ++from;
    to = std::min(place + span, line.size());
    column = static_cast<std::uint32_t>(cells_of(line.substr(from, place - from)).size() + 1);
  }
  const bool more_before = from > 0;
  const bool more_behind = to < line.size();
  const std::vector<Cell> cells = cells_of(line.substr(from, to - from));
  const std::size_t caret = std::min<std::size_t>(column > 0 ? column - 1 : 0, cells.size());
  std::size_t begin = 0;
  std::size_t end = cells.size();
  const bool cut = width_of(cells, 0, end) > width;
  if (cut) {
    // A third of the width before the caret, the rest behind it.
    begin = caret;
    while (begin > 0 && width_of(cells, begin - 1, caret) <= width / 3) --begin;
    end = caret;
    while (end < cells.size() && width_of(cells, begin, end + 1) <= width) ++end;
    while (begin > 0 && end == cells.size() && width_of(cells, begin - 1, end) <= width) --begin;
  }
  Excerpt result;
  if (begin > 0 || more_before) {
    result.line += kDots;
    result.indent.assign(kDots.size(), ' ');
  }
  for (std::size_t i = begin; i < end; ++i) {
    // In a line that was cut the tab stops are others: a tab is a space.
    const bool tab = cells[i].tab && !cut;
    result.line += cells[i].tab ? (tab ? "\t" : " ") : cells[i].text;
    if (i < caret) result.indent += tab ? std::string("\t") : std::string(cells[i].width, ' ');
  }
  if (end < cells.size() || more_behind) result.line += kDots;
  return result;
}

}  // namespace stepwright::source
