#pragma once

// The state of a runtime as page, metrics and journals spell it. Pure; any thread.
//
//   name_of(status.state)      // "running"

#include "runtime/host/runtime_state.h"

namespace stepwright::host {

inline const char* name_of(RuntimeState state) {
  switch (state) {
    case RuntimeState::Empty:
      return "empty";
    case RuntimeState::Stopped:
      return "stopped";
    case RuntimeState::Running:
      return "running";
    case RuntimeState::Fault:
      return "fault";
  }
  return "";
}

}  // namespace stepwright::host
