#pragma once

// Access of clients to addresses. Without rules every client that is let in reads everything and writes
// nothing; with rules the one that fits best decides: a rule with a role before one without, then the longest
// prefix. Whom none fits may nothing.
//
//   const Access access(rules);
//   const Rights rights = access.of(peer);
//   exception = rights.read(Table::HoldingRegisters, 0, 10);
//
// Writing needs the map's word too: only addresses that it calls writable are.
// Immutable; any thread.

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/ground/network/ip_range.h"
#include "runtime/modbus/map/table.h"
#include "runtime/modbus/pdu/exception.h"
#include "runtime/modbus/server/transport.h"

namespace stepwright::modbus::server {

struct Window {
  map::Table table = map::Table::HoldingRegisters;
  std::uint32_t first = 0;
  std::uint32_t last = map::kAddresses - 1;
};

struct ClientRule {
  network::IpRange address;  // "0.0.0.0/0", "::/0": all
  bool any = true;           // no address was given: `address` does not count
  std::string role;          // of the certificate; empty: any, or none
  std::vector<Window> read;
  std::vector<Window> write;
  std::string device;  // the serial line of the client; empty: it comes over IP
};

class Rights {
 public:
  // Everything may be read.
  static Rights reader();
  Rights() = default;  // nothing
  explicit Rights(const ClientRule& rule);

  // None, or why not: 2, an address outside of the windows; 1 if a role decides (Modbus/TCP Security V21, 8:
  // the function is not authorised).
  pdu::Exception read(map::Table table, std::uint16_t first, std::uint16_t count) const;
  pdu::Exception write(map::Table table, std::uint16_t first, std::uint16_t count) const;

 private:
  pdu::Exception judge(const std::vector<Window>& windows, map::Table table, std::uint16_t first,
                       std::uint16_t count) const;
  std::vector<Window> read_;  // sorted, neighbours joined
  std::vector<Window> write_;
  pdu::Exception refusal_ = pdu::Exception::IllegalDataAddress;
};

class Access {
 public:
  explicit Access(std::vector<ClientRule> rules) : rules_(std::move(rules)) {}
  Rights of(const Peer& peer) const;
  // Whether any client may write anything.
  bool any_writes() const;

 private:
  std::vector<ClientRule> rules_;
};

}  // namespace stepwright::modbus::server
