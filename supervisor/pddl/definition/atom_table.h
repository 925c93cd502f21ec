#pragma once

// Numbers for atoms in the order of their first use, found by hashing.
//
// Thread rule: a container like any other.
//
//   AtomTable table;
//   const int id = table.intern(symbol, objects);   // 0, then 1, ...

#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/pddl/definition/ast.h"

namespace stepwright::pddl {

class AtomTable {
 public:
  // The number of the atom; -1 if it has none.
  int find(int symbol, std::span<const int> objects) const;
  int find(const Atom& atom) const { return find(atom.symbol, atom.arguments); }

  // The number of the atom, given now if it has none.
  int intern(int symbol, std::span<const int> objects);
  int intern(const Atom& atom) { return intern(atom.symbol, atom.arguments); }

  std::size_t size() const { return atoms_.size(); }
  const std::vector<Atom>& atoms() const { return atoms_; }

 private:
  std::size_t place(int symbol, std::span<const int> objects) const;
  void grow();

  std::vector<Atom> atoms_;
  std::vector<int> places_;  // open addressing: number + 1, 0 = free; a power of two
};

// A hash of a symbol and objects; also for keys of other tables.
std::uint64_t hash_objects(std::uint64_t seed, std::span<const int> objects);

}  // namespace stepwright::pddl
