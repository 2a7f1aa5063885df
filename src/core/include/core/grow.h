#pragma once

// Arrays that grow by a quarter of their capacity, or by a third. An array that doubles, as std::vector does, leaves a quarter of its memory unused on average;
// these leave a tenth and an eighth. In return, an item is copied four times, or three times, instead of once.

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace carom::internal {

enum class Growth : std::size_t
{
    Quarter = 4,
    Third = 3, ///< for arrays that grow while a scene is stepped
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

/// Appends an item, which may be one of `items`.
template <Growth growth = Growth::Quarter, class T>
void append(std::vector<T>& items, std::type_identity_t<T> item)
{
    make_room<growth>(items, items.size() + 1);
    items.push_back(item);
}

/// Appends several items, none of which may be one of `items`.
template <Growth growth = Growth::Quarter, class T>
void append_all(std::vector<T>& items, std::span<const std::type_identity_t<T>> more)
{
    make_room<growth>(items, items.size() + more.size());
    items.insert(items.end(), more.begin(), more.end());
}

} // namespace carom::internal
