#include "supervisor/pddl/definition/atom_table.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

constexpr std::size_t kFirstPlaces = 64;

}  // namespace

std::uint64_t hash_objects(std::uint64_t seed, std::span<const int> objects) {
  std::uint64_t hash = (seed + 1) * 0x9E3779B97F4A7C15u;
  for (const int object : objects) {
    hash = (hash ^ static_cast<std::uint32_t>(object)) * 0xD6E8FEB86659FD93u;
    hash ^= hash >> 32;
  }
  return hash;
}

// Where the atom is or would go.
std::size_t AtomTable::place(int symbol, std::span<const int> objects) const {
  const std::size_t mask = places_.size() - 1;
  std::size_t at = hash_objects(static_cast<std::uint64_t>(symbol), objects) & mask;
  for (; places_[at] != 0; at = (at + 1) & mask) {
    const Atom& atom = atoms_[static_cast<std::size_t>(places_[at] - 1)];
    if (atom.symbol == symbol &&
        std::equal(objects.begin(), objects.end(), atom.arguments.begin(), atom.arguments.end())) {
      break;
    }
  }
  return at;
}

void AtomTable::grow() {
  places_.assign(std::max(kFirstPlaces, 2 * places_.size()), 0);
  for (std::size_t i = 0; i < atoms_.size(); ++i) {
    places_[place(atoms_[i].symbol, atoms_[i].arguments)] = static_cast<int>(i) + 1;
  }
}

int AtomTable::find(int symbol, std::span<const int> objects) const {
  return places_.empty() ? -1 : places_[place(symbol, objects)] - 1;
}

int AtomTable::intern(int symbol, std::span<const int> objects) {
  if (2 * (atoms_.size() + 1) > places_.size()) grow();
  int& number = places_[place(symbol, objects)];
  if (number == 0) {
    atoms_.push_back({symbol, {objects.begin(), objects.end()}});
    number = static_cast<int>(atoms_.size());
  }
  return number - 1;
}

}  // namespace stepwright::pddl
