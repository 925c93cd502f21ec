#pragma once

// Short ways to write charts in tests.

#include <string>
#include <vector>

#include "ladder/graphic/project.h"

namespace stepwright::lowering {

inline graphic::Step step(std::string name, bool initial = false,
                          std::vector<graphic::ActionBlock> actions = {}) {
  graphic::Step result;
  result.name = std::move(name);
  result.initial = initial;
  result.actions = std::move(actions);
  return result;
}

inline graphic::Transition transition(std::string name, std::vector<std::uint32_t> sources,
                                      std::vector<std::uint32_t> targets, graphic::Condition condition) {
  graphic::Transition result;
  result.name = std::move(name);
  for (const std::uint32_t id : sources) result.sources.emplace_back(id);
  for (const std::uint32_t id : targets) result.targets.emplace_back(id);
  result.condition = std::move(condition);
  return result;
}

// A program with these BOOL variables and this chart.
inline graphic::Pou pou_of(graphic::SfcChart chart, const std::vector<std::string>& bools) {
  graphic::Pou pou;
  pou.name = "main";
  for (const std::string& name : bools) pou.variables.push_back({name, "BOOL"});
  pou.body = std::move(chart);
  return pou;
}

}  // namespace stepwright::lowering
