// 5. A disc rolls and a box slides down a slope; and the angle at which a box begins to slide.

#include "truth/experiments/experiments.h"

namespace truth {
namespace {

constexpr double g = -earth.y;

struct Slope
{
    std::unique_ptr<World> world{};
    Body body = 0;
    double angle = 0;

    /// How far the body is down the slope.
    [[nodiscard]] double distance() const { return dot(world->state(body).position, -direction(angle)); }
};

/// Something of this height above its underside, at rest on a slope that falls to the left.
Slope on_slope(const Setup& setup, double angle, double friction, const Shape& shape, double height)
{
    Slope slope{.world = setup.world(earth), .angle = angle};
    const Material material{.friction = friction};
    const Body ramp = slope.world->add_body({.motion = Motion::Static, .angle = angle});
    slope.world->add_shape(ramp, box(200, 2, {0, -1}), material);
    const bool turned = std::holds_alternative<Polygon>(shape);
    slope.body = slope.world->add_body({.position = height * perp(direction(angle)), .angle = turned ? angle : 0});
    slope.world->add_shape(slope.body, shape, material);
    return slope;
}

Slope disc_on_slope(const Setup& setup, double angle, double friction)
{
    return on_slope(setup, angle, friction, Disc{0.25}, 0.25);
}

Slope box_on_slope(const Setup& setup, double angle, double friction)
{
    return on_slope(setup, angle, friction, box(0.5, 0.5), 0.25);
}

void run(const Setup& setup, Slope& slope, double seconds)
{
    for (int step = 0; step < setup.steps(seconds); ++step)
    {
        slope.world->step(setup.dt());
    }
}

/// From three places at equal distances in time: what settles in before the first does not count.
double acceleration(const Setup& setup, Slope slope)
{
    run(setup, slope, 0.5);
    const double first = slope.distance();
    run(setup, slope, 0.75);
    const double second = slope.distance();
    run(setup, slope, 0.75);
    const double interval = setup.steps(0.75) * setup.dt();
    return (slope.distance() - 2 * second + first) / (interval * interval);
}

double moved(const Setup& setup, Slope slope, double from, double to)
{
    run(setup, slope, from);
    const double start = slope.distance();
    run(setup, slope, to - from);
    return slope.distance() - start;
}

constexpr double threshold_friction = 0.5;
constexpr double threshold_distance = 0.005; ///< moved between 0.5 and 4 s

/// Halves the interval until it is far narrower than the bound.
double bisect(double low, double high, const std::function<bool(double)>& slides)
{
    while (high - low > radians(1e-4))
    {
        const double middle = (low + high) / 2;
        (slides(middle) ? high : low) = middle;
    }
    return (low + high) / 2;
}

double measured_threshold(const Setup& setup)
{
    return bisect(radians(5), radians(35),
                  [&](double angle)
                  {
                      setup.tell("slope");
                      return moved(setup, box_on_slope(setup, angle, threshold_friction), 0.5, 4) > threshold_distance;
                  });
}

/// Where Coulomb's law moves the box by the same distance: a little above atan mu.
double exact_threshold()
{
    return bisect(radians(5), radians(35),
                  [](double angle)
                  {
                      const double a = g * (std::sin(angle) - threshold_friction * std::cos(angle));
                      return a > 0 && a / 2 * (4 * 4 - 0.5 * 0.5) > threshold_distance;
                  });
}

} // namespace

Metrics inclines(const Setup& setup)
{
    const double rolling = acceleration(setup, disc_on_slope(setup, radians(20), 0.9));
    const double sliding = acceleration(setup, box_on_slope(setup, radians(30), 0.3));
    const double exact_rolling = g * std::sin(radians(20)) * 2 / 3;
    const double exact_sliding = g * (std::sin(radians(30)) - 0.3 * std::cos(radians(30)));
    const double below = std::atan(threshold_friction) - radians(1);
    const double creep = moved(setup, box_on_slope(setup, below, threshold_friction), 1, 11);
    return {{5, "rolling disc: acceleration error, %", 0, (rolling / exact_rolling - 1) * 100, 0.01},
            {5, "sliding box: acceleration error, %", 0, (sliding / exact_sliding - 1) * 100, 0.01},
            {5, "slip threshold, deg", degrees(exact_threshold()), degrees(measured_threshold(setup)), 0.01},
            {5, "creep 1 deg below the threshold, mm in 10 s", 0, creep * 1000, none}};
}

} // namespace truth
