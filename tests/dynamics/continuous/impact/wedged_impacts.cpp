// Impacts on what leans against a hinge and a wall that nearly face each other: the equations are so ill-conditioned that no number of passes solves them.

#include "dynamics/continuous/impact/reflect.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace carom::internal;

namespace {

double energy(const std::vector<ImpactBody>& bodies)
{
    double sum = 0;
    for (const ImpactBody& b : bodies)
    {
        if (b.inverse_mass_x > 0)
            sum += 0.5 * (b.vx * b.vx + b.vy * b.vy) / b.inverse_mass_x + 0.5 * b.w * b.w / b.inverse_inertia;
    }
    return sum;
}

ImpactRow row(ImpactRow::Kind kind, int a, int b, double nx, double ny, double turn_a, double turn_b)
{
    ImpactRow r;
    r.kind = kind;
    r.a = a;
    r.b = b;
    r.nx = nx;
    r.ny = ny;
    r.turn_a = turn_a;
    r.turn_b = turn_b;
    return r;
}

} // namespace

TEST(WedgedImpacts, NeverGiveEnergy)
{
    for (const double arm : {-0.8135, -0.8, -0.5, 0.0, 0.1067, 0.5})
    {
        for (const double restitution : {0.0, 0.3, 0.615, 1.0})
        {
            SCOPED_TRACE("arm " + std::to_string(arm) + ", e " + std::to_string(restitution));
            // The first body falls, the second is on the hinge, the third is the world.
            std::vector<ImpactBody> bodies(3);
            bodies[0] = {
                .vx = 7.5, .vy = -18.9, .inverse_mass_x = 1 / 3.024, .inverse_mass_y = 1 / 3.024, .inverse_inertia = 1 / 3.452};
            bodies[1] = {.inverse_mass_x = 1 / 2.58, .inverse_mass_y = 1 / 2.58, .inverse_inertia = 1 / 8.979};
            const double before = energy(bodies);
            std::vector<ImpactRow> rows{row(ImpactRow::Kind::Contact, 1, 0, 0.5541, 0.8325, 2.37, -0.1499),
                                        row(ImpactRow::Kind::Bilateral, 1, 2, 1, 0, 0.8135, 0),
                                        row(ImpactRow::Kind::Bilateral, 1, 2, 0, 1, -3.154, 0),
                                        row(ImpactRow::Kind::Contact, 2, 1, -1, -0.003323, 0, arm)};
            rows[0].arm_a_x = 3.15;
            rows[0].arm_a_y = 0.455;
            rows[0].arm_b_x = 0.3;
            rows[0].arm_b_y = 0.721;
            rows[3].arm_b_x = 3.2;
            rows[3].arm_b_y = arm + 0.0106;
            rows[0].friction = rows[3].friction = 0.6;
            ImpactWork work;
            std::vector<Blow> blows;
            const bool done =
                reflect(bodies, rows, 1e-3, [=](int, double) { return Bounce{.restitution = restitution}; }, work, blows);
            EXPECT_LE(energy(bodies), before * (1 + 1e-6)) << (done ? "" : "and it is jammed");
        }
    }
}
