#pragma once

// Names and values of a program as people write them, as requests to a runtime and out of its answers. Here
// alone a name becomes a place of a program, a text a value, and what is forced a name and a text again: for
// the page, for `stepwright force`, and for whoever else goes by names.
//
//   const ProgramNames names(digest, info);
//   auto valve = names.value("MAIN.valve", "true");      // or R0057, R0058
//   client.ask(Force{{valve->bits, 60'000}});            // says by itself of which program it is
//   auto batch = names.written("MAIN.batch", "B 17");    // also of strings
//   client.ask(WriteBlock{batch->block});
//   print(valve->name, valve->text);                     // MAIN.valve TRUE, as the program spells them
//
// Pure; any thread.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/result.h"
#include "runtime/host/messages.h"
#include "runtime/image/force_table.h"

namespace stepwright::service {

struct NamedBits {
  std::string name;  // as the program spells it; a direct address as it was given
  host::ProgramBits bits;
  std::string text;  // the value as the program spells it; empty: there is none
};

// A value of any length, as the parts of one write.
struct NamedWrite {
  std::string name;
  host::BlockWrite block;
  std::string text;
};

struct ForcedValue {
  std::string name;
  reader::Variable variable;
  std::vector<std::byte> image;  // with nothing but the forced value in it
  bool ends = false;             // by itself

  std::string text() const;
};

class ProgramNames {
 public:
  // Of the program with that digest; both outlive it.
  ProgramNames(const std::string& digest, const reader::ProgramInfo& info) : digest_(digest), info_(info) {}

  // To be forced: no string.
  [[nodiscard]] result::Result<NamedBits> value(std::string_view name, std::string_view text) const;
  // To be written.
  [[nodiscard]] result::Result<NamedWrite> written(std::string_view name, std::string_view text) const;
  // To be released.
  [[nodiscard]] result::Result<NamedBits> forceable(std::string_view name) const;
  // Requires an image of this program.
  [[nodiscard]] result::Result<std::string> read(std::string_view name,
                                                 std::span<const std::byte> image) const;

  ForcedValue forced(const image::Force& force) const;
  // What `forced` would say if that value were forced for a time.
  [[nodiscard]] result::Result<ForcedValue> as_forced(std::string_view name, std::string_view text) const;

 private:
  const std::string& digest_;
  const reader::ProgramInfo& info_;
};

}  // namespace stepwright::service
