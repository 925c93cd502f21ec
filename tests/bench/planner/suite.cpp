#include "tests/bench/planner/suite.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/bench/planner/measure/judge.h"

namespace stepwright::bench {
namespace {

result::Result<Row> run_instance(Instance instance, const Settings& settings, BestKnown& best) {
  const auto task = task_of(instance);
  if (!task) return tl::unexpected(task.error());
  const auto wrong = [&](const char* who, const std::string& why) {
    return result::fail("P0400", {instance.name(), 0, 0}, std::string(who) + " is wrong: " + why,
                        "reproduce it with --domains " + instance.generator + " --write FOLDER");
  };
  Row row;
  const Judgement reference = judge(*task, instance.reference);
  if (!reference.wrong.empty()) return wrong("the generator's own plan", reference.wrong);
  best.offer(instance, reference.cost, instance.lower_bound, "generator");

  row.ours = measure_planner(instance, *task, settings.limits);
  if (!row.ours.wrong.empty()) return wrong("the planner", row.ours.wrong);
  if (row.ours.solved()) {
    best.offer(instance, row.ours.last().cost, row.ours.bound.value_or(instance.lower_bound), "planner");
  }
  row.ground = measure_grounding(instance, settings.limits);
  if (settings.baseline) {
    row.baseline = measure_baseline(instance, *task, settings.limits);
    if (!row.baseline.wrong.empty()) return wrong("the baseline", row.baseline.wrong);
    if (row.baseline.solved())
      best.offer(instance, row.baseline.last().cost, instance.lower_bound, "baseline");
  }
  for (const Outside& planner : settings.outside) {
    auto& measured = row.outside.emplace_back();
    if (planner.classical_only && !instance.classical) continue;
    Limits limits = settings.limits;
    limits.time = settings.outside_time;
    measured = measure_outside(planner, instance, *task, limits);
    if (measured.solved()) best.offer(instance, measured.last().cost, instance.lower_bound, planner.name);
  }
  row.best = *best.find(instance);
  if (row.best.bound > row.best.cost + 1e-6) return wrong("the bound", "a valid plan costs less than it");
  row.instance = std::move(instance);
  return row;
}

}  // namespace

double Row::ratio(double cost) const {
  if (cost <= best.cost + 1e-6) return 1.0;
  return best.cost > 0.0 ? cost / best.cost : 1.0 + cost;
}

result::Result<std::vector<Instance>> instances_of(const Settings& settings) {
  std::vector<Instance> instances;
  std::vector<std::string> unknown = settings.domains;
  std::string names;
  for (const Generator& generator : generators()) {
    names += (names.empty() ? "" : ", ") + generator.name;
    const auto asked = std::find(settings.domains.begin(), settings.domains.end(), generator.name);
    std::erase(unknown, generator.name);
    if (!settings.domains.empty() && asked == settings.domains.end()) continue;
    std::size_t count = generator.sizes.size();
    if (settings.sizes > 0) count = std::min(count, static_cast<std::size_t>(settings.sizes));
    for (std::size_t i = 0; i < count; ++i) {
      instances.push_back(make_instance(generator, generator.sizes[i], settings.seed));
    }
  }
  if (!unknown.empty())
    return result::fail("P0001", {"--domains", 0, 0}, "there is no generator '" + unknown.front() + "'",
                        "there are " + names);
  return instances;
}

result::Result<pddl::Task> task_of(const Instance& instance) {
  return pddl::parse_task({instance.name() + ".domain.pddl", instance.domain},
                          {instance.name() + ".problem.pddl", instance.problem});
}

result::Result<std::vector<Row>> run_suite(const Settings& settings, BestKnown& best,
                                           const std::function<void(const Row&)>& done) {
  auto instances = instances_of(settings);
  if (!instances) return tl::unexpected(instances.error());
  std::vector<Row> rows;
  for (Instance& instance : *instances) {
    auto row = run_instance(std::move(instance), settings, best);
    if (!row) return tl::unexpected(row.error());
    done(*row);
    rows.push_back(std::move(*row));
  }
  return rows;
}

bool write_instances(const std::string& folder, const std::vector<Instance>& instances) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  bool good = !failed;
  for (const Instance& instance : instances) {
    const std::string path = folder + "/" + instance.name();
    std::string plan;
    for (const model::GroundAction& action : instance.reference) plan += model::to_string(action) + "\n";
    good = good && std::ofstream(path + ".domain.pddl") << instance.domain;
    good = good && std::ofstream(path + ".problem.pddl") << instance.problem;
    good = good && std::ofstream(path + ".reference.plan") << plan;
  }
  return good;
}

}  // namespace stepwright::bench
