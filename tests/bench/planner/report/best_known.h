#pragma once

// The best costs known of the instances, in a file beside the generators. Entries come from validated plans
// and from bounds that a search or a generator proved, never from hopes; an entry holds for the exact texts
// it was found with.
//
// Thread rule: one thread.

#include <map>
#include <optional>
#include <string>

#include "runtime/ground/result/result.h"
#include "tests/bench/planner/generators/instance.h"

namespace stepwright::bench {

struct Known {
  double cost = 0.0;
  double bound = 0.0;    // no plan costs less
  std::string found_by;  // "planner", "generator", the name of an outside planner
  bool proved() const { return bound >= cost - 1e-6; }
};

class BestKnown {
 public:
  // An absent file is an empty one; a broken one fails.
  static result::Result<BestKnown> load(const std::string& path);

  // Nothing if nothing is known of these texts.
  std::optional<Known> find(const Instance& instance) const;

  // Takes what is better: the lower cost, the higher bound.
  void offer(const Instance& instance, double cost, double bound, const std::string& found_by);

  bool save(const std::string& path) const;

 private:
  struct Entry {
    std::string digest;
    Known known;
  };
  std::map<std::string, Entry> entries_;  // by name of the instance
};

}  // namespace stepwright::bench
