// The experiments themselves: their measures on motions that are known, their references, and that a wrong engine is found out.

#include "truth/run.h"

#include "truth/experiments/flipper.h"
#include "truth/measure.h"
#include "truth/overlap.h"

using namespace truth;
using namespace truth::test;

namespace {

/// Factors on what the engine is told.
struct Wrong
{
    double gravity = 1;
    double restitution = 1;
    double radius = 1;
};

/// Carom, misled.
class WrongWorld final : public World
{
public:
    WrongWorld(Vec gravity, Wrong wrong)
        : m_world(carom_engine().make_world({.gravity = wrong.gravity * gravity})), m_wrong(wrong)
    {}
    Body add_body(const BodyDef& def) override { return m_world->add_body(def); }
    void add_shape(Body body, const Shape& shape, const Material& material) override
    {
        Material changed = material;
        changed.restitution *= m_wrong.restitution;
        const Disc* disc = std::get_if<Disc>(&shape);
        m_world->add_shape(body, disc ? Shape(Disc{disc->radius * m_wrong.radius}) : shape, changed);
    }
    void add_hinge(const Hinge& hinge) override { m_world->add_hinge(hinge); }
    void add_slider(const Slider& slider) override { m_world->add_slider(slider); }
    void add_rod(Body a, Body b, double length) override { m_world->add_rod(a, b, length); }
    void add_spring(Body a, Body b, double length, double stiffness, double damping) override
    {
        m_world->add_spring(a, b, length, stiffness, damping);
    }
    void set_motion(Body body, Vec velocity, double spin) override { m_world->set_motion(body, velocity, spin); }
    void step(double dt) override { m_world->step(dt); }
    State state(Body body) const override { return m_world->state(body); }

private:
    std::unique_ptr<World> m_world;
    Wrong m_wrong;
};

Engine wrong_engine(Wrong wrong)
{
    return {"wrong", [=](const WorldDef& def) { return std::make_unique<WrongWorld>(def.gravity, wrong); }};
}

int misses(int number, const Engine& engine)
{
    int count = 0;
    for (const Metric& m : run(number, 60, 0.1, engine))
    {
        count += m.ok() ? 0 : 1;
    }
    return count;
}

} // namespace

TEST(Harness, AWrongEngineIsFoundOut)
{
    for (const int number : {1, 2, 3, 4, 8, 10})
    {
        EXPECT_GT(misses(number, wrong_engine({.restitution = 0.99})), 0) << "experiment " << number;
    }
    EXPECT_GT(misses(15, wrong_engine({.restitution = 0.97})), 0) << "a third of that in the speed of the shot";
    for (const int number : {5, 6})
    {
        EXPECT_GT(misses(number, wrong_engine({.gravity = 1.01})), 0) << "experiment " << number;
    }
    for (const int number : {7, 9})
    {
        EXPECT_GT(misses(number, wrong_engine({.radius = 1.01})), 0) << "experiment " << number;
    }
}

TEST(Harness, WithoutSensorEventsSensorsFail) { EXPECT_GT(misses(11, wrong_engine({})), 0); }

TEST(Harness, EveryExperimentHasItsNumberAndNamesOfItsOwn)
{
    for (const Experiment& experiment : experiments())
    {
        EXPECT_EQ(find_experiment(experiment.number), &experiment);
    }
    EXPECT_EQ(find_experiment(25), nullptr);
    EXPECT_EQ(experiments().size(), 24u);
}

TEST(Harness, ConvergesMeansHalfOrAQuarterOfTheBound)
{
    const auto metric = [](double value) { return Metric{.exact = 1, .value = value, .bound = 0.1}; };
    EXPECT_TRUE(converges(metric(1.4), metric(1.2)));
    EXPECT_FALSE(converges(metric(1.4), metric(1.21)));
    EXPECT_TRUE(converges(metric(1.01), metric(1.024)));
    EXPECT_FALSE(converges(metric(1.03), metric(1.026)));
    EXPECT_FALSE(converges(metric(1.03), metric(none)));
}

