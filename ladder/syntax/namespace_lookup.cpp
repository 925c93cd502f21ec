#include "ladder/syntax/namespace_lookup.h"

namespace stepwright::syntax {

namespace {

std::string_view last_name(std::string_view full) {
  const std::size_t dot = full.rfind('.');
  return dot == std::string_view::npos ? full : full.substr(dot + 1);
}

}  // namespace

NamespaceLookup::NamespaceLookup(const source::NameTable& names, const Unit& unit) : names_(names) {
  const auto declare = [&](source::NameId id) {
    const std::string_view full = names.folded(id);
    const std::string_view last = last_name(full);
    if (declared_.insert(id.value).second && last.size() < full.size()) by_last_name_.emplace(last, id);
  };
  for (const TypeDeclaration& each : unit.types) declare(each.name.id);
  for (const PouDeclaration& each : unit.pous) declare(each.name.id);
  for (const NamespacePart& each : unit.namespaces) {
    if (each.is_namespace) spaces_.insert(each.name.id.value);
    if (each.internal_to) internal_.emplace(each.name.id.value, &each);
  }
  for (const NameScope& each : unit.scopes)
    for (const Name& used : each.used) used_[&each].insert(used.id.value);
}

std::optional<source::NameId> NamespaceLookup::declared(const std::string& name) const {
  const auto id = names_.find(name);
  return id && declared_.contains(id->value) ? id : std::nullopt;
}

std::optional<NamespaceLookup::Found> NamespaceLookup::find(const std::string& name,
                                                            const NameScope* scope) const {
  for (const NameScope* each = scope; each != nullptr; each = each->outer) {
    if (!each->space) continue;
    if (const auto id = declared(names_.folded(*each->space) + "." + name)) return Found{*id};
  }
  if (const auto id = declared(name)) return Found{*id};
  return find_used(name, scope);
}

// Of several, one that can be used goes first.
std::optional<NamespaceLookup::Found> NamespaceLookup::find_used(const std::string& name,
                                                                 const NameScope* scope) const {
  std::optional<Found> found;
  bool is_barred = false;
  const auto [begin, end] = by_last_name_.equal_range(last_name(name));
  for (auto each = begin; each != end; ++each) {
    const std::string_view full = names_.folded(each->second);
    if (full.size() < name.size() + 2 || !full.ends_with("." + name)) continue;
    if (!is_used(full.substr(0, full.size() - name.size() - 1), scope)) continue;
    const bool barred = barrier(each->second, scope).has_value();
    if (found && barred == is_barred) found->several = true;
    if (found && (barred || !is_barred)) continue;
    found = Found{each->second};
    is_barred = barred;
  }
  return found;
}

bool NamespaceLookup::is_used(std::string_view space, const NameScope* scope) const {
  const auto id = names_.find(space);
  for (const NameScope* each = scope; id && each != nullptr; each = each->outer) {
    const auto used = used_.find(each);
    if (used != used_.end() && used->second.contains(id->value)) return true;
  }
  return false;
}

std::optional<NamespaceLookup::Barrier> NamespaceLookup::barrier(source::NameId id,
                                                                 const NameScope* scope) const {
  if (internal_.empty()) return std::nullopt;
  const auto is_around = [&](source::NameId space) {
    for (const NameScope* each = scope; each != nullptr; each = each->outer)
      if (each->space == space) return true;
    return false;
  };
  std::string_view part = names_.folded(id);
  while (true) {
    const auto known = names_.find(part);
    const auto internal = known ? internal_.find(known->value) : internal_.end();
    if (internal != internal_.end() && !is_around(*internal->second->internal_to)) {
      const std::string_view text = internal->second->name.text;
      return Barrier{text, text.substr(0, text.rfind('.'))};
    }
    const std::size_t dot = part.rfind('.');
    if (dot == std::string_view::npos) return std::nullopt;
    part = part.substr(0, dot);
  }
}

}  // namespace stepwright::syntax
