// A joint's free axis: the pieces of its law stand in one order along the rate, and a step of the active set goes to the next one.

#include "dynamics/solver/joint/joint_axis.h"

#include <gtest/gtest.h>

#include <vector>

using namespace carom::internal;

namespace {

constexpr double inverse_mass = 0.5; // along the axis

struct Case
{
    const char* name;
    double target;
    double most;
    double lower;
    double upper;
    int pieces; // that the law has
};

const Case cases[] = {
    {"free", 0, 0, -AxisLaw::unbounded, AxisLaw::unbounded, 1},
    {"stops", 0, 0, -1, 1, 3},
    {"motor", 0.5, 0.1, -AxisLaw::unbounded, AxisLaw::unbounded, 3},
    {"motor between stops", 0.5, 0.1, -1, 1, 5},
    {"motor that wants to be below the lower stop", -2, 0.1, -1, 1, 3},
    {"motor that wants to be above the upper stop", 2, 0.1, -1, 1, 3},
    {"motor and one stop", 0, 1e-4, -50, AxisLaw::unbounded, 4},
};

AxisLaw law_of(const Case& c)
{
    AxisLaw law;
    law.target = c.target;
    law.most = c.most;
    law.lower = c.lower;
    law.upper = c.upper;
    return law;
}

bool are_same(const AxisPiece& a, const AxisPiece& b)
{
    return a.kind == b.kind && (a.keeps_its_rate() || a.constant == b.constant);
}

// Along rates without an impulse from far below all pieces to far above them.
std::vector<AxisPiece> pieces_in_order(const AxisLaw& law)
{
    std::vector<AxisPiece> found;
    for (int i = -400'000; i <= 400'000; ++i)
    {
        const AxisPiece piece = law.solve(i * 2e-4 + 1e-5, inverse_mass);
        if (found.empty() || !are_same(found.back(), piece))
            found.push_back(piece);
    }
    return found;
}

} // namespace

TEST(JointAxis, PiecesFollowEachOtherInOneOrder)
{
    for (const Case& c : cases)
    {
        SCOPED_TRACE(c.name);
        const AxisLaw law = law_of(c);
        const std::vector<AxisPiece> pieces = pieces_in_order(law);
        ASSERT_EQ(static_cast<int>(pieces.size()), c.pieces);
        for (std::size_t from = 0; from < pieces.size(); ++from)
        {
            for (std::size_t to = 0; to < pieces.size(); ++to)
            {
                const std::size_t next = to > from ? from + 1 : to < from ? from - 1 : from;
                EXPECT_TRUE(are_same(law.neighbour(pieces[from], pieces[to]), pieces[next])) << from << " to " << to;
            }
        }
    }
}
