#pragma once

// A linear expression over measured fluents; everything that is not measured is folded into the constant.

#include <map>
#include <optional>
#include <string>

#include "supervisor/model/planned_run.h"
#include "supervisor/translate/binding.h"

namespace stepwright::translate {

struct LinearForm {
  std::map<std::string, double> coefficients;  // measured fluent -> factor, none of them 0
  double constant = 0.0;
};

// Nullopt if the expression is not linear in the measured fluents, divides by zero, or reads a fluent that
// neither a sensor nor `state` knows.
std::optional<LinearForm> linear_form(const model::Expression& expression, const Binding& binding,
                                      const model::NamedState& state);

// a - b
LinearForm difference(const LinearForm& a, const LinearForm& b);

}  // namespace stepwright::translate
