#pragma once

/// @file
/// Ids are values: a slot and the generation it had when the object was made. A default id is null. An id of a destroyed
/// object is stale: it never names a later object, every function refuses it, and Scene::is_valid tells.

#include <compare>
#include <cstdint>

namespace carom {

template <class Kind>
struct Id
{
    std::uint32_t slot = 0; ///< index + 1; 0 is null
    std::uint32_t generation = 0;

    [[nodiscard]] constexpr bool is_null() const { return slot == 0; }
    [[nodiscard]] constexpr explicit operator bool() const { return slot != 0; }
    friend constexpr auto operator<=>(Id, Id) = default;
};

using BodyId = Id<struct BodyKind>;
using ShapeId = Id<struct ShapeKind>;
using JointId = Id<struct JointKind>;

} // namespace carom
