#pragma once

// Limits of a container: what it has no room for is told at its place in the source, before or instead of the
// verifier's refusal; texts that only viewers read become UTF-8 and are cut to the room there is.
// ladder/doc/language.md lists the limits. Internal to this folder; one object per program, one thread.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ladder/semantics/model/model.h"
#include "ladder/source/source_set.h"
#include "runtime/bytecode/container_format.h"
#include "runtime/bytecode/writer/container_writer.h"
#include "runtime/ground/result/result.h"

namespace stepwright::codegen {

class ContainerLimits {
 public:
  // `sources` must outlive it.
  explicit ContainerLimits(const source::SourceSet& sources) : sources_(sources) {}

  // `where`: the variable or the statement that is one too many for the function.
  void too_many_locals(const semantics::Pou& pou, source::Position where);
  // Of a chart, or of a variable with an address of its own, through the instances to it.
  void check_path(std::string_view path, source::Position where);
  // The refusal of a container that is too large; any other one as it is. `functions`: as in `out`.
  result::Diagnostics explained(writer::Refusal refusal, const writer::ContainerModel& out,
                                const std::vector<const semantics::Pou*>& functions) const;

  // A name that is no name of the program: that of a type or a file.
  static std::string name(std::string name, std::size_t most = bytecode::kMaxStringBytes);
  // A condition or a comment.
  std::string text(std::string text);

  result::Diagnostics& errors() { return errors_; }

 private:
  result::Diagnostic too_large(source::Position where, std::string message, std::string hint) const;

  const source::SourceSet& sources_;
  result::Diagnostics errors_;
  std::uint64_t long_texts_ = 0;  // bytes
};

}  // namespace stepwright::codegen
