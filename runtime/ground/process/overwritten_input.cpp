#include "runtime/ground/process/overwritten_input.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/files/files.h"

namespace stepwright::process {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 5> kOutputs = {"json", "out", "output", "svg", "csv"};

struct Files {
  std::vector<std::string> read;
  std::vector<std::string> written;
  std::vector<std::string> reports;  // of those that are written
};

// What a stream leads to is added to.
bool is_plain(const std::string& path) {
  std::error_code error;
  return !files::is_stream(path) && fs::is_regular_file(path, error);
}

void collect(const CLI::App& app, Files& files) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_expected_max() == 0) continue;  // a flag names nothing
    const auto is_called = [&](std::string_view name) {
      return std::ranges::find(option->get_lnames(), name) != option->get_lnames().end();
    };
    const bool is_output = std::ranges::any_of(kOutputs, is_called);
    for (const std::string& value : option->results()) {
      if (!is_plain(value)) continue;
      (is_output ? files.written : files.read).push_back(value);
      if (is_called("json")) files.reports.push_back(value);
    }
  }
  // Groups of options are among them.
  for (const CLI::App* part : app.get_subcommands([](const CLI::App*) { return true; }))
    collect(*part, files);
}

// Blanks, then an object or a list; or nothing.
bool is_report(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  for (char c = 0; file.get(c);)
    if (std::isspace(static_cast<unsigned char>(c)) == 0) return c == '{' || c == '[';
  return true;
}

result::Diagnostic refusal(const std::string& path, const char* why) {
  return {"E0004",
          result::Severity::Error,
          {path, 0, 0},
          std::string("the file is not overwritten: ") + why,
          "name another file, or remove this one"};
}

}  // namespace

result::Diagnostics overwritten_inputs(const CLI::App& app) {
  Files files;
  collect(app, files);
  result::Diagnostics problems;
  std::error_code error;
  for (const std::string& output : files.written) {
    const auto is_same = [&](const std::string& input) { return fs::equivalent(output, input, error); };
    if (std::ranges::any_of(files.read, is_same))
      problems.push_back(refusal(output, "the command reads it"));
    else if (std::ranges::find(files.reports, output) != files.reports.end() && !is_report(output))
      problems.push_back(refusal(output, "it is no JSON"));
  }
  return problems;
}

}  // namespace stepwright::process
