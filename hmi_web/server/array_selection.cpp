#include "hmi_web/server/array_selection.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace stepwright::server {

ArraySelection::ArraySelection(const std::vector<reader::Tag>& tags,
                               const std::vector<reader::InstanceInfo>& instances) {
  for (const reader::InstanceInfo& each : instances) blocks_.insert(each.path);
  for (const reader::Tag& tag : tags) {
    const Place place = place_of(tag.name);
    if (place.array.empty()) continue;
    const auto [found, fresh] = by_name_.try_emplace(place.array, arrays_.size());
    if (fresh) arrays_.push_back({place.array, 0, place.of_blocks, false});
    arrays_[found->second].of_blocks |= place.of_blocks;
    ++arrays_[found->second].values;
  }
  choose();
}

// Where the path of a function block ends that the element before `from` is or holds; 0: there is none.
std::size_t ArraySelection::end_of_block(std::string_view tag, std::size_t from) const {
  const std::size_t most = std::min(tag.find('[', from), tag.size());
  for (std::size_t at = from; at < most; ++at)
    if (tag[at] == '.' && blocks_.contains(tag.substr(0, at))) return at;
  return 0;
}

// A table in a block of an array is an array of its own.
ArraySelection::Place ArraySelection::place_of(std::string_view tag) const {
  Place place;
  for (std::size_t open = tag.find('['); open != std::string_view::npos;) {
    std::size_t end = open;  // behind the indices of every dimension
    while (end < tag.size() && tag[end] == '[') end = std::min(tag.find(']', end), tag.size() - 1) + 1;
    const std::size_t block = end_of_block(tag, end);
    if (block == 0) return {tag.substr(0, open), false};
    if (place.array.empty()) place = {tag.substr(0, open), true};
    open = tag.find('[', block);
  }
  return place;
}

void ArraySelection::choose() {
  std::vector<std::size_t> order(arrays_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return arrays_[i].values; });
  std::size_t values = 0;
  for (const std::size_t i : order) {
    Array& array = arrays_[i];
    if (!array.of_blocks && array.values > kMostOfATable) continue;
    values += array.values;
    array.shown = values <= kMostArrayValues;
  }
}

bool ArraySelection::shows(std::string_view tag) const {
  const auto found = by_name_.find(place_of(tag).array);
  return found == by_name_.end() || arrays_[found->second].shown;
}

std::vector<protocol::LeftOutArray> ArraySelection::left_out() const {
  std::vector<protocol::LeftOutArray> all;
  for (const Array& each : arrays_)
    if (!each.shown) all.push_back({std::string(each.name), each.values, each.of_blocks});
  return all;
}

}  // namespace stepwright::server
