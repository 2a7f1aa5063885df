#pragma once

// Which joint hangs on which.

#include <cstdint>
#include <span>
#include <vector>

namespace carom::internal {

/// Joints without loops between them, in the order of breadth from the roots: parents come first, and the joints by which a body holds further
/// ones follow one another. A root is what does not move or, where a tree hangs free, its first body.
class JointForest
{
public:
    static constexpr int ground = 0; ///< the node of all that does not move

    /// What a joint connects.
    struct Link
    {
        int joint = 0;      ///< any number of the caller's
        int rows = 0;       ///< that it holds
        std::int32_t a = 0; ///< bodies; none: does not move
        std::int32_t b = 0;

        friend bool operator==(const Link&, const Link&) = default;
    };

    struct Joint
    {
        int link = 0;
        int up = ground;       ///< node towards the root
        int down = 0;          ///< node that hangs on it
        int parent = 0;        ///< the joint that holds `up`; none at a root
        int first_sibling = 0; ///< the first one that shares the body `up`; itself on the ground, which couples nothing
    };

    /// False where there is a loop. All that does not move is one.
    [[nodiscard]] bool build(std::span<const Link> links);
    [[nodiscard]] std::span<const Joint> joints() const { return m_joints; }
    /// By node; none for the ground.
    [[nodiscard]] std::span<const std::int32_t> bodies() const { return m_bodies; }

private:
    /// A joint as one of its bodies sees it.
    struct End
    {
        int node = 0;
        int link = 0;
        int other = 0;

        friend auto operator<=>(const End&, const End&) = default;
    };

    void number_bodies(std::span<const Link> links);
    [[nodiscard]] int node_of(std::int32_t body) const;
    void gather_ends(std::span<const Link> links);
    [[nodiscard]] bool grow(int root);
    [[nodiscard]] bool add_children(int node, int parent);

    std::vector<std::int32_t> m_bodies;
    std::vector<End> m_ends;     ///< sorted by node
    std::vector<char> m_reached; ///< by node
    std::vector<char> m_taken;   ///< by link
    std::vector<Joint> m_joints;
};

} // namespace carom::internal
