// The job-shop problem: which operation comes next on which machine; the metric is the makespan.

#include <algorithm>

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain =
    R"(; Times are numbers: an operation starts when its job and its machine are both ready.
(define (domain job-shop)
  (:requirements :typing :numeric-fluents :conditional-effects :negative-preconditions)
  (:types job machine task)
  (:predicates
    (next ?t - task)                 ; may be started
    (follows ?a ?b - task)           ; b comes after a in the job
    (last ?t - task)
    (part-of ?t - task ?j - job)
    (needs ?t - task ?m - machine)
    (done ?t - task)
    (delivered ?j - job))
  (:functions
    (ready ?j - job)
    (free ?m - machine)
    (takes ?t - task)
    (makespan))
  (:action start-when-job-ready
    :parameters (?t - task ?j - job ?m - machine)
    :precondition (and (next ?t) (part-of ?t ?j) (needs ?t ?m) (>= (ready ?j) (free ?m)))
    :effect (and (not (next ?t)) (done ?t)
                 (increase (ready ?j) (takes ?t))
                 (assign (free ?m) (+ (ready ?j) (takes ?t)))))
  (:action start-when-machine-free
    :parameters (?t - task ?j - job ?m - machine)
    :precondition (and (next ?t) (part-of ?t ?j) (needs ?t ?m) (< (ready ?j) (free ?m)))
    :effect (and (not (next ?t)) (done ?t)
                 (assign (ready ?j) (+ (free ?m) (takes ?t)))
                 (increase (free ?m) (takes ?t))))
  (:action release
    :parameters (?a ?b - task)
    :precondition (and (done ?a) (follows ?a ?b) (not (done ?b)))
    :effect (next ?b))
  (:action deliver
    :parameters (?t - task ?j - job)
    :precondition (and (done ?t) (last ?t) (part-of ?t ?j))
    :effect (and (delivered ?j)
                 (when (> (ready ?j) (makespan)) (assign (makespan) (ready ?j))))))
)";

struct Operation {
  int machine, takes;
};

// The operations in rounds, one of every job: a valid order, seldom a good one.
std::vector<std::string> reference(const std::vector<std::vector<Operation>>& jobs, int machines) {
  std::vector<int> ready(jobs.size(), 0), free(static_cast<std::size_t>(machines), 0);
  std::vector<std::string> plan;
  for (std::size_t k = 0; k < jobs.front().size(); ++k) {
    for (std::size_t j = 0; j < jobs.size(); ++j) {
      const Operation& o = jobs[j][k];
      int& machine = free[static_cast<std::size_t>(o.machine)];
      if (k > 0) plan.push_back(fmt::format("release t{0}x{1} t{0}x{2}", j + 1, k, k + 1));
      plan.push_back(fmt::format("{} t{}x{} job{} machine{}",
                                 ready[j] >= machine ? "start-when-job-ready" : "start-when-machine-free",
                                 j + 1, k + 1, j + 1, o.machine + 1));
      ready[j] = machine = std::max(ready[j], machine) + o.takes;
    }
  }
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    plan.push_back(fmt::format("deliver t{0}x{1} job{0}", j + 1, jobs[j].size()));
  }
  return plan;
}

// No schedule is shorter than the longest job or the work of the busiest machine.
int lower_bound(const std::vector<std::vector<Operation>>& jobs, int machines) {
  std::vector<int> load(static_cast<std::size_t>(machines), 0);
  int bound = 0;
  for (const auto& job : jobs) {
    int length = 0;
    for (const Operation& o : job) {
      length += o.takes;
      load[static_cast<std::size_t>(o.machine)] += o.takes;
    }
    bound = std::max(bound, length);
  }
  return std::max(bound, *std::max_element(load.begin(), load.end()));
}

Draft draft(int size, Random& random) {
  const int jobs = 2 + size / 2, machines = 2 + (size + 1) / 2;
  ProblemText problem(fmt::format("job-shop-{}", size), "job-shop");
  problem.objects("job", numbered("job", jobs));
  problem.objects("machine", numbered("machine", machines));
  problem.init("(= (makespan) 0)");
  for (int m = 1; m <= machines; ++m) problem.init("(= (free machine{}) 0)", m);
  std::vector<std::vector<Operation>> shop;
  for (int j = 1; j <= jobs; ++j) {
    problem.objects("task", numbered(fmt::format("t{}x", j), machines));
    problem.init("(= (ready job{0}) 0) (next t{0}x1) (last t{0}x{1})", j, machines);
    problem.goal("(delivered job{})", j);
    std::vector<int> route;
    for (int m = 0; m < machines; ++m) route.push_back(m);
    random.shuffle(route);
    auto& job = shop.emplace_back();
    for (int k = 1; k <= machines; ++k) {
      job.push_back({route[static_cast<std::size_t>(k - 1)], random.between(1, 20)});
      problem.init("(part-of t{0}x{1} job{0}) (needs t{0}x{1} machine{2}) (= (takes t{0}x{1}) {3})", j, k,
                   job.back().machine + 1, job.back().takes);
      if (k > 1) problem.init("(follows t{0}x{1} t{0}x{2})", j, k - 1, k);
    }
  }
  problem.metric("minimize (makespan)");
  return {problem.text(), reference(shop, machines), static_cast<double>(lower_bound(shop, machines))};
}

}  // namespace

Generator job_shop() {
  return {"job_shop", "operations on machines, least makespan", kDomain, {1, 2, 4, 6, 9}, 5000, false, draft};
}

}  // namespace stepwright::bench
