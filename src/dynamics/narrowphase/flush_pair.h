#pragma once

// Shapes that lie flush with the two shapes of a contact, see collision/flush.h.

#include "collision/flush.h"
#include "collision/time_of_impact.h"
#include "dynamics/state/scene_state.h"

namespace carom::internal {

/// Finds shapes that do not move against the touched one, are near it, and may touch the same visitor. They belong to its body or, where neither body is
/// dynamic, to any other. Reads nothing that a step changes, except for the list of a body's contacts.
void find_flush_neighbours(const SceneState& state, int touched, int visitor, FlushNeighbours& found);

struct FlushPair
{
    FlushNeighbours of_a;
    FlushNeighbours of_b;

    FlushPair(const SceneState& state, int shape_a, int shape_b)
    {
        find_flush_neighbours(state, shape_a, shape_b, of_a);
        find_flush_neighbours(state, shape_b, shape_a, of_b);
    }
    /// Finds neighbors only for leaves that may be hidden, as far as the manifold shows.
    FlushPair(const SceneState& state, const Contact& contact, const RelativePose& pose, const LocalManifold& m);
    /// In the form that flight uses.
    [[nodiscard]] Flush flush() const { return is_empty() ? Flush{} : Flush{&of_a, &of_b}; }
    [[nodiscard]] bool is_empty() const { return of_a.count == 0 && of_b.count == 0; }
};

} // namespace carom::internal
