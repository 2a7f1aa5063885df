#pragma once

// Who lies flush with the two shapes of a contact, see collision/flush.h.

#include "collision/flush.h"
#include "collision/time_of_impact.h"
#include "dynamics/state/scene_state.h"

namespace carom::internal {

/// Shapes that lie still against the touched one, near it, and may touch the same visitor: of its own body or, where neither is dynamic, of any other. Reads
/// nothing that a step changes, but the list of a body's contacts.
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
    /// Where the manifold tells that a leaf is not hidden, for that one alone.
    FlushPair(const SceneState& state, const Contact& contact, const RelativePose& pose, const LocalManifold& m);
    /// As flight asks for it.
    [[nodiscard]] Flush flush() const { return is_empty() ? Flush{} : Flush{&of_a, &of_b}; }
    [[nodiscard]] bool is_empty() const { return of_a.count == 0 && of_b.count == 0; }
};

} // namespace carom::internal
