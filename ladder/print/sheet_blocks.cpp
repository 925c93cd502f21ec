#include "ladder/print/sheet_blocks.h"

#include <algorithm>
#include <utility>

#include "ladder/graphic/ladder_painter.h"
#include "ladder/graphic/text_wrap.h"
#include "ladder/print/chart_tiles.h"
#include "ladder/print/sheet_title.h"

namespace stepwright::print {

namespace {

using graphic::SvgWriter;

constexpr int kLine = 15;      // of a listing or table
constexpr int kCharacter = 7;  // of its type
constexpr int kNumber = 48;    // room for the number of a line
constexpr int kSmallest = 75;  // percent; a rung that is still too wide goes on in another line

Block text_block(std::string text, const char* css, int height, bool keep) {
  return {height,
          [text = std::move(text), css, height](SvgWriter& svg, int x, int y) {
            svg.text(x, y + height - 8, text, css);
          },
          keep};
}

void append_listing(std::vector<Block>& blocks, const graphic::Listing& listing, const PageFormat& format) {
  const auto width = static_cast<std::size_t>((format.content_width() - kNumber) / kCharacter);
  for (std::size_t i = 0; i < listing.lines.size(); ++i) {
    bool first = true;
    for (std::string& line : graphic::wrap_characters(listing.lines[i], width)) {
      const std::string number = first ? std::to_string(listing.first_line + i) : "";
      first = false;
      blocks.push_back({kLine, [number, line = std::move(line)](SvgWriter& svg, int x, int y) {
                          svg.text(x + kNumber - 14, y + 11, number, "sw-line");
                          svg.code(x + kNumber, y + 11, line, "sw-code");
                        }});
    }
  }
}

// A ladder diagram with everything that its blocks need.
struct LadderPrint {
  graphic::LadderLayout layout;
  graphic::LadderNotes notes;
  int percent = 100;
};

std::shared_ptr<const LadderPrint> lay_out_ladder(const graphic::LadderProgram& program,
                                                  graphic::LadderNotes notes, const PageFormat& format) {
  auto print = std::make_shared<LadderPrint>();
  print->notes = std::move(notes);
  graphic::LadderMetrics metrics = graphic::svg_ladder_metrics();
  metrics.margin = 2;
  metrics.note = 12;
  const int room = format.content_width() - 5;
  const int natural = lay_out(program, metrics).width;
  print->percent = std::clamp(room * 100 / natural, kSmallest, 100);
  metrics.min_width = metrics.max_width = room * 100 / print->percent;
  print->layout = lay_out(program, metrics);
  print->percent = std::min(print->percent, std::max(1, (room + 5) * 100 / print->layout.width));
  for (const graphic::PlacedRung& rung : print->layout.rungs) {
    const int height = rung.bottom - rung.top;
    print->percent = std::min(print->percent, std::max(1, format.content_height() * 100 / height));
  }
  return print;
}

void append_ladder(std::vector<Block>& blocks, const graphic::LadderProgram& program,
                   graphic::LadderNotes notes, const PageFormat& format) {
  const auto print = lay_out_ladder(program, std::move(notes), format);
  for (const graphic::PlacedRung& rung : print->layout.rungs) {
    const int height = (rung.bottom - rung.top) * print->percent / 100;
    blocks.push_back({height, [print, &program, &rung](SvgWriter& svg, int x, int y) {
                        svg.open_moved(x, y - rung.top * print->percent / 100, print->percent);
                        graphic::LadderPainter painter(program, print->layout, svg, &print->notes);
                        painter.rails(rung.top, rung.bottom);
                        painter.rung(rung);
                        svg.close_group();
                      }});
  }
}

void append_chart(std::vector<Block>& blocks, const graphic::SfcChart& chart, const PageFormat& format) {
  const auto tiles = std::make_shared<ChartTiles>(chart, format.content_width(), format.content_height());
  for (std::size_t i = 0; i < tiles->tiles().size(); ++i) {
    Block block{tiles->height_of(i), [tiles, i](SvgWriter& svg, int x, int y) { tiles->draw(svg, i, x, y); }};
    block.placed = [tiles, i](std::size_t page) { tiles->set_page(i, page); };
    blocks.push_back(std::move(block));
  }
  for (const graphic::Action& action : chart.actions) {
    blocks.push_back(text_block("ACTION " + action.name, "sw-heading", 30, true));
    append_listing(blocks, listing_of(action), format);
  }
}

Block row_block(const Cells& cells, const std::vector<std::size_t>& widths, const char* css) {
  const int height = static_cast<int>(lines_of(cells)) * kLine + 4;
  return {height, [cells, widths, css, height](SvgWriter& svg, int x, int y) {
            int at = x;
            int total = 0;
            for (std::size_t column = 0; column < cells.size(); ++column) {
              int line = y + 13;
              for (const std::string& text : cells[column]) {
                svg.text(at, line, text, css);
                line += kLine;
              }
              at += static_cast<int>(widths[column] + 2) * kCharacter;
              total = at - x;
            }
            svg.line(x, y + height, x + total - 2 * kCharacter, y + height, "sw-hair");
          }};
}

}  // namespace

void append_table(std::vector<Block>& blocks, const std::string& heading, const Table& table,
                  const PageFormat& format) {
  if (table.rows.empty()) return;
  const auto widths = column_widths(table, static_cast<std::size_t>(format.content_width() / kCharacter));
  blocks.push_back(text_block(heading, "sw-heading", 30, true));
  auto head = std::make_shared<Block>(row_block(cells_of(table.heads, widths), widths, "sw-head"));
  head->keep = true;
  blocks.push_back(*head);
  for (const auto& row : table.rows) {
    blocks.push_back(row_block(cells_of(row, widths), widths, "sw-cell-text"));
    blocks.back().head = head;
  }
  blocks.push_back({14, [](SvgWriter&, int, int) {}});
}

std::vector<Block> blocks_of(const graphic::Sheet& sheet, const PageFormat& format) {
  std::vector<Block> blocks;
  blocks.push_back(text_block(title_of(sheet), "sw-sheet", 26, true));
  const auto width = static_cast<std::size_t>(format.content_width() / kCharacter);
  if (!sheet.comment.empty())
    for (const std::string& line : graphic::wrap_words(sheet.comment, width))
      blocks.push_back(text_block(line, "sw-cell-text", 18, false));
  append_table(blocks, "Declarations", declaration_table(sheet), format);
  const auto uses = has_references(sheet) ? cross_reference(sheet) : std::vector<VariableUses>{};
  if (const auto* listing = std::get_if<graphic::Listing>(&sheet.body))
    append_listing(blocks, *listing, format);
  if (const auto* ladder = std::get_if<graphic::LadderProgram>(&sheet.body))
    append_ladder(blocks, *ladder, ladder_notes(uses), format);
  if (const auto* chart = std::get_if<graphic::SfcChart>(&sheet.body)) append_chart(blocks, *chart, format);
  append_table(blocks, "Cross references", cross_reference_table(uses), format);
  return blocks;
}

}  // namespace stepwright::print
