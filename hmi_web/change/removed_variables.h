#pragma once

// Tells the log which recipes and screens name variables that the running program does not have: a recipe
// then cannot be loaded, and of a screen a part stays pale. Alarms say so themselves.
//
//   RemovedVariables removed(&tags, drawn.get(), log);
//   removed.turn(cell.program());                    // often
//
// Of recipes also at the start; of screens what a program had that ran before, as they show points of the
// plant, too. Each once for each program.
//
// Threads: one.

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "hmi_web/recipes/recipe.h"
#include "hmi_web/screens/screen_store.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/log/logger.h"

namespace stepwright::change {

class RemovedVariables {
 public:
  // What it is given outlives it; null: there are none.
  RemovedVariables(const std::vector<recipes::RecipeTag>* tags, const screens::ScreenStore* screens,
                   log::Logger& log)
      : tags_(tags), screens_(screens), log_(log) {}

  // Null: no program is known, and the one before still counts.
  void turn(std::shared_ptr<const reader::ProgramInfo> program);

 private:
  void note_recipes(const reader::ProgramInfo& program);
  void note_screens(const reader::ProgramInfo& before, const reader::ProgramInfo& now);

  const std::vector<recipes::RecipeTag>* tags_;
  const screens::ScreenStore* screens_;
  log::Logger& log_;
  std::shared_ptr<const reader::ProgramInfo> program_;
  std::set<std::string> missing_;  // of recipes
};

}  // namespace stepwright::change
