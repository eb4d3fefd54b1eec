#pragma once

namespace regrasp {

/// Whether this is built for the address sanitizer: it takes more address space than any limit, and
/// asks with a pipe whether memory is there. GCC says so with a macro, clang with a feature.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kAddressSanitizer = true;
#elif defined(__has_feature)
inline constexpr bool kAddressSanitizer = __has_feature(address_sanitizer);
#else
inline constexpr bool kAddressSanitizer = false;
#endif

}  // namespace regrasp
