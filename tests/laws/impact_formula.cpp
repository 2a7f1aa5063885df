// Row 5: an isolated frictionless impact gives j = (1+e) · m1·m2/(m1+m2) · (v1 - v2), m = 1/(1/m + r²/I), r the lever arm of the normal.
// The reference below is in doubles and knows the geometry only from how each pair was built.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

namespace {

struct D2
{
    double x = 0;
    double y = 0;
};

D2 operator+(D2 a, D2 b) { return {a.x + b.x, a.y + b.y}; }
D2 operator*(double s, D2 a) { return {s * a.x, s * a.y}; }
D2 turned(double angle, D2 a)
{
    return {std::cos(angle) * a.x - std::sin(angle) * a.y, std::sin(angle) * a.x + std::cos(angle) * a.y};
}
double dot(D2 a, D2 b) { return a.x * b.x + a.y * b.y; }
double cross(D2 a, D2 b) { return a.x * b.y - a.y * b.x; }

struct Moving
{
    D2 center;
    D2 velocity;
    double spin = 0;
    double inverse_mass = 0;
    double inverse_inertia = 0;
};

Moving read(Scene& scene, BodyId id)
{
    const Body b = scene.body(id);
    const Position c = b.center_of_mass();
    Moving m{{c.x, c.y}, {b.velocity().x, b.velocity().y}, b.angular_velocity()};
    if (b.mass() > 0)
        m.inverse_mass = 1 / static_cast<double>(b.mass());
    if (b.inertia() > 0 && b.mass() > 0)
        m.inverse_inertia = 1 / static_cast<double>(b.inertia());
    return m;
}

struct Reference
{
    double approach = 0;
    double impulse = 0;
    Moving a;
    Moving b;
};

// The formula, with 1/m_eff = 1/m + r²/I on each side; an infinite mass has 1/m_eff = 0.
Reference collide(const Moving& a, const Moving& b, D2 point, D2 n, double e)
{
    const auto lever = [&](const Moving& m) { return cross(point + -1.0 * m.center, n); };
    const auto along = [&](const Moving& m) { return dot(m.velocity, n) + m.spin * lever(m); };
    const double ka = a.inverse_mass + lever(a) * lever(a) * a.inverse_inertia;
    const double kb = b.inverse_mass + lever(b) * lever(b) * b.inverse_inertia;
    Reference r{along(a) - along(b), 0, a, b};
    if (r.approach <= 0)
        return r;
    r.impulse = (1 + e) * r.approach / (ka + kb);
    r.a.velocity = a.velocity + -r.impulse * a.inverse_mass * n;
    r.a.spin -= r.impulse * a.inverse_inertia * lever(a);
    r.b.velocity = b.velocity + r.impulse * b.inverse_mass * n;
    r.b.spin += r.impulse * b.inverse_inertia * lever(b);
    return r;
}

enum class Kind
{
    CircleCircle,
    CircleFace,
    CornerFace,
    CapsuleFace,
    CapsuleCapsule,
    CircleCapsule,
};

struct Pair
{
    BodyId a{};
    BodyId b{};
    ShapeId shape_a{};
    ShapeId shape_b{};
    D2 point;
    D2 normal; // from a to b
    double e = 0;
    Kind kind{};
};

struct Side
{
    BodyType type = BodyType::Dynamic;
    bool off_center = false;
};

void give_mass(Scene& scene, BodyId id, Random& random, bool off_center)
{
    if (scene.body(id).type() != BodyType::Dynamic)
        return;
    const float m = random.rangef(0.2, 5);
    scene.body(id).set_mass(
        {.mass = m, .center = off_center ? random.vec(0.3) : Vec2{}, .inertia = m * random.rangef(0.05, 0.6)});
}

// One of the two shapes of a pair: its frame lies where its surface goes through the common point.
struct Half
{
    Geometry geometry{};
    D2 at;
    double angle = 0;
};

// Turned by theta, with its surface's outward normal there.
Half lower_half(Random& random, Kind kind, D2 point, double theta)
{
    const D2 n = turned(theta, {0, 1});
    const D2 t = turned(theta, {1, 0});
    const auto place = [&](const Geometry& geometry, double height, double reach)
    {
        const double offset = reach > 0 ? random.range(-reach, reach) : 0; // along the face
        return Half{geometry, point + -height * n + -offset * t, theta};
    };
    switch (kind)
    {
    case Kind::CircleCircle:
    case Kind::CircleCapsule: return place(Circle{.radius = 0.5f}, 0.5, 0);
    case Kind::CapsuleCapsule: return place(Capsule{{-0.75f, 0}, {0.75f, 0}, 0.25f, 0.25f}, 0.25, 0.6);
    default: return place(box(1, 0.5f), 0.5, 0.8);
    }
}

// A circle, a box on its corner, or a capsule with one round end down.
Half upper_half(Random& random, Kind kind, D2 point, double theta)
{
    const D2 n = turned(theta, {0, 1});
    if (kind == Kind::CircleCircle || kind == Kind::CircleFace)
        return {Circle{.radius = 0.25f}, point + 0.25 * n, theta};
    if (kind == Kind::CornerFace)
    {
        const double angle = theta + 0.7853981633974483 + random.range(-0.5, 0.5);
        return {box(0.5f, 0.5f), point + -1.0 * turned(angle, {-0.5, -0.5}), angle};
    }
    const double angle = theta + random.range(-0.9, 0.9);
    return {Capsule{{0, 0}, {0, 1}, 0.25f, 0.125f}, point + 0.25 * n, angle};
}

BodyId add_half(Scene& scene, const Half& half, Side side)
{
    return scene.create_body({.type = side.type, .position = {half.at.x, half.at.y}, .angle = static_cast<float>(half.angle)});
}

// Both shapes touch at a random point, but for a gap of a few roundings.
Pair make_pair(Scene& scene, Random& random, Kind kind, Side side_a, Side side_b, double gap)
{
    const double theta = random.range(-3.1, 3.1);
    const D2 point{random.range(-2, 2), random.range(-2, 2)};
    const float ea = random.rangef(0, 1);
    const float eb = random.rangef(0, 1);
    const D2 n = turned(theta, {0, 1});
    const Half a = lower_half(random, kind, point, theta);
    Half b = upper_half(random, kind, point, theta);
    b.at = b.at + gap * n;
    Pair pair{.point = point, .normal = n, .e = 0.5 * (static_cast<double>(ea) + static_cast<double>(eb)), .kind = kind};
    pair.a = add_half(scene, a, side_a);
    pair.b = add_half(scene, b, side_b);
    pair.shape_a = scene.create_shape(pair.a, a.geometry, {.friction = 0, .restitution = ea});
    pair.shape_b = scene.create_shape(pair.b, b.geometry, {.friction = 0, .restitution = eb});
    give_mass(scene, pair.a, random, side_a.off_center);
    give_mass(scene, pair.b, random, side_b.off_center);
    return pair;
}

// Random motion with the wanted approach speed at the point.
void give_motion(Scene& scene, Random& random, const Pair& pair, double approach)
{
    for (const BodyId id : {pair.a, pair.b})
    {
        if (scene.body(id).type() == BodyType::Static)
            continue;
        scene.body(id).set_velocity(random.vec(3));
        scene.body(id).set_angular_velocity(random.rangef(-3, 3));
    }
    const double now = collide(read(scene, pair.a), read(scene, pair.b), pair.point, pair.normal, 0).approach;
    const BodyId mover = scene.body(pair.b).type() == BodyType::Dynamic ? pair.b : pair.a;
    const double sign = mover == pair.b ? -1 : 1;
    const double change = sign * (approach - now);
    const Vec2 v = scene.body(mover).velocity();
    scene.body(mover).set_velocity(v +
                                   Vec2{static_cast<float>(change * pair.normal.x), static_cast<float>(change * pair.normal.y)});
}

constexpr float tiny_step = 1e-6f; // so short that spin does not turn the pair before or after the impact

void expect_velocity(Scene& scene, BodyId id, const Moving& want, double tolerance, const char* who)
{
    const Body b = scene.body(id);
    EXPECT_NEAR(b.velocity().x, want.velocity.x, tolerance) << who;
    EXPECT_NEAR(b.velocity().y, want.velocity.y, tolerance) << who;
    EXPECT_NEAR(b.angular_velocity(), want.spin, 4 * tolerance) << who; // inverse inertia is up to 20 inverse masses
}

void check_impact(std::uint64_t seed, Kind kind, Side side_a, Side side_b)
{
    SCOPED_TRACE("seed " + std::to_string(seed) + " kind " + std::to_string(static_cast<int>(kind)));
    Random random(seed);
    Scene scene(weightless());
    const Pair pair = make_pair(scene, random, kind, side_a, side_b, -1e-6);
    give_motion(scene, random, pair, random.range(0.5, 20));
    const Reference want = collide(read(scene, pair.a), read(scene, pair.b), pair.point, pair.normal, pair.e);
    scene.step(tiny_step);
    ASSERT_EQ(scene.impacts().size(), 1u);
    const ImpactEvent& hit = scene.impacts()[0];
    const bool same_order = hit.shape_a == pair.shape_a;
    const double scale = want.approach;
    EXPECT_NEAR(hit.approach_speed, want.approach, 3e-5 * scale + 1e-5);
    EXPECT_NEAR(hit.impulse, want.impulse, 5e-5 * want.impulse + 1e-5);
    EXPECT_NEAR(hit.restitution, pair.e, 1e-6);
    const double sign = same_order ? 1 : -1;
    EXPECT_NEAR(hit.normal.x, sign * pair.normal.x, 1e-5);
    EXPECT_NEAR(hit.normal.y, sign * pair.normal.y, 1e-5);
    EXPECT_NEAR(hit.point.x, pair.point.x, 1e-3);
    EXPECT_NEAR(hit.point.y, pair.point.y, 1e-3);
    EXPECT_NEAR(hit.friction_impulse, 0, 1e-7);
    expect_velocity(scene, pair.a, want.a, 1e-4 * (1 + scale), "a");
    expect_velocity(scene, pair.b, want.b, 1e-4 * (1 + scale), "b");
    // The event's own terms give its impulse, as its comment promises.
    const double ka = hit.effective_mass_a > 0 ? 1 / static_cast<double>(hit.effective_mass_a) : 0;
    const double kb = hit.effective_mass_b > 0 ? 1 / static_cast<double>(hit.effective_mass_b) : 0;
    const double from_terms = (1 + static_cast<double>(hit.restitution)) *
                              (static_cast<double>(hit.speed_a) - static_cast<double>(hit.speed_b)) / (ka + kb);
    EXPECT_NEAR(hit.impulse, from_terms, 5e-5 * want.impulse + 1e-5);
    const auto kinetic_of = [](const Moving& m)
    {
        const double turning = m.inverse_inertia > 0 ? m.spin * m.spin / m.inverse_inertia : 0;
        return 0.5 * ((m.inverse_mass > 0 ? dot(m.velocity, m.velocity) / m.inverse_mass : 0) + turning);
    };
    // 1/2 (1 - e²) µ u² holds against moving walls too; without one it is the plain difference of the energies.
    const double lost = 0.5 * (1 - pair.e * pair.e) * want.approach * want.approach / (ka + kb);
    if (side_a.type == BodyType::Dynamic && side_b.type == BodyType::Dynamic)
    {
        const double before = kinetic_of(read(scene, pair.a)) + kinetic_of(read(scene, pair.b));
        EXPECT_NEAR(kinetic_of(want.a) + kinetic_of(want.b), before, 1e-3 * (1 + before));
    }
    if (side_a.type != BodyType::Kinematic)
    {
        EXPECT_NEAR(hit.energy_lost, lost, 1e-3 * (1 + lost));
    }
}

void check_separating(std::uint64_t seed, Kind kind, Side side_a, Side side_b)
{
    SCOPED_TRACE("seed " + std::to_string(seed) + " kind " + std::to_string(static_cast<int>(kind)));
    Random random(seed);
    Scene scene(weightless());
    const Pair pair = make_pair(scene, random, kind, side_a, side_b, 1e-6);
    give_motion(scene, random, pair, -random.range(0.1, 10));
    const Moving a = read(scene, pair.a);
    const Moving b = read(scene, pair.b);
    scene.step(tiny_step);
    EXPECT_TRUE(scene.impacts().empty());
    expect_velocity(scene, pair.a, a, 1e-6, "a");
    expect_velocity(scene, pair.b, b, 1e-6, "b");
}

constexpr Kind kinds[] = {Kind::CircleCircle, Kind::CircleFace,     Kind::CornerFace,
                          Kind::CapsuleFace,  Kind::CapsuleCapsule, Kind::CircleCapsule};

Kind kind_of(int i) { return kinds[static_cast<std::size_t>(i) % std::size(kinds)]; }

} // namespace

