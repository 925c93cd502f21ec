#include "hmi_web/recorder/cell_alarms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "hmi_web/alarms/codes.h"
#include "hmi_web/recorder/json_writer.h"
#include "hmi_web/server/image_value.h"

namespace stepwright::recorder {
namespace {

using alarms::AlarmDefinition;
using alarms::AlarmId;
using alarms::AlarmState;
using alarms::ConditionKind;
using alarms::Priority;

constexpr std::int64_t kStatisticsNs = 600'000'000'000;
constexpr std::size_t kMostForStatistics = 100'000;
constexpr double kLevelDeadband = 1.0;  // per cent
constexpr std::string_view kMonitor = "MON_SCAN[";
// Of an alarm whose source says nothing: whether it holds is not known, and it is not normal for that.
constexpr const char* kNoValue = "no value";
// The program has no such variable (any more): it cannot come, and what stood can never return.
constexpr const char* kNoVariable = "no variable";

AlarmDefinition made(std::string name, std::string text, std::string source, ConditionKind kind,
                     Priority priority) {
  AlarmDefinition one;
  one.name = std::move(name);
  one.text = std::move(text);
  one.source = std::move(source);
  one.condition.kind = kind;
  one.priority = priority;
  return one;
}

AlarmDefinition limit(const protocol::Tank& tank, ConditionKind kind, double percent) {
  const bool high = kind == ConditionKind::High;
  AlarmDefinition one = made(tank.id + (high ? ".high" : ".low"),
                             "The level of " + tank.label + (high ? " is high" : " is low"), tank.level_point,
                             kind, Priority::Medium);
  one.condition.limit = percent;
  one.condition.deadband = kLevelDeadband;
  one.condition.on_delay = std::chrono::seconds(1);
  one.response = high ? "stop what fills it" : "see whether it leaks, and fill it";
  one.suppress_by_hand = true;  // a tank that is cleaned is empty
  return one;
}

AlarmDefinition monitor_alarm(std::uint32_t number) {
  const std::string index = std::to_string(number);
  AlarmDefinition one =
      made("plan.monitor." + index, "What the plan relies on is lost (monitor " + index + ")",
           std::string(kMonitor) + index + "]", ConditionKind::On, Priority::Medium);
  one.group = "plan";
  one.consequence = "the plan does not reach its goal as it is";
  one.response = "see what the supervisor decides: it replans, or stops in the safe state";
  return one;
}

bool is_own(std::string_view source) {
  constexpr std::array kOwn = {kRuntimeAlive, kRuntimeFault, kSupervisorAlive, kServerAway};
  return std::ranges::find(kOwn, source) != kOwn.end();
}

bool is_unread(const std::optional<reader::Variable>& variable, const server::Observation& seen) {
  return variable && std::ranges::any_of(seen.unread, [&](const server::UnreadInputs& device) {
           return server::overlap_any(device.inputs, *variable);
         });
}

void write_times(JsonWriter& out, const alarms::AlarmView& view) {
  const auto time = [&](const char* key, std::int64_t ns) {
    out.key(key);
    ns == 0 ? out.null() : out.milliseconds(ns);
  };
  time("since_ms", view.since_ns);
  time("raised_ms", view.raised_ns);
  time("shelved_until_ms", view.shelved_until_ns);
}

// In other languages, where the definition has them.
void write_words(JsonWriter& out, const AlarmDefinition& one) {
  if (one.words.empty()) return;
  out.key("words").open('{');
  for (const auto& [language, words] : one.words) {
    out.key(language).open('{').key("text").text(words.text).key("consequence").text(words.consequence);
    out.key("response").text(words.response).close('}');
  }
  out.close('}');
}

void write_names(JsonWriter& out, const char* key, const std::vector<AlarmId>& ids,
                 const std::vector<AlarmDefinition>& definitions) {
  out.key(key).open('[');
  for (const AlarmId id : ids) out.text(definitions[id.value].name);
  out.close(']');
}

void write_figures(JsonWriter& out, const alarms::AlarmFigures& figures,
                   const std::vector<AlarmDefinition>& definitions, std::size_t no_value,
                   std::size_t no_variable) {
  out.key("figures").open('{');
  out.key("annunciated").integer(static_cast<std::int64_t>(figures.annunciated));
  out.key("in_ten_minutes").integer(figures.in_ten_minutes);
  out.key("most_in_ten_minutes").integer(figures.most_in_ten_minutes);
  out.key("flood").boolean(figures.flood).key("floods").integer(figures.floods);
  out.key("flood_share").number(std::round(figures.flood_share * 1e4) / 1e4);
  out.key("standing").open('{');
  for (std::uint8_t i = 0; i < alarms::kPriorities; ++i)
    out.key(to_string(static_cast<Priority>(i))).integer(figures.standing[i]);
  out.close('}');
  out.key("unacknowledged").integer(figures.unacknowledged).key("shelved").integer(figures.shelved);
  out.key("suppressed").integer(figures.suppressed).key("out_of_service").integer(figures.out_of_service);
  out.key("no_value").integer(static_cast<std::int64_t>(no_value));
  out.key("no_variable").integer(static_cast<std::int64_t>(no_variable));
  write_names(out, "stale", figures.stale, definitions);
  write_names(out, "chattering", figures.chattering, definitions);
  out.key("most_frequent").open('[');
  for (const alarms::AlarmCount& one : figures.most_frequent) {
    out.open('{').key("name").text(definitions[one.alarm.value].name);
    out.key("count").integer(static_cast<std::int64_t>(one.count)).close('}');
  }
  out.close(']').close('}');
}

}  // namespace

std::vector<AlarmDefinition> built_in_alarms(const protocol::Synoptic& synoptic,
                                             const BuiltInAlarms& wanted) {
  std::vector<AlarmDefinition> all;
  all.push_back(made("runtime.lost", "The runtime does not answer", std::string(kRuntimeAlive),
                     ConditionKind::Off, Priority::Critical));
  // A page's server that starts with its cell is there before the others.
  all.back().condition.on_delay = std::chrono::seconds(2);
  all.back().consequence = "nobody sees what the plant does";
  all.back().response = "see whether the runtime and its link are running";
  all.push_back(made("runtime.fault", "The program has been stopped by a fault", std::string(kRuntimeFault),
                     ConditionKind::On, Priority::Critical));
  all.back().consequence = "outputs are in their safe state";
  all.back().response = "see what the runtime says of it, mend the program and start it";
  all.push_back(made("server.away", "The server of this page was away", std::string(kServerAway),
                     ConditionKind::On, Priority::Low));
  all.back().traits.acknowledge_on_return = true;
  all.back().consequence = "what came and went meanwhile is not in this journal";
  all.back().response = "see the audit trail and the plan for what has happened";
  if (wanted.supervisor) {
    all.push_back(made("supervisor.lost", "The supervisor does not answer", std::string(kSupervisorAlive),
                       ConditionKind::Off, Priority::High));
    all.back().condition.on_delay = std::chrono::seconds(5);
    all.back().consequence = "nothing is replanned";
    all.back().response = "see whether the supervisor is running";
  }
  for (const protocol::Tank& tank : synoptic.tanks) {
    if (tank.level_point.empty()) continue;
    if (tank.high_percent > 0) all.push_back(limit(tank, ConditionKind::High, tank.high_percent));
    if (tank.low_percent > 0) all.push_back(limit(tank, ConditionKind::Low, tank.low_percent));
  }
  for (std::uint32_t i = 1; i <= wanted.monitors; ++i) all.push_back(monitor_alarm(i));
  return all;
}

result::Result<std::unique_ptr<CellAlarms>> CellAlarms::open(const std::filesystem::path& file,
                                                             std::vector<AlarmDefinition> definitions,
                                                             const std::vector<protocol::Point>& points,
                                                             alarms::JournalOptions options,
                                                             std::int64_t seen_until_ns,
                                                             std::vector<protocol::TagNote> notes) {
  auto engine = alarms::AlarmEngine::create(definitions);
  if (!engine) return result::forward(engine);
  auto journal = alarms::AlarmJournal::open(file, std::move(definitions), std::move(options));
  if (!journal) return result::forward(journal);
  std::unique_ptr<CellAlarms> all(
      new CellAlarms(std::move(*engine), std::move(*journal), points, std::move(notes)));
  if (auto done = all->go_on(); !done) return result::forward(done);
  if (seen_until_ns > 0) all->note_absence(seen_until_ns);
  return all;
}

CellAlarms::CellAlarms(alarms::AlarmEngine engine, std::unique_ptr<alarms::AlarmJournal> journal,
                       std::vector<protocol::Point> points, std::vector<protocol::TagNote> notes)
    : journal_(std::move(journal)),
      points_(std::move(points)),
      notes_(std::move(notes)),
      texts_(notes_, points_, nullptr),
      engine_(std::move(engine)),
      statistics_(engine_.definitions()) {
  for (const std::string& name : engine_.sources())
    sources_.push_back({name, nullptr, {}, name.starts_with(kMonitor), false, std::nullopt});
  std::map<std::string_view, const Source*> by_name;
  for (const Source& source : sources_) by_name.emplace(source.name, &source);
  for (const AlarmDefinition& one : engine_.definitions()) {
    const auto suppressor = by_name.find(one.suppress_when);
    uses_.push_back({by_name.at(one.source), suppressor == by_name.end() ? nullptr : suppressor->second});
  }
}

// States of the journal, and the figures of its last ten minutes.
result::Result<void> CellAlarms::go_on() {
  if (auto done = restore(engine_, *journal_); !done) return done;
  auto newest = journal_->find({}, 1);
  if (!newest) return result::forward(newest);
  if (newest->empty()) return {};
  now_ns_ = newest->front().transition.time_ns;
  auto entries = journal_->find({.from_ns = now_ns_ - kStatisticsNs}, kMostForStatistics);
  if (!entries) return result::forward(entries);
  for (auto entry = entries->rbegin(); entry != entries->rend(); ++entry) {
    if (const auto alarm = engine_.find(entry->alarm)) {
      entry->transition.alarm = *alarm;
      statistics_.note(entry->transition);
    }
  }
  for (std::uint32_t i = 0; i < engine_.definitions().size(); ++i)
    statistics_.restore(AlarmId(i), engine_.view(AlarmId(i)));
  return {};
}

// Nobody saw what happened since then. That is an alarm of its own, which returns with the first look.
void CellAlarms::note_absence(std::int64_t seen_until_ns) {
  now_ns_ = std::max(now_ns_, seen_until_ns);
  engine_.blind_since(now_ns_);
  offer_own(kServerAway, now_ns_, 1.0, true);
  hand_on();
}

// One of the cell's own sources.
void CellAlarms::offer_own(std::string_view source, std::int64_t time_ns, double value, bool time_known) {
  for (std::uint32_t i = 0; i < sources_.size(); ++i)
    if (sources_[i].name == source) engine_.offer(alarms::SourceId(i), time_ns, value, true, time_known);
}

void CellAlarms::runtime_answers(std::int64_t time_ns) {
  const std::lock_guard lock(mutex_);
  now_ns_ = std::max(now_ns_, time_ns);
  offer_own(kRuntimeAlive, now_ns_, 1.0, false);
  hand_on();
}

std::optional<reader::Variable> CellAlarms::variable_of(const std::string& name,
                                                        const server::ProgramLayout* layout) const {
  const bool other = is_own(name) || std::ranges::find(points_, name, &protocol::Point::id) != points_.end();
  return other || layout == nullptr ? std::nullopt : find_tag(*layout, name);
}

CellAlarms::Read CellAlarms::reader_of(const std::string& name, const server::ProgramLayout* layout) const {
  const auto flag = [](bool value) { return std::optional<double>(value ? 1.0 : 0.0); };
  // What is no number is neither above nor below a limit.
  const auto known = [](const std::optional<double>& value) {
    return value && std::isnan(*value) ? std::nullopt : value;
  };
  if (name == kRuntimeAlive)
    return [flag](const RecordedScan& scan) { return flag(scan.observation->runtime_alive); };
  if (name == kRuntimeFault) {
    return [flag](const RecordedScan& scan) -> std::optional<double> {
      if (!scan.observation->runtime_alive) return std::nullopt;
      const auto& status = scan.observation->status;
      return flag(status && status->state == host::RuntimeState::Fault);
    };
  }
  if (name == kSupervisorAlive)
    return [flag](const RecordedScan& scan) { return flag(scan.observation->supervisor_alive); };
  if (name == kServerAway) return [flag](const RecordedScan&) { return flag(false); };
  const auto point = std::ranges::find(points_, name, &protocol::Point::id);
  if (point != points_.end()) {
    const auto index = static_cast<std::size_t>(point - points_.begin());
    return [index, known](const RecordedScan& scan) -> std::optional<double> {
      if (!scan.observation->runtime_alive) return std::nullopt;
      return known(scan.view->state.points.at(index));
    };
  }
  const auto tag = variable_of(name, layout);
  if (!tag) return nullptr;
  return [tag = *tag, known](const RecordedScan& scan) -> std::optional<double> {
    if (!scan.observation->runtime_alive || !scan.observation->snapshot) return std::nullopt;
    // Before its first scan the program has read nothing and computed nothing.
    if (scan.observation->snapshot->scan == 0) return std::nullopt;
    return known(server::read(tag, scan.observation->snapshot->image));
  };
}

void CellAlarms::resolve(const std::shared_ptr<const server::ProgramLayout>& layout) {
  if (resolved_ && layout == layout_) return;
  resolved_ = true;
  const auto before = std::exchange(layout_, layout);  // until texts_ is another one
  for (Source& source : sources_) {
    source.read = reader_of(source.name, layout.get());
    source.variable = variable_of(source.name, layout.get());
  }
  monitor_now_ = reader_of("MON_NOW", layout.get());
  {
    const std::lock_guard lock(mutex_);
    texts_ = server::ValueTexts(notes_, points_, layout_.get());
  }
  before_count_ = interval_ns_ = 0;
}

void CellAlarms::measure_interval(const RecordedScan& scan) {
  const auto count = monitor_now_ ? monitor_now_(scan) : std::nullopt;
  const std::int64_t now = count ? std::llround(*count) : 0;
  if (before_count_ > 0 && now > before_count_)
    interval_ns_ = (scan.time_ns - before_ns_) / (now - before_count_);
  before_count_ = now;
  before_ns_ = scan.time_ns;
}

// A monitor keeps the number of the scan that raised it, counted as MON_NOW: that scan has its own time.
std::int64_t CellAlarms::time_of(const Source& source, double value, const RecordedScan& scan) const {
  if (!source.is_monitor || value < 1.0 || value > static_cast<double>(before_count_)) return scan.time_ns;
  return scan.time_ns - (before_count_ - std::llround(value)) * interval_ns_;
}

CellAlarms::Missing CellAlarms::missing_of(const Source& source, bool unread, bool has_value,
                                           const RecordedScan& scan) {
  if (has_value) return Missing::Nothing;
  const server::Observation& seen = *scan.observation;
  if (!seen.runtime_alive || !seen.snapshot || !scan.view->layout) return Missing::Image;
  if (unread) return Missing::Device;
  return source.read ? Missing::Value : Missing::Variable;
}

void CellAlarms::take(const RecordedScan& scan) {
  resolve(scan.view->layout);
  measure_interval(scan);
  const std::lock_guard lock(mutex_);
  now_ns_ = std::max(now_ns_, scan.time_ns);
  for (std::uint32_t i = 0; i < sources_.size(); ++i) {
    Source& source = sources_[i];
    const bool unread = is_unread(source.variable, *scan.observation);
    std::optional<double> value = source.read && !unread ? source.read(scan) : std::nullopt;
    // The next program has other monitors, or none: what this one raised is over.
    if (source.is_monitor && !source.read && scan.view->layout) value = 0.0;
    note_missing(source, missing_of(source, unread, value.has_value(), scan));
    // Its scan is known, and its time with the next image.
    const bool counts = source.is_monitor && source.read && value.value_or(0.0) >= 1.0;
    if (counts && monitor_now_ && interval_ns_ == 0) continue;
    if (source.offered && value == source.last) continue;
    source.offered = true;
    source.last = value;
    engine_.offer(alarms::SourceId(i), time_of(source, value.value_or(0.0), scan), value.value_or(0.0),
                  value.has_value(), counts && interval_ns_ > 0);
  }
  engine_.advance(now_ns_);
  hand_on();
}

// Pages are told, though nothing has happened to an alarm.
void CellAlarms::note_missing(Source& source, Missing missing) {
  if (std::exchange(source.missing, missing) != missing) ++revision_;
  // While there is no image nobody knows: what was known last stays.
  if (missing != Missing::Image) source.has_no_variable = missing == Missing::Variable;
}

const char* CellAlarms::word_of(AlarmId id) const {
  const AlarmState state = engine_.view(id).status.state();
  const Missing missing = uses_[id.value].watched->missing;
  const bool seen = state == AlarmState::Normal || state == AlarmState::Acknowledged;
  if (seen && missing == Missing::Variable) return kNoVariable;
  const bool unknown = missing != Missing::Nothing;
  return state == AlarmState::Normal && unknown ? kNoValue : to_string(state);
}

// A sentence; empty if both of its sources have values.
std::string CellAlarms::problem_of(AlarmId id) const {
  const auto [watched, suppressor] = uses_[id.value];
  switch (watched->missing) {
    case Missing::Image:
      return "no image of a running program is there";
    case Missing::Variable:
      return "the program has no variable '" + watched->name + "'";
    case Missing::Device:
      return "the device of '" + watched->name + "' does not answer";
    case Missing::Value:
      return "'" + watched->name + "' has no value";
    case Missing::Nothing:
      break;
  }
  if (suppressor == nullptr || suppressor->missing != Missing::Variable) return {};
  return "the program has no variable '" + suppressor->name + "', which would suppress it";
}

void CellAlarms::hand_on() {
  const auto transitions = engine_.take();
  if (transitions.empty()) return;
  for (const alarms::Transition& transition : transitions) statistics_.note(transition);
  journal_->append(transitions);
  ++revision_;
}

result::Result<AlarmChange> CellAlarms::command(std::string_view alarm, alarms::Command by) {
  AlarmChange change;
  {
    const std::lock_guard lock(mutex_);
    const auto id = engine_.find(alarm);
    if (!id)
      return result::fail(alarms::kNoSuchAlarm, {}, "there is no alarm '" + std::string(alarm) + "'",
                          "the list of alarms has every name");
    by.alarm = *id;
    by.time_ns = now_ns_;
    engine_.advance(now_ns_);  // a delay or a shelf may have ended: that is no part of the change
    change.before = word_of(*id);
    auto done = engine_.command(by);
    change.after = word_of(*id);
    hand_on();
    if (!done) return result::forward(done);
  }
  if (auto written = journal_->flush(); !written) return result::forward(written);
  return change;
}

std::vector<StandingView> CellAlarms::unacknowledged() const {
  const std::lock_guard lock(mutex_);
  std::vector<StandingView> all;
  for (std::uint32_t i = 0; i < engine_.definitions().size(); ++i) {
    const alarms::AlarmView view = engine_.view(AlarmId(i));
    const AlarmState state = view.status.state();
    if (state != AlarmState::Unacknowledged && state != AlarmState::LatchedUnacknowledged) continue;
    all.push_back({engine_.definitions()[i], view, text_of(engine_.definitions()[i].source, view.value)});
  }
  return all;
}

server::ValueText CellAlarms::text_of(const std::string& source, double value) const {
  return is_own(source) ? server::ValueText() : texts_.of(source, value);
}

server::ValueText CellAlarms::told(const std::string& source, double value) const {
  const std::lock_guard lock(mutex_);
  return text_of(source, value);
}

std::vector<std::pair<std::string, std::string>> CellAlarms::without_variable() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::pair<std::string, std::string>> all;
  for (std::uint32_t i = 0; i < uses_.size(); ++i) {
    const Source& source = *uses_[i].watched;
    if (source.has_no_variable) all.emplace_back(engine_.definitions()[i].name, source.name);
  }
  return all;
}

