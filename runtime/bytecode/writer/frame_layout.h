#pragma once

// Layout of the functions' memory locals within a task's frame. As nothing recurses, a function's frame lies
// behind those of every caller on the longest way to it, and functions that are never active together share
// their bytes.
//
// Pure but for the sections that it completes; any thread.

#include "runtime/bytecode/verify_result.h"
#include "runtime/bytecode/writer/container_model.h"
#include "runtime/bytecode/writer/section_buffers.h"

namespace stepwright::writer {

// Sets frame_offset of every function record and frame_bytes of the sizes. Refuses recursion, which has no
// such layout. Requires the function records of the model in `sections`; calls of functions that are not
// there are left to the verifier.
[[nodiscard]] bytecode::VerifyResult layout_frames(const ContainerModel& model, SectionBuffers& sections);

}  // namespace stepwright::writer
