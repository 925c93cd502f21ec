#include "runtime/modbus/master/outcome.h"

#include <cerrno>
#include <cstring>

namespace stepwright::modbus::master {
namespace {

// Numbers from here on are libmodbus's own (MODBUS_ENOBASE): they have no text of the system.
constexpr int kFirstOwnError = 112345678;

struct Kind {
  const char* code;
  const char* text;
  const char* hint;
};

Kind kind_of(Fault fault) {
  switch (fault) {
    case Fault::None:
      return {"", "good", ""};
    case Fault::NotConnected:
      return {"R0121", "no connection", "is the address right, and the device switched on?"};
    case Fault::Timeout:
      return {"R0122", "no answer within the timeout",
              "is the unit number right, and the timeout long enough?"};
    case Fault::ConnectionLost:
      return {"R0123", "the connection is lost", ""};
    case Fault::Exception:
      return {"R0124", "the slave refuses",
              "compare address, count and access with the slave's register map"};
    case Fault::BadAnswer:
      return {"R0125", "the answer is not one to this request",
              "two masters or two slaves of one unit number?"};
    case Fault::BadRequest:
      return {"R0126", "not a request of the protocol",
              "1 to 125 registers, 1 to 2000 bits, addresses to 65535"};
  }
  return {"", "", ""};
}

}  // namespace

const char* exception_name(std::uint8_t exception) {
  switch (exception) {
    case 1:
      return "illegal function";
    case 2:
      return "illegal data address";
    case 3:
      return "illegal data value";
    case 4:
      return "server device failure";
    case 5:
      return "acknowledge";
    case 6:
      return "server device busy";
    case 7:
      return "negative acknowledge";
    case 8:
      return "memory parity error";
    case 10:
      return "gateway path unavailable";
    case 11:
      return "gateway target device failed to respond";
    default:
      return "unknown exception";
  }
}

std::string Outcome::text() const {
  if (fault == Fault::Exception)
    return "exception " + std::to_string(exception) + " (" + exception_name(exception) + ")";
  std::string text = kind_of(fault).text;
  const bool told = fault == Fault::NotConnected || fault == Fault::ConnectionLost;
  if (fault == Fault::NotConnected && system_error == EBUSY)
    return text + ": the line is in use, by another process or under another name";
  if (told && system_error > 0 && system_error < kFirstOwnError)
    text += std::string(": ") + std::strerror(system_error);
  return text;
}

result::Result<void> Outcome::result(const result::Location& where) const {
  if (good()) return {};
  const Kind kind = kind_of(fault);
  return result::fail(kind.code, where, text(), kind.hint);
}

}  // namespace stepwright::modbus::master