TEST(Row05_ResolveCollision, ThousandRandomPairsFollowTheFormula)
{
    for (int i = 0; i < 1000; ++i)
    {
        check_impact(static_cast<std::uint64_t>(i) + 1, kind_of(i), {}, {});
        if (::testing::Test::HasFailure())
            return; // the first one tells
    }
}

TEST(Row05_ResolveCollision, PairsWhoseMassIsOffTheirCenter)
{
    for (int i = 0; i < 600; ++i)
    {
        check_impact(static_cast<std::uint64_t>(i) + 5001, kind_of(i), {.off_center = true}, {.off_center = true});
        if (::testing::Test::HasFailure())
            return;
    }
}

TEST(Row05_ResolveCollision, SeparatingPairsGetNothing)
{
    for (int i = 0; i < 600; ++i)
    {
        check_separating(static_cast<std::uint64_t>(i) + 9001, kind_of(i), {}, {});
        if (::testing::Test::HasFailure())
            return;
    }
}

TEST(Row05_ResolveCollision, StaticIsInfinitelyHeavy)
{
    for (int i = 0; i < 300; ++i)
    {
        check_impact(static_cast<std::uint64_t>(i) + 12001, kind_of(i), {BodyType::Static}, {});
        if (::testing::Test::HasFailure())
            return;
    }
}

