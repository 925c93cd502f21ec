#pragma once

// Tells whoever has started a demonstration how to act on its page: the set-up token, which the page's server
// writes to its log and nobody would look for there.
//
//   SetupTokenPrinter printer(state_dir / "hmi.log");   // before the server is started
//   while (running) printer.look();
//
// Threads: one thread uses an object. A file that is not there yet is an empty one.

#include <cstdint>
#include <filesystem>

namespace stepwright::demo {

class SetupTokenPrinter {
 public:
  // The present content of the log is of earlier runs and is skipped.
  explicit SetupTokenPrinter(std::filesystem::path log);

  // Prints each token that is new in the log, on a line of its own. Cheap where nothing is new.
  void look();

 private:
  std::filesystem::path log_;
  std::uintmax_t told_ = 0;  // bytes of whole lines that were looked at
};

}  // namespace stepwright::demo
