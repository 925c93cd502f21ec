#include "cell/hmi/component_symbols.h"

#include <algorithm>
#include <array>

#include "cell/hmi/drawing_units.h"

namespace stepwright::hmi {
namespace {

// Drawn in a square of 18 units; what measures is a circle with the letter of what it measures (ISA-5.1).
struct Symbol {
  std::string_view type;
  std::string_view path{};
  std::string_view letter{};
  bool round = false;  // in a circle
};

constexpr std::string_view kCircle = "M17 9A8 8 0 1 1 1 9A8 8 0 1 1 17 9";

constexpr std::array kSymbols = {
    Symbol{"tank", "M3 2V16H15V2"},
    Symbol{"closed_tank", "M3 5Q9 -1 15 5V13Q9 19 3 13Z"},
    Symbol{"double_tank", "M4 1V8H14V1M4 10V17H14V10"},
    Symbol{"source", "M1 9H15M11 5L15 9L11 13"},
    Symbol{"sink", "M9 1V12M5 8L9 12L13 8M2 16H16"},
    Symbol{"pipe", "M1 6H17M1 12H17"},
    Symbol{"pump", "M9 1L17 9L9 17", "", true},
    Symbol{"control_valve", "M1 7L17 17V7L1 17ZM9 12V5M5 5Q9 0 13 5Z"},
    Symbol{"on_off_valve", "M1 7L17 17V7L1 17ZM9 12V5M5 1H13V5H5Z"},
    Symbol{"three_way_valve", "M1 3L17 13V3L1 13ZM9 8L5 17H13Z"},
    Symbol{"selector", "M1 9H6M6 9L17 2M6 9L17 7M6 9L17 12M6 9L17 17"},
    Symbol{"heater", "M1 9H4L6 4L9 14L12 4L14 9H17"},
    Symbol{"cooler", "M9 1V17M2 5L16 13M16 5L2 13"},
    Symbol{"heat_exchanger", "M1 9H5L8 5L10 13L13 9H17", "", true},
    Symbol{"mixer", "M9 1V12M3 10Q6 16 9 12Q12 8 15 14"},
    Symbol{"motor", "", "M", true},
    Symbol{"conveyor", "M4 6H14A3 3 0 0 1 14 12H4A3 3 0 0 1 4 6"},
    Symbol{"photo_eye", "M7 9A3 3 0 1 1 1 9A3 3 0 1 1 7 9M7 9H9M11 9H13M15 9H17"},
    Symbol{"position_switch", "M1 12H6L14 5M14 12H17"},
    Symbol{"cylinder", "M1 5H12V13H1ZM6 5V13M6 9H17"},
    Symbol{"axis", "M1 15H17M5 15V8H12V15M3 4H15M12 1L15 4L12 7"},
    Symbol{"carriage",
           "M2 5H16V11H2ZM7 14A2 2 0 1 1 3 14A2 2 0 1 1 7 14M15 14A2 2 0 1 1 11 14A2 2 0 1 1 15 14"},
    Symbol{"pendulum", "M2 11H16V16H2ZM9 11L15 2"},
    Symbol{"first_order", "M2 1V16H17M2 16Q5 4 16 4"},
    Symbol{"push_button", "M2 12H16V16H2ZM6 12V6H12V12"},
    Symbol{"lamp", "M3.4 3.4L14.6 14.6M14.6 3.4L3.4 14.6", "", true},
    Symbol{"analog_input", "M1 1H17V17H1ZM5 13L13 5M4 6H8M6 4V8"},
    Symbol{"analog_output", "M1 1H17V17H1ZM5 13L13 5M10 12H14M12 10V14"},
    Symbol{"level_sensor", "", "L", true},
    Symbol{"temperature_sensor", "", "T", true},
    Symbol{"flow_sensor", "", "F", true},
    Symbol{"pressure_sensor", "", "P", true},
    Symbol{"fmu", "M1 1H17V17H1ZM1 6H17"},
};

}  // namespace

std::string component_symbol(std::string_view type, double x, double y) {
  const auto found = std::ranges::find(kSymbols, type, &Symbol::type);
  if (found == kSymbols.end()) return {};
  std::string out = "<g transform=\"translate(" + units(x) + " " + units(y) + ")\"><path d=\"" +
                    std::string(found->round ? kCircle : "") + std::string(found->path) +
                    "\" fill=\"none\" stroke=\"var(--line-strong)\" stroke-width=\"1.2\"/>";
  if (!found->letter.empty())
    out += "<text x=\"9\" y=\"13\" font-size=\"11\" text-anchor=\"middle\" fill=\"var(--text)\">" +
           std::string(found->letter) + "</text>";
  return out + "</g>\n";
}

}  // namespace stepwright::hmi
