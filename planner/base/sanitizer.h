#pragma once

namespace regrasp {

/// Whether this is a build for the address or thread sanitizer.
/// Both require more address space than any limit, and the address sanitizer opens a pipe to test
/// memory. GCC defines macros for them, clang features.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitizer = true;
#elif defined(__has_feature)
inline constexpr bool kSanitizer =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kSanitizer = false;
#endif

}  // namespace regrasp
