#pragma once

// Writes a ContainerModel as the bytes of a container and has the verifier accept it before it returns.
// Deterministic: equal models give equal bytes.

#include <cstddef>
#include <vector>

#include "runtime/bytecode/verify_result.h"
#include "runtime/bytecode/writer/container_model.h"
#include "runtime/ground/result/result.h"

namespace stepwright::writer {

// Why a model is no valid container: the verdict, and the same as a diagnostic (code "B0100") that names the
// function, the byte offset and the reason.
struct Refusal {
  bytecode::VerifyResult verdict;
  result::Diagnostics diagnostics;
};

// Fails if the model is not a valid container, e.g. a recursive call or a store outside the image; a file
// that is larger than any container is TooLarge in the section Code. Computes max_stack, stack_slots and
// call_depth itself.
[[nodiscard]] tl::expected<std::vector<std::byte>, Refusal> try_write_container(const ContainerModel& model);

// The same, failing with the diagnostic.
[[nodiscard]] result::Result<std::vector<std::byte>> write_container(const ContainerModel& model);

}  // namespace stepwright::writer
