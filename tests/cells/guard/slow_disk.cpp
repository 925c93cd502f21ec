// A disk that takes its time, for a process that loads this first (LD_PRELOAD): fsync and fdatasync return
// when the file that STEPWRIGHT_SLOW_DISK names is gone.

#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>

namespace {

void wait_for_the_test() {
  const char* const gate = getenv("STEPWRIGHT_SLOW_DISK");
  while (gate != nullptr && access(gate, F_OK) == 0) usleep(1'000);
}

}  // namespace

extern "C" int fsync(int descriptor) {
  wait_for_the_test();
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}

extern "C" int fdatasync(int descriptor) {
  wait_for_the_test();
  return static_cast<int>(syscall(SYS_fdatasync, descriptor));
}
