#include <array>
#include <charconv>
#include <chrono>

#include "hmi_web/historian/visitors.h"

namespace stepwright::historian {
namespace {

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
  const auto end = std::to_chars(number.data(), number.data() + number.size(), sample.value).ptr;
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
