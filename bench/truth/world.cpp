#include "truth/world.h"

namespace truth {

Polygon box(double width, double height, Vec center)
{
    const Vec half{width / 2, height / 2};
    return {{center - half, center + Vec{half.x, -half.y}, center + half, center + Vec{-half.x, half.y}}};
}

} // namespace truth
