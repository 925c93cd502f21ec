// The print on pages; see print.h.

#include <utility>

#include "ladder/graphic/svg_style.h"
#include "ladder/print/flow.h"
#include "ladder/print/page.h"
#include "ladder/print/print.h"
#include "ladder/print/sheet_blocks.h"
#include "ladder/print/sheet_title.h"

namespace stepwright::print {

namespace {

// On paper: white, and sizes in which one line of a listing is 15 pixels.
std::string style_of(const PageFormat& format) {
  return graphic::drawing_style() + graphic::ladder_style() + graphic::sfc_style() + R"(.sw-paper{fill:#fff}
.sw-halo{stroke:#fff}
.sw-frame{fill:none;stroke:#111;stroke-width:1.5}
.sw-rule{stroke:#111;stroke-width:1}
.sw-hair{stroke:#bbb;stroke-width:.6}
.sw-drawing text.sw-small{font-size:8px;fill:#555}
.sw-drawing text.sw-sheet{font-size:15px;font-weight:bold}
.sw-drawing text.sw-heading{font-weight:bold}
.sw-drawing text.sw-head{font-size:11px;font-weight:bold}
.sw-drawing text.sw-cell-text,.sw-drawing text.sw-code{font-size:11px}
.sw-drawing text.sw-line{font-size:10px;fill:#777;text-anchor:end}
.sw-drawing text.sw-reference{font-size:9px;text-anchor:middle}
@page{size:)" +
         std::to_string(format.width_mm) + "mm " + std::to_string(format.height_mm) + "mm;margin:0}\n";
}

// Sheets and their first pages.
Table contents(const std::vector<graphic::Sheet>& sheets, const std::vector<std::size_t>& first_pages) {
  Table table{{"Sheet", "Source", "Page"}, {}};
  for (std::size_t i = 0; i < sheets.size(); ++i)
    table.rows.push_back({title_of(sheets[i]), sheets[i].file, std::to_string(first_pages[i])});
  return table;
}

class Document {
 public:
  Document(const std::vector<graphic::Sheet>& sheets, const PrintOptions& options)
      : sheets_(sheets), options_(options), format_(format_of(options.paper)) {
    const bool several = sheets.size() > 1;
    if (several) {
      // The pages that the contents take are known from their length, the numbers in them only later.
      append_table(contents_, "Contents", contents(sheets, std::vector<std::size_t>(sheets.size(), 100)),
                   format_);
      flow(contents_, sheets.size(), format_.content_height(), pages_);
    }
    std::vector<std::size_t> first_pages;
    for (const graphic::Sheet& sheet : sheets) blocks_.push_back(blocks_of(sheet, format_));
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      first_pages.push_back(pages_.size() + 1);
      flow(blocks_[i], i, format_.content_height(), pages_);
    }
    append_table(shared_, "Shared variables", global_reference_table(sheets), format_);
    if (!shared_.empty()) flow(shared_, sheets.size(), format_.content_height(), pages_);
    if (several) renew_contents(first_pages);
  }

  std::string draw() {
    const int count = static_cast<int>(pages_.size());
    graphic::SvgWriter svg(format_.width, format_.height * count, options_.project, style_of(format_),
                           format_.width_mm, format_.height_mm * count);
    for (std::size_t i = 0; i < pages_.size(); ++i) draw(svg, i);
    return svg.finish();
  }

 private:
  void renew_contents(const std::vector<std::size_t>& first_pages) {
    std::vector<Block> renewed;
    append_table(renewed, "Contents", contents(sheets_, first_pages), format_);
    std::vector<Page> pages;
    flow(renewed, sheets_.size(), format_.content_height(), pages);
    for (std::size_t i = 0; i < pages.size(); ++i) pages_[i] = std::move(pages[i]);
    contents_ = std::move(renewed);
  }

  void draw(graphic::SvgWriter& svg, std::size_t index) {
    const Page& page = pages_[index];
    const graphic::Sheet* sheet = page.sheet < sheets_.size() ? &sheets_[page.sheet] : nullptr;
    svg.open_group("sw-page", "data-page", std::to_string(index + 1));
    svg.open_moved(0, format_.height * static_cast<int>(index));
    draw_frame(svg, format_,
               {options_.project, sheet != nullptr ? title_of(*sheet) : "",
                sheet != nullptr ? sheet->file : "", index + 1, pages_.size()});
    for (const PlacedBlock& each : page.blocks) each.block->draw(svg, format_.left(), format_.top() + each.y);
    svg.close_group();
    svg.close_group();
  }

  const std::vector<graphic::Sheet>& sheets_;
  const PrintOptions& options_;
  PageFormat format_;
  std::vector<Block> contents_;
  std::vector<Block> shared_;
  std::vector<std::vector<Block>> blocks_;
  std::vector<Page> pages_;
};

}  // namespace

std::string print_svg(const std::vector<graphic::Sheet>& sheets, const PrintOptions& options) {
  return Document(sheets, options).draw();
}

}  // namespace stepwright::print
