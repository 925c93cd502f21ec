#pragma once

// A pseudo terminal: what a test writes into it comes out of its device.

#include <fcntl.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <string>

namespace stepwright::modbus::server {

struct Pty {
  Pty() {
    std::array<char, 128> name{};
    if (::openpty(&master, &slave, name.data(), nullptr, nullptr) != 0) throw std::runtime_error("no pty");
    ::fcntl(master, F_SETFL, O_NONBLOCK);
    device = name.data();
  }
  ~Pty() { close(); }
  Pty(const Pty&) = delete;
  // As if the adapter were pulled out.
  void close() {
    for (int* each : {&master, &slave}) {
      if (*each >= 0) ::close(*each);
      *each = -1;
    }
  }

  int master = -1;
  int slave = -1;
  std::string device;
};

}  // namespace stepwright::modbus::server
