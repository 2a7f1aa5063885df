#pragma once

// Ray casts against leaves, in the leaf's body frame.

#include "geometry/leaf.h"

#include <optional>

namespace carom::internal {

struct LeafHit
{
    float fraction; ///< fraction of the translation
    Vec2 normal;    ///< outward normal; zero where the ray starts inside
};

/// First hit of the ray from origin to origin + translation.
[[nodiscard]] std::optional<LeafHit> ray_leaf(const LeafView& view, Vec2 origin, Vec2 translation);

} // namespace carom::internal
