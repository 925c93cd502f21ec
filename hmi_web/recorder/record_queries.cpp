#include "hmi_web/recorder/record_queries.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include "hmi_web/historian/visitors.h"
#include "hmi_web/recorder/json_writer.h"
#include "runtime/ground/csv/csv_rows.h"

namespace stepwright::recorder {
namespace {

using alarms::AlarmEvent;
using alarms::AlarmState;
using alarms::JournalEntry;
using alarms::JournalQuery;
using alarms::Priority;
using api::Answer;
using api::refused;
using historian::Quality;
using historian::Sample;
using historian::Summary;
using historian::TagId;
using historian::Window;
using Parameters = api::CellRecords::Parameters;

constexpr std::size_t kMostTags = 12;
constexpr std::int64_t kMostColumns = 4'000;
constexpr std::int64_t kColumns = 1'000;
constexpr std::int64_t kMostEntries = 500;
constexpr std::int64_t kEntries = 100;
constexpr std::size_t kMostCsvEntries = 100'000;
constexpr std::size_t kMostCsvBytes = 32 << 20;
constexpr std::int64_t kHourNs = 3'600'000'000'000;
// A value that nobody repeats holds so long: twice the time after which the historian keeps it again.
constexpr std::int64_t kHoldsNs = 1'200'000'000'000;
constexpr double kMostMilliseconds = 4.6e12;  // of 64 bits of nanoseconds, so that a difference fits, too

template <typename T>
using Asked = result::Result<T>;

tl::unexpected<result::Diagnostics> wrong(std::string message, std::string hint) {
  return result::fail("H0060", {}, std::move(message), std::move(hint));
}

const std::string* find(const Parameters& given, std::string_view name) {
  const auto found = given.find(name);
  return found == given.end() || found->second.empty() ? nullptr : &found->second;
}

Asked<std::int64_t> whole_number(const Parameters& given, const char* name, std::int64_t fallback,
                                 std::int64_t least, std::int64_t most) {
  const std::string* text = find(given, name);
  if (text == nullptr) return fallback;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error == std::errc() && end == text->data() + text->size() && value >= least && value <= most)
    return value;
  return wrong(
      std::string(name) + " is no whole number from " + std::to_string(least) + " to " + std::to_string(most),
      std::string(name) + "=" + std::to_string(fallback));
}

Asked<std::int64_t> time_ns(const Parameters& given, const char* name, std::int64_t fallback) {
  const std::string* text = find(given, name);
  if (text == nullptr) return fallback;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error == std::errc() && end == text->data() + text->size() && std::abs(value) < kMostMilliseconds)
    return std::llround(value * 1e3) * 1'000;
  return wrong(std::string(name) + " is no time in milliseconds since 1970",
               "leave it out for the newest hour");
}

Asked<Window> window_of(const Parameters& given, std::int64_t now_ns) {
  auto to = time_ns(given, "to_ms", now_ns);
  if (!to) return result::forward(to);
  auto span = time_ns(given, "span_ms", kHourNs);
  if (!span) return result::forward(span);
  if (*span < 0) return wrong("span_ms is below 0", "from_ms is the earlier end of the window");
  auto from = time_ns(given, "from_ms", *to - *span);
  if (!from) return result::forward(from);
  if (*from > *to) return wrong("the window ends before it begins", "from_ms is the earlier one");
  return Window{*from, *to};
}

Asked<std::vector<TagId>> tags_of(const Parameters& given, const historian::Historian& historian,
                                  std::vector<std::string>* names = nullptr) {
  const std::string* text = find(given, "tags");
  if (text == nullptr) return wrong("there are no tags to show", "tags=points/a1.level;S1");
  std::vector<TagId> tags;
  std::string_view left = *text;
  while (!left.empty()) {
    const std::string name(left.substr(0, left.find(';')));
    left.remove_prefix(std::min(left.size(), name.size() + 1));
    const auto tag = historian.find(name);
    if (!tag) return wrong("there is no history of '" + name + "'", "/api/history/tags has every name");
    tags.push_back(*tag);
    if (names != nullptr) names->push_back(name);
  }
  if (tags.size() <= kMostTags) return tags;
  return wrong("there are more than " + std::to_string(kMostTags) + " tags", "ask for some of them");
}

