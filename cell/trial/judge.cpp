#include "cell/trial/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "cell/trial/level_change.h"
#include "cell/trial/swapped_tags.h"
#include "supervisor/translate/change.h"
#include "supervisor/translate/pattern.h"

namespace stepwright::trial {
namespace {

using translate::ActionBinding;
using translate::Binding;

// A timeout leaves room for what a plant does on a bad day.
constexpr double kRoom = 1.5;

std::string number(double value) {
  return fmt::format("{:.4g}", std::abs(value) < 1e-9 ? 0.0 : value);
}

// "4.2 (4.1 to 4.3)" or "4.2".
std::string range_of(std::vector<double> values) {
  const auto [low, high] = std::ranges::minmax(values);
  double sum = 0.0;
  for (const double value : values) sum += value;
  const std::string mean = number(sum / static_cast<double>(values.size()));
  return number(low) == number(high) ? mean : mean + " (" + number(low) + " to " + number(high) + ")";
}

class Judge {
 public:
  Judge(const Binding& binding, std::span<const ActionRun> runs)
      : binding_(binding),
        runs_(runs),
        planned_(runs.front().planned),
        entry_(*binding.action_for(planned_.action, assignment_)),
        who_(model::to_string(planned_.action)),
        claimed_(translate::changed_atoms(planned_)),
        until_(translate::instantiate(entry_.completion.atom, assignment_)) {}

  Findings take() {
    if (runs_.front().end == RunEnd::NotBound) return not_bound();
    for (const RunEnd end : {RunEnd::NotBegun, RunEnd::NotReached, RunEnd::Refused, RunEnd::HoldLost,
                             RunEnd::TimedOut, RunEnd::WrongWay, RunEnd::Trapped}) {
      std::vector<const ActionRun*> ended;
      for (const ActionRun& run : runs_)
        if (run.end == end) ended.push_back(&run);
      if (!ended.empty()) judge_end(end, ended);
    }
    std::vector<const ActionRun*> done;
    for (const ActionRun& run : runs_)
      if (run.end == RunEnd::Done) done.push_back(&run);
    if (!done.empty()) judge_done(done);
    return std::move(found_);
  }

 private:
  using Runs = std::vector<const ActionRun*>;

  void add(const char* code, std::string subject, std::string message, std::string hint,
           result::Severity severity = result::Severity::Error) {
    found_.push_back(
        {{code, severity, entry_.where, std::move(message), std::move(hint)}, std::move(subject)});
  }

  // The same of every seed.
  Findings not_bound() const {
    Findings found;
    for (const result::Diagnostic& each : runs_.front().problems) found.push_back({each, each.message});
    return found;
  }

  // "(level t1)" of (fill t1) as (level ?t), in that direction: a subject.
  std::string in_entry(const char* direction, const std::string& atom) const {
    auto pattern = translate::parse_pattern(atom).value_or(translate::Pattern{atom, {}});
    for (std::string& argument : pattern.arguments) {
      const auto parameter =
          std::ranges::find_if(assignment_, [&](const auto& each) { return each.second == argument; });
      argument = parameter == assignment_.end() ? "?" : parameter->first;
    }
    return std::string(direction) + " " + translate::to_string(pattern);
  }

  std::string times(const Runs& runs) const {
    if (runs.size() == runs_.size()) return {};
    return fmt::format(" in {} of {} runs", runs.size(), runs_.size());
  }

  std::string label(const std::string& atom) const {
    if (const translate::Sensor* sensor = binding_.sensor_of(atom)) return sensor->label;
    return atom;
  }

  void judge_end(RunEnd end, const Runs& runs) {
    const ActionRun& first = *runs.front();
    switch (end) {
      case RunEnd::NotBegun:
        return add(kNotBegunCode, "",
                   "the plant does not begin where the problem's :init says: " + first.detail,
                   swapped_tags(binding_, first) + "change :init, or the start values of the plant");
      case RunEnd::NotReached:
        return add("B0021", "",
                   who_ + " was not tried" + times(runs) + ": on the way there, " + first.detail + " fails",
                   "what is wrong with that action is said of itself", result::Severity::Warning);
      case RunEnd::Refused:
        return add("B0022", "",
                   who_ + " may not start" + times(runs) + ": sensors do not show " + unmet(first),
                   "an effect of an action before it, or the tolerance of a sensor, is not as the plant is");
      case RunEnd::HoldLost:
        return hold_lost(runs);
      case RunEnd::WrongWay:
        return wrong_way(runs);
      case RunEnd::TimedOut:
        return timed_out(runs);
      default:
        return add("B0031", "", "the program or the plant fails while " + who_ + " runs" + times(runs),
                   "`stepwright plant` runs the plant without a program");
    }
  }

