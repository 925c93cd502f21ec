// `stepwright guard --config CELL.toml`: drives the outputs of a cell in shared memory to their safe state
// when its runtime is lost, until another runtime takes over. SIGTERM ends it and leaves the outputs as they
// are.

#include <poll.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>

#include "cell/config/cell_options.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/stop_signal.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/io_memory/output_guard.h"

namespace stepwright::guard {
namespace {

using io_memory::OutputGuard;
using result::ExitCode;

// Above the scan thread's.
constexpr int kPriority = 82;
constexpr std::int64_t kNsPerMs = 1'000'000;
constexpr std::chrono::milliseconds kStandby{20};

struct Options {
  int starter = 0;         // the runtime that started it; 0: nobody, the guard stays until it is asked to end
  int ready = -1;          // where to write a byte once it watches
  bool standby = false;    // waits while another guard watches
  bool concerned = false;  // only tells whether the cell wants one
};

// The process that started the guard.
class Starter {
 public:
  explicit Starter(int pid)
      : pid_(pid), process_(pid == 0 ? -1 : static_cast<int>(syscall(SYS_pidfd_open, pid, 0))) {}
  ~Starter() {
    if (process_ >= 0) close(process_);
  }
  Starter(const Starter&) = delete;
  Starter& operator=(const Starter&) = delete;

  // False for ever if there is none.
  bool gone() const {
    pollfd entry{process_, POLLIN, 0};
    return pid_ != 0 && (process_ < 0 || poll(&entry, 1, 0) == 1);
  }

 private:
  int pid_;
  int process_;
};

void enter_real_time() {
  prctl(PR_SET_TIMERSLACK, 1uL, 0uL, 0uL, 0uL);
  sched_param parameters{};
  parameters.sched_priority = kPriority;
  if (sched_setscheduler(0, SCHED_FIFO, &parameters) != 0)
    std::printf("note: no real-time priority (SCHED_FIFO: %s)\n", std::strerror(errno));
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
    std::printf("note: memory is not locked (mlockall: %s)\n", std::strerror(errno));
}

result::Result<std::unique_ptr<OutputGuard>> make_guard(const config::CellConfig& config) {
  if (!config.safety.io.shared_memory) {
    return result::fail(
        "C0446", {config.file.string(), 0, 0}, "a guard can drive outputs in shared memory only",
        "[io] kind = \"shared_memory\"; the simulated plant of [plant] ends with its runtime");
  }
  const std::int64_t timeout_ns = config.safety.guard.timeout.count() * kNsPerMs;
  io_memory::GuardOptions options;
  options.timeout_ns = timeout_ns;
  options.tick_ns = std::min<std::int64_t>(options.tick_ns, timeout_ns / 4);
  return OutputGuard::create(config.safety.io.name, config.image.input_bytes, config.image.output_bytes,
                             config.safety.host.safe_state.matrix(), options);
}

int run(const config::CellConfig& config, const Options& options) {
  const process::StopSignal stop;
  auto guard = make_guard(config);
  while (!guard && options.standby && guard.error().front().code == io_memory::kGuardedAlready) {
    if (stop.wait_for(kStandby)) return to_int(ExitCode::Done);
    guard = make_guard(config);
  }
  if (!guard) return process::fail(guard.error(), ExitCode::BadInput);
  enter_real_time();
  std::printf("guard of '%s' watches %s\n", config.name.c_str(),
              io_memory::area_path(config.safety.io.name).c_str());
  std::fflush(stdout);
  if (options.ready >= 0) {
    [[maybe_unused]] const ssize_t written = write(options.ready, "r", 1);
    close(options.ready);
  }
  const Starter starter(options.starter);
  while (!stop.came()) {
    if (const char* const news = (*guard)->turn(stop.descriptor())) {
      std::printf("%s\n", news);
      std::fflush(stdout);
    }
    // Of use for a runtime that comes back, as long as there is something to guard.
    if (starter.gone() && (*guard)->idle()) break;
  }
  std::printf("guard of '%s' ends\n", config.name.c_str());
  return to_int(ExitCode::Done);
}

}  // namespace
}  // namespace stepwright::guard

int main(int argc, char** argv) {
  CLI::App app{"Drive the outputs to their safe state when the runtime is lost", "stepwright guard"};
  stepwright::config::CellOptions options;
  stepwright::config::add_cell_options(app, options);
  stepwright::guard::Options guard;
  app.add_option(
      "--starter", guard.starter,
      "the process that starts it: the guard ends when that is gone and nobody drives the outputs");
  app.add_option("--ready", guard.ready, "descriptor to write a byte to once the guard watches");
  app.add_flag("--standby", guard.standby,
               "wait while another guard watches, and go on for it when that is gone");
  app.add_flag("--concerned", guard.concerned,
               "only tell by the exit code whether this cell wants a guard: 0 yes, 1 no");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  // Of a file that is wrong the runtime says so.
  if (guard.concerned) {
    return to_int(stepwright::config::concerned(options, [](const stepwright::config::CellConfig& cell) {
      return cell.safety.io.shared_memory && cell.safety.guard.enabled;
    }));
  }
  const auto config = stepwright::config::load_cell(options);
  return config ? stepwright::guard::run(*config, guard) : config.error();
}
