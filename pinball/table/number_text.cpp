#include "pinball/table/number_text.h"

#include <cstdio>

namespace carom::pinball {

std::string short_number(double value)
{
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.7g", value);
    return buffer;
}

std::string millimetres(double metres)
{
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.1f mm", metres * 1000);
    return buffer;
}

} // namespace carom::pinball
