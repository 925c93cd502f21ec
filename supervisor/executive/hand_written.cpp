#include "supervisor/executive/hand_written.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "ladder/exchange/plcopen_reader.h"
#include "ladder/graphic/identifier.h"
#include "runtime/ground/files/files.h"

namespace stepwright::executive {
namespace {

using graphic::Project;

bool same(const std::string& a, const std::string& b) {
  return graphic::upper(a) == graphic::upper(b);
}

result::Location place_in(const Project& project, std::uint32_t where) {
  const std::string before = project.file_text.substr(0, where);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t begin = before.rfind('\n');
  const std::size_t column = begin == std::string::npos ? before.size() : before.size() - begin - 1;
  if (where == 0) return {project.file_name, 0, 0};
  return {project.file_name, static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(column) + 1};
}

class Joiner {
 public:
  explicit Joiner(const Project& generated) { joined_.generated = generated; }

  void add(const Project& written) {
    Project rest = written;
    add_instances(written);
    rest.tasks.clear();
    rest.instances.clear();
    std::vector<graphic::Variable> globals = std::move(rest.globals);
    for (graphic::Resource& resource : rest.resources)
      std::move(resource.globals.begin(), resource.globals.end(), std::back_inserter(globals));
    rest.resources.clear();
    rest.globals.clear();
    // All globals stand in the one configuration there is.
    for (graphic::Variable& global : globals) add_global(written, std::move(global));
    joined_.written.push_back(std::move(rest));
  }

  result::Result<JoinedPrograms> finish() {
    if (!problems_.empty()) return tl::unexpected(std::move(problems_));
    return std::move(joined_);
  }

 private:
  void problem(const Project& written, std::uint32_t where, std::string message, std::string hint) {
    problems_.push_back(
        {"X0006", result::Severity::Error, place_in(written, where), std::move(message), std::move(hint)});
  }

  void add_instances(const Project& written) {
    for (const graphic::ProgramInstance& instance : written.instances) {
      add_instance(written, instance.name, instance.program, instance.where);
    }
    for (const graphic::Pou& pou : written.pous) {
      if (pou.kind != graphic::PouKind::Program) continue;
      const bool named = std::any_of(written.instances.begin(), written.instances.end(),
                                     [&](const auto& each) { return same(each.program, pou.name); });
      if (!named) add_instance(written, pou.name, pou.name, pou.where);
    }
  }

  void add_instance(const Project& written, const std::string& name, const std::string& program,
                    std::uint32_t where) {
    std::vector<graphic::ProgramInstance>& instances = joined_.generated.instances;
    const bool taken = std::any_of(instances.begin(), instances.end(),
                                   [&](const auto& each) { return same(each.name, name); });
    if (taken) {
      return problem(written, where, "there is an instance '" + name + "' already",
                     "the planned chart and its sensors take 'planned' and 'sensing'");
    }
    instances.push_back({.name = name, .program = program, .task = joined_.generated.tasks.front().name});
  }

  void add_global(const Project& written, graphic::Variable global) {
    std::vector<graphic::Variable>& globals = joined_.generated.globals;
    const auto known = std::find_if(globals.begin(), globals.end(),
                                    [&](const auto& each) { return same(each.name, global.name); });
    if (known == globals.end()) {
      global.where = 0;  // it counts in another file
      global.list = 0;
      globals.push_back(std::move(global));
    } else if (!same(known->type, global.type) || !same(known->address, global.address)) {
      problem(written, global.where,
              "'" + global.name + "' is " + global.type + " at '" + global.address + "' here, but " +
                  known->type + " at '" + known->address + "' in the binding",
              "one variable has one place");
    }
  }

  JoinedPrograms joined_;
  result::Diagnostics problems_;
};

}  // namespace

std::vector<const graphic::Project*> JoinedPrograms::projects() const {
  std::vector<const graphic::Project*> all = {&generated};
  for (const graphic::Project& each : written) all.push_back(&each);
  return all;
}

result::Result<HandWritten> HandWritten::load(const std::vector<std::filesystem::path>& files,
                                              const source::Dialect& dialect) {
  HandWritten programs;
  result::Diagnostics problems;
  for (const std::filesystem::path& file : files) {
    const auto text = files::read_file(file.string());
    if (!text) {
      problems.insert(problems.end(), text.error().begin(), text.error().end());
      continue;
    }
    auto project = exchange::read_plcopen(file.string(), *text, dialect);
    if (!project) {
      std::move(project.error().begin(), project.error().end(), std::back_inserter(problems));
      continue;
    }
    const bool runs = std::any_of(project->pous.begin(), project->pous.end(),
                                  [](const auto& pou) { return pou.kind == graphic::PouKind::Program; });
    if (!runs) {
      problems.push_back({"X0007",
                          result::Severity::Error,
                          {file.string(), 0, 0},
                          "there is no program in this file",
                          "a POU with pouType=\"program\" runs behind the plan"});
    }
    programs.projects_.push_back(std::move(*project));
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return programs;
}

result::Result<JoinedPrograms> HandWritten::joined(const graphic::Project& generated) const {
  Joiner joiner(generated);
  for (const graphic::Project& written : projects_) joiner.add(written);
  return joiner.finish();
}

}  // namespace stepwright::executive
