#pragma once

// Which boxes overlap. Two layers: what moves (awake bodies) and what rests (static and sleeping ones), so that the resting world costs
// nothing per step. A layer is a few trees, each at least twice as large as the next: new boxes gather in a short list and are
// merged into trees of growing size, so that adding one shape to a million costs little.
// Boxes without bounds (half-spaces) stand in a list of their own.

#include "collision/box_tree.h"

#include <cstdint>
#include <vector>

namespace carom::internal {

enum class Layer : std::int8_t
{
    None = -1,
    Moving = 0,
    Resting = 1,
};

class BroadPhase
{
public:
    void insert(int item, const FloatBox& box, Layer layer, bool unbounded);
    void remove(int item);
    void move_to(int item, Layer layer);
    void set_box(int item, const FloatBox& box);

    /// The boxes of these items of the moving layer changed. Few: their paths in the tree are widened; many: the layer is sorted anew.
    void update_moving(std::span<const std::int32_t> items, std::span<const FloatBox> boxes);

    [[nodiscard]] const FloatBox& box(int item) const { return m_places[static_cast<std::size_t>(item)].box; }
    [[nodiscard]] bool has(int item) const
    {
        return item < static_cast<int>(m_places.size()) && m_places[static_cast<std::size_t>(item)].layer != Layer::None;
    }

    /// Calls visit(item) for every box that overlaps; false from visit stops.
    template <class Visit>
    bool query(Layer layer, const FloatBox& box, Visit&& visit) const
    {
        return descend(layer, [&](const FloatBox& node) { return overlaps(node, box); }, visit);
    }

    template <class Test, class Visit>
    bool descend(Layer layer, Test&& test, Visit&& visit) const
    {
        const Forest& forest = m_forests[static_cast<std::size_t>(layer)];
        for (const std::int32_t item : forest.recent)
        {
            if (test(box(item)) && !visit(item))
                return false;
        }
        for (const BoxTree& tree : forest.trees)
        {
            if (!tree.descend(test, visit))
                return false;
        }
        return true;
    }

    [[nodiscard]] const std::vector<std::int32_t>& unbounded() const { return m_unbounded; }

private:
    static constexpr std::size_t recent_limit = 32; // longer lists cost queries more than the merge they put off

    struct Place
    {
        FloatBox box{};
        Layer layer = Layer::None;
        bool unbounded = false;
        std::int32_t tree = -1;  ///< -1: in the recent list
        std::int32_t index = -1; ///< leaf in the tree, or place in the list
    };

    struct Forest
    {
        std::vector<BoxTree> trees;
        std::vector<std::int32_t> recent;
    };

    void add_recent(int item, Layer layer);
    void take_out(int item);
    void merge_recent(Forest& forest);
    void rebuild(Forest& forest, std::size_t from_tree);

    std::vector<Place> m_places;
    Forest m_forests[2];
    std::vector<std::int32_t> m_unbounded;
};

} // namespace carom::internal
