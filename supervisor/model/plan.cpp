#include "supervisor/model/plan.h"

namespace stepwright::model {

std::string to_string(const GroundAction& action) {
  std::string text = "(" + action.name;
  for (const std::string& argument : action.arguments) text += " " + argument;
  return text + ")";
}

}  // namespace stepwright::model
