#pragma once

// Arrays that grow by a quarter of what they have, or by a third. What doubles, as std::vector does, leaves a quarter of its memory unused in the mean, these a
// tenth and an eighth; on the way an item is copied four times, or three times, not once.

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace carom::internal {

enum class Growth : std::size_t
{
    Quarter = 4,
    Third = 3, ///< what grows while a scene is stepped
};

/// Room for `size` items in all.
template <Growth growth = Growth::Quarter, class T>
void make_room(std::vector<T>& items, std::size_t size)
{
    const std::size_t wanted = items.capacity() + items.capacity() / static_cast<std::size_t>(growth);
    if (size > items.capacity())
        items.reserve(size > wanted ? size : wanted);
}

/// At least `size` items; new ones are T().
template <Growth growth = Growth::Quarter, class T>
void grow(std::vector<T>& items, std::size_t size)
{
    make_room<growth>(items, size);
    if (items.size() < size)
        items.resize(size);
}

/// Just `size` items; new ones are T().
template <class T>
void set_size(std::vector<T>& items, std::size_t size)
{
    make_room(items, size);
    items.resize(size);
}

/// The item may be one of them.
template <Growth growth = Growth::Quarter, class T>
void append(std::vector<T>& items, std::type_identity_t<T> item)
{
    make_room<growth>(items, items.size() + 1);
    items.push_back(item);
}

/// None of them may be one of `items`.
template <Growth growth = Growth::Quarter, class T>
void append_all(std::vector<T>& items, std::span<const std::type_identity_t<T>> more)
{
    make_room<growth>(items, items.size() + more.size());
    items.insert(items.end(), more.begin(), more.end());
}

} // namespace carom::internal
