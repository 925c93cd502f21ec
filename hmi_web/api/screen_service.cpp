#include "hmi_web/api/screen_service.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string_view>

#include "hmi_web/screens/codes.h"
#include "hmi_web/screens/part_check.h"
#include "runtime/bytecode/reader/parse_value.h"
#include "runtime/bytecode/reader/read_value.h"

namespace stepwright::api {
namespace {

using access::Role;
using drawing::Part;
using drawing::PartKind;
using result::Result;

constexpr std::size_t kMostRemembered = 512;

bool may_see(const screens::Version& version, Role role) {
  return role >= access::role_of(version.least).value_or(Role::Viewer);
}

// 12.5, or T#12.5s as 12.5.
std::optional<double> quantity_of(std::string_view literal) {
  for (const auto type : {bytecode::ElementaryType::Lreal, bytecode::ElementaryType::Time}) {
    reader::Variable variable;
    variable.type = type;
    const auto bits = reader::parse_value(variable, literal);
    if (!bits) continue;
    const auto image = std::bit_cast<std::array<std::byte, sizeof *bits>>(*bits);
    const double quantity = reader::read_quantity(variable, image);
    return std::isfinite(quantity) ? std::optional(quantity) : std::nullopt;
  }
  return std::nullopt;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

auto not_of(const Part& part, const std::string& value, const std::string& hint) {
  return result::fail(kNotOfPart, {}, "the part '" + part.key + "' does not write " + value.substr(0, 64),
                      hint);
}

struct Target {
  std::string variable;
  std::string literal;
};

Result<Target> target_of(const Part& part, const std::string& value) {
  const std::string& variable = part.write;
  switch (part.kind) {
    case PartKind::Button:
      return Target{variable, part.value};
    case PartKind::Switch:
      if (value == "TRUE" || value == "FALSE") return Target{variable, value};
      return not_of(part, value, "TRUE or FALSE");
    case PartKind::StartStop:
      if (value == "start") return Target{variable, "TRUE"};
      if (value == "stop") return part.stop.empty() ? Target{variable, "FALSE"} : Target{part.stop, "TRUE"};
      return not_of(part, value, "start or stop");
    case PartKind::Choice: {
      std::string known;
      for (const auto& [literal, name] : part.values) {
        if (literal == value) return Target{variable, value};
        known += (known.empty() ? "" : ", ") + literal;
      }
      return not_of(part, value, known);
    }
    default: {
      const auto number = quantity_of(value);
      if (number && *number >= part.least.value_or(0) && *number <= part.most.value_or(0))
        return Target{variable, value};
      return not_of(part, value,
                    "a number from " + short_number(part.least.value_or(0)) + " to " +
                        short_number(part.most.value_or(0)));
    }
  }
}

}  // namespace

std::vector<screens::Screen> ScreenService::list(Role role) const {
  std::vector<screens::Screen> all = store_.list();
  std::erase_if(all, [&](const screens::Screen& each) {
    const screens::Version* now = each.current();
    if (role >= Role::Engineer) return false;
    return now == nullptr || now->removed || !may_see(*now, role);
  });
  return all;
}

std::optional<screens::Screen> ScreenService::find(const std::string& name, Role role) const {
  auto screen = store_.find(name);
  if (!screen || role >= Role::Engineer) return screen;
  const screens::Version* now = screen->current();
  if (now == nullptr || now->removed || !may_see(*now, role)) return std::nullopt;
  return screen;
}

std::string ScreenService::start_of(Role role) const {
  const std::string own = access::to_string(std::min(role, Role::Engineer));
  for (const std::string& each : {own, std::string()}) {
    const std::string name = store_.start(each);
    const auto screen = find(name, role);
    if (screen && screen->shown() != nullptr) return name;
  }
  return {};
}

result::Diagnostics ScreenService::doubts_of(const std::string& name, std::string_view svg) const {
  auto drawn = drawing::read_drawing(name + ".svg", svg);
  if (!drawn) return {};
  result::Diagnostics doubts = std::move(drawn->warnings);
  const auto program = cell_.program();
  // A face has words in braces in place of names.
  if (!program || drawn->is_symbol) return doubts;
  for (result::Diagnostic& each : screens::check_parts(drawn->parts, *program))
    doubts.push_back(std::move(each));
  return doubts;
}

Result<PartWritten> ScreenService::write(const PartWrite& deed) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(done_.begin(), done_.end(), [&](const auto& each) { return each.first == deed.once; });
  if (found != done_.end()) return found->second;
  bool tried = false;
  auto written = obey(deed, tried);
  // Also what has failed: who does not answer may have written all the same.
  if (tried) done_.emplace_back(deed.once, written);
  if (done_.size() > kMostRemembered) done_.pop_front();
  return written;
}

Result<PartWritten> ScreenService::obey(const PartWrite& deed, bool& tried) {
  const auto screen = find(deed.screen, deed.role);
  const screens::Version* now = screen ? screen->current() : nullptr;
  if (now == nullptr || now->removed)
    return result::fail(screens::kNoSuchScreen, {}, "there is no screen '" + deed.screen.substr(0, 64) + "'");
  auto drawn = store_.read(deed.screen, now->number);
  if (!drawn) return result::forward(drawn);
  const auto part = std::find_if(drawn->parts.begin(), drawn->parts.end(), [&](const Part& each) {
    return drawing::writes(each.kind) && each.key == deed.part;
  });
  if (part == drawn->parts.end())
    return result::fail(
        kNoSuchPart, {},
        "the screen '" + deed.screen + "' has no part '" + deed.part.substr(0, 40) + "' that writes",
        "somebody may have changed the screen: load it again");
  if (deed.writes.value_or(part->write) != part->write ||
      deed.question.value_or(part->confirm) != part->confirm)
    return result::fail(kPartChanged, {},
                        "the part '" + part->key + "' was changed meanwhile: it writes '" + part->write +
                            "' now" + (part->confirm.empty() ? "" : " and asks: " + part->confirm),
                        "nothing was written; look at the screen again");
  if (part->engineer && deed.role < Role::Engineer)
    return result::fail(kPartOfOtherRole, {}, "the part '" + part->key + "' takes the role engineer");
  if (!part->confirm.empty() && !deed.confirmed)
    return result::fail(kNotConfirmed, {}, "the part '" + part->key + "' asks before it writes",
                        part->confirm);
  auto target = target_of(*part, deed.value);
  if (!target) return result::forward(target);
  if (auto there = cell_.reach(); !there) return result::forward(there);
  PartWritten written{.variable = target->variable};
  written.before = cell_.read(target->variable).value_or("");
  tried = true;
  auto done = cell_.write(target->variable, target->literal);
  if (!done) return result::forward(done);
  written.after = std::move(*done);
  return written;
}

}  // namespace stepwright::api
