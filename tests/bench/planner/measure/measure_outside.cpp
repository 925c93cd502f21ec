#include <filesystem>
#include <fstream>
#include <string>

#include "supervisor/pddl/plan/plan_file.h"
#include "tests/bench/planner/measure/child.h"
#include "tests/bench/planner/measure/judge.h"
#include "tests/bench/planner/measure/measurement.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::bench {
namespace {

std::string filled(std::string command, const std::string& word, const std::filesystem::path& file) {
  for (std::size_t at = command.find(word); at != std::string::npos; at = command.find(word)) {
    command.replace(at, word.size(), "'" + file.string() + "'");
  }
  return command;
}

}  // namespace

Measurement measure_outside(const Outside& planner, const Instance& instance, const pddl::Task& task,
                            const Limits& limits) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "domain.pddl") << instance.domain;
  std::ofstream(folder / "problem.pddl") << instance.problem;
  std::string command = filled(planner.command, "{domain}", folder / "domain.pddl");
  command = filled(command, "{problem}", folder / "problem.pddl");
  command = filled(command, "{plan}", folder / "plan");
  const ChildResult child =
      run_command({limits.time, limits.memory_mb}, "cd '" + folder.path().string() + "' && " + command);
  Measurement result;
  result.outcome = child.end == ChildEnd::Done ? "none" : to_string(child.end);
  result.wall_ms = child.wall_ms;
  result.cpu_ms = child.cpu_ms;
  result.peak_mb = child.peak_mb;
  const auto source = pddl::read_source((folder / "plan").string());
  if (!source) return result;
  const auto plan = pddl::parse_plan(*source);
  if (!plan) return result;
  const Judgement judged = judge(task, plan->actions);
  if (!judged.wrong.empty()) {
    // Not ours: it counts as no plan and is reported.
    result.outcome = "wrong plan: " + judged.wrong;
    return result;
  }
  result.outcome = "plan";
  result.profile.push_back({child.wall_ms, child.cpu_ms, judged.cost, plan->actions.size()});
  return result;
}

}  // namespace stepwright::bench
