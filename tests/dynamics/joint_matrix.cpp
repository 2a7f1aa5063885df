// The system of equations of what joints hold, against the same one written out in full.

#include "dynamics/joint_matrix.h"
#include "dynamics/scene_state.h"
#include "support/test_scene.h"

#include <algorithm>
#include <cmath>

using namespace carom::test;
using namespace carom::internal;

namespace {

using Link = JointForest::Link;

/// A forest of bodies, each of which hangs on an earlier one or on the ground, with rows and masses of any kind.
struct RandomForest
{
    Random random;
    std::vector<Link> links;
    JointForest forest;
    std::vector<JointJacobian> jacobians;
    std::vector<Triple> masses;

    explicit RandomForest(std::uint64_t seed) : random(seed)
    {
        const int bodies = pick(1, 30);
        for (int i = 0; i < bodies; ++i)
            hang(i);
        for (std::size_t i = 1; i < links.size(); ++i)
            std::swap(links[i], links[static_cast<std::size_t>(pick(0, static_cast<int>(i)))]);
        EXPECT_TRUE(forest.build(links));
        for (const JointForest::Joint& joint : forest.joints())
            add_rows(links[static_cast<std::size_t>(joint.link)].rows);
        masses.resize(1);
        while (masses.size() < forest.bodies().size())
            masses.push_back({number(0.01, 10), number(0.01, 10), number(0.01, 10)});
    }

    int pick(int least, int most) { return least + static_cast<int>(random.unit() * (most - least + 1)); }
    double number(double least, double most) { return random.range(least, most); }

    // Some bodies hang on nothing: the ground and such bodies are roots.
    void hang(int body)
    {
        const std::int32_t on = pick(0, 4) == 0 ? none : 100 + 3 * pick(0, body);
        const std::int32_t own = 100 + 3 * body;
        if (on == own)
            return;
        const bool turned = pick(0, 1) == 1;
        links.push_back({body, pick(1, 2), turned ? own : on, turned ? on : own});
    }

    void add_rows(int rows)
    {
        JointJacobian& j = jacobians.emplace_back();
        j.rows = rows;
        for (int r = 0; r < rows; ++r)
        {
            j.up[r] = {number(-1, 1), number(-1, 1), number(-1, 1)};
            j.down[r] = {number(-1, 1), number(-1, 1), number(-1, 1)};
        }
    }

    // The change of velocity of each body by impulses, J^T and the masses.
    [[nodiscard]] std::vector<Triple> pushed(const std::vector<RowPair>& impulses) const
    {
        std::vector<Triple> velocities(masses.size());
        for (std::size_t i = 0; i < impulses.size(); ++i)
        {
            push(velocities, forest.joints()[i].up, jacobians[i].up, impulses[i]);
            push(velocities, forest.joints()[i].down, jacobians[i].down, impulses[i]);
        }
        return velocities;
    }

    void push(std::vector<Triple>& velocities, int node, const Triple (&rows)[2], const RowPair& impulse) const
    {
        Triple& v = velocities[static_cast<std::size_t>(node)];
        const Triple m = masses[static_cast<std::size_t>(node)];
        v.x += m.x * (rows[0].x * impulse.x + rows[1].x * impulse.y);
        v.y += m.y * (rows[0].y * impulse.x + rows[1].y * impulse.y);
        v.turn += m.turn * (rows[0].turn * impulse.x + rows[1].turn * impulse.y);
    }

