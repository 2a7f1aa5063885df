// Shapes: what their geometries and definitions refuse.

#include "contracts/contract.h"

using namespace carom;
using namespace carom::test;

TEST_F(Contract, SizesOfGeometries)
{
    for (const float bad : {not_a_number, infinite, -infinite, 0.0f, -1.0f})
    {
        geometry_refused(Circle{.radius = bad}, "radius");
        geometry_refused(Capsule{.radius_a = bad}, "radius_a");
        geometry_refused(Capsule{.radius_b = bad}, "radius_b");
        geometry_refused(Arc{.radius = bad}, "radius", fixed.body);
    }
    for (const float bad : {not_a_number, infinite, -infinite, -1.0f})
    {
        geometry_refused(Segment{.half_thickness = bad}, "half_thickness");
        geometry_refused(Arc{.half_thickness = bad}, "half_thickness", fixed.body);
        geometry_refused(Chain{.pieces = {{.end = {1, 0}}}, .half_thickness = bad}, "half_thickness", fixed.body);
        Polygon round = box(1, 1);
        round.radius = bad;
        geometry_refused(round, "radius");
    }
}

TEST_F(Contract, PlacesOfGeometries)
{
    for (const float bad : {not_a_number, infinite, -infinite})
    {
        geometry_refused(Circle{.center = {bad, 0}}, "center");
        geometry_refused(Circle{.center = {0, bad}}, "center");
        geometry_refused(Capsule{.a = {bad, 0}}, "Capsule.a");
        geometry_refused(Capsule{.b = {0, bad}}, "Capsule.b");
        geometry_refused(Segment{.a = {bad, 0}}, "Segment.a");
        geometry_refused(Segment{.b = {bad, 0}}, "Segment.b");
        geometry_refused(Polygon{{{0, 0}, {1, 0}, {bad, 1}}}, "vertices");
        geometry_refused(Arc{.center = {bad, 0}}, "center", fixed.body);
        geometry_refused(Arc{.start_angle = bad}, "start_angle", fixed.body);
        geometry_refused(Arc{.sweep = bad}, "sweep", fixed.body);
        geometry_refused(HalfSpace{.normal = {bad, 1}}, "normal", fixed.body);
        geometry_refused(HalfSpace{.offset = bad}, "offset", fixed.body);
        geometry_refused(Chain{.start = {bad, 0}, .pieces = {{.end = {1, 0}}}}, "start", fixed.body);
        geometry_refused(Chain{.pieces = {{.end = {bad, 0}}}}, "end", fixed.body);
        geometry_refused(Chain{.pieces = {{.end = {1, 0}, .sweep = bad}}}, "sweep", fixed.body);
    }
}

TEST_F(Contract, PlacesAndSizesBeyondAllMeasure)
{
    for (const float far : {1.1e8f, 1e25f, 3e38f})
    {
        const auto in_scene = [&](const Geometry& geometry, const char* field)
        {
            geometry_refused(geometry, field, fixed.body);
            refused([&] { scene.shape(fixed.shape).set_geometry(geometry); }, {"Shape::set_geometry", field});
        };
        in_scene(Circle{.center = {far, 0}}, "Circle.center");
        in_scene(Circle{.center = {0, -far}}, "Circle.center");
        in_scene(Circle{.radius = far}, "Circle.radius");
        in_scene(Polygon{{{0, 0}, {far, 0}, {far, far}}}, "Polygon.vertices");
        in_scene(Capsule{.a = {-far, 0}}, "Capsule.a");
        in_scene(Capsule{.b = {far, 0}}, "Capsule.b");
        in_scene(Segment{.a = {-far, 0}}, "Segment.a");
        in_scene(Segment{.b = {far, 0}}, "Segment.b");
        in_scene(Segment{.half_thickness = far}, "Segment.half_thickness");
        in_scene(Arc{.center = {far, 0}}, "Arc.center");
        in_scene(Arc{.radius = far}, "Arc.radius");
        in_scene(Chain{.start = {far, 0}, .pieces = {{.end = {1, 0}}}}, "Chain.start");
        in_scene(Chain{.pieces = {{.end = {far, 0}}}}, "Chain.pieces.end");
        in_scene(Chain{.pieces = {{.end = {1, 0}, .sweep = 1 / far}}}, "Chain.pieces.sweep");
        in_scene(HalfSpace{.offset = -far}, "HalfSpace.offset");
    }
    EXPECT_NO_THROW(scene.create_shape(fixed.body, Circle{.center = {9e7f, -9e7f}, .radius = 9e7f}));
    EXPECT_NO_THROW(scene.create_shape(fixed.body, Chain{.pieces = {{.end = {1, 0}, .sweep = 2e-8f}}}));
}

