#include "tests/bench/fleet/kept.h"

#include <iomanip>
#include <sstream>

namespace stepwright::bench::fleet {

namespace {

constexpr const char* kEnd = "end";  // of a line that was written whole

}  // namespace

Kept::Kept(const std::string& file) {
  if (file.empty()) return;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key, end;
    Measured measured;
    if (words >> key >> measured.ms >> measured.nodes >> measured.found >> measured.sound >> end &&
        end == kEnd)
      known_[key] = measured;
  }
  out_.open(file, std::ios::app);
  // The line before may have been cut short.
  if (!known_.empty()) out_ << "\n";
}

std::optional<Measured> Kept::find(const std::string& key) const {
  const auto found = known_.find(key);
  if (found == known_.end()) return std::nullopt;
  ++taken_;
  return found->second;
}

void Kept::add(const std::string& key, const Measured& measured) {
  if (!out_.is_open()) return;
  known_[key] = measured;
  out_ << key << ' ' << std::setprecision(17) << measured.ms << ' ' << measured.nodes << ' ' << measured.found
       << ' ' << measured.sound << ' ' << kEnd << std::endl;
}

}  // namespace stepwright::bench::fleet
