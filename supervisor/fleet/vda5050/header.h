#pragma once

// Header of every message (VDA 5050 2.1.0, section 6.4).
//
// Values and pure functions; any thread. HeaderIds: one thread at a time.
//
//   HeaderIds ids;
//   const Header header = make_header(address, Topic::Order, ids, now);

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "supervisor/fleet/vda5050/topic.h"

namespace stepwright::fleet::vda5050 {

using Timestamp = std::chrono::sys_time<std::chrono::milliseconds>;

// "2026-11-23T03:50:00.125Z". Requires a year from 0 to 9999.
std::string to_text(Timestamp time);
// Up to nine digits of a fraction, of which three count; only UTC, written as Z. Nothing for what is no time.
std::optional<Timestamp> timestamp_of(std::string_view text);

struct Header {
  std::uint32_t header_id = 0;
  Timestamp timestamp{};
  std::string version{kVersion};
  std::string manufacturer;
  std::string serial_number;

  friend bool operator==(const Header&, const Header&) = default;
};

// Counts the messages of one vehicle, topic by topic.
class HeaderIds {
 public:
  std::uint32_t next(Topic topic) { return next_[static_cast<std::size_t>(topic)]++; }

 private:
  std::array<std::uint32_t, kTopics.size()> next_{};
};

Header make_header(const Address& address, Topic topic, HeaderIds& ids, Timestamp now);

}  // namespace stepwright::fleet::vda5050
