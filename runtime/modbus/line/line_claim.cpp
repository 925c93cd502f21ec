#include "runtime/modbus/line/line_claim.h"

#include <fcntl.h>
#include <linux/serial.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>

namespace stepwright::modbus::line {

int lock(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return 0;
  return errno == EWOULDBLOCK ? EBUSY : errno;
}

bool is_pseudo_terminal(int descriptor) {
  constexpr unsigned kFirst = 136;  // Linux, Documentation/admin-guide/devices.txt: Unix98 PTY slaves
  constexpr unsigned kLast = 143;
  struct stat device {};
  if (::fstat(descriptor, &device) != 0) return false;
  return major(device.st_rdev) >= kFirst && major(device.st_rdev) <= kLast;
}

void keep_others_out(int descriptor) {
  if (!is_pseudo_terminal(descriptor)) ::ioctl(descriptor, TIOCEXCL);
}

void ask_for_low_latency(int descriptor) {
  serial_struct settings{};
  if (::ioctl(descriptor, TIOCGSERIAL, &settings) != 0) return;
  settings.flags |= ASYNC_LOW_LATENCY;
  ::ioctl(descriptor, TIOCSSERIAL, &settings);
}

bool has_taken(int descriptor, const termios& wanted) {
  termios taken{};
  if (::tcgetattr(descriptor, &taken) != 0) return false;
  const tcflag_t format =
      is_pseudo_terminal(descriptor) ? tcflag_t{CSTOPB} : tcflag_t{CSTOPB | CSIZE | PARENB | PARODD};
  return ::cfgetospeed(&taken) == ::cfgetospeed(&wanted) &&
         (taken.c_cflag & format) == (wanted.c_cflag & format);
}

namespace {

// glibc refuses to set a pseudo terminal, which drops the parity, to what it has already, parity included: as
// a process that was killed leaves it. With another speed there is something to change.
void make_settable(int descriptor) {
  termios settings{};
  if (::tcgetattr(descriptor, &settings) != 0) return;
  ::cfsetispeed(&settings, B50);
  ::cfsetospeed(&settings, B50);
  ::tcsetattr(descriptor, TCSANOW, &settings);
}

}  // namespace

int LineClaim::take(const std::string& device) {
  descriptor_ = ::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) return errno;
  const int error = ::isatty(descriptor_) == 1 ? lock(descriptor_) : ENOTTY;
  if (error != 0) release();
  if (error == 0 && is_pseudo_terminal(descriptor_)) make_settable(descriptor_);
  device_ = device;
  return error;
}

bool LineClaim::moved() const {
  struct stat locked {};
  struct stat there {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &locked) != 0) return false;
  return ::stat(device_.c_str(), &there) == 0 && there.st_rdev != locked.st_rdev;
}

void LineClaim::release() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

}  // namespace stepwright::modbus::line
