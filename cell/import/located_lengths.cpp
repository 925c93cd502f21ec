#include "cell/import/located_lengths.h"

#include <algorithm>
#include <optional>

#include "ladder/driver/compile.h"
#include "ladder/syntax/direct_address.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::cell_import {
namespace {

std::uint8_t bits_of(const std::string& address) {
  if (const auto flat = naming::parse_direct_address(address)) return flat->bits;
  const auto levels = syntax::parse_hierarchical(address);
  return levels ? levels->address.bits : 0;
}

class Lengths {
 public:
  Lengths(const graphic::Project& project, const source::Dialect& dialect) : dialect_(dialect) {
    probe_.types = project.types;
    keep_constants(project.globals);
    for (const graphic::Resource& resource : project.resources) keep_constants(resource.globals);
    graphic::Pou pou;
    pou.name = "StepwrightProbe";
    graphic::Variable located;
    located.name = "located";
    pou.variables = {located};
    pou.body = graphic::StBody{";"};
    probe_.pous = {pou};
  }

  // Of a variable of this type at an address of this size; nothing if it does not compile.
  std::optional<std::uint32_t> of(const std::string& type, std::uint8_t bits) {
    if (bits == 1) return 1;  // nothing else is at a bit
    const auto [at, is_new] = known_.try_emplace({naming::upper(type), bits});
    if (is_new) at->second = compiled(type, bits);
    return at->second;
  }

 private:
  // The bounds of an array may be some.
  void keep_constants(const std::vector<graphic::Variable>& variables) {
    std::ranges::copy_if(variables, std::back_inserter(probe_.globals),
                         [](const graphic::Variable& each) { return each.constant && each.address.empty(); });
  }

  std::optional<std::uint32_t> compiled(const std::string& type, std::uint8_t bits) {
    graphic::Variable& located = probe_.pous.front().variables.front();
    located.type = type;
    located.address = std::string("%Q") + (bits == 8 ? "B" : bits == 16 ? "W" : bits == 32 ? "D" : "L") + "0";
    driver::CompileInput input;
    input.projects = {&probe_};
    input.dialect = &dialect_;
    const auto output = driver::compile(input);
    if (!output) return std::nullopt;
    const auto info = reader::ProgramInfo::read(output->container);
    if (!info) return std::nullopt;
    return info->sizes().output_bytes * 8;
  }

  const source::Dialect& dialect_;
  graphic::Project probe_;
  std::map<std::pair<std::string, std::uint8_t>, std::optional<std::uint32_t>> known_;
};

}  // namespace

std::map<std::string, std::uint32_t> located_lengths(const graphic::Project& project,
                                                     const source::Dialect& dialect,
                                                     std::vector<std::string>& left) {
  Lengths lengths(project, dialect);
  std::map<std::string, std::uint32_t> longest;
  const auto take = [&](const std::string& of, const std::vector<graphic::Variable>& variables) {
    for (const graphic::Variable& each : variables) {
      const std::uint8_t bits = bits_of(each.address);
      if (bits == 0) continue;
      const auto length = lengths.of(each.type, bits);
      if (!length)
        left.push_back(of + each.name + " at " + each.address + ": how long a " + each.type +
                       " is is not known, so what is behind it may lie in it: `stepwright check` says where "
                       "(W0016)");
      std::uint32_t& known = longest[each.address];
      known = std::max(known, length.value_or(bits));
    }
  };
  take("", project.globals);
  for (const graphic::Resource& resource : project.resources) take("", resource.globals);
  for (const graphic::Pou& pou : project.pous) take(pou.name + ".", pou.variables);
  return longest;
}

}  // namespace stepwright::cell_import
