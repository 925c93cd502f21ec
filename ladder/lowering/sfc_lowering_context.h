#pragma once

// Shared state of the SFC lowering: the POU that grows, its generated variables and the rewriting of step
// flags. Internal to this folder; one object per lowering, one thread.

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ladder/graphic/identifier.h"
#include "ladder/graphic/project.h"
#include "ladder/lowering/condition_network.h"
#include "ladder/syntax/piece.h"

namespace stepwright::lowering {

// The generated variables of one step; empty where the chart does not need it.
struct StepVariables {
  std::string active;      // BOOL, S.X
  std::string elapsed;     // TIME, S.T
  std::string entered_at;  // TIME, the chart's clock when the step was entered last
  std::string was_active;  // BOOL, S.X at the end of the scan before
};

// The generated variables of one action with a body; empty where the chart does not need it.
struct ActionVariables {
  std::string flag;        // BOOL, A.Q: the output Q of its action control
  std::string activation;  // BOOL, A.A: the body runs; without final scan the same as `flag`
  std::string was_active;  // BOOL, A.Q in the scan before, with final scan only
};

class SfcLoweringContext {
 public:
  // Reserves every name that `pou` uses and declares the step and transition bits and what they need. The
  // body of `pou` is a sound chart. `networks` run beside it.
  explicit SfcLoweringContext(const graphic::Pou& pou, ChartNetworks networks = {});

  const graphic::SfcChart& chart() const { return pou_.origin; }
  const std::vector<StepVariables>& steps() const { return steps_; }
  // In the order of the chart's actions.
  const std::vector<ActionVariables>& actions() const { return actions_; }
  graphic::Condition active(graphic::StepId step, bool negated = false) const;
  graphic::Condition fires(std::size_t transition, bool negated = false) const;
  // Their texts are not rewritten yet.
  const std::vector<ConditionNetwork>& condition_networks() const { return networks_.conditions; }
  const std::string& clock_timer() const { return clock_timer_; }
  const std::string& now() const { return now_; }
  const std::string& first_scan() const { return pou_.first_scan_variable; }

  // Declares a variable under a free name made from `wanted` and returns that name.
  std::string declare(std::string_view wanted, std::string type, std::string comment,
                      std::string initial = {});

  // The text with the flags of steps and actions replaced by their variables.
  std::string rewrite(std::string_view text) const;
  graphic::Condition rewrite(graphic::Condition condition) const;

  // The rungs of the networks that run in every scan, with their flags replaced.
  void add_networks();
  void add(graphic::Rung rung) { rungs_.push_back(std::move(rung)); }
  // The POU with the rungs as its body. The context is used up.
  graphic::Pou finish();

 private:
  void reserve_names();
  void declare_steps();
  void declare_transitions();
  void declare_actions();
  void index_names();
  std::string variable_of(std::string_view owner, char flag) const;
  template <typename Visit>
  void for_each_text(Visit visit) const;

  graphic::Pou pou_;
  graphic::NameSet names_;
  mutable syntax::PieceReader reader_;  // learns spellings, nothing else
  // In upper case -> index; the first of a name counts.
  std::unordered_map<std::string, std::size_t> step_index_;
  std::unordered_map<std::string, std::size_t> action_index_;
  std::vector<StepVariables> steps_;
  std::vector<ActionVariables> actions_;
  ChartNetworks networks_;
  std::vector<graphic::Rung> rungs_;
  std::string clock_timer_;
  std::string now_;
};

// A rung that runs statements of ST where its condition has power.
graphic::Rung statements(std::string comment, graphic::Condition condition, std::string st);

}  // namespace stepwright::lowering
