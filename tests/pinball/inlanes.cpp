// A ball that comes down an inlane rolls onto the resting bat: it was thrown 14.5 mm high by the step between guide and bat.

#include "pinball/bench_table.h"
#include "pinball/table/loader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace carom::pinball {
namespace {

struct Lane
{
    const char* table;
    const char* guide;
    const char* flipper;
};

Table table_of(const std::string& name)
{
    LoadResult loaded;
    if (name.ends_with(".json"))
        loaded = load_table_file(CAROM_TABLES_DIR "/" + name);
    else
    { // the smallest table, as the page on the format has it
        std::ifstream in(CAROM_SOURCE_DIR "/docs/table-format.md");
        std::stringstream page;
        page << in.rdbuf();
        const std::string text = page.str();
        const std::size_t start = text.find("```json\n") + 8;
        loaded = load_table(text.substr(start, text.find("```", start) - start));
    }
    EXPECT_TRUE(loaded.table) << name;
    return loaded.table.value_or(Table{});
}

// How far the ball's surface comes from all that it may roll on, m.
double highest_hop(const Lane& lane, float speed)
{
    const Table table = table_of(lane.table);
    const auto element = [&](const std::string& id) { return std::ranges::find(table.elements, id, &Element::id); };
    const Chain path = std::get<Wall>(element(lane.guide)->part).path;
    const float thickness = path.half_thickness;
    const Vec2 end = path.pieces.back().end;
    const Vec2 from = path.pieces.size() > 1 ? path.pieces[path.pieces.size() - 2].end : path.start;
    const Vec2 down = (end - from) * (1 / length(end - from));
    const Vec2 up = perp(down).y > 0 ? perp(down) : -perp(down);
    const float r = table.ball.radius;
    Playfield field(table, 1);
    Ball& ball = test::shoot(field, end - down * 0.03f + up * (thickness + r + 1e-5f), down * speed, true);
    const BodyId body = ball.state.body;
    const Vec2 pivot = std::get<Flipper>(element(lane.flipper)->part).pivot;
    double most = 0;
    for (int i = 0; i < 600; ++i)
    {
        field.step({});
        if (!field.scene().is_valid(body))
            break; // it has drained
        const Position at = field.scene().body(body).position();
        if (std::abs(at.x - static_cast<double>(pivot.x)) > 0.04 || at.y < static_cast<double>(pivot.y) - 0.02)
            continue; // not on the guide's end or the bat's base
        double nearest = 1;
        for (const ShapeId shape : field.scene().overlap_shape(Circle{.radius = 3 * r}, {at, {}}))
        {
            if (field.scene().shape(shape).body() == body || field.scene().shape(shape).is_trigger())
                continue;
            double low = static_cast<double>(0.9f * r); // how big a ball would touch it
            double high = static_cast<double>(3 * r);
            for (int k = 0; k < 40; ++k)
            {
                const double middle = 0.5 * (low + high);
                const auto touched = field.scene().overlap_shape(Circle{.radius = static_cast<float>(middle)}, {at, {}});
                (std::ranges::find(touched, shape) != touched.end() ? high : low) = middle;
            }
            nearest = std::min(nearest, high - static_cast<double>(r));
        }
        most = std::max(most, nearest < 1 ? nearest : static_cast<double>(2 * r));
    }
    return most;
}

TEST(Inlanes, LeadOntoTheBatWithoutAHop)
{
    for (const Lane& lane : {Lane{"momentum.table.json", "inlane_guide_left", "flipper_left"},
                             {"momentum.table.json", "inlane_guide_right", "flipper_right"},
                             {"lab.table.json", "guide_left", "flipper_left"},
                             {"lab.table.json", "guide_right", "flipper_right"},
                             {"smallest", "guide_left", "flipper_left"},
                             {"smallest", "guide_right", "flipper_right"}})
    {
        for (const float speed : {0.05f, 0.15f, 0.28f, 0.5f})
            EXPECT_LT(highest_hop(lane, speed), 0.001) << lane.table << " " << lane.guide << " " << speed << " m/s";
    }
}

} // namespace
} // namespace carom::pinball
