#pragma once

// Addresses of clients: which of them a rule means. "192.168.1.0/24", "10.0.0.7", "fd00::/8".
// Plain values; any thread.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stepwright::network {

// IPv6, or IPv4 as its mapped form (::ffff:a.b.c.d), so that both are compared alike.
using IpAddress = std::array<std::uint8_t, 16>;

std::optional<IpAddress> parse_ip(std::string_view text);
// As people write it; of a mapped address the IPv4 form.
std::string to_string(const IpAddress& address);

class IpRange {
 public:
  // Without a prefix length: that one address. None if it is neither.
  static std::optional<IpRange> parse(std::string_view text);

  bool contains(const IpAddress& address) const;
  // How exact it is: 0 to 128.
  int prefix() const { return prefix_; }

 private:
  IpAddress address_{};
  int prefix_ = 0;
};

}  // namespace stepwright::network
