#include "runtime/trace/csv_trace.h"

#include <array>
#include <cstdio>
#include <cstring>
#include <utility>

#include "runtime/bytecode/reader/read_value.h"

namespace stepwright::trace {
namespace {

using bytecode::ElementaryType;

tl::unexpected<result::Diagnostics> unwritten(const std::string& path) {
  return result::fail("E0002", {path, 0, 0}, "the file cannot be written",
                      "is there room, and does its folder exist?");
}

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string seconds_text(std::int64_t ns) {
  const bool negative = ns < 0;
  const std::uint64_t size = negative ? ~static_cast<std::uint64_t>(ns) + 1 : static_cast<std::uint64_t>(ns);
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%s%llu.%09llu", negative ? "-" : "",
                static_cast<unsigned long long>(size / 1'000'000'000),
                static_cast<unsigned long long>(size % 1'000'000'000));
  return text.data();
}

std::string csv_value(const reader::Variable& variable, std::span<const std::byte> image) {
  if (variable.type == ElementaryType::Bool) {
    return std::get<bool>(reader::read_value(variable, image)) ? "1" : "0";
  }
  if (variable.type == ElementaryType::Time) {
    return seconds_text(std::get<std::int64_t>(reader::read_value(variable, image)));
  }
  return csv_field(reader::read_text(variable, image));
}

result::Result<void> CsvTrace::columns(std::vector<reader::NamedVariable> variables) {
  variables_ = std::move(variables);
  if (std::exchange(has_header_, true)) return {};
  file_.open(path_, std::ios::binary | std::ios::trunc);
  if (!file_) return unwritten(path_);
  file_ << "scan,time_s";
  for (const reader::NamedVariable& column : variables_) {
    const char* unit = column.variable.type == ElementaryType::Time ? " [s]" : "";
    file_ << ',' << csv_field(column.name + unit);
  }
  file_ << "\r\n";
  return {};
}

void CsvTrace::row(std::uint64_t scan, std::int64_t time_ns, std::span<const std::byte> image) {
  file_ << scan << ',' << seconds_text(time_ns);
  for (const reader::NamedVariable& column : variables_) file_ << ',' << csv_value(column.variable, image);
  file_ << "\r\n";
  ++rows_;
}

result::Result<void> CsvTrace::finish() {
  file_.close();
  if (!file_) return unwritten(path_);
  return {};
}

}  // namespace stepwright::trace
