#include "runtime/modbus/server/access.h"

#include <algorithm>
#include <optional>
#include <tuple>

namespace stepwright::modbus::server {
namespace {

// The rule is about where this peer is.
bool comes_from(const ClientRule& rule, const Peer& peer, const std::optional<network::IpAddress>& address) {
  if (!rule.device.empty()) return rule.device == peer.address;
  return rule.any || (address && rule.address.contains(*address));
}

std::vector<Window> joined(std::vector<Window> windows) {
  std::sort(windows.begin(), windows.end(), [](const Window& a, const Window& b) {
    return std::tie(a.table, a.first) < std::tie(b.table, b.first);
  });
  std::vector<Window> out;
  for (const Window& window : windows) {
    if (!out.empty() && out.back().table == window.table && window.first <= out.back().last + 1) {
      out.back().last = std::max(out.back().last, window.last);
    } else {
      out.push_back(window);
    }
  }
  return out;
}

}  // namespace

Rights Rights::reader() {
  Rights rights;
  for (std::size_t table = 0; table < map::kTables; ++table)
    rights.read_.push_back({static_cast<map::Table>(table)});
  return rights;
}

Rights::Rights(const ClientRule& rule) : read_(joined(rule.read)), write_(joined(rule.write)) {
  if (!rule.role.empty()) refusal_ = pdu::Exception::IllegalFunction;
}

pdu::Exception Rights::judge(const std::vector<Window>& windows, map::Table table, std::uint16_t first,
                             std::uint16_t count) const {
  const std::uint32_t last = first + std::uint32_t{count} - 1;
  const bool inside = std::any_of(windows.begin(), windows.end(), [&](const Window& window) {
    return window.table == table && window.first <= first && last <= window.last;
  });
  return inside ? pdu::Exception::None : refusal_;
}

pdu::Exception Rights::read(map::Table table, std::uint16_t first, std::uint16_t count) const {
  return judge(read_, table, first, count);
}

pdu::Exception Rights::write(map::Table table, std::uint16_t first, std::uint16_t count) const {
  return judge(write_, table, first, count);
}

Rights Access::of(const Peer& peer) const {
  if (rules_.empty()) return Rights::reader();
  const std::optional<network::IpAddress> address = network::parse_ip(peer.address);
  const ClientRule* best = nullptr;
  const auto rank = [](const ClientRule& rule) {
    return std::pair(!rule.role.empty(), rule.any ? -1 : rule.address.prefix());
  };
  for (const ClientRule& rule : rules_) {
    if (!comes_from(rule, peer, address)) continue;
    if (!rule.role.empty() && (!peer.authenticated || peer.role != rule.role)) continue;
    if (best == nullptr || rank(rule) > rank(*best)) best = &rule;
  }
  if (best != nullptr) return Rights(*best);
  // Somebody whose certificate nobody knows is refused as the roles are.
  ClientRule nothing;
  if (peer.authenticated) nothing.role = peer.role.empty() ? "none" : peer.role;
  return Rights(nothing);
}

bool Access::any_writes() const {
  return std::any_of(rules_.begin(), rules_.end(),
                     [](const ClientRule& rule) { return !rule.write.empty(); });
}

}  // namespace stepwright::modbus::server
