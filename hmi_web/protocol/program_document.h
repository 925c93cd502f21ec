#pragma once

// The sources of the running program as pages get them (hmi_web/doc/program.md), made from the section
// Document of a container, which anybody may have written.
//
//   answer.text = program_sources({digest, instances, text});
//
// Pure; any thread. Whatever the text is: the result is JSON, and no deeper than kMostLevels.

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace stepwright::protocol {

struct ProgramInstance {
  std::string path;  // "plan.filter"
  std::string pou;
};

struct ProgramSources {
  std::string digest;
  std::vector<ProgramInstance> instances;
  std::string_view document;  // empty: the container has none
};

inline constexpr int kMostLevels = 64;  // of nested JSON: what is deeper is left out
inline constexpr std::size_t kMostInstances = 20'000;

// The document of a container as JSON; null if it is not one of this version.
nlohmann::json parsed_document(std::string_view document);

std::string program_sources(const ProgramSources& sources);

}  // namespace stepwright::protocol