bool is_known(const Sample& sample) {
  return sample.quality <= Quality::Uncertain && !std::isnan(sample.value);
}

// The columns of one tag: what lies in a column, or the value that holds through it, as far as that is known.
class Columns {
 public:
  Columns(const historian::Trend& trend, Window window, std::int64_t known_ns) {
    std::optional<Sample> held = trend.before;
    for (std::size_t i = 0; i < trend.buckets.size(); ++i) {
      const std::int64_t begin = window.from_ns + static_cast<std::int64_t>(i) * trend.bucket_ns;
      const Summary& bucket = trend.buckets[i];
      const bool holds = held && is_known(*held) && begin <= known_ns && begin - held->time_ns <= kHoldsNs;
      if (bucket.count > 0) {
        add(bucket, holds ? held : std::nullopt);
        held = bucket.last;
      } else {
        add(holds ? held->value : NAN, holds ? held->value : NAN, holds ? held->value : NAN);
      }
    }
  }
  void write(JsonWriter& out) const {
    const auto column = [&](const char* key, const std::vector<double>& values) {
      out.key(key).open('[');
      for (const double value : values) out.number(value);
      out.close(']');
    };
    column("least", least_);
    column("greatest", greatest_);
    column("last", last_);
  }

 private:
  // The value before lasts into the column.
  void add(const Summary& bucket, const std::optional<Sample>& held) {
    double least = bucket.has_extremes() ? bucket.least.value : NAN;
    double greatest = bucket.has_extremes() ? bucket.greatest.value : NAN;
    if (held) {
      least = std::fmin(least, held->value);
      greatest = std::fmax(greatest, held->value);
    }
    add(least, greatest, is_known(bucket.last) ? bucket.last.value : NAN);
  }
  void add(double least, double greatest, double last) {
    least_.push_back(least);
    greatest_.push_back(greatest);
    last_.push_back(last);
  }
  std::vector<double> least_, greatest_, last_;
};

template <typename Enum>
Asked<std::optional<Enum>> word_of(const Parameters& given, const char* name, std::uint8_t count) {
  const std::string* text = find(given, name);
  if (text == nullptr) return std::optional<Enum>();
  std::string all;
  for (std::uint8_t i = 0; i < count; ++i) {
    const auto value = static_cast<Enum>(i);
    if (*text == to_string(value)) return std::optional<Enum>(value);
    all += (i > 0 ? "; " : "") + std::string(to_string(value));
  }
  return wrong(std::string(name) + " is '" + *text + "'", "one of: " + all);
}

Asked<JournalQuery> journal_query(const Parameters& given) {
  JournalQuery query;
  for (const auto& [name, bound] : {std::pair("from_ms", &query.from_ns), std::pair("to_ms", &query.to_ns)}) {
    if (find(given, name) == nullptr) continue;
    auto time = time_ns(given, name, 0);
    if (!time) return result::forward(time);
    *bound = *time;
  }
  if (const std::string* alarm = find(given, "alarm")) query.alarm = *alarm;
  if (const std::string* source = find(given, "source")) query.source = *source;
  if (const std::string* user = find(given, "user")) query.user = *user;
  if (const std::string* text = find(given, "text")) query.text = *text;
  auto state = word_of<AlarmState>(given, "state", alarms::kAlarmStates);
  if (!state) return result::forward(state);
  auto event = word_of<AlarmEvent>(given, "event", alarms::kAlarmEvents);
  if (!event) return result::forward(event);
  auto priority = word_of<Priority>(given, "priority", alarms::kPriorities);
  if (!priority) return result::forward(priority);
  query.state = *state;
  query.event = *event;
  query.at_least = *priority;
  auto before = whole_number(given, "before", 0, 0, INT64_MAX);
  if (!before) return result::forward(before);
  if (*before > 0) query.before = *before;
  return query;
}