  // Another level that goes as this one should, of which the domain says nothing: its tag may be the one.
  std::string other_tag(const ActionRun& run) const {
    const translate::Sensor* const mine = binding_.sensor_of(until_);
    if (mine == nullptr) return {};
    const double claimed = planned_.after.fluents.at(until_) - planned_.before.fluents.at(until_);
    for (const translate::Sensor& other : binding_.sensors) {
      const double change = value_of(run.after, other.fluent) - value_of(run.before, other.fluent);
      if (claimed_.contains(other.fluent) || std::abs(change) <= other.tolerance || change * claimed < 0.0)
        continue;
      return fmt::format("tag = \"{}\" for '{}', if the tags of the two are swapped; ", other.tag,
                         mine->name);
    }
    return {};
  }

  // The conjuncts of the precondition that do not hold as observed.
  std::string unmet(const ActionRun& run) const {
    const model::NamedState state = as_shown(binding_, run.planned.before, run.before);
    std::string text;
    const auto note = [&](const model::Condition& part) {
      if (model::holds(part, state)) return;
      text += (text.empty() ? "" : " and ") + model::to_string(part);
    };
    if (planned_.precondition.kind == model::ConditionKind::All) {
      for (const model::Condition& part : planned_.precondition.children) note(part);
    } else {
      note(planned_.precondition);
    }
    return text.empty() ? std::string("what it needs") : text;
  }

  // What is to be held and is not in the reading.
  std::string lost(const Reading& reading) const {
    std::string text;
    for (const translate::Pattern& pattern : entry_.hold) {
      const std::string atom = translate::instantiate(pattern, assignment_);
      if (value_of(reading, atom) < 0.5) text += (text.empty() ? "" : " and ") + atom;
    }
    return text;
  }

  void hold_lost(const Runs& runs) {
    const ActionRun& first = *runs.front();
    const std::string missing = lost(first.before);
    if (!missing.empty() && missing == lost(first.after)) {
      return add("B0023", "begins without",
                 fmt::format("{} is to hold {}, which it begins without{}", who_, missing, times(runs)),
                 "an action before it does not bring that about; or hold what is there");
    }
    const std::string gone = lost(first.after);
    add("B0023", "loses",
        fmt::format("{} loses {} after {} s{}", who_, gone.empty() ? "what it must hold" : gone,
                    number(first.active_s), times(runs)),
        "hold only what stays while its outputs are on");
  }

  // What sensors show of the run: "level of t2 from 3 to 4.1, (closed v1) false".
  std::string changes(const ActionRun& run, const std::string& but) const {
    std::string text;
    for (const auto& [atom, after] : run.after) {
      const double before = value_of(run.before, atom);
      if (atom == but) continue;
      const translate::Sensor* const sensor = binding_.sensor_of(atom);
      if (std::abs(after - before) <= (sensor != nullptr ? sensor->tolerance : 0.5)) continue;
      text += (text.empty() ? "" : ", ") + label(atom) +
              (sensor != nullptr ? " from " + number(before) + " to " + number(after)
               : after > 0.5     ? " true"
                                 : " false");
    }
    return text;
  }

  void wrong_way(const Runs& runs) {
    const ActionRun& first = *runs.front();
    const double claimed = planned_.after.fluents.at(until_) - planned_.before.fluents.at(until_);
    const double change = value_of(first.after, until_) - value_of(first.before, until_);
    const double rate = change / std::max(first.active_s, 1e-3);
    add("B0025", in_entry(change > 0.0 ? "increase" : "decrease", until_),
        fmt::format("{} {} {} by the domain, and the plant {} it: {} units a second{}", who_,
                    claimed > 0.0 ? "raises" : "lowers", label(until_), change > 0.0 ? "raises" : "lowers",
                    number(rate), times(runs)),
        fmt::format("({} {} ...) in the domain; or other outputs, or a calibration that rises the other way",
                    change > 0.0 ? "increase" : "decrease", until_));
  }

