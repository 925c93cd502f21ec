// Types by shape (IEC 61131-3, 6.4.4).

#include <algorithm>
#include <utility>

#include "ladder/semantics/declarations/declarer.h"

namespace stepwright::semantics::internal {

const Type* TypeResolver::array(const syntax::TypeSpec& spec) {
  const Type* element = resolve(*spec.element);
  ExpressionAnalyzer expressions(a_, scope_);
  std::vector<Dimension> dimensions;
  std::uint64_t size = element != nullptr ? element->size : 1;
  bool sound = element != nullptr;
  for (const syntax::ArrayRange& each : spec.ranges) {
    if (!each.low) return misplaced_open_array(spec);
    const auto low = expressions.constant_integer(*each.low);
    const auto high = expressions.constant_integer(*each.high);
    if (!low || !high) {
      sound = false;
      continue;
    }
    constexpr std::int64_t kBound = 1LL << 30;
    if (*high < *low || *low < -kBound || *high > kBound) {
      a_.error(code::kBadArrayBounds, each.low->where,
               "the bounds " + std::to_string(*low) + ".." + std::to_string(*high) +
                   (*high < *low ? " hold no element" : " reach beyond -1073741824..1073741824"),
               "the lower bound comes first");
      return nullptr;
    }
    dimensions.push_back({static_cast<std::int32_t>(*low), static_cast<std::int32_t>(*high)});
    size *= dimensions.back().count();
    if (size > kMaxData) {
      a_.error(code::kTooLarge, spec.where, "the array is larger than 32 MiB");
      return nullptr;
    }
  }
  if (!sound || (!element->initial.empty() && !affords(size, spec.where))) return nullptr;
  const Type* type = a_.type_table().array(element, std::move(dimensions));
  return is_shallow(*type, spec.where) ? type : nullptr;
}

const Type* TypeResolver::misplaced_open_array(const syntax::TypeSpec& spec) {
  a_.error(code::kBadSection, spec.where,
           "ARRAY[*] can only be the type of a VAR_IN_OUT, or of a VAR_INPUT of a function",
           "give the bounds, as in ARRAY[1..10]");
  return nullptr;
}

const Type* TypeResolver::open_array(const syntax::TypeSpec& spec) {
  for (const syntax::ArrayRange& each : spec.ranges) {
    if (!each.low) continue;
    a_.error(code::kBadArrayBounds, each.low->where, "either all bounds of an array are '*' or none");
    return nullptr;
  }
  const Type* element = resolve(*spec.element);
  return element != nullptr ? a_.type_table().open_array(element, spec.ranges.size()) : nullptr;
}

// The base of an enumeration or a subrange; null after a report.
const Type* TypeResolver::base_type(const syntax::Name& name, const char* what) {
  const Type* base = named(name);
  if (base == nullptr) return nullptr;
  if (base->kind == TypeKind::Elementary && (base->is_integer() || base->is_bits())) return base;
  a_.error(code::kTypeMismatch, name.where, std::string(what) + " needs an integer type, not " + base->name);
  return nullptr;
}

const Type* TypeResolver::enumeration(const syntax::TypeSpec& spec, std::string name) {
  const Type* base = spec.name.text.empty() ? a_.type_table().elementary(ElementaryType::Int)
                                            : base_type(spec.name, "an enumeration");
  if (base == nullptr) return nullptr;
  Type* type = a_.type_table().create(TypeKind::Enumeration, std::move(name));
  type->elementary = base->elementary;
  type->base = base;
  type->size = base->size;
  ExpressionAnalyzer expressions(a_, scope_);
  Constant next;
  for (const syntax::Enumerator& each : spec.enumerators) {
    if (each.value) {
      const Type* const outer = std::exchange(a_.numbered, type);
      const auto value = expressions.constant(*each.value, base);
      a_.numbered = outer;
      if (!value) return nullptr;
      next = *value;
    }
    if (!add_enumerator(*type, each.name, next.integer)) return nullptr;
    ++next.integer;
  }
  type->initial.resize(type->size);
  store({type->enumerators.front().value}, *type, type->initial);
  return type;
}

// Viewers keep the values of enumerators in 32 bits.
bool TypeResolver::add_enumerator(Type& type, const syntax::Name& name, __int128 value) {
  const IntegerRange range = range_of(type.elementary);
  const __int128 low = std::max(range.low, range_of(ElementaryType::Dint).low);
  const __int128 high =
      std::min(range.high, range_of(type.is_unsigned() ? ElementaryType::Udint : ElementaryType::Dint).high);
  if (value < low || value > high) {
    a_.error(code::kOutOfRange, name.where,
             "the value " + to_string(value) + " of " + quote(name.text) + " is out of range",
             "it goes from " + to_string(low) + " to " + to_string(high) + " here");
    return false;
  }
  const auto stored = static_cast<std::int64_t>(value);
  if (!type.add(Enumerator{name.id, std::string(name.text), stored}))
    a_.error(code::kDuplicate, name.where, "there is another value " + quote(name.text));
  const auto [known, is_new] = a_.enum_values.try_emplace(name.id.value, EnumValue{&type, stored});
  if (!is_new) known->second.type = nullptr;
  return true;
}

const Type* TypeResolver::subrange(const syntax::TypeSpec& spec) {
  const Type* base = base_type(spec.name, "a subrange");
  if (base == nullptr) return nullptr;
  if (!base->is_integer()) {
    a_.error(code::kTypeMismatch, spec.where, "a subrange needs an integer type, not " + base->name);
    return nullptr;
  }
  ExpressionAnalyzer expressions(a_, scope_);
  const auto low = expressions.constant(*spec.ranges.front().low, base);
  const auto high = expressions.constant(*spec.ranges.front().high, base);
  if (!low || !high) return nullptr;
  if (high->integer < low->integer) {
    a_.error(code::kOutOfRange, spec.ranges.front().low->where, "the range is empty",
             "the lower value comes first");
    return nullptr;
  }
  return a_.type_table().subrange(base, {low->integer, high->integer});
}

const Type* TypeResolver::text(const syntax::TypeSpec& spec) {
  ExpressionAnalyzer expressions(a_, scope_);
  const auto length = expressions.constant_integer(*spec.length);
  if (!length) return nullptr;
  constexpr std::int64_t kMost = bytecode::kMaxStringCapacity;
  if (*length < 1 || *length > kMost) {
    a_.error(
        code::kOutOfRange, spec.length->where,
        "a string holds from 1 to " + std::to_string(kMost) + " characters, not " + std::to_string(*length));
    return nullptr;
  }
  const bool wide = a_.names.folded(spec.name.id) == "WSTRING";
  return a_.type_table().string(wide ? ElementaryType::Wstring : ElementaryType::String,
                                static_cast<std::uint32_t>(*length));
}

// What a reference leads to may be incomplete: a structure or block that holds references to its own kind.
const Type* TypeResolver::reference(const syntax::TypeSpec& spec) {
  const syntax::TypeSpec& target = *spec.element;
  const Type* type = nullptr;
  if (target.kind == syntax::TypeKind::Named) {
    const auto known = known_.find(target.name.id.value);
    const auto pou = a_.pous.find(target.name.id.value);
    if (known != known_.end() && known->second.state == State::Running) {
      const auto made = a_.types.find(target.name.id.value);
      if (made != a_.types.end()) type = made->second;
    } else if (pou != a_.pous.end() && pou->second->kind == PouKind::FunctionBlock) {
      type = pou->second->type;
    }
  }
  if (type == nullptr) type = resolve(target);
  return type != nullptr ? a_.type_table().reference(type) : nullptr;
}

}  // namespace stepwright::semantics::internal
