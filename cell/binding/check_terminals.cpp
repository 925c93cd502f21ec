// What can be said of a binding by the plant: its terminals, and where it is made of components, what stands
// behind them.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "cell/binding/check_binding.h"
#include "cell/runtime/cell_io.h"
#include "plant_models/components/library/catalogue.h"
#include "plant_models/components/model_text.h"
#include "supervisor/translate/address.h"

namespace stepwright::cell_binding {
namespace {

using components::ComponentText;
using components::ModelText;
using result::Diagnostics;
using result::Severity;
using translate::Binding;
using translate::Tag;

std::string exact(double value) {
  return fmt::format("{:.6g}", value);
}

class TerminalCheck {
 public:
  TerminalCheck(const config::CellConfig& config, const Binding& binding)
      : binding_(binding), wires_(cell_runtime::plant_wires(config)) {
    if (config.plant.kind != "model") return;
    auto text = components::read_model(config.plant.file, components::library::catalogue(),
                                       {.seed = config.plant.seed, .uncertainty = config.plant.uncertainty});
    if (text) model_ = std::move(*text);
  }

  Diagnostics run() {
    check_shared_tags();
    if (wires_.empty()) return std::move(problems_);
    for (const std::string& name : used_tags()) check_address(*binding_.tag(name));
    if (!model_) return std::move(problems_);
    for (const translate::Sensor& sensor : binding_.sensors) check_unit(sensor);
    for (const translate::ActionBinding& entry : binding_.actions) check_travel(entry);
    return std::move(problems_);
  }

 private:
  // One reading cannot be two levels.
  void check_shared_tags() {
    std::map<std::string, const translate::Sensor*> readers;
    for (const translate::Sensor& sensor : binding_.sensors) {
      const auto [first, is_new] = readers.emplace(sensor.tag, &sensor);
      if (is_new) continue;
      problems_.push_back(
          {"B0016", Severity::Error, sensor.where,
           fmt::format("'{}' and '{}' read the same tag '{}'", first->second->name, sensor.name, sensor.tag),
           "each sensor has a tag of its own"});
    }
  }

  // Of a plan: a program written by hand may have others.
  std::set<std::string> used_tags() const {
    std::set<std::string> names;
    for (const translate::Sensor& sensor : binding_.sensors) names.insert(sensor.tag);
    for (const translate::ObservedFact& fact : binding_.facts) names.insert(fact.tag);
    for (const translate::ActionBinding& entry : binding_.actions)
      names.insert(entry.outputs.begin(), entry.outputs.end());
    for (const translate::OneOf& group : binding_.one_of)
      for (const translate::Search& search : group.searches) names.insert(search.output);
    return names;
  }

  const bridge::PortWire* wire_at(const translate::Address& wanted) const {
    for (const bridge::PortWire& wire : wires_) {
      const auto at = translate::parse_address(wire.address);
      if (at && at->area == wanted.area && at->first_bit == wanted.first_bit && at->bits == wanted.bits)
        return &wire;
    }
    return nullptr;
  }

  void check_address(const Tag& tag) {
    const auto address = translate::parse_address(tag.address);
    // Memory is no terminal: programs meet there.
    if (!address || address->area == 'M' || wire_at(*address) != nullptr) return;
    std::string known;
    for (const bridge::PortWire& wire : wires_) {
      const auto at = translate::parse_address(wire.address);
      if (at && at->area == address->area && at->bits == address->bits)
        known += (known.empty() ? "" : ", ") + wire.port + " " + wire.address;
    }
    // Of a built-in plant a part may be left out on purpose; then nothing is wired to it.
    const Severity severity = model_ ? Severity::Error : Severity::Warning;
    problems_.push_back(
        {"B0011", severity, tag.where,
         fmt::format("'{}' is at {}, where the plant has no such terminal", tag.name, tag.address),
         known.empty() ? "the plant has none of this kind" : "the plant has " + known});
  }

  const components::TerminalText* terminal_of(const std::string& tag_name) const {
    const Tag* const tag = binding_.tag(tag_name);
    const auto address = tag == nullptr ? std::nullopt : translate::parse_address(tag->address);
    const bridge::PortWire* const wire = address ? wire_at(*address) : nullptr;
    if (wire == nullptr) return nullptr;
    const auto found = std::ranges::find(model_->terminals, wire->port, &components::TerminalText::name);
    return found == model_->terminals.end() ? nullptr : &*found;
  }

  // The component of "card", "card.counts"; and the port that is named.
  const ComponentText* component_of(const std::string& from, std::string* port = nullptr) const {
    const auto find = [&](const std::string& name) {
      const auto found = std::ranges::find(model_->components, name, &ComponentText::name);
      return found == model_->components.end() ? nullptr : &*found;
    };
    if (const ComponentText* whole = find(from)) return whole;
    const std::size_t dot = from.rfind('.');
    if (dot == std::string::npos) return nullptr;
    if (port != nullptr) *port = from.substr(dot + 1);
    return find(from.substr(0, dot));
  }

