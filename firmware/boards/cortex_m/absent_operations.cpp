// What the basic firmware has instead of runtime/operations/string_ops.cpp and elementary.cpp. Programs that
// use them are refused before they are loaded (app/operation_set.h).

#include "runtime/operations/elementary.h"
#include "runtime/operations/string_ops.h"

namespace stepwright::operations {

bytecode::TrapCode call_string_op(bytecode::StringOpId, Slot*&, std::span<std::byte>, std::uint64_t&) {
  return bytecode::TrapCode::BadArgument;
}
bool elementary(Elementary, double, double&) {
  return false;
}
double arc_tangent(double, double) {
  return 0.0;
}
bool power(double, double, double&) {
  return false;
}

}  // namespace stepwright::operations
