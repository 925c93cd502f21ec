#pragma once

// A page: its frame, its title block and the room between. Lengths are pixels at 96 to the inch. Internal to
// this folder.

#include <cstddef>
#include <string>

#include "ladder/graphic/svg_writer.h"
#include "ladder/print/print.h"

namespace stepwright::print {

struct PageFormat {
  int width_mm = 210;
  int height_mm = 297;
  int width = 794;
  int height = 1123;

  // The frame: 20 mm for the holes at the left, 10 mm at the other sides (ISO 5457).
  int frame_left() const { return 76; }
  int frame_top() const { return 38; }
  int frame_right() const { return width - 38; }
  int frame_bottom() const { return height - 38; }
  int title_height() const { return 40; }
  // The room for the content.
  int left() const { return frame_left() + 12; }
  int top() const { return frame_top() + 14; }
  int content_width() const { return frame_right() - 12 - left(); }
  int content_height() const { return frame_bottom() - title_height() - 12 - top(); }
};

PageFormat format_of(Paper paper);

struct TitleBlock {
  std::string project;
  std::string sheet;
  std::string file;
  std::size_t page = 1;
  std::size_t pages = 1;
};

void draw_frame(graphic::SvgWriter& svg, const PageFormat& format, const TitleBlock& title);

}  // namespace stepwright::print
