#pragma once

// Kept measurements of a slow baseline, line by line in a file, so that a run of hours can be ended and begun
// again: what is there is not measured a second time.
//
// One thread at a time, one process for one file. A line belongs to a solver, an instance (by a hash of its
// text), a cap and a clock; a line cut short by an end in its midst is measured again.
//
//   Kept kept("literal.txt");
//   if (const auto before = kept.find(key)) return *before;
//   kept.add(key, measured);

#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <string>

namespace stepwright::bench::fleet {

struct Measured {
  double ms = 0.0;
  std::uint64_t nodes = 0;
  std::string found;  // "schedule", "none" or "timeout"
  bool sound = true;  // the checker found nothing in its schedule

  friend bool operator==(const Measured&, const Measured&) = default;
};

class Kept {
 public:
  // Nothing is kept where the name is empty.
  explicit Kept(const std::string& file);

  std::optional<Measured> find(const std::string& key) const;
  void add(const std::string& key, const Measured& measured);
  // Of what find() has answered.
  std::size_t taken() const { return taken_; }

 private:
  std::map<std::string, Measured> known_;
  std::ofstream out_;
  mutable std::size_t taken_ = 0;
};

}  // namespace stepwright::bench::fleet