  void timed_out(const Runs& runs) {
    const ActionRun& first = *runs.front();
    const std::string others = changes(first, until_);
    const std::string instead = others.empty() ? "" : "; what changes is " + others;
    if (entry_.completion.kind == translate::CompletionKind::Fact) {
      if (others.empty()) return no_change(runs, first);
      return add("B0027", "until",
                 fmt::format("{} ends with {}, which no sensor shows within {} s{}{}", who_, until_,
                             number(first.given_s), times(runs), instead),
                 "another fact in 'until', other outputs, or the switch of that fact is another one");
    }
    const double change = value_of(first.after, until_) - value_of(first.before, until_);
    if (std::abs(change) <= binding_.sensor_of(until_)->tolerance) return no_change(runs, first);
    const double claimed = planned_.after.fluents.at(until_) - planned_.before.fluents.at(until_);
    if (change * claimed < 0.0) return wrong_way(runs);
    const double way = way_left(first, until_);
    const double rate = change / std::max(first.active_s, 1e-3);
    add("B0026", "",
        fmt::format("{} moves {} by {} of {} in {} s{}: too slow, or it ends before", who_, label(until_),
                    number(change), number(way), number(first.active_s), times(runs)),
        fmt::format("timeout_s = {} at {} units a second, if it gets there at all",
                    number(std::ceil(kRoom * way / rate)), number(rate)));
  }

  void no_change(const Runs& runs, const ActionRun& first) {
    std::string outputs;
    for (const std::string& output : entry_.outputs) outputs += (outputs.empty() ? "" : ", ") + output;
    const std::string others = changes(first, until_);
    add("B0024", others.empty() ? "nothing changes" : "others change",
        fmt::format("{} changes nothing of {} in {} s with {} on{}", who_, label(until_),
                    number(first.active_s), outputs.empty() ? "no output" : outputs, times(runs)),
        others.empty()
            ? "outputs = [...]: these move nothing that a sensor shows"
            : "what changes is " + others + ": " + other_tag(first) + "other outputs, or another 'until'");
  }

  void judge_done(const Runs& runs) {
    const Spread spread = spread_of(runs_);
    const double timeout_s = std::chrono::duration<double>(entry_.timeout).count();
    if (spread.longest_s > timeout_s && !began_elsewhere(binding_, *runs.front())) {
      add("B0026", "",
          fmt::format("{} takes {} s (longest of {}), and counts as failed after {} s", who_,
                      number(spread.longest_s), spread.runs, number(timeout_s)),
          "timeout_s = " + number(std::ceil(kRoom * spread.longest_s)));
    }
    for (const auto& [atom, expected] : runs.front()->expected) {
      if (binding_.observed(atom) != nullptr) {
        judge_fact(atom, runs);
      } else {
        judge_level(atom, runs);
      }
    }
  }

  void judge_fact(const std::string& atom, const Runs& runs) {
    const bool is_claimed = claimed_.contains(atom);
    Runs other;
    for (const ActionRun* run : runs) {
      const bool after = value_of(run->after, atom) > 0.5;
      const bool was_so = after == (value_of(run->before, atom) > 0.5);
      if (after != (value_of(run->expected, atom) > 0.5) && (is_claimed || !was_so)) other.push_back(run);
    }
    if (other.empty()) return;
    const bool wanted = value_of(other.front()->expected, atom) > 0.5;
    if (is_claimed) {
      return add("B0027", in_entry(wanted ? "true" : "false", atom),
                 fmt::format("after {} the domain says that {} is {}, and its sensor does not show that{}",
                             who_, atom, wanted ? "true" : "false", times(other)),
                 wanted ? "(not " + atom + ") in the effect, or nothing of it; or another tag for the fact"
                        : atom + " in the effect, or nothing of it; or inverted = true for the fact");
    }
    add("B0029", in_entry(wanted ? "false" : "true", atom),
        fmt::format("{} makes {} {}, of which the domain says nothing{}", who_, atom,
                    wanted ? "false" : "true", times(other)),
        wanted ? "(not " + atom + ") in the effect" : atom + " in the effect");
  }

