#pragma once

// Claim on a serial device, for a master or a slave: nobody else speaks on it. Beside it two further needs of
// a line: that the driver has taken the settings that were asked for, and that bytes come as they arrive.
//
//   LineClaim claim;
//   if (const int error = claim.take("/dev/ttyUSB0"); error == EBUSY) ...   // another process has the line
//   ... open it, set it up ...
//   claim.keep_others_out(descriptor);
//
// Threads: one. Functions return 0 or an errno.

#include <termios.h>

#include <string>

namespace stepwright::modbus::line {

// Locks a device that is open (flock), against other processes of ours and whoever else asks; also against
// a second opening under another name. EBUSY: it is locked already. The lock ends with the descriptor.
int lock(int descriptor);

// Nobody but root may open the device any more (TIOCEXCL), until the last descriptor is closed. Pseudo
// terminals are left alone: with them the kernel would keep that beyond the end of the process.
void keep_others_out(int descriptor);

// Bytes are passed on as they come, not gathered for some milliseconds. Not every driver can.
void ask_for_low_latency(int descriptor);

// tcsetattr is content with a part of what it was asked for. True if speed, parity and size are those of
// `wanted`; of a pseudo terminal, which has neither parity nor size, the speed and the stop bits.
bool has_taken(int descriptor, const termios& wanted);

bool is_pseudo_terminal(int descriptor);

// A device that is locked by a descriptor of its own, for those that cannot lock the one that they use.
class LineClaim {
 public:
  LineClaim() = default;
  ~LineClaim() { release(); }
  LineClaim(const LineClaim&) = delete;
  LineClaim& operator=(const LineClaim&) = delete;

  // Opens without waiting for a carrier. Requires that nothing is taken.
  int take(const std::string& device);
  void release();
  // The path leads to another device than the one that is locked, as a link does whose adapter was exchanged.
  // Not while nothing is taken, and not while the path leads nowhere.
  bool moved() const;

 private:
  int descriptor_ = -1;
  std::string device_;
};

}  // namespace stepwright::modbus::line
