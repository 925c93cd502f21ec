#include "tests/bench/grounding/measure.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>

namespace stepwright::bench::grounding {
namespace {

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void limit(int what, rlim_t amount) {
  const rlimit both{amount, amount};
  setrlimit(what, &both);
}

Measured run(const Instance& instance, Ground ground, const Limits& limits) {
  Measured measured;
  const double start = cpu_s();
  const auto task = pddl::parse_task({"domain", instance.domain}, {"problem", instance.problem});
  if (!task) return measured;
  const double parsed = cpu_s();
  const pddl::GroundTask found =
      ground(task->definition(), [&] { return cpu_s() - parsed > limits.seconds; });
  measured.done = !found.cancelled;
  measured.parse_s = parsed - start;
  measured.ground_s = cpu_s() - parsed;
  measured.operators = found.operators.size();
  measured.facts = found.facts.size();
  measured.variables = found.variables.size();
  measured.groups = found.groups.size();
  measured.axioms = found.axioms.size();
  return measured;
}

}  // namespace

Measured measure(const Instance& instance, Ground ground, const Limits& limits) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    limit(RLIMIT_AS, static_cast<rlim_t>(limits.memory_mb) << 20);
    limit(RLIMIT_CPU, static_cast<rlim_t>(2.0 * limits.seconds) + 20);
    limit(RLIMIT_CORE, 0);
    const Measured measured = run(instance, ground, limits);
    const auto written = write(ends[1], &measured, sizeof(measured));
    _exit(written == sizeof(measured) ? 0 : 1);
  }
  close(ends[1]);
  Measured measured;
  if (read(ends[0], &measured, sizeof(measured)) != sizeof(measured)) measured = {};
  close(ends[0]);
  rusage usage{};
  int status = 0;
  wait4(child, &status, 0, &usage);
  measured.peak_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
  return measured;
}

}  // namespace stepwright::bench::grounding
