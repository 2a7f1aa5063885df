#pragma once

/// @file
/// The adapters. A peer's file is built only where the peer is installed.

#include "truth/world.h"

namespace truth {

[[nodiscard]] Engine box2d_engine();
[[nodiscard]] Engine box2d3_engine();
[[nodiscard]] Engine chipmunk_engine();

} // namespace truth
