#include "cell/reference/sample_files.h"

#include <array>

namespace stepwright::reference {
namespace {

constexpr std::array<std::string_view, 1> kAlarms = {R"(
[[alarm]]
[alarm.de]
[alarm.en]
[alarm.es]
[alarm.fr]
)"};

constexpr std::array<std::string_view, 2> kRecipes = {R"(
[[tag]]
type = "BOOL"
)",
                                                      R"(
[[tag]]
type = "REAL"
)"};

constexpr std::array<std::string_view, 1> kBindings = {R"toml(
[tags.NAME]
[sensors.NAME]
fluent = "(level a1)"
[[facts]]
[[one_of]]
search = [{}]
[[exclusive]]
[[actions]]
action = "(load ?v)"
transfers = [{}]
[[devices]]
)toml"};

// Terminals, values and faults have a short form and a long one.
constexpr std::array<std::string_view, 2> kPlants = {R"(
[types.TYPE]
[types.TYPE.parameters.PARAMETER]
unit = "m"
[types.TYPE.faults.FAULT]
unit = "m"
[types.TYPE.inputs.INPUT]
unit = "m"
default = "1 m"
[types.TYPE.ports.FLUID_PORT]
[types.TYPE.ports.NODE_PORT]
role = "node"
[types.TYPE.states.STATE]
unit = "m"
[types.TYPE.outputs.OUTPUT]
unit = "m"
[types.TYPE.events.EVENT]
set = { STATE = "0 * STATE" }
[assemblies.ASSEMBLY]
parameters.PARAMETER = "1 m"
components.NAME = { type = "nosuch" }
[components.NAME]
type = "ASSEMBLY"
PARAMETER = "2 m"
[terminals]
TERMINAL = "%QX0.0"
[truths]
VALUE = "NAME.level"
[faults]
FAULT = "NAME.leak"
)",
                                                     R"(
[components.NAME]
type = "nosuch"
[terminals]
TERMINAL = { address = "%IX0.0", from = "NAME.level" }
[truths]
VALUE = { of = "NAME.level" }
[faults]
FAULT = { of = "NAME.leak" }
)"};

}  // namespace

std::span<const std::string_view> sample_alarms() {
  return kAlarms;
}
std::span<const std::string_view> sample_recipes() {
  return kRecipes;
}
std::span<const std::string_view> sample_bindings() {
  return kBindings;
}
std::span<const std::string_view> sample_plants() {
  return kPlants;
}

}  // namespace stepwright::reference