TEST(Row05_ResolveCollision, KinematicIsInfinitelyHeavyAndItsSurfaceSpeedCounts)
{
    for (int i = 0; i < 300; ++i)
    {
        check_impact(static_cast<std::uint64_t>(i) + 15001, kind_of(i), {BodyType::Kinematic}, {});
        if (::testing::Test::HasFailure())
            return;
    }
}

TEST(Row05_ResolveCollision, PlaneIsInfinitelyHeavy)
{
    for (const float e : {0.0f, 0.4f, 1.0f})
    {
        Scene scene(weightless());
        add_static(scene, HalfSpace{}, {.friction = 0, .restitution = e});
        const Thing ball = add_dynamic(scene, {0, 0.5}, Circle{}, {.density = 3, .friction = 0, .restitution = e}, {2, -7});
        scene.step(tiny_step);
        ASSERT_EQ(scene.impacts().size(), 1u);
        EXPECT_NEAR(scene.body(ball.body).velocity().y, 7 * e, 1e-5);
        EXPECT_NEAR(scene.body(ball.body).velocity().x, 2, 1e-6);
        EXPECT_NEAR(scene.impacts()[0].impulse, static_cast<double>(1 + e) * scene.body(ball.body).mass() * 7, 1e-4);
        EXPECT_EQ(scene.impacts()[0].effective_mass_a == 0 || scene.impacts()[0].effective_mass_b == 0, true);
    }
}

