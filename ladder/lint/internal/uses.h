#pragma once

// Uses of a program's variables: filled by the walk over the bodies, read by the rules. One thread; model and
// unit outlive it.

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "ladder/semantics/model/model.h"

namespace stepwright::lint::internal {

using source::NameId;
using source::Position;

// A place that writes an output, a located variable or the BOOL of a coil.
struct WriteSite {
  const semantics::Pou* pou = nullptr;
  Position where;
  bool keeps = false;  // sets or resets: other places may write too
  bool coil = false;   // of a ladder diagram
};

struct VariableUse {
  const semantics::Variable* variable = nullptr;
  bool initialised = false;  // explicitly, where it is declared
  bool generated = false;
  bool named = false;
  bool referred = false;  // REF gives it away: who holds the reference may read and write it
  std::uint32_t reads = 0;
  std::uint32_t writes = 0;
  Position first_read = {};
  std::uint64_t last_write = 0;  // number of the write; they are counted through the program
  Position last_write_where = {};
  // Read before anything was written to it, in the loop with this number: a later write of the loop excuses
  // it.
  std::optional<std::uint32_t> doubtful_loop = {};
  Position doubtful_where = {};
  std::vector<WriteSite> sites = {};
};

// A directly represented variable: area, first bit, number of bits.
using BitRange = std::tuple<std::uint8_t, std::uint32_t, std::uint32_t>;

struct DirectUse {
  std::string text;
  std::vector<WriteSite> sites;
};

struct Uses {
  Uses(const semantics::Model& model, const syntax::Unit& unit, std::size_t user_pous);

  // The variable that a name means inside of a POU; null if it is none. A VAR_EXTERNAL means its global.
  VariableUse* find(std::size_t pou, NameId name);

  const semantics::Model& model;
  const syntax::Unit& unit;
  std::size_t user_pous;
  std::vector<std::vector<VariableUse>> of_pous;  // as Model::pous and Pou::variables
  std::vector<VariableUse> of_globals;
  std::unordered_map<std::uint32_t, std::size_t> global_index;  // NameId -> index
  std::unordered_map<std::uint32_t, std::size_t> pou_index;
  std::map<BitRange, DirectUse> directs;
  std::vector<bool> has_side_effects;  // of POUs: they write to more than their own variables
  // Calls of functions whose result is dropped.
  std::vector<std::pair<Position, const semantics::Pou*>> dropped;
};

// The bits of %I, %Q or %M that a variable with an address occupies.
BitRange range_of(const semantics::Variable& variable);
BitRange range_of(const syntax::DirectAddress& address);

// Marks the names that declarations use: constants in bounds, lengths and first values, variables in REF.
void name_declarations(Uses& uses);

// REF(x): the x; null for any other expression.
const syntax::Expression* referred_by(const syntax::Expression& call);

std::string quote(std::string_view name);

}  // namespace stepwright::lint::internal
