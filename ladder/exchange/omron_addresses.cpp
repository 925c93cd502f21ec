#include "ladder/exchange/omron_addresses.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "ladder/graphic/identifier.h"
#include "ladder/source/codes.h"

namespace stepwright::exchange {
namespace {

using graphic::Variable;
using graphic::VariableSection;

constexpr int bits_per_word = 16;
constexpr int kWords = 32768;  // of the DM area

std::string padded(int number, std::size_t digits) {
  std::string text = std::to_string(number);
  return std::string(digits > text.size() ? digits - text.size() : 0, '0') + text;
}

std::optional<int> digits(const std::string& text) {
  const bool all = !text.empty() && text.size() <= 5 && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
  });
  return all ? std::optional<int>(std::stoi(text)) : std::nullopt;
}

int words_in(const std::string& area) {
  if (area.empty() || area == "I" || area == "Q") return 6144;
  if (area == "W" || area == "H") return 512;
  if (area == "A") return 960;
  return area == "D" ? kWords : 0;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& n) { return graphic::same_name(n, name); });
}

}  // namespace

std::optional<OmronPlace> parse_omron_address(const std::string& text) {
  std::string plain;
  for (const char c : graphic::upper(text)) {
    if (c != ' ' && c != ':') plain += c;
  }
  const std::size_t start = std::min(plain.find_first_of("0123456789"), plain.size());
  const std::string area = plain.substr(0, start);
  const std::size_t dot = plain.find('.');
  const std::optional<int> word = digits(plain.substr(start, dot == std::string::npos ? dot : dot - start));
  if (!word || *word >= words_in(area)) return std::nullopt;
  const std::string prefix = area == "I" || area == "Q" ? "" : area;
  OmronPlace place;
  place.is_input = area == "I" || area == "A";
  if (dot == std::string::npos) {
    place.kind = OmronPlace::Kind::Word;
    place.code = prefix + std::to_string(*word);
    place.shown = area + (prefix.empty() && !area.empty() ? ":" : "") + std::to_string(*word);
    return place;
  }
  const std::optional<int> bit = digits(plain.substr(dot + 1));
  if (area == "D" || !bit || *bit >= bits_per_word || plain.size() - dot != 3) return std::nullopt;
  const std::string number = std::to_string(*word) + "." + padded(*bit, 2);
  place.code = prefix + number;
  place.shown = area + (prefix.empty() && !area.empty() ? ":" : "") + number;
  return place;
}

std::optional<std::int64_t> time_literal_ns(const std::string& text) {
  const std::string literal = graphic::upper(text);
  const std::size_t hash = literal.find('#');
  if (hash == std::string::npos) return std::nullopt;
  const std::string type = literal.substr(0, hash);
  if (type != "T" && type != "TIME" && type != "LTIME" && type != "LT") return std::nullopt;
  const std::map<std::string, double> units{{"D", 86400e9}, {"H", 3600e9}, {"M", 60e9}, {"S", 1e9},
                                            {"MS", 1e6},    {"US", 1e3},   {"NS", 1}};
  double sum = 0;
  std::size_t at = hash + 1;
  if (at == literal.size()) return std::nullopt;
  while (at < literal.size()) {
    std::string number;
    std::string unit;
    while (at < literal.size() &&
           (std::isdigit(static_cast<unsigned char>(literal[at])) != 0 || literal[at] == '.')) {
      number += literal[at++];
    }
    while (at < literal.size() && std::isalpha(static_cast<unsigned char>(literal[at])) != 0)
      unit += literal[at++];
    while (at < literal.size() && literal[at] == '_') ++at;
    const auto found = units.find(unit);
    if (number.empty() || number.size() > 12 || found == units.end() || number == "." ||
        std::count(number.begin(), number.end(), '.') > 1) {
      return std::nullopt;
    }
    sum += std::stod(number) * found->second;
  }
  return sum < 9e18 ? std::optional<std::int64_t>(std::llround(sum)) : std::nullopt;
}