  void judge_level(const std::string& atom, const Runs& runs) {
    const double tolerance = binding_.sensor_of(atom)->tolerance;
    const bool by_level = entry_.completion.kind == translate::CompletionKind::Fluent;
    const LevelChange level = level_change(binding_, runs, atom, by_level ? until_ : std::string());
    if (std::abs(level.off) <= tolerance) return;
    const double moved = level.moved;
    const double claimed = level.claimed;
    std::vector<double> after, change;
    for (const ActionRun* run : runs) {
      after.push_back(value_of(run->after, atom));
      change.push_back(after.back() - value_of(run->before, atom));
    }
    if (!claimed_.contains(atom)) {
      return add("B0029", in_entry(moved > 0.0 ? "increase" : "decrease", atom),
                 fmt::format("{} changes {} by {}, of which the domain says nothing", who_, label(atom),
                             range_of(change)),
                 fmt::format("({} {} {}) in the effect", moved > 0.0 ? "increase" : "decrease", atom,
                             number(std::abs(moved))));
    }
    if (std::abs(moved) <= tolerance) {
      return add("B0024", in_entry("leave", atom),
                 fmt::format("{} changes {} by {} in the domain, and the plant leaves it", who_, label(atom),
                             number(claimed)),
                 "leave it out of the effect, or look at the sensor's tag");
    }
    if (moved * claimed < 0.0) {
      return add("B0025", in_entry(moved > 0.0 ? "increase" : "decrease", atom),
                 fmt::format("{} changes {} by {} in the domain, and the plant by {}", who_, label(atom),
                             number(claimed), range_of(change)),
                 fmt::format("({} {} ...) in the effect", moved > 0.0 ? "increase" : "decrease", atom));
    }
    judge_end_level(atom, level, after, change);
  }

  void judge_end_level(const std::string& atom, const LevelChange& level, const std::vector<double>& after,
                       const std::vector<double>& change) {
    if (atom != until_) {
      return add("B0028", in_entry("amount", atom),
                 fmt::format("{} changes {} by {} in the domain, and the plant by {}", who_, label(atom),
                             number(level.claimed), range_of(change)),
                 "amounts of the effect in the plant's own proportion, or a wider tolerance");
    }
    const double beyond = level.off * std::copysign(1.0, level.claimed);
    const double pre_act = std::max(0.0, entry_.completion.pre_act + beyond);
    add("B0028", "end",
        fmt::format("{} ends with {} at {} instead of {}", who_, label(atom), range_of(after),
                    number(planned_.after.fluents.at(atom))),
        beyond > 0.0 || entry_.completion.pre_act > 0.0
            ? fmt::format("until = {{ fluent = \"{}\", pre_act = {} }}",
                          translate::to_string(entry_.completion.atom), number(pre_act))
            : std::string("a longer rest_s, until what runs out has arrived"));
  }

  const Binding& binding_;
  std::span<const ActionRun> runs_;
  const model::PlannedAction& planned_;
  translate::Assignment assignment_;
  const ActionBinding& entry_;
  std::string who_;
  std::set<std::string> claimed_;
  std::string until_;
  Findings found_;
};

}  // namespace

Findings judge_runs(const Binding& binding, std::span<const ActionRun> runs) {
  return runs.empty() ? Findings() : Judge(binding, runs).take();
}

Spread spread_of(std::span<const ActionRun> runs) {
  Spread spread;
  double sum = 0.0;
  double squares = 0.0;
  for (const ActionRun& run : runs) {
    if (run.end != RunEnd::Done) continue;
    ++spread.runs;
    sum += run.active_s;
    squares += run.active_s * run.active_s;
    spread.longest_s = std::max(spread.longest_s, run.active_s);
  }
  if (spread.runs == 0) return spread;
  const auto count = static_cast<double>(spread.runs);
  spread.mean_s = sum / count;
  spread.spread_s = std::sqrt(std::max(0.0, squares / count - spread.mean_s * spread.mean_s));
  return spread;
}

}  // namespace stepwright::trial
