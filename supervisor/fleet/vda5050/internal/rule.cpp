#include "supervisor/fleet/vda5050/internal/rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/ground/result/closest.h"
#include "supervisor/fleet/vda5050/header.h"

namespace stepwright::fleet::vda5050 {

namespace {

using nlohmann::json;

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::Object:
      return "object";
    case Kind::List:
      return "list";
    case Kind::Text:
      return "text";
    case Kind::Whole:
      return "whole number";
    case Kind::Number:
      return "number";
    case Kind::Boolean:
      return "true or false";
    case Kind::NotNull:
      return "value other than null";
  }
  return "";
}

bool whole(const json& value) {
  if (value.is_number_integer()) return true;
  return value.is_number_float() && value.get<double>() == std::floor(value.get<double>());
}

bool of_kind(Kind kind, const json& value) {
  switch (kind) {
    case Kind::Object:
      return value.is_object();
    case Kind::List:
      return value.is_array();
    case Kind::Text:
      return value.is_string();
    case Kind::Whole:
      return whole(value);
    case Kind::Number:
      return value.is_number();
    case Kind::Boolean:
      return value.is_boolean();
    case Kind::NotNull:
      return !value.is_null();
  }
  return false;
}

// Three numbers with dots between them.
bool version(const std::string& text) {
  int numbers = 1;
  bool digit = false;
  for (const char c : text) {
    if (c >= '0' && c <= '9') {
      digit = true;
    } else if (c == '.' && digit) {
      ++numbers;
      digit = false;
    } else {
      return false;
    }
  }
  return digit && numbers == 3;
}

void apply_text(const Rule& rule, const std::string& text, const Place& place, Findings& findings) {
  if (rule.form == Form::Time && !timestamp_of(text)) {
    findings.add("F0903", place, "'" + text + "' is no time in UTC", "write 2026-11-23T03:50:00.125Z");
  }
  if (rule.form == Form::Version && !version(text)) {
    findings.add("F0903", place, "'" + text + "' is no version", "write 2.1.0");
  }
  if (rule.words.empty() || std::ranges::find(rule.words, text) != rule.words.end()) return;
  const std::vector<std::string> words(rule.words.begin(), rule.words.end());
  const std::string* const meant = result::closest(text, words, 2);
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  findings.add("F0903", place, "'" + text + "' is none of " + all,
               meant != nullptr ? "did you mean '" + *meant + "'?" : "");
}

void apply_number(const Rule& rule, double value, const Place& place, Findings& findings) {
  if (value >= rule.least && value <= rule.most) return;
  const std::string range = std::isinf(rule.most) ? fmt::format("below {}", rule.least)
                                                  : fmt::format("not from {} to {}", rule.least, rule.most);
  findings.add("F0903", place, fmt::format("{} is {}", value, range));
}

void apply_object(const Rule& rule, const json& value, const Place& place, Findings& findings) {
  for (const Member& member : rule.members) {
    const auto found = value.find(member.name);
    if (found != value.end()) {
      apply(*member.rule, *found, place.at(member.name), findings);
      continue;
    }
    if (!member.required) continue;
    std::vector<std::string> others;
    for (const auto& [name, ignored] : value.items()) others.push_back(name);
    const std::string* const meant = result::closest(member.name, others, 2);
    findings.add("F0902", place, "lacks '" + std::string(member.name) + "'",
                 meant != nullptr ? "is '" + *meant + "' meant to be it?" : "");
  }
}

}  // namespace

std::string to_pointer(const Place& place) {
  if (place.parent == nullptr) return {};
  std::string text = to_pointer(*place.parent) + "/";
  if (place.name.empty()) return text + std::to_string(place.index);
  for (const char c : place.name) {
    if (c == '~') {
      text += "~0";
    } else if (c == '/') {
      text += "~1";
    } else {
      text += c;
    }
  }
  return text;
}

void Findings::add(const char* code, const Place& place, const std::string& what, const std::string& hint) {
  if (full()) return;
  const std::string pointer = to_pointer(place);
  found_.push_back({.code = code,
                    .severity = result::Severity::Error,
                    .where = {source_, 0, 0},
                    .message = (pointer.empty() ? "the message" : pointer) + ": " + what,
                    .hint = hint});
}

void apply(const Rule& rule, const json& value, const Place& place, Findings& findings) {
  if (findings.full()) return;
  if (!of_kind(rule.kind, value)) {
    findings.add("F0902", place, std::string("is no ") + name_of(rule.kind));
    return;
  }
  switch (rule.kind) {
    case Kind::Object:
      return apply_object(rule, value, place, findings);
    case Kind::List:
      if (value.size() < rule.fewest) findings.add("F0903", place, "has no items");
      for (std::size_t k = 0; rule.items != nullptr && k < value.size(); ++k) {
        apply(*rule.items, value[k], place.at(k), findings);
      }
      return;
    case Kind::Text:
      return apply_text(rule, value.get_ref<const std::string&>(), place, findings);
    case Kind::Whole:
    case Kind::Number:
      return apply_number(rule, value.get<double>(), place, findings);
    default:
      return;
  }
}

const Rule& rule_of(Topic topic) {
  switch (topic) {
    case Topic::Order:
      return rules::kOrder;
    case Topic::InstantActions:
      return rules::kInstantActions;
    case Topic::State:
      return rules::kState;
    case Topic::Visualization:
      return rules::kVisualization;
    case Topic::Connection:
      return rules::kConnection;
    case Topic::Factsheet:
      return rules::kFactsheet;
  }
  return rules::kOrder;
}

}  // namespace stepwright::fleet::vda5050
