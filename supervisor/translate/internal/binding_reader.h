#pragma once

// Reads the sections of a binding file into a Binding. Private to supervisor/translate.

#include <string>
#include <vector>

#include "supervisor/translate/internal/atom_reader.h"

namespace stepwright::translate::internal {

class BindingReader {
 public:
  // `vocabulary` may be null; it must outlive the reader.
  BindingReader(std::string file, const model::Vocabulary* vocabulary);

  // Reads every section once; problems collect in the document and in the reader.
  void read(const TomlTable& root);
  result::Diagnostics take_problems() { return atoms_.take_problems(); }
  Binding take_binding() { return std::move(binding_); }

 private:
  void read_tags(const TomlTable& tags);
  void read_sensors(const TomlTable& sensors);
  void read_facts(const TomlTable& root);
  void read_groups(const TomlTable& root);
  void read_action(const TomlTable& entry);
  void read_device(const TomlTable& entry);
  void read_believed(const TomlTable& root);
  void read_completion(const TomlTable& entry, ActionBinding& action);
  void read_transfers(const TomlTable& entry, ActionBinding& action);
  void read_duration(const TomlTable& entry, ActionBinding& action);
  void check_address(const TomlTable& table, const Tag& tag);
  void check_outputs(const TomlTable& entry, const ActionBinding& action);
  void check_names(const TomlTable& root);
  void check_every_action_is_bound(const TomlTable& root);

  Binding binding_;
  const model::Vocabulary* vocabulary_;
  AtomReader atoms_;
};

}  // namespace stepwright::translate::internal
