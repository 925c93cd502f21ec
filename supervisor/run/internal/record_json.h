#pragma once

// The run record as a JSON value, for the three texts that carry it: the plan document, the journal and the
// report. For supervisor/run and the journals; the shape is specified in supervisor/doc/plan_document.md.
//
// Pure functions.

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "runtime/ground/result/result.h"
#include "supervisor/run/run_record.h"

namespace stepwright::run::internal {

using nlohmann::json;

json incident_json(const Incident& incident);
Incident incident_from(const json& value);
json record_json(const RunRecord& record);
// Throws json::exception where the shape differs.
RunRecord record_from(const json& value);

// The word's place in a list of names; throws json::exception for any other word.
std::size_t index_of_word(const json& value, const char* const* names, std::size_t count);

// Names and messages may come from outside; bytes that are no UTF-8 are replaced, so that this cannot fail.
std::string text_of(const json& value);

// Parses `text` and applies `read`; a json::exception becomes X0001 "not a <what>".
template <typename Read>
auto read_text(const std::string& text, const std::string& file, const std::string& what, const Read& read)
    -> decltype(read(json())) {
  try {
    return read(json::parse(text));
  } catch (const json::exception& problem) {
    return result::fail("X0001", {file, 0, 0}, "not a " + what + ": " + problem.what(),
                        "delete the file to start afresh");
  }
}

}  // namespace stepwright::run::internal
