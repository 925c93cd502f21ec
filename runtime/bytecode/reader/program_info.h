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
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/bytecode/container_view.h"
#include "runtime/bytecode/value_type.h"
#include "runtime/ground/result/result.h"

namespace stepwright::reader {

// The names of an enumeration's values.
using Enumerators = std::map<std::int64_t, std::string>;

// Where a single value lies in the image. Of an enumeration or a subrange the type is its base.
struct Variable {
  bytecode::ElementaryType type = bytecode::ElementaryType::Bool;
  std::uint32_t address = 0;  // byte; of a string: of its header
  std::uint8_t bit = bytecode::kNoBit;
  // Null if it is no enumeration. Shared, as variables are copied out of the ProgramInfo and outlive it.
  std::shared_ptr<const Enumerators> enumerators = nullptr;
  std::uint16_t capacity = 0;  // of a string: characters
};

struct Tag {
  std::string name;  // path of a single value: "plan.START_X", "main.table[3].speed"
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
  std::uint32_t interval_us = 0;  // 0: runs on its trigger only; without one it is freewheeling
  std::uint32_t priority = 0;
  std::string trigger;  // path of the BOOL whose rising edge runs it; empty: none
};

// Of a verified program, in the order of the container.
std::vector<TaskInfo> task_infos(const bytecode::ContainerView& view);

// A program or function block that keeps its values in the image.
struct InstanceInfo {
  std::string path;  // "plan", "plan.filter"
  std::string pou;   // whose instance it is
};

class ProgramInfo {
 public:
  // Fails with the `refusal` (loaded_program.h) if the verifier refuses the bytes.
  [[nodiscard]] static result::Result<ProgramInfo> read(std::span<const std::byte> container);

  // By path, upper and lower case alike; null if there is none or if it is not a single value (a reference is
  // none: what it refers to is found under its own name).
  const Variable* find(std::string_view name) const;
  const Tag* find_tag(std::string_view name) const;
  const ChartInfo* chart(std::string_view name) const;

  const std::vector<Tag>& tags() const { return tags_; }  // in the order of the container
  // False if the program has values beyond the tags: more than 2^20, types deeper than 256 levels or paths of
  // more than 256 MiB. No program of a runtime's size does; whoever reports a name as unknown says so.
  bool complete() const { return complete_; }
  const std::vector<ChartInfo>& charts() const { return charts_; }
  const std::vector<TaskInfo>& tasks() const { return tasks_; }
  const std::vector<InstanceInfo>& instances() const { return instances_; }  // those of the library, too
  const bytecode::SizesRecord& sizes() const { return sizes_; }

 private:
  std::vector<Tag> tags_;
  std::vector<std::uint32_t> by_name_;  // indexes into tags_, sorted by name without regard to case
  bool complete_ = true;
  std::vector<ChartInfo> charts_;
  std::vector<TaskInfo> tasks_;
  std::vector<InstanceInfo> instances_;
  bytecode::SizesRecord sizes_{};
};

// BOOLs as 0 or 1, TIME in nanoseconds; 64-bit integers beyond 2^53 lose their last digits. 0 if the variable
// lies outside `image` or is a string.
double read_number(const Variable& variable, std::span<const std::byte> image);

}  // namespace stepwright::reader