OmronAddresses::OmronAddresses(const graphic::Pou& pou, const OmronOptions& options,
                               result::Diagnostics& diagnostics)
    : diagnostics_(diagnostics) {
  take_given(options);
  for (const Variable& variable : pou.variables) {
    OmronPlace place;
    if (index_.count(graphic::upper(variable.name)) != 0) {
      Entry& entry = entries_[index_.at(graphic::upper(variable.name))];
      const bool is_bool = graphic::same_name(variable.type, "BOOL");
      const bool is_word = graphic::same_name(variable.type, "INT") ||
                           graphic::same_name(variable.type, "UINT") ||
                           graphic::same_name(variable.type, "WORD");
      if (is_bool != (entry.place.kind == OmronPlace::Kind::Bit) || (!is_bool && !is_word)) {
        fail(source::code::kOmronAddress,
             "variable '" + variable.name + "' of type " + variable.type + " cannot be at " +
                 entry.place.shown,
             "a BOOL takes a bit (0.00), an INT, UINT or WORD a word (D100)");
      }
      entry.place.is_unsigned = !graphic::same_name(variable.type, "INT");
      if (entry.comment.empty()) entry.comment = variable.comment;
    } else {
      allocate(pou, variable);
    }
  }
}

void OmronAddresses::take_given(const OmronOptions& options) {
  for (const OmronAddress& given : options.addresses) {
    const std::optional<OmronPlace> place = parse_omron_address(given.address);
    if (!place) refused_.insert(graphic::upper(given.variable));
    if (given.address.empty()) {
      miss(given.variable);
    } else if (!place) {
      fail(source::code::kOmronAddress,
           "variable '" + given.variable + "' has the address '" + given.address +
               "', which is no Omron address",
           "write I0.00, Q1.00, W40.00 or D100 (bits with two digits)");
    } else {
      assign(given.variable, *place, "");
    }
  }
}

void OmronAddresses::allocate(const graphic::Pou& pou, const Variable& variable) {
  const std::string& type = variable.type;
  const bool local =
      (variable.section == VariableSection::Local || variable.section == VariableSection::Temp) &&
      variable.address.empty();
  const bool is_unsigned = graphic::same_name(type, "UINT") || graphic::same_name(type, "WORD");
  if (graphic::same_name(variable.name, pou.first_scan_variable)) {
    OmronPlace place;
    place.code = place.shown = "A200.11";
    place.is_input = true;
    assign(variable.name, place, "first cycle flag of the controller");
  } else if (refused_.count(graphic::upper(variable.name)) != 0) {
    return;
  } else if (!local) {
    miss(variable.name);
  } else if (graphic::same_name(type, "TON")) {
    next_timer(variable);
  } else if (graphic::same_name(type, "BOOL") && contains(pou.step_variables, variable.name)) {
    next_bit(variable, "steps", next_step_, 10, 20);
  } else if (graphic::same_name(type, "BOOL") && contains(pou.transition_variables, variable.name)) {
    next_bit(variable, "transitions", next_transition_, 20, 30);
  } else if (graphic::same_name(type, "BOOL")) {
    next_bit(variable, "other bits", next_internal_, 30, 512);
  } else if (graphic::same_name(type, "INT") || is_unsigned) {
    next_word(variable, is_unsigned);
  } else {
    fail(source::code::kOmronConstruct,
         "variable '" + variable.name + "' has the type " + type + ", which this export does not have",
         "BOOL, INT, UINT, WORD and TON have exact counterparts");
  }
}

void OmronAddresses::assign(const std::string& variable, OmronPlace place, const std::string& comment) {
  if (!used_.insert(place.code).second) {
    fail(source::code::kOmronAddress, "address " + place.shown + " of variable '" + variable + "' is in use",
         "give it another one");
    return;
  }
  if (!index_.try_emplace(graphic::upper(variable), entries_.size()).second) {
    fail(source::code::kOmronAddress, "variable '" + variable + "' has two addresses", "remove one of them");
    return;
  }
  entries_.push_back({variable, std::move(place), comment});
}

