#pragma once

// Where the states of a plant begin whose start follows from inputs, other states, faults or the time: at
// time 0, with faults at rest and terminals at 0, each from what the others begin with.
//
//   auto model = assemble(std::move(text));
//   if (auto worked_out = work_out_starts(*model); !worked_out) return forward(worked_out);
//   std::vector<double> y = model->start();
//
// Thread rule: nobody else uses the model meanwhile.

#include "plant_models/components/model.h"
#include "runtime/ground/result/result.h"

namespace stepwright::components {

// Sets the starts of the components, which are new afterwards (but for those that are processes): modes that
// were found on the way are forgotten. Does nothing to a plant whose starts are all figures. Fails with C0346
// (each of several starts needs another one; no values fit each other), C0349 (a start is no finite number)
// and C0331.
[[nodiscard]] result::Result<void> work_out_starts(Model& model);

}  // namespace stepwright::components
