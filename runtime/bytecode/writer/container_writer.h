#pragma once

// Writes a ContainerModel as the bytes of a container and has the verifier accept it before it returns.
// Deterministic: equal models give equal bytes.

#include <cstddef>
#include <vector>

#include "runtime/bytecode/writer/container_model.h"
#include "runtime/result/result.h"

namespace stepwright::writer {

// Fails (code "B0100") if the model is not a valid container, e.g. a recursive call or a store outside the
// image: the message names the function, the byte offset and the reason. Computes max_stack, stack_slots and
// call_depth itself.
[[nodiscard]] result::Result<std::vector<std::byte>> write_container(const ContainerModel& model);

}  // namespace stepwright::writer
