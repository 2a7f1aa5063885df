#include "pinball/table/load_error.h"

namespace carom::pinball {

std::string to_string(const LoadError& error)
{
    std::string text;
    if (error.line > 0)
        text += std::to_string(error.line) + ":" + std::to_string(error.column) + ": ";
    if (!error.element.empty())
        text += "element \"" + error.element + "\": ";
    if (!error.path.empty())
        text += error.path + ": ";
    return text + error.sentence;
}

} // namespace carom::pinball
