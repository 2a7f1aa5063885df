#pragma once

// Arrays that grow by half of what they have. What doubles, as std::vector does, leaves a quarter of its memory unused in the mean, this a sixth; on the way
// an item is copied twice, not once.

#include <cstddef>
#include <type_traits>
#include <vector>

namespace carom::internal {

/// Room for `size` items in all.
template <class T>
void make_room(std::vector<T>& items, std::size_t size)
{
    const std::size_t wanted = items.capacity() + items.capacity() / 2;
    if (size > items.capacity())
        items.reserve(size > wanted ? size : wanted);
}

/// At least `size` items; new ones are T().
template <class T>
void grow(std::vector<T>& items, std::size_t size)
{
    make_room(items, size);
    if (items.size() < size)
        items.resize(size);
}

/// The item may be one of them.
template <class T>
void append(std::vector<T>& items, std::type_identity_t<T> item)
{
    make_room(items, items.size() + 1);
    items.push_back(item);
}

} // namespace carom::internal
