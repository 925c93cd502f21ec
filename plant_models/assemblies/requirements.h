#pragma once

// Collects what is wrong with the parameters of a plant, each as a C0321. NaN fails every requirement.
//
//   Requirements wanted;
//   wanted.positive(p.mass_kg, "mass_kg");
//   return wanted.finish();

#include <cmath>
#include <string>
#include <utility>

#include "runtime/ground/result/result.h"

namespace stepwright::assemblies {

class Requirements {
 public:
  void require(bool holds, std::string message, std::string hint = {}) {
    if (holds) return;
    wrong_.push_back({"C0321", result::Severity::Error, {}, std::move(message), std::move(hint)});
  }
  void positive(double value, const std::string& what) {
    require(std::isfinite(value) && value > 0.0, what + " must be positive");
  }
  void not_negative(double value, const std::string& what) {
    require(std::isfinite(value) && value >= 0.0, what + " must not be negative");
  }
  [[nodiscard]] result::Result<void> finish() {
    if (wrong_.empty()) return {};
    return tl::unexpected<result::Diagnostics>(std::move(wrong_));
  }

 private:
  result::Diagnostics wrong_;
};

}  // namespace stepwright::assemblies
