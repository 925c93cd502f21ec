#include "hmi_web/alarms/engine.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <map>
#include <utility>

#include "hmi_web/alarms/codes.h"

namespace stepwright::alarms {
namespace {

std::string unseen_comment(std::int64_t since_ns) {
  const std::time_t seconds = static_cast<std::time_t>(since_ns / 1'000'000'000);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char text[96];
  std::snprintf(text, sizeof text, "%s%04d-%02d-%02dT%02d:%02d:%02d.%03dZ", kUnseenSince, utc.tm_year + 1900,
                utc.tm_mon + 1, utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec,
                static_cast<int>(since_ns / 1'000'000 % 1'000));
  return text;
}

bool is_standing(const AlarmStatus& status) {
  return !status.is_hidden() && status.annunciated != AlarmState::Normal;
}

result::Diagnostics check(const std::vector<AlarmDefinition>& definitions) {
  result::Diagnostics problems;
  const auto wrong = [&](const char* code, const AlarmDefinition& at, std::string message, std::string hint) {
    problems.push_back({code, result::Severity::Error, at.where, std::move(message), std::move(hint)});
  };
  std::map<std::string_view, const AlarmDefinition*> seen;
  for (const AlarmDefinition& one : definitions) {
    const auto [first, fresh] = seen.emplace(one.name, &one);
    if (one.name.empty()) wrong("C0602", one, "an alarm has no name", "name = \"tank.high\"");
    if (!fresh && !one.name.empty()) {
      const auto line = first->second->where.line;
      wrong("C0601", one, "there are two alarms " + one.name,
            line > 0 ? "the other one is in line " + std::to_string(line)
                     : "the other one is built in: every cell has it");
    }
    if (one.source.empty()) wrong("C0602", one, one.name + " watches no variable", "source = \"main.level\"");
    const ConditionSettings& c = one.condition;
    if (!std::isfinite(c.limit) || !std::isfinite(c.deadband) || c.deadband < 0.0)
      wrong("C0605", one, "limit and deadband of " + one.name + " must be numbers, the deadband 0 or more",
            "");
    if (one.suppress_by_hand && !one.suppress_when.empty())
      wrong("C0605", one, one.name + " is suppressed both by hand and by " + one.suppress_when,
            "by one of them");
    if (c.on_delay.count() < 0 || c.off_delay.count() < 0 || one.longest_shelving.count() < 0)
      wrong("C0605", one, "times of " + one.name + " must not be negative", "");
  }
  return problems;
}

}  // namespace

bool Condition::holds(double value, bool usable) const {
  if (settings_.kind == ConditionKind::Bad) return !usable;
  if (!usable || std::isnan(value)) return seen_;
  switch (settings_.kind) {
    case ConditionKind::High:
      return value > (seen_ ? settings_.limit - settings_.deadband : settings_.limit);
    case ConditionKind::Low:
      return value < (seen_ ? settings_.limit + settings_.deadband : settings_.limit);
    case ConditionKind::On:
      return value != 0.0;
    case ConditionKind::Off:
      return value == 0.0;
    case ConditionKind::Bad:
      break;
  }
  return false;
}

std::int64_t Condition::delay_ns() const {
  return seen_ ? settings_.on_delay.count() : settings_.off_delay.count();
}

std::optional<ConditionChange> Condition::offer(std::int64_t time_ns, double value, bool usable,
                                                bool time_known) {
  newest_ns_ = std::max(newest_ns_, time_ns);
  const bool now = holds(value, usable);
  if (now != seen_) {
    seen_ = now;
    since_ns_ = newest_ns_;
    value_ = value;
    unseen_since_ns_ = time_known ? 0 : blind_since_ns_;
  }
  // That a value is missing is seen by a condition of that kind.
  if (usable || settings_.kind == ConditionKind::Bad)
    blind_since_ns_ = 0;
  else if (blind_since_ns_ == 0)
    blind_since_ns_ = newest_ns_;
  return expire(newest_ns_);
}

std::optional<ConditionChange> Condition::expire(std::int64_t time_ns) {
  const auto due = deadline();
  if (!due || *due > time_ns) return std::nullopt;
  active_ = seen_;
  return ConditionChange{*due, active_, value_, unseen_since_ns_};
}

std::optional<std::int64_t> Condition::deadline() const {
  if (seen_ == active_) return std::nullopt;
  return since_ns_ + delay_ns();
}

result::Result<AlarmEngine> AlarmEngine::create(std::vector<AlarmDefinition> definitions) {
  result::Diagnostics problems = check(definitions);
  if (!problems.empty()) return tl::unexpected<result::Diagnostics>(std::move(problems));
  return AlarmEngine(std::move(definitions));
}

AlarmEngine::AlarmEngine(std::vector<AlarmDefinition> definitions)
    : definitions_(std::move(definitions)), groups_(1) {
  std::map<std::string, std::uint32_t> groups;
  std::map<std::string, std::uint32_t> sources;
  const auto source = [&](const std::string& name) -> std::vector<Use>& {
    const auto [found, fresh] = sources.emplace(name, static_cast<std::uint32_t>(sources_.size()));
    if (fresh) {
      sources_.push_back(name);
      uses_.emplace_back();
    }
    return uses_[found->second];
  };
  for (std::uint32_t i = 0; i < definitions_.size(); ++i) {
    const AlarmDefinition& one = definitions_[i];
    Alarm& alarm = alarms_.emplace_back(Alarm{Condition(one.condition), {}});
    source(one.source).push_back({AlarmId(i), false});
    if (!one.suppress_when.empty()) source(one.suppress_when).push_back({AlarmId(i), true});
    if (one.group.empty()) continue;
    const auto [found, fresh] = groups.emplace(one.group, static_cast<std::uint32_t>(groups_.size()));
    if (fresh) groups_.emplace_back();
    alarm.group = found->second;
    groups_[alarm.group].members.push_back(AlarmId(i));
  }
  // A variable that both suppresses and raises does the former first, in every scan alike.
  for (std::vector<Use>& uses : uses_)
    std::ranges::stable_partition(uses, [](const Use& use) { return use.suppresses; });
}

std::optional<AlarmId> AlarmEngine::find(std::string_view name) const {
  const auto found = std::ranges::find(definitions_, name, &AlarmDefinition::name);
  if (found == definitions_.end()) return std::nullopt;
  return AlarmId(static_cast<std::uint32_t>(found - definitions_.begin()));
}

void AlarmEngine::restore(AlarmId id, const AlarmView& view) {
  Alarm& alarm = alarms_[id.value];
  alarm.view = view;
  AlarmStatus& status = alarm.view.status;
  const AlarmDefinition& definition = definitions_[id.value];
  // Nothing would ever end it.
  if (status.suppressed && definition.suppress_when.empty() && !definition.suppress_by_hand) {
    status.suppressed = false;
    if (!status.is_hidden())
      status.annunciated = status.active ? AlarmState::Unacknowledged : AlarmState::Normal;
  }
  alarm.condition.restore(status.active);
  if (alarm.group != 0) restore_group(groups_[alarm.group]);
  wait_for(id);
}

// First-out ends without an event of its own: what was written of it is older than what the times say.
void AlarmEngine::restore_group(Group& group) {
  group.standing = 0;
  std::int64_t oldest_ns = std::numeric_limits<std::int64_t>::max();
  group.first_ns = oldest_ns;
  for (const AlarmId member : group.members) {
    const AlarmView& view = alarms_[member.value].view;
    if (!is_standing(view.status)) continue;
    ++group.standing;
    oldest_ns = std::min(oldest_ns, view.raised_ns);
    if (view.first_out) group.first_ns = std::min(group.first_ns, view.raised_ns);
  }
  if (group.first_ns == std::numeric_limits<std::int64_t>::max()) group.first_ns = oldest_ns;
  for (const AlarmId member : group.members) {
    AlarmView& view = alarms_[member.value].view;
    view.first_out = view.first_out && is_standing(view.status) && view.raised_ns == group.first_ns;
  }
}

void AlarmEngine::blind_since(std::int64_t time_ns) {
  for (Alarm& alarm : alarms_) alarm.condition.blind_since(time_ns);
}

void AlarmEngine::offer(SourceId source, std::int64_t time_ns, double value, bool usable, bool time_known) {
  for (const Use& use : uses_[source.value]) {
    if (use.suppresses) {
      if (usable) suppress(use.alarm, time_ns, value != 0.0);
      continue;
    }
    expire(use.alarm, time_ns);
    if (const auto changed = alarms_[use.alarm.value].condition.offer(time_ns, value, usable, time_known)) {
      change(use.alarm, *changed);
    } else {
      wait_for(use.alarm);
    }
  }
}

void AlarmEngine::suppress(AlarmId alarm, std::int64_t time_ns, bool suppressed) {
  expire(alarm, time_ns);
  happen(alarm, suppressed ? AlarmEvent::Suppress : AlarmEvent::Unsuppress, time_ns, 0.0, nullptr);
}

void AlarmEngine::change(AlarmId alarm, const ConditionChange& change) {
  const Refusal refusal = happen(alarm, change.active ? AlarmEvent::Raise : AlarmEvent::Return,
                                 change.time_ns, change.value, nullptr);
  if (refusal == Refusal::None && change.unseen_since_ns != 0)
    transitions_.back().comment = unseen_comment(change.unseen_since_ns);
}

void AlarmEngine::wait_for(AlarmId id) {
  Alarm& alarm = alarms_[id.value];
  const auto wait = [&](std::int64_t& waits_for, std::optional<std::int64_t> due) {
    if (!due || *due == waits_for) return;  // every value of every scan comes here
    waits_for = *due;
    deadlines_.push({*due, id});
  };
  wait(alarm.delay_waits_for, alarm.condition.deadline());
  if (alarm.view.status.shelved) wait(alarm.shelf_waits_for, alarm.view.shelved_until_ns);
}

void AlarmEngine::expire(AlarmId id, std::int64_t time_ns) {
  Alarm& alarm = alarms_[id.value];
  const bool shelf_ends = alarm.view.status.shelved && alarm.view.shelved_until_ns <= time_ns;
  // The earlier one first.
  const auto due = alarm.condition.deadline();
  const bool shelf_is_first = shelf_ends && (!due || alarm.view.shelved_until_ns < *due);
  if (shelf_is_first) happen(id, AlarmEvent::Unshelve, alarm.view.shelved_until_ns, 0.0, nullptr);
  if (const auto changed = alarm.condition.expire(time_ns)) change(id, *changed);
  if (shelf_ends && !shelf_is_first)
    happen(id, AlarmEvent::Unshelve, alarm.view.shelved_until_ns, 0.0, nullptr);
}

void AlarmEngine::advance(std::int64_t time_ns) {
  while (!deadlines_.empty() && deadlines_.top().time_ns <= time_ns) {
    const Deadline due = deadlines_.top();
    deadlines_.pop();
    Alarm& alarm = alarms_[due.alarm.value];
    if (alarm.delay_waits_for == due.time_ns) alarm.delay_waits_for = kNever;
    if (alarm.shelf_waits_for == due.time_ns) alarm.shelf_waits_for = kNever;
    expire(due.alarm, due.time_ns);
  }
}

result::Result<void> AlarmEngine::command(const Command& command) {
  const auto refuse = [&](std::string message, std::string hint) {
    return result::fail(kNotInThisState, {}, std::move(message), std::move(hint));
  };
  if (command.alarm.value >= definitions_.size())
    return refuse("there is no alarm with the number " + std::to_string(command.alarm.value), "");
  const AlarmDefinition& definition = definitions_[command.alarm.value];
  const AlarmEvent event = command.event;
  if (event == AlarmEvent::Raise || event == AlarmEvent::Return)
    return refuse(std::string("'") + to_string(event) + "' is for the plant, not for people", "");
  const bool suppresses = event == AlarmEvent::Suppress || event == AlarmEvent::Unsuppress;
  if (suppresses && !definition.suppress_by_hand)
    return refuse(definition.name + " is not suppressed by hand",
                  definition.suppress_when.empty()
                      ? "shelve it for a time, or set suppress_by_hand in its definition"
                      : definition.suppress_when + " decides it");
  expire(command.alarm, command.time_ns);
  const bool shelves = event == AlarmEvent::Shelve;
  if (shelves && (command.shelve_for.count() <= 0 || command.shelve_for > definition.longest_shelving)) {
    using std::chrono::duration_cast, std::chrono::seconds;
    return refuse(definition.name + " cannot be shelved for " +
                      std::to_string(duration_cast<seconds>(command.shelve_for).count()) + " s",
                  definition.longest_shelving.count() == 0
                      ? "it must not be shelved at all"
                      : "up to " +
                            std::to_string(duration_cast<seconds>(definition.longest_shelving).count()) +
                            " s, and more than 0");
  }
  const Refusal refusal = happen(command.alarm, event, command.time_ns, 0.0, &command);
  if (refusal == Refusal::None) return {};
  return refuse(definition.name + ": " + to_string(event) + " is refused, because " + to_string(refusal),
                std::string("its state is: ") + to_string(view(command.alarm).status.state()));
}

Refusal AlarmEngine::happen(AlarmId id, AlarmEvent event, std::int64_t time_ns, double value,
                            const Command* by) {
  Alarm& alarm = alarms_[id.value];
  const AlarmStatus before = alarm.view.status;
  const Step step = apply(before, event, definitions_[id.value].traits);
  if (step.refusal != Refusal::None) return step.refusal;
  AlarmView& view = alarm.view;
  view.status = step.status;
  if (before.state() != step.status.state()) view.since_ns = time_ns;
  if (event == AlarmEvent::Raise) view.raised_ns = time_ns;
  if (event == AlarmEvent::Raise || event == AlarmEvent::Return) view.value = value;
  if (event == AlarmEvent::Shelve) view.shelved_until_ns = time_ns + by->shelve_for.count();
  if (event == AlarmEvent::Unshelve) view.shelved_until_ns = 0;
  note_in_group(id, event, is_standing(before), time_ns);
  wait_for(id);
  transitions_.push_back({++sequence_, time_ns, id, event, before.state(), step.status.state(), step.status,
                          view.value, view.first_out, view.shelved_until_ns, by ? by->user : std::string(),
                          by ? by->comment : std::string()});
  return Refusal::None;
}

void AlarmEngine::note_in_group(AlarmId id, AlarmEvent event, bool before, std::int64_t time_ns) {
  Alarm& alarm = alarms_[id.value];
  if (alarm.group == 0) return;
  Group& group = groups_[alarm.group];
  const bool now = is_standing(alarm.view.status);
  if (!before && now) {
    // News of an earlier scan may come later, from another task or another runtime.
    const bool first = group.standing == 0 || time_ns < group.first_ns;
    if (first) {
      for (const AlarmId member : group.members) alarms_[member.value].view.first_out = false;
      group.first_ns = time_ns;
    }
    alarm.view.first_out = event == AlarmEvent::Raise && time_ns == group.first_ns;
  }
  if (now && !before) ++group.standing;
  if (before && !now) --group.standing;
  if (group.standing == 0)
    for (const AlarmId member : group.members) alarms_[member.value].view.first_out = false;
}

std::vector<Transition> AlarmEngine::take() {
  return std::exchange(transitions_, {});
}

}  // namespace stepwright::alarms