    [[nodiscard]] RowPair speed(std::size_t i, const std::vector<Triple>& velocities) const
    {
        const Triple& up = velocities[static_cast<std::size_t>(forest.joints()[i].up)];
        const Triple& down = velocities[static_cast<std::size_t>(forest.joints()[i].down)];
        const JointJacobian& j = jacobians[i];
        return {dot(j.up[0], up) + dot(j.down[0], down), dot(j.up[1], up) + dot(j.down[1], down)};
    }
};

TEST(JointForest, ParentsComeFirstAndSiblingsTogether)
{
    for (std::uint64_t seed = 0; seed < 200; ++seed)
    {
        const RandomForest random(seed);
        const auto joints = random.forest.joints();
        ASSERT_EQ(joints.size(), random.links.size());
        for (int i = 0; i < static_cast<int>(joints.size()); ++i)
        {
            const JointForest::Joint& joint = joints[static_cast<std::size_t>(i)];
            ASSERT_LT(joint.parent, i);
            ASSERT_LE(joint.first_sibling, i);
            if (joint.parent != none)
            {
                ASSERT_EQ(joints[static_cast<std::size_t>(joint.parent)].down, joint.up);
            }
            for (int k = joint.first_sibling; k < i; ++k)
                ASSERT_EQ(joints[static_cast<std::size_t>(k)].up, joint.up);
            if (joint.up == JointForest::ground)
            {
                ASSERT_EQ(joint.first_sibling, i);
            }
        }
    }
}

TEST(JointForest, LoopsAreRefused)
{
    JointForest forest;
    EXPECT_TRUE(forest.build(std::vector<Link>{{0, 2, 1, 2}, {1, 2, 2, 3}, {2, 2, 3, none}}));
    EXPECT_FALSE(forest.build(std::vector<Link>{{0, 2, 1, 2}, {1, 2, 2, 3}, {2, 2, 3, 1}}));
    EXPECT_FALSE(forest.build(std::vector<Link>{{0, 2, 1, none}, {1, 2, 1, 2}, {2, 2, none, 2}}));
    EXPECT_FALSE(forest.build(std::vector<Link>{{0, 2, 1, 2}, {1, 2, 2, 1}}));
    EXPECT_FALSE(forest.build(std::vector<Link>{{0, 2, none, none}}));
}

TEST(JointMatrix, TheImpulsesItFindsGiveTheSpeedsAskedFor)
{
    JointMatrix matrix;
    int solved = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed)
    {
        RandomForest random(seed);
        const auto joints = random.forest.joints();
        matrix.lay_out(joints);
        ASSERT_TRUE(matrix.factor(joints, random.jacobians, random.masses)) << seed;
        std::vector<RowPair> wanted;
        for (const JointJacobian& j : random.jacobians)
            wanted.push_back({random.number(-1, 1), j.rows == 2 ? random.number(-1, 1) : 0});
        std::vector<RowPair> impulses = wanted;
        matrix.solve(impulses);
        double largest = 1;
        for (const RowPair& p : impulses)
            largest = std::max({largest, std::fabs(p.x), std::fabs(p.y)});
        const std::vector<Triple> velocities = random.pushed(impulses);
        for (std::size_t i = 0; i < wanted.size(); ++i)
        {
            const RowPair speed = random.speed(i, velocities);
            ASSERT_NEAR(speed.x, wanted[i].x, 1e-11 * largest) << seed;
            ASSERT_NEAR(speed.y, wanted[i].y, 1e-11 * largest) << seed;
            ++solved;
        }
    }
    EXPECT_GT(solved, 4000);
}

TEST(JointMatrix, RowsThatSayTheSameTwiceAreRefused)
{
    JointForest forest;
    ASSERT_TRUE(forest.build(std::vector<Link>{{0, 2, none, 1}}));
    JointMatrix matrix;
    matrix.lay_out(forest.joints());
    const Triple row = {0.3, -0.4, 0.7};
    const std::vector<Triple> masses = {{}, {1, 1, 3}};
    EXPECT_FALSE(matrix.factor(forest.joints(), std::vector<JointJacobian>{{{}, {row, row}, 2}}, masses));
    EXPECT_TRUE(matrix.factor(forest.joints(), std::vector<JointJacobian>{{{}, {row, {}}, 1}}, masses));
    EXPECT_FALSE(matrix.factor(forest.joints(), std::vector<JointJacobian>{{{}, {row, {}}, 1}}, std::vector<Triple>(2)));
}

} // namespace
