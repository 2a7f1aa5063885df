// Elements that stand still and only get in the way: walls, solids, posts, planes. Lights do not even do that.

#include "pinball/elements/make.h"
#include "pinball/elements/playfield.h"

namespace carom::pinball {

namespace {

DevicePtr scenery(Playfield& field, Index index, const Geometry& geometry)
{
    field.scene().create_shape(field.add_fixed(field.table().elements[index].enabled), geometry, field.surface(index));
    return std::make_unique<Device>(index);
}

} // namespace

DevicePtr make(Playfield& field, Index index, const Wall& wall) { return scenery(field, index, wall.path); }

DevicePtr make(Playfield& field, Index index, const Solid& solid) { return scenery(field, index, solid.path); }

DevicePtr make(Playfield& field, Index index, const Post& post) { return scenery(field, index, Circle{post.pos, post.radius}); }

DevicePtr make(Playfield& field, Index index, const Plane& plane)
{
    return scenery(field, index, HalfSpace{plane.normal, dot(plane.normal, plane.point)});
}

DevicePtr make(Playfield&, Index index, const Light&) { return std::make_unique<Device>(index); }

// A captive ball is a ball like any other; its element is what it is called in events.
DevicePtr make(Playfield& field, Index index, const CaptiveBall& ball)
{
    field.add_ball(ball.pos, index);
    return std::make_unique<Device>(index);
}

} // namespace carom::pinball
