#pragma once

// A construct of the language that random programs have as text only: both engines run it, C does not.
// Each has variables of its own in every POU, under names that nothing else has, and statements that mix
// them with the program's other variables.

#include <memory>
#include <string>
#include <vector>

#include "tests/fuzz/st/expression_generator.h"

namespace stepwright::st_fuzz {

// Source of random expressions and places of the POU that it stands in.
class Material {
 public:
  Material(Random& numbers, const Program& all, const Pou& own, const Scope& scope,
           ExpressionGenerator& expressions)
      : random(numbers), program(all), pou(own), scope_(scope), expressions_(expressions) {}

  // An expression of exactly this type that the compiler cannot compute.
  std::string value(Scalar type);
  // The same between two numbers, at most 97 times in 100 (integers).
  std::string between(Scalar type, std::int64_t low, std::int64_t high);
  // A variable of this type that may be written; empty if there is none.
  std::string target(Scalar type);
  // The same of a type of its own, without computed indexes, for VAR_IN_OUT and REF.
  std::string plain_target(Scalar type);
  std::string literal(Scalar type, std::int64_t low, std::int64_t high);
  std::string pick(const std::vector<std::string>& texts) { return random.pick(texts); }
  bool is_function() const { return pou.kind == PouKind::Function; }

  Random& random;
  const Program& program;
  const Pou& pou;

 private:
  const Scope& scope_;
  ExpressionGenerator& expressions_;
};

class Extra {
 public:
  virtual ~Extra() = default;
  virtual const char* name() const = 0;
  // Types, globals and POUs in front of the program's.
  virtual std::string before(Random&) const { return {}; }
  // "VAR ... END_VAR" of a POU.
  virtual std::string declarations(const Pou& pou, Random& random) const = 0;
  // A statement; empty if none fits here.
  virtual std::string statement(Material& material) const = 0;
};

using Extras = std::vector<std::unique_ptr<Extra>>;

std::unique_ptr<Extra> strings();
std::unique_ptr<Extra> wide_strings();
std::unique_ptr<Extra> string_conversions();
std::unique_ptr<Extra> characters();
std::unique_ptr<Extra> dates();
std::unique_ptr<Extra> references();
std::unique_ptr<Extra> open_arrays();
std::unique_ptr<Extra> standard_blocks();
std::unique_ptr<Extra> enables();
std::unique_ptr<Extra> globals();
std::unique_ptr<Extra> retained();
std::unique_ptr<Extra> bit_parts();
std::unique_ptr<Extra> instances();
std::unique_ptr<Extra> aliases();
std::unique_ptr<Extra> ladder();  // its programs need random_ladder of their seed (ladder.h)
inline constexpr const char* kLadderName = "ladder diagram";

// One of each.
Extras all_extras();

}  // namespace stepwright::st_fuzz
