// A scene keeps a shape as its leaves alone; Shape::geometry() is what was given, normalised, to the bit.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

namespace {

Geometry read_back(const Geometry& geometry)
{
    Scene scene(weightless());
    return scene.shape(scene.create_shape(scene.create_body({.type = BodyType::Static}), geometry)).geometry();
}

template <class Kind>
Kind read(const Kind& geometry)
{
    const Geometry back = read_back(geometry);
    EXPECT_TRUE(std::holds_alternative<Kind>(back));
    return std::holds_alternative<Kind>(back) ? std::get<Kind>(back) : Kind{};
}

void expect_same(const Chain& a, const Chain& b)
{
    EXPECT_EQ(a.start, b.start);
    EXPECT_EQ(a.closed, b.closed);
    EXPECT_EQ(a.half_thickness, b.half_thickness);
    EXPECT_EQ(a.sides, b.sides);
    ASSERT_EQ(a.pieces.size(), b.pieces.size());
    for (std::size_t i = 0; i < a.pieces.size(); ++i)
    {
        EXPECT_EQ(a.pieces[i].end, b.pieces[i].end) << i;
        EXPECT_EQ(a.pieces[i].sweep, b.pieces[i].sweep) << i;
    }
}

} // namespace

TEST(GeometryReadBack, ShapesOfOneLeaf)
{
    const Circle circle = read(Circle{{0.3f, -0.7f}, 0.1f});
    EXPECT_EQ(circle.center, (Vec2{0.3f, -0.7f}));
    EXPECT_EQ(circle.radius, 0.1f);

    const Polygon box_given = box(0.3f, 0.7f, {1.1f, 0.2f}, 0.37f, 0.05f);
    const Polygon polygon = read(box_given);
    EXPECT_EQ(polygon.vertices, box_given.vertices);
    EXPECT_EQ(polygon.radius, 0.05f);

    const Capsule capsule = read(Capsule{{0.1f, 0.2f}, {1.3f, 0.4f}, 0.11f, 0.22f});
    EXPECT_EQ(capsule.a, (Vec2{0.1f, 0.2f}));
    EXPECT_EQ(capsule.b, (Vec2{1.3f, 0.4f}));
    EXPECT_EQ(capsule.radius_a, 0.11f);
    EXPECT_EQ(capsule.radius_b, 0.22f);

    const Segment segment = read(Segment{{0.1f, 0.2f}, {1.3f, 0.4f}, 0.03f, Sides::Right});
    EXPECT_EQ(segment.a, (Vec2{0.1f, 0.2f}));
    EXPECT_EQ(segment.b, (Vec2{1.3f, 0.4f}));
    EXPECT_EQ(segment.half_thickness, 0.03f);
    EXPECT_EQ(segment.sides, Sides::Right);

    const Arc arc = read(Arc{{0.1f, 0.2f}, 1.7f, 0.9f, -2.3f, 0.03f, Sides::Left});
    EXPECT_EQ(arc.center, (Vec2{0.1f, 0.2f}));
    EXPECT_EQ(arc.radius, 1.7f);
    EXPECT_EQ(arc.start_angle, 0.9f);
    EXPECT_EQ(arc.sweep, -2.3f);
    EXPECT_EQ(arc.half_thickness, 0.03f);
    EXPECT_EQ(arc.sides, Sides::Left);

    const HalfSpace half_space = read(HalfSpace{{0, 1}, -3.5f});
    EXPECT_EQ(half_space.normal, (Vec2{0, 1}));
    EXPECT_EQ(half_space.offset, -3.5f);
}

TEST(GeometryReadBack, ChainsOfLinesAndArcs)
{
    const Chain open{.start = {0.1f, 0.2f},
                     .pieces = {{{1.3f, 0.4f}, 0}, {{2.2f, 1.7f}, 1.1f}, {{3.9f, 1.6f}, -0.7f}, {{5.1f, 0.3f}, 0}},
                     .closed = false,
                     .half_thickness = 0.02f,
                     .sides = Sides::Left};
    expect_same(read(open), open);
    const Chain one{.start = {0.1f, 0.2f}, .pieces = {{{1.3f, 0.4f}, 0.6f}}};
    expect_same(read(one), one);
    const Chain closed{
        .start = {0.1f, 0.2f}, .pieces = {{{1.3f, 0.4f}, 0}, {{1.2f, 1.7f}, 1.1f}, {{0.1f, 0.2f}, 0}}, .closed = true};
    expect_same(read(closed), closed);
}

TEST(GeometryReadBack, AClosedChainComesBackAsItWasNormalised)
{
    const Chain clockwise{.start = {0, 0}, .pieces = {{{0, 1}, 0}, {{1, 1}, -0.4f}, {{1, 0}, 0}}, .closed = true};
    const Chain normal = read(clockwise);
    ASSERT_EQ(normal.pieces.size(), 4u); // with the straight piece to its start
    EXPECT_EQ(normal.pieces[0].end, (Vec2{1, 0}));
    EXPECT_EQ(normal.pieces[2].sweep, 0.4f);
    expect_same(read(normal), normal);
}

TEST(GeometryReadBack, FollowsSetGeometry)
{
    Scene scene(weightless());
    const Thing t = add_dynamic(scene, {0, 0}, Circle{{0, 0}, 0.5f});
    scene.shape(t.shape).set_geometry(box(0.25f, 0.5f));
    const Geometry now = scene.shape(t.shape).geometry();
    ASSERT_TRUE(std::holds_alternative<Polygon>(now));
    EXPECT_EQ(std::get<Polygon>(now).vertices, box(0.25f, 0.5f).vertices);
}