// The same law where the pair meets within a step of the usual size, far from the world's origin too.
TEST(Row05_ResolveCollision, BallsThatMeetInFlight)
{
    for (const double far : {0.0, 1e5})
    {
        Scene scene(weightless());
        const Thing a =
            add_dynamic(scene, {far - 0.6, 0}, Circle{.radius = 0.25f}, {.friction = 0, .restitution = 0.8f}, {30, 0});
        const Thing b = add_dynamic(scene, {far + 0.6, 0}, Circle{.radius = 0.25f},
                                    {.density = 3, .friction = 0, .restitution = 0.8f}, {-20, 0});
        scene.step(1.0f / 60);
        ASSERT_EQ(scene.impacts().size(), 1u);
        const double m1 = scene.body(a.body).mass();
        const double m2 = scene.body(b.body).mass();
        const double j = 1.8 * m1 * m2 / (m1 + m2) * 50;
        EXPECT_NEAR(scene.impacts()[0].impulse, j, 1e-4);
        EXPECT_NEAR(scene.impacts()[0].time, 0.7 / 50, 1e-6);
        EXPECT_NEAR(scene.impacts()[0].point.x, far - 0.35 + 30 * 0.7 / 50, 1e-5);
        EXPECT_NEAR(scene.body(a.body).velocity().x, 30 - j / m1, 1e-4);
        EXPECT_NEAR(scene.body(b.body).velocity().x, -20 + j / m2, 1e-4);
        // After the impact the rest of the step is flown.
        const double left = 1.0 / 60 - 0.014;
        EXPECT_NEAR(scene.body(a.body).position().x, far - 0.6 + 30 * 0.014 + (30 - j / m1) * left, 1e-5);
    }
}

