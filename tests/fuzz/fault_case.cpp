#include "tests/fuzz/fault_case.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cstring>

namespace stepwright::fuzz {

namespace {

constexpr const char* kFile = "fuzz_mutation_finding.swb";

char name_of_case[256];
std::span<const std::byte> bytes_of_case;

// A signal's handler: system calls only, and the signal happens again without it.
void on_fault(int signal) {
  keep_case();
  constexpr char kText[] = "\nstopped by a fault, the container is in fuzz_mutation_finding.swb: ";
  [[maybe_unused]] auto written = ::write(STDERR_FILENO, kText, sizeof kText - 1);
  written = ::write(STDERR_FILENO, name_of_case, std::strlen(name_of_case));
  written = ::write(STDERR_FILENO, "\n", 1);
  ::signal(signal, SIG_DFL);
}

void listen() {
  static bool listens = false;
  if (listens) return;
  listens = true;
  for (const int each : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL}) ::signal(each, on_fault);
}

}  // namespace

void name_case(const std::string& name, std::span<const std::byte> bytes) {
  listen();
  name_of_case[name.copy(name_of_case, sizeof name_of_case - 1)] = '\0';
  bytes_of_case = bytes;
}

const char* keep_case() {
  const int file = ::open(kFile, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  [[maybe_unused]] const auto written = ::write(file, bytes_of_case.data(), bytes_of_case.size());
  ::close(file);
  return kFile;
}

}  // namespace stepwright::fuzz
