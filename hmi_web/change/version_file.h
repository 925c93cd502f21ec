#pragma once

// A version and its container as the bytes of one file: a line of JSON, and the container behind it.
//
//   {"format":1,"digest":"9f..","name":"mixer.swb","user":"emil","reason":"..","replaced":"",
//    "when_s":1790000000,"outcome":"kept","note":""}
//
// Pure; any thread. Diagnostics: H0095 the file is damaged.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "hmi_web/change/version.h"
#include "runtime/ground/result/result.h"

namespace stepwright::change {

struct VersionFile {
  Version version;
  std::span<const std::byte> container;  // a view into what was read
};

inline constexpr std::size_t kLongestHead = 8'192;  // of the first line, bytes
inline constexpr std::size_t kLargestVersionFile = kLongestHead + kMostContainerBytes;

std::string to_file(const Version& version, std::span<const std::byte> container);
// `name` stands in the diagnostics. What cannot have been written by to_file is refused, a container with
// another digest too.
[[nodiscard]] result::Result<VersionFile> from_file(std::string_view bytes, const std::string& name);

// H0095 of the file `name`.
tl::unexpected<result::Diagnostics> damaged_version(const std::string& name, const std::string& what);

// 64 lower-case hexadecimal digits: can be the digest of a program.
bool is_digest(std::string_view text);

}  // namespace stepwright::change