  void check_unit(const translate::Sensor& sensor) {
    const components::TerminalText* const terminal = terminal_of(sensor.tag);
    const ComponentText* const card = terminal == nullptr ? nullptr : component_of(terminal->from);
    if (card == nullptr || card->type->name != "analog_input" || sensor.unit.empty()) return;
    const auto of_card = card->units.find("low");
    const auto of_sensor = components::parse_unit(sensor.unit);
    if (of_card == card->units.end() || !of_sensor) return;
    const components::Dimension shown = of_card->second.dimension;
    if (shown == of_sensor->dimension) return check_calibration(sensor, *card, *of_sensor);
    // A level in shares of a tank may be said in litres, metres or kilograms of it.
    const ComponentText* const tank = shown.none() ? tank_behind(*card) : nullptr;
    if (shown.none() && tank == nullptr) return;
    const auto whole = tank == nullptr ? std::nullopt : whole_of(*tank, of_sensor->dimension);
    if (whole) return check_calibration(sensor, *card, *of_sensor, *whole);
    if (tank != nullptr && of_sensor->dimension == dimension_of("m")) return;  // of a cone
    const std::string& text = of_card->second.text;
    problems_.push_back(
        {"B0013", Severity::Error, sensor.where,
         fmt::format("'{}' is in {}, and '{}' of the plant is {}", sensor.name, sensor.unit, card->name,
                     tank == nullptr ? "in " + text : "a share of the tank '" + tank->name + "'"),
         "unit = \"" + text + "\", or another tag"});
  }

  static components::Dimension dimension_of(const char* unit) {
    return components::parse_unit(unit).value_or(components::Unit{}).dimension;
  }

  // The tank whose level goes to the card, through sensors or not; null where that is not known.
  const ComponentText* tank_behind(const ComponentText& card) const {
    constexpr int kMostSensors = 8;
    const ComponentText* at = &card;
    for (int n = 0; n < kMostSensors && at != nullptr; ++n) {
      std::string port = "level";
      const ComponentText* before = nullptr;
      for (const components::ConnectionText& each : at->connections)
        if (at->type->ports[each.port].name == "of") before = component_of(each.prefix + each.to, &port);
      if (before == nullptr) return nullptr;
      const bool is_tank = before->type->name == "tank" || before->type->name == "closed_tank";
      if (is_tank) return port == "level" ? before : nullptr;
      at = before->type->name == "level_sensor" ? before : nullptr;
    }
    return nullptr;
  }

  // What a full tank holds or is high, SI; nothing in another unit, or where it does not go in proportion.
  static std::optional<double> whole_of(const ComponentText& tank, const components::Dimension& in) {
    const components::Parameters& p = tank.parameters;
    if (in == dimension_of("m3")) return p["volume"];
    if (in == dimension_of("kg")) return p["volume"] * p.density_kg_m3;
    if (in == dimension_of("m") && (tank.type->name != "tank" || p.is("shape", "upright")))
      return p["height"];
    return std::nullopt;
  }

  // `whole`: what 1 of the card's figure is in the sensor's dimension.
  void check_calibration(const translate::Sensor& sensor, const ComponentText& card,
                         const components::Unit& unit, double whole = 1.0) {
    const auto value_at = [&](double counts) {
      const components::Parameters& p = card.parameters;
      const double share = (counts - p["counts_low"]) / (p["counts_high"] - p["counts_low"]);
      return unit.from_si(whole * (p["low"] + share * (p["high"] - p["low"])));
    };
    for (const translate::CalibrationPoint& point : sensor.calibration.points()) {
      const double there = value_at(point.counts);
      if (std::abs(there - point.value) <= sensor.tolerance) continue;
      const components::Parameters& p = card.parameters;
      problems_.push_back(
          {"B0013", Severity::Error, sensor.where,
           fmt::format("'{}' takes {} counts for {} {}, and '{}' of the plant shows {} there", sensor.name,
                       exact(point.counts), exact(point.value), sensor.unit, card.name, exact(there)),
           fmt::format("calibration = [[{}, {}], [{}, {}]]", exact(unit.from_si(whole * p["low"])),
                       exact(p["counts_low"]), exact(unit.from_si(whole * p["high"])),
                       exact(p["counts_high"]))});
      return;
    }
  }

  // The whole way of what carries an end switch; 0 where that is not known.
  static double travel_of(const ComponentText& component, const std::string& port) {
    const components::Parameters& p = component.parameters;
    if (component.type->name == "cylinder" && port == "extended") return p["extend_time"];
    if (component.type->name == "cylinder" && port == "retracted" && p.is("spring", "no"))
      return p["retract_time"];
    if (component.type->name == "on_off_valve" && (port == "opened" || port == "closed")) return p["travel"];
    return 0.0;
  }

  void check_travel(const translate::ActionBinding& entry) {
    if (entry.completion.kind != translate::CompletionKind::Fact) return;
    const double timeout_s = std::chrono::duration<double>(entry.timeout).count();
    for (const translate::ObservedFact& fact : binding_.facts) {
      const auto ground = translate::parse_pattern(fact.fact);
      const components::TerminalText* const terminal = terminal_of(fact.tag);
      if (!ground || terminal == nullptr || !can_be(entry, *ground)) continue;
      std::string port;
      const ComponentText* const component = component_of(terminal->from, &port);
      const double travel_s = component == nullptr ? 0.0 : travel_of(*component, port);
      if (travel_s <= timeout_s) continue;
      problems_.push_back({"B0015", Severity::Error, entry.where,
                           fmt::format("{} counts as failed after {} s, and '{}' takes {} s for its way",
                                       translate::to_string(entry.pattern), exact(timeout_s), component->name,
                                       exact(travel_s)),
                           fmt::format("timeout_s = {}", exact(std::ceil(1.5 * travel_s)))});
      return;
    }
  }

  // Whether an action of the entry may end with the fact: constants of its pattern are constants of the fact.
  static bool can_be(const translate::ActionBinding& entry, const translate::Pattern& fact) {
    return translate::match(entry.completion.atom, {fact.name, fact.arguments}).has_value();
  }

  const Binding& binding_;
  std::vector<bridge::PortWire> wires_;
  std::optional<ModelText> model_;
  Diagnostics problems_;
};

}  // namespace

Diagnostics check_terminals(const config::CellConfig& config, const Binding& binding) {
  return TerminalCheck(config, binding).run();
}

}  // namespace stepwright::cell_binding
