#pragma once

// A container as viewers, reports and the supervisor read it: variables by name, charts, tasks. Host side
// only.
//
//   auto info = ProgramInfo::read(container);                    // verifies first
//   const Variable* level = info->find("S1_filtered");
//   double counts = read_number(*level, image);
//
// Immutable; any thread.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/bytecode/container_format.h"
#include "runtime/bytecode/value_type.h"
#include "runtime/result/result.h"

namespace stepwright::reader {

// Where a value of an elementary type lies in the image.
struct Variable {
  bytecode::ElementaryType type = bytecode::ElementaryType::Bool;
  std::uint32_t address = 0;  // byte
  std::uint8_t bit = bytecode::kNoBit;
};

struct Tag {
  std::string name;  // path of an elementary variable: "plan.START_X", "main.table[3].speed"
  Variable variable;
  std::uint16_t flags = 0;  // bytecode::SymbolFlag
};

struct StepInfo {
  std::string name;
  std::string comment;
  bool initial = false;
  Variable active;
};

struct TransitionInfo {
  std::string name;
  std::string condition;
  std::vector<std::uint32_t> sources;  // indexes into ChartInfo::steps
  std::vector<std::uint32_t> targets;
  std::optional<Variable> fires;  // true in the scan in which it is crossed; none if no bit is kept
};

struct ChartInfo {
  std::string name;
  std::vector<StepInfo> steps;
  std::vector<TransitionInfo> transitions;
};

struct TaskInfo {
  std::string name;
  std::uint32_t interval_us = 0;
  std::uint32_t priority = 0;
};

class ProgramInfo {
 public:
  // Fails with the `refusal` (loaded_program.h) if the verifier refuses the bytes.
  [[nodiscard]] static result::Result<ProgramInfo> read(std::span<const std::byte> container);

  // By path, upper and lower case alike; null if there is none or if it is not elementary.
  const Variable* find(std::string_view name) const;
  const ChartInfo* chart(std::string_view name) const;

  const std::vector<Tag>& tags() const { return tags_; }  // in the order of the container
  const std::vector<ChartInfo>& charts() const { return charts_; }
  const std::vector<TaskInfo>& tasks() const { return tasks_; }
  const bytecode::SizesRecord& sizes() const { return sizes_; }

 private:
  std::vector<Tag> tags_;
  std::map<std::string, std::size_t, std::less<>> by_name_;  // upper case -> index into tags_
  std::vector<ChartInfo> charts_;
  std::vector<TaskInfo> tasks_;
  bytecode::SizesRecord sizes_{};
};

// BOOLs as 0 or 1, TIME in nanoseconds; 64-bit integers beyond 2^53 lose their last digits. 0 if the variable
// lies outside `image`.
double read_number(const Variable& variable, std::span<const std::byte> image);

}  // namespace stepwright::reader
