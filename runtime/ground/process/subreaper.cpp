#include "runtime/ground/process/subreaper.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>

namespace stepwright::process {
namespace {

constexpr time_t kGrace_s = 2;  // from SIGTERM on
constexpr int kCannotFork = 126;
constexpr timespec kMoment{0, 1'000'000};

// Of this process; what their own children become when they are gone is a child, too. False: not to be told.
bool kill_children() {
  const int file = open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  char text[4096];
  const ssize_t size = read(file, text, sizeof text);
  close(file);
  pid_t pid = 0;
  for (ssize_t i = 0; i < size; ++i) {
    if (text[i] >= '0' && text[i] <= '9') {
      pid = pid * 10 + (text[i] - '0');
      continue;
    }
    if (pid > 1) kill(pid, SIGKILL);
    pid = 0;
  }
  return size >= 0;
}

void kill_rest(pid_t program) {
  kill(-program, SIGKILL);  // its group: where the system has no list of children
  for (;;) {
    const bool told = kill_children();
    pid_t reaped = 0;
    do {
      reaped = waitpid(-1, nullptr, WNOHANG);
    } while (reaped > 0);
    if (reaped < 0 || !told) return;
    nanosleep(&kMoment, nullptr);
  }
}

// Reaps whatever has ended. Whether the program has.
bool has_ended(pid_t program, int& status) {
  for (;;) {
    int of_any = 0;
    const pid_t reaped = waitpid(-1, &of_any, WNOHANG);
    if (reaped <= 0) return false;
    if (reaped != program) continue;
    status = of_any;
    return true;
  }
}

// Its status, as of waitpid(2).
int watch(pid_t program) {
  sigset_t awaited;
  sigemptyset(&awaited);
  for (const int each : {SIGCHLD, SIGTERM, kKillProgram}) sigaddset(&awaited, each);
  bool asked = false;
  int status = 0;
  while (!has_ended(program, status)) {
    const timespec grace{kGrace_s, 0};
    const int got = sigtimedwait(&awaited, nullptr, asked ? &grace : nullptr);
    if (got == SIGTERM) {
      asked = true;
      kill(program, SIGTERM);
    } else if (got == kKillProgram || (got < 0 && errno == EAGAIN)) {
      kill(program, SIGKILL);
    }
  }
  return status;
}

[[noreturn]] void end_as(int status) {
  if (!WIFSIGNALED(status)) _exit(WEXITSTATUS(status));
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);  // the program has left its own
  signal(WTERMSIG(status), SIG_DFL);
  sigset_t open;
  sigemptyset(&open);
  sigaddset(&open, WTERMSIG(status));
  kill(getpid(), WTERMSIG(status));
  sigprocmask(SIG_UNBLOCK, &open, nullptr);
  _exit(128 + WTERMSIG(status));
}

}  // namespace

void stand_over_program() {
  signal(SIGCHLD, SIG_DFL);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t subreaper = getpid();
  const pid_t program = fork();
  if (program < 0) _exit(kCannotFork);
  if (program == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != subreaper) _exit(1);
    setpgid(0, 0);
    return;
  }
  setpgid(program, program);  // whichever of both is first
  prctl(PR_SET_NAME, "subreaper");
  static_cast<void>(close_range(STDERR_FILENO + 1, ~0u, 0));
  const int status = watch(program);
  kill_rest(program);
  end_as(status);
}

}  // namespace stepwright::process
