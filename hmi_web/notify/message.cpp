#include "hmi_web/notify/message.h"

#include <sodium.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <nlohmann/json.hpp>
#include <tuple>

namespace stepwright::notify {
namespace {

using nlohmann::json;

std::string utc(std::int64_t ns) {
  const std::time_t seconds = ns / 1'000'000'000;
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S UTC", &parts)};
}

std::string dumped(const json& document) {
  return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

// RFC 2047: a header is ASCII without line breaks.
std::string header(const std::string& text) {
  const auto plain = [](unsigned char c) { return c >= 0x20 && c < 0x7F; };
  if (std::ranges::all_of(text, plain)) return text;
  // Up to 45 bytes of a word, and no character cut in two.
  std::string words;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = std::min(at + 45, text.size());
    while (end < text.size() && end > at + 1 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
      --end;
    std::array<char, sodium_base64_ENCODED_LEN(45, sodium_base64_VARIANT_ORIGINAL)> word{};
    sodium_bin2base64(word.data(), word.size(), reinterpret_cast<const unsigned char*>(text.data() + at),
                      end - at, sodium_base64_VARIANT_ORIGINAL);
    words += std::string(words.empty() ? "" : "\r\n ") + "=?UTF-8?B?" + word.data() + "?=";
    at = end;
  }
  return words;
}

std::string with_mail_lines(const std::string& text) {
  std::string lines;
  for (const char c : text) {
    if (c == '\r') continue;
    if (c == '\n') lines += '\r';
    lines += c;
  }
  return lines;
}

}  // namespace

Message message_of(const std::string& cell, std::vector<StandingAlarm> alarms, std::chrono::seconds repeat) {
  std::ranges::stable_sort(alarms, [](const StandingAlarm& a, const StandingAlarm& b) {
    return std::tuple(a.priority, a.raised_ns) < std::tuple(b.priority, b.raised_ns);
  });
  Message message;
  const StandingAlarm& first = alarms.front();
  message.subject = cell + ": " + first.text + " (" + to_string(first.priority) + ")";
  if (alarms.size() > 1) message.subject += " and " + std::to_string(alarms.size() - 1) + " more";
  json list = json::array();
  for (const StandingAlarm& each : alarms) {
    message.text += std::string(to_string(each.priority)) + ": " + each.text + "\n  " + each.name +
                    ", unacknowledged, raised " + utc(each.raised_ns);
    if (!each.source.starts_with("cell.")) message.text += ", " + each.source + " = " + each.told;
    message.text += "\n";
    if (!each.response.empty()) message.text += "  What to do: " + each.response + "\n";
    list.push_back({{"name", each.name},
                    {"text", each.text},
                    {"source", each.source},
                    {"priority", to_string(each.priority)},
                    {"response", each.response},
                    {"raised_ms", each.raised_ns / 1'000'000},
                    {"value", each.is_bool ? json(each.value != 0) : json(each.value)},
                    {"told", each.told},
                    {"unit", each.unit}});
  }
  message.text += repeat.count() == 0
                      ? "\nSent once by the cell " + cell + ": its page shows what stands now.\n"
                      : "\nSent by the cell " + cell + " until somebody acknowledges it on its page.\n";
  message.json = dumped({{"cell", cell}, {"kind", "alarms"}, {"alarms", std::move(list)}});
  return message;
}

Message test_message(const std::string& cell, const Channel& channel, const std::string& user) {
  return {cell + ": test of '" + channel.name + "'",
          "This is a test that " + user + " asked for. Nothing has happened in the cell " + cell + ".\n",
          dumped({{"cell", cell}, {"kind", "test"}, {"alarms", json::array()}, {"user", user}})};
}

std::string mail_of(const Channel& channel, const Message& message, const std::string& date,
                    const std::string& id) {
  std::string to;
  for (const std::string& each : channel.to) to += (to.empty() ? "<" : ", <") + each + ">";
  return "Date: " + date + "\r\nFrom: <" + channel.from + ">\r\nTo: " + to + "\r\nMessage-ID: <" + id +
         ">\r\nSubject: " + header(message.subject) +
         "\r\nMIME-Version: 1.0\r\nContent-Type: text/plain; charset=utf-8\r\n"
         "Content-Transfer-Encoding: 8bit\r\nAuto-Submitted: auto-generated\r\n\r\n" +
         with_mail_lines(message.text);
}

}  // namespace stepwright::notify
