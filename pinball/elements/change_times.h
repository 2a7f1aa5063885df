#pragma once

/// @file
/// The times of button changes within a step: given from outside, so they are checked.

#include "carom/error.h"

#include <span>
#include <string>

namespace carom::pinball {

/// Refuses times that go back or lie outside of the step. `field` names the time, "InputChange::time".
template <class Change>
void check_times(const char* function, const char* field, std::span<const Change> changes, float step)
{
    double last = 0;
    for (const Change& change : changes)
    {
        if (!(change.time >= last && change.time <= static_cast<double>(step)))
        {
            const std::string sentence = std::string(function) + ": " + field + " is " + std::to_string(change.time) +
                                         ", but must lie within the step and not before the change ahead of it";
            throw Error(sentence.c_str());
        }
        last = change.time;
    }
}

} // namespace carom::pinball
