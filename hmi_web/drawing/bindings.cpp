#include "hmi_web/drawing/bindings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "hmi_web/drawing/parts.h"
#include "runtime/ground/result/closest.h"

namespace stepwright::drawing {
namespace {

constexpr std::size_t kLongestName = 200;
constexpr double kMostDigits = 6;

// What is bound to a value, and what goes with it.
struct Kind {
  std::string_view name;
  bool is_switch;  // true or false, may begin with "!"
  bool has_range;  // data-from, data-to
  std::array<std::string_view, 2> numbers;
};
constexpr std::array kKinds = {
    Kind{"data-text", false, false, {}},
    Kind{"data-on", true, false, {}},
    Kind{"data-warn", true, false, {}},
    Kind{"data-alarm", true, false, {}},
    Kind{"data-show", true, false, {}},
    Kind{"data-fill", false, true, {}},
    Kind{"data-move", false, true, {"data-x", "data-y"}},
    Kind{"data-turn", false, true, {"data-degrees", ""}},
    Kind{"data-pose-x", false, false, {"data-pose-y", ""}},
    Kind{"data-pose-y", false, false, {"data-pose-x", ""}},
    Kind{"data-pose-heading", false, false, {"data-pose-x", "data-pose-y"}},
};
constexpr std::array<std::string_view, 10> kMore = {
    "data-from",   "data-to",   "data-x",       "data-y",       "data-degrees",
    "data-digits", "data-unit", "data-floor-x", "data-floor-y", "data-floor-scale"};

// A point of a pallet or a box is named with a blank: "pallet p1.x".
bool is_readable(std::string_view name) {
  for (const std::string_view thing : {"pallet ", "box "})
    if (name.starts_with(thing)) name.remove_prefix(thing.size());
  return !name.empty() &&
         std::none_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) <= ' '; });
}

const Kind* kind_of(std::string_view name) {
  const auto found =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& kind) { return kind.name == name; });
  return found == kKinds.end() ? nullptr : &*found;
}

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

bool is_more(std::string_view name) {
  return std::find(kMore.begin(), kMore.end(), name) != kMore.end();
}

class Check {
 public:
  Check(pugi::xml_node element, std::vector<BindingMistake>& mistakes)
      : element_(element), mistakes_(mistakes) {}

  std::vector<std::string> run() {
    for (const pugi::xml_attribute attribute : element_.attributes()) {
      const std::string_view name = attribute.name();
      if (!name.starts_with("data-")) continue;
      if (const Kind* kind = kind_of(name))
        take(*kind, attribute.value());
      else if (is_part_attribute(name))
        continue;  // read_part looks at it
      else if (is_more(name))
        check_more(name, attribute.value());
    }
    if (ranges_ > 1)
      tell("an element has one of data-fill, data-move, data-turn and a pose: each places it",
           "put a group <g> around it for the other one");
    if (element_.attribute("data-pose-x")) check_floor();
    return std::move(bindings_);
  }

 private:
  void tell(std::string message, std::string hint) {
    mistakes_.push_back({std::move(message), std::move(hint)});
  }

  void take(const Kind& kind, std::string_view value) {
    ranges_ += kind.has_range || kind.name == "data-pose-x" ? 1 : 0;
    if (kind.is_switch && value.starts_with('!')) value.remove_prefix(1);
    bindings_.emplace_back(value);
    if (value.size() > kLongestName || !is_readable(value))
      tell(std::string(kind.name) + " is not the name of a value",
           "the whole name of a variable (Main.level) or a point of the plant (a1.level)");
    if (kind.has_range) check_range(kind);
    for (const std::string_view more : kind.numbers)
      if (!more.empty() && !element_.attribute(more.data()))
        tell(std::string(kind.name) + " needs " + std::string(more), hint_of(more));
  }

  static const char* hint_of(std::string_view missing) {
    if (missing.starts_with("data-pose"))
      return "a pose is x and y in m, and a heading in rad where it has one";
    return missing == "data-degrees" ? "how far it turns until data-to"
                                     : "how far it moves until data-to, in the units of the drawing";
  }

  // Where metres are in the drawing: said by the element or by what it stands in.
  void check_floor() {
    for (pugi::xml_node at = element_; at; at = at.parent())
      if (at.attribute("data-floor-scale")) return;
    tell("a pose needs data-floor-scale at the element or at a group around it",
         "data-floor-scale: units of the drawing for a metre; data-floor-x, data-floor-y: where the floor's "
         "origin is");
  }

  void check_range(const Kind& kind) {
    const auto from = number_of(element_.attribute("data-from").as_string("0"));
    const auto to = number_of(element_.attribute("data-to").as_string("100"));
    if (from && to && *from == *to)
      tell(std::string(kind.name) + ": data-from and data-to are the same",
           "a range of the value, such as 0 to 100");
  }

  void check_more(std::string_view name, std::string_view value) {
    if (name == "data-unit") {
      if (value.size() > kLongestName) tell("data-unit is longer than a unit", "such as \"%\" or \"m/s\"");
      return;
    }
    const auto number = number_of(value);
    if (!number)
      return tell(std::string(name) + "=\"" + std::string(value.substr(0, 40)) + "\" is no number",
                  "such as 12.5");
    if (name == "data-floor-scale" && *number <= 0)
      tell("data-floor-scale is more than 0",
           "units of the drawing for a metre; y of the floor goes upwards");
    if (name == "data-digits" && (*number < 0 || *number > kMostDigits || *number != std::floor(*number)))
      tell("data-digits is a whole number from 0 to 6", "how many stand behind the point");
  }

  pugi::xml_node element_;
  std::vector<BindingMistake>& mistakes_;
  std::vector<std::string> bindings_;
  int ranges_ = 0;
};

}  // namespace

bool is_known_data(std::string_view name) {
  return kind_of(name) != nullptr || is_more(name) || is_part_attribute(name);
}

std::string nearest_data(std::string_view name) {
  constexpr std::size_t kPrefix = std::string_view("data-").size();
  if (name.size() > kLongestName) return {};
  std::vector<std::string> known;
  for (const Kind& each : kKinds) known.emplace_back(each.name);
  for (const std::string_view each : kMore) known.emplace_back(each);
  for (const std::string_view each : part_attributes()) known.emplace_back(each);
  const std::string* const found = result::closest(name, known, (name.size() - kPrefix + 2) / 3);
  return found == nullptr ? std::string() : *found;
}

std::vector<std::string> check_bindings(pugi::xml_node element, std::vector<BindingMistake>& mistakes) {
  return Check(element, mistakes).run();
}

}  // namespace stepwright::drawing
