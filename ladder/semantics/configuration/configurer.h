#pragma once

// A configuration: its tasks, the instances of programs with their connections and first values, and the
// addresses that VAR_CONFIG gives (IEC 61131-3, 6.8).
//
// An instance with connections, with VAR_CONFIG addresses or with a block of its own task is run by a small
// program of its own that copies what comes in, runs it, and copies what goes out: the body is shared by all
// instances and knows of none. An AT %I* is so a variable of the instance that holds the address; a bit
// has none, so that the instance holds its value: read before the program runs, written behind.

#include "ladder/semantics/configuration/configure.h"

namespace stepwright::semantics::internal {

class Configurer {
 public:
  // All must outlive the configurer.
  Configurer(Analysis& analysis, TypeResolver& types, const syntax::Configuration& configuration)
      : a_(analysis), types_(types), configuration_(configuration) {}

  void run();

  // Without a configuration: `program` runs every 10 ms.
  void run_only(const Pou& program);

 private:
  // A variable of an instance that VAR_CONFIG gives an address.
  struct Located {
    std::uint32_t offset = 0;  // in the instance of the program
    Place area;
    bool copied = false;  // a bit; else the instance holds the address
  };
  struct Instance {
    const syntax::ProgramDeclaration* declaration = nullptr;  // null without a configuration
    std::size_t resource = 0;                                 // index into configuration.resources
    std::size_t task = 0;
    std::size_t index = 0;  // into model.instances
    std::vector<Located> located;
  };
  // Indexes into model.tasks.
  struct TaskRange {
    std::size_t first = 0;
    std::size_t end = 0;
  };
  // Target of a path of VAR_CONFIG.
  struct Member {
    Instance* instance = nullptr;
    const Variable* variable = nullptr;
    std::uint32_t offset = 0;
    std::string path;
  };

  // The name of its resource.
  std::string_view name_of(const Instance& instance) const {
    return configuration_.resources[instance.resource].name.text;
  }

  // configurer.cpp
  void declare_task(const syntax::TaskDeclaration& declaration);
  // Reports the first one that is one too many.
  void add_task(Task task, Position where);
  void set_interval(const syntax::TaskDeclaration& declaration, Task& task);
  void set_trigger(const syntax::TaskDeclaration& declaration, Task& task);
  std::optional<Place> trigger_place(const syntax::Expression& source);
  std::optional<Place> program_output(const syntax::Expression& source);
  void check_clock() const;
  void qualify_tasks();

  // program_instance.cpp
  std::optional<std::size_t> find_task(const syntax::Name& name) const;
  std::size_t background_task(const syntax::Name& program);
  void declare_program(const syntax::ProgramDeclaration& declaration, std::size_t resource);
  Instance& add_instance(const std::string& name, const Pou& program, std::size_t task, Position where);
  void add_calls(Instance& instance);
  void add_block_call(const Instance& instance, const syntax::BlockTask& given);
  bool connect(const Instance& instance, Pou& runner, Statement& call);
  bool is_connectable(const syntax::Argument& argument) const;
  Pou& make_runner(const Instance& instance, std::string name, Position where);
  void copy_located(const Instance& instance, std::uint32_t from, std::uint32_t to, bool before, Pou& runner);

  // configured_variable.cpp
  void configure(const syntax::ConfiguredVariable& line);
  std::optional<Member> find_member(const syntax::ConfiguredVariable& line);
  bool give_address(const syntax::ConfiguredVariable& line, const Member& member,
                    std::span<const std::byte> first);
  void check_addresses(const Instance& instance, const Pou& pou, const std::string& path,
                       std::uint32_t offset);

  Analysis& a_;
  TypeResolver& types_;
  const syntax::Configuration& configuration_;
  std::vector<Instance> instances_;
  std::vector<TaskRange> tasks_;  // of each resource
  TaskRange resource_tasks_;      // of the resource that is being read
};

}  // namespace stepwright::semantics::internal