void OmronAddresses::next_bit(const Variable& variable, const char* what, int& next, int first_word,
                              int end_word) {
  OmronPlace place;
  do {
    const int word = first_word + next / bits_per_word;
    if (word >= end_word) {
      if (!full_.insert(what).second) return;
      fail(source::code::kOmronFull,
           std::string("no bit is left for '") + variable.name + "' and what follows: " + what +
               " live in W" + std::to_string(first_word) + ".00 to W" + std::to_string(end_word - 1) + ".15",
           "split the program");
      return;
    }
    place.code = "W" + std::to_string(word) + "." + padded(next % bits_per_word, 2);
    ++next;
  } while (used_.count(place.code) != 0);
  place.shown = place.code;
  assign(variable.name, place, variable.comment);
  std::string initial = graphic::upper(variable.initial);
  if (initial.rfind("BOOL#", 0) == 0) initial.erase(0, 5);
  if (initial == "TRUE" || initial == "1") {
    initial_values_.emplace_back(place, variable.initial);
  } else if (!initial.empty() && initial != "FALSE" && initial != "0") {
    fail(source::code::kOmronConstruct,
         "the initial value '" + variable.initial + "' of '" + variable.name + "' is not exported",
         "write TRUE or FALSE");
  }
}

void OmronAddresses::next_word(const Variable& variable, bool is_unsigned) {
  OmronPlace place;
  place.kind = OmronPlace::Kind::Word;
  place.is_unsigned = is_unsigned;
  do {
    if (next_word_ >= kWords) {
      fail(source::code::kOmronFull, "no word is left for '" + variable.name + "'",
           "there are D0 to D" + std::to_string(kWords - 1));
      return;
    }
    place.code = "D" + std::to_string(next_word_++);
  } while (used_.count(place.code) != 0);
  place.shown = place.code;
  assign(variable.name, place, variable.comment);
  // The DM area keeps its content, while a variable starts with its initial value.
  initial_values_.emplace_back(place, variable.initial.empty() ? "0" : variable.initial);
}

void OmronAddresses::next_timer(const Variable& variable) {
  if (next_timer_ >= 2048) {
    fail(source::code::kOmronFull, "no timer is left for '" + variable.name + "'",
         "there are T0000 to T2047");
    return;
  }
  OmronPlace place;
  place.kind = OmronPlace::Kind::Timer;
  place.code = place.shown = "T" + padded(next_timer_++, 4);
  assign(variable.name, place, variable.comment);
}

const OmronPlace* OmronAddresses::find(const std::string& variable) const {
  std::string name = graphic::upper(variable);
  // The output of a timer is the timer's completion flag.
  if (name.size() > 2 && name.compare(name.size() - 2, 2, ".Q") == 0) name.resize(name.size() - 2);
  const auto found = index_.find(name);
  if (found == index_.end()) return nullptr;
  const OmronPlace& place = entries_[found->second].place;
  const bool dotted = name.size() != variable.size();
  return dotted == (place.kind == OmronPlace::Kind::Timer) ? &place : nullptr;
}

std::vector<OmronTableRow> OmronAddresses::table() const {
  std::vector<OmronTableRow> rows;
  for (const Entry& entry : entries_) {
    const char* type = entry.place.kind == OmronPlace::Kind::Bit    ? "BOOL"
                       : entry.place.kind == OmronPlace::Kind::Word ? "CHANNEL"
                                                                    : "TIMER";
    rows.push_back({entry.variable, entry.place.shown, type, entry.comment});
  }
  return rows;
}

void OmronAddresses::miss(const std::string& variable) {
  fail(source::code::kOmronAddress, "input or output '" + variable + "' has no Omron address",
       "give it one, such as I0.00");
}

void OmronAddresses::fail(const char* code, std::string message, std::string hint) {
  diagnostics_.push_back({code, result::Severity::Error, {}, std::move(message), std::move(hint)});
}

}  // namespace stepwright::exchange
