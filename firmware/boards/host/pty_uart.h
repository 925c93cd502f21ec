#pragma once

// The serial line of a board that is a process: a pseudo terminal. Masters open its other side, which has a
// name of its own and, if wanted, a link that is the same each time.

#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <string>

#include "firmware/port/uart.h"

namespace stepwright::boards {

class PtyUart final : public port::Uart {
 public:
  // `link`: a symbolic link to the device, made anew and removed with the line; empty: none. See ok().
  explicit PtyUart(std::string link)
      : link_(std::move(link)), line_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    if (line_ < 0 || ::grantpt(line_) != 0 || ::unlockpt(line_) != 0) return;
    // The other side stays open, so that masters may come and go.
    keep_ = ::open(::ptsname(line_), O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (keep_ < 0) return;
    termios raw{};
    ::tcgetattr(keep_, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(keep_, TCSANOW, &raw);
    ok_ = link_.empty() || linked();
  }
  ~PtyUart() {
    if (ok_ && !link_.empty()) ::unlink(link_.c_str());
    ::close(keep_);
    ::close(line_);
  }
  PtyUart(const PtyUart&) = delete;
  PtyUart& operator=(const PtyUart&) = delete;

  // Whether it could be opened; errno says why not.
  bool ok() const { return ok_; }
  // Name of the device for a master.
  std::string name() const { return link_.empty() ? ::ptsname(line_) : link_; }
  int descriptor() const { return line_; }

  std::size_t read(std::span<std::byte> bytes) override {
    const ssize_t count = ::read(line_, bytes.data(), bytes.size());
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  std::size_t write(std::span<const std::byte> bytes) override {
    const ssize_t count = ::write(line_, bytes.data(), bytes.size());
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }

 private:
  bool linked() const {
    ::unlink(link_.c_str());
    return ::symlink(::ptsname(line_), link_.c_str()) == 0;
  }

  std::string link_;
  int line_ = -1;
  int keep_ = -1;
  bool ok_ = false;
};

}  // namespace stepwright::boards
