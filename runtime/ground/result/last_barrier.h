#pragma once

// Barrier for exceptions at the top of a thread that serves others for long: whatever is thrown below it
// costs one step of its work, and never the process.
//
//   while (!stopping()) {
//     if (const auto thrown = result::thrown_by([&] { step(); })) tell(*thrown);
//   }
//
// Any thread.

#include <exception>
#include <optional>
#include <string>

namespace stepwright::result {

// Text of the exception that the step threw; nothing: it returned.
template <typename Step>
std::optional<std::string> thrown_by(Step&& step) {
  try {
    step();
    return std::nullopt;
  } catch (const std::exception& problem) {
    return problem.what();
  } catch (...) {
    return "something that is no exception of the standard's";
  }
}

}  // namespace stepwright::result
