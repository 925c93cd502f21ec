#pragma once

// Diagnostics as the page reads them: what was refused, and what somebody ought to know of what was done.
//
// Pure; any thread.

#include <nlohmann/json.hpp>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::api {

// An object with code, message and, where they are known, hint, file, line and column.
inline nlohmann::json problem_json(const result::Diagnostic& problem) {
  nlohmann::json entry = {{"code", problem.code}, {"message", problem.message}};
  if (!problem.hint.empty()) entry["hint"] = problem.hint;
  if (!problem.where.file.empty()) entry["file"] = problem.where.file;
  if (problem.where.line > 0) {
    entry["line"] = problem.where.line;
    entry["column"] = problem.where.column;
  }
  return entry;
}

inline nlohmann::json problems_json(const result::Diagnostics& problems) {
  nlohmann::json list = nlohmann::json::array();
  for (const result::Diagnostic& problem : problems) list.push_back(problem_json(problem));
  return list;
}

}  // namespace stepwright::api
