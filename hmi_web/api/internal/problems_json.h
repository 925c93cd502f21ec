#pragma once

// Diagnostics as the page reads them: what was refused, and what somebody ought to know of what was done.
//
// Pure; any thread.

#include <nlohmann/json.hpp>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::api {

// A list of objects with code, message and, where it is known, hint, line and column.
inline nlohmann::json problems_json(const result::Diagnostics& problems) {
  nlohmann::json list = nlohmann::json::array();
  for (const result::Diagnostic& problem : problems) {
    nlohmann::json entry = {{"code", problem.code}, {"message", problem.message}};
    if (!problem.hint.empty()) entry["hint"] = problem.hint;
    if (problem.where.line > 0) {
      entry["line"] = problem.where.line;
      entry["column"] = problem.where.column;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace stepwright::api
