#include "hmi_web/historian/visitors.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>

namespace stepwright::historian {
namespace {

constexpr double kLastExact = 9007199254740992.0;  // 2^53

std::uint64_t distance(std::int64_t from, std::int64_t to) {
  return static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
}

constexpr std::size_t kPieceBytes = 64 * 1024;

// RFC 4180.
std::string quoted(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string made = "\"";
  for (const char c : text) {
    if (c == '"') made += '"';
    made += c;
  }
  return made + '"';
}

void append_digits(std::string& text, unsigned value, int digits) {
  std::array<char, 10> buffer{};
  for (int i = digits; i-- > 0; value /= 10)
    buffer[static_cast<std::size_t>(i)] = static_cast<char>('0' + value % 10);
  text.append(buffer.data(), static_cast<std::size_t>(digits));
}

}  // namespace

bool WindowVisitor::outside(const Summary& summary) const {
  return summary.last.time_ns < window_.from_ns || summary.first.time_ns > window_.to_ns;
}

bool WindowVisitor::inside(const Sample& sample) const {
  return sample.time_ns >= window_.from_ns && sample.time_ns <= window_.to_ns;
}

void WindowVisitor::note_before(const Sample& sample) {
  if (sample.time_ns < window_.from_ns && (!before || sample.time_ns >= before->time_ns)) before = sample;
}

void WindowVisitor::damaged(const Summary& summary) {
  damage.push_back({summary.count, summary.first.time_ns, summary.last.time_ns});
}

Look RangeVisitor::judge(const Summary& summary) {
  if (truncated) return Look::End;
  return outside(summary) ? Look::Summary : Look::Closer;
}

void RangeVisitor::take(const Summary& summary) {
  note_before(summary.last);
}

void RangeVisitor::take(const Sample& sample) {
  note_before(sample);
  if (!inside(sample)) return;
  if (samples.size() == most_) {
    truncated = true;
    return;
  }
  samples.push_back(sample);
}

TrendVisitor::TrendVisitor(Window window, std::size_t count) : WindowVisitor(window) {
  const std::uint64_t last = distance(window.from_ns, window.to_ns);
  // Every time of the window has a bucket; in windows of more than 292 years the last one may be longer.
  constexpr std::uint64_t kLongest = std::numeric_limits<std::int64_t>::max();
  bucket_ns_ = std::min(last / count, kLongest - 1) + 1;
  buckets.resize(std::min(count, static_cast<std::size_t>(last / bucket_ns_) + 1));
}

std::size_t TrendVisitor::bucket_of(std::int64_t time_ns) const {
  const std::uint64_t bucket = distance(window_.from_ns, time_ns) / bucket_ns_;
  return std::min(static_cast<std::size_t>(bucket), buckets.size() - 1);
}

Look TrendVisitor::judge(const Summary& summary) {
  if (outside(summary)) return Look::Summary;
  const bool whole = inside(summary.first) && inside(summary.last) &&
                     bucket_of(summary.first.time_ns) == bucket_of(summary.last.time_ns);
  return whole ? Look::Summary : Look::Closer;
}

void TrendVisitor::take(const Summary& summary) {
  if (outside(summary)) {
    note_before(summary.last);
  } else {
    buckets[bucket_of(summary.first.time_ns)].add(summary);
  }
}

void TrendVisitor::take(const Sample& sample) {
  note_before(sample);
  if (inside(sample)) buckets[bucket_of(sample.time_ns)].add(sample);
}

std::string iso_time(std::int64_t time_ns) {
  using namespace std::chrono;
  const sys_time<nanoseconds> time{nanoseconds(time_ns)};
  const auto day = floor<days>(time);
  const year_month_day date{day};
  const hh_mm_ss clock{time - day};
  std::string text;
  append_digits(text, static_cast<unsigned>(static_cast<int>(date.year())), 4);  // 1677 to 2262
  text += '-';
  append_digits(text, static_cast<unsigned>(date.month()), 2);
  text += '-';
  append_digits(text, static_cast<unsigned>(date.day()), 2);
  text += 'T';
  append_digits(text, static_cast<unsigned>(clock.hours().count()), 2);
  text += ':';
  append_digits(text, static_cast<unsigned>(clock.minutes().count()), 2);
  text += ':';
  append_digits(text, static_cast<unsigned>(clock.seconds().count()), 2);
  if (clock.subseconds().count() != 0) {
    text += '.';
    append_digits(text, static_cast<unsigned>(clock.subseconds().count()), 9);
    text.erase(text.find_last_not_of('0') + 1);
  }
  return text + 'Z';
}

CsvVisitor::CsvVisitor(Window window, std::string_view tag, const Historian::Sink& sink)
    : WindowVisitor(window), tag_(quoted(tag) + ','), sink_(sink) {}

Look CsvVisitor::judge(const Summary& summary) {
  if (!wanted_) return Look::End;
  return outside(summary) ? Look::Summary : Look::Closer;
}

void CsvVisitor::take(const Sample& sample) {
  if (!inside(sample)) return;
  std::array<char, 32> number{};
  // Beyond 2^53 a number is rounded: a power of ten says no digits that nobody has measured.
  char* const room_end = number.data() + number.size();
  const auto end =
      std::abs(sample.value) <= kLastExact
          ? std::to_chars(number.data(), room_end, sample.value).ptr
          : std::to_chars(number.data(), room_end, sample.value, std::chars_format::scientific).ptr;
  text_ += tag_;
  text_ += iso_time(sample.time_ns);
  text_ += ',';
  text_.append(number.data(), end);
  text_ += ',';
  text_ += to_string(sample.quality);
  text_ += "\r\n";
  if (text_.size() >= kPieceBytes) hand_on();
}

void CsvVisitor::hand_on() {
  if (wanted_ && !text_.empty()) wanted_ = sink_(text_);
  text_.clear();
}

bool CsvVisitor::finish() {
  hand_on();
  return wanted_;
}

}  // namespace stepwright::historian
