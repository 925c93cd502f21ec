#include "ladder/graphic/text_canvas.h"

#include <array>
#include <cassert>

namespace stepwright::graphic {
namespace {

// By bits: left 1, right 2, up 4, down 8.
constexpr std::array<const char*, 16> single{" ", "─", "─", "─", "│", "┘", "└", "┴",
                                             "│", "┐", "┌", "┬", "│", "┤", "├", "┼"};
constexpr std::array<const char*, 16> double_horizontal{" ", "═", "═", "═", "│", "╛", "╘", "╧",
                                                        "│", "╕", "╒", "╤", "│", "╡", "╞", "╪"};
constexpr std::array<const char*, 16> double_both{" ", "═", "═", "═", "║", "╝", "╚", "╩",
                                                  "║", "╗", "╔", "╦", "║", "╣", "╠", "╬"};

}  // namespace

TextCanvas::Cell& TextCanvas::at(int x, int y) {
  assert(x >= 0 && y >= 0);
  const auto column = static_cast<std::size_t>(x);
  const auto row = static_cast<std::size_t>(y);
  if (rows_.size() <= row) rows_.resize(row + 1);
  if (rows_[row].size() <= column) rows_[row].resize(column + 1);
  return rows_[row][column];
}

void TextCanvas::text(int x, int y, const std::string& utf8) {
  for (std::size_t i = 0; i < utf8.size();) {
    std::size_t end = i + 1;
    while (end < utf8.size() && (static_cast<unsigned char>(utf8[end]) & 0xC0U) == 0x80U) ++end;
    const bool control = end == i + 1 && static_cast<unsigned char>(utf8[i]) < 0x20;
    at(x++, y).glyph = control ? " " : utf8.substr(i, end - i);
    i = end;
  }
}

void TextCanvas::horizontal(int x1, int x2, int y, bool doubled) {
  for (int x = x1; x <= x2; ++x) {
    Cell& cell = at(x, y);
    cell.left = cell.left || x > x1;
    cell.right = cell.right || x < x2;
    cell.doubled = cell.doubled || doubled;
  }
}

void TextCanvas::vertical(int x, int y1, int y2) {
  for (int y = y1; y <= y2; ++y) {
    Cell& cell = at(x, y);
    cell.up = cell.up || y > y1;
    cell.down = cell.down || y < y2;
    cell.ends = cell.ends || y == y1 || y == y2;
  }
}

void TextCanvas::box(int x, int y, int width, int height, bool doubled) {
  const int right = x + width - 1;
  const int bottom = y + height - 1;
  horizontal(x, right, y, doubled);
  horizontal(x, right, bottom, doubled);
  vertical(x, y, bottom);
  vertical(right, y, bottom);
  if (!doubled) return;
  for (int row = y; row <= bottom; ++row) at(x, row).doubled_up = at(right, row).doubled_up = true;
}

std::string TextCanvas::glyph(const Cell& cell) {
  if (!cell.glyph.empty()) return cell.glyph;
  const bool passes = cell.left && cell.right && cell.up && cell.down && !cell.ends;
  if (passes) return "│";
  const std::size_t bits =
      (cell.left ? 1U : 0U) + (cell.right ? 2U : 0U) + (cell.up ? 4U : 0U) + (cell.down ? 8U : 0U);
  if (cell.doubled_up) return double_both[bits];
  return (cell.doubled ? double_horizontal : single)[bits];
}

std::string TextCanvas::finish() const {
  std::string out;
  for (const std::vector<Cell>& row : rows_) {
    std::string line;
    for (const Cell& cell : row) line += glyph(cell);
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

}  // namespace stepwright::graphic
