#include "programs/compile/code_rows.h"

#include <algorithm>
#include <cstdlib>

namespace stepwright::compile_program {

namespace {

constexpr std::size_t kDigits = 4;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

// "P0101" begins here and is the whole word.
bool is_code(std::string_view text, std::size_t at) {
  if (at + kDigits >= text.size() || !is_capital(text[at])) return false;
  const std::size_t end = at + 1 + kDigits;
  const bool alone = (at == 0 || !(is_capital(text[at - 1]) || is_digit(text[at - 1]))) &&
                     (end == text.size() || !is_digit(text[end]));
  return alone && std::all_of(text.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                              text.begin() + static_cast<std::ptrdiff_t>(end), is_digit);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

// Codes of a cell, a range "A0001 to A0004" in full.
std::vector<std::string> codes_of(std::string_view cell) {
  constexpr std::string_view kTo = " to ";
  std::vector<std::string> codes;
  for (std::size_t at = 0; at < cell.size(); ++at) {
    if (!is_code(cell, at)) continue;
    const std::size_t end = at + 1 + kDigits;
    const char letter = cell[at];
    const int first = std::atoi(std::string(cell.substr(at + 1, kDigits)).c_str());
    int last = first;
    const std::size_t other = end + kTo.size();
    if (cell.substr(end, kTo.size()) == kTo && is_code(cell, other) && cell[other] == letter)
      last = std::atoi(std::string(cell.substr(other + 1, kDigits)).c_str());
    for (int number = first; number <= last; ++number) {
      const std::string digits = std::to_string(number);
      codes.push_back(letter + std::string(kDigits - digits.size(), '0') + digits);
    }
    at = end - 1;
  }
  return codes;
}

// Calls `use(document, first cell, last cell)` for the rows of all tables.
template <typename Use>
void each_row(Use use) {
  for (const DocumentText& document : document_texts()) {
    std::string_view rest = document.text;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      const std::string_view line = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      const std::size_t first =
          line.size() > 2 && line.front() == '|' ? line.find('|', 1) : std::string_view::npos;
      if (first == std::string_view::npos || line.back() != '|' || first + 1 >= line.size()) continue;
      const std::size_t last = line.rfind('|', line.size() - 2);
      use(document.name, trimmed(line.substr(1, first - 1)),
          trimmed(line.substr(last + 1, line.size() - last - 2)));
    }
  }
}

}  // namespace

std::vector<CodeRow> code_rows(std::string_view code) {
  std::vector<CodeRow> rows;
  each_row([&](std::string_view document, std::string_view cell, std::string_view meaning) {
    const std::vector<std::string> codes = codes_of(cell);
    if (std::find(codes.begin(), codes.end(), code) != codes.end())
      rows.push_back({document, std::string(cell), std::string(meaning)});
  });
  // A row of one code says more than one of many.
  std::stable_sort(rows.begin(), rows.end(), [](const CodeRow& l, const CodeRow& r) {
    return codes_of(l.codes).size() < codes_of(r.codes).size();
  });
  return rows;
}

std::vector<std::string> documented_codes() {
  std::vector<std::string> all;
  each_row([&](std::string_view, std::string_view cell, std::string_view) {
    for (std::string& each : codes_of(cell)) all.push_back(std::move(each));
  });
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace stepwright::compile_program
