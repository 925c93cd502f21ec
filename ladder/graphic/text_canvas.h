#pragma once

// A canvas of characters with box-drawing lines for terminals. Internal to this folder.
// Lines join where one ends on another; where two only pass each other the vertical one is drawn through.

#include <cstdint>
#include <string>
#include <vector>

namespace stepwright::graphic {

class TextCanvas {
 public:
  void text(int x, int y, const std::string& utf8);
  void horizontal(int x1, int x2, int y, bool doubled = false);
  void vertical(int x, int y1, int y2);
  void box(int x, int y, int width, int height, bool doubled);
  // Lines end with a line feed and hold no trailing spaces.
  std::string finish() const;

 private:
  // Lines that meet in one cell.
  struct Cell {
    bool left = false;
    bool right = false;
    bool up = false;
    bool down = false;
    bool doubled = false;     // the horizontal part
    bool doubled_up = false;  // the vertical part
    bool ends = false;        // a vertical line ends here
    std::string glyph;        // text wins over lines
  };
  Cell& at(int x, int y);
  static std::string glyph(const Cell& cell);

  std::vector<std::vector<Cell>> rows_;
};

}  // namespace stepwright::graphic