// RFC 4180; what a spreadsheet would take for a formula begins with an apostrophe.
void append_field(std::string& text, std::string_view value) {
  const bool formula =
      !value.empty() && std::string_view("=+-@\t\r").find(value.front()) != std::string::npos;
  text += '"';
  if (formula) text += '\'';
  for (const char c : value) {
    if (c == '"') text += '"';
    text += c;
  }
  text += '"';
}

// `told`: its value as people read it.
void append_entry(std::string& text, const JournalEntry& entry, const std::string& told) {
  const alarms::Transition& t = entry.transition;
  text += historian::iso_time(t.time_ns) + ',';
  append_field(text, entry.alarm);
  text += std::string(",") + to_string(entry.priority) + ',' + to_string(t.event) + ',';
  append_field(text, to_string(t.from));
  text += ',';
  append_field(text, to_string(t.to));
  std::array<char, 32> digits{};
  text += ',';
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), t.value).ptr);
  text += ',';
  append_field(text, told);
  text += t.first_out ? ",first," : ",,";
  append_field(text, t.user);
  text += ',';
  append_field(text, t.comment);
  text += "\r\n";
}

void write_entry(JsonWriter& out, const JournalEntry& entry) {
  const alarms::Transition& t = entry.transition;
  out.open('{').key("number").integer(entry.number).key("time_ms").milliseconds(t.time_ns);
  out.key("alarm").text(entry.alarm).key("source").text(entry.source);
  out.key("priority").text(to_string(entry.priority)).key("event").text(to_string(t.event));
  out.key("from").text(to_string(t.from)).key("to").text(to_string(t.to)).key("value").number(t.value);
  out.key("first_out").boolean(t.first_out).key("user").text(t.user).key("comment").text(t.comment);
  out.close('}');
}

}  // namespace

Answer RecordQueries::tags(const Parameters&) const {
  const historian::HistorianStatus status = recorder_.historian().status();
  JsonWriter out;
  out.open('{').key("now_ms").milliseconds(recorder_.now_ns()).key("tags").open('[');
  for (const std::string& name : recorder_.historian().names())
    if (!name.starts_with('@')) out.text(name);
  out.close(']').key("status").open('{').key("failing").boolean(status.failing);
  out.key("lost").integer(static_cast<std::int64_t>(status.lost + status.dropped));
  out.key("file_bytes").integer(static_cast<std::int64_t>(status.file_bytes));
  out.key("calendar_ahead_s").integer(recorder_.calendar_ahead().count());
  out.key("ahead_s").integer(recorder_.ahead_of_real_time().count());
  out.key("problem").text(status.problems.empty() ? "" : result::to_string(status.problems)).close('}');
  return {200, out.close('}').take()};
}

Answer RecordQueries::trend(const Parameters& given) const {
  // Before the read: what comes meanwhile is more than is told.
  const std::int64_t now_ns = recorder_.now_ns(), known_ns = recorder_.known_ns();
  const auto window = window_of(given, known_ns);
  if (!window) return refused(window.error());
  const auto columns = whole_number(given, "columns", kColumns, 1, kMostColumns);
  if (!columns) return refused(columns.error());
  std::vector<std::string> names;
  const auto tags = tags_of(given, recorder_.historian(), &names);
  if (!tags) return refused(tags.error());
  JsonWriter out;
  out.open('{')
      .key("now_ms")
      .milliseconds(now_ns)
      .key("known_ms")
      .milliseconds(known_ns)
      .key("from_ms")
      .milliseconds(window->from_ns);
  out.key("to_ms").milliseconds(window->to_ns).key("series").open('[');
  std::int64_t bucket_ns = 0;
  for (std::size_t i = 0; i < tags->size(); ++i) {
    const auto trend = recorder_.historian().trend((*tags)[i], *window, static_cast<std::size_t>(*columns));
    if (!trend) return refused(trend.error());
    bucket_ns = trend->bucket_ns;
    out.open('{').key("tag").text(names[i]);
    Columns(*trend, *window, known_ns).write(out);
    out.key("damaged").integer(static_cast<std::int64_t>(trend->damage.size())).close('}');
  }
  out.close(']').key("column_ms").number(static_cast<double>(bucket_ns) / 1e6);
  return {200, out.close('}').take()};
}

