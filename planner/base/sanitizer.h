#pragma once

namespace regrasp {

/// Whether this is built for the address or the thread sanitizer: both take more address space than
/// any limit, and the first asks with a pipe whether memory is there. GCC says so with macros,
/// clang with features.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitizer = true;
#elif defined(__has_feature)
inline constexpr bool kSanitizer =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kSanitizer = false;
#endif

}  // namespace regrasp
