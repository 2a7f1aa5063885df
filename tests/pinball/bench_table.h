#pragma once

/// @file
/// Small tables made in code, and balls put where a test wants them.

#include "pinball/elements/playfield.h"

#include <utility>

namespace carom::pinball::test {

inline constexpr Index ball_material = 0;
inline constexpr Index wall_material = 1;

inline float radians(float degrees) { return degrees * pi / 180; }

/// A table without any element: 80 g balls of 27 mm, 6.5 degrees.
inline Table bare_table(float slope_deg = 6.5f, float mu_playfield = 0.12f)
{
    Table table;
    table.name = "bench";
    table.size = {2, 3};
    table.physics = {.g = 9.81f, .slope = radians(slope_deg), .step = 0.001f, .mu_playfield = mu_playfield};
    table.materials = {{.name = "ball", .restitution = 0.9f, .friction = 0.05f},
                       {.name = "wall", .restitution = 0.5f, .friction = 0.2f}};
    table.ball = {.radius = 0.0135f, .mass = 0.08f, .spawn = {0.5f, 0.5f}, .material = ball_material};
    return table;
}

inline Index add(Table& table, Part part, int score = 0, Index material = wall_material)
{
    const auto index = static_cast<Index>(table.elements.size());
    std::string id = "e";
    id += std::to_string(index); // a sum here sets off a false warning of g++ 12
    table.elements.push_back({.id = std::move(id), .part = std::move(part), .material = material, .score = score});
    return index;
}

/// A straight wall.
inline Wall wall(Vec2 a, Vec2 b) { return {Chain{.start = a, .pieces = {{b}}}}; }

/// A ball on its way; rolling, or sliding without any spin. The reference holds until the next ball.
inline Ball& shoot(Playfield& field, Vec2 position, Vec2 velocity, bool rolling = false)
{
    Ball& ball = field.add_ball(position);
    field.scene().body(ball.state.body).set_velocity(velocity);
    ball.state.velocity = velocity;
    ball.state.rolling = rolling ? velocity : Vec2{};
    return ball;
}

inline void run(Playfield& field, int steps, const Buttons& buttons = {})
{
    for (int i = 0; i < steps; ++i)
        field.step(buttons);
}

/// Steps until an event of this kind comes; false when it does not within the limit.
inline bool run_until(Playfield& field, EventKind kind, int limit, const Buttons& buttons = {})
{
    for (int i = 0; i < limit; ++i)
    {
        field.step(buttons);
        for (const GameEvent& event : field.events())
            if (event.kind == kind)
                return true;
    }
    return false;
}

inline int count(std::span<const GameEvent> events, EventKind kind)
{
    int found = 0;
    for (const GameEvent& event : events)
        found += event.kind == kind ? 1 : 0;
    return found;
}

} // namespace carom::pinball::test
