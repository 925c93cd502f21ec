#include "runtime/io_memory/process_mark.h"

#include <dirent.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

namespace stepwright::io_memory {
namespace {

// 0 if it cannot be asked.
std::uint64_t space_of(const std::string& process) {
  struct stat info {};
  return stat(("/proc/" + process + "/ns/pid").c_str(), &info) == 0 ? info.st_ino : 0;
}

// The number of a process in its own namespace: the last one of the line "NSpid:" of its status.
std::uint32_t innermost_pid(const std::string& process) {
  const std::unique_ptr<FILE, int (*)(FILE*)> file(fopen(("/proc/" + process + "/status").c_str(), "re"),
                                                   fclose);
  if (file == nullptr) return 0;
  char line[512];
  while (fgets(line, sizeof line, file.get()) != nullptr) {
    const std::string text(line);
    if (!text.starts_with("NSpid:")) continue;
    return static_cast<std::uint32_t>(std::strtoul(text.c_str() + text.find_last_of(" \t"), nullptr, 10));
  }
  return 0;
}

int open_pid(std::uint32_t pid) {
  return static_cast<int>(syscall(SYS_pidfd_open, static_cast<pid_t>(pid), 0));
}

int find_elsewhere(const ProcessMark& mark) {
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir("/proc"), closedir);
  if (folder == nullptr) return -1;
  while (const dirent* const entry = readdir(folder.get())) {
    const std::string name = entry->d_name;
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    if (space_of(name) != mark.space || innermost_pid(name) != mark.pid) continue;
    return open_pid(static_cast<std::uint32_t>(std::strtoul(name.c_str(), nullptr, 10)));
  }
  return -1;
}

}  // namespace

ProcessMark ProcessMark::own() {
  return {static_cast<std::uint32_t>(getpid()), space_of("self")};
}

int open_process(const ProcessMark& mark) {
  if (mark.pid == 0) return -1;
  const bool here = mark.space == 0 || mark.space == space_of("self");
  return here ? open_pid(mark.pid) : find_elsewhere(mark);
}

bool kill_process(int descriptor) {
  return syscall(SYS_pidfd_send_signal, descriptor, SIGKILL, nullptr, 0) == 0 || errno == ESRCH;
}

}  // namespace stepwright::io_memory
