#pragma once

/// @file
/// Long tests do a part of their work: a tenth in slow builds (sanitizers and structure walks cost a factor of ten), a third by default, all of it where
/// the environment says CAROM_TESTS=whole, as scripts/whole-tests does.

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace carom::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(CAROM_VALIDATE)
inline constexpr bool slow_build = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool slow_build = true;
#else
inline constexpr bool slow_build = false;
#endif
#else
inline constexpr bool slow_build = false;
#endif

inline bool does_whole_tests()
{
    const char* wish = std::getenv("CAROM_TESTS");
    return !slow_build && wish != nullptr && std::string_view(wish) == "whole";
}

/// One over that part.
inline int divisor_of_work() { return slow_build ? 10 : does_whole_tests() ? 1 : 3; }

/// That part of so many runs, steps or bodies.
inline int part_of(int whole) { return std::max(whole / divisor_of_work(), 1); }

} // namespace carom::test