TEST_F(Contract, MassesBeyondFloats)
{
    const Polygon large{{{0, 0}, {9e7f, 0}, {9e7f, 9e7f}}};
    const auto mass_refused = [&](const Geometry& geometry, float density, const char* field)
    {
        refused([&] { scene.create_shape(ball.body, geometry, {.density = density}); }, {"Scene::create_shape", field});
        const ShapeId shape = scene.create_shape(crate.body, geometry, {.density = 0});
        refused([&] { scene.shape(shape).set_def({.density = density}); }, {"Shape::set_def", field});
        scene.destroy(shape);
        scene.shape(crate.shape).set_def({.density = density});
        refused([&] { scene.shape(crate.shape).set_geometry(geometry); }, {"Shape::set_geometry", field});
        scene.shape(crate.shape).set_def({});
    };
    mass_refused(large, 1e30f, "the shape's mass");
    mass_refused(large, 1e6f, "the shape's moment of inertia");
    mass_refused(Circle{.radius = 1e-5f}, 1e-30f, "the shape's mass");
    mass_refused(Circle{.radius = 1e-10f}, 1, "the shape's moment of inertia");
    // A shape without mass has no limits of it.
    EXPECT_NO_THROW(scene.create_shape(ball.body, large, {.density = 0}));
    EXPECT_NO_THROW(scene.create_shape(ball.body, large, {.density = 1e30f, .trigger = true}));
    EXPECT_NO_THROW(scene.create_shape(ball.body, large));
    EXPECT_TRUE(std::isfinite(scene.body(ball.body).mass()) && std::isfinite(scene.body(ball.body).inertia()));
}

TEST_F(Contract, Outlines)
{
    geometry_refused(Polygon{}, "vertices");
    geometry_refused(Polygon{{{0, 0}, {1, 0}}}, "vertices");
    geometry_refused(Polygon{{{0, 0}, {1, 0}, {2, 0}}}, "vertices");
    geometry_refused(Polygon{{{0, 0}, {1, 0}, {1, 0}, {0, 0}}}, "vertices");
    geometry_refused(Polygon{{{0, 0}, {2, 0}, {1, 0.5f}, {1, 2}}}, "vertices"); // concave
    geometry_refused(Polygon{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}, "vertices");    // crosses itself
    geometry_refused(Polygon{{{0, 1}, {0.5878f, -0.809f}, {-0.951f, 0.309f}, {0.951f, 0.309f}, {-0.5878f, -0.809f}}},
                     "vertices"); // a pentagram turns twice
}

TEST_F(Contract, GeometriesWithoutExtent)
{
    geometry_refused(Segment{{1, 1}, {1, 1}}, "Segment.b");
    geometry_refused(Capsule{.a = {1, 1}, .b = {1, 1}}, "Capsule.b");
    geometry_refused(Capsule{.a = {0, 0}, .b = {0.1f, 0}, .radius_a = 1, .radius_b = 0.2f}, "Capsule.b");
    geometry_refused(HalfSpace{.normal = {0, 0}}, "normal", fixed.body);
    geometry_refused(Arc{.sweep = 0}, "sweep", fixed.body);
    geometry_refused(Arc{.sweep = 7}, "sweep", fixed.body);
    geometry_refused(Arc{.sweep = -7}, "sweep", fixed.body);
    geometry_refused(Arc{.radius = 1, .half_thickness = 1}, "half_thickness", fixed.body);
    geometry_refused(Chain{}, "pieces", fixed.body);
    geometry_refused(Chain{.pieces = {{.end = {0, 0}}}}, "end", fixed.body);
    geometry_refused(Chain{.pieces = {{.end = {1, 0}, .sweep = 2 * pi}}}, "sweep", fixed.body);
}

