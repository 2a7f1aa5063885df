// A game loop: frames come when they come, the physics takes fixed steps, and what is drawn lies between two of them.
// update() keeps the remainder of time in the scene, so that the simulation is the same at any frame rate: forces act for the time of the frame that they are
// applied in, and events are those of all the steps of a frame, each once.
#include <carom/carom.h>
#include <cmath>
#include <cstdio>

namespace {

struct Game
{
    carom::Scene scene{{.fixed_step = 1.0f / 120}};
    carom::BodyId lift{};
    carom::BodyId crate{};
    carom::BodyId ball{};
    int bounces = 0;
};

Game make_game()
{
    Game game;
    game.lift = game.scene.create_body({.type = carom::BodyType::Kinematic, .velocity = {0, 1}});
    game.scene.create_shape(game.lift, carom::box(1, 0.1f));
    game.crate = game.scene.create_body({.type = carom::BodyType::Dynamic, .position = {0, 0.41}});
    game.scene.create_shape(game.crate, carom::box(0.3f, 0.3f));
    const carom::BodyId ground = game.scene.create_body({});
    game.scene.create_shape(ground, carom::HalfSpace{.offset = -1});
    game.ball = game.scene.create_body({.type = carom::BodyType::Dynamic, .position = {3, 0}});
    game.scene.create_shape(game.ball, carom::Circle{.radius = 0.2f}, {.restitution = 1});
    return game;
}

// Plays one second in frames of the given length and returns the height at which the crate would be drawn.
double play(Game& game, float frame_time, int frames)
{
    double drawn = 0;
    for (int i = 0; i < frames; ++i)
    {
        game.scene.body(game.ball).apply_force({0.1f, 0}); // a wind
        const carom::UpdateResult update = game.scene.update(frame_time);
        game.bounces += static_cast<int>(game.scene.impacts().size());
        drawn = game.scene.body(game.crate).interpolated_pose(update.alpha).position.y;
        if (game.scene.report().has(carom::StepFlag::TimeDropped))
            std::printf("a frame took too long, time was dropped\n");
    }
    return drawn;
}

} // namespace

int main()
{
    Game smooth = make_game();
    Game jerky = make_game();
    const double a = play(smooth, 1.0f / 144, 144);
    const double b = play(jerky, 1.0f / 20, 20);
    std::printf("at 144 frames a second the crate is drawn at %.3f m, at 20 at %.3f m\n", a, b);
    std::printf("the ball bounced %d and %d times and came to %.3f and %.3f m\n", smooth.bounces, jerky.bounces,
                smooth.scene.body(smooth.ball).position().x, jerky.scene.body(jerky.ball).position().x);
    const double lifted = 1.0 - 1.0 / 120; // the frame shown lies one step behind the simulation
    return std::abs(a - (0.4 + lifted)) < 0.02 && std::abs(a - b) < 0.02 && smooth.bounces == jerky.bounces ? 0 : 1;
}