std::uint64_t CellAlarms::revision() const {
  const std::lock_guard lock(mutex_);
  return revision_;
}

std::string no_alarms_json(const std::string& problem) {
  JsonWriter out;
  out.open('{').key("count").integer(0).key("alarms").open('[').close(']');
  write_figures(out, {}, {}, 0, 0);
  out.key("journal").open('{').key("failing").boolean(true).key("dropped").integer(0);
  return out.key("problem").text(problem).close('}').close('}').take();
}

std::string CellAlarms::json(bool all) const {
  JsonWriter out;
  out.open('{');
  {
    const std::lock_guard lock(mutex_);
    const auto& definitions = engine_.definitions();
    const alarms::AlarmFigures figures = statistics_.figures(now_ns_);
    std::size_t no_value = 0;
    std::size_t no_variable = 0;
    out.key("count").integer(static_cast<std::int64_t>(definitions.size())).key("alarms").open('[');
    for (std::uint32_t i = 0; i < definitions.size(); ++i) {
      const AlarmDefinition& one = definitions[i];
      const alarms::AlarmView& view = engine_.view(AlarmId(i));
      const std::string_view state = word_of(AlarmId(i));
      if (state == kNoValue) ++no_value;
      if (state == kNoVariable) ++no_variable;
      // While there is no image they are all without a value, and what is lost is an alarm of its own.
      const bool blind = state == kNoValue && uses_[i].watched->missing == Missing::Image;
      if (!all && (blind || state == to_string(AlarmState::Normal))) continue;
      out.open('{').key("name").text(one.name).key("text").text(one.text).key("source").text(one.source);
      out.key("priority").text(to_string(one.priority)).key("state").text(state);
      out.key("active").boolean(view.status.active).key("value").number(view.value);
      out.key("problem").text(problem_of(AlarmId(i)));
      out.key("group").text(one.group).key("first_out").boolean(view.first_out);
      out.key("longest_shelving_min")
          .integer(std::chrono::duration_cast<std::chrono::minutes>(one.longest_shelving).count());
      out.key("suppress_by_hand").boolean(one.suppress_by_hand);
      out.key("shelved").boolean(view.status.shelved).key("suppressed").boolean(view.status.suppressed);
      out.key("out_of_service").boolean(view.status.out_of_service);
      write_times(out, view);
      out.key("consequence").text(one.consequence).key("response").text(one.response);
      write_words(out, one);
      out.close('}');
    }
    out.close(']');
    write_figures(out, figures, definitions, no_value, no_variable);
  }
  const alarms::JournalStatus status = journal_->status();
  out.key("journal").open('{').key("failing").boolean(status.failing);
  out.key("dropped").integer(static_cast<std::int64_t>(status.dropped));
  out.key("problem").text(status.problems.empty() ? "" : result::to_string(status.problems)).close('}');
  return out.close('}').take();
}

}  // namespace stepwright::recorder
