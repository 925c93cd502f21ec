#pragma once

// An array variable of FMI 3.0 (2.4.7.4) as variables of one number each, named as Modelica does: "u[2]",
// "A[1,3]". The indices begin with 1, the last one runs fastest.
//
// Thread-safe: pure.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "plant_models/fmu/model_description.h"

namespace stepwright::fmu {

// How many elements such dimensions make; nothing if they are more than `most`.
std::optional<std::size_t> count_elements(const std::vector<std::uint64_t>& dimensions, std::size_t most);

// Numbers and Booleans that white space separates, as in the attribute `start`; what is none is 0.
std::vector<double> numbers_of(std::string_view text);

// Appends the elements of `array`. `starts` has one number for each, one for all, or none: 0.
void append_elements(const ModelVariable& array, const std::vector<std::uint64_t>& dimensions,
                     const std::vector<double>& starts, std::vector<ModelVariable>& variables);

}  // namespace stepwright::fmu
