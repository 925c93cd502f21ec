#pragma once

// An independent reference interpreter of sequential function charts: the token game and the action control
// of IEC 61131-3 written down as history formulas ("active since", "set since"), without rungs. Tests compare
// it with lowered charts.

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "ladder/graphic/sfc_chart.h"

namespace stepwright::support {

class SfcReference {
 public:
  // `input` gives the value of an input variable by name.
  using Input = std::function<std::int64_t(const std::string&)>;

  explicit SfcReference(const graphic::SfcChart& chart);

  void scan(std::int64_t now_ns, const Input& input);

  bool active(std::size_t step) const { return active_[step]; }
  // Value of an action's Q after the scan; by name of the target.
  bool action(const std::string& target) const { return actions_.at(target); }
  // Whether an action's body ran in the scan: with final scan once more after its Q fell, and for P1 and P0
  // without its Q.
  bool runs(const std::string& target) const { return runs_.at(target); }
  // Value of a BOOL variable with S and R blocks only, else the same as action().
  bool variable(const std::string& target) const { return variables_.at(target); }

 private:
  struct Association {
    std::size_t step;
    graphic::ActionBlock block;
    bool stored = false;
    std::int64_t stored_since = 0;
  };

  void evolve(std::int64_t now_ns, const Input& input);
  bool test(const graphic::Condition& condition, std::int64_t now_ns, const Input& input) const;
  std::int64_t value(const std::string& text, std::int64_t now_ns, const Input& input) const;
  bool has_body(const std::string& target) const;
  bool contributes(Association& association, std::int64_t now_ns, bool reset);

  const graphic::SfcChart& chart_;
  bool first_ = true;
  std::vector<bool> active_;
  std::vector<bool> before_;
  std::vector<std::int64_t> flag_since_;    // when X rose
  std::vector<std::int64_t> entered_;       // when the step was entered, also by a transition from itself
  std::vector<std::int64_t> last_elapsed_;  // T of a step that is not active
  std::map<std::string, std::vector<Association>> associations_;
  std::map<std::string, bool> set_;
  std::map<std::string, bool> actions_;
  std::map<std::string, bool> runs_;
  std::map<std::string, bool> variables_;
};

}  // namespace stepwright::support