TEST_F(Contract, MasslessGeometriesOnWhatMovesFreely)
{
    geometry_refused(Arc{}, "", ball.body);
    geometry_refused(Chain{.pieces = {{.end = {1, 0}}}}, "", ball.body);
    geometry_refused(HalfSpace{}, "", ball.body);
    geometry_refused(HalfSpace{}, "", bar.body);
}

TEST_F(Contract, BoxHelper)
{
    for (const float bad : {not_a_number, infinite, 0.0f, -1.0f})
    {
        refused([&] { static_cast<void>(box(bad, 1)); }, {"box", "half_width"});
        refused([&] { static_cast<void>(box(1, bad)); }, {"box", "half_height"});
    }
    refused([&] { static_cast<void>(box(1, 1, {not_a_number, 0})); }, {"box", "center"});
    refused([&] { static_cast<void>(box(1, 1, {}, infinite)); }, {"box", "angle"});
    refused([&] { static_cast<void>(box(1, 1, {}, 0, -1)); }, {"box", "radius"});
}

TEST_F(Contract, ShapeDefinitions)
{
    for (const float bad : {not_a_number, infinite, -infinite, -1.0f})
    {
        def_refused({.density = bad}, "density");
        def_refused({.friction = bad}, "friction");
        def_refused({.restitution = bad}, "restitution");
        def_refused({.rolling_resistance = bad}, "rolling_resistance");
        def_refused({.kick = {.speed = bad}}, "Kick::speed");
        def_refused({.kick = {.threshold = bad}}, "Kick::threshold");
        def_refused({.kick = {.cooldown = bad}}, "Kick::cooldown");
        def_refused({.trigger = true, .field = {.drag = bad}}, "Field::drag");
    }
    for (const float bad : {not_a_number, infinite, -infinite})
    {
        def_refused({.surface_speed = bad}, "surface_speed");
        def_refused({.one_way = {bad, 0}}, "one_way");
        def_refused({.trigger = true, .field = {.force = {bad, 0}}}, "Field::force");
        def_refused({.trigger = true, .field = {.acceleration = {0, bad}}}, "Field::acceleration");
    }
    def_refused({.restitution = 1.5f}, "restitution");
}

TEST_F(Contract, FieldsOnShapesThatAreNoTriggers)
{
    for (const Field& field : {Field{.force = {1, 0}}, Field{.acceleration = {0, 1}}, Field{.drag = 1}})
    {
        def_refused({.field = field}, "ShapeDef::field");
        refused([&] { scene.shape(zone.shape).set_def({.trigger = false, .field = field}); },
                {"Shape::set_def", "ShapeDef::field"});
        EXPECT_NO_THROW(scene.shape(zone.shape).set_def({.trigger = true, .field = field}));
    }
}

TEST_F(Contract, RestitutionCurves)
{
    RestitutionCurve curve;
    curve.count = 9;
    def_refused({.restitution_curve = curve}, "RestitutionCurve");
    curve.count = 2;
    curve.points[0] = {5, 0.5f};
    curve.points[1] = {1, 0.5f};
    def_refused({.restitution_curve = curve}, "RestitutionCurve"); // descending
    curve.points[1] = {6, 1.5f};
    def_refused({.restitution_curve = curve}, "RestitutionCurve");
    curve.points[1] = {6, not_a_number};
    def_refused({.restitution_curve = curve}, "RestitutionCurve");
    curve.points[0] = {-1, 0.5f};
    curve.points[1] = {6, 0.5f};
    def_refused({.restitution_curve = curve}, "RestitutionCurve");
    curve.points[0] = {not_a_number, 0.5f};
    def_refused({.restitution_curve = curve}, "RestitutionCurve");
}

TEST_F(Contract, SplitConcave)
{
    refused([&] { static_cast<void>(split_concave(std::vector<Vec2>{})); }, {"split_concave", "outline"});
    refused([&] { static_cast<void>(split_concave(std::vector<Vec2>{{0, 0}, {1, 0}})); }, {"split_concave", "outline"});
    refused([&] { static_cast<void>(split_concave(std::vector<Vec2>{{0, 0}, {1, 1}, {1, 0}, {0, 1}})); },
            {"split_concave", "outline"});
    refused([&] { static_cast<void>(split_concave(std::vector<Vec2>{{0, 0}, {1, not_a_number}, {1, 0}})); },
            {"split_concave", "outline"});
}
