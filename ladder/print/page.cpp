#include "ladder/print/page.h"

#include "ladder/graphic/text_wrap.h"

namespace stepwright::print {

namespace {

void cell(graphic::SvgWriter& svg, int x, int y, int width, const char* label, const std::string& text) {
  svg.text(x + 6, y + 12, label, "sw-small");
  svg.text(x + 6, y + 30, graphic::shortened(text, static_cast<std::size_t>((width - 12) / 8)), "sw-field");
}

}  // namespace

PageFormat format_of(Paper paper) {
  if (paper == Paper::A3) return {420, 297, 1588, 1123};
  return {};
}

void draw_frame(graphic::SvgWriter& svg, const PageFormat& format, const TitleBlock& title) {
  const int left = format.frame_left();
  const int right = format.frame_right();
  const int bottom = format.frame_bottom();
  const int top = bottom - format.title_height();
  const int width = right - left;
  svg.rect(left, format.frame_top(), width, bottom - format.frame_top(), "sw-frame");
  svg.line(left, top, right, top, "sw-rule");
  const int page_width = 110;
  const int rest = width - page_width;
  const int starts[] = {left, left + rest / 4, left + rest * 5 / 8, right - page_width, right};
  for (int i = 1; i < 4; ++i) svg.line(starts[i], top, starts[i], bottom, "sw-rule");
  cell(svg, starts[0], top, starts[1] - starts[0], "Project", title.project);
  cell(svg, starts[1], top, starts[2] - starts[1], "POU", title.sheet);
  cell(svg, starts[2], top, starts[3] - starts[2], "Source", title.file);
  cell(svg, starts[3], top, page_width, "Page",
       std::to_string(title.page) + " of " + std::to_string(title.pages));
}

}  // namespace stepwright::print
