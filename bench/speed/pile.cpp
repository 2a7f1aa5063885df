#include "speed/pile.h"

namespace speed {

using namespace carom;

void add_piece(Scene& scene, Position at, int i, const ShapeDef& shape)
{
    i % 3 == 0 ? scenes::add_dynamic(scene, at, Circle{.radius = 0.25f}, shape)
               : scenes::add_dynamic(scene, at, box(0.25f, 0.25f), shape);
}

float pile_half_width(int bodies) { return 0.5f * pile_pitch * static_cast<float>((bodies + pile_rows - 1) / pile_rows); }

void build_pile(Scene& scene, int bodies, float wall_height)
{
    const float half_width = pile_half_width(bodies);
    scenes::add_trough(scene, half_width, wall_height);
    for (int i = 0; i < bodies; ++i)
    {
        const auto column = static_cast<float>(i / pile_rows) + 0.5f;
        add_piece(scene, {column * pile_pitch - half_width, 0.25f + pile_pitch * static_cast<float>(i % pile_rows)}, i);
    }
}

} // namespace speed
