#include "runtime/ground/csv/csv_rows.h"

#include <algorithm>

namespace stepwright::csv {

namespace {

constexpr std::uint32_t kMostRowBytes = 1u << 20;

}  // namespace

bool CsvRows::next() {
  while (!error_ && !at_end()) {
    row();
    const bool empty = std::ranges::all_of(fields_, &std::string::empty);
    if (!empty || error_) return !error_;
  }
  return false;
}

// The bytes of a mark that is none after all.
std::string CsvRows::skip_mark() {
  std::string begin;
  while (begin.size() < kByteOrderMark.size() && sees(kByteOrderMark[begin.size()]))
    begin += static_cast<char>(in_.sbumpc());
  return begin == kByteOrderMark ? std::string() : begin;
}

void CsvRows::row() {
  fields_.clear();
  columns_.clear();
  line_ = next_line_;
  bytes_ = 0;
  for (bool more = true; more;) {
    columns_.push_back(bytes_ + 1);
    std::string& field = fields_.emplace_back(next_line_ == 1 && bytes_ == 0 ? skip_mark() : std::string());
    if (field.empty() && sees('"')) {
      if (!quoted(field)) return;
    } else {
      while (!at_end() && !sees(',') && !sees('\r') && !sees('\n'))
        if (!take(&field)) return;
    }
    more = sees(',');
    if (more && !take(nullptr)) return;
  }
  if (sees('\r')) in_.sbumpc();
  if (sees('\n')) in_.sbumpc();
  ++next_line_;
}

bool CsvRows::quoted(std::string& field) {
  const result::Location begin = where(columns_.size() - 1);
  take(nullptr);
  while (!at_end()) {
    if (sees('\n')) ++next_line_;
    if (!sees('"')) {
      if (!take(&field)) return false;
      continue;
    }
    if (!take(nullptr)) return false;
    if (at_end() || sees(',') || sees('\r') || sees('\n')) return true;
    if (!sees('"'))
      return fail(begin, "behind the quotes of this field stands something else",
                  "a quote within a field is written twice");
    if (!take(&field)) return false;
  }
  return fail(begin, "the quotes of this field do not end", "close them with \"");
}

bool CsvRows::take(std::string* into) {
  const auto c = static_cast<char>(in_.sbumpc());
  if (into != nullptr) *into += c;
  if (++bytes_ <= kMostRowBytes) return true;
  return fail(where(0), "this row is longer than a mebibyte", "a row ends with its line: is this a table?");
}

bool CsvRows::fail(const result::Location& at, const char* message, const char* hint) {
  error_ = result::fail(code_, at, message, hint).value();
  return false;
}

}  // namespace stepwright::csv