Answer RecordQueries::samples_csv(const Parameters& given) const {
  const auto window = window_of(given, recorder_.now_ns());
  if (!window) return refused(window.error());
  const auto tags = tags_of(given, recorder_.historian());
  if (!tags) return refused(tags.error());
  Answer reply;
  bool too_long = false;
  const auto damage = recorder_.historian().export_csv(*tags, *window, [&](std::string_view piece) {
    too_long = reply.text.size() + piece.size() > kMostCsvBytes;
    if (!too_long) reply.text += piece;
    return !too_long;
  });
  if (!damage) return refused(damage.error());
  if (too_long)
    return refused(400, "H0061", "the table would be longer than 32 MB",
                   "ask for a shorter time or fewer tags");
  reply.content_type = "text/csv; charset=utf-8";
  reply.file_name = "history.csv";
  return reply;
}

Answer RecordQueries::alarms(const Parameters& given) const {
  const std::string* all = find(given, "all");
  return {200, recorder_.alarms().json(all != nullptr && *all == "1")};
}

result::Result<api::AlarmChange> RecordQueries::act(const api::AlarmAction& action) {
  auto event = word_of<AlarmEvent>({{"event", action.event}}, "event", alarms::kAlarmEvents);
  if (!event) return result::forward(event);
  alarms::Command command;
  command.event = **event;
  command.user = action.user;
  command.comment = action.comment;
  command.shelve_for = action.shelve_for;
  auto change = recorder_.alarms().command(action.alarm, std::move(command));
  if (!change) return result::forward(change);
  return api::AlarmChange{std::move(change->before), std::move(change->after)};
}

namespace {

// A page asks as soon as it is told that an alarm has changed: that entry may still be on its way to the
// file. A file that takes none is told with the alarms.
result::Result<std::vector<JournalEntry>> entries_of(CellAlarms& alarms, const JournalQuery& query,
                                                     std::size_t most) {
  static_cast<void>(alarms.flush());
  return alarms.journal().find(query, most);
}

}  // namespace

Answer RecordQueries::journal(const Parameters& given) const {
  const auto query = journal_query(given);
  if (!query) return refused(query.error());
  const auto most = whole_number(given, "most", kEntries, 1, kMostEntries);
  if (!most) return refused(most.error());
  const auto entries = entries_of(recorder_.alarms(), *query, static_cast<std::size_t>(*most));
  if (!entries) return refused(entries.error());
  JsonWriter out;
  out.open('{').key("entries").open('[');
  for (const JournalEntry& entry : *entries) write_entry(out, entry);
  return {200, out.close(']').close('}').take()};
}

Answer RecordQueries::journal_csv(const Parameters& given) const {
  const auto query = journal_query(given);
  if (!query) return refused(query.error());
  const auto entries = entries_of(recorder_.alarms(), *query, kMostCsvEntries + 1);
  if (!entries) return refused(entries.error());
  if (entries->size() > kMostCsvEntries)
    return refused(400, "H0061", "the table would have more than 100,000 entries", "ask for a shorter time");
  Answer reply{200, std::string(csv::kByteOrderMark), "text/csv; charset=utf-8", "alarms.csv"};
  reply.text += "time,alarm,priority,event,from,to,value,told,first_out,user,comment\r\n";
  for (const JournalEntry& entry : *entries)
    append_entry(reply.text, entry, recorder_.alarms().told(entry.source, entry.transition.value).text);
  return reply;
}

}  // namespace stepwright::recorder
