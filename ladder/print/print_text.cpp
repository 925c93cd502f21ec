// The print for a terminal; see print.h.

#include "ladder/graphic/ladder_drawing.h"
#include "ladder/graphic/sfc_drawing.h"
#include "ladder/graphic/sfc_layout.h"
#include "ladder/print/print.h"
#include "ladder/print/sheet_title.h"
#include "ladder/print/table.h"

namespace stepwright::print {

namespace {

constexpr std::size_t kColumns = 100;

std::string padded(const std::string& text, std::size_t width, bool right = false) {
  const std::size_t length = graphic::length_of(text);
  const std::string blanks(length < width ? width - length : 0, ' ');
  return right ? blanks + text : text + blanks;
}

void append_line(std::string& out, std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  out += line + "\n";
}

std::string text_of(const Table& table) {
  if (table.rows.empty()) return {};
  const std::vector<std::size_t> widths = column_widths(table, kColumns - 2);
  std::string out;
  const auto append = [&](const std::vector<std::string>& row) {
    const Cells cells = cells_of(row, widths);
    for (std::size_t i = 0; i < lines_of(cells); ++i) {
      std::string line = "  ";
      for (std::size_t column = 0; column < cells.size(); ++column)
        line += padded(i < cells[column].size() ? cells[column][i] : "", widths[column] + 2);
      append_line(out, line);
    }
  };
  append(table.heads);
  std::size_t total = 0;
  for (const std::size_t each : widths) total += each + 2;
  std::string rule = "  ";
  for (std::size_t i = 2; i < total; ++i) rule += "─";
  out += rule + "\n";
  for (const auto& row : table.rows) append(row);
  return out;
}

std::string text_of(const graphic::Listing& listing) {
  std::string out;
  for (std::size_t i = 0; i < listing.lines.size(); ++i)
    append_line(out, padded(std::to_string(listing.first_line + i), 5, true) + "  " + listing.lines[i]);
  return out;
}

std::string text_of(const graphic::LadderProgram& program) {
  return draw_ladder_text(program, static_cast<int>(kColumns) - 2);
}

std::string text_of(const graphic::SfcChart& chart) {
  std::string out = draw_sfc_text(chart).value_or("");
  for (const graphic::Action& action : chart.actions)
    out += "\nACTION " + action.name + "\n" + text_of(listing_of(action));
  return out;
}

void append_part(std::string& out, const std::string& head, const std::string& text) {
  if (!text.empty()) out += "\n" + head + (head.empty() ? "" : "\n") + text;
}

}  // namespace

std::string print_text(const std::vector<graphic::Sheet>& sheets, const PrintOptions& options) {
  std::string rule;
  for (std::size_t i = 0; i < kColumns; ++i) rule += "═";
  std::string out;
  for (const graphic::Sheet& sheet : sheets) {
    const std::string title = title_of(sheet);
    const std::string right = options.project + (options.project.empty() ? "" : "  ") + sheet.file;
    const std::size_t used = graphic::length_of(title) + graphic::length_of(right);
    out += (out.empty() ? "" : "\n") + rule + "\n" + title +
           std::string(used + 2 < kColumns ? kColumns - used : 2, ' ') + right + "\n" + rule + "\n";
    if (!sheet.comment.empty()) append_part(out, "", sheet.comment + "\n");
    append_part(out, "Declarations", text_of(declaration_table(sheet)));
    append_part(out, "", std::visit([](const auto& body) { return text_of(body); }, sheet.body));
    if (has_references(sheet))
      append_part(out, "Cross references", text_of(cross_reference_table(cross_reference(sheet))));
  }
  append_part(out, "Shared variables", text_of(global_reference_table(sheets)));
  return out;
}

}  // namespace stepwright::print
