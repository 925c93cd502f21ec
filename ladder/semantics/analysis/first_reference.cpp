// REF(x) as a first value (IEC 61131-3, 6.4.4.10.2). A first value is bytes, copied wherever a variable of
// its type lies: in an instance, an element of an array, a constant. A reference in them is the number of its
// target until they lie in an area, where it becomes an address.

#include <algorithm>
#include <utility>

#include "ladder/semantics/analysis/analysis.h"

namespace stepwright::semantics::internal {

namespace {

bool holds_reference(const Type& type) {
  switch (type.kind) {
    case TypeKind::Reference:
      return true;
    case TypeKind::Array:
      return holds_reference(*type.element);
    case TypeKind::Struct:
      return std::ranges::any_of(type.fields, [](const Field& each) { return holds_reference(*each.type); });
    case TypeKind::Instance:
      return std::ranges::any_of(type.pou->variables, [](const Variable& each) {
        return each.type != nullptr && each.place.base == Base::This && holds_reference(*each.type);
      });
    default:
      return false;
  }
}

// The references of a first value at its place.
class ReferenceFinder {
 public:
  ReferenceFinder(Analysis& a, std::span<const std::byte> bytes, Base base, std::uint32_t offset,
                  Position where)
      : a_(a), bytes_(bytes), base_(base), offset_(offset), where_(where) {}

  // `at`: of a value of the type, in the bytes.
  void find(const Type& type, std::uint32_t at) {
    switch (type.kind) {
      case TypeKind::Reference:
        return add(type, at);
      case TypeKind::Array:
        if (!holds_reference(*type.element)) return;
        for (std::uint32_t end = at + type.size; at < end; at += type.element->size) find(*type.element, at);
        return;
      case TypeKind::Struct:
        for (const Field& each : type.fields) find(*each.type, at + each.offset);
        return;
      case TypeKind::Instance:
        instances_.emplace_back(type.pou, at);
        for (const Variable& each : type.pou->variables)
          if (each.type != nullptr && each.place.base == Base::This) find(*each.type, at + each.place.offset);
        instances_.pop_back();
        return;
      default:
        return;
    }
  }

 private:
  void add(const Type& type, std::uint32_t at) {
    const FirstTarget* target = a_.first_target(semantics::load(type, bytes_.subspan(at, type.size)), type);
    if (target == nullptr) return;
    Place place;
    place.base = target->base;
    place.offset = target->offset;
    if (target->owner != nullptr) {
      const auto owner =
          std::ranges::find(instances_, target->owner, &std::pair<const Pou*, std::uint32_t>::first);
      if (owner == instances_.end()) {
        a_.error(code::kNotConstant, where_,
                 "a first value that is copied with every call cannot lead to a variable of the instance",
                 "assign the reference in the body");
        return;
      }
      place.base = base_;
      place.offset = offset_ + owner->second + target->offset;
    }
    a_.model.references.push_back({base_, offset_ + at, std::move(place)});
  }

  Analysis& a_;
  std::span<const std::byte> bytes_;
  Base base_;
  std::uint32_t offset_;
  Position where_;
  std::vector<std::pair<const Pou*, std::uint32_t>> instances_;  // around the value, with their offsets
};

}  // namespace

Constant Analysis::add_first_target(const Place& place, const Pou* pou) {
  FirstTarget target;
  target.base = place.base;
  target.offset = place.offset;
  if (place.base == Base::This) target.owner = pou;
  first_targets.push_back(target);
  return {static_cast<__int128>(first_targets.size())};
}

const FirstTarget* Analysis::first_target(const Constant& value, const Type& type) const {
  const bool known = type.is_reference() && value.integer > 0 &&
                     value.integer <= static_cast<__int128>(first_targets.size());
  return known ? &first_targets[static_cast<std::size_t>(value.integer) - 1] : nullptr;
}

void Analysis::note_references(const Type& type, std::span<const std::byte> bytes, Base base,
                               std::uint32_t offset, Position where) {
  if (first_targets.empty() || !holds_reference(type)) return;
  // A value that VAR_CONFIG gives takes the place of the one before.
  std::erase_if(model.references, [&](const FirstReference& each) {
    return each.base == base && each.offset >= offset && each.offset - offset < bytes.size();
  });
  ReferenceFinder(*this, bytes, base, offset, where).find(type, 0);
}

}  // namespace stepwright::semantics::internal
