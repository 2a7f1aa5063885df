// The system of equations of an island's joints, against the same one multiplied out.

#include "dynamics/solver/joint/direct/joint_matrix.h"
#include "support/test_scene.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace carom::test;
using namespace carom::internal;

namespace {

/// Bodies and joints between them and the ground, with rows and masses of any kind.
struct RandomGraph
{
    Random random;
    std::vector<JointMatrix::Edge> edges;
    std::vector<JointJacobian> jacobians;
    std::vector<Triple> masses{{}};

    RandomGraph(std::uint64_t seed, int loops) : random(seed)
    {
        const int bodies = pick(1, 30);
        for (int i = 1; i <= bodies; ++i)
        {
            masses.push_back({number(0.01, 10), number(0.01, 10), number(0.01, 10)});
            add_edge(pick(0, 4) == 0 ? JointMatrix::ground : pick(0, i - 1), i);
        }
        for (int i = 0; i < loops && bodies > 1; ++i)
            add_edge(pick(0, bodies - 1), pick(1, bodies));
        for (std::size_t i = 1; i < edges.size(); ++i)
            std::swap(edges[i], edges[static_cast<std::size_t>(pick(0, static_cast<int>(i)))]);
    }

    int pick(int least, int most) { return least + static_cast<int>(random.unit() * (most - least + 1)); }
    double number(double least, double most) { return random.range(least, most); }
    Triple triple() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }

    void add_edge(int a, int b)
    {
        if (a == b)
            return;
        if (pick(0, 1) == 1)
            std::swap(a, b);
        edges.push_back({a, b, pick(1, most_joint_rows)});
        JointJacobian& j = jacobians.emplace_back();
        for (int r = 0; r < most_joint_rows; ++r)
        {
            j.a[r] = triple();
            j.b[r] = triple();
        }
    }

    /// J M^-1 J^T impulses.
    [[nodiscard]] std::vector<double> speeds(const JointMatrix& matrix, const std::vector<double>& impulses) const
    {
        std::vector<Triple> change(masses.size());
        std::vector<double> found(impulses.size());
        const auto for_each_row = [&](const auto& visit)
        {
            for (std::size_t i = 0; i < edges.size(); ++i)
            {
                for (int r = 0; r < edges[i].rows; ++r)
                    visit(static_cast<std::size_t>(matrix.first_row(i) + r), edges[i], jacobians[i].a[r], jacobians[i].b[r]);
            }
        };
        for_each_row(
            [&](std::size_t row, const JointMatrix::Edge& e, const Triple& a, const Triple& b)
            {
                change[static_cast<std::size_t>(e.a)] += impulses[row] * product(masses[static_cast<std::size_t>(e.a)], a);
                change[static_cast<std::size_t>(e.b)] += impulses[row] * product(masses[static_cast<std::size_t>(e.b)], b);
            });
        for_each_row(
            [&](std::size_t row, const JointMatrix::Edge& e, const Triple& a, const Triple& b)
            { found[row] = dot(a, change[static_cast<std::size_t>(e.a)]) + dot(b, change[static_cast<std::size_t>(e.b)]); });
        return found;
    }

    [[nodiscard]] std::vector<double> numbers(int count)
    {
        std::vector<double> found(static_cast<std::size_t>(count));
        for (double& x : found)
            x = number(-1, 1);
        return found;
    }
};

double largest(const std::vector<double>& values)
{
    double most = 1;
    for (const double x : values)
        most = std::max(most, std::fabs(x));
    return most;
}

JointMatrix laid_out(const RandomGraph& graph)
{
    JointMatrix matrix;
    matrix.lay_out(graph.edges, static_cast<int>(graph.masses.size()));
    matrix.fill(graph.jacobians, graph.masses);
    return matrix;
}

TEST(JointMatrix, TheImpulsesItFindsGiveTheSpeedsAskedFor)
{
    int solved = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed)
    {
        RandomGraph graph(seed, 0);
        // A body has three ways to move: with more rows than that, they cannot all be asked for. Soft ones can.
        for (JointMatrix::Edge& e : graph.edges)
            e.rows = std::min(e.rows, 2);
        JointMatrix matrix = laid_out(graph);
        EXPECT_FALSE(matrix.has_loops());
        const std::vector<double> wanted = graph.numbers(matrix.rows());
        std::vector<double> impulses = wanted;
        matrix.factor(std::vector<double>(wanted.size(), 0.0));
        matrix.solve(impulses);
        const std::vector<double> speeds = graph.speeds(matrix, impulses);
        for (std::size_t i = 0; i < wanted.size(); ++i)
            ASSERT_NEAR(speeds[i], wanted[i], 1e-11 * largest(impulses)) << seed;
        solved += matrix.rows();
    }
    EXPECT_GT(solved, 4000);
}

