#pragma once

// Trial of a binding: every ground action of the domain alone on the simulated plant, from states in which it
// may start, and what the plant does otherwise than the domain and the binding say.
//
//   auto report = try_binding(config, {.seeds = 3}, [](const TrialProgress& p) { show(p); });
//   report->problems     // where each stands in the binding, and what to write instead
//
// Thread rule: one thread; `told` is called from it.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cell/trial/judge.h"
#include "supervisor/translate/pattern.h"

namespace stepwright::trial {

// Of so many ground actions each is tried; of more a sample of each entry (sample.h).
inline constexpr std::size_t kTriedEach = 60;

struct TrialOptions {
  std::optional<translate::Pattern> only;   // "(load ?v ?f ?l)", "(load v1 f1 level8)"; nothing: every action
  std::size_t seeds = 3;                    // from the cell's own on
  std::size_t most = 0;                     // ground actions of each entry of the binding; 0: see `every`
  bool every = false;                       // all of them, where there are more than kTriedEach
  std::chrono::milliseconds search{2'000};  // of each state to start from
  const std::atomic<bool>* cancel = nullptr;  // not owned; asked between runs; may be null
};

struct ActionTrial {
  model::GroundAction action;
  result::Location where;  // of its entry
  std::size_t starts = 0;  // states from which it was tried
  std::size_t runs = 0;
  Spread duration{};       // of those that ended as they should
  double nominal_s = 0.0;  // by the binding, without its rest; the mean over the same runs
  std::size_t problems = 0;
};

struct TrialReport {
  std::vector<ActionTrial> actions;
  std::vector<std::string> never;  // actions for which no state was found in which they may start
  result::Diagnostics problems;    // in the order of the binding
  std::size_t left_out = 0;        // ground actions beyond the sample
  bool complete = true;            // false: more ground actions than can be listed
  bool cancelled = false;
  double simulated_s = 0.0;
  double wall_s = 0.0;
};

struct TrialProgress {
  std::size_t done = 0;  // of `actions`
  std::size_t actions = 0;
  std::string action;  // that is tried now
};

// Fails with what is wrong in the cell's planning files, its plant, or with M0031: no action matches `only`.
[[nodiscard]] result::Result<TrialReport> try_binding(
    const config::CellConfig& config, const TrialOptions& options,
    const std::function<void(const TrialProgress&)>& told = {});

// A table of the actions with their durations, then the problems.
std::string to_text(const TrialReport& report);
std::string to_json(const TrialReport& report);

}  // namespace stepwright::trial
