#include "runtime/ground/process/standard_output.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "runtime/ground/result/exit_code.h"

namespace stepwright::process {
namespace {

bool reader_is_gone() {
  pollfd output{STDOUT_FILENO, 0, 0};
  return poll(&output, 1, 0) == 1 && (output.revents & (POLLERR | POLLHUP)) != 0;
}

void check_output(int exit, void* /*context*/) {
  errno = 0;
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (written || exit != to_int(result::ExitCode::Done) || reader_is_gone()) return;
  // The reason of an earlier write is not known any more.
  std::fprintf(stderr, "E0002: standard output cannot be written%s%s\n", errno == 0 ? "" : ": ",
               errno == 0 ? "" : std::strerror(errno));
  std::_Exit(to_int(result::ExitCode::BadInput));
}

}  // namespace

void tell_lost_output() {
  on_exit(check_output, nullptr);
}

}  // namespace stepwright::process