TEST(JointMatrix, SoftRowsGiveAsTheirComplianceSaysAndRowsThatAreOffGiveNothing)
{
    for (std::uint64_t seed = 0; seed < 500; ++seed)
    {
        RandomGraph graph(seed, 0);
        JointMatrix matrix = laid_out(graph);
        const std::vector<double> wanted = graph.numbers(matrix.rows());
        std::vector<double> compliances;
        for (int i = 0; i < matrix.rows(); ++i)
            compliances.push_back(graph.pick(0, 3) == 0 ? JointMatrix::off : graph.number(0.1, 10));
        std::vector<double> impulses = wanted;
        matrix.factor(compliances);
        matrix.solve(impulses);
        const std::vector<double> speeds = graph.speeds(matrix, impulses);
        for (std::size_t i = 0; i < wanted.size(); ++i)
        {
            if (compliances[i] == JointMatrix::off)
                ASSERT_EQ(impulses[i], 0) << seed;
            else
                ASSERT_NEAR(speeds[i] + compliances[i] * impulses[i], wanted[i], 1e-11 * largest(impulses)) << seed;
        }
    }
}

// Loops hold some directions twice: asked for speeds that can be had, a few solves of what is left find them.
TEST(JointMatrix, LoopsFindWhatCanBeHad)
{
    int looped = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed)
    {
        RandomGraph graph(seed, 4);
        JointMatrix matrix = laid_out(graph);
        looped += matrix.has_loops() ? 1 : 0;
        const std::vector<double> possible = graph.speeds(matrix, graph.numbers(matrix.rows()));
        matrix.factor(std::vector<double>(possible.size(), 0.0));
        std::vector<double> left = possible;
        for (int i = 0; i < 4; ++i)
        {
            std::vector<double> impulses = left;
            matrix.solve(impulses);
            const std::vector<double> speeds = graph.speeds(matrix, impulses);
            for (std::size_t row = 0; row < left.size(); ++row)
                left[row] -= speeds[row];
        }
        for (const double x : left)
            ASSERT_NEAR(x, 0, 1e-2 * largest(possible)) << seed;
    }
    EXPECT_GT(looped, 200);
}

TEST(JointMatrix, SaysWhatALoopIs)
{
    const auto loops = [](const std::vector<JointMatrix::Edge>& edges)
    {
        JointMatrix matrix;
        matrix.lay_out(edges, 4);
        return matrix.has_loops();
    };
    EXPECT_FALSE(loops({{1, 2, 2}, {2, 3, 2}, {3, 0, 2}}));
    EXPECT_TRUE(loops({{1, 2, 2}, {2, 3, 2}, {3, 1, 2}}));
    EXPECT_TRUE(loops({{1, 0, 2}, {1, 2, 2}, {0, 2, 2}}));
    EXPECT_TRUE(loops({{1, 2, 2}, {2, 1, 2}}));
}

TEST(JointMatrix, ARowThatOthersImplyGivesNothing)
{
    JointMatrix matrix;
    matrix.lay_out(std::vector<JointMatrix::Edge>{{0, 1, 2}}, 2);
    const Triple row = {0.3, -0.4, 0.7};
    const std::vector<JointJacobian> twice{{{}, {row, row, {}}}};
    matrix.fill(twice, std::vector<Triple>{{}, {1, 1, 3}});
    matrix.factor(std::vector<double>(2, 0.0));
    std::vector<double> impulses{1, 1};
    matrix.solve(impulses);
    EXPECT_NEAR(impulses[0] + impulses[1], 1 / (0.09 + 0.16 + 3 * 0.49), 1e-12);
    matrix.fill(twice, std::vector<Triple>(2)); // nothing moves
    matrix.factor(std::vector<double>(2, 0.0));
    impulses = {1, 1};
    matrix.solve(impulses);
    EXPECT_EQ(impulses[0], 0);
    EXPECT_EQ(impulses[1], 0);
}

} // namespace
