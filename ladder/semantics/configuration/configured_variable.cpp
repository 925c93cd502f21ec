// VAR_CONFIG: addresses and first values of single instances (IEC 61131-3, 6.8.1 and table 62).

#include <algorithm>
#include <utility>

#include "ladder/semantics/configuration/configurer.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::semantics::internal {

void Configurer::configure(const syntax::ConfiguredVariable& line) {
  const auto member = find_member(line);
  const Type* type = types_.resolve(*line.type);
  if (!member || type == nullptr || member->variable->type == nullptr) return;
  const Position where = line.path.back().where;
  if (type != member->variable->type) {
    a_.error(code::kTypeMismatch, line.type->where,
             quote(member->path) + " is " + member->variable->type->name + ", not " + type->name);
    return;
  }
  if (!line.address && !line.initial) {
    a_.error(code::kBadConnection, where, "the line gives neither an address nor a first value",
             "write path AT %IX0.0 : BOOL; or path : INT := 5;");
    return;
  }
  auto& data = a_.model.area(Base::Data);
  const bool referred = member->variable->is_referred();
  const std::uint32_t at = referred ? member->variable->first.offset
                                    : a_.model.instances[member->instance->index].offset + member->offset;
  if (data.size() < std::size_t{at} + type->size) return;
  std::vector<std::byte> first(data.begin() + at, data.begin() + at + type->size);
  ExpressionAnalyzer expressions(a_, nullptr);
  if (line.initial && !initialise(a_, expressions, *line.initial, *type, first)) return;
  if (!referred) {
    std::copy(first.begin(), first.end(), data.begin() + at);
    a_.note_references(*type, first, Base::Data, at, where);
  }
  if (line.address) give_address(line, *member, first);
}

// [resource.] program instance {. block} . variable
std::optional<Configurer::Member> Configurer::find_member(const syntax::ConfiguredVariable& line) {
  const auto& path = line.path;
  const auto unknown = [&](const syntax::Name& name, const std::string& where) {
    a_.error(code::kBadConnection, name.where, where + " has no " + quote(name.text),
             "a path is [resource.]program.block.variable, the program an instance of the configuration");
    return std::nullopt;
  };
  const auto& resources = configuration_.resources;
  const bool qualified =
      path.size() > 2 && std::any_of(resources.begin(), resources.end(), [&](const auto& each) {
        return naming::same_name(each.name.text, path[0].text);
      });
  const std::size_t first = qualified ? 1 : 0;
  Member member;
  for (Instance& each : instances_) {
    if (qualified && !naming::same_name(name_of(each), path[0].text)) continue;
    if (naming::same_name(a_.model.instances[each.index].name, path[first].text)) member.instance = &each;
  }
  const bool broken = std::ranges::any_of(resources, [&](const auto& resource) {
    return std::ranges::any_of(resource.programs,
                               [&](const auto& each) { return each.name.id == path[first].id; });
  });
  if (member.instance == nullptr && broken) return std::nullopt;  // it was reported
  if (member.instance == nullptr) return unknown(path[first], "the configuration");
  const ProgramInstance& instance = a_.model.instances[member.instance->index];
  const Pou* owner = instance.program;
  member.path = instance.name;
  for (std::size_t i = first + 1; i < path.size(); ++i) {
    if (owner == nullptr) return unknown(path[i], quote(member.path));
    const Variable* found = owner->find(path[i].id);
    const bool inside = found != nullptr && (found->place.base == Base::This || found->is_referred());
    if (!inside || found->section == Section::External) return unknown(path[i], quote(member.path));
    if (found->type == nullptr) return std::nullopt;
    member.variable = found;
    member.offset += found->place.offset;
    member.path += "." + found->spelling;
    owner = found->type->kind == TypeKind::Instance ? found->type->pou : nullptr;
  }
  if (member.variable == nullptr) return unknown(path[first], "a variable of the configuration");
  return member;
}

bool Configurer::give_address(const syntax::ConfiguredVariable& line, const Member& member,
                              std::span<const std::byte> first) {
  const Variable& declared = *member.variable;
  if (!declared.open_address || *declared.open_address != line.address->area) {
    a_.error(code::kAddressNotHere, line.address_where,
             declared.open_address ? quote(member.path) + " is declared at another area"
                                   : quote(member.path) + " is not declared with an open address",
             "declare it AT %I*, AT %Q* or AT %M*, and give it an address of that area");
    // What is wrong is not missing too.
    Place place;
    place.type = declared.type;
    member.instance->located.push_back({member.offset, std::move(place), true});
    return false;
  }
  syntax::VariableDeclaration whole;
  whole.names.push_back(line.path.back());
  whole.address = line.address;
  whole.address_where = line.address_where;
  Variable variable;
  variable.spelling = member.path;
  variable.where = line.path.back().where;
  variable.type = declared.type;
  variable.place.type = declared.type;
  variable.retain = declared.retain;
  if (!locate(a_, whole, variable, first)) return false;
  auto& located = member.instance->located;
  const bool twice = std::any_of(located.begin(), located.end(),
                                 [&](const Located& each) { return each.offset == member.offset; });
  if (twice) {
    a_.error(code::kDuplicate, variable.where, quote(member.path) + " has an address already");
    return false;
  }
  located.push_back({member.offset, copy_direct(variable.place), !declared.is_referred()});
  if (declared.is_referred())
    a_.model.references.push_back({Base::Data,
                                   a_.model.instances[member.instance->index].offset + member.offset,
                                   copy_direct(variable.place)});
  a_.model.configured.push_back(std::move(variable));
  return true;
}

// Every AT %I* of an instance that runs has got an address.
void Configurer::check_addresses(const Instance& instance, const Pou& pou, const std::string& path,
                                 std::uint32_t offset) {
  for (const Variable& each : pou.variables) {
    if (each.type == nullptr || (each.place.base != Base::This && !each.is_referred())) continue;
    const std::uint32_t at = offset + each.place.offset;
    const std::string name = path + "." + each.spelling;
    if (each.type->kind == TypeKind::Instance) {
      check_addresses(instance, *each.type->pou, name, at);
      continue;
    }
    const bool known = std::any_of(instance.located.begin(), instance.located.end(),
                                   [&](const Located& located) { return located.offset == at; });
    if (each.open_address && !known)
      a_.error(code::kMissingAddress, each.where, quote(name) + " has no address",
               "add VAR_CONFIG " + name + " AT %IX0.0 : BOOL; END_VAR to the configuration");
  }
}

}  // namespace stepwright::semantics::internal
