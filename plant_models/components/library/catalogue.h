#pragma once

// The types of components that every plant's file can name. Built at the first call, which is at set-up; any
// thread after it.

#include "plant_models/components/component_type.h"

namespace stepwright::components::library {

Catalogue catalogue();

}  // namespace stepwright::components::library
