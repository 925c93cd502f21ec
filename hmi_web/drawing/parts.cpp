#include "hmi_web/drawing/parts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "hmi_web/drawing/trimmed.h"

namespace stepwright::drawing {
namespace {

constexpr std::size_t kLongestText = 4'000;  // of parameters of a symbol, or of a list of tags
constexpr std::size_t kLongestKey = 40;
constexpr std::size_t kLongestLiteral = 64;

// Of the whole drawing: `least`, `kind`; of a symbol: `symbol`, `params`; the rest of parts.
constexpr std::array<std::string_view, 16> kAttributes = {
    "data-part",    "data-key",   "data-write",  "data-stop",  "data-value", "data-values",
    "data-confirm", "data-least", "data-go",     "data-label", "data-tags",  "data-minutes",
    "data-step",    "data-kind",  "data-symbol", "data-params"};

struct Kind {
  std::string_view name;
  PartKind kind;
  const char* word;
};
constexpr std::array kKinds = {
    Kind{"button", PartKind::Button, "button"},
    Kind{"switch", PartKind::Switch, "switch"},
    Kind{"setpoint", PartKind::SetPoint, "set point"},
    Kind{"slider", PartKind::Slider, "slider"},
    Kind{"choice", PartKind::Choice, "choice"},
    Kind{"startstop", PartKind::StartStop, "start/stop pair"},
    Kind{"navigate", PartKind::Navigate, "way to a screen"},
    Kind{"trend", PartKind::Trend, "trend"},
    Kind{"alarms", PartKind::Alarms, "list of alarms"},
    Kind{"tags", PartKind::Tags, "table of tags"},
};

const Kind* kind_of(std::string_view name) {
  const auto found = std::ranges::find(kKinds, name, &Kind::name);
  return found == kKinds.end() ? nullptr : &*found;
}

bool is_key(std::string_view text) {
  return !text.empty() && text.size() <= kLongestKey && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

bool is_variable(std::string_view name) {
  return !name.empty() && name.size() <= 200 &&
         std::none_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) <= ' '; });
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t end = text.find(';');
    if (const auto part = trimmed(text.substr(0, end)); !part.empty()) parts.emplace_back(part);
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

class Reader {
 public:
  Reader(pugi::xml_node element, std::vector<std::string>& names, std::vector<BindingMistake>& mistakes)
      : element_(element), names_(names), mistakes_(mistakes) {}

  std::optional<Part> read() {
    for (const pugi::xml_attribute attribute : element_.attributes())
      check(attribute.name(), attribute.value());
    const std::string_view name = text("data-part");
    if (name.empty()) return std::nullopt;
    const Kind* const found = kind_of(name);
    if (found == nullptr) {
      tell("there is no part " + std::string(name.substr(0, kLongestKey)),
           "button, switch, setpoint, slider, choice, startstop, navigate, trend, alarms, tags");
      return std::nullopt;
    }
    part_.kind = found->kind;
    part_.confirm = text("data-confirm");
    part_.engineer = text("data-least") == std::string_view("engineer");
    if (writes(part_.kind)) read_writing();
    if (part_.kind == PartKind::Navigate && text("data-go").empty())
      tell("a navigate part needs data-go", "the name of the screen that it leads to");
    for (std::string& each : split(text("data-tags"))) {
      if (!is_variable(each))
        tell("data-tags has '" + each.substr(0, kLongestKey) + "', which names no variable",
             "names with a semicolon between them: Main.level; Main.flow");
      names_.push_back(std::move(each));
    }
    return std::move(part_);
  }

 private:
  std::string_view text(const char* name) const { return element_.attribute(name).value(); }
  void tell(std::string message, std::string hint) {
    mistakes_.push_back({std::move(message), std::move(hint)});
  }

  void check(std::string_view name, std::string_view value) {
    if (!is_part_attribute(name)) return;
    if (value.size() > kLongestText)
      tell(std::string(name) + " is longer than " + std::to_string(kLongestText) + " bytes", "shorten it");
    if (name == "data-least" && value != "viewer" && value != "operator" && value != "engineer")
      tell("data-least=\"" + std::string(value.substr(0, kLongestKey)) + "\" is no role",
           "viewer, operator or engineer");
    if (name == "data-kind" && value != "screen" && value != "symbol")
      tell("data-kind is screen or symbol", "of the whole drawing");
    double number = 0;
    if ((name == "data-minutes" || name == "data-step") && !(read_number(value, number) && number > 0))
      tell(std::string(name) + " is a number above 0", "such as 10");
  }

