#pragma once

// Names of a sheet in one of its instances, as tags of the running program or steps of its chart; and their
// values in a copy of the image (hmi_web/doc/program.md).
//
//   ProgramNames names(*layout);
//   Scope scope(names, variables, "Main.f");
//   Value level = scope.value("level", types, image);
//
// Immutable; what is given outlives it.

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "hmi_web/monitor/value.h"
#include "hmi_web/server/program_layout.h"

namespace stepwright::monitor {

// Names are compared without upper and lower case.
std::string folded(std::string_view name);

// Tags by their names and addresses, steps by "plan.s1".
class ProgramNames {
 public:
  explicit ProgramNames(const server::ProgramLayout& layout);

  // By path or by address; null if there is none.
  const reader::Variable* tag(std::string_view name) const;
  const reader::Variable* step(std::string_view chart, std::string_view name) const;

 private:
  const server::ProgramLayout& layout_;
  std::unordered_map<std::string, std::size_t> tags_;
  std::unordered_map<std::string, std::size_t> steps_;
};

// Variable, by its name in lower case -> its section.
using Sections = std::map<std::string, std::string, std::less<>>;

class Scope {
 public:
  // `instance`: its path; empty: the sheet has none (a function).
  Scope(const ProgramNames& names, const Sections& sections, std::string instance)
      : names_(names), sections_(sections), instance_(std::move(instance)) {}

  bool declares(std::string_view name) const;
  // None of what has no value between two scans, and of texts.
  Value value(const std::string& path, const semantics::TypeTable& types,
              std::span<const std::byte> image) const;

 private:
  const reader::Variable* find(const std::string& path) const;

  const ProgramNames& names_;
  const Sections& sections_;
  std::string instance_;
};

}  // namespace stepwright::monitor
