#pragma once

// Modbus TCP in front of a controller that is a process, in the place of its serial line: as an Ethernet
// coupler beside it would speak. One master at a time, the newest, as on a line.
//
//   TcpLine line(1502);
//   while (line.ok()) line.work(slave);

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/modbus/pdu/data_model.h"

namespace stepwright::boards {

class TcpLine {
 public:
  // On this port of the loopback; 0: any that is free. See ok().
  explicit TcpLine(std::uint16_t port);
  ~TcpLine();
  TcpLine(const TcpLine&) = delete;
  TcpLine& operator=(const TcpLine&) = delete;

  // Whether it could be opened; errno says why not.
  bool ok() const { return waits_ >= 0; }
  // "127.0.0.1:1502"
  std::string name() const;
  // Readable when a master comes or says something.
  int descriptor() const { return waits_; }

  // Takes what has arrived and answers it; never waits. False if there was nothing to do.
  bool work(modbus::pdu::DataModel& model);

 private:
  bool open(std::uint16_t port);
  bool greet();
  bool serve(modbus::pdu::DataModel& model);
  void hang_up();

  int listener_ = -1;
  int waits_ = -1;  // epoll: listener and peer
  int peer_ = -1;
  std::vector<std::byte> held_;  // of a request that has not arrived whole
};

}  // namespace stepwright::boards
