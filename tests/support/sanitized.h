#pragma once

// Flag whether the tests are compiled with a sanitizer: it owns the allocator and takes many times the
// processor's time.

namespace stepwright::support {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace stepwright::support
