#pragma once

// The rows of a table of comma-separated values (RFC 4180), one after the other. Private to this library.
//
// Thread rule: one thread at a time. Example:
//   CsvRows rows(text, "trace.csv");
//   while (rows.next()) use(rows.fields());
//   if (rows.error()) ...

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::ltl {

class CsvRows {
 public:
  CsvRows(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  // False at the end, and at what is no table (L0041). Lines without anything in them are no rows.
  bool next();

  const std::vector<std::string>& fields() const { return fields_; }
  result::Location where(std::size_t field) const { return {file_, line_, columns_[field]}; }
  std::uint32_t line() const { return line_; }  // where the row begins
  const std::optional<result::Diagnostics>& error() const { return error_; }

 private:
  void row();
  bool quoted(std::string& field);

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  std::uint32_t next_line_ = 1, line_ = 0;
  std::vector<std::string> fields_;
  std::vector<std::uint32_t> columns_;
  std::optional<result::Diagnostics> error_;
};

}  // namespace stepwright::ltl
