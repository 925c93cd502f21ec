#include "tests/bench/planner/measure/child.h"

#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <new>

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kOutOfMemory = 77;  // exit status

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void write_all(int pipe, const std::string& text) {
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = write(pipe, text.data() + sent, text.size() - sent);
    if (n < 0 && errno != EINTR) _exit(1);
    if (n > 0) sent += static_cast<std::size_t>(n);
  }
}

[[noreturn]] void in_child(const ChildLimits& limits, int pipe,
                           const std::function<void(const Send&)>& body) {
  setpgid(0, 0);
  if (limits.memory_mb > 0) {
    const rlimit limit{limits.memory_mb << 20, limits.memory_mb << 20};
    setrlimit(RLIMIT_AS, &limit);
  }
  try {
    body([pipe](const std::string& line) { write_all(pipe, line + "\n"); });
  } catch (const std::bad_alloc&) {
    _exit(kOutOfMemory);
  }
  _exit(0);
}

// Reads until the child closes the pipe or the time is over; false in the latter case.
bool read_lines(int pipe, const ChildLimits& limits, Clock::time_point start, std::string& text) {
  std::array<char, 65536> buffer{};
  while (true) {
    const double left = static_cast<double>(limits.time.count()) - ms_since(start);
    if (limits.time.count() > 0 && left <= 0) return false;
    pollfd wait{pipe, POLLIN, 0};
    const int ready = poll(&wait, 1, limits.time.count() > 0 ? static_cast<int>(left) + 1 : -1);
    if (ready <= 0) continue;
    const ssize_t n = read(pipe, buffer.data(), buffer.size());
    if (n == 0) return true;
    if (n > 0) text.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0;;) {
    const std::size_t to = text.find('\n', from);
    if (to == std::string::npos) return lines;  // a line cut off by the end is not one
    lines.push_back(text.substr(from, to - from));
    from = to + 1;
  }
}

double ms_of(const timeval& time) {
  return 1000.0 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1000.0;
}

}  // namespace

const char* to_string(ChildEnd end) {
  switch (end) {
    case ChildEnd::Done:
      return "done";
    case ChildEnd::OutOfTime:
      return "out of time";
    case ChildEnd::OutOfMemory:
      return "out of memory";
    case ChildEnd::Crashed:
      break;
  }
  return "crashed";
}

ChildResult run_child(const ChildLimits& limits, const std::function<void(const Send&)>& body) {
  std::array<int, 2> ends{};
  ChildResult result;
  std::fflush(nullptr);
  // The child begins with a copy of what this process holds: judging a plan of millions of steps took
  // gigabytes.
  malloc_trim(0);
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return result;
  const Clock::time_point start = Clock::now();
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    in_child(limits, ends[1], body);
  }
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    return result;
  }
  std::string text;
  const bool in_time = read_lines(ends[0], limits, start, text);
  close(ends[0]);
  kill(-child, SIGKILL);  // the child, if it is late, and in any case what it may have left behind
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  result.lines = split(text);
  result.wall_ms = ms_since(start);
  result.cpu_ms = ms_of(usage.ru_utime) + ms_of(usage.ru_stime);
  result.peak_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
  if (!in_time) {
    result.end = ChildEnd::OutOfTime;
  } else if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    result.end = ChildEnd::Done;
  } else if (WIFEXITED(status) && WEXITSTATUS(status) == kOutOfMemory) {
    result.end = ChildEnd::OutOfMemory;
  }
  return result;
}

ChildResult run_command(const ChildLimits& limits, const std::string& command) {
  return run_child(limits, [&](const Send&) {
    // The pipe stays open in a process between us and the shell, so that the end of the pipe is the end of
    // all.
    const pid_t shell = fork();
    if (shell == 0) {
      const int nowhere = open("/dev/null", O_RDWR);
      for (const int stream : {0, 1, 2}) dup2(nowhere, stream);
      execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
    int status = 0;
    while (waitpid(shell, &status, 0) < 0 && errno == EINTR) {
    }
  });
}

}  // namespace stepwright::bench
