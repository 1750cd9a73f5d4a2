// Whether this program is built with sanitizers: they take a multiple of the time, handle signals themselves, need to
// be loaded first, and terabytes of addresses.
#pragma once

namespace dynalin {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // g++
inline constexpr bool sanitized = true;
#elif defined(__has_feature)  // clang
inline constexpr bool sanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace dynalin
