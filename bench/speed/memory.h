#pragma once

/// @file
/// Memory of this process, as the system and the allocator report it; zeros where they do not.

#include <cstddef>

namespace speed {

/// In use on the heap now, bytes.
[[nodiscard]] std::size_t heap_bytes();
/// Most memory that was resident since the start or since forget_peak, bytes.
[[nodiscard]] std::size_t peak_bytes();
/// Gives back what is free and starts the peak anew, so that one scene's does not hide the next one's.
void forget_peak();

} // namespace speed
