#pragma once

// State of a TomlDocument: toml++ behind a wall. Internal to this folder; not thread-safe.

#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <map>
#include <set>
#include <string>
#include <utility>

#include "runtime/ground/settings/toml_document.h"

namespace stepwright::settings {

struct TomlDocument::State {
  std::string file;
  std::string code;
  toml::table root;
  result::Diagnostics problems;
  std::map<std::string, std::string> origins;  // dotted key -> the override that set it
  using Keys = std::map<const void*, std::set<std::string, std::less<>>>;  // of each table
  Keys asked;                                                              // that were read
  Keys looked_for;  // of which somebody wanted to know whether they are there
  KeyListener listener;

  result::Location place(const toml::source_region& source) const {
    return {file, source.begin.line, source.begin.column};
  }
  // What came from an override stands in no line of the file.
  result::Location place(const std::string& path, const toml::source_region& source) const {
    const auto found = origins.find(path);
    return found != origins.end() ? result::Location{found->second, 0, 0} : place(source);
  }
  void add(const char* number, result::Location where, std::string message, std::string hint) {
    problems.push_back(
        {code + number, result::Severity::Error, std::move(where), std::move(message), std::move(hint)});
  }
  void report_unknown(const toml::table& table, const std::string& path, const KeyAdvice& advice);
};

}  // namespace stepwright::settings
