#pragma once

// Variables over scans as a table of comma-separated values (RFC 4180), one row per scan, for spreadsheets
// and plots.
//
//   trace::CsvTrace csv("out.csv");
//   auto begun = csv.columns(variables);             // scan,time_s,MAIN.level,MAIN.delay [s]
//   csv.row(scan, time_ns, image);                   // 1,0.000000000,12,1.500000000
//   auto finished = csv.finish();
//
// BOOL is 0 or 1, a duration its seconds (and says so in the header), dates, enumerations and strings are
// texts; quoted where a comma, a quote or a line break stands in them. Threads: one.

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/bytecode/reader/resolve_name.h"
#include "runtime/ground/result/result.h"

namespace stepwright::trace {

// A field as it stands in a file: in quotes where it needs them.
std::string csv_field(std::string_view text);

// The value of a variable in a table. Requires the image of its program.
std::string csv_value(const reader::Variable& variable, std::span<const std::byte> image);

// Seconds with all nine places.
std::string seconds_text(std::int64_t ns);

class CsvTrace {
 public:
  explicit CsvTrace(std::string path) : path_(std::move(path)) {}

  // The columns from the next row on. The first call makes the file and its header, or fails with E0002; a
  // later one, when another program has taken over, brings the same names.
  [[nodiscard]] result::Result<void> columns(std::vector<reader::NamedVariable> variables);
  void row(std::uint64_t scan, std::int64_t time_ns, std::span<const std::byte> image);
  // Fails with E0002 if any of it could not be written.
  [[nodiscard]] result::Result<void> finish();

  std::uint64_t rows() const { return rows_; }

 private:
  std::string path_;
  std::ofstream file_;
  std::vector<reader::NamedVariable> variables_;
  bool has_header_ = false;
  std::uint64_t rows_ = 0;
};

}  // namespace stepwright::trace
