#include "ladder/exchange/omron_writer.h"

#include <algorithm>
#include <cassert>

#include "ladder/exchange/omron_addresses.h"
#include "ladder/exchange/omron_statements.h"
#include "ladder/source/codes.h"

namespace stepwright::exchange {
namespace {

// Copies that bring analog inputs to the words that the program compares (the paper's Table 3).
void write_sources(const OmronOptions& options, OmronStatements& statements,
                   result::Diagnostics& diagnostics) {
  for (const OmronAddress& given : options.addresses) {
    if (given.source.empty()) continue;
    const std::optional<OmronPlace> from = parse_omron_address(given.source);
    const std::optional<OmronPlace> to = parse_omron_address(given.address);
    const bool words =
        from && to && from->kind == OmronPlace::Kind::Word && to->kind == OmronPlace::Kind::Word;
    if (!words) {
      result::Diagnostic diagnostic;
      diagnostic.code = source::code::kOmronAddress;
      diagnostic.message = "variable '" + given.variable + "' cannot be copied from '" + given.source +
                           "' to '" + given.address + "'";
      diagnostic.hint = "both have to be words, such as 2001 and D100";
      diagnostics.push_back(std::move(diagnostic));
      continue;
    }
    statements.comment("Read " + given.variable);
    statements.line("LD CF113");
    statements.line("MOV(021) " + from->code + " " + to->code);
  }
}

void write_initial_values(const OmronAddresses& addresses, OmronStatements& statements) {
  if (addresses.initial_values().empty()) return;
  statements.comment("Initial values");
  statements.line("LD A200.11");
  for (const auto& [place, literal] : addresses.initial_values()) statements.initialise(place, literal);
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size() + 1, width), ' ');
  return text;
}

}  // namespace

std::string OmronProgram::to_text() const {
  std::string text = "'Address table\n";
  for (const OmronTableRow& row : table) {
    text +=
        "'" + padded(row.variable, 24) + padded(row.address, 10) + padded(row.type, 9) + row.comment + "\n";
  }
  return text + "'Program\n" + statements;
}

result::Result<OmronProgram> write_omron(const graphic::Pou& ladder, const OmronOptions& options) {
  assert(std::holds_alternative<graphic::LadderProgram>(ladder.body));
  result::Diagnostics diagnostics;
  const OmronAddresses addresses(ladder, options, diagnostics);
  // Without addresses every use of a variable would be one more error about the same thing.
  if (result::has_errors(diagnostics)) return tl::unexpected<result::Diagnostics>(std::move(diagnostics));
  OmronStatements statements(addresses, diagnostics);
  write_sources(options, statements, diagnostics);
  write_initial_values(addresses, statements);
  const auto& rungs = std::get<graphic::LadderProgram>(ladder.body).rungs;
  for (std::size_t i = 0; i < rungs.size(); ++i) {
    std::string place = "rung " + std::to_string(i + 1);
    if (!rungs[i].comment.empty()) place += " (" + rungs[i].comment + ")";
    statements.rung(rungs[i], place, ladder.first_scan_variable);
  }
  statements.line("END(001)");
  if (result::has_errors(diagnostics)) return tl::unexpected<result::Diagnostics>(std::move(diagnostics));
  return OmronProgram{statements.take(), addresses.table()};
}

}  // namespace stepwright::exchange