TEST(Harness, AValueThatIsNoNumberIsNotOk)
{
    EXPECT_FALSE((Metric{.value = none, .bound = 1}.ok()));
    EXPECT_TRUE((Metric{.value = 5}.ok()));
    Errors errors;
    errors.add(none);
    errors.add(1);
    EXPECT_TRUE(std::isnan(errors.worst()));
    EXPECT_TRUE(std::isnan(Errors{}.mean()));
    Farthest farthest(0);
    farthest.add(1);
    farthest.add(none);
    EXPECT_TRUE(std::isnan(farthest.value()));
}

TEST(Harness, VertexAndCrossingOfPolynomials)
{
    const auto parabola = [](double t) { return 3 - 2 * (t - 0.3) * (t - 0.3); };
    EXPECT_NEAR(vertex(parabola(-1), parabola(0), parabola(1)), 3, 1e-12);
    const auto cubic = [](double t) { return (t - 0.37) * (t * t + 2); };
    EXPECT_NEAR(crossing({cubic(-1), cubic(0), cubic(1), cubic(2)}), 0.37, 1e-12);
}

TEST(Harness, OverlapsOfShapesInEachOther)
{
    const Placed square{box(1, 1), {0, 0}, 0};
    EXPECT_NEAR(overlap(square, {box(1, 1), {0.9, 0.3}, 0}), 0.1, 1e-12);
    EXPECT_NEAR(overlap(square, {box(1, 1), {0, 0.5 + std::sqrt(0.5) - 0.01}, pi / 4}), 0.01, 1e-12);
    EXPECT_LT(overlap(square, {box(1, 1), {1.1, 0}, 0}), 0);
    EXPECT_NEAR(overlap(square, {Disc{0.2}, {0.6, 0}, 0}), 0.1, 1e-12);
    EXPECT_NEAR(overlap({Disc{0.2}, {0.3, 0}, 0}, square), 0.4, 1e-12);
    EXPECT_NEAR(overlap(square, {Disc{0.2}, {0.6, 0.6}, 0}), 0.2 - std::sqrt(0.02), 1e-12);
    EXPECT_NEAR(overlap({Disc{1}, {0, 0}, 0}, {Disc{2}, {2.5, 0}, 0}), 0.5, 1e-12);
    const Capsule capsule{{-1, 0}, {1, 0}, 0.25};
    EXPECT_NEAR(overlap(square, {capsule, {0, 0.7}, 0}), 0.05, 1e-12);
    EXPECT_NEAR(overlap(square, {capsule, {0.6, 1.6}, pi / 2}), 0.25 - std::hypot(0.1, 0.1), 1e-12);
    EXPECT_NEAR(overlap({capsule, {0, 0}, 0}, {capsule, {1.5, 0.4}, pi / 2}), 0, 1e-12);
    EXPECT_NEAR(overlap({capsule, {0, 0.2}, 0}, {Segment{{-5, 0}, {5, 0}}, {0, 0}, 0}), 0.05, 1e-12);
    Polygon rounded = box(1, 1);
    rounded.radius = 0.1;
    EXPECT_NEAR(overlap({rounded, {0, 0}, 0}, {box(1, 1), {0.5 + 0.5 + 0.03, 1.04}, 0}), 0.1 - std::hypot(0.03, 0.04), 1e-12);
}

// One impact at the bar's rest position, in closed form: 1.5 times the speed of the bar there, at a right angle to it.
TEST(Harness, TheFlipperReferenceGivesTheClosedForm)
{
    const Shot shot = exact_flipper_shot(1.0 / 60, 0.5, 0);
    EXPECT_NEAR(shot.speed(), 1.5 * 30 * 0.06, 1e-4);
    EXPECT_NEAR(degrees(shot.angle()), 65, 5e-3);
}
