#include "truth/pictures.h"

#include "truth/chart.h"
#include "truth/experiments/drop.h"
#include "truth/experiments/flipper.h"
#include "truth/experiments/pendulum.h"
#include "truth/random.h"

#include <array>

namespace truth {
namespace {

constexpr const char* exact_color = "#6e7781";

/// Colours that differ for everybody: ours, then the peers'.
std::string color_of(std::size_t engine)
{
    static const std::array<std::string, 4> colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7"};
    return colors[engine % colors.size()];
}

std::vector<Series> with_exact(Series exact, std::vector<Series> engines)
{
    engines.insert(engines.begin(), std::move(exact));
    return engines;
}

std::vector<Vec> apex_line(const Setup& setup, double height)
{
    Drop drop = drop_disc(setup, height, 1);
    std::vector<Vec> line{{0, 100}};
    for (const double apex : apexes(setup, drop, 10, 40))
    {
        line.push_back({static_cast<double>(line.size()), 100 * apex / height});
    }
    return line;
}

void draw_apexes(const std::vector<Setup>& setups, const std::filesystem::path& file)
{
    std::vector<Series> engines;
    for (std::size_t e = 0; e < setups.size(); ++e)
    {
        engines.push_back({setups[e].engine.name, color_of(e)});
        Random random(1);
        for (int i = 0; i < 20; ++i)
        {
            setups[e].tell("apexes");
            engines.back().lines.push_back(apex_line(setups[e], random.in(2, 8)));
        }
    }
    const Series exact{"exact", exact_color, Mark::Dashed, {{{0, 100}, {10, 100}}}};
    write_svg({"A ball that loses nothing, dropped from 20 heights", "bounces", "apex over the height it fell from, %",
               with_exact(exact, std::move(engines))},
              file);
}

/// Energy at each turning point, % of that at the start.
std::vector<Vec> energy_line(const Setup& setup, double release)
{
    const std::vector<double> angles = pendulum_angles(setup, release, 60);
    std::vector<Vec> line{{0, 100}};
    for (std::size_t i = 1; i + 1 < angles.size(); ++i)
    {
        const double at = std::abs(angles[i]);
        if (at > std::abs(angles[i - 1]) && at >= std::abs(angles[i + 1]))
        {
            const double energy = (1 - std::cos(at)) / (1 - std::cos(release));
            line.push_back({static_cast<double>(i) * setup.dt(), 100 * energy});
        }
    }
    return line;
}

void draw_pendulum(const std::vector<Setup>& setups, const std::filesystem::path& file)
{
    std::vector<Series> engines;
    for (std::size_t e = 0; e < setups.size(); ++e)
    {
        setups[e].tell("pendulum");
        engines.push_back({setups[e].engine.name, color_of(e), Mark::Line, {energy_line(setups[e], radians(120))}});
    }
    const Series exact{"exact", exact_color, Mark::Dashed, {{{0, 100}, {60, 100}}}};
    write_svg(
        {"Pendulum released at 120 degrees", "time, s", "energy, % of that at the start", with_exact(exact, std::move(engines))},
        file);
}

/// Misses are left out.
Series shots(const Setup& setup, std::size_t engine, double restitution)
{
    setup.tell("flipper shots");
    Series series{setup.engine.name, color_of(engine), Mark::Dots, {{}}};
    for (int i = 0; i < 60; ++i)
    {
        const Shot shot = flipper_shot_of(setup, restitution, i / 60.0);
        if (shot.speed() > 0.5)
        {
            series.lines.front().push_back({i / 60.0, degrees(shot.angle())});
        }
    }
    return series;
}

void draw_flipper(const std::vector<Setup>& setups, double restitution, const std::string& what,
                  const std::filesystem::path& file)
{
    std::vector<Series> engines;
    for (std::size_t e = 0; e < setups.size(); ++e)
    {
        engines.push_back(shots(setups[e], e, restitution));
    }
    Series exact{"exact", exact_color, Mark::Dashed, {{}}};
    for (int i = 0; i < 60; ++i)
    {
        const Shot shot = exact_flipper_shot(setups.front().dt(), restitution, i / 60.0);
        exact.lines.front().push_back({i / 60.0, degrees(shot.angle())});
    }
    write_svg({"The same flipper shot, " + what, "when in the step the flipper meets the ball", "exit angle, degrees",
               with_exact(exact, std::move(engines))},
              file);
}

void draw_flipper_dead(const std::vector<Setup>& setups, const std::filesystem::path& file)
{
    draw_flipper(setups, 0, "dead rubber", file);
}

void draw_flipper_live(const std::vector<Setup>& setups, const std::filesystem::path& file)
{
    draw_flipper(setups, 0.5, "restitution 0.5", file);
}

} // namespace

std::span<const Picture> pictures()
{
    static const std::array list{Picture{1, "apex-decay.svg", draw_apexes}, Picture{6, "pendulum-energy.svg", draw_pendulum},
                                 Picture{15, "flipper-dead.svg", draw_flipper_dead},
                                 Picture{15, "flipper-live.svg", draw_flipper_live}};
    return list;
}

} // namespace truth
