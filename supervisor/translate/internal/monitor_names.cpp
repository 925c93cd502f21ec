#include "supervisor/translate/internal/monitor_names.h"

#include <fmt/format.h>

namespace stepwright::translate::internal {

std::string numbered(const char* name, std::size_t number) {
  return fmt::format("{}_{:02}", name, number);
}

std::string run_flag(std::size_t action) {
  return numbered("MON_RUN", action + 1);
}

std::string fail_flag(std::size_t action) {
  return numbered("MON_FAILED", action + 1);
}

std::string ran_flag(std::size_t action) {
  return numbered("RAN", action + 1);
}

std::string had_failed_flag(std::size_t action) {
  return numbered("HAD_FAILED", action + 1);
}

std::string still_variable(const Sensor& sensor) {
  return "STILL_" + sensor.name;
}

std::string last_variable(const Sensor& sensor) {
  return "LAST_" + sensor.name;
}

std::string mark_variable(std::size_t action) {
  return numbered("MARK", action + 1);
}

std::string since_variable(std::size_t action) {
  return numbered("SINCE", action + 1);
}

}  // namespace stepwright::translate::internal