TEST(Row05_ResolveCollision, RestitutionIsTheAverageAndTheRuleCanBeChanged)
{
    const auto bounce = [](SceneDef def, ShapeDef a, ShapeDef b)
    {
        def.gravity = {};
        Scene scene(def);
        add_static(scene, HalfSpace{}, a);
        const Thing ball = add_dynamic(scene, {0, 0.6}, Circle{}, b, {0, -10});
        steps(scene, 2);
        return static_cast<double>(scene.body(ball.body).velocity().y) / 10;
    };
    const ShapeDef a{.restitution = 0.2f};
    const ShapeDef b{.restitution = 0.8f};
    EXPECT_NEAR(bounce({}, a, b), 0.5, 1e-6);
    EXPECT_NEAR(bounce({.restitution_rule = MixRule::Minimum}, a, b), 0.2, 1e-6);
    EXPECT_NEAR(bounce({.restitution_rule = MixRule::Maximum}, a, b), 0.8, 1e-6);
    EXPECT_NEAR(bounce({.restitution_rule = MixRule::Product}, a, b), 0.16, 1e-6);
    EXPECT_NEAR(bounce({.restitution_rule = MixRule::GeometricMean}, a, b), 0.4, 1e-6);
    ShapeDef yielding = b;
    yielding.yields_material = true;
    EXPECT_NEAR(bounce({.restitution_rule = MixRule::OtherDecides}, a, yielding), 0.2, 1e-6);
    EXPECT_NEAR(bounce({.restitution_rule = MixRule::OtherDecides}, a, b), 0.5, 1e-6);
    SceneDef function;
    function.restitution_rule = MixRule::Function;
    function.mix_function = [](MixedValue what, float x, std::uint64_t, float y, std::uint64_t)
    { return what == MixedValue::Restitution ? 0.3f * x + 0.3f * y : 0; };
    EXPECT_NEAR(bounce(function, a, b), 0.3, 1e-6);
}

TEST(Row05_ResolveCollision, RestitutionCurveFollowsTheApproachSpeed)
{
    ShapeDef rubber;
    rubber.restitution_curve.count = 3;
    rubber.restitution_curve.points[0] = {1, 0.9f};
    rubber.restitution_curve.points[1] = {5, 0.5f};
    rubber.restitution_curve.points[2] = {10, 0.1f};
    const auto curve = [](double u)
    {
        return u <= 1 ? 0.9 : u <= 5 ? 0.9 - 0.1 * (u - 1) : u <= 10 ? 0.5 - 0.08 * (u - 5) : 0.1;
    };
    for (const float u : {0.5f, 1.0f, 3.0f, 5.0f, 8.0f, 10.0f, 30.0f})
    {
        Scene scene(weightless());
        add_static(scene, HalfSpace{}, rubber);
        const Thing ball = add_dynamic(scene, {0, 0.5}, Circle{}, rubber, {0, -u});
        steps(scene, 1);
        EXPECT_NEAR(scene.body(ball.body).velocity().y, curve(u) * static_cast<double>(u), 1e-5 * static_cast<double>(u))
            << "approach " << u;
    }
}
