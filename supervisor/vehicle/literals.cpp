#include "supervisor/vehicle/literals.h"

#include <fmt/format.h>

#include "ladder/graphic/literal_text.h"

namespace stepwright::vehicle {

std::string real_literal(double value) {
  return graphic::real_literal(value, 7);
}

std::string time_literal(std::chrono::milliseconds time) {
  return time.count() % 1'000 == 0 ? fmt::format("T#{}s", time.count() / 1'000)
                                   : fmt::format("T#{}ms", time.count());
}

std::string member(const char* name, double value) {
  return fmt::format("{} := {}", name, real_literal(value));
}

}  // namespace stepwright::vehicle
