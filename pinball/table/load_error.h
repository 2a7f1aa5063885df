#pragma once

#include <string>
#include <vector>

namespace carom::pinball {

/// One thing that a table file says wrongly.
struct LoadError
{
    std::string element{}; ///< id of the element, empty where there is none
    std::string path{};    ///< within the file, like elements[3].kick_speed
    int line = 0;          ///< from 1; 0 unknown
    int column = 0;        ///< from 1; 0 unknown
    std::string sentence{};
};

using LoadErrors = std::vector<LoadError>;

/// "12:5: element "pop1": elements[3].radius: must be ...", in one line.
[[nodiscard]] std::string to_string(const LoadError& error);

} // namespace carom::pinball
