#include "runtime/modbus/client/poll/read_plan.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <tuple>

namespace stepwright::modbus::client {
namespace {

constexpr std::uint32_t kBitsForARegister = 16;

ReadRequest request_of(std::span<const std::uint32_t> members, std::span<const Tag> tags) {
  const Tag& first = tags[members.front()];
  std::uint32_t end = 0;
  for (const std::uint32_t index : members) end = std::max(end, tags[index].end());
  return {first.table,
          first.first,
          static_cast<std::uint16_t>(end - first.first),
          {members.begin(), members.end()}};
}

}  // namespace

std::vector<ReadRequest> plan_reads(std::span<const Tag> tags, const ReadLimits& limits) {
  std::vector<std::uint32_t> order(tags.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(tags[a].table, tags[a].first, a) < std::tuple(tags[b].table, tags[b].first, b);
  });
  std::vector<ReadRequest> requests;
  for (const std::uint32_t index : order) {
    const Tag& tag = tags[index];
    const bool bits = is_bits(tag.table);
    const std::uint32_t most = bits ? limits.max_bits : limits.max_registers;
    const std::uint32_t gap = limits.max_gap * (bits ? kBitsForARegister : 1u);
    assert(tag.count() <= most);
    if (!requests.empty() && requests.back().table == tag.table) {
      ReadRequest& open = requests.back();
      const std::uint32_t end = std::uint32_t{open.first} + open.count;
      const std::uint32_t wanted = std::max(end, tag.end()) - open.first;
      if (tag.first <= end + gap && wanted <= most) {
        open.count = static_cast<std::uint16_t>(wanted);
        open.tags.push_back(index);
        continue;
      }
    }
    requests.push_back({tag.table, tag.first, tag.count(), {index}});
  }
  return requests;
}

std::vector<ReadRequest> halves_of(const ReadRequest& request, std::span<const Tag> tags) {
  if (request.tags.size() < 2) return {};
  const std::span<const std::uint32_t> members(request.tags);
  const std::size_t half = members.size() / 2;
  return {request_of(members.first(half), tags), request_of(members.subspan(half), tags)};
}

}  // namespace stepwright::modbus::client
