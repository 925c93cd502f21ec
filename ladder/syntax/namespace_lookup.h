#pragma once

// Lookup of names through namespaces (namespaces.h): what one means where it stands. Reports nothing.
//
// Not thread-safe; the unit and the names must outlive it, and what is declared later is not known to it.
//
//   NamespaceLookup lookup(names, unit);
//   lookup.find("TWICE", pou.scope)   ->  PLANT.TWICE

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "ladder/syntax/declaration.h"

namespace stepwright::syntax {

class NamespaceLookup {
 public:
  NamespaceLookup(const source::NameTable& names, const Unit& unit);

  struct Found {
    source::NameId id;
    bool several = false;  // others of the namespaces that are used have the name, too
  };
  // The type or POU that `name`, in upper case, means in a scope. Nothing if no declaration has it.
  std::optional<Found> find(const std::string& name, const NameScope* scope) const;

  // Barrier for a scope outside of it: the part of the name that is INTERNAL, and its namespace.
  struct Barrier {
    std::string_view part;
    std::string_view owner;
  };
  std::optional<Barrier> barrier(source::NameId id, const NameScope* scope) const;

  bool is_namespace(source::NameId id) const { return spaces_.contains(id.value); }

 private:
  std::optional<source::NameId> declared(const std::string& name) const;
  std::optional<Found> find_used(const std::string& name, const NameScope* scope) const;
  bool is_used(std::string_view space, const NameScope* scope) const;

  const source::NameTable& names_;
  std::unordered_set<std::uint32_t> declared_;  // NameIds of types and POUs
  std::unordered_set<std::uint32_t> spaces_;
  std::unordered_map<std::uint32_t, const NamespacePart*> internal_;
  std::unordered_multimap<std::string_view, source::NameId> by_last_name_;  // of what is in a namespace
  std::unordered_map<const NameScope*, std::unordered_set<std::uint32_t>> used_;
};

}  // namespace stepwright::syntax
