#pragma once

// Values that were written last, until the images show them: a write that follows is made to them, not to
// what an image of before shows.
//
//   values.note("MAIN.level", "20.0", images);          // the runtime has taken it; so many images had come
//   values.of("main.LEVEL", images);                    // "20.0", or nothing once images show it
//
// Threads: every function from any.

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace stepwright::api {

class WrittenValues {
 public:
  void note(std::string_view name, std::string text, std::uint64_t images);
  std::optional<std::string> of(std::string_view name, std::uint64_t images);

 private:
  struct Written {
    std::string text;
    std::uint64_t images = 0;  // that had come when it was taken
  };

  std::mutex mutex_;
  std::map<std::string, Written, std::less<>> values_;  // by the name in upper case
};

}  // namespace stepwright::api
