#include "cell/monitor_check/monitor_names.h"

namespace stepwright::cell_monitors {

std::string program_name(const std::string& monitor) {
  return "monitor_" + monitor;
}

std::string failed_tag(const std::string& monitor) {
  return program_name(monitor) + ".Failed";
}

}  // namespace stepwright::cell_monitors
