#pragma once

// A chart cut into tiles that fit a page. Cuts go between symbols; every line that a cut crosses has a
// reference at both ends. Internal to this folder; not thread-safe.
//
// Of all the ways - sizes down to a readable one, conditions wrapped narrower - it takes the one with the
// fewest pages and, among those, with few lines cut and large symbols.

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ladder/graphic/sfc_layout.h"
#include "ladder/graphic/svg_writer.h"
#include "ladder/print/cuts.h"

namespace stepwright::print {

// A part of the layout, in its coordinates; [x1, x2) and [y1, y2).
struct Tile {
  int x1 = 0;
  int y1 = 0;
  int x2 = 0;
  int y2 = 0;
};

// A symbol with its texts, through which no cut may go.
struct Box {
  Interval x;
  Interval y;
};

class ChartTiles {
 public:
  // The chart is sound and outlives this. Width and height of a page's room in pixels.
  ChartTiles(const graphic::SfcChart& chart, int width, int height);

  const std::vector<Tile>& tiles() const { return tiles_; }
  int percent() const { return percent_; }
  // Pixels that a tile takes with its references.
  int height_of(std::size_t tile) const;
  void set_page(std::size_t tile, std::size_t page) { pages_[tile] = page; }
  // Requires the pages of all tiles.
  void draw(graphic::SvgWriter& svg, std::size_t tile, int x, int y) const;

 private:
  bool cut(int width, int height);
  bool cut_band(const std::vector<Box>& boxes, Interval band, int width);
  void number_crossings();
  // The worth of the present cut on pages of this height: the smaller, the better.
  int cost(int height) const;
  std::size_t tile_at(int x, int y) const;
  std::string reference(int x, int y, std::size_t other) const;
  std::string page_of(int x, int y, std::size_t from) const;
  void draw_lines(graphic::SvgWriter& svg, std::size_t tile) const;
  void draw_references(graphic::SvgWriter& svg, const graphic::PlacedLine& line, const Tile& tile) const;
  void draw_symbols(graphic::SvgWriter& svg, std::size_t tile) const;
  std::string jumps_into(const graphic::PlacedStep& step, std::size_t tile) const;

  const graphic::SfcChart* chart_;
  graphic::SfcLayout layout_;
  std::vector<Tile> tiles_;
  std::vector<std::size_t> pages_;
  std::map<std::pair<int, int>, int> crossings_;  // where a cut crosses a line -> its number at this cut
  int percent_ = 100;
};

}  // namespace stepwright::print
