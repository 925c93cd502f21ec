#pragma once

// Description of the program that runs, for viewers: the charts with their steps and transitions, and the
// tags, each known afterwards by its index. Sent once per program digest.
//
// Plain values; any thread.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hmi_web/protocol/tag_note.h"

namespace stepwright::protocol {

struct ProgramStep {
  std::string name;
  std::string comment;  // of a planned step: the action, "(load v1 f1 level8)"
  bool initial = false;
};

struct ProgramTransition {
  std::string name;
  std::vector<std::uint32_t> sources;  // indices into Program::steps
  std::vector<std::uint32_t> targets;
  std::string condition;  // ST expression
};

struct ProgramTag {
  std::string name;          // "PLAN.S1_FILTERED"
  std::string type;          // IEC type name: "BOOL", "INT", "REAL", "TIME" (its value is in seconds)
  std::string address;       // "%IX0.0", or empty if the tag is not located
  std::string comment = {};  // of its declaration, or what a pragma there says instead
  std::optional<std::uint32_t> enumeration = std::nullopt;  // index into Program::enumerations
  TagNote note = {};  // what else the declaration says, without name and description
};

// The names of an enumeration's values; several tags have the same one.
using Enumeration = std::map<std::int64_t, std::string>;

// Of each point of the synoptic the tags at its place, as indexes into Program::tags: what is forced of them
// is forced in the picture, too.
using PointTags = std::vector<std::vector<std::uint32_t>>;

// Charts follow each other in the lists of steps and transitions.
struct ProgramChart {
  std::string name;         // of the program that it is the body of
  std::uint32_t steps = 0;  // how many
  std::uint32_t transitions = 0;
};

// An array whose values are no tags.
struct LeftOutArray {
  std::string name;
  std::size_t values = 0;  // single ones
  bool of_blocks = false;  // of function blocks; else a table
};

struct Program {
  std::string digest;  // hex; empty = no program
  std::vector<ProgramChart> charts;
  std::vector<ProgramStep> steps;
  std::vector<ProgramTransition> transitions;
  std::vector<ProgramTag> tags;
  std::vector<Enumeration> enumerations;
  std::vector<LeftOutArray> left_out = {};
};

}  // namespace stepwright::protocol
