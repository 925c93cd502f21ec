#pragma once

// The rows of a table of comma-separated values (RFC 4180), one after the other: of the table no more than
// one row is in memory, and of a row no more than a mebibyte. A byte order mark of UTF-8 is skipped.
//
// Thread rule: one thread at a time. Example:
//   CsvRows rows(stream, "trace.csv", "L0041");
//   while (rows.next()) use(rows.fields());
//   if (rows.error()) ...

#include <cstdint>
#include <istream>
#include <optional>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/ground/result/utf8_place.h"

namespace stepwright::csv {

// Spreadsheets write it before a table, and read letters beyond ASCII wrongly without it.
using result::kByteOrderMark;

class CsvRows {
 public:
  // The stream outlives this. `code`: of what is no table.
  CsvRows(std::istream& in, std::string file, std::string code)
      : in_(*in.rdbuf()), file_(std::move(file)), code_(std::move(code)) {}

  // False at the end, and at what is no table (error()). Lines without anything in them are no rows,
  // nor are those of commas alone, which spreadsheets write.
  bool next();

  const std::vector<std::string>& fields() const { return fields_; }
  result::Location where(std::size_t field) const { return {file_, line_, columns_[field]}; }
  std::uint32_t line() const { return line_; }  // where the row begins
  const std::optional<result::Diagnostics>& error() const { return error_; }

 private:
  void row();
  std::string skip_mark();
  bool quoted(std::string& field);
  bool fail(const result::Location& at, const char* message, const char* hint);

  int peek() { return in_.sgetc(); }  // the end is none of the characters
  bool sees(char c) { return peek() == std::char_traits<char>::to_int_type(c); }
  bool at_end() { return peek() == std::char_traits<char>::eof(); }
  // The next one; false, with an error, where the row is longer than its bound.
  bool take(std::string* into);

  std::streambuf& in_;
  std::string file_, code_;
  std::uint32_t bytes_ = 0;  // of the row, so far
  std::uint32_t next_line_ = 1, line_ = 0;
  std::vector<std::string> fields_;
  std::vector<std::uint32_t> columns_;
  std::optional<result::Diagnostics> error_;
};

}  // namespace stepwright::csv
