#pragma once

// How public functions refuse bad input: refuse(...) builds the sentence and throws carom::Error, or without exceptions gives
// it to the handler and returns false.

#include "carom/error.h"
#include "carom/math.h"

#include <string>

namespace carom::internal {

/// "Scene::step: h is nan, but must be finite and > 0". Always returns false where it returns.
bool refuse(const char* function, const char* field, const std::string& value, const char* rule);

[[nodiscard]] std::string to_text(double value);
[[nodiscard]] std::string to_text(Vec2 value);
[[nodiscard]] std::string to_text(Position value);

/// Comparisons that stay true under every floating-point flag: a NaN compares false with everything.
[[nodiscard]] inline bool is_finite(float value) { return value >= -3.402823466e38f && value <= 3.402823466e38f; }
[[nodiscard]] inline bool is_finite(double value) { return value >= -1.7976931348623157e308 && value <= 1.7976931348623157e308; }
[[nodiscard]] inline bool is_finite(Vec2 v) { return is_finite(v.x) && is_finite(v.y); }
[[nodiscard]] inline bool is_finite(Position p) { return is_finite(p.x) && is_finite(p.y); }

/// Checks of one function's arguments; each gives true when the value is fine and refuses otherwise.
struct Checker
{
    const char* function;

    template <class T>
    bool finite(const char* field, T value) const
    {
        return is_finite(value) || refuse(function, field, to_text(value), "must be finite");
    }
    bool positive(const char* field, float value) const;
    bool not_negative(const char* field, float value) const;
    bool in_range(const char* field, float value, float low, float high) const;
    /// Refuses a value that is not in an enumeration, whose values run from 0 to `last`.
    template <class Enum>
    bool one_of(const char* field, Enum value, Enum last) const
    {
        return holds(value <= last, field, std::to_string(static_cast<unsigned>(value)),
                     "must be one of the enumeration's values");
    }
    bool holds(bool condition, const char* field, const std::string& value, const char* rule) const;
};

} // namespace carom::internal
