// Hierarchical addresses (IEC 61131-3, 6.5.5.2): %QW1.0.3. The standard leaves to the manufacturer what they
// mean. Here each gets the next free place of its size behind the flat addresses of its area, in the order of
// their numbers, so that equal programs have equal images; a bit takes a byte.

#include "ladder/semantics/analysis/hierarchical_address.h"

#include <algorithm>

namespace stepwright::semantics::internal {

std::uint32_t hierarchical_offset(Analysis& a, const syntax::DirectAddress& address, std::size_t size,
                                  Position where) {
  auto& known = a.model.hierarchical;
  const NameId text(address.byte - syntax::kHierarchical);
  std::size_t index = 0;
  while (index < known.size() && known[index].text != text) ++index;
  if (index == known.size()) {
    HierarchicalPlace place;
    place.address = *syntax::parse_hierarchical(a.names.folded(text));
    place.text = text;
    place.where = where;
    known.push_back(std::move(place));
    // Further ones would have no offsets.
    constexpr std::size_t kMost = (0x8000'0000u - kHierarchicalPlace) / kHierarchicalStride;
    if (index >= kMost) {
      a.error(code::kBadAddress, where, "there are too many hierarchical addresses");
      known.pop_back();
      index = 0;
    }
  }
  if (known[index].first.size() < size) known[index].first.resize(size);
  return kHierarchicalPlace + static_cast<std::uint32_t>(index) * kHierarchicalStride;
}

namespace {

void set_flat(const Model& model, Variable& variable) {
  if (!variable.address || variable.address->byte < syntax::kHierarchical || variable.type == nullptr) return;
  variable.address->byte = model.offset_in_area(variable.place.offset, variable.place.base);
}

}  // namespace

void place_hierarchical(Analysis& a) {
  std::vector<HierarchicalPlace*> order;
  for (HierarchicalPlace& each : a.model.hierarchical) order.push_back(&each);
  std::stable_sort(order.begin(), order.end(), [](const HierarchicalPlace* l, const HierarchicalPlace* r) {
    if (l->address.levels != r->address.levels) return l->address.levels < r->address.levels;
    return l->address.address.bits < r->address.address.bits;
  });
  for (HierarchicalPlace* each : order) {
    auto& area = a.model.area(static_cast<Base>(each->address.address.area));
    const std::size_t unit = std::max(1, each->address.address.bits / 8);
    const std::size_t start = (area.size() + unit - 1) / unit * unit;
    if (start + each->first.size() > syntax::kAreaLimit) {
      a.error(code::kBadAddress, each->where, "the area's 64 KiB are full");
      return;
    }
    each->start = static_cast<std::uint32_t>(start);
    area.resize(start);
    area.insert(area.end(), each->first.begin(), each->first.end());
  }
  for (Variable& each : a.model.globals) set_flat(a.model, each);
  for (Variable& each : a.model.configured) set_flat(a.model, each);
  for (const auto& pou : a.model.pous)
    for (Variable& each : pou->variables) set_flat(a.model, each);
}

}  // namespace stepwright::semantics::internal
