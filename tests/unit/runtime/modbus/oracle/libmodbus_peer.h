#pragma once

// libmodbus's modbus_reply as a peer: it answers over a socket pair.
//
// It sees only requests whose length is the one that its own modbus_receive would have read (3.1.6 checks no
// length against the contents of a request), in a buffer that is larger than any offset it may look at.

#include <memory>
#include <optional>

#include "tests/unit/runtime/modbus/oracle/answer.h"
#include "tests/unit/runtime/modbus/oracle/tables.h"

namespace stepwright::modbus::oracle {

class LibmodbusPeer {
 public:
  explicit LibmodbusPeer(Sizes sizes);
  ~LibmodbusPeer();

  // None: modbus_receive would wait for more bytes, or take the rest for the next request.
  std::optional<Answer> ask(const Bytes& pdu);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::modbus::oracle
