#include "programs/compile/explain_command.h"

#include <iostream>
#include <vector>

#include "ladder/driver/diagnostic_pages.h"
#include "ladder/source/suggestion.h"

namespace stepwright::compile_program {

using result::ExitCode;

ExitCode run_explain(const std::string& code) {
  if (code.empty()) {
    for (const driver::DiagnosticPage& each : driver::diagnostic_pages())
      std::cout << each.code << "  " << each.title() << "\n";
    return ExitCode::Done;
  }
  if (const driver::DiagnosticPage* page = driver::find_page(code)) {
    std::cout << page->text;
    return ExitCode::Done;
  }
  std::vector<std::string_view> codes;
  for (const driver::DiagnosticPage& each : driver::diagnostic_pages()) codes.push_back(each.code);
  const std::string meant = source::did_you_mean(code, codes);
  std::cerr << "there is no diagnostic '" << code
            << "'\n  hint: " << (meant.empty() ? "`stepwright explain` lists all codes" : meant) << "\n";
  return ExitCode::BadInput;
}

}  // namespace stepwright::compile_program