  static bool read_number(std::string_view text, double& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size() && std::isfinite(number);
  }

  // The names of what it writes, its key and what may be written.
  void read_writing() {
    part_.key = text("data-key");
    if (!is_key(part_.key))
      tell("a part that writes needs data-key, its name in the drawing",
           "up to 40 letters, digits, - and _: the page asks for the write by it");
    part_.write = text("data-write");
    if (!is_variable(part_.write))
      tell("a part that writes needs data-write", "the whole name of a variable: Main.level");
    else
      names_.push_back(part_.write);
    if (part_.kind == PartKind::StartStop && !text("data-stop").empty()) {
      part_.stop = text("data-stop");
      if (is_variable(part_.stop))
        names_.push_back(part_.stop);
      else
        tell("data-stop names no variable", "the whole name of a variable: Main.stop");
    }
    if (part_.kind == PartKind::Button) {
      part_.value = text("data-value");
      if (part_.value.empty() || part_.value.size() > kLongestLiteral)
        tell("a button needs data-value, the value that it writes", "a literal such as TRUE, 4 or T#2s");
    }
    if (part_.kind == PartKind::SetPoint || part_.kind == PartKind::Slider) read_range();
    if (part_.kind == PartKind::Choice) read_values();
  }

  void read_range() {
    double from = 0;
    double to = 0;
    if (!read_number(text("data-from"), from) || !read_number(text("data-to"), to) || from >= to)
      return tell("a set point and a slider need their range, data-from below data-to",
                  "the least and the greatest value that may be written");
    part_.least = from;
    part_.most = to;
  }

  void read_values() {
    for (const std::string& each : split(text("data-values"))) {
      const std::size_t equals = std::min(each.find('='), each.size());
      std::string literal(trimmed(std::string_view(each).substr(0, equals)));
      std::string name(trimmed(std::string_view(each).substr(std::min(equals + 1, each.size()))));
      if (literal.empty() || literal.size() > kLongestLiteral) continue;
      part_.values.emplace_back(literal, name.empty() ? literal : std::move(name));
    }
    if (part_.values.size() < 2)
      tell("a choice needs data-values with two or more", "literals and their names: 0=Off;1=By hand");
  }

  pugi::xml_node element_;
  std::vector<std::string>& names_;
  std::vector<BindingMistake>& mistakes_;
  Part part_;
};

}  // namespace

bool writes(PartKind kind) {
  return kind < PartKind::Navigate;
}

const char* word_of(PartKind kind) {
  const auto found = std::ranges::find(kKinds, kind, &Kind::kind);
  return found == kKinds.end() ? "part" : found->word;
}

bool is_part_attribute(std::string_view name) {
  return std::find(kAttributes.begin(), kAttributes.end(), name) != kAttributes.end();
}

std::span<const std::string_view> part_attributes() {
  return kAttributes;
}

std::optional<Part> read_part(pugi::xml_node element, std::vector<std::string>& names,
                              std::vector<BindingMistake>& mistakes) {
  return Reader(element, names, mistakes).read();
}

std::optional<BindingMistake> idle_symbol(pugi::xml_node element) {
  const Kind* const found = kind_of(element.attribute("data-symbol").value());
  if (found == nullptr || found->kind > PartKind::Navigate || element.attribute("data-part"))
    return std::nullopt;
  const auto params = nlohmann::json::parse(element.attribute("data-params").value(), nullptr,
                                            /*allow_exceptions=*/false);
  const auto said = [&](const char* name) {
    const auto member = params.is_object() ? params.find(name) : params.end();
    return member != params.end() && member->is_string() ? member->get<std::string>() : std::string();
  };
  const std::string label = said("label").empty() ? said("key") : said("label");
  const bool leads = found->kind == PartKind::Navigate;
  return BindingMistake{
      "the " + std::string(found->word) + " '" + label + "' " + (leads ? "leads nowhere" : "writes nothing"),
      leads                   ? "'Leads to' in its properties: the screen"
      : said("write").empty() ? "'Writes' in its properties: the variable"
                              : "the value, the values or the range that it writes, in its properties"};
}

}  // namespace stepwright::drawing
