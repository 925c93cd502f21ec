#pragma once

// Declarations: types, variables with their memory and first values.

#include "ladder/semantics/expressions/expression_analyzer.h"

namespace stepwright::semantics::internal {

// Levels of arrays, structures and blocks in each other.
inline constexpr std::uint32_t kMaxTypeNesting = 150;

// Types by name and by shape; user types are made on demand, so that their order does not matter.
class TypeResolver {
 public:
  // `unit` must outlive the resolver.
  TypeResolver(Analysis& analysis, const syntax::Unit& unit);

  // Every type of the unit, and the names of enumeration values.
  void declare_all();
  // Null after a report. Instances of function blocks are types too.
  const Type* resolve(const syntax::TypeSpec& spec);
  // The same for a parameter, which may be an ARRAY[*].
  const Type* resolve_parameter(const syntax::TypeSpec& spec);
  // Whether the type is a function block or holds some. Makes no type.
  bool names_block(const syntax::TypeSpec& spec) const;
  // ANY_INT, which the library's texts may name (6.4.3).
  bool is_any_integer(const syntax::TypeSpec& spec) const;
  // Initial value of a variable of this declaration: TYPE may give one of its own.
  std::vector<std::byte> initial_of(const syntax::TypeSpec& spec, const Type& type);
  // Lays out the variables of a POU, before those that hold instances of it.
  void lay_out(Pou& pou);

  // Whether values of the type can be walked through; reports if they cannot.
  bool is_shallow(const Type& type, Position where);
  // Takes what the first values of types need in the compiler; false after a report.
  bool affords(std::size_t bytes, Position where);

 private:
  // One more type or block that is made because another one holds it; false after a report.
  bool enter(Position where);
  const Type* named(const syntax::Name& name);
  enum class State : std::uint8_t { Open, Running, Done };
  struct Known {
    const syntax::TypeDeclaration* declaration = nullptr;
    State state = State::Open;
    std::vector<std::byte> initial;
  };
  const Type* declared(Known& known);

  // derived_type.cpp
  const Type* array(const syntax::TypeSpec& spec);
  const Type* misplaced_open_array(const syntax::TypeSpec& spec);
  const Type* open_array(const syntax::TypeSpec& spec);
  const Type* structure(const syntax::TypeSpec& spec, Type& out);
  bool is_member_line(const syntax::VariableDeclaration& line, const Type& type);
  bool is_placed(const syntax::VariableDeclaration& line, const Type& type);
  bool share_soundly(const Type& structure, const std::vector<const syntax::VariableDeclaration*>& lines,
                     bool overlap);
  const Type* base_type(const syntax::Name& name, const char* what);
  const Type* enumeration(const syntax::TypeSpec& spec, std::string name);
  bool add_enumerator(Type& type, const syntax::Name& name, __int128 value);
  const Type* subrange(const syntax::TypeSpec& spec);
  const Type* text(const syntax::TypeSpec& spec);
  const Type* reference(const syntax::TypeSpec& spec);

  Analysis& a_;
  const syntax::Unit& unit_;
  std::unordered_map<std::uint32_t, Known> known_;
  std::unordered_map<std::uint32_t, State> layouts_;  // of POUs
  std::uint32_t nesting_ = 0;                         // of types and blocks that are being made
  std::size_t first_values_ = 0;                      // bytes
  Pou* scope_ = nullptr;  // whose variables are being laid out: bounds may name its constants
};

// Writes the value of an initialiser at `out`, which holds the type's own initial value. False after a
// report.
bool initialise(Analysis& analysis, ExpressionAnalyzer& expressions, const syntax::Expression& initial,
                const Type& type, std::span<std::byte> out);

// The bit of the byte becomes 1 unless `value` is 0.
void set_bit(std::byte& byte, std::uint8_t bit, std::byte value);

// Globals of the unit and of its configurations: the constant ones or the others. Appends to the model.
void declare_globals(Analysis& analysis, TypeResolver& types, const syntax::Unit& unit, bool constants);

// Two located variables that share bits, whatever POU or configuration declares them.
void check_overlaps(Analysis& analysis);

// Gives a variable an address of %I, %Q or %M, grows the area and writes the first value. False after a
// report.
bool locate(Analysis& analysis, const syntax::VariableDeclaration& line, Variable& variable,
            std::span<const std::byte> initial);

// AT %MW0 : INT; without a name.
void declare_direct(Analysis& analysis, TypeResolver& types, ExpressionAnalyzer& expressions,
                    const syntax::VariableDeclaration& line, const Type& type);

// Behind the analysis of all bodies: inputs in memory keep their value while the function changes what it was
// called with.
void protect_inputs(Analysis& analysis);

}  // namespace stepwright::semantics::internal
