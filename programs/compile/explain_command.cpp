#include "programs/compile/explain_command.h"

#include <algorithm>
#include <iostream>
#include <vector>

#include "ladder/driver/diagnostic_pages.h"
#include "ladder/source/name_table.h"
#include "ladder/source/suggestion.h"
#include "programs/compile/code_rows.h"

namespace stepwright::compile_program {

using result::ExitCode;

namespace {

// Pages first; what has none stands in a document.
std::vector<std::string> all_codes() {
  std::vector<std::string> codes;
  for (const driver::DiagnosticPage& each : driver::diagnostic_pages()) codes.emplace_back(each.code);
  for (std::string& each : documented_codes())
    if (driver::find_page(each) == nullptr) codes.push_back(std::move(each));
  return codes;
}

void list_all() {
  for (const std::string& code : all_codes()) {
    const driver::DiagnosticPage* page = driver::find_page(code);
    std::cout << code << "  "
              << (page != nullptr ? std::string(page->title()) : code_rows(code).front().meaning) << "\n";
  }
}

}  // namespace

ExitCode run_explain(const std::string& given) {
  if (given.empty()) {
    list_all();
    return ExitCode::Done;
  }
  const std::string code = source::upper(given);
  if (const driver::DiagnosticPage* page = driver::find_page(code)) {
    std::cout << page->text;
    return ExitCode::Done;
  }
  if (const std::vector<CodeRow> rows = code_rows(code); !rows.empty()) {
    for (const CodeRow& each : rows)
      std::cout << each.codes << ": " << each.meaning << "\n  (" << each.document << ")\n";
    return ExitCode::Done;
  }
  const std::vector<std::string> codes = all_codes();
  const std::string meant =
      source::did_you_mean(code, std::vector<std::string_view>(codes.begin(), codes.end()));
  std::cerr << "there is no diagnostic '" << given
            << "'\n  hint: " << (meant.empty() ? "`stepwright explain` lists all codes" : meant) << "\n";
  return ExitCode::BadInput;
}

}  // namespace stepwright::compile_program
