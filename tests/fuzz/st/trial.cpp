#include "tests/fuzz/st/trial.h"

#include <bit>
#include <cmath>
#include <stdexcept>

#include "tests/fuzz/st/c_batch.h"
#include "tests/fuzz/st/engines.h"
#include "tests/fuzz/st/extras/ladder.h"
#include "tests/fuzz/st/generator.h"

namespace stepwright::st_fuzz {

namespace {

void set_inputs(Engines& engines, const Program& program, std::uint64_t scan) {
  for (std::size_t i = 0; i < program.inputs.size(); ++i) {
    const Variable& input = *program.inputs[i];
    const Scalar type = input.type->scalar;
    engines.set("main." + input.name, type, input_value(program.seed, scan, i, type));
  }
}

// The sign and the payload of a NaN are the machine's.
bool equal(Scalar type, std::uint64_t left, std::uint64_t right) {
  if (left == right) return true;
  if (type == Scalar::Lreal)
    return std::isnan(std::bit_cast<double>(left)) && std::isnan(std::bit_cast<double>(right));
  return type == Scalar::Real && std::isnan(std::bit_cast<float>(static_cast<std::uint32_t>(left))) &&
         std::isnan(std::bit_cast<float>(static_cast<std::uint32_t>(right)));
}

std::string shown(const Type& type, std::uint64_t bits) {
  const bool named = type.kind == TypeKind::Enumeration;
  const auto number = bits - static_cast<std::uint64_t>(type.low);
  return named && number >= type.enumerators.size() ? std::to_string(bits) : st_literal(type, bits);
}

class CTrial {
 public:
  CTrial(CBatch& batch, std::size_t index, const Program& program, const Dropped& dropped)
      : batch_(batch),
        index_(index),
        program_(program),
        leaves_(leaves_of(program)),
        engines_(write_st(program, dropped)) {}

  Outcome run() {
    Outcome out;
    compare(0);
    for (std::uint64_t scan = 1; scan <= kScans && out.trap == 0; ++scan) {
      set_inputs(engines_, program_, scan);
      // Whatever lies in the inputs now is what C gets.
      for (std::size_t i = 0; i < leaves_.size(); ++i)
        if (leaves_[i].path.starts_with("main.in")) batch_.set(index_, i, read(i));
      engines_.scan();
      const int trap = batch_.scan(index_);
      out.scans = scan;
      out.trap = static_cast<std::uint8_t>(engines_.trap().code);
      if (trap != out.trap)
        difference_ += "scan " + std::to_string(scan) + ": trap " + std::to_string(out.trap) + " (" +
                       (out.trap != 0 ? engines_.trap_place() : "none") + "), in C " + std::to_string(trap) +
                       "\n";
      compare(scan);
      if (!difference_.empty()) break;
    }
    out.difference = difference_;
    return out;
  }

 private:
  std::uint64_t read(std::size_t leaf) const {
    return engines_.get(leaves_[leaf].path, leaves_[leaf].type->scalar);
  }

  void compare(std::uint64_t scan) {
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      const Type& type = *leaves_[i].type;
      const std::uint64_t found = read(i);
      const std::uint64_t in_c = batch_.get(index_, i, type.scalar);
      if (equal(type.scalar, found, in_c)) continue;
      difference_ += "scan " + std::to_string(scan) + ": " + leaves_[i].path + " is " + shown(type, found) +
                     ", in C " + shown(type, in_c) + "\n";
    }
  }

  CBatch& batch_;
  std::size_t index_;
  const Program& program_;
  std::vector<Leaf> leaves_;
  Engines engines_;
  std::string difference_;
};

void try_drops(const Statements& statements, Dropped& dropped, const Program& program,
               Outcome (*attempt)(const Program&, const Dropped&), std::string& difference) {
  for (auto each = statements.rbegin(); each != statements.rend(); ++each) {
    Dropped fewer = dropped;
    fewer.insert(each->id);
    const Outcome outcome = attempt(program, fewer);
    if (!outcome.difference.empty()) {
      dropped = std::move(fewer);
      difference = outcome.difference;
      continue;
    }
    try_drops(each->body, dropped, program, attempt, difference);
    for (const Branch& branch : each->branches) try_drops(branch.body, dropped, program, attempt, difference);
  }
}

}  // namespace

Outcome try_engines(const Program& program, const Dropped& dropped) {
  Outcome out;
  try {
    const graphic::Project ladder = program.ladder ? random_ladder(program.seed) : graphic::Project{};
    Engines engines(write_st(program, dropped), program.ladder ? &ladder : nullptr);
    for (std::uint64_t scan = 1; scan <= kScans && out.trap == 0 && out.difference.empty(); ++scan) {
      set_inputs(engines, program, scan);
      out.difference = engines.scan();
      out.scans = scan;
      out.trap = static_cast<std::uint8_t>(engines.trap().code);
    }
  } catch (const std::runtime_error& error) {
    out.difference = error.what();
  }
  return out;
}

std::vector<Outcome> try_c(const std::vector<const Program*>& programs, const Dropped& dropped) {
  std::vector<Outcome> out(programs.size());
  CBatch batch(programs, dropped);
  for (std::size_t i = 0; i < programs.size(); ++i) {
    try {
      out[i] = CTrial(batch, i, *programs[i], dropped).run();
    } catch (const std::runtime_error& error) {
      out[i].difference = error.what();
    }
  }
  return out;
}

Outcome try_c_alone(const Program& program, const Dropped& dropped) {
  return try_c({&program}, dropped).front();
}

std::string reduced(const Program& program, Outcome (*attempt)(const Program&, const Dropped&)) {
  Dropped dropped;
  std::string difference = attempt(program, dropped).difference;
  for (const Pou& each : program.pous) {
    try_drops(each.body, dropped, program, attempt, difference);
    for (const Action& action : each.actions) try_drops(action.body, dropped, program, attempt, difference);
  }
  return "(*\n" + difference + "*)\n" + write_st(program, dropped);
}

}  // namespace stepwright::st_fuzz
